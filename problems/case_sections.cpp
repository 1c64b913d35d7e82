#include "problems/case_sections.h"

#include <algorithm>
#include <array>

namespace stillhook {
namespace {

constexpr std::array kSections = {
    CaseSection{"name", false, true},
    CaseSection{"title", false, false},  // of reports, like the next five
    CaseSection{"project", false, false},
    CaseSection{"revision", false, false},
    CaseSection{"author", false, false},
    CaseSection{"checked_by", false, false},
    CaseSection{"north_deg", false, false},
    CaseSection{"sea", true, true},
    CaseSection{"bodies", true, true},
    CaseSection{"panel_method", true, true},
    CaseSection{"joints", true, true},
    CaseSection{"drives", true, true},
    CaseSection{"wires", true, true},
    CaseSection{"taglines", true, true},
    CaseSection{"moorings", true, true},
    CaseSection{"restoring", true, true},
    CaseSection{"contacts", true, true},
    CaseSection{"ballast", true, true},
    CaseSection{"operation", true, true},
    CaseSection{"poses", false, false},  // reported, not simulated
    CaseSection{"clearances", true, true},
    CaseSection{"limits", false, true},
    CaseSection{"solver", false, true},
    CaseSection{"plan", false, true},  // but for its budget, see store_identity()
    CaseSection{"tune", false, false},
    CaseSection{"fit", false, false},
};

}  // namespace

std::span<const CaseSection> case_sections() { return kSections; }

bool may_be_varied(const std::string& section) {
  const auto found =
      std::find_if(kSections.begin(), kSections.end(), [&](const CaseSection& s) { return s.key == section; });
  return found == kSections.end() || found->varied;  // a key that does not exist is told as that
}

}  // namespace stillhook
