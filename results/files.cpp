#include "results/files.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

namespace stillhook {
namespace {

[[noreturn]] void fail(const std::string& path, const char* what, int error) {
  throw FileError(fmt::format("{}: {}: {}", path, what, std::strerror(error)));
}

/// Closes the descriptor at the end of the scope.
struct Descriptor {
  int fd = -1;
  ~Descriptor() {
    if (fd >= 0) ::close(fd);
  }
};

}  // namespace

PendingFile::PendingFile(std::string path)
    : path_(std::move(path)), temporary_(fmt::format("{}.part-{}", path_, static_cast<long>(::getpid()))) {
  std::filesystem::path folder = std::filesystem::path(path_).parent_path();
  if (folder.empty()) folder = ".";
  std::error_code error;
  if (!std::filesystem::is_directory(folder, error))
    throw FileError(fmt::format("{}: cannot be written: folder {} does not exist", path_, folder.string()));
  if (::access(folder.c_str(), W_OK) != 0) fail(path_, "cannot be written", errno);
}

PendingFile::~PendingFile() {
  if (!done_) std::remove(temporary_.c_str());
}

void PendingFile::commit(Flush flush) {
  if (flush == Flush::yes) {
    const Descriptor file{::open(temporary_.c_str(), O_RDONLY | O_CLOEXEC)};
    if (file.fd < 0 || ::fsync(file.fd) != 0) fail(path_, "cannot be written", errno);
  }
  if (std::rename(temporary_.c_str(), path_.c_str()) != 0) fail(path_, "cannot be put in place", errno);
  done_ = true;
  if (flush == Flush::no) return;
  // The new name itself survives a power cut only when the folder is flushed too; some file systems refuse that,
  // and then the file is complete all the same.
  std::filesystem::path folder = std::filesystem::path(path_).parent_path();
  if (folder.empty()) folder = ".";
  const Descriptor directory{::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)};
  if (directory.fd >= 0) ::fsync(directory.fd);
}

void write_file(const std::string& path, std::string_view content) {
  PendingFile pending(path);
  {
    const Descriptor file{::open(pending.temporary().c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666)};
    if (file.fd < 0) fail(path, "cannot be written", errno);
    while (!content.empty()) {
      const ssize_t written = ::write(file.fd, content.data(), content.size());
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) fail(path, "cannot be written", errno);
      content.remove_prefix(static_cast<std::size_t>(written));
    }
  }
  pending.commit();
}

}  // namespace stillhook
