// Measured runs in NetCDF: gaps and packed numbers by its conventions, and files that must be refused.
#include <netcdf.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>

#include "problems/case.h"
#include "tests/tuning/measured_file.h"
#include "tuning/measured_table.h"
#include "tuning/record.h"

namespace stillhook {
namespace {

using Catch::Matchers::Contains;

/// A file of one dimension, written with NetCDF itself.
class NetcdfWriter {
 public:
  explicit NetcdfWriter(const std::string& path, std::size_t rows, int format = NC_NETCDF4) {
    REQUIRE(nc_create(path.c_str(), NC_CLOBBER | format, &id_) == NC_NOERR);
    REQUIRE(nc_def_dim(id_, "sample", rows, &dimension_) == NC_NOERR);
  }
  ~NetcdfWriter() { nc_close(id_); }

  int variable(const char* name, nc_type type, const std::vector<double>& values,
               const std::function<void(int, int)>& describe = {}) {
    int variable = -1;
    nc_redef(id_);
    REQUIRE(nc_def_var(id_, name, type, 1, &dimension_, &variable) == NC_NOERR);
    if (describe) describe(id_, variable);
    nc_enddef(id_);
    if (!values.empty()) REQUIRE(nc_put_var_double(id_, variable, values.data()) == NC_NOERR);
    return variable;
  }
  int id() const { return id_; }

