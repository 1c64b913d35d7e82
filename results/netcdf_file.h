// A thin, checked hold on the NetCDF C API: opens, closes, and turns every error code into a sentence. Used by
// archive*.cpp and by the readers of 2-D spectra (problems/spectra). The NetCDF library is not thread-safe: one call at a time, over all files.
#pragma once

#include <netcdf.h>

#include <optional>
#include <string>
#include <vector>

namespace stillhook {

class NetcdfFile {
 public:
  enum class Mode { create, read };
  /// `shown` is the name that messages give (the final one when `path` is temporary).
  NetcdfFile(const std::string& path, Mode mode, std::string shown);
  ~NetcdfFile();
  NetcdfFile(const NetcdfFile&) = delete;
  NetcdfFile& operator=(const NetcdfFile&) = delete;

  int id() const { return id_; }
  /// Throws FileError "<file>: <what>: <NetCDF's reason>" if `code` is an error.
  void check(int code, const std::string& what) const;
  /// Hands everything to the operating system: what is there then survives the end of the process, however it ends.
  void sync();
  void close();  // reports the errors that a destructor would swallow

  // Writing.
  int define_dimension(const std::string& name, std::size_t size);
  int dimension(const std::string& name) const;  // of one that is defined
  enum class Storage {
    plain,
    compressed,
    whole  // at its final place in the file from the start, NaN until written: writing changes nothing else in the file
  };
  /// CF wants a long name for every variable; `units` is "" where there can be none (text, flags, mixed units).
  int define(const std::string& name, nc_type type, const std::vector<int>& dimensions, const std::string& long_name,
             const std::string& units = "", Storage storage = Storage::plain);
  void attribute(int variable, const std::string& name, const std::string& text);
  void attribute(int variable, const std::string& name, double value);
  void attribute(int variable, const std::string& name, const std::vector<int>& values);
  void put(int variable, const std::vector<double>& values);
  void put(int variable, const std::vector<int>& values);
  /// Defines and writes a variable of texts over one dimension: characters in a second dimension, `name`_length, as
  /// long as the longest, filled up with zeros. Texts of variable length would stand on a heap of HDF5's that no
  /// checksum guards, and a damaged one ends the program that reads it.
  void put_texts(const std::string& name, int dimension, const std::string& long_name,
                 const std::vector<std::string>& values);
  /// `count` rows of a variable from row `first` on.
  void put_rows(int variable, std::size_t first, std::size_t count, const double* values);
  void put_rows(int variable, std::size_t first, std::size_t count, const int* values);

  // Reading. A missing dimension has size 0.
  std::size_t size(const std::string& dimension) const;
  bool has(const std::string& variable) const;
  int find(const std::string& variable) const;  // throws if it is not there
  std::string text(int variable, const std::string& name) const;
  double number(int variable, const std::string& name) const;
  std::vector<double> doubles(const std::string& variable, std::size_t count) const;
  std::vector<int> integers(const std::string& variable, std::size_t count) const;
  /// Texts as put_texts() writes them, or of variable length, as older files have them.
  std::vector<std::string> texts(const std::string& variable, std::size_t count) const;
  /// The first `count` of a variable with one dimension.
  std::vector<double> first_doubles(int variable, std::size_t count) const;

  // Reading files of other programs, which may lack anything.
  static constexpr int kGlobal = NC_GLOBAL;  // as `variable`: an attribute of the file
  struct Dimension {
    std::string name;
    std::size_t size = 0;
  };
  std::vector<Dimension> dimensions(int variable) const;
  std::optional<std::string> text_if_any(int variable, const std::string& name) const;
  std::optional<double> number_if_any(int variable, const std::string& name) const;
  /// A block of a variable as it is stored, row-major.
  std::vector<double> block(int variable, const std::vector<std::size_t>& start,
                            const std::vector<std::size_t>& count) const;

 private:
  std::vector<std::string> texts_of_variable_length(int variable, std::size_t count) const;
  std::vector<std::size_t> shape(int variable, const std::string& name) const;
  void lay_out(int variable, nc_type type, Storage storage);
  void check_count(int variable, const std::string& name, std::size_t count) const;
  /// Start and count of whole rows, in NetCDF's terms.
  void rows(int variable, std::size_t first, std::size_t count, std::vector<std::size_t>& start,
            std::vector<std::size_t>& counts) const;
  std::string shown_;
  int id_ = -1;
};

}  // namespace stillhook
