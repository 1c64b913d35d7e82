// Measured files: what is read of them, and what is said about bad ones.
#include "tuning/record.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <ctime>
#include <functional>

#include "problems/case.h"
#include "sim/recorder.h"
#include "tests/tuning/measured_file.h"
#include "tuning/measured_table.h"
#include "tuning/measured_unit.h"

namespace stillhook {
namespace {

using Catch::Matchers::Contains;
constexpr double kDegree = 3.14159265358979323846 / 180.0;

const std::vector<Channel>& channels() {
  static const std::vector<Channel> all = {
      {"ship.roll", "rad", ""}, {"ship.z", "m", ""}, {"ship.wx", "rad/s", ""}, {"line.tension", "N", ""}};
  return all;
}

FitRecordSpec roll_in_degrees(const std::string& file) {
  FitRecordSpec spec;
  spec.name = "decay";
  spec.file = file;
  FitColumnSpec column;
  column.channel = "ship.roll";
  column.column = "roll";
  column.unit = "deg";
  spec.columns = {column};
  return spec;
}

std::string complaint(const FitRecordSpec& spec) {
  try {
    read_record(spec, channels(), 0.2);
  } catch (const CaseError& error) {
    return error.what();
  }
  return "no complaint";
}

double roll_at(double t) { return 5.0 * std::exp(-0.01 * t) * std::cos(t); }

TEST_CASE("a record comes out in SI, on its own clock, with its sign", "[record]") {
  const TemporaryFolder folder;
  FitRecordSpec spec = roll_in_degrees(folder.write("a.csv", csv_of("roll", 40.0, 0.25, roll_at)));
  spec.columns[0].reversed = true;
  spec.columns[0].offset = 1.0;
  spec.start = 10.0;
  const MeasuredRecord r = read_record(spec, channels(), 0.2);
  REQUIRE(r.time.size() == 121);  // 10 to 40 s every 0.25 s
  CHECK(r.time.front() == 0.0);   // a decay begins with its window
  CHECK(r.time.back() == Approx(30.0));
  CHECK(r.interval == Approx(0.25));  // rows as they are: they are not denser than the interval wanted
  for (const std::size_t i : {0u, 50u, 120u})
    CHECK(r.channels[0].value[i] == Approx(-(roll_at(10.0 + 0.25 * static_cast<double>(i)) - 1.0) * kDegree).margin(1e-12));
}

TEST_CASE("the position of a joint's drive can be measured in degrees", "[record][unit]") {
  Specification s;
  s.sea.active = "calm";
  s.sea.states = {SeaStateSpec{}};
  s.sea.states[0].name = "calm";
  s.solver.static_start = false;
  BodySpec boom;
  boom.name = "boom";
  boom.mass = 1e5;
  boom.inertia = 1e6 * Matrix3::Identity();
  s.bodies = {boom};
  JointSpec ring;
  ring.name = "ring";
  ring.parent = "world";
  ring.child = "boom";
  ring.stiffness = 1e9;
  ring.drive = "slew";
  s.joints = {ring};
  s.drives = {{"slew", DriveSpec::Kind::joint, 0.0, 0.0}};
  const Model model = build_model(s);
  const TemporaryFolder folder;
  FitRecordSpec spec = roll_in_degrees(folder.write("a.csv", csv_of("roll", 40.0, 0.25, roll_at)));
  spec.columns[0].channel = "slew.position";
  const MeasuredRecord r = read_record(spec, ChannelBoard(model).channels(), 0.2);
  CHECK(r.channels[0].unit == "rad");
  CHECK(r.channels[0].value[0] == Approx(5.0 * kDegree));
}

TEST_CASE("model scale is Froude's", "[record]") {
  const TemporaryFolder folder;
  std::string text = "t_s,z,f\n";
  for (int i = 0; i < 100; ++i) text += fmt::format("{},{},{}\n", 0.1 * i, std::sin(0.5 * i), 2.0 + std::cos(0.5 * i));
  FitRecordSpec spec = roll_in_degrees(folder.write("m.csv", text));
  spec.model_scale = 25.0;
  FitColumnSpec z, f;
  z.channel = "ship.z", z.column = "z", z.unit = "mm";
  f.channel = "line.tension", f.column = "f", f.unit = "N";
  spec.columns = {z, f};
  const MeasuredRecord r = read_record(spec, channels(), 0.2);
  CHECK(r.time[7] == Approx(0.7 * 5.0));                                      // time by the root of the scale
  CHECK(r.channels[0].value[7] == Approx(1e-3 * 25.0 * std::sin(3.5)));       // length by the scale
  CHECK(r.channels[1].value[7] == Approx(15625.0 * (2.0 + std::cos(3.5))));  // force by its cube
}

TEST_CASE("a dense record is reduced without loss of amplitude", "[record]") {
  const TemporaryFolder folder;
  Noise noise(1);
  FitRecordSpec spec = roll_in_degrees(
      folder.write("d.csv", csv_of("roll", 60.0, 0.01, [&](double t) { return std::sin(2.0 * t) + 0.1 * noise(); })));
  spec.interval = 0.4;
  const MeasuredRecord r = read_record(spec, channels(), 0.2);
  double square = 0.0, with = 0.0, of = 0.0;
  for (std::size_t i = 2; i + 2 < r.time.size(); ++i) {
    const double truth = std::sin(2.0 * r.time[i]), got = r.channels[0].value[i] / kDegree;
    square += (got - truth) * (got - truth);
    with += got * truth;
    of += truth * truth;
  }
  // A parabola over 41 rows leaves 9/4 of the variance of a mean over them: 0.1 sqrt(2.25/41) = 0.023.
  CHECK(std::sqrt(square / static_cast<double>(r.time.size() - 4)) < 0.03);
  // Its error in a sine is of fourth order, (w half)^4/280 = 1e-4; a mean would lose (w half)^2/6 = 2.7 %.
  CHECK(with / of == Approx(1.0).margin(0.006));  // and 3 standard errors of the noise: 3 x 0.023 sqrt(2/147)
}

TEST_CASE("spikes are marked, gaps stay gaps", "[record]") {
  const TemporaryFolder folder;
  Noise noise(2);
  int row = 0;
  FitRecordSpec spec = roll_in_degrees(folder.write("s.csv", csv_of("roll", 50.0, 0.25, [&](double t) {
    ++row;
    if (row % 60 == 30) return 40.0;  // three spikes
    return row > 100 && row <= 110 ? std::nan("") : roll_at(t) + 0.02 * noise();
  })));
  const MeasuredRecord r = read_record(spec, channels(), 0.2);
  CHECK(r.channels[0].outliers == 3);
  CHECK(r.channels[0].missing == 10);
  CHECK(r.notes.size() == 2);
  int left_out = 0;
  for (const double v : r.channels[0].value) left_out += std::isnan(v);
  CHECK(left_out == 13);
}

TEST_CASE("a smooth signal has no spikes", "[record]") {
  for (const double step : {0.05, 0.3, 1.0}) {  // rad between rows
    std::vector<double> x;
    for (int i = 0; i < 500; ++i) x.push_back(std::exp(-0.005 * i) * std::sin(step * i));
    for (const bool spike : spikes(x)) CHECK_FALSE(spike);
  }
}

TEST_CASE("semicolons with decimal commas, tabs, blanks, units under the names, missing cells", "[record][csv]") {
  const TemporaryFolder folder;
  const auto read = [&](const std::string& text) {
    return read_measured_table(folder.write("x.csv", text), {"t", "b"});
  };
  CHECK(read("# a comment\nt;a;b\n0,5;1;2,25\n").values == std::vector<std::vector<double>>{{0.5}, {2.25}});
  CHECK(read("t\ta\tb\r\n1\t2\t-3e-1\r\n").values == std::vector<std::vector<double>>{{1.0}, {-0.3}});
  CHECK(read("t  a b\n 1   2 3\n").values == std::vector<std::vector<double>>{{1.0}, {3.0}});
  CHECK(read("t,a,b\ns,m,deg\n1,2,3\n").values == std::vector<std::vector<double>>{{1.0}, {3.0}});
  const MeasuredTable missing = read("t,a,b\n1,2,NaN\n2,2,\n3,2,+4\n");
  CHECK(std::isnan(missing.values[1][0]));
  CHECK(std::isnan(missing.values[1][1]));
  CHECK(missing.values[1][2] == 4.0);
  CHECK(missing.place(2).ends_with("x.csv:4"));
}

TEST_CASE("a million rows are read, in a time that grows with the rows and not with their square", "[record]") {
  const TemporaryFolder folder;
  const auto seconds = [&](int rows) {
    std::string text = "t_s,a,b,roll\n";
    for (int i = 0; i < rows; ++i) text += fmt::format("{:.3f},1.5,2.5,{:.5f}\n", 0.01 * i, std::sin(0.01 * i));
    const FitRecordSpec spec = roll_in_degrees(folder.write("long.csv", text));
    const std::clock_t begin = std::clock();  // processor time: the machine may be busy with other things
    const MeasuredRecord r = read_record(spec, channels(), 0.2);
    const double took = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    CHECK(r.rows == static_cast<std::size_t>(rows));
    CHECK(r.time.size() == static_cast<std::size_t>(rows / 20));
    return took;
  };
  // Against this build's own pace, since one with sanitizers takes more than forty times as long: ten times the rows take ten times the
  // time, a hundred times with a quadratic algorithm. The geometric mean of the two is what neither comes near.
  const double tenth = std::max(seconds(100000), seconds(100000));
  CHECK(seconds(1000000) < 32.0 * tenth);
}

TEST_CASE("every bad record is told its sentence", "[record][bad_input]") {
  const TemporaryFolder folder;
  const auto with = [&](const std::string& text) { return roll_in_degrees(folder.write("bad.csv", text)); };
  SECTION("clock") {
    std::string text = csv_of("roll", 20.0, 0.25, roll_at);
    text += "19.5,1.0\n";
    CHECK_THAT(complaint(with(text)), Contains("bad.csv:83: the clock runs backwards, from 20 s to 19.5 s"));
    CHECK_THAT(complaint(with(csv_of("roll", 20.0, 0.25, roll_at) + "20,1.0\n")), Contains("the clock stands still at 20 s"));
  }
  SECTION("constant channel") {
    CHECK_THAT(complaint(with(csv_of("roll", 20.0, 0.25, [](double) { return 1.5; }))),
               Contains("column \"roll\" is constant, 1.5 deg in all 81 rows: the sensor did not work"));
  }
  SECTION("NaN") {
    CHECK_THAT(complaint(with(csv_of("roll", 20.0, 0.25, [](double t) { return t < 15.0 ? std::nan("") : roll_at(t); }))),
               Contains("bad.csv:2: column \"roll\" is NaN or empty in 60 of 81 rows"));
  }
  SECTION("three rows") {
    CHECK_THAT(complaint(with("t_s,roll\n0,1\n1,2\n2,3\n")), Contains("has 3 rows, a fit needs at least 20"));
  }
  SECTION("a channel that the model has not") {
    FitRecordSpec spec = with(csv_of("roll", 20.0, 0.25, roll_at));
    spec.columns[0].channel = "ship.rol";
    CHECK_THAT(complaint(spec), Contains("the model has no channel \"ship.rol\", did you mean \"ship.roll\"?"));
  }
  SECTION("a unit of another quantity, an unknown unit") {
    FitRecordSpec spec = with(csv_of("roll", 20.0, 0.25, roll_at));
    spec.columns[0].unit = "m";
    CHECK_THAT(complaint(spec), Contains("the channel is in rad, the file's unit m is another quantity"));
    spec.columns[0].unit = "furlong";
    CHECK_THAT(complaint(spec), Contains("unit \"furlong\" is not known; there are m, mm"));
  }
  SECTION("degrees taken for radians") {
    FitRecordSpec spec = with(csv_of("roll", 20.0, 0.25, roll_at));
    spec.columns[0].unit = "rad";
    CHECK_THAT(complaint(spec), Contains("a factor 57.3 too large, as degrees taken for radians"));
  }
  SECTION("columns and cells") {
    FitRecordSpec spec = with(csv_of("rol", 20.0, 0.25, roll_at));
    CHECK_THAT(complaint(spec), Contains("has no column \"roll\", did you mean \"rol\"?"));
    CHECK_THAT(complaint(with("t_s,roll\n0,1\n1,bad\n")), Contains("bad.csv:3: column \"roll\": is no number: \"bad\""));
    CHECK_THAT(complaint(with("t_s,roll\n0,1\n1\n")), Contains("bad.csv:3: has 1 cells, the names say 2"));
    CHECK_THAT(complaint(with("0,1\n1,2\n")), Contains("numbers begin at once"));
    CHECK_THAT(complaint(with("")), Contains("has no line with the names"));
    CHECK_THAT(complaint(with("t_s,roll\n0,1\n,2\n")), Contains("bad.csv:3: the time \"t_s\" is missing"));
    spec.file = folder / "not_there.csv";
    CHECK_THAT(complaint(spec), Contains("cannot be read"));
    spec.file.clear();
    CHECK_THAT(complaint(spec), Contains("has no file; give one in the case or with --measured"));
  }
}

TEST_CASE("a number that stands for nothing measured is no measurement", "[record][csv]") {
  const TemporaryFolder folder;
  const auto complain = [&](const std::function<double(int)>& value, FitRecordSpec::Kind kind = FitRecordSpec::Kind::decay) {
    int row = 0;
    FitRecordSpec spec = roll_in_degrees(
        folder.write("s.csv", csv_of("roll", 50.0, 0.25, [&](double t) {
                       const double instead = value(row++);
                       return instead != 0.0 ? instead : roll_at(t);
                     })));
    spec.kind = kind;
    return complaint(spec);
  };
  const auto every_ninth = [](double value) { return [value](int row) { return row % 9 == 4 ? value : 0.0; }; };
  for (const double value : {-9999.0, -999.0, 9999.0, 99999.0, -999.25, 1e20, 32767.0, -99.0}) {
    CAPTURE(value);
    CHECK_THAT(complain(every_ninth(value)),
               Contains(fmt::format("s.csv:6: column \"roll\" is {:.10g}, far from all its other values, in 22 rows", value)));
    CHECK_THAT(complain(every_ninth(value), FitRecordSpec::Kind::constant), Contains("nothing was measured"));
  }
  CHECK_THAT(complain([](int row) { return row == 0 ? -9999.0 : 0.0; }), Contains("s.csv:2") && Contains("in this row alone"));
  CHECK(complain(every_ninth(4.0)) == "no complaint");  // a number as any other
  // The clock has such rows, too.
  std::string text = "t_s,roll\n-9999,5\n";
  for (int i = 1; i < 60; ++i) text += fmt::format("{:.6g},{:.12g}\n", 0.25 * i, roll_at(0.25 * i));
  CHECK_THAT(complaint(roll_in_degrees(folder.write("clock.csv", text))), Contains("clock.csv:2: column \"t_s\" is -9999"));
}

TEST_CASE("999 is a force like any other among its like", "[record]") {
  const TemporaryFolder folder;
  FitRecordSpec spec = roll_in_degrees(
      folder.write("f.csv", csv_of("f", 50.0, 0.25, [](double t) { return t == 5.0 ? 999.0 : 1000.0 + 50.0 * std::sin(t); })));
  spec.columns[0].channel = "line.tension", spec.columns[0].column = "f", spec.columns[0].unit = "N";
  CHECK(complaint(spec) == "no complaint");
}

TEST_CASE("mistakes of units are recognised", "[record][unit]") {
  CHECK_THAT(mistaken_unit(55.0, "rad"), Contains("57.3 too large, as degrees taken for radians"));
  CHECK_THAT(mistaken_unit(1.0 / 60.0, "rad/s"), Contains("57.3 too small, as radians taken for degrees"));
  CHECK_THAT(mistaken_unit(900.0, "N"), Contains("1e+03 too large, as newtons taken for kilonewtons"));
  CHECK(mistaken_unit(3.0, "rad").empty());
}

}  // namespace
}  // namespace stillhook
