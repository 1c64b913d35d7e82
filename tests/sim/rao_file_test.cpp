// Files of displacement RAOs: WAMIT's, one side for both, what does not cover the sea, what is not right.
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "sim/hull/rao_motion.h"
#include "tests/sim/rao_sample.h"
#include "tests/sim/temporary_folder.h"

using namespace stillhook;
using namespace stillhook::rao_sample;

TEST_CASE("WAMIT's .4 says what the same RAOs in columns say", "[rao]") {
  const TemporaryFolder folder;
  const double ulen = 75.0;
  const double period = 9.0, w = kTwoPi / period;
  // A second body's modes 7 to 12 come first.
  std::string wamit, csv = header("period_s", "_rad_per_m");
  const std::array<double, 6> mod = {0.5, 0.25, 0.8, 3.0, 1.5, 0.75}, lead = {80, -70, -10, 150, -95, 20};
  const auto line = [&](int mode, double size, double phase) {
    std::ostringstream out;
    out.precision(10);
    out << period << "  135  " << mode << "  " << size << "  " << phase << "  " << size * std::cos(phase * kDegree)
        << "  " << size * std::sin(phase * kDegree) << "\n";
    return out.str();
  };
  csv += "9,135";
  for (int i = 0; i < 6; ++i) {
    const auto n = static_cast<std::size_t>(i);
    wamit += line(i + 7, 0.1, 0.0);
    wamit += line(i + 1, mod[n], lead[n]);
    std::ostringstream out;
    out.precision(15);
    out << "," << mod[n] / (i < 3 ? 1.0 : ulen) << "," << lead[n];
    csv += out.str();
  }
  RaoSpec columns;
  columns.phase = RaoSpec::Phase::lead;
  columns.reference = Vector3(5.0, 0.0, -1.0);
  columns.phase_x = -30.0;
  RaoSpec file = columns;
  columns.file = folder.write("rao.csv", csv + "\n");
  file.phase = RaoSpec::Phase::lag;  // has no meaning for the format
  file.format = RaoSpec::Format::wamit;
  file.length = ulen;
  file.body = 1;
  file.file = folder.write("vessel.4", wamit);
  const RaoTable a = read_rao_table(vessel(columns), kG), b = read_rao_table(vessel(file), kG);
  REQUIRE(b.values.size() == 1);
  CHECK(b.headings.front() == Approx(a.headings.front()).epsilon(1e-12));
  CHECK(b.frequencies.front() == Approx(w).epsilon(1e-12));
  for (std::size_t i = 0; i < 6; ++i) CHECK(std::abs(a.values[0][i] - b.values[0][i]) < 1e-9);
  file.body = 0;
  CHECK_THAT(refusal([&] { read_rao_table(vessel(file), kG); }),
             Catch::Contains("2 bodies") && Catch::Contains("wamit_body"));
  file.body = 1;
  file.file = folder.write("short.4", line(1, 0.5, 80.0));
  CHECK_THAT(refusal([&] { read_rao_table(vessel(file), kG); }), Catch::Contains("not all six modes"));
}

TEST_CASE("headings of one side stand for the other", "[rao]") {
  const TemporaryFolder folder;
  RaoSpec spec;
  std::string text = header();
  for (const double heading : {0.0, 45.0, 90.0, 135.0, 180.0}) {
    const double b = heading * kDegree;
    std::ostringstream line;
    line << "10," << heading << ",0.5,90," << 0.6 * std::sin(b) + 1e-13 << ",90,1,0," << 2.0 * std::sin(b) + 1e-13
         << ",-90,1,90," << 0.5 * std::sin(2.0 * b) * std::sin(2.0 * b) << ",0\n";
    text += line.str();
  }
  spec.file = folder.write("rao.csv", text);
  spec.port_starboard = true;
  const RaoTable table = read_rao_table(vessel(spec), kG);
  CHECK(table.headings.size() == 8);
  const double w = kTwoPi / 10.0;
  for (const double b : {45.0, 90.0, 135.0}) {
    const Raos port = table.between(w, b * kDegree), starboard = table.between(w, -b * kDegree);
    for (std::size_t i = 0; i < 6; ++i) CHECK(std::abs(starboard[i] - (i % 2 == 1 ? -1.0 : 1.0) * port[i]) < 1e-12);
  }
  // Half way between two rows the complex numbers are the mean of theirs.
  const Raos middle = table.between(w, 22.5 * kDegree), a = table.between(w, 0.0), b = table.between(w, 45.0 * kDegree);
  for (std::size_t i = 0; i < 6; ++i) CHECK(std::abs(middle[i] - 0.5 * (a[i] + b[i])) < 1e-12);
}

