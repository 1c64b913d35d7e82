// An output file that appears under its name only when it is complete.
#pragma once

#include <string>

namespace stillhook {

class WholeFile {
 public:
  explicit WholeFile(std::string path);
  WholeFile(const WholeFile&) = delete;
  WholeFile& operator=(const WholeFile&) = delete;
  /// Without a commit nothing is left behind.
  ~WholeFile();

  /// Where to write: a name beside the file's own.
  const std::string& temporary() const { return temporary_; }

  /// Writes `content` to the temporary name. Throws SpecificationError(path).
  void write(const std::string& content);

  /// Puts what was written in its place. Throws SpecificationError(path).
  void commit();

 private:
  std::string path_, temporary_;
  bool done_ = false;
};

}  // namespace stillhook
