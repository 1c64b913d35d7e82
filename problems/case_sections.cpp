#include "problems/case_sections.h"

#include <algorithm>
#include <vector>

#include "sim/specification.h"

namespace stillhook {
namespace {

/// Every section; those of force elements come from the list of their kinds.
std::vector<CaseSection> build_sections() {
  std::vector<CaseSection> all = {
      {"name", false, true},
      {"title", false, false},  // of reports, like the next five
      {"project", false, false},
      {"revision", false, false},
      {"author", false, false},
      {"checked_by", false, false},
      {"north_deg", false, false},
      {"sea", true, true},
      {"bodies", true, true},
      {"panel_method", true, true},
      {"joints", true, true},
      {"drives", true, true},
      {"rigging", true, true},
      {"operation", true, true},
      {"poses", false, false},  // reported, not simulated
      {"clearances", true, true},
      {"crane_curves", false, true},
      {"limits", false, true},
      {"solver", false, true},
      {"plan", false, true},  // but for its budget, see store_identity()
      {"tune", false, false},
      {"fit", false, false},
      {"operability", false, false},
      {"weather", false, false},
      {"wind", true, true},
  };
  for_each_element_kind([&](const auto& kind) { all.push_back({kind.section, true, true}); });
  return all;
}

}  // namespace

std::span<const CaseSection> case_sections() {
  static const std::vector<CaseSection> sections = build_sections();
  return sections;
}

bool may_be_varied(const std::string& section) {
  const std::span<const CaseSection> sections = case_sections();
  const auto found =
      std::find_if(sections.begin(), sections.end(), [&](const CaseSection& s) { return s.key == section; });
  return found == sections.end() || found->varied;  // a key that does not exist is told as that
}

}  // namespace stillhook
