// What databases lack or leave unsaid: the added mass at infinite frequency, the depth of the water, what their first
// column is, which of their frequencies are sound; and that they are read once.
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <thread>

#include "sim/hull/coefficients/database_source.h"
#include "sim/hull/coefficients/wamit_file.h"
#include "sim/hull/felt_depth.h"
#include "sim/hull/radiation/infinite_frequency.h"
#include "tests/sim/coefficient_sets.h"
#include "tests/sim/temporary_folder.h"

namespace stillhook {
namespace {

using Catch::Contains;

/// The crane vessel's set with a table dense enough for retardation functions.
HydrodynamicCoefficients dense_set() {
  HydrodynamicCoefficients c = crane_set();
  std::vector<double> frequencies;
  for (int n = 1; n <= 60; ++n) frequencies.push_back(0.05 * n);
  c.frequency = sampled(c, frequencies);
  return c;
}

void write_set(const std::string& base, const HydrodynamicCoefficients& c,
               WamitUnits::Column column = WamitUnits::Column::period) {
  WamitUnits u;
  u.density = c.density;
  u.gravity = c.gravity;
  u.column = column;
  DatabaseFrame f;
  f.length = c.length;
  f.bodies = {{Vector3(0.0, 0.0, -c.waterline), c.volume[0]}};
  write_wamit(base, c, u, f);
}

/// The vessel of the set, afloat at its draft, with that file.
struct Vessel {
  Mesh mesh = box_mesh(Vector3(110.0, 46.0, 8.0), Vector3::Zero(), 6.0);  // draft 4 m: the water at z = 0
  BodySpec body;
  SeaSpec sea;
  HullAfloat hull;

