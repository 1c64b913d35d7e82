// Keys and rules that areas and hulls have alike, in the wind and in the current.
#pragma once

#include <string>

#include "problems/entry_check.h"
#include "problems/field_table.h"

namespace stillhook {

/// `fluid`: "wind" or "current", for the sentences.
template <class S>
void add_area_keys(TableOf<S>& t, const std::string& fluid, const std::string& drag, const std::string& height) {
  t.text("body", &S::body, "Body that it belongs to.").names(Reference::body).require();
  t.vector("centre_m", &S::centre, unit::m, any_value(), "Centre of the area, in the body frame.");
  t.vector("areas_m2", &S::areas, unit::m2, not_negative(),
           "Area that " + fluid + " along x, along y and along z of the body meets.")
      .require();
  t.vector("drag", &S::drag, unit::one, not_negative(), drag);
  t.number("height_m", &S::height, unit::m, positive(), height)
      .absent("the root of the larger of the areas across x and y");
}

/// Returns the key of the file, which is one of several ways to give coefficients. `use`: what they multiply.
template <class S>
Field& add_hull_keys(TableOf<S>& t, const std::string& use) {
  t.text("body", &S::body, "Body that it is the hull of.").names(Reference::body).require();
  t.vector("reference_m", &S::reference, unit::m, any_value(),
           "Amidships at the still water, in the body frame: what moments and heights refer to.")
      .require();
  t.number("length_m", &S::length, unit::m, positive(), "Length of the hull.").require();
  t.number("filter_s", &S::filter, unit::s, positive(),
           "Time constant of the filter that leaves the slow part of the hull's own velocity.");
  return t.file("coefficients", &S::coefficient_file,
                "Table with the columns angle_deg, Cx, Cy, Cn. The angle is where the flow comes from, off the bow, to "
                "port; x forward, y to port; from 0 to 180 or to 360 deg. " +
                    use);
}

void check_area(const FlowAreaSpec& area, const std::string& fluid, EntryCheck& check);
void check_hull(const FlowHullSpec& hull, const std::string& fluid, EntryCheck& check);

}  // namespace stillhook
