// Capacity curves of cranes: which one counts, what it says, and how far a lift uses it, by hand.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "problems/case.h"
#include "results/crane_chart.h"
#include "results/metrics.h"
#include "results/run_view.h"
#include "results/smooth_metrics.h"
#include "sim/operation.h"
#include "sim/simulate.h"
#include "sim/spatial/constants.h"

namespace stillhook {
namespace {

using Catch::Matchers::Contains;

/// 50 t on 20 m of wire under a jib 20 m from the king post of a crane that turns on a quay; the hook swings out as the crane
/// turns. `curves` are entries of [[crane_curves]].
std::string pedestal(const std::string& curves, const std::string& sea = "") {
  return R"(name = "pedestal"
)" + sea + R"(
[[bodies]]
name = "crane"
mass_t = 150.0
gyration_m = [10.0, 10.0, 8.0]
position_m = [5.0, -3.0, 3.0]
[[bodies]]
name = "load"
mass_t = 50.0
gyration_m = [1.0, 1.0, 1.0]
position_m = [25.0, -3.0, 10.0]
[[drives]]
name = "slew"
kind = "joint"
speed_max_deg_per_s = 3.0
[[joints]]
name = "ring"
type = "revolute"
parent = "world"
child = "crane"
point_on_parent_m = [5.0, -3.0, 3.0]
axis = [0.0, 0.0, 1.0]
angular_stiffness_kN_m_per_rad = 1.0e7
angular_damping_kN_m_s_per_rad = 1.0e6
drive = "slew"
[[wires]]
name = "fall"
role = "hoist"
from = "crane"
to = "load"
point_from_m = [20.0, 0.0, 27.0]
axial_stiffness_kN = 1.0e7
damping_ratio = 0.01
damping_mass_t = 50.0
slack_m = 0.0
)" + curves + R"(
[operation]
load = "load"
[[operation.phases]]
name = "wait"
duration_s = 10.0
[[operation.phases]]
name = "turn"
moves = [{ drive = "slew", speed_deg_per_s = 3.0, ramp_s = 2.0, travel_deg = 60.0 }]
)";
}

const std::string kCalm = R"(
[[crane_curves]]
name = "harbour"
crane = "crane"
radius_m = [10.0, 20.0, 30.0]
capacity_t = [200.0, 100.0, 60.0]
up_to_significant_height_m = 0.5
)";
const std::string kRough = R"(
[[crane_curves]]
name = "offshore"
crane = "crane"
radius_m = [10.0, 20.0, 30.0]
capacity_t = [120.0, 60.0, 20.0]
up_to_significant_height_m = 2.0
)";

Case case_of(const std::string& text) { return read_case_text(text, "pedestal.toml", "."); }

std::string refusal(const std::string& text) {
  try {
    case_of(text);
  } catch (const CaseError& error) {
    return error.what();
  }
  return "";
}

Trajectory run_of(const Case& c) {
  const Model model = build_model(c.specification);
  return simulate(model, build_operation(model));
}

std::string replaced(std::string text, const std::string& what, const std::string& with) {
  const std::size_t at = text.find(what);
  REQUIRE(at != std::string::npos);
  return text.replace(at, what.size(), with);
}

const std::string kSea = R"(
[sea]
active = "sea"
[[sea.states]]
name = "sea"
type = "jonswap"
significant_height_m = 1.5
peak_period_s = 7.0
heading_deg = 0.0
)";

}  // namespace

TEST_CASE("capacity is linear between the points of a curve and ends with them", "[crane_curve]") {
  const Case c = case_of(pedestal(kCalm));
  const CraneCurveSpec& curve = c.specification.crane_curves.at(0);
  const double tonne = 1e3 * kStandardGravity;
  CHECK(capacity_at(curve, 10.0) == Approx(200.0 * tonne));
  CHECK(capacity_at(curve, 15.0) == Approx(150.0 * tonne));
  CHECK(capacity_at(curve, 27.5) == Approx(70.0 * tonne));
  CHECK(capacity_at(curve, 30.0) == Approx(60.0 * tonne));
  CHECK(std::isnan(capacity_at(curve, 9.99)));
  CHECK(std::isnan(capacity_at(curve, 30.01)));
  CHECK(nearest_capacity(curve, 40.0) == Approx(60.0 * tonne));
}

