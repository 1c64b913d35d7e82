#include "problems/entry_check.h"

#include <fmt/core.h>

#include "problems/case_key.h"

namespace stillhook {
namespace {

const char* word_of(DriveSpec::Kind kind) {
  switch (kind) {
    case DriveSpec::Kind::winch:
      return "winch";
    case DriveSpec::Kind::ballast:
      return "ballast";
    case DriveSpec::Kind::tow:
      return "tow";
    case DriveSpec::Kind::joint:
      break;
  }
  return "joint";
}

}  // namespace

EntryCheck::EntryCheck(const Specification& specification, const Node& root, Findings& findings, std::string entry)
    : specification_(specification), root_(root), findings_(findings), entry_(std::move(entry)) {}

void EntryCheck::report(const std::string& key, const std::string& sentence) {
  findings_.add(position_of_key(root_, entry_, key), entry_, key, sentence);
}

bool EntryCheck::written(const std::string& key) const { return find_key(root_, entry_, key) != nullptr; }

void EntryCheck::wants_drive(const std::string& key, const std::string& drive, DriveSpec::Kind kind) {
  const DriveSpec* found = entry_named(specification_.drives, drive);
  if (found && found->kind != kind)
    report(key, fmt::format("must name a drive of kind \"{}\", \"{}\" is a \"{}\"", word_of(kind), drive,
                            word_of(found->kind)));
}

void EntryCheck::wants_direction(const std::string& key, const Vector3& direction) {
  if (!(direction.norm() > 0.0)) report(key, "must not be [0, 0, 0]");
}

void EntryCheck::wants_another_body(const std::string& key, const std::string& body, const std::string& than) {
  if (body == than) report(key, fmt::format("must be another body than \"{}\"", than));
}

void EntryCheck::one_of(const std::string& key, const std::string& other) {
  if (written(key) && written(other)) report(key, fmt::format("cannot stand beside \"{}\", give one of them", other));
}

}  // namespace stillhook
