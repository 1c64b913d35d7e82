// Where the numbers of a case come from: the remark that stands behind a value in its file, `mass_t = 1000.0  # P:
// Table 1`.
#pragma once

#include <string>
#include <vector>

#include "problems/case.h"

namespace stillhook {

/// A value of a case, as written, and what its file says about it.
struct CaseSource {
  std::string key;    // as --set takes it, "bodies.load.mass_t"
  std::string value;  // as TOML, on one line
  std::string remark;
};

/// Every value of the case as resolved, in order, with the remark of its line in the file it was read from. A value
/// that --set or a search changed has that as its remark.
std::vector<CaseSource> case_sources(const Case& c);

/// The resolved case with these remarks behind its values, so that it can be read again without losing them.
std::string text_with_remarks(const Case& c);

}  // namespace stillhook
