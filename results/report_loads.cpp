// Weights, hook loads and their amplification beside the tabulated one, by phase; where moored vessels go.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "results/crane_chart.h"
#include "results/html.h"
#include "results/load_path.h"
#include "results/report_parts.h"
#include "sim/lifting/wire.h"
#include "sim/run_channels.h"
#include "sim/spatial/constants.h"

namespace stillhook {
namespace {

constexpr double kTonneForce = 1000.0 * kStandardGravity;

std::vector<const WireSpec*> hoist_wire_specs(const Specification& s) {
  std::vector<const WireSpec*> wires;
  for (const WireSpec& wire : s.wires)
    if (wire.role == WireSpec::Role::hoist) wires.push_back(&wire);
  return wires;
}

const BodySpec* load_of(const Specification& s) {
  for (const BodySpec& body : s.bodies)
    if (body.name == s.operation.load) return &body;
  return nullptr;
}

/// What the hoist wires carry together in one phase, N.
struct PhaseLoad {
  double static_start = 0.0, static_end = 0.0;
  Peak largest, amplification;
};

PhaseLoad phase_load(const RunView& view, const std::vector<const WireSpec*>& wires, std::size_t p) {
  PhaseLoad out;
  for (const WireSpec* wire : wires) {
    out.static_start += view.static_value(p, wire_channels::tension.of(*wire));
    out.static_end += view.static_value(p + 1, wire_channels::tension.of(*wire));
  }
  std::vector<std::string> channels;
  std::vector<std::span<const double>> tensions;
  for (const WireSpec* wire : wires) {
    channels.push_back(wire_channels::tension.of(*wire));
    tensions.push_back(view.series(channels.back()));
    if (tensions.back().empty()) return out;
  }
  const RunView::Range range = view.samples(p);
  for (std::size_t i = range.first; i < range.last; ++i) {
    const double t = view.run().time[i];
    double sum = 0.0;
    for (const auto& tension : tensions) sum += tension[i];
    out.largest.take_larger(sum, t);
  }
  out.amplification = largest_amplification(view, channels, {p});
  return out;
}

/// Sum of a limit over wires that must all give it.
double sum_of(const std::vector<const WireSpec*>& wires, double WireSpec::*limit) {
  double sum = 0.0;
  for (const WireSpec* wire : wires) {
    if (!(wire->*limit > 0.0)) return kNaN;
    sum += wire->*limit;
  }
  return sum;
}

std::string tonnes(double newton) { return fixed_number(newton / kTonneForce, 1); }

std::string phase_table(const RunView& view, const std::vector<const WireSpec*>& wires) {
  const double winches = sum_of(wires, &WireSpec::tension_max), breaking = sum_of(wires, &WireSpec::breaking_load);
  const auto share = [](double load, double limit) {
    return std::isfinite(load / limit) ? fixed_number(100.0 * load / limit, 1) : std::string("–");
  };
  std::vector<std::vector<std::string>> rows;
  for (std::size_t p = 0; p < view.run().phases.size(); ++p) {
    const PhaseLoad load = phase_load(view, wires, p);
    rows.push_back({std::to_string(p + 1) + " " + escape_html(readable_name(view.run().phases[p].name)),
                    tonnes(load.static_start), tonnes(load.static_end), tonnes(load.largest.value),
                    std::isfinite(load.largest.time) ? event_time(load.largest.time) : "–",
                    fixed_number(load.amplification.value, 3), share(load.largest.value, winches),
                    share(load.largest.value, breaking)});
  }
  return html_table({"phase", "static hook load at its start, t", "at its end, t", "largest dynamic hook load, t", "at",
                     "DAF simulated", "share of the winch limits, %", "share of the breaking loads, %"},
                    rows);
}

std::string daf_table(const ReportData& data, double weight, double hook_load) {
  std::vector<std::vector<std::string>> rows;
  for (const auto& [place, name] :
       {std::pair{LiftPlace::onshore, "onshore"}, {LiftPlace::inshore, "inshore"}, {LiftPlace::offshore, "offshore"}}) {
    const double daf = tabulated_daf(place, weight / kTonneForce, hook_load / kTonneForce);
    rows.push_back({std::string("tabulated, ") + name, fixed_number(daf, 3), tonnes(hook_load), tonnes(daf * hook_load),
                    "0027/ND rev 11.2, Table 5-1"});
  }
  const double simulated = data.metrics.value("daf_total");
  rows.push_back({"<b>simulated</b>", "<b>" + fixed_number(simulated, 3) + "</b>", tonnes(hook_load),
                  "<b>" + tonnes(simulated * hook_load) + "</b>", "this run, lift-off and set-down included"});
  return html_table({"dynamic amplification factor", "DAF", "SHL, t", "DHL = DAF × SHL, t", "source"}, rows);
}

/// The largest horizontal departure of every moored vessel from where it lies in calm water.
std::string offset_table(const ReportData& data, const RunView& view) {
  std::vector<std::vector<std::string>> rows;
  for (const BodySpec& body : data.specification.bodies) {
    const bool moored = std::any_of(data.specification.moorings.begin(), data.specification.moorings.end(),
                                    [&](const MooringSpec& m) { return m.body == body.name && m.tow.empty(); }) ||
                        std::any_of(data.specification.restoring.begin(), data.specification.restoring.end(),
                                    [&](const RestoringSpec& r) { return r.body == body.name; });
    const auto x = view.series(body_channels::x.of(body)), y = view.series(body_channels::y.of(body));
    if (!moored || x.empty() || y.empty()) continue;
    Peak fore, athwart, away;
    for (std::size_t p = 0; p < view.run().phases.size(); ++p) {
      const RunView::Range range = view.samples(p);
      for (std::size_t i = range.first; i < range.last; ++i) {
        const double t = view.run().time[i];
        const double dx = x[i] - view.planned_at(p, t, body_channels::x.of(body));
        const double dy = y[i] - view.planned_at(p, t, body_channels::y.of(body));
        fore.take_larger(std::abs(dx), t);
        athwart.take_larger(std::abs(dy), t);
        away.take_larger(std::hypot(dx, dy), t);
      }
    }
    const auto cell = [](const Peak& peak) {
      return fixed_number(peak.value, 2) + (peak.valid() ? " at " + event_time(peak.time) : "");
    };
    rows.push_back({escape_html(readable_name(body.name)), cell(fore), cell(athwart), cell(away)});
  }
  if (rows.empty()) return {};
  return "<h3>Mooring offsets</h3>" + html_table({"vessel", "along x, m", "along y, m", "together, m"}, rows) +
         "<p><small>From the position in calm water at the same moment of the operation. Tensions of the lines are "
         "under Metrics.</small></p>";
}

/// The lift's path over the capacity curve of each crane that has one.
std::string curve_figures(const ReportData& data, const RunView& view) {
  std::string out;
  for (const std::string& crane : cranes_with_curves(data.specification)) {
    const std::string drawing = draw_crane_curve(view, crane);
    if (drawing.empty()) continue;
    out += fmt::format(
        "<figure><div class=\"scroll\" tabindex=\"0\">{}</div><figcaption>The hook load of {} at its radius, through "
        "the whole lift, under what its curve allows; circled: the largest use, {} %.</figcaption></figure>",
        drawing, escape_html(readable_name(crane)),
        fixed_number(100.0 * data.metrics.value("crane_utilisation_max." + crane), 1));
  }
  return out.empty() ? out : "<h3>Capacity over radius</h3>" + out;
}

}  // namespace

double tabulated_daf(LiftPlace place, double weight, double static_hook_load) {
  struct Row {
    double up_to, onshore, inshore, offshore;
  };
  static constexpr Row kRows[] = {{300.0, 1.05, 1.12, 1.25},
                                  {1000.0, 1.05, 1.10, 1.20},
                                  {2500.0, 1.03, 1.08, 1.15},
                                  {std::numeric_limits<double>::infinity(), 1.03, 1.05, 1.10}};
  if (!(weight >= 3.0) || !(static_hook_load > 0.0)) return kNaN;
  if (weight <= 100.0) {
    const double root = std::sqrt(100.0 / static_hook_load);
    return place == LiftPlace::onshore ? 1.10 : place == LiftPlace::inshore ? 1.07 + 0.05 * root : 1.0 + 0.25 * root;
  }
  const Row& row = *std::find_if(std::begin(kRows), std::end(kRows), [&](const Row& r) { return weight <= r.up_to; });
  return place == LiftPlace::onshore ? row.onshore : place == LiftPlace::inshore ? row.inshore : row.offshore;
}

std::string loads_part(const ReportData& data, const RunView& view) {
  const std::vector<const WireSpec*> wires = hoist_wire_specs(data.specification);
  const BodySpec* load = load_of(data.specification);
  std::string out;
  if (load && !wires.empty() && !data.trajectory.static_poses.empty()) {
    double hook_load = 0.0;
    for (std::size_t p = 0; p < view.run().phases.size(); ++p) {
      if (view.run().phases[p].stage != PhaseSpec::Stage::hanging) continue;
      const PhaseLoad at = phase_load(view, wires, p);
      hook_load = std::max({hook_load, at.static_start, at.static_end});
    }
    const double weight = load->mass * kStandardGravity;
    out += fmt::format(
        "<p>Gross weight W of the load {} t (the mass in the case; no contingency is added: 0027/ND asks for 1.03 on a "
        "weighed weight, 1.05 on class A, 1.10 on class B and C). Static hook load SHL {} t, the largest of the "
        "hanging "
        "phases in calm water. Winch limits of the falls together {} t, breaking loads {} t. {}</p>",
        tonnes(weight), tonnes(hook_load), tonnes(sum_of(wires, &WireSpec::tension_max)),
        tonnes(sum_of(wires, &WireSpec::breaking_load)),
        data.specification.crane_curves.empty()
            ? "The case gives no capacity curve of the crane; compare the dynamic hook load with it at the radius of "
              "each phase."
            : "");
    out += daf_table(data, weight, hook_load) + "<h3>By phase</h3>" + phase_table(view, wires);
  }
  return out + curve_figures(data, view) + offset_table(data, view);
}

}  // namespace stillhook
