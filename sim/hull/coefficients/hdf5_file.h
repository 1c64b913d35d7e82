// The little of HDF5 that coefficient databases need: datasets of numbers and of text, by path. Not for several threads
// at once: the serial library keeps global state.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace stillhook {

/// A dataset of numbers, last index fastest.
struct Hdf5Array {
  std::vector<std::size_t> shape;
  std::vector<double> value;

  std::string shape_text() const;  // "[6][6][20]"
};

class Hdf5File {
 public:
  enum class Mode { read, create };
  /// Throws SpecificationError(path) when it cannot be opened or is not an HDF5 file. When created, messages name
  /// `shown_as`.
  Hdf5File(const std::string& path, Mode mode, const std::string& shown_as = "");
  Hdf5File(const Hdf5File&) = delete;
  Hdf5File& operator=(const Hdf5File&) = delete;
  ~Hdf5File();

  bool exists(const std::string& name) const;
  bool is_text(const std::string& name) const;
  /// Numbers (integers, floating point, booleans). Throws SpecificationError(path) when the dataset is missing, holds
  /// something else, or cannot be read to its end.
  Hdf5Array numbers(const std::string& name) const;
  std::string text(const std::string& name) const;

  /// Groups on the way are created. `units` becomes an attribute.
  void write(const std::string& name, const Hdf5Array& array, const std::string& units);
  void write(const std::string& name, const std::string& text);
  /// Throws when what was written did not reach the disk.
  void close();

  [[noreturn]] void fail(const std::string& sentence) const;

 private:
  std::string path_;
  std::int64_t file_ = -1;
};

}  // namespace stillhook
