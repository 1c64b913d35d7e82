#include "sim/hull/coefficients/whole_file.h"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>

#include "sim/specification.h"

namespace stillhook {

WholeFile::WholeFile(std::string path)
    : path_(std::move(path)), temporary_(path_ + ".part-" + std::to_string(static_cast<long>(::getpid()))) {}

WholeFile::~WholeFile() {
  if (!done_) std::remove(temporary_.c_str());
}

void WholeFile::write(const std::string& content) {
  std::ofstream out(temporary_, std::ios::binary);
  if (!out) throw SpecificationError(path_, "", std::string("cannot be written: ") + std::strerror(errno));
  out.write(content.data(), static_cast<std::streamsize>(content.size()));
  out.close();
  if (!out) throw SpecificationError(path_, "", std::string("cannot be written: ") + std::strerror(errno));
}

void WholeFile::commit() {
  if (std::rename(temporary_.c_str(), path_.c_str()) != 0)
    throw SpecificationError(path_, "", std::string("cannot be put in place: ") + std::strerror(errno));
  done_ = true;
}

}  // namespace stillhook
