#include "sim/hull/coefficients/hdf5_file.h"

#include <hdf5.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <memory>

#include "sim/specification.h"

namespace stillhook {
namespace {

constexpr hssize_t kLargestDataset = 200'000'000;  // numbers: more is a damaged header

/// The library's own report on standard error is off while this lives: the exceptions say it.
class QuietErrors {
 public:
  QuietErrors() {
    H5dont_atexit();  // it crashes on files that a full disk kept from being closed
    H5Eget_auto2(H5E_DEFAULT, &function_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  QuietErrors(const QuietErrors&) = delete;
  QuietErrors& operator=(const QuietErrors&) = delete;
  ~QuietErrors() { H5Eset_auto2(H5E_DEFAULT, function_, data_); }

 private:
  H5E_auto2_t function_ = nullptr;
  void* data_ = nullptr;
};

/// An identifier of the library, closed at the end of the scope.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  operator hid_t() const { return id_; }
  bool valid() const { return id_ >= 0; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

/// Integers of `size` bytes at `from`; what an HDF5 boolean or enumeration is made of.
double integer_at(const unsigned char* from, std::size_t size) {
  const auto as = [from](auto number) {
    std::memcpy(&number, from, sizeof number);
    return static_cast<double>(number);
  };
  if (size == 1) return as(std::int8_t{});
  if (size == 2) return as(std::int16_t{});
  return as(std::int32_t{});
}

}  // namespace

std::string Hdf5Array::shape_text() const {
  std::string text;
  for (std::size_t n : shape) text += "[" + std::to_string(n) + "]";
  return text.empty() ? "a single value" : text;
}

Hdf5File::Hdf5File(const std::string& path, Mode mode, const std::string& shown_as)
    : path_(shown_as.empty() ? path : shown_as) {
  const QuietErrors quiet;
  if (mode == Mode::create) {
    file_ = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    if (file_ < 0) fail("cannot be written");
    return;
  }
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) fail("cannot be opened");
  const htri_t known = H5Fis_hdf5(path.c_str());
  if (known <= 0) fail("is not an HDF5 file");
  file_ = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  if (file_ < 0) fail("is a damaged HDF5 file: is it cut off?");
}

Hdf5File::~Hdf5File() {
  const QuietErrors quiet;
  if (file_ >= 0) H5Fclose(file_);
}

void Hdf5File::fail(const std::string& sentence) const { throw SpecificationError(path_, "", sentence); }

bool Hdf5File::exists(const std::string& name) const {
  const QuietErrors quiet;
  for (std::size_t slash = name.find('/', 1);; slash = name.find('/', slash + 1)) {
    if (H5Lexists(file_, name.substr(0, slash).c_str(), H5P_DEFAULT) <= 0) return false;
    if (slash == std::string::npos) return true;
  }
}

bool Hdf5File::is_text(const std::string& name) const {
  const QuietErrors quiet;
  if (!exists(name)) return false;
  const Handle data(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose);
  if (!data.valid()) return false;
  const Handle type(H5Dget_type(data), H5Tclose);
  return H5Tget_class(type) == H5T_STRING;
}

Hdf5Array Hdf5File::numbers(const std::string& name) const {
  const QuietErrors quiet;
  if (!exists(name)) fail("the dataset " + name + " is missing");
  const Handle data(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose);
  if (!data.valid()) fail(name + " is not a dataset");
  const Handle type(H5Dget_type(data), H5Tclose), space(H5Dget_space(data), H5Sclose);
  const H5T_class_t kind = H5Tget_class(type);
  if (kind != H5T_INTEGER && kind != H5T_FLOAT && kind != H5T_ENUM) fail("the dataset " + name + " is not of numbers");
  const int rank = H5Sget_simple_extent_ndims(space);
  const hssize_t count = H5Sget_simple_extent_npoints(space);
  if (rank < 0 || rank > 8 || count < 0 || count > kLargestDataset)
    fail("the dataset " + name + " has no usable shape");
  std::vector<hsize_t> shape(static_cast<std::size_t>(rank));
  if (rank > 0) H5Sget_simple_extent_dims(space, shape.data(), nullptr);
  Hdf5Array array{{shape.begin(), shape.end()}, std::vector<double>(static_cast<std::size_t>(count))};
  herr_t status = 0;
  if (kind == H5T_ENUM) {
    const Handle native(H5Tget_native_type(type, H5T_DIR_ASCEND), H5Tclose);
    const std::size_t size = H5Tget_size(native);
    if (size != 1 && size != 2 && size != 4) fail("the dataset " + name + " is not of numbers");
    std::vector<unsigned char> raw(array.value.size() * size);
    status = H5Dread(data, native, H5S_ALL, H5S_ALL, H5P_DEFAULT, raw.data());
    for (std::size_t n = 0; n < array.value.size(); ++n) array.value[n] = integer_at(&raw[n * size], size);
  } else if (count > 0) {
    status = H5Dread(data, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, array.value.data());
  }
  if (status < 0) fail("the dataset " + name + " cannot be read: is the file cut off?");
  return array;
}

std::string Hdf5File::text(const std::string& name) const {
  const QuietErrors quiet;
  if (!exists(name)) fail("the dataset " + name + " is missing");
  const Handle data(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose);
  if (!data.valid()) fail(name + " is not a dataset");
  const Handle type(H5Dget_type(data), H5Tclose), space(H5Dget_space(data), H5Sclose);
  if (H5Tget_class(type) != H5T_STRING || H5Sget_simple_extent_npoints(space) != 1) fail(name + " is not a text");
  const Handle memory(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_cset(memory, H5Tget_cset(type));
  if (H5Tis_variable_str(type) > 0) {
    H5Tset_size(memory, H5T_VARIABLE);
    char* raw = nullptr;
    if (H5Dread(data, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, static_cast<void*>(&raw)) < 0)
      fail("the dataset " + name + " cannot be read: is the file cut off?");
    const std::string result = raw == nullptr ? "" : raw;
    H5free_memory(raw);
    return result;
  }
  std::string raw(H5Tget_size(type) + 1, '\0');
  H5Tset_size(memory, raw.size());
  if (H5Dread(data, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, raw.data()) < 0)
    fail("the dataset " + name + " cannot be read: is the file cut off?");
  return raw.c_str();
}

namespace {

std::unique_ptr<Handle> groups_on_the_way() {
  auto properties = std::make_unique<Handle>(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
  H5Pset_create_intermediate_group(*properties, 1);
  return properties;
}

Handle text_type(const std::string& text) {
  const hid_t type = H5Tcopy(H5T_C_S1);
  H5Tset_size(type, std::max<std::size_t>(text.size(), 1));
  return Handle(type, H5Tclose);
}

}  // namespace

void Hdf5File::write(const std::string& name, const Hdf5Array& array, const std::string& units) {
  const QuietErrors quiet;
  const std::vector<hsize_t> shape(array.shape.begin(), array.shape.end());
  const Handle space(H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr), H5Sclose);
  const auto properties = groups_on_the_way();
  const Handle data(H5Dcreate2(file_, name.c_str(), H5T_IEEE_F64LE, space, *properties, H5P_DEFAULT, H5P_DEFAULT),
                    H5Dclose);
  if (!data.valid() || H5Dwrite(data, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, array.value.data()) < 0)
    fail("the dataset " + name + " cannot be written");
  if (units.empty()) return;
  const Handle one(H5Screate(H5S_SCALAR), H5Sclose), type = text_type(units);
  const Handle attribute(H5Acreate2(data, "units", type, one, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  if (!attribute.valid() || H5Awrite(attribute, type, units.data()) < 0)
    fail("the units of " + name + " cannot be written");
}

void Hdf5File::write(const std::string& name, const std::string& text) {
  const QuietErrors quiet;
  const auto properties = groups_on_the_way();
  const Handle one(H5Screate(H5S_SCALAR), H5Sclose), type = text_type(text);
  const Handle data(H5Dcreate2(file_, name.c_str(), type, one, *properties, H5P_DEFAULT, H5P_DEFAULT), H5Dclose);
  const std::string padded = text.empty() ? std::string(1, ' ') : text;
  if (!data.valid() || H5Dwrite(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, padded.data()) < 0)
    fail("the dataset " + name + " cannot be written");
}

void Hdf5File::close() {
  const QuietErrors quiet;
  const hid_t file = file_;
  file_ = -1;
  if (H5Fflush(file, H5F_SCOPE_GLOBAL) < 0 || H5Fclose(file) < 0) fail("cannot be written");
}

}  // namespace stillhook
