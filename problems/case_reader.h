// From a document to structs by way of the field tables: keys, types, units, ranges, alternatives, files.
#pragma once

#include <string>
#include <vector>

#include "problems/case_findings.h"
#include "problems/field_table.h"

namespace stillhook {

/// A text in the case that names something else.
struct NamedThing {
  Reference what = Reference::none;
  std::string name;
  Position position;
  std::string section, key;
};

class TableReader {
 public:
  /// Relative file names start at `directory`.
  TableReader(std::string directory, Findings& findings) : directory_(std::move(directory)), findings_(findings) {}

  /// Fills `object` from `node`. File names in `node` become absolute.
  void read(const Table& table, Node& node, void* object, const std::string& section);

  const std::vector<NamedThing>& references() const { return references_; }

 private:
  bool applies(const Table& table, const Field& field, const Node& node) const;
  void check_groups(const Table& table, const Node& node, const std::string& section,
                    const std::vector<std::string>& meant);
  void check_absent(const Table& table, const Field& field, const Node& node, const std::string& section);
  void read_field(const Field& field, Node& value, void* object, const std::string& section);
  void read_number(const Field& field, const Node& value, void* object, const std::string& section);
  void read_numbers(const Field& field, const Node& value, void* object, const std::string& section);
  void read_rows(const Field& field, const Node& value, void* object, const std::string& section);
  void read_text(const Field& field, Node& value, void* object, const std::string& section);
  void read_entries(const Field& field, Node& array, void* object, const std::string& section);
  void read_map(const Field& field, Node& map, void* object, const std::string& section);
  bool good_number(const Field& field, const Node& value, const std::string& section, const std::string& which);
  std::string absolute_file(const std::string& name) const;
  std::string existing_file(const std::string& name) const;

  std::string directory_;
  Findings& findings_;
  std::vector<NamedThing> references_;
};

}  // namespace stillhook
