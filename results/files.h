// Writing files so that a reader never meets half of one: the content goes to a temporary file in the same folder,
// which takes the final name only when it is complete and on the disk.
#pragma once

#include <string>
#include <string_view>

#include "sim/error.h"

namespace stillhook {

/// A file being written under a temporary name. commit() gives it its real name; without commit() it is removed and
/// a file that already had the real name stays as it was.
class PendingFile {
 public:
  /// Throws FileError when the folder does not exist or cannot be written.
  explicit PendingFile(std::string path);
  ~PendingFile();
  PendingFile(const PendingFile&) = delete;
  PendingFile& operator=(const PendingFile&) = delete;

  const std::string& path() const { return path_; }            // the final name
  const std::string& temporary() const { return temporary_; }  // where to write
  enum class Flush { yes, no };
  /// Flushes the temporary file to the disk, unless told not to, and renames it. Throws FileError.
  void commit(Flush flush = Flush::yes);

 private:
  std::string path_, temporary_;
  bool done_ = false;
};

/// Writes `content` to `path`, replacing what is there only when everything is written. Throws FileError
/// that names the file and the reason ("No space left on device", "Permission denied").
void write_file(const std::string& path, std::string_view content);

}  // namespace stillhook