  explicit Vessel(const std::string& file) {
    const HydrodynamicCoefficients c = crane_set();
    body.name = "crane";
    body.cog = Vector3(0.0, 0.0, 3.0);
    body.hydrodynamics.kind = HydrodynamicsSpec::Kind::database;
    body.hydrodynamics.coefficient_file = file;
    sea.density = c.density;
    sea.gravity = c.gravity;
    hull = {&body, &mesh, 0.0, 0.0, 0.0, 0.0};
  }
  std::string refusal() const {
    std::vector<std::string> warnings;
    try {
      coefficient_set({&hull, 1}, sea, {}, warnings);
    } catch (const SpecificationError& error) {
      return error.what();
    }
    return "accepted";
  }
};

}  // namespace

TEST_CASE("added mass at infinite frequency follows from A and B at others", "[database]") {
  // K(t) = c (1 - a t) exp(-a t), whose transforms are elementary:
  //   B = 2 a c w^2 / (a^2 + w^2)^2,   A = A_inf - c (w^2 - a^2) / (a^2 + w^2)^2.
  const double a = 1.2, c = 900.0, A_inf = 700.0, coupling = 0.4;
  std::vector<FrequencyCoefficients> table;
  for (int n = 1; n <= 160; ++n) {
    const double w = 0.05 * n, square = std::pow(a * a + w * w, 2);
    FrequencyCoefficients f{w, MatrixX::Zero(2, 2), MatrixX::Zero(2, 2)};
    const double A = A_inf - c * (w * w - a * a) / square, B = 2.0 * a * c * w * w / square;
    f.A << A, coupling * A, coupling * A, 2.0 * A;
    f.B << B, coupling * B, coupling * B, 2.0 * B;
    table.push_back(f);
  }
  // B falls as w^-2 here, slower than a hull's: what lies beyond 8 rad/s, continued as w^-3, is 0.1 % of c.
  const MatrixX found = infinite_added_mass(table);
  CHECK(found(0, 0) == Approx(A_inf).epsilon(0.005));
  CHECK(found(1, 0) == Approx(coupling * A_inf).epsilon(0.005));
  CHECK(found(1, 1) == Approx(2.0 * A_inf).epsilon(0.005));
}

TEST_CASE("WAMIT files without infinite frequency are read, and it is said", "[database]") {
  const TemporaryFolder folder;
  const HydrodynamicCoefficients c = dense_set();
  write_set(folder / "set", c);
  std::ifstream in(folder / "set.1");
  std::string line, kept;
  int left_out = 0;
  while (std::getline(in, line)) {
    std::istringstream words(line);
    double period = 1.0;
    if (words >> period && period == 0.0)
      ++left_out;
    else
      kept += line + "\n";
  }
  REQUIRE(left_out > 0);
  folder.write("set.1", kept);
  const Vessel vessel(folder / "set.1");
  const auto set = file_set(vessel.hull, vessel.sea);
  // The band ends at 3 rad/s with B falling: what its continuation leaves open is a few per cent of A_inf.
  CHECK(difference(c.A_inf, set->A_inf) < 0.04);
  REQUIRE_FALSE(set->remarks.empty());
  CHECK_THAT(set->remarks[0], Contains("no added mass at infinite frequency"));
  CHECK(vessel.refusal() == "accepted");
}

TEST_CASE("the depth of the water shows in the longest waves", "[database]") {
  // One heave force of 1 MN/m in waves of k h = 0.5, 0.7 ... and the damping that Haskind's relation gives it there,
  // with the dispersion relation solved the other way round: w from k.
  HydrodynamicCoefficients c;
  c.density = 1025.0;
  c.gravity = 9.81;
  c.length = 30.0;
  c.volume = {1000.0};
  const double depth = 60.0;
  const auto add = [&](double k, double h) {
    const double w = std::sqrt(9.81 * k * std::tanh(k * h));
    const double group = 0.5 * w / k * (1.0 + 2.0 * k * h / std::sinh(2.0 * k * h));
    FrequencyCoefficients f{w, MatrixX::Zero(6, 6), MatrixX::Zero(6, 6)};
    f.B(2, 2) = k * 1e12 / (4.0 * 1025.0 * 9.81 * group);
    c.frequency.push_back(f);
    c.excitation.frequencies.push_back(w);
    for (int i = 0; i < 6; ++i) c.excitation.value.push_back(i == 2 ? Complex(0.6e6, -0.8e6) : 0.0);
  };
  c.excitation.headings = {0.0};
  for (const double kh : {0.5, 0.7, 0.9}) add(kh / depth, depth);
  const std::optional<double> found = felt_depth(c);
  REQUIRE(found);
  CHECK(*found == Approx(depth).epsilon(1e-6));  // both relations are exact
  c.frequency.clear();
  c.excitation.frequencies.clear();
  c.excitation.value.clear();
  for (const double k : {0.01, 0.015, 0.02}) add(k, 2000.0);  // deep
  CHECK_FALSE(felt_depth(c));
}

TEST_CASE("a coefficient file is read once, and again when it has changed", "[database]") {
  const TemporaryFolder folder;
  HydrodynamicCoefficients c = dense_set();
  write_set(folder / "set", c);
  const Vessel vessel(folder / "set.1");
  const auto first = file_set(vessel.hull, vessel.sea);
  std::vector<std::shared_ptr<const HydrodynamicCoefficients>> seen(4);
  std::vector<std::thread> threads;
  for (auto& set : seen) threads.emplace_back([&] { set = file_set(vessel.hull, vessel.sea); });
  for (std::thread& thread : threads) thread.join();
  for (const auto& set : seen) CHECK(set == first);
  // Asked for otherwise, it is another set.
  Vessel cut(folder / "set.1");
  cut.body.hydrodynamics.database_highest = 2.0;
  CHECK(file_set(cut.hull, cut.sea)->frequency.size() < first->frequency.size());
  CHECK(file_set(vessel.hull, vessel.sea) == first);
  // Of the same size, written later: other numbers.
  c.A_inf *= 1.25;
  write_set(folder / "set", c);
  std::filesystem::last_write_time(folder / "set.1",
                                   std::filesystem::last_write_time(folder / "set.1") + std::chrono::seconds(2));
  CHECK(file_set(vessel.hull, vessel.sea)->A_inf(2, 2) == Approx(1.25 * first->A_inf(2, 2)));
}

TEST_CASE("frequencies that cannot be trusted are named with the keys that leave them out", "[database]") {
  const TemporaryFolder folder;
  HydrodynamicCoefficients c = dense_set();
  write_set(folder / "sound", c);
  CHECK(Vessel(folder / "sound.1").refusal() == "accepted");
  // Above 2.2 rad/s, as at irregular frequencies, heave and pitch lose their reciprocity.
  for (FrequencyCoefficients& f : c.frequency)
    if (f.frequency > 2.2) f.A(2, 4) += 0.3 * std::sqrt(f.A(2, 2) * f.A(4, 4));
  write_set(folder / "set", c);
  Vessel vessel(folder / "set.1");
  CHECK_THAT(
      vessel.refusal(),
      Contains("(symmetry)") && Contains("without its other frequencies it passes: database_highest_rad_per_s = 2.2"));
  vessel.body.hydrodynamics.database_highest = 2.225;
  CHECK(vessel.refusal() == "accepted");
}

TEST_CASE("a first column read as the wrong quantity is found out", "[database]") {
  const TemporaryFolder folder;
  write_set(folder / "set", dense_set(), WamitUnits::Column::frequency);
  Vessel vessel(folder / "set.1");
  CHECK_THAT(vessel.refusal(), Contains("with database_first_column = \"frequency\" they pass"));
  vessel.body.hydrodynamics.database_in_frequency = true;
  CHECK(vessel.refusal() == "accepted");
}

TEST_CASE("a body that floats at another draft than its database is warned of", "[database]") {
  const TemporaryFolder folder;
  write_set(folder / "set", dense_set());
  Vessel vessel(folder / "set.1");
  const auto set = file_set(vessel.hull, vessel.sea);
  CHECK(draft_difference(*set, vessel.hull).empty());
  vessel.hull.waterline = 0.05;  // 1.25 % of the volume
  CHECK(draft_difference(*set, vessel.hull).empty());
  vessel.hull.waterline = 0.4;
  CHECK_THAT(draft_difference(*set, vessel.hull),
             Contains("hold for a displaced volume of 20240 m3, with the still water at z = 0 m") &&
                 Contains("'crane' floats with 22264 m3, the water at z = 0.4 m"));
  // The set itself does not depend on it.
  CHECK(file_set(vessel.hull, vessel.sea) == set);
  vessel.body.hydrodynamics.database_origin = Vector3(0.0, 0.0, 30.0);
  CHECK_THROWS_WITH(file_set(vessel.hull, vessel.sea), Contains("nothing below the still water of the database"));
}

}  // namespace stillhook
