// A thin, checked hold on the NetCDF C API: opens, closes, and turns every error code into a sentence. Used by
// archive*.cpp.
#pragma once

#include <netcdf.h>

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
  /// Throws std::runtime_error "<file>: <what>: <NetCDF's reason>" if `code` is an error.
  void check(int code, const std::string& what) const;
  void close();  // reports the errors that a destructor would swallow

  // Writing.
  int define_dimension(const std::string& name, std::size_t size);
  int define(const std::string& name, nc_type type, const std::vector<int>& dimensions);
  void compress(int variable);
  void attribute(int variable, const std::string& name, const std::string& text);
  void attribute(int variable, const std::string& name, double value);
  void put(int variable, const std::vector<double>& values);
  void put(int variable, const std::vector<int>& values);
  void put(int variable, const std::vector<std::string>& values);

  // Reading. A missing dimension has size 0.
  std::size_t size(const std::string& dimension) const;
  int find(const std::string& variable) const;  // throws if it is not there
  std::string text(int variable, const std::string& name) const;
  double number(int variable, const std::string& name) const;
  std::vector<double> doubles(const std::string& variable, std::size_t count) const;
  std::vector<int> integers(const std::string& variable, std::size_t count) const;
  std::vector<std::string> strings(const std::string& variable, std::size_t count) const;

 private:
  void check_count(int variable, const std::string& name, std::size_t count) const;
  std::string shown_;
  int id_ = -1;
};

}  // namespace stillhook
