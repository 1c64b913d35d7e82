// The self-checks that compare the excitation with the rest of a set.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "sim/hull/coefficients/coefficient_file.h"
#include "sim/hull/coefficients/coefficients.h"
#include "sim/specification.h"

namespace stillhook {
namespace {

HydrodynamicCoefficients crane() {
  HydrodynamicCoefficients c = read_coefficient_file(STILLHOOK_SOURCE_DIR "/problems/hulls/crane_110x46x4.csv");
  c.waterplane = {110.0 * 46.0};
  return c;
}

const SelfCheck& check_named(const std::vector<SelfCheck>& checks, const std::string& key) {
  for (const SelfCheck& check : checks)
    if (check.key == key) return check;
  throw std::logic_error("no check " + key);
}

/// Moments of X about a point at `shift` from Bo, as if the code that made it had used that reference.
void move_reference(ExcitationTable& X, const Vector3& shift) {
  for (int f = 0; f < static_cast<int>(X.frequencies.size()); ++f)
    for (int h = 0; h < static_cast<int>(X.headings.size()); ++h) {
      const Eigen::Vector3cd F(X.at(f, h, 0), X.at(f, h, 1), X.at(f, h, 2));
      const Eigen::Vector3cd extra = -shift.cast<Complex>().cross(F);
      for (int i = 0; i < 3; ++i) X.at(f, h, 3 + i) += extra(i);
    }
}

/// X at each heading becomes that of the opposite one.
void reverse_headings(ExcitationTable& X) {
  const ExcitationTable old = X;
  const int headings = static_cast<int>(X.headings.size());
  for (int f = 0; f < static_cast<int>(X.frequencies.size()); ++f)
    for (int h = 0; h < headings; ++h)
      for (int i = 0; i < X.modes; ++i) X.at(f, h, i) = old.at(f, (h + headings / 2) % headings, i);
}

/// A hull that only heaves: A_33 (kg) at all frequencies, X_3 (N/m) from all headings, and B_33 of the energy of X_3.
HydrodynamicCoefficients heaving(double volume, double waterplane, double length, double A,
                                 const std::vector<std::pair<double, Complex>>& X) {
  HydrodynamicCoefficients c;
  c.source = "heave alone";
  c.density = 1025.0;
  c.gravity = 9.80665;
  c.length = length;
  c.volume = {volume};
  c.waterplane = {waterplane};
  c.A_inf = MatrixX::Zero(6, 6);
  c.A_inf(2, 2) = A;
  constexpr int kHeadings = 72;
  for (int h = 0; h < kHeadings; ++h) c.excitation.headings.push_back(2.0 * std::numbers::pi * h / kHeadings);
  for (const auto& [w, x] : X) {
    c.excitation.frequencies.push_back(w);
    for (int h = 0; h < kHeadings; ++h)
      for (int i = 0; i < 6; ++i) c.excitation.value.push_back(i == 2 ? x : 0.0);
    FrequencyCoefficients at{w, c.A_inf, MatrixX::Zero(6, 6)};
    at.B(2, 2) = std::pow(w / c.gravity, 3) / (2.0 * c.density) * std::norm(x);
    c.frequency.push_back(at);
  }
  return c;
}

void scale_all(HydrodynamicCoefficients& c, double factor) {
  c.A_inf *= factor;
  for (FrequencyCoefficients& f : c.frequency) f.A *= factor, f.B *= factor;
  for (RetardationKernel& k : c.retardation.kernels)
    for (double& v : k.value) v *= factor;
  for (Complex& x : c.excitation.value) x *= factor;
}

}  // namespace

TEST_CASE("the shipped coefficients leave the limits of the self-checks room", "[self_check]") {
  const std::vector<SelfCheck> checks = self_checks(crane());
  CHECK(checks.size() == 13);
  for (const SelfCheck& check : checks) {
    INFO(check.key << ": " << check.value << " of " << check.limit << " " << check.detail);
    CHECK(check.passed());
  }
  // What two codes' agreement (0.7 %) and eight headings leave.
  CHECK(check_named(checks, "haskind").value < 0.015);
  CHECK(check_named(checks, "long_wave_heave").value < 0.12);
  CHECK(check_named(checks, "long_wave_phase").value < 0.15);
}

TEST_CASE("an excitation that does not belong to the set is refused", "[self_check]") {
  HydrodynamicCoefficients c = crane();
  std::string failing;
  SECTION("phases of the other sign") {
    for (Complex& x : c.excitation.value) x = std::conj(x);
    failing = "long_wave_phase";
  }
  SECTION("headings the waves come from") {
    reverse_headings(c.excitation);
    failing = "long_wave_phase";
  }
  SECTION("both of these at once, which the horizontal forces alone do not show") {
    for (Complex& x : c.excitation.value) x = std::conj(x);
    reverse_headings(c.excitation);
    failing = "long_wave_phase";
  }
  SECTION("an excitation for another density, 5 % off") {
    for (Complex& x : c.excitation.value) x *= 1.05;
    failing = "haskind";
  }
  SECTION("an excitation in kN") {
    for (Complex& x : c.excitation.value) x *= 1e-3;
    failing = "haskind";
  }
  SECTION("moments about a point 2 m above") {
    move_reference(c.excitation, {0.0, 0.0, 2.0});
    failing = "haskind";
  }
  SECTION("moments about a point 3 m ahead") {
    move_reference(c.excitation, {3.0, 0.0, 0.0});
    failing = "haskind";
  }
  SECTION("moments about a point 3 m to port") {
    move_reference(c.excitation, {0.0, 3.0, 0.0});
    failing = "haskind";
  }
  SECTION("moments per degree") {
    for (std::size_t n = 0; n < c.excitation.value.size(); ++n)
      if (n % 6 > 2) c.excitation.value[n] *= std::numbers::pi / 180.0;
    failing = "haskind";
  }
  SECTION("everything in tonnes and kN") {
    scale_all(c, 1e-3);
    failing = "displaced_mass";
    CHECK_FALSE(check_named(self_checks(c), "haskind").passed());
  }
  SECTION("tables about a point 2 m above, retardation functions not") {
    for (FrequencyCoefficients& f : c.frequency) {
      f.A = about_point(f.A, {0.0, 0.0, 2.0});
      f.B = about_point(f.B, {0.0, 0.0, 2.0});
    }
    failing = "kramers_kronig";
    CHECK_FALSE(check_named(self_checks(c), "haskind").passed());
  }
  SECTION("a water plane of half the size") {
    c.waterplane = {2530.0};
    failing = "long_wave_heave";
  }
  SECTION("an added mass that grows without limit towards long waves") {
    c.frequency[0].A *= 10.0;
    failing = "low_frequency";
  }
  const SelfCheck check = check_named(self_checks(c), failing);
  INFO(check.key << " " << check.value << " " << check.detail);
  CHECK_FALSE(check.passed());
  CHECK_THROWS_AS(require_self_checks(c), SpecificationError);
}

TEST_CASE("Haskind's relation holds without a table, by the retardation functions", "[self_check]") {
  HydrodynamicCoefficients c = crane();
  c.frequency.clear();
  const SelfCheck check = check_named(self_checks(c), "haskind");
  // K is of a coarser mesh than X: 3 % in B (coefficients_test), 3.5 % in roll.
  INFO(check.value << " " << check.detail);
  CHECK(check.value > 0.0);
  CHECK(check.passed());
}

TEST_CASE("damping of a deep hull's heave is judged by what it does to the motion", "[self_check]") {
  // A box of 90 x 90 x 40 m: the heave force goes with exp(-40 m k), so that B has all but gone at 1.63 rad/s, where the
  // panels leave 2.5e6 N s/m of their own. C = 81.4e6 N/m and m + A = 572e6 kg make that 0.3 % of the motion there.
  const double density = 1025.0, gravity = 9.80665, area = 8100.0, draft = 40.0;
  std::vector<std::pair<double, Complex>> X;
  for (double w = 0.2; w < 2.0; w *= 1.077)
    X.emplace_back(w, (density * gravity * area - w * w * 2.4e8) * std::exp(-draft * w * w / gravity));
  HydrodynamicCoefficients c = heaving(area * draft, area, 90.0, 2.4e8, X);
  double largest = 0.0;
  for (const FrequencyCoefficients& at : c.frequency) largest = std::max(largest, at.B(2, 2));
  REQUIRE(largest > 1.5e7);
  for (FrequencyCoefficients& at : c.frequency)
    if (at.frequency > 1.3) at.B(2, 2) += 2.5e6;
  CHECK(check_named(self_checks(c), "haskind").value > 0.01);
  CHECK(check_named(self_checks(c), "haskind").passed());
  // At resonance, 0.38 rad/s, the same error is an eighth of all the damping there is.
  for (FrequencyCoefficients& at : c.frequency)
    if (std::abs(at.frequency - 0.38) < 0.02) at.B(2, 2) += 2.5e6;
  CHECK_FALSE(check_named(self_checks(c), "haskind").passed());
}

TEST_CASE("an error of the added mass in heave counts less where the hull follows the waves", "[self_check]") {
  // C = rho g 5060 m2 is 1.3e9 kg times w^2 at 0.2 rad/s, eight times m + A: 10 % of A_33 move the hull by 1 % there. At 0.9
  // rad/s nothing but m + A holds it.
  for (const bool long_wave : {true, false}) {
    HydrodynamicCoefficients c = crane();
    const double w = long_wave ? 0.2 : 0.9;
    FrequencyCoefficients row{w, added_mass_from_kernels(c.A_inf, c.retardation, w),
                              damping_from_kernels(c.retardation, 6, w)};
    row.A(2, 2) *= 1.1;
    std::erase_if(c.frequency, [&](const auto& f) { return f.frequency == w; });
    c.frequency.insert(std::upper_bound(c.frequency.begin(), c.frequency.end(), w,
                                        [](double x, const auto& f) { return x < f.frequency; }),
                       row);
    const SelfCheck check = check_named(self_checks(c), "kramers_kronig");
    INFO(w << " rad/s: " << check.value << " " << check.detail);
    CHECK(check.passed() == long_wave);
    // Without the water plane's area nobody knows.
    c.waterplane.clear();
    CHECK_FALSE(check_named(self_checks(c), "kramers_kronig").passed());
  }
}

TEST_CASE("heave force of deep hulls in long waves", "[self_check]") {
  // At 0.4 rad/s as WAMIT gives them, in files that come with OpenFAST; X_3 from all headings alike. The water's
  // acceleration pulls at what the hull displaces: of a tension-leg platform 47.9 m deep that is half of rho g A_w, of a
  // spar 120 m deep the force is against it.
  struct Truth {
    double volume, waterplane, length, A, X;
  };
  for (const Truth& t : {Truth{12179.6, 254.33, 18.0, 1440.97, 104.700}, Truth{8029.21, 33.12, 9.4, 249.83, -22.63}}) {
    const auto set = [&](double share) {
      return heaving(t.volume, share * t.waterplane, t.length, 1025.0 * t.A, {{0.4, 1025.0 * 9.80665 * t.X}});
    };
    const SelfCheck check = check_named(self_checks(set(1.0)), "long_wave_heave");
    INFO(t.volume << ": " << check.value << " " << check.detail);
    CHECK(check.passed());
  }
  const Truth platform{12179.6, 254.33, 18.0, 1440.97, 104.700};
  for (const double share : {0.5, 2.0})
    CHECK_FALSE(check_named(self_checks(heaving(platform.volume, share * platform.waterplane, platform.length,
                                                1025.0 * platform.A, {{0.4, 1025.0 * 9.80665 * platform.X}})),
                            "long_wave_heave")
                    .passed());
}

TEST_CASE("every tolerance of a self-check has a key that a refusal names", "[self_check]") {
  HydrodynamicCoefficients c = crane();
  for (Complex& x : c.excitation.value) x *= 1.05;  // 10 % more energy than B
  CHECK_THROWS_WITH(require_self_checks(c), Catch::Contains("allowed 0.08 by panel_method.haskind_tolerance"));
  SelfCheckTolerances wider;
  wider.haskind = 0.15;
  CHECK_NOTHROW(require_self_checks(c, {}, wider));
  CHECK(check_named(self_checks(c, wider), "haskind").limit == 0.15);
  // Each is in use: with a tolerance of nothing what it belongs to fails, and names it.
  const SelfCheckTolerances nothing{0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
  const std::vector<std::pair<const char*, const char*>> keys = {{"kramers_kronig", "kramers_kronig_tolerance"},
                                                                 {"kernel_tail", "kernel_tail_tolerance"},
                                                                 {"haskind", "haskind_tolerance"},
                                                                 {"long_wave_phase", "long_wave_phase_tolerance"},
                                                                 {"long_wave_heave", "long_wave_heave_tolerance"},
                                                                 {"symmetry", "symmetry_tolerance"},
                                                                 {"damping", "negative_damping_tolerance"},
                                                                 {"kernel_damping", "negative_damping_tolerance"},
                                                                 {"symmetry_infinite", "symmetry_tolerance"}};
  for (const auto& [key, tolerance] : keys) {
    INFO(key);
    CHECK(check_named(self_checks(c, nothing), key).limit == 0.0);
    CHECK(check_named(self_checks(c, nothing), key).tolerance_key == tolerance);
  }
}

TEST_CASE("a failed check is accepted by its name only", "[self_check]") {
  HydrodynamicCoefficients c = crane();
  for (Complex& x : c.excitation.value) x *= 1.05;
  CHECK_THROWS_WITH(require_self_checks(c), Catch::Contains("(haskind)"));
  CHECK_THROWS_WITH(require_self_checks(c, {"damping"}), Catch::Contains("(haskind)"));
  CHECK_NOTHROW(require_self_checks(c, {"damping", "haskind"}));
  CHECK_THROWS_WITH(require_self_checks(crane(), {"haskin"}),
                    Catch::Contains("\"haskin\"") && Catch::Contains("kramers_kronig, haskind"));
  c.A_inf(2, 2) = std::nan("");
  CHECK_THROWS_WITH(require_self_checks(c, {"finite"}), Catch::Contains("not a self-check that can be accepted"));
  for (const SelfCheck& check : self_checks(crane()))
    if (check.key != "finite")
      CHECK(std::count(acceptable_self_checks().begin(), acceptable_self_checks().end(), check.key) == 1);
}

}  // namespace stillhook
