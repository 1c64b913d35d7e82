#include "problems/case.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <fmt/core.h>

#include "problems/case_checks.h"
#include "problems/case_document.h"
#include "problems/case_format.h"
#include "problems/case_key.h"
#include "problems/case_reader.h"
#include "problems/spectra/sea_files.h"

namespace stillhook {
namespace {

std::string override_origin(const Override& setting) { return "--set " + setting.key + "=" + setting.value; }

void set_overrides(Node& root, const std::vector<Override>& overrides) {
  for (const Override& setting : overrides) {
    const std::string origin = override_origin(setting);
    Node value = parse_value(setting.key, setting.value);
    value.position = {origin, 1, 1};
    try {
      set_key(root, setting.key, value);
    } catch (const KeyError& error) {
      throw CaseError(origin + ": " + error.what());
    }
  }
}

Node document_of(const std::string& text, const std::string& file, const std::vector<Override>& overrides) {
  Node root = parse_document(text, file);
  set_overrides(root, overrides);
  return root;
}

std::string written(double value) {
  std::string text = fmt::format("{}", value);  // shortest form that reads back to the same bits
  return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
}

}  // namespace

namespace {

/// Spectra and records that seas and the wind have in files.
void read_files_of(Case& c, const Node& root, Findings& findings) {
  SeaSpec& sea = c.specification.sea;
  const auto read = [&](SeaStateSpec& state, const std::string& entry) {
    const char* key = state.type == SeaStateSpec::Type::record ? "record_file" : "spectrum_file";
    try {
      read_sea_file(state, sea.density, sea.gravity);
    } catch (const FileError& error) {
      findings.add(position_of_key(root, entry, key), entry, key, error.what());
    }
  };
  for (SeaStateSpec& state : sea.states) {
    read(state, "sea.states." + state.name);
    for (SeaStateSpec& part : state.parts) read(part, "sea.states." + state.name + ".parts." + part.name);
  }
  try {
    read_wind_record(c.specification.wind);
  } catch (const FileError& error) {
    findings.add(position_of_key(root, "wind", "record_file"), "wind", "record_file", error.what());
  }
}

/// Fills a case, whose text, file, directory and overrides are known, from its document.
void read_document(Node root, Case& c) {
  Findings findings(c.file);
  TableReader reader(c.directory, findings);
  reader.read(case_table(), root, &c, {});
  if (!c.rigging.empty()) {
    findings.throw_if_any();
    expand_rigging(c, root, findings);
    findings.throw_if_any();  // without its bodies and wires all that names them would be told too
  }
  check_names(c, root, reader.references(), findings);
  findings.throw_if_any();  // what follows takes every key and name for good
  check_lift(c, root, findings);
  check_stations(c, root, findings);
  check_plan(c, root, findings);
  check_varied_moves(c, root, findings);
  check_fit(c, root, findings);
  check_operability(c, root, findings);
  check_weather(c.weather, root, findings);
  findings.throw_if_any();
  read_files_of(c, root, findings);
  findings.throw_if_any();
  check_crane_seas(c, root, findings);
  findings.throw_if_any();
  if (c.title.empty()) c.title = c.name;
  c.specification.name = c.name;
  for (JointSpec& joint : c.specification.joints) joint.axis.normalize();
  for (MooringSpec& mooring : c.specification.moorings)
    if (!mooring.tow.empty()) mooring.tow_direction.normalize();
  c.document = std::make_shared<const Node>(std::move(root));
}

}  // namespace

Case read_case_text(const std::string& text, const std::string& name, const std::string& directory,
                    const std::vector<Override>& overrides) {
  Case c;
  c.directory = directory;
  c.file = name;
  c.text = text;
  c.overrides = overrides;
  read_document(document_of(text, name, overrides), c);
  return c;
}

WeatherSpec read_weather_settings(const std::string& directory, const std::vector<Override>& overrides) {
  for (const Override& setting : overrides)
    if (!setting.key.starts_with("weather."))
      throw CaseError(override_origin(setting) +
                      ": without a case only keys of the section weather can be set, as in --set weather.operation_h=10");
  Node root;
  set_overrides(root, overrides);
  Findings findings("--set");
  WeatherSpec weather;
  TableReader reader(directory, findings);
  reader.read(weather_table(), root.at("weather"), &weather, "weather");
  check_weather(weather, root, findings);
  findings.throw_if_any();
  return weather;
}

std::string resolved_text(const Case& c) { return write_document(*c.document); }

Case read_case(const std::string& path, const std::vector<Override>& overrides) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) throw CaseError(path + ": is a folder, not a case file");
  std::ifstream in(path, std::ios::binary);
  if (!in) throw CaseError(path + ": cannot be read: " + std::strerror(errno));
  std::ostringstream text;
  text << in.rdbuf();
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  return read_case_text(text.str(), path, folder.empty() ? "." : folder.string(), overrides);
}

double key_value(const Case& c, const std::string& key) {
  Node root = *c.document;
  try {
    std::optional<double> common;
    for (const KeyTarget& target : find_targets(root, key)) {
      const std::optional<double> value = number_at(target);
      if (!value) throw CaseError(fmt::format("{}: {}: has no number in this case", c.file, key));
      if (common && *common != *value)
        throw CaseError(fmt::format("{}: {}: leads to different values, {} and {}", c.file, key, *common, *value));
      common = value;
    }
    return *common;  // find_targets finds at least one or throws
  } catch (const KeyError& error) {
    throw CaseError(fmt::format("{}: {}: {}", c.file, key, error.what()));
  }
}

std::string key_unit(const Case& c, const std::string& key) {
  Node root = *c.document;
  try {
    return find_targets(root, key).front().field->unit.text;
  } catch (const KeyError& error) {
    throw CaseError(fmt::format("{}: {}: {}", c.file, key, error.what()));
  }
}

Case with_values(const Case& c, const std::vector<std::pair<std::string, double>>& values) {
  Case changed;
  changed.directory = c.directory;
  changed.file = c.file;
  changed.text = c.text;
  changed.overrides = c.overrides;
  Node root = *c.document;
  for (const auto& [key, value] : values) {
    if (!std::isfinite(value))
      throw CaseError(fmt::format("{}: {}: must be a finite number, got {}", c.file, key, value));
    const Override setting{key, written(value)};
    std::erase_if(changed.overrides, [&](const Override& o) { return o.key == setting.key; });
    changed.overrides.push_back(setting);
    Node number;
    number.kind = Node::Kind::number;
    number.number = value;
    number.position = {override_origin(setting), 1, 1};
    try {
      set_key(root, key, number);
    } catch (const KeyError& error) {
      throw CaseError(number.position.origin + ": " + error.what());
    }
  }
  read_document(std::move(root), changed);
  return changed;
}

CaseError located(const Case& c, const SpecificationError& error) {
  const Node& root = *c.document;
  const std::string entry = written_entry(c, error.entry);
  Position position = position_of_key(root, entry, error.field);
  const std::string prefix = error.entry + (error.field.empty() ? "" : "." + error.field) + ": ";
  std::string sentence = error.what();
  if (sentence.compare(0, prefix.size(), prefix) == 0) sentence.erase(0, prefix.size());
  Findings findings(c.file);
  findings.add(position, entry, error.field, sentence);
  try {
    findings.throw_if_any();
  } catch (const CaseError& located_error) {
    return located_error;
  }
  return CaseError(sentence);
}

}  // namespace stillhook
