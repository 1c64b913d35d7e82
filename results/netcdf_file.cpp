#include "results/netcdf_file.h"

#include <hdf5.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <limits>

#include "results/files.h"

namespace stillhook {
namespace {

constexpr std::size_t kCacheBytes = 65536, kCacheSlots = 101;  // per variable

}  // namespace

NetcdfFile::NetcdfFile(const std::string& path, Mode mode, std::string shown) : shown_(std::move(shown)) {
  // At the end of the program HDF5 closes what is open; a file that could not be closed, on a full disk, makes it crash
  // there. Every file is closed by its owner.
  [[maybe_unused]] static const herr_t once = H5dont_atexit();
  // Channels are written and read whole, once: a cache would only keep all of them in memory until the file is closed.
  nc_set_chunk_cache(kCacheBytes, kCacheSlots, 0.75f);
  if (mode == Mode::create)
    check(nc_create(path.c_str(), NC_NETCDF4 | NC_CLOBBER, &id_), "cannot be written");
  else
    check(nc_open(path.c_str(), NC_NOWRITE, &id_), "cannot be read");
}

NetcdfFile::~NetcdfFile() {
  if (id_ >= 0) nc_close(id_);
}

void NetcdfFile::check(int code, const std::string& what) const {
  if (code == NC_NOERR) return;
  const int system = errno;
  std::string reason = nc_strerror(code);
  // HDF5 does not pass on why the system refused a write; errno still knows.
  for (const int known : {ENOSPC, EFBIG, EDQUOT, EIO, EROFS})
    if (code == NC_EHDFERR && system == known) reason = std::strerror(system);
  throw FileError(shown_ + ": " + what + ": " + reason);
}

void NetcdfFile::sync() { check(nc_sync(id_), "cannot be written"); }

void NetcdfFile::close() {
  const int code = nc_close(id_);
  id_ = -1;
  check(code, "cannot be completed");
}

int NetcdfFile::define_dimension(const std::string& name, std::size_t size) {
  int dimension = -1;
  check(nc_def_dim(id_, name.c_str(), size, &dimension), "dimension " + name);
  return dimension;
}

int NetcdfFile::dimension(const std::string& name) const {
  int id = -1;
  check(nc_inq_dimid(id_, name.c_str(), &id), "dimension " + name);
  return id;
}

int NetcdfFile::define(const std::string& name, nc_type type, const std::vector<int>& dimensions,
                       const std::string& long_name, const std::string& units, Storage storage) {
  int variable = -1;
  check(nc_def_var(id_, name.c_str(), type, static_cast<int>(dimensions.size()), dimensions.data(), &variable),
        "variable " + name);
  lay_out(variable, type, storage);
  attribute(variable, "long_name", long_name);
  if (!units.empty()) attribute(variable, "units", units);
  return variable;
}

void NetcdfFile::lay_out(int variable, nc_type type, Storage storage) {
  if (storage == Storage::compressed) {
    check(nc_def_var_deflate(id_, variable, 1, 1, 2), "compression");
    check(nc_def_var_fletcher32(id_, variable, NC_FLETCHER32), "checksum");  // other programs, too, then see damage
  }
  if (storage != Storage::whole) return;
  check(nc_def_var_chunking(id_, variable, NC_CONTIGUOUS, nullptr), "layout");
  if (type != NC_DOUBLE) return;
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  check(nc_def_var_fill(id_, variable, NC_FILL, &nothing), "layout");
}

void NetcdfFile::attribute(int variable, const std::string& name, const std::string& text) {
  check(nc_put_att_text(id_, variable, name.c_str(), text.size(), text.c_str()), "attribute " + name);
}

void NetcdfFile::attribute(int variable, const std::string& name, double value) {
  check(nc_put_att_double(id_, variable, name.c_str(), NC_DOUBLE, 1, &value), "attribute " + name);
}

void NetcdfFile::attribute(int variable, const std::string& name, const std::vector<int>& values) {
  check(nc_put_att_int(id_, variable, name.c_str(), NC_INT, values.size(), values.data()), "attribute " + name);
}

void NetcdfFile::put(int variable, const std::vector<double>& values) {
  check(nc_put_var_double(id_, variable, values.data()), "cannot be written");
}

void NetcdfFile::put(int variable, const std::vector<int>& values) {
  check(nc_put_var_int(id_, variable, values.data()), "cannot be written");
}

void NetcdfFile::put_texts(const std::string& name, int dimension, const std::string& long_name,
                           const std::vector<std::string>& values) {
  std::size_t length = 1;
  for (const std::string& value : values) length = std::max(length, value.size());
  const int characters = define_dimension(name + "_length", length);
  const int variable = define(name, NC_CHAR, {dimension, characters}, long_name, "", Storage::compressed);
  attribute(variable, "_Encoding", "utf-8");
  std::string padded;
  for (const std::string& value : values) {
    padded += value;
    padded.append(length - value.size(), '\0');
  }
  check(nc_put_var_text(id_, variable, padded.data()), "cannot be written");
}

void NetcdfFile::rows(int variable, std::size_t first, std::size_t count, std::vector<std::size_t>& start,
                      std::vector<std::size_t>& counts) const {
  counts = shape(variable, "of rows");
  start.assign(counts.size(), 0);
  start.front() = first;
  counts.front() = count;
}

void NetcdfFile::put_rows(int variable, std::size_t first, std::size_t count, const double* values) {
  std::vector<std::size_t> start, counts;
  rows(variable, first, count, start, counts);
  check(nc_put_vara_double(id_, variable, start.data(), counts.data(), values), "cannot be written");
}

void NetcdfFile::put_rows(int variable, std::size_t first, std::size_t count, const int* values) {
  std::vector<std::size_t> start, counts;
  rows(variable, first, count, start, counts);
  check(nc_put_vara_int(id_, variable, start.data(), counts.data(), values), "cannot be written");
}

std::size_t NetcdfFile::size(const std::string& dimension) const {
  int id = -1;
  std::size_t size = 0;
  if (nc_inq_dimid(id_, dimension.c_str(), &id) != NC_NOERR) return 0;
  check(nc_inq_dimlen(id_, id, &size), "dimension " + dimension);
  return size;
}

bool NetcdfFile::has(const std::string& variable) const {
  int id = -1;
  return nc_inq_varid(id_, variable.c_str(), &id) == NC_NOERR;
}

int NetcdfFile::find(const std::string& variable) const {
  int id = -1;
  check(nc_inq_varid(id_, variable.c_str(), &id), "is not the archive of a stillhook run: no variable " + variable);
  return id;
}

std::string NetcdfFile::text(int variable, const std::string& name) const {
  const std::string what = "is not the archive of a stillhook run: no attribute " + name;
  std::size_t length = 0;
  nc_type type = NC_NAT;
  check(nc_inq_att(id_, variable, name.c_str(), &type, &length), what);
  if (type != NC_CHAR) check(NC_EBADTYPE, what);
  std::string value(length, '\0');
  check(nc_get_att_text(id_, variable, name.c_str(), value.data()), what);
  return value;
}

double NetcdfFile::number(int variable, const std::string& name) const {
  const std::string what = "is not the archive of a stillhook run: no attribute " + name;
  std::size_t length = 0;
  nc_type type = NC_NAT;
  check(nc_inq_att(id_, variable, name.c_str(), &type, &length), what);
  if (length != 1) check(NC_EINVAL, what);
  double value = 0.0;
  check(nc_get_att_double(id_, variable, name.c_str(), &value), what);
  return value;
}

std::vector<std::size_t> NetcdfFile::shape(int variable, const std::string& name) const {
  int rank = 0;
  check(nc_inq_varndims(id_, variable, &rank), name);
  std::vector<int> dimensions(static_cast<std::size_t>(rank));
  check(nc_inq_vardimid(id_, variable, dimensions.data()), name);
  std::vector<std::size_t> lengths;
  for (int d : dimensions) check(nc_inq_dimlen(id_, d, &lengths.emplace_back()), name);
  return lengths;
}

void NetcdfFile::check_count(int variable, const std::string& name, std::size_t count) const {
  std::size_t total = 1;
  for (const std::size_t length : shape(variable, name)) total *= length;
  if (total != count) check(NC_EEDGE, "variable " + name + " has another size than expected");
}

std::vector<double> NetcdfFile::doubles(const std::string& variable, std::size_t count) const {
  std::vector<double> values(count);
  const int id = find(variable);
  check_count(id, variable, count);
  check(nc_get_var_double(id_, id, values.data()), "variable " + variable);
  return values;
}

std::vector<double> NetcdfFile::first_doubles(int variable, std::size_t count) const {
  std::vector<double> values(count);
  if (count == 0) return values;
  const std::vector<std::size_t> lengths = shape(variable, "of samples");
  if (lengths.size() != 1 || lengths[0] < count) check(NC_EEDGE, "holds fewer samples than it says");
  const std::size_t start = 0;
  check(nc_get_vara_double(id_, variable, &start, &count, values.data()), "cannot be read");
  return values;
}

std::vector<int> NetcdfFile::integers(const std::string& variable, std::size_t count) const {
  std::vector<int> values(count);
  const int id = find(variable);
  check_count(id, variable, count);
  check(nc_get_var_int(id_, id, values.data()), "variable " + variable);
  return values;
}

std::vector<std::string> NetcdfFile::texts(const std::string& variable, std::size_t count) const {
  const int id = find(variable);
  nc_type type = NC_NAT;
  check(nc_inq_vartype(id_, id, &type), "variable " + variable);
  if (type == NC_STRING) {
    check_count(id, variable, count);
    return texts_of_variable_length(id, count);
  }
  const std::vector<std::size_t> lengths = shape(id, variable);
  if (type != NC_CHAR || lengths.size() != 2 || lengths[0] != count)
    check(NC_EEDGE, "variable " + variable + " does not hold the texts that are expected");
  const std::size_t length = lengths[1];
  std::string padded(count * length, '\0');
  check(nc_get_var_text(id_, id, padded.data()), "variable " + variable);
  std::vector<std::string> values;
  for (std::size_t i = 0; i < count; ++i) {
    values.push_back(padded.substr(i * length, length));
    values.back().erase(std::min(values.back().find('\0'), length));
  }
  return values;
}

std::vector<std::string> NetcdfFile::texts_of_variable_length(int variable, std::size_t count) const {
  std::vector<char*> pointers(count, nullptr);
  check(nc_get_var_string(id_, variable, pointers.data()), "texts");
  std::vector<std::string> values;
  for (const char* p : pointers) values.emplace_back(p ? p : "");
  nc_free_string(count, pointers.data());
  return values;
}

std::vector<NetcdfFile::Dimension> NetcdfFile::dimensions(int variable) const {
  int rank = 0;
  check(nc_inq_varndims(id_, variable, &rank), "dimensions");
  std::vector<int> ids(static_cast<std::size_t>(rank));
  check(nc_inq_vardimid(id_, variable, ids.data()), "dimensions");
  std::vector<Dimension> result;
  for (const int id : ids) {
    char name[NC_MAX_NAME + 1] = {};
    std::size_t size = 0;
    check(nc_inq_dim(id_, id, name, &size), "dimensions");
    result.push_back({name, size});
  }
  return result;
}

std::optional<std::string> NetcdfFile::text_if_any(int variable, const std::string& name) const {
  std::size_t length = 0;
  nc_type type = NC_NAT;
  if (nc_inq_att(id_, variable, name.c_str(), &type, &length) != NC_NOERR) return std::nullopt;
  if (type == NC_STRING && length == 1) {
    char* pointer = nullptr;
    check(nc_get_att_string(id_, variable, name.c_str(), &pointer), "attribute " + name);
    std::string value = pointer ? pointer : "";
    nc_free_string(1, &pointer);
    return value;
  }
  if (type != NC_CHAR) return std::nullopt;
  std::string value(length, '\0');
  check(nc_get_att_text(id_, variable, name.c_str(), value.data()), "attribute " + name);
  value.erase(std::min(value.find('\0'), length));
  return value;
}

std::optional<double> NetcdfFile::number_if_any(int variable, const std::string& name) const {
  std::size_t length = 0;
  nc_type type = NC_NAT;
  if (nc_inq_att(id_, variable, name.c_str(), &type, &length) != NC_NOERR || length != 1 || type == NC_CHAR ||
      type == NC_STRING)
    return std::nullopt;
  double value = 0.0;
  check(nc_get_att_double(id_, variable, name.c_str(), &value), "attribute " + name);
  return value;
}

std::vector<double> NetcdfFile::block(int variable, const std::vector<std::size_t>& start,
                                      const std::vector<std::size_t>& count) const {
  constexpr std::size_t kMost = 100'000'000;  // values: 800 MB
  const std::vector<Dimension> all = dimensions(variable);
  if (all.size() != start.size() || all.size() != count.size()) check(NC_EINVAL, "a block of another rank");
  std::size_t total = 1;
  for (std::size_t i = 0; i < count.size(); ++i) {
    if (count[i] > 0 && total > kMost / count[i]) check(NC_ENOMEM, "a block of too many values");
    total *= count[i];
  }
  std::vector<double> values(total);
  if (total > 0) check(nc_get_vara_double(id_, variable, start.data(), count.data(), values.data()), "cannot be read");
  return values;
}

}  // namespace stillhook