TEST_CASE("the curve of the lowest sea that holds counts", "[crane_curve]") {
  const auto name = [](const Case& c) { return curve_of(c.specification, "crane")->name; };
  CHECK(name(case_of(pedestal(kCalm + kRough))) == "harbour");
  CHECK(name(case_of(pedestal(kRough + kCalm))) == "harbour");
  CHECK(name(case_of(pedestal(kRough + kCalm, kSea))) == "offshore");
  CHECK(curve_sea_height(case_of(pedestal("", kSea)).specification) == Approx(1.5).epsilon(1e-6));
  // The height of a sea from a file is that in the file.
  const std::string file = "[sea]\nactive = \"hindcast\"\n[[sea.states]]\nname = \"hindcast\"\ntype = \"spectrum\"\nspectrum_file = "
                           "\"era5_like_spectrum.nc\"\ntime = \"2026-11-30T06:00\"\nbearing_of_x_deg = 300.0\nscale_to_height_m = ";
  const std::string folder = STILLHOOK_SOURCE_DIR "/docs/examples";
  CHECK(name(read_case_text(pedestal(kRough + kCalm, file + "1.9\n"), "pedestal.toml", folder)) == "offshore");
  CHECK_THROWS_WITH(read_case_text(pedestal(kRough + kCalm, file + "2.1\n"), "pedestal.toml", folder),
                    Contains("[crane_curves.offshore] up_to_significant_height_m: is 2, but the active sea \"hindcast\" has "
                             "a height of 2.1 m"));
  // No curve is stretched to a sea that it was not made for.
  CHECK_THAT(refusal(pedestal(kCalm, kSea)), Contains("[crane_curves.harbour] up_to_significant_height_m: is 0.5") &&
                                                 Contains("\"sea\" has a height of 1.5 m"));
  CHECK(refusal(pedestal(replaced(kCalm, "up_to_significant_height_m = 0.5", ""), kSea)).empty());
}

