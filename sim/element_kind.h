// What the program has to know of a kind of force element that a case can hold. An entry of a case is a struct that
// derives from ElementEntry; the list of the kinds stands in specification.h, one line each. The reader, the checks of
// names, the model, the recorder, the metrics, replay and report loop over that list, so a kind that lacks one of the
// functions below does not link.
#pragma once

#include <memory>
#include <string>
#include <vector>

namespace stillhook {

class ElementSite;   // sim/element_site.h
class ForceElement;  // sim/multibody/force_element.h
class EntryCheck;    // problems/entry_check.h
class SceneBuilder;  // results/scene_builder.h
struct ChannelPlot;  // results/channel_plot.h
struct MetricRow;    // results/metrics/metric_row.h
struct Table;        // problems/field_table.h

// Each kind has functions of its own, found through their argument; they are no templates, and that is meant.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wnon-template-friend"

template <class Spec>
struct ElementEntry {
  std::string name;

  /// The law, in the kind's own file in sim. Throws SpecificationError.
  friend std::unique_ptr<const ForceElement> make_element(const Spec& entry, const ElementSite& site);
  /// Its keys, and its rules beyond one key: problems/format/<kind>.cpp.
  friend const Table& case_table(const Spec*);
  friend void check_entry(const Spec& entry, EntryCheck& check);
  /// Its metrics, its shapes in drawings and replay, its plots in the report: results/elements/<kind>.cpp.
  friend std::vector<MetricRow> metric_rows(const Spec*);
  friend void add_shapes(const Spec& entry, SceneBuilder& scene);
  friend std::vector<ChannelPlot> channel_plots(const Spec*);
};

#pragma GCC diagnostic pop

struct Specification;

/// A line of the list.
template <class Entry>
struct ElementKind {
  using Spec = Entry;
  const char* section;  // of the case: "wires"
  const char* noun;     // "wire"
  const char* title;    // for the key reference and over tables: "Mooring lines"
  std::vector<Spec> Specification::*entries;
  std::string Spec::*drive = nullptr;  // the entry's key that names the drive which moves it

  /// What the functions of a kind that need no entry are asked with.
  static const Spec* tag() { return nullptr; }
};

}  // namespace stillhook
