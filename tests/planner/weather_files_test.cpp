// Readers of weather files: what they take, and what they tell of files that must be refused.
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <numbers>

#include "planner/weather/limit_file.h"
#include "planner/weather/record_file.h"
#include "planner/weather/scatter_file.h"
#include "problems/case.h"
#include "results/netcdf_file.h"
#include "tests/planner/program.h"

namespace stillhook {
namespace {

using Catch::Contains;

const std::string kWeather = std::string(STILLHOOK_SOURCE_DIR) + "/problems/weather/";

std::string written(const Folder& folder, const std::string& name, const std::string& text) {
  std::ofstream(folder / name, std::ios::binary) << text;
  return folder / name;
}

template <class F>
std::string fault_of(F read) {
  try {
    read();
  } catch (const Error& error) {
    return error.what();
  }
  return "taken";
}

TEST_CASE("limits that cannot be are refused with line, column and remedy", "[weather][bad_input]") {
  const Folder folder;
  const auto fault = [&](const std::string& text) {
    return fault_of([&] { read_limit_file(written(folder, "l.csv", text)); });
  };
  CHECK_THAT(fault("tp [s],hs_limit [m]\n6,1.5\n8,-1\n"),
             Contains("l.csv:3: column \"hs_limit [m]\": must be a height from 0 to 30 m, got \"-1\""));
  CHECK_THAT(fault("tp [s],hs_limit [m]\n0,1.5\n"),
             Contains("l.csv:2: column \"tp [s]\": must be a peak period above 0 and up to 60 s"));
  CHECK_THAT(fault("heading [deg],hs_limit [m]\n400,1.5\n"), Contains("an angle from -360 to 360 deg"));
  CHECK_THAT(fault("tp [s],hs_limit [m]\n6,x\n"), Contains("l.csv:2: column \"hs_limit [m]\": is no number: \"x\""));
  CHECK_THAT(fault("tp [s],hs_limit [km]\n6,1\n"), Contains("the unit must be one of m, cm, ft, got \"km\""));
  CHECK_THAT(fault("tp [s],hs [m]\n6,1\n"), Contains("has no column \"hs_limit [m]\""));
  CHECK_THAT(fault("tp [s],hs_limit [m],hs_lim [m]\n6,1,1\n"), Contains("has two columns that may be meant"));
  CHECK_THAT(fault("tp [s],heading [deg],hs_limit [m]\n6,0,1\n6,90,1\n8,0,1\n"),
             Contains("has no limit for tp 8 s, heading 90 deg"));
  CHECK_THAT(fault("tp [s],hs_limit [m]\n6,1\n6,2\n"), Contains("l.csv:3: tp 6 s stands in line 2 already"));
  CHECK_THAT(fault("tp [s],heading [rad],hs_limit [m]\n6,0,1\n6,6.283185307,1\n"),
             Contains("stands in line 2 already"));
  CHECK_THAT(fault("tp [s],hs_limit [m]\n"), Contains("has no limits under its names"));
  CHECK_THAT(fault("tp [s],phase,hs_limit [m]\n6,a,1\n6,b,1\n8,a,1\n"), Contains("tp 8 s of phase \"b\""));
  CHECK(fault("tp [s];heading [deg];hs_limit [m]\n6;0;1,5\n6;90;1,2\n") == "taken");
}

TEST_CASE("limits by phase, with bounds, and what must be known of them", "[weather]") {
  const Folder folder;
  const LimitFile two = read_limit_file(
      written(folder, "l.csv",
              "tp [s],phase,hs_limit [m],hs_low [m],hs_high [m]\n6,a,1,0.9,1.1\n6,b,2,1.9,\n6,all,0.9,0.8,1.1\n"));
  REQUIRE(two.limits.phases.size() == 3);
  CHECK(two.limits.phases[1].phase == "b");
  CHECK(two.limits.phases[2].phase.empty());
  // The whole operation is broken where any phase is: its limit is the lowest, and its bounds are those that count.
  CHECK(two.limits.at(6.0, 0.0) == 0.9);
  REQUIRE(two.low);
  CHECK(two.low->at(6.0, 0.0) == 0.8);
  REQUIRE(two.high);
  CHECK(two.high->at(6.0, 0.0) == 1.1);
  CHECK_FALSE(read_limit_file(written(folder, "p.csv", "tp [s],phase,hs_limit [m],hs_high [m]\n6,a,1,1.1\n6,b,2,\n")).high);
  // One row a condition: the phase only says where the limit was reached.
  CHECK(read_limit_file(kWeather + "limits.csv").limits.phases.size() == 1);
  const LimitFile few = read_limit_file(written(folder, "f.csv", "heading [deg],hs_limit [m]\n90,1\n180,2\n"));
  CHECK_THAT(few.remarks.at(0), Contains("no limit for 270 deg of heading from 180 deg on"));
  CHECK_THAT(read_limit_file(written(folder, "e.csv", "tp [s],hs_limit [m]\n6,1\n8,\n")).remarks.at(0),
             Contains("1 of the limits are empty"));
}

TEST_CASE("records that cannot be are refused with line, column and remedy", "[weather][bad_input]") {
  const Folder folder;
  const auto fault = [&](const std::string& text, const WeatherSpec& spec = {}) {
    return fault_of([&] { read_record_file(written(folder, "r.csv", text), spec); });
  };
  const std::string head = "time,hs [m],tp [s],wave_from [deg]\n";
  CHECK_THAT(fault(head + "2019-01-01,1,8,0\n2019-01-01T03:00Z,-999,8,0\n"),
             Contains("r.csv:3: column \"hs [m]\": must be a height from 0 to 30 m; leave the cell empty where there "
                      "is none, got -999"));
  CHECK_THAT(fault(head + "yesterday,1,8,0\n"),
             Contains("r.csv:2: column \"time\": must be a time as 2019-01-01T03:00Z, got \"yesterday\""));
  CHECK_THAT(fault(head + "2019-01-01,1,8,0\n2019-01-01,1,8,0\n"),
             Contains("must be later than 2019-01-01T00:00Z in the row before"));
  CHECK_THAT(fault(head + "2019-01-01,1,8,0\n2019-01-01T03:00Z,1,8,0\n2019-01-01T07:00Z,1,8,0\n"),
             Contains("r.csv:4") && Contains("equal steps"));
  CHECK_THAT(fault(head + "2019-01-01,1,8,0\n"), Contains("two at least are needed"));
  CHECK_THAT(fault(head + "0001-01-01,1,8,0\n0001-01-01T00:00:01Z,1,8,0\n9999-01-01,1,8,0\n"),
             Contains("is a time wrong?"));
  CHECK_THAT(fault("time,hs [m],dir\n2019-01-01,1,5\n2019-01-02,1,5\n"),
             Contains("weather.direction_sense = \"from\" or \"towards\""));
  CHECK_THAT(fault("time,hs,hm0\n2019-01-01,1,5\n"),
             Contains("two columns that may be meant, \"hs\" and \"hm0\"; say which with weather.height_column"));
  CHECK_THAT(fault("time,height\n2019-01-01,1\n"), Contains("no column of significant wave heights by a usual name"));
  WeatherSpec spec;
  spec.height_column = "heigth";
  CHECK_THAT(fault("time,height\n2019-01-01,1\n", spec),
             Contains("has no column \"heigth\", did you mean \"height\"?, which weather.height_column names"));
  spec = {};
  spec.period_column = "t";
  CHECK_THAT(fault("time,hs [m],t [s]\n2019-01-01,1,5\n", spec), Contains("weather.period_kind"));
  std::string radians = "time,hs [m],wave_from\n";
  for (int i = 0; i < 60; ++i)
    radians +=
        "2019-01-01T00:" + std::string(i < 10 ? "0" : "") + std::to_string(i) + "Z,1," + std::to_string(0.1 * i) + "\n";
  CHECK_THAT(fault(radians), Contains("are they radians?"));
}

TEST_CASE("a record says what its columns were taken for, and its gaps are samples without values", "[weather]") {
  const Folder folder;
  WeatherSpec spec;
  spec.gamma = 1.0;
  const WeatherRecord r =
      read_record_file(written(folder, "r.csv",
                               "time;hs (cm);tz (s);wave_to (rad);wind (kn)\n2019-01-01 00:00;150;5;0;10\n2019-01-01 "
                               "03:00;;5,5;1;\n2019-01-01 09:00;100;5;1;10\n"),
                       spec);
  CHECK(r.size() == 4);
  CHECK(r.gaps == 1);
  CHECK(r.height[0] == Approx(1.5));
  CHECK(std::isnan(r.height[1]));
  CHECK(std::isnan(r.height[2]));
  CHECK(r.period[0] == Approx(5.0 * 1.407716).epsilon(1e-5));
  CHECK(r.from[0] == Approx(std::numbers::pi));
  CHECK(r.wind[0] == Approx(5.1444).epsilon(1e-4));
  CHECK_THAT(r.remarks[1], Contains("mean zero-crossing period") && Contains("1.4077"));
  CHECK_THAT(r.remarks[2], Contains("travel towards") && Contains("turned by 180 deg"));
}

TEST_CASE("a hindcast of one place as NetCDF, with its own names and time unit", "[weather]") {
  const Folder folder;
  const std::string path = folder / "era.nc";
  {
    NetcdfFile file(path, NetcdfFile::Mode::create, path);
    const int time = file.define_dimension("time", 3), one = file.define_dimension("latitude", 1);
    const auto add = [&](const char* name, const char* units, const std::vector<int>& over,
                         const std::vector<double>& values) {
      file.put(file.define(name, NC_DOUBLE, over, name, units), values);
    };
    add("time", "hours since 1900-01-01 00:00:00.0", {time}, {1043136.0, 1043139.0, 1043142.0});  // 2019-01-01T00:00Z
    add("swh", "m", {time, one}, {1.0, 2.0, 1.5});
    add("pp1d", "s", {time, one}, {8.0, 9.0, 8.5});
    add("mwd", "degrees", {time, one}, {270.0, 280.0, 290.0});
    file.close();
  }
  const WeatherRecord r = read_record_file(path, {});
  CHECK(instant_text(r.start) == "2019-01-01T00:00Z");
  CHECK(r.step_h() == 3.0);
  CHECK(r.height == std::vector<double>{1.0, 2.0, 1.5});
  CHECK(r.from[0] == Approx(1.5 * std::numbers::pi));
}

TEST_CASE("scatter tables and alpha factors that cannot be are refused", "[weather][bad_input]") {
  const Folder folder;
  const auto scatter = [&](const std::string& text) {
    return fault_of([&] { read_scatter_file(written(folder, "s.csv", text)); });
  };
  CHECK_THAT(scatter("hs_low [m],hs_high [m],tp_low [s],tp_high [s],count\n1,0.5,5,6,3\n"),
             Contains("s.csv:2: column \"hs_high [m]\": must be above the bin's lower height, got \"0.5\""));
  CHECK_THAT(scatter("month,hs_low [m],hs_high [m],tp_low [s],tp_high [s],count\n13,0,0.5,5,6,3\n"),
             Contains("a month from 1 to 12"));
  CHECK_THAT(scatter("hs,4-5,five\n0-1,3,4\n"), Contains("column 3: must be a range of peak periods in s"));
  CHECK_THAT(scatter("hs,4-5\n0-1,-3\n"), Contains("must be a count of 0 or more"));
  CHECK_THAT(scatter("hs,4-5\n0-1,0\n"), Contains("has no counts"));
  const auto alpha = [&](const std::string& text) {
    return fault_of([&] { read_alpha_file(written(folder, "a.csv", text)); });
  };
  CHECK_THAT(alpha("t_pop_at_most [h],hs [m],alpha\n12,1,1.2\n"), Contains("a factor above 0 and up to 1"));
  CHECK_THAT(alpha("t_pop_at_most [h],hs [m],alpha\n12,1,0.7\n12,1,0.8\n"),
             Contains("two alpha factors for 12 h and 1 m"));
  CHECK_THAT(alpha("t_pop_at_most,hs [m],alpha\n12,1,0.7\n"), Contains("has no unit"));
  const AlphaTable read = read_alpha_file(kWeather + "alpha.csv");  // the shipped file is the built-in table
  const AlphaTable built_in;
  REQUIRE(read.rows().size() == built_in.rows().size());
  for (std::size_t i = 0; i < read.rows().size(); ++i) {
    CHECK(read.rows()[i].planned_at_most_h == built_in.rows()[i].planned_at_most_h);
    CHECK(read.rows()[i].height == built_in.rows()[i].height);
    CHECK(read.rows()[i].factor == built_in.rows()[i].factor);
  }
}

}  // namespace
}  // namespace stillhook