TEST_CASE("a load at rest uses its weight over the capacity at its radius, one that swings out more", "[crane_curve]") {
  const Case c = case_of(pedestal(kCalm));
  const Trajectory run = run_of(c);
  const Metrics metrics = compute_metrics(c.specification, run);
  REQUIRE(metrics.status == RunStatus::completed);
  const Metric* use = metrics.find("crane_utilisation_max.crane");
  REQUIRE(use);
  // At rest: 50 of 100 t at 20 m. Turning swings the load out, where a metre more of radius takes 4 t of capacity; the hook is
  // the load's own centre here.
  const RunView view(c.specification, run);
  const auto x = view.series("load.x"), y = view.series("load.y"), tension = view.series("fall.tension");
  double largest = 0.0, farthest = 0.0;
  for (std::size_t i = view.samples(1).first; i < view.samples(1).last; ++i) {
    const double radius = std::hypot(x[i] - 5.0, y[i] + 3.0);
    const double capacity = radius < 20.0 ? 100.0 + 10.0 * (20.0 - radius) : 100.0 - 4.0 * (radius - 20.0);
    largest = std::max(largest, tension[i] / (1e3 * 9.80665) / capacity);
    farthest = std::max(farthest, radius);
  }
  CHECK(farthest > 20.1);  // w^2 r/g of 20 m of wire are 0.11 m already
  REQUIRE(use->by_phase.size() == 2);
  CHECK(use->by_phase[0].value == Approx(0.5).epsilon(1e-4));
  CHECK(use->by_phase[1].value == Approx(largest).epsilon(1e-9));
  CHECK(metrics.value("crane_utilisation_max") == use->value);
  // The maker who has taken amplification off bounds the load at rest: only the radius counts then.
  const Case at_rest = case_of(pedestal(replaced(kCalm, "crane = \"crane\"", "crane = \"crane\"\nbasis = \"static\"")));
  const Metrics still = compute_metrics(at_rest.specification, run);
  CHECK(still.value("crane_utilisation_max") == Approx(50.0 / (100.0 - 4.0 * (farthest - 20.0))).epsilon(1e-4));
  // From the channels that a gradient keeps, the same number.
  Trajectory kept = run;
  for (std::size_t k = kept.channels.size(); k-- > 0;) {
    const std::vector<std::string> names = channels_of_metric(c.specification, "crane_utilisation_max.crane");
    if (std::find(names.begin(), names.end(), kept.channels[k].name) != names.end()) continue;
    kept.channels.erase(kept.channels.begin() + static_cast<std::ptrdiff_t>(k));
    kept.values.erase(kept.values.begin() + static_cast<std::ptrdiff_t>(k));
    for (auto& phase : kept.extremes) phase.erase(phase.begin() + static_cast<std::ptrdiff_t>(k));
  }
  CHECK(compute_metrics(c.specification, kept).value("crane_utilisation_max.crane") == use->value);
  // Drawn in the report.
  CHECK_THAT(draw_crane_curve(view, "crane"), Contains("harbour, up to 0.5 m") && Contains("the lift, dynamic"));
  CHECK(draw_crane_curve(view, "load").empty());
}

TEST_CASE("a crane outside its curve fails the run", "[crane_curve]") {
  const Case c = case_of(pedestal(replaced(kCalm, "radius_m = [10.0, 20.0, 30.0]", "radius_m = [5.0, 10.0, 15.0]")));
  const Metrics metrics = compute_metrics(c.specification, run_of(c));
  CHECK(metrics.status == RunStatus::failed);
  CHECK_THAT(metrics.message, Contains("crane carries 50 t at a radius of 20.0 m at 0.0 s in wait, outside its capacity "
                                       "curve harbour of 5.0 to 15.0 m"));
  // In a sea that comes with a scenario and that no curve is for.
  Case rough = case_of(pedestal(kCalm));
  rough.specification.sea.active = "wild";
  SeaStateSpec wild;
  wild.name = "wild";
  wild.type = SeaStateSpec::Type::regular;
  wild.amplitude = 1.0;
  wild.frequency = 0.7;
  rough.specification.sea.states = {wild};
  const Metrics unfit = compute_metrics(rough.specification, run_of(rough));
  CHECK(unfit.status == RunStatus::failed);
  CHECK_THAT(unfit.message, Contains("crane has no capacity curve for a sea of 2.00 m"));
}

TEST_CASE("curves that cannot be are refused", "[crane_curve]") {
  const auto with = [](const std::string& what, const std::string& by) { return refusal(pedestal(replaced(kCalm, what, by))); };
  CHECK_THAT(with("[10.0, 20.0, 30.0]", "[10.0, 30.0, 20.0]"), Contains("[crane_curves.harbour] radius_m: must ascend"));
  CHECK_THAT(with("[200.0, 100.0, 60.0]", "[200.0, 100.0]"), Contains("capacity_t: has 2 numbers, radius_m 3"));
  CHECK_THAT(with("crane = \"crane\"", "crane = \"load\""), Contains("\"load\" holds no hoist wire") &&
                                                                Contains("a curve can be of \"crane\""));
  CHECK_THAT(with("crane = \"crane\"", "crane = \"cran\""), Contains("did you mean \"crane\""));
  CHECK_THAT(refusal(pedestal(kCalm + replaced(kCalm, "harbour", "again"))), Contains("is that of \"harbour\" as well"));
}

}  // namespace stillhook
