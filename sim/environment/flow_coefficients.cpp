#include "sim/environment/flow_coefficients.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <sstream>

#include "sim/csv_cells.h"
#include "sim/error.h"
#include "sim/number_text.h"
#include "sim/spatial/constants.h"

namespace stillhook {
namespace {

constexpr double kSameAngle = 1e-6;            // rad, of a printed degree
constexpr double kWidestGap = 45.5 * kDegree;  // between two rows: a cubic over more makes coefficients up
constexpr double kAmidships = 1e-6;            // of C_y and C_n at 0 and 180 deg of a table that is mirrored
constexpr int kRulesStep = 5;                  // deg, of tables made by a rule

struct ShipParameters {
  double across, bow, stern, delta, kappa;  // CDt, CDl_AF at the bow and at the stern, delta, kappa
};

ShipParameters parameters_of(WindHullSpec::Ship ship) {
  using Ship = WindHullSpec::Ship;
  switch (ship) {
    case Ship::cargo_loaded:
      return {0.85, 0.65, 0.55, 0.4, 1.7};
    case Ship::diving_support:
      return {0.9, 0.6, 0.8, 0.55, 1.7};
    case Ship::drilling:
      return {1.0, 0.85, 0.925, 0.1, 1.7};
    case Ship::offshore_supply:
      return {0.9, 0.55, 0.8, 0.55, 1.2};
    case Ship::research:
      return {0.85, 0.55, 0.65, 0.6, 1.4};
    case Ship::tanker_ballast:
      return {0.7, 0.75, 0.55, 0.4, 2.2};
    case Ship::tender:
      return {0.85, 0.55, 0.55, 0.65, 1.1};
    case Ship::none:
      break;
  }
  throw Error("is no kind of ship");
}

template <class Rule>
FlowCoefficients by_rule(Rule rule) {
  std::vector<FlowCoefficients::Row> rows;
  for (int degree = 0; degree <= 180; degree += kRulesStep) {
    const double a = degree * kDegree;
    // Exactly 0 across a symmetric flow, where sin(pi) is not.
    const double cosine = degree == 90 ? 0.0 : std::cos(a), sine = degree == 180 ? 0.0 : std::sin(a);
    const Vector3 C = rule(a, cosine, sine);
    rows.push_back({a, C[0], C[1], C[2]});
  }
  return FlowCoefficients(std::move(rows));
}

std::vector<FlowCoefficients::Row> mirrored(std::vector<FlowCoefficients::Row> rows) {
  double largest = 0.0;
  for (const auto& row : rows) largest = std::max({largest, std::abs(row[2]), std::abs(row[3])});
  for (const auto* row : {&rows.front(), &rows.back()})
    if (std::abs((*row)[2]) > kAmidships * largest || std::abs((*row)[3]) > kAmidships * largest)
      throw Error(
          "must have Cy and Cn of 0 at 0 and 180 deg, where its other side is mirrored; give 0 to 360 deg of a "
          "hull that is not alike on both sides");
  for (std::size_t i = rows.size() - 1; i-- > 0;)
    rows.push_back({kTwoPi - rows[i][0], rows[i][1], -rows[i][2], -rows[i][3]});
  return rows;
}

}  // namespace

FlowCoefficients::FlowCoefficients(std::vector<Row> rows) {
  if (rows.size() < 2) throw Error("needs rows from 0 to 180 or to 360 deg");
  for (std::size_t i = 0; i + 1 < rows.size(); ++i) {
    const double gap = rows[i + 1][0] - rows[i][0];
    if (!(gap > kSameAngle)) throw Error("must have rising angles");
    if (gap > kWidestGap)
      throw Error("has no row between " + number_text(rows[i][0] / kDegree) + " and " +
                  number_text(rows[i + 1][0] / kDegree) + " deg: 45 deg at most are bridged");
  }
  const double first = rows.front()[0], last = rows.back()[0];
  const bool half = std::abs(last - 0.5 * kTwoPi) < kSameAngle, whole = std::abs(last - kTwoPi) < kSameAngle;
  if (std::abs(first) > kSameAngle || !(half || whole))
    throw Error("must go from 0 to 180 or from 0 to 360 deg, it goes from " + number_text(first / kDegree) + " to " +
                number_text(last / kDegree) + " deg");
  if (half) rows = mirrored(std::move(rows));
  for (int k = 1; k < 4; ++k)
    if (std::abs(rows.back()[k] - rows.front()[k]) > 1e-9)
      throw Error("must have the same coefficients at 0 and 360 deg");
  for (const Row& row : rows) {
    angle_.push_back(row[0]);
    value_.push_back({row[1], row[2], row[3]});
  }
  const std::size_t n = rows.size() - 1;  // intervals once round
  for (std::size_t i = 0; i <= n; ++i) {
    const std::size_t before = i == 0 ? n - 1 : i - 1, here = i == n ? 0 : i;
    const double h0 = angle_[before + 1] - angle_[before], h1 = angle_[here + 1] - angle_[here];
    std::array<double, 3> d;
    for (std::size_t k = 0; k < 3; ++k) {
      const double d0 = (value_[before + 1][k] - value_[before][k]) / h0;
      const double d1 = (value_[here + 1][k] - value_[here][k]) / h1;
      d[k] = (h1 * d0 + h0 * d1) / (h0 + h1);
    }
    slope_.push_back(d);
  }
}

FlowCoefficients::Values FlowCoefficients::at(double angle) const {
  const double a = angle - kTwoPi * std::floor(angle / kTwoPi);
  const auto above = std::upper_bound(angle_.begin(), angle_.end(), a);
  const auto i = static_cast<std::size_t>(
      std::clamp<std::ptrdiff_t>(above - angle_.begin() - 1, 0, static_cast<std::ptrdiff_t>(angle_.size()) - 2));
  const double h = angle_[i + 1] - angle_[i], s = (a - angle_[i]) / h;
  Values v;
  for (std::size_t k = 0; k < 3; ++k) {
    const double c0 = value_[i][k], d0 = h * slope_[i][k], d1 = h * slope_[i + 1][k], rise = value_[i + 1][k] - c0;
    const double c2 = 3.0 * rise - 2.0 * d0 - d1, c3 = d0 + d1 - 2.0 * rise;
    v.value[static_cast<int>(k)] = c0 + s * (d0 + s * (c2 + s * c3));
    v.slope[static_cast<int>(k)] = (d0 + s * (2.0 * c2 + s * 3.0 * c3)) / h;
  }
  return v;
}

double FlowCoefficients::broadside() const {
  double largest = 0.0;
  for (const auto& row : value_) largest = std::max(largest, std::abs(row[1]));
  return largest;
}

FlowCoefficients blendermann(const WindHullSpec& hull) {
  const ShipParameters p = parameters_of(hull.ship);
  const double front = hull.area_front / hull.area_side, ahead = hull.centroid_ahead / hull.length;
  return by_rule([=](double a, double cosine, double sine) {
    const double along = a <= 0.25 * kTwoPi ? p.bow : p.stern;
    const double twice = 2.0 * sine * cosine;
    const double D = 1.0 - 0.5 * p.delta * (1.0 - along * front / p.across) * twice * twice;
    const double across = -p.across * sine / D;
    return Vector3(-along * cosine / D, across, across * (ahead + 0.18 * (0.25 * kTwoPi - a)));
  });
}

double blendermann_heeling(WindHullSpec::Ship ship) { return parameters_of(ship).kappa; }

FlowCoefficients cross_flow(double along, double across) {
  return by_rule([=](double, double cosine, double sine) {
    return Vector3(-along * cosine * std::abs(cosine), -across * sine * std::abs(sine), 0.0);
  });
}

FlowCoefficients read_flow_coefficients(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream whole;
  whole << in.rdbuf();
  if (!in) throw FileError(path + ": cannot be read");
  const std::string text = whole.str();
  std::vector<FlowCoefficients::Row> rows;
  try {
    CsvRows lines(text);
    const char separator = lines.find_separator();
    std::vector<CsvCell> cells;
    if (!lines.next(separator, cells)) throw Error("is empty");
    std::vector<std::string> names;
    for (const CsvCell& cell : cells) {
      names.emplace_back(cell.text);
      for (char& c : names.back()) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
    const std::array<std::string, 4> wanted = {"angle_deg", "cx", "cy", "cn"};
    std::array<std::size_t, 4> column;
    for (std::size_t k = 0; k < 4; ++k) {
      column[k] = static_cast<std::size_t>(std::ranges::find(names, wanted[k]) - names.begin());
      if (column[k] == names.size())
        throw Error("has no column \"" + wanted[k] + "\": its first row must name angle_deg, Cx, Cy and Cn");
    }
    while (lines.next(separator, cells)) {
      FlowCoefficients::Row row;
      for (std::size_t k = 0; k < 4; ++k) {
        const auto number = column[k] < cells.size() ? number_with_point(cells[column[k]].text) : std::nullopt;
        if (!number) throw Error("line " + std::to_string(lines.line()) + " has no number in \"" + wanted[k] + "\"");
        row[k] = k == 0 ? *number * kDegree : *number;
      }
      rows.push_back(row);
    }
    return FlowCoefficients(std::move(rows));
  } catch (const std::runtime_error& error) {
    throw FileError(path + ": " + error.what());
  }
}

}  // namespace stillhook