TEST_CASE("an RAO table that does not cover the sea is refused with the remedy", "[rao]") {
  const TemporaryFolder folder;
  const Truth truth;
  RaoSpec spec;
  spec.file = folder.write("rao.csv", table_text(truth, spec, {0.4, 0.7, 1.1}));
  const auto in = [&](double w, double towards, RaoSpec::Beyond beyond = RaoSpec::Beyond::refuse) {
    BodySpec body = vessel(spec);
    body.attitude = {};
    body.hydrodynamics.rao.beyond = beyond;
    std::vector<std::string> notes;
    RaoMotion motion(body, read_rao_table(body, kG), regular_wave(1.0, w, towards), notes);
    return notes;
  };
  CHECK(in(0.5, 0.2).empty());
  CHECK_THAT(refusal([&] { in(0.3, 0.2); }), Catch::Contains("longer periods"));
  CHECK_THAT(refusal([&] { in(0.3, 0.2, RaoSpec::Beyond::cut); }), Catch::Contains("longer periods"));
  CHECK_THAT(refusal([&] { in(1.3, 0.2); }), Catch::Contains("beyond = \"cut\""));
  REQUIRE(in(1.3, 0.2, RaoSpec::Beyond::cut).size() == 1);
  CHECK_THAT(in(1.3, 0.2, RaoSpec::Beyond::cut).front(), Catch::Contains("100 %"));
  spec.file = folder.write("one.csv", header() + row(truth, spec, 0.5, 0.0) + row(truth, spec, 0.5, 90.0 * kDegree));
  CHECK(in(0.5, 0.0).empty());
  CHECK_THAT(refusal([&] { in(0.5, 45.0 * kDegree); }), Catch::Contains("45 deg") && Catch::Contains("port_starboard"));
  spec.file = folder.write("two.csv", header() + row(truth, spec, 0.5, 0.0) + row(truth, spec, 0.5, 45.0 * kDegree));
  REQUIRE(in(0.5, 20.0 * kDegree).size() == 1);
  CHECK_THAT(in(0.5, 20.0 * kDegree).front(), Catch::Contains("45 deg apart"));
  // Without a ramp the vessel would jump.
  LiftParts lift = vessel_alone(spec);
  regular_sea(lift.spec, 1.0, 0.5, 0.7, 0.0);
  CHECK_THAT(refusal([&] { build_model(lift.spec); }), Catch::Contains("ramp"));
}

TEST_CASE("an RAO file that is not right is refused by line and rule", "[rao]") {
  const TemporaryFolder folder;
  const std::string good = "8,0,0.5,0,0,0,1,0,2,0,0,0,0,0\n";
  const auto said = [&](const std::string& text) {
    RaoSpec spec;
    spec.file = folder.write("rao.csv", text);
    return refusal([&] { read_rao_table(vessel(spec), kG); });
  };
  CHECK(said(header() + good).empty());
  CHECK_THAT(said(header() + "8,0,0.5,0,0,0,1,0,2,0,0,0,0\n"),
             Catch::Contains("rao.csv:2") && Catch::Contains("cut off"));
  CHECK_THAT(said(header() + good + good), Catch::Contains("rao.csv:3") && Catch::Contains("once more"));
  CHECK_THAT(said(header() + good + "9,0,0.5,0,0,0,1,0,2,0,0,0,0,0\n9,90,0.5,0,0,0,1,0,2,0,0,0,0,0\n"),
             Catch::Contains("same periods"));
  CHECK_THAT(said(header() + "8,0,0.5,0,0,0,1,0,x,0,0,0,0,0\n"),
             Catch::Contains("roll_deg_per_m") && Catch::Contains("\"x\""));
  CHECK_THAT(said(header() + "8,0,-0.5,0,0,0,1,0,2,0,0,0,0,0\n"),
             Catch::Contains("surge_m_per_m") && Catch::Contains(">= 0"));
  CHECK_THAT(said(header() + "8,0,0.5,0,0,0,1,0,200,0,0,0,0,0\n"), Catch::Contains("unit"));
  CHECK_THAT(said(header() + "0,0,0.5,0,0,0,1,0,2,0,0,0,0,0\n"), Catch::Contains("period_s"));
  CHECK_THAT(said("period_s,heading_deg\n8,0\n"), Catch::Contains("surge_m_per_m"));
  CHECK_THAT(said("T,heading_deg\n8,0\n"), Catch::Contains("period_s"));
  CHECK_THAT(said(header().substr(0, header().size() - 1) + ",note\n" + good), Catch::Contains("\"note\""));
  CHECK_THAT(said(header()), Catch::Contains("no rows"));
}

TEST_CASE("wrong conventions show in long waves, which every ship follows", "[rao]") {
  const TemporaryFolder folder;
  // A raft on waves of 25 s: its points go with the surface. Phases are lags of the crest.
  const double w = kTwoPi / 25.0, k = w * w / kG;
  const auto odd = [&](RaoSpec spec) {
    std::string text = header("period_s", "_rad_per_m");
    for (const double heading : {0.0, 45.0, 90.0, 135.0, 180.0}) {
      const double b = heading * kDegree, c = std::cos(b), s = std::sin(b);
      std::ostringstream line;
      line.precision(12);
      // Water that the crest passes goes forward with it, a quarter of a period later it is furthest: cos(wt - 90 deg).
      line << "25," << heading << "," << std::abs(c) << "," << (c < 0 ? -90 : 90) << "," << s << ",90,1,0," << k * s
           << ",90," << k * std::abs(c) << "," << (c < 0 ? 90 : -90) << ",0,0\n";
      text += line.str();
    }
    spec.file = folder.write("rao.csv", text);
    BodySpec body = vessel(spec);
    body.cog = Vector3::Zero();
    return odd_in_long_waves(read_rao_table(body, kG), kG);
  };
  RaoSpec right;
  CHECK(odd(right).empty());
  RaoSpec lead = right;
  lead.phase = RaoSpec::Phase::lead;
  CHECK(odd(lead).size() >= 3);
  RaoSpec bow_up = right;
  bow_up.reversed[4] = true;
  REQUIRE(odd(bow_up).size() == 1);
  CHECK_THAT(odd(bow_up).front(), Catch::Contains("pitch") && Catch::Contains("25 s"));
  RaoSpec from = right;
  from.direction = RaoSpec::Direction::from;
  CHECK(odd(from).size() >= 2);
  RaoSpec trough = right;
  trough.event = RaoSpec::Event::trough;
  CHECK_THAT(odd(trough).front(), Catch::Contains("surge"));
}
