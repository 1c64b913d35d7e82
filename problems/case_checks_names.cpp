#include <algorithm>
#include <map>

#include <fmt/core.h>

#include "problems/case_checks.h"
#include "problems/case_key.h"

namespace stillhook {
namespace {

template <class Entries>
std::vector<std::string> names_in(const Entries& entries) {
  std::vector<std::string> names;
  for (const auto& entry : entries) names.push_back(entry.name);
  return names;
}

std::vector<std::string> names_of(Reference what, const Specification& s) {
  std::vector<std::string> names;
  switch (what) {
    case Reference::none:
      break;
    case Reference::body_or_world:
      names = names_in(s.bodies);
      names.push_back("world");
      break;
    case Reference::body:
      names = names_in(s.bodies);
      break;
    case Reference::joint:
      names = names_in(s.joints);
      break;
    case Reference::drive:
      names = names_in(s.drives);
      break;
    case Reference::wire:
      names = names_in(s.wires);
      break;
    case Reference::contact:
      names = names_in(s.contacts);
      break;
    case Reference::sea_state:
      names = names_in(s.sea.states);
      names.push_back("calm");  // still water needs no entry
      break;
    case Reference::phase:
      names = names_in(s.operation.phases);
      break;
  }
  return names;
}

std::string noun(Reference what) {
  switch (what) {
    case Reference::body:
    case Reference::body_or_world:
      return "body";
    case Reference::joint:
      return "joint";
    case Reference::drive:
      return "drive";
    case Reference::wire:
      return "wire";
    case Reference::contact:
      return "contact";
    case Reference::sea_state:
      return "sea state";
    case Reference::phase:
      return "phase";
    case Reference::none:
      break;
  }
  return "thing";
}

/// Results are channels "<name>.<quantity>", so these share one set of names.
void check_shared_names(const Specification& s, const Node& root, Findings& findings) {
  std::map<std::string, std::string> owner = {{"world", "the fixed body"}, {"sea", "the sea"}, {"phase", "the phase"}};
  const auto claim = [&](const std::string& kind, const std::vector<std::string>& names) {
    for (const std::string& name : names) {
      if (name.empty()) continue;
      const auto [first, is_new] = owner.emplace(name, kind + "." + name);
      if (!is_new && first->second != kind + "." + name)
        findings.add(position_of_key(root, kind + "." + name, "name"), kind + "." + name, "name",
                     fmt::format("\"{}\" is already the name of {}", name, first->second));
    }
  };
  claim("bodies", names_in(s.bodies));
  claim("joints", names_in(s.joints));
  claim("drives", names_in(s.drives));
  for_each_element_kind([&](const auto& kind) { claim(kind.section, names_in(s.*kind.entries)); });
}

}  // namespace

void check_names(const Case& c, const Node& root, const std::vector<NamedThing>& references, Findings& findings) {
  check_shared_names(c.specification, root, findings);
  for (const NamedThing& reference : references) {
    const std::vector<std::string> names = names_of(reference.what, c.specification);
    const auto has = [&names](const std::string& name) {
      return std::find(names.begin(), names.end(), name) != names.end();
    };
    if (has(reference.name) || has("")) continue;  // an entry without a name is told already, it may be the one meant
    if (reference.what == Reference::body && reference.name == "world")
      findings.add(reference.position, reference.section, reference.key, "must be a body that can move, not \"world\"");
    else
      findings.add(reference.position, reference.section, reference.key,
                   fmt::format("there is no {} \"{}\"{}", noun(reference.what), reference.name,
                               did_you_mean(reference.name, names)));
  }
}

}  // namespace stillhook
