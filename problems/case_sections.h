// The sections of a case and what they are for, in one place: what a search or fit may vary, what a store of
// evaluations belongs to, whose entries share one set of names.
#pragma once

#include <span>
#include <string>

namespace stillhook {

struct CaseSection {
  const char* key;
  bool varied;  // keys in it change what a simulation does: a search or a fit may vary them
  bool stored;  // evaluations of a search depend on it, so that a store is not gone on with when it changes
};

std::span<const CaseSection> case_sections();

/// True for a section whose keys a search or a fit may vary.
bool may_be_varied(const std::string& section);

}  // namespace stillhook
