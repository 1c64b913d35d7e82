// The case format for other readers: editors (JSON Schema) and people (the key reference). Both come from the field
// tables.
#pragma once

#include <string>

namespace stillhook {

/// JSON Schema, draft 2020-12, of a case file. What one key cannot say alone (names that must exist, keys that belong
/// to one kind) is left to the reader.
std::string json_schema();

/// Every key with its unit, range, default and meaning, as Markdown: the text of docs/case-format.md.
std::string key_reference_markdown();

}  // namespace stillhook