 private:
  int id_ = -1, dimension_ = -1;
};

void number(int file, int variable, const char* name, nc_type type, double value) {
  REQUIRE(nc_put_att_double(file, variable, name, type, 1, &value) == NC_NOERR);
}

void text(int file, int variable, const char* name, const std::string& value) {
  REQUIRE(nc_put_att_text(file, variable, name, value.size(), value.c_str()) == NC_NOERR);
}

std::string fault_of(const std::string& path, const std::vector<std::string>& names) {
  try {
    read_measured_table(path, names);
  } catch (const CaseError& error) {
    return error.what();
  }
  return "no complaint";
}

TEST_CASE("a gap is what the variable says: fill value, missing value, range, default", "[netcdf]") {
  const TemporaryFolder folder;
  const std::string path = folder / "gaps.nc";
  const int format = GENERATE(NC_NETCDF4, NC_64BIT_OFFSET, 0);  // 0: classic, "CDF\1"
  {
    NetcdfWriter file(path, 4, format);
    file.variable("t", NC_DOUBLE, {0.0, 1.0, 2.0, 3.0}, [](int f, int v) { text(f, v, "units", "s"); });
    file.variable("fill", NC_DOUBLE, {1.0, -9999.0, 3.0, 4.0},
                  [](int f, int v) { number(f, v, "_FillValue", NC_DOUBLE, -9999.0); });
    file.variable("single", NC_FLOAT, {1.0, 1e20, 3.0, 4.0},
                  [](int f, int v) { number(f, v, "_FillValue", NC_FLOAT, 1e20); });
    file.variable("missing", NC_DOUBLE, {1.0, -1.0, 3.0, 4.0},
                  [](int f, int v) { number(f, v, "missing_value", NC_DOUBLE, -1.0); });
    file.variable("ranged", NC_DOUBLE, {1.0, 500.0, 3.0, 4.0}, [](int f, int v) {
      number(f, v, "valid_min", NC_DOUBLE, -10.0);
      number(f, v, "valid_max", NC_DOUBLE, 10.0);
    });
    // A tenth of a millimetre by the unit, 5 m off zero; NetCDF's own fill value of the type where nothing was written.
    file.variable("packed", NC_SHORT, {0.0, -32767.0, 100.0, -50.0}, [](int f, int v) {
      number(f, v, "scale_factor", NC_DOUBLE, 0.1);
      number(f, v, "add_offset", NC_DOUBLE, 5.0);
    });
    file.variable("unwritten", NC_DOUBLE, {});
  }
  const MeasuredTable table =
      read_measured_table(path, {"t", "fill", "single", "missing", "ranged", "packed", "unwritten"});
  CHECK(table.units[0] == "s");
  CHECK(table.values[0] == std::vector<double>{0.0, 1.0, 2.0, 3.0});
  for (const std::size_t k : {1u, 2u, 3u, 4u}) {
    CAPTURE(table.names[k]);
    CHECK(std::isnan(table.values[k][1]));
    CHECK(table.values[k][0] == 1.0);
    CHECK(table.values[k][3] == 4.0);
  }
  CHECK(std::isnan(table.values[5][1]));
  CHECK(table.values[5][2] == Approx(15.0));  // 100 x 0.1 + 5
  CHECK(table.values[5][3] == Approx(0.0).margin(1e-12));
  for (const double value : table.values[6]) CHECK(std::isnan(value));
}

TEST_CASE("variables are found by their channel, as in history.nc", "[netcdf]") {
  const TemporaryFolder folder;
  const std::string path = folder / "channels.nc";
  {
    NetcdfWriter file(path, 2);
    file.variable("time", NC_DOUBLE, {0.0, 1.0});
    file.variable("ship_roll", NC_DOUBLE, {0.5, 0.25}, [](int f, int v) { text(f, v, "channel", "ship.roll"); });
  }
  CHECK(read_measured_table(path, {"time", "ship.roll"}).values[1] == std::vector<double>{0.5, 0.25});
  CHECK(read_measured_table(path, {"time", "ship_roll"}).values[1] == std::vector<double>{0.5, 0.25});
  CHECK_THAT(fault_of(path, {"time", "ship.rol"}),
             Contains("has no variable \"ship.rol\", did you mean \"ship.roll\"?"));
}

TEST_CASE("variables that are no column are refused", "[netcdf]") {
  const TemporaryFolder folder;
  const std::string path = folder / "shapes.nc";
  {
    NetcdfWriter file(path, 3);
    file.variable("t", NC_DOUBLE, {0.0, 1.0, 2.0});
    int other = -1, both[2] = {0, 0}, variable = -1;
    nc_redef(file.id());
    REQUIRE(nc_def_dim(file.id(), "other", 2, &other) == NC_NOERR);
    both[1] = other;
    REQUIRE(nc_def_var(file.id(), "matrix", NC_DOUBLE, 2, both, &variable) == NC_NOERR);
    REQUIRE(nc_def_var(file.id(), "short_one", NC_DOUBLE, 1, &other, &variable) == NC_NOERR);
    REQUIRE(nc_def_var(file.id(), "letters", NC_CHAR, 1, both, &variable) == NC_NOERR);
    REQUIRE(nc_def_var(file.id(), "scalar", NC_DOUBLE, 0, nullptr, &variable) == NC_NOERR);
  }
  CHECK_THAT(fault_of(path, {"t", "matrix"}), Contains("variable \"matrix\" must have one dimension longer than 1, has 2"));
  CHECK_THAT(fault_of(path, {"t", "scalar"}), Contains("variable \"scalar\" must have one dimension, has 0"));
  CHECK_THAT(fault_of(path, {"t", "short_one"}), Contains("\"short_one\" has 2 values, \"t\" 3"));
  CHECK_THAT(fault_of(path, {"t", "letters"}), Contains("shapes.nc: variable letters"));
}

TEST_CASE("what a file says of its units must be what the case says", "[netcdf][record]") {
  const TemporaryFolder folder;
  const std::vector<Channel> channels = {{"ship.roll", "rad", ""}};
  FitRecordSpec spec;
  spec.name = "decay";
  spec.file = folder / "units.nc";
  spec.time_column = "t";
  FitColumnSpec column;
  column.channel = "ship.roll", column.column = "roll", column.unit = "deg";
  spec.columns = {column};
  const auto complaint = [&](const std::string& time_unit, const std::string& unit) -> std::string {
    {
      NetcdfWriter file(spec.file, 60);
      std::vector<double> t, roll;
      for (int i = 0; i < 60; ++i) t.push_back(0.25 * i), roll.push_back(0.05 * std::cos(0.25 * i));
      file.variable("t", NC_DOUBLE, t, [&](int f, int v) { text(f, v, "units", time_unit); });
      file.variable("roll", NC_DOUBLE, roll, [&](int f, int v) { text(f, v, "units", unit); });
    }
    try {
      read_record(spec, channels, 0.2);
    } catch (const CaseError& error) {
      return error.what();
    }
    return "no complaint";
  };
  CHECK(complaint("s", "deg") == "no complaint");
  CHECK(complaint("seconds since 2024-05-01 00:00:00", "degree_of_something") == "no complaint");
  CHECK_THAT(complaint("s", "rad"),
             Contains("variable \"roll\" is in rad by its attribute units") && Contains("says deg"));
  CHECK_THAT(complaint("minutes since 2024-05-01", "deg"),
             Contains("variable \"t\" is in \"minutes since") && Contains("time_unit"));
}

TEST_CASE("no damage to a file ends the program", "[netcdf]") {
  const TemporaryFolder folder;
  const std::string good = folder / "good.nc", bad = folder / "bad.nc";
  {
    NetcdfWriter file(good, 50);
    std::vector<double> t, z;
    for (int i = 0; i < 50; ++i) t.push_back(0.1 * i), z.push_back(std::cos(0.1 * i));
    file.variable("t", NC_DOUBLE, t);
    file.variable("z", NC_DOUBLE, z, [](int f, int v) { text(f, v, "units", "m"); });
  }
  std::string bytes;
  {
    std::ifstream in(good, std::ios::binary);
    bytes.assign(std::istreambuf_iterator<char>(in), {});
  }
  const auto reads = [&](const std::string& changed) {
    std::filesystem::remove(bad);
    std::ofstream(bad, std::ios::binary) << changed;
    try {
      return read_measured_table(bad, {"t", "z"}).rows() > 0;
    } catch (const CaseError& error) {
      CHECK_THAT(error.what(), Contains("bad.nc"));
      return false;
    }
  };
  REQUIRE(reads(bytes));
  int refused = 0;
  // Every part of the bookkeeping is hit, an eighth of its bytes; each is read in a child process, for 20 ms.
  for (std::size_t at = 0; at < bytes.size(); at += 122) {
    std::string changed = bytes;
    for (std::size_t i = at; i < std::min(at + 16, bytes.size()); ++i) changed[i] = static_cast<char>(~changed[i]);
    refused += !reads(changed);
  }
  CHECK(refused > 0);
  CHECK_FALSE(reads(bytes.substr(0, bytes.size() / 2)));
}

}  // namespace
}  // namespace stillhook
