// One process at a time writes into a run folder. The lock is the operating system's (flock), on the folder itself: it
// needs no file, and is gone with the process however that ends.
#pragma once

#include <memory>
#include <string>

namespace stillhook {

class FolderLock {
 public:
  FolderLock() = default;  // none
  /// Throws UsageError that names the process which holds the folder. Where the file system has no locks there is none.
  explicit FolderLock(const std::string& folder);

 private:
  std::shared_ptr<const int> descriptor_;
};

}  // namespace stillhook
