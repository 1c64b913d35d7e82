#include "planner/verbs/hydro/hydro_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "planner/text_number.h"
#include "sim/spatial/constants.h"

namespace stillhook {
namespace {

constexpr double kNegligibleCoupling = 5e-3;
constexpr double kFarBeyond = 1e3;  // rad/s: the margin is that of infinite frequency
constexpr double kSlowest = 1e-3;   // rad/s: what is slower than 100 min has no period worth a number
constexpr int kSampled = 6;          // frequencies of the table of pairs
constexpr int kExcitationRows = 14;  // frequencies of the table of X

int rotations(int i, int j) { return (i % 6 >= 3) + (j % 6 >= 3); }

std::string number(double value, double factor) { return std::isfinite(value) ? short_number(value / factor) : "-"; }

/// Evenly chosen indices of n entries.
std::vector<int> spread(int n, int wanted) {
  std::vector<int> chosen;
  const int count = std::min(n, wanted);
  for (int k = 0; k < count; ++k) chosen.push_back(count == 1 ? 0 : k * (n - 1) / (count - 1));
  return chosen;
}

/// The period of a frequency, s; "-" at zero and next to it.
std::string period_text(double frequency) {
  return frequency > kSlowest ? cell(2.0 * std::numbers::pi / frequency, 1) : "-";
}

/// "31.4 to 3.1 s" of a band in rad/s.
std::string periods_text(double lowest, double highest) {
  return lowest > 0.0 ? fmt::format("{} to {} s", period_text(lowest), period_text(highest))
                      : fmt::format("from {} s", period_text(highest));
}

ReportTable diagonal_table(const HydroSet& set, int hull, bool added_mass) {
  const HydrodynamicCoefficients& c = *set.set;
  ReportTable table;
  table.title = fmt::format("{} of {}", added_mass ? "Added mass" : "Radiation damping", set.names[hull]);
  table.header = {"rad/s", "period s"};
  for (int i = 6 * hull; i < 6 * hull + 6; ++i) {
    static constexpr std::array<const char*, 6> kNames = {"surge", "sway", "heave", "roll", "pitch", "yaw"};
    table.header.push_back(
        fmt::format("{} {}", kNames[i % 6], added_mass ? added_mass_unit(i, i).name : damping_unit(i, i).name));
  }
  const auto add = [&](const std::string& w, const std::string& period, const MatrixX& M) {
    std::vector<std::string> row = {w, period};
    for (int i = 6 * hull; i < 6 * hull + 6; ++i)
      row.push_back(number(M(i, i), added_mass ? added_mass_unit(i, i).factor : damping_unit(i, i).factor));
    table.rows.push_back(std::move(row));
  };
  for (const FrequencyCoefficients& at : c.frequency)
    if (added_mass || at.frequency > 0.0)
      add(cell(at.frequency, 3), at.frequency > 0.0 ? cell(2.0 * std::numbers::pi / at.frequency, 2) : "-",
          added_mass ? at.A : at.B);
  if (added_mass) add("infinite", "0", c.A_inf);
  return table;
}

ReportTable pair_table(const HydroSet& set, const std::vector<std::pair<int, int>>& pairs) {
  const HydrodynamicCoefficients& c = *set.set;
  ReportTable table;
  table.title = "Coupled modes of " + set.title();
  table.note = "Symmetric; pairs below 0.5 % of the diagonal are left out.";
  table.header = {"pair"};
  std::vector<const FrequencyCoefficients*> at;
  std::vector<const FrequencyCoefficients*> positive;
  for (const FrequencyCoefficients& f : c.frequency)
    if (f.frequency > 0.0) positive.push_back(&f);
  for (const int k : spread(static_cast<int>(positive.size()), kSampled)) at.push_back(positive[k]);
  table.header.push_back("unit");
  for (const FrequencyCoefficients* f : at)
    table.header.push_back(
        fmt::format("{} rad/s ({} s)", cell(f->frequency, 2), cell(2.0 * std::numbers::pi / f->frequency, 1)));
  table.header.push_back("infinite");
  for (const auto& [i, j] : pairs)
    for (const bool added_mass : {true, false}) {
      const ShownUnit unit = added_mass ? added_mass_unit(i, j) : damping_unit(i, j);
      std::vector<std::string> row = {
          fmt::format("{} {}, {}", added_mass ? "A" : "B", set.mode_name(i), set.mode_name(j)), unit.name};
      for (const FrequencyCoefficients* f : at)
        row.push_back(number(added_mass ? f->A(i, j) : f->B(i, j), unit.factor));
      row.push_back(added_mass ? number(c.A_inf(i, j), unit.factor) : "0");
      table.rows.push_back(std::move(row));
    }
  return table;
}

ReportTable excitation_table(const HydroSet& set, int hull, int heading) {
  const ExcitationTable& X = set.set->excitation;
  ReportTable table;
  table.title =
      fmt::format("Excitation of {} by waves towards {:.0f} deg", set.names[hull], X.headings[heading] / kDegree);
  table.note = "Amplitude per metre of wave and lag behind the crest at the reference point, deg.";
  table.header = {"rad/s", "period s"};
  for (int i = 0; i < 6; ++i) {
    static constexpr std::array<const char*, 6> kNames = {"surge", "sway", "heave", "roll", "pitch", "yaw"};
    table.header.push_back(std::string(kNames[i]) + " " + excitation_unit(i).name);
    table.header.push_back("deg");
  }
  for (const int f : spread(static_cast<int>(X.frequencies.size()), kExcitationRows)) {
    std::vector<std::string> row = {cell(X.frequencies[f], 3), cell(2.0 * std::numbers::pi / X.frequencies[f], 2)};
    double largest[2] = {0.0, 0.0};
    for (int i = 0; i < 6; ++i) largest[i / 3] = std::max(largest[i / 3], std::abs(X.at(f, heading, 6 * hull + i)));
    for (int i = 0; i < 6; ++i) {
      const Complex x = X.at(f, heading, 6 * hull + i);
      const bool nothing = std::abs(x) < 1e-6 * largest[i / 3];
      row.push_back(nothing ? "0" : number(std::abs(x), excitation_unit(i).factor));
      row.push_back(nothing ? "-" : cell(std::arg(x) / kDegree, 0));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace

ShownUnit added_mass_unit(int i, int j) {
  static constexpr std::array<const char*, 3> kUnits = {"t", "t m", "t m2"};
  return {kUnits[rotations(i, j)], 1e3};
}

ShownUnit damping_unit(int i, int j) {
  static constexpr std::array<const char*, 3> kUnits = {"kN s/m", "kN s", "kN m s"};
  return {kUnits[rotations(i, j)], 1e3};
}

ShownUnit kernel_unit(int i, int j) {
  static constexpr std::array<const char*, 3> kUnits = {"kN/m", "kN", "kN m"};
  return {kUnits[rotations(i, j)], 1e3};
}

ShownUnit excitation_unit(int i) { return {i % 6 < 3 ? "kN/m" : "kN m/m", 1e3}; }

std::vector<std::pair<int, int>> coupled_pairs(const HydrodynamicCoefficients& set) {
  std::vector<std::pair<int, int>> pairs;
  const int n = set.modes();
  for (int i = 0; i < n; ++i)
    for (int j = i + 1; j < n; ++j) {
      const auto size = [&](const MatrixX& M) {
        const double scale = std::sqrt(std::abs(M(i, i) * M(j, j)));
        return scale > 0.0 ? std::abs(M(i, j)) / scale : 0.0;
      };
      double most = size(set.A_inf);
      double largest_B = 0.0, diagonal_i = 0.0, diagonal_j = 0.0;
      for (const FrequencyCoefficients& f : set.frequency) {
        most = std::max(most, size(f.A));
        largest_B = std::max(largest_B, std::abs(f.B(i, j)));
        diagonal_i = std::max(diagonal_i, f.B(i, i));
        diagonal_j = std::max(diagonal_j, f.B(j, j));
      }
      if (most > kNegligibleCoupling || largest_B > kNegligibleCoupling * std::sqrt(diagonal_i * diagonal_j)) pairs.emplace_back(i, j);
    }
  return pairs;
}

std::vector<int> shown_headings(const ExcitationTable& X) {
  std::vector<int> shown;
  for (const double wanted : {180.0, 135.0, 90.0}) {
    int best = 0;
    double least = std::numeric_limits<double>::max();
    for (std::size_t h = 0; h < X.headings.size(); ++h)
      if (const double off = std::abs(std::remainder(X.headings[h] - wanted * kDegree, 2.0 * std::numbers::pi));
          off < least - 1e-9)
        least = off, best = static_cast<int>(h);
    if (!X.headings.empty() && std::find(shown.begin(), shown.end(), best) == shown.end()) shown.push_back(best);
  }
  return shown;
}

std::vector<ReportTable> coefficient_tables(const HydroSet& set) {
  std::vector<ReportTable> tables;
  for (int hull = 0; hull < set.set->hulls(); ++hull) {
    tables.push_back(diagonal_table(set, hull, true));
    if (!set.set->frequency.empty()) tables.push_back(diagonal_table(set, hull, false));
  }
  if (const auto pairs = coupled_pairs(*set.set); !pairs.empty()) tables.push_back(pair_table(set, pairs));
  for (int hull = 0; hull < set.set->hulls(); ++hull)
    for (const int heading : shown_headings(set.set->excitation))
      tables.push_back(excitation_table(set, hull, heading));
  return tables;
}

ReportTable check_table(const HydroSet& set) {
  ReportTable table;
  table.title = "Self-checks of " + set.title();
  table.header = {"check", "value", "limit", "verdict", "where"};
  for (const SelfCheck& check : set.checks)
    table.rows.push_back({check.name, fmt::format("{:.3g}", check.value), fmt::format("{:.3g}", check.limit),
                          check.passed() ? "pass" : "FAIL, accepted", check.detail});
  return table;
}

ReportTable fit_table(const HydroSet& set) {
  ReportTable table;
  table.title = "Reduced model of " + set.title();
  if (!set.fit) {
    table.note = set.no_fit;
    return table;
  }
  const StateSpaceReport& report = set.fit->report;
  table.note = fmt::format(
      "Fitted to {} over {:.2f} to {:.2f} rad/s (periods {}) with a tolerance of {:.1f} %: {} states. A passivity "
      "margin >= 0 means "
      "that the model never gives energy away.",
      report.data, report.lowest, report.highest, periods_text(report.lowest, report.highest), 100.0 * report.tolerance,
      report.states);
  table.header = {"modes", "order", "worst R2", "passivity margin", "at rad/s", "period s", "enforced"};
  for (const StateSpaceBlockReport& block : report.blocks) {
    std::string modes;
    for (const int mode : block.modes) modes += (modes.empty() ? "" : ", ") + set.mode_name(mode);
    double worst = 1.0;
    for (const StateSpacePair& pair : report.pairs)
      if (pair.i == pair.j && std::find(block.modes.begin(), block.modes.end(), pair.i) != block.modes.end())
        worst = std::min(worst, pair.r_squared);
    table.rows.push_back({modes, std::to_string(block.order), fmt::format("{:.5f}", worst),
                          fmt::format("{:.2g}", block.passivity_margin), block.margin_frequency < kFarBeyond ? fmt::format("{:.2f}", block.margin_frequency) : "beyond",
                          block.margin_frequency < kFarBeyond ? period_text(block.margin_frequency) : "0", block.passivity_enforced ? "yes" : "no"});
  }
  return table;
}

ReportTable panel_table(const HydroSet& set) {
  ReportTable table;
  table.title = "Panels of " + set.title();
  table.note = "Each part of the band has a water surface of its own; panels are those that symmetry leaves.";
  table.header = {"band rad/s",     "periods s",        "frequencies", "hull panels",
                  "surface panels", "symmetry classes", "memory MB"};
  for (const PanelBand& band : set.bands)
    table.rows.push_back({fmt::format("{:.2f} to {:.2f}", band.from, band.to),
                          fmt::format("{} to {}", period_text(band.from), period_text(band.to)),
                          std::to_string(band.frequencies.size()), std::to_string(band.hull_panels),
                          std::to_string(band.surface_panels), std::to_string(band.classes),
                          cell(band.bytes / 1e6, 0)});
  return table;
}

ReportTable convergence_table(const HydroSet& set, const Convergence& convergence) {
  ReportTable table;
  table.title = "Convergence of " + set.title();
  table.note = fmt::format(
      "Largest change over the band, relative to the largest value of the curve, from panels divided by {:.2f} to "
      "{:.2f} "
      "and to {:.2f} ({}, {} and {} panels on the hull, {}, {} and {} on the water). Order and error by Richardson's "
      "extrapolation. {}",
      convergence.refinement[0], convergence.refinement[1], convergence.refinement[2], convergence.hull_panels[0],
      convergence.hull_panels[1], convergence.hull_panels[2], convergence.surface_panels[0],
      convergence.surface_panels[1], convergence.surface_panels[2], convergence.conclusion(set));
  table.header = {"quantity", "first change %", "second change %", "order", "estimated error %"};
  for (const ConvergenceRow& row : convergence.rows)
    table.rows.push_back({row.quantity + " " + set.mode_name(row.mode), cell(100.0 * row.first, 2),
                          cell(100.0 * row.second, 2), cell(row.order, 1), cell(100.0 * row.error, 2)});
  return table;
}

std::string origin_sentence(const HydroSet& set) {
  if (!set.panels) return fmt::format("{}: read from {}", set.title(), set.set->source);
  if (set.from_cache) return fmt::format("{}: panel method, taken from the cache", set.title());
  return fmt::format("{}: panel method, computed in {}", set.title(),
                     set.seconds < 10.0 ? cell(set.seconds, 1) + " s" : duration_text(set.seconds));
}

}  // namespace stillhook
