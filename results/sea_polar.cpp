#include "results/sea_polar.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "results/html.h"
#include "results/svg.h"
#include "sim/crane_parts.h"
#include "sim/sea/sea_statistics.h"
#include "sim/sea/spectrum.h"
#include "sim/sea/wave_record.h"
#include "sim/spatial/constants.h"

namespace stillhook {
namespace {

using SeaType = SeaStateSpec::Type;

constexpr double kCentreX = 235.0, kCentreY = 240.0, kRadius = 180.0, kHub = 24.0;  // user units
constexpr int kPlaces = 4;  // at which a mean over a cell looks, one way
constexpr double kLongCrested = 10.0 * kDegree;

/// Share of the energy of cos^n or cos^2s between two angles from the main direction, rad.
double spreading_share(const SeaStateSpec& s, double from, double to) {
  const bool round = s.spreading_2s > 0.0, line = s.directions == 1 || !(round || s.spreading > 0.0);
  const auto weight = [&](double b) {
    b = std::remainder(b, kTwoPi);
    if (line) return std::abs(b) <= 0.5 * kLongCrested ? 1.0 : 0.0;
    if (round) return std::pow(std::cos(0.5 * b), 2.0 * s.spreading_2s);
    return std::abs(b) < 0.5 * std::numbers::pi ? std::pow(std::cos(b), s.spreading) : 0.0;
  };
  const auto sum = [&](double a, double b, int n) {
    double total = 0.0;
    for (int i = 0; i < n; ++i) total += weight(a + (b - a) * (i + 0.5) / n);
    return total * (b - a) / n;
  };
  return sum(from, to, 40) / sum(-std::numbers::pi, std::numbers::pi, 3600);
}

double density_in_spectrum(const DirectionalSpectrum& d, double w, double b) {
  if (w < d.frequency.front() || w > d.frequency.back()) return 0.0;
  const auto upper = std::upper_bound(d.frequency.begin() + 1, d.frequency.end() - 1, w);
  const auto i = static_cast<std::size_t>(upper - d.frequency.begin()) - 1;
  const double part = (w - d.frequency[i]) / (d.frequency[i + 1] - d.frequency[i]);
  const std::size_t n = d.heading.size();
  // Every entry stands for a bin about its heading.
  const double turn = (b - d.heading.front()) / kTwoPi * static_cast<double>(n);
  const auto j = static_cast<std::size_t>(((std::lround(turn) % static_cast<long>(n)) + static_cast<long>(n))) % n;
  return (1.0 - part) * d.density[i * n + j] + part * d.density[(i + 1) * n + j];
}

/// rad/s, the end of the plot: two hundredths of the energy of a system lie beyond it.
double end_of(const SeaStateSpec& s) {
  double end = 0.0;
  switch (s.type) {
    case SeaType::calm:
      break;
    case SeaType::regular:
      end = 1.3 * s.frequency;
      break;
    case SeaType::sum:
      for (const SeaStateSpec& part : s.parts) end = std::max(end, end_of(part));
      break;
    case SeaType::record:
      end = 2.5 * kTwoPi / sea_statistics(s).back().peak_period;
      break;
    default:
      end = frequency_below(s, 0.98);
  }
  return end;
}

/// m2 s/rad, the mean over every ring, of a sea whose spreading is the same at all frequencies.
std::vector<double> over_rings(const SeaStateSpec& s, double ring) {
  std::vector<double> mean(SeaCells::kRings, 0.0);
  if (s.type == SeaType::record) {
    for (const WaveComponent& c : record_components(s, kStandardGravity, std::numeric_limits<double>::infinity()))
      if (const auto r = static_cast<std::size_t>(c.frequency / ring); r < mean.size())
        mean[r] += 0.5 * c.amplitude * c.amplitude / ring;
    return mean;
  }
  for (std::size_t r = 0; r < mean.size(); ++r)
    for (int i = 0; i < kPlaces; ++i)
      mean[r] += spectral_density(s, ring * (static_cast<double>(r) + (i + 0.5) / kPlaces)) / kPlaces;
  return mean;
}

void add_cells(const SeaStateSpec& state, SeaCells& cells) {
  constexpr double kSector = kTwoPi / SeaCells::kSectors;
  if (state.type == SeaType::calm || state.type == SeaType::regular) return;
  if (state.type == SeaType::sum) {
    for (const SeaStateSpec& part : state.parts) add_cells(part, cells);
    return;
  }
  const bool table = state.type == SeaType::spectrum;
  const std::vector<double> mean = table ? std::vector<double>() : over_rings(state, cells.ring);
  for (int s = 0; s < SeaCells::kSectors; ++s) {
    const double from = kSector * (s - 0.5), off = std::remainder(kSector * s - state.heading, kTwoPi);
    const double share = table ? 0.0 : spreading_share(state, off - 0.5 * kSector, off + 0.5 * kSector) / kSector;
    for (int r = 0; r < SeaCells::kRings; ++r) {
      if (!table) {
        cells.density[r][s] += mean[r] * share;
        continue;
      }
      for (int i = 0; i < kPlaces * kPlaces; ++i)
        cells.density[r][s] += density_in_spectrum(*state.spectrum, cells.ring * (r + (i % kPlaces + 0.5) / kPlaces),
                                                   from + kSector * (i / kPlaces + 0.5) / kPlaces) /
                               (kPlaces * kPlaces);
    }
  }
}

/// White to dark blue, so that it reads in grey.
std::string shade(double part) {
  const double p = std::sqrt(std::clamp(part, 0.0, 1.0));  // small swells are seen beside large ones
  const auto mix = [&](int light, int dark) { return static_cast<int>(std::lround(light + p * (dark - light))); };
  return fmt::format("#{:02x}{:02x}{:02x}", mix(255, 8), mix(255, 64), mix(255, 129));
}

struct Spot {
  double x, y;
};
/// A place on the plot by the direction that waves come from (rad from +x, counter-clockwise) and the radius.
Spot spot(double from, double radius) {
  return {kCentreX - radius * std::sin(from), kCentreY - radius * std::cos(from)};
}
double radius_of(double frequency, double end) { return kHub + (kRadius - kHub) * frequency / end; }

std::string cells_svg(const SeaCells& cells, double most) {
  constexpr double kSector = kTwoPi / SeaCells::kSectors;
  const double end = cells.ring * SeaCells::kRings;
  std::string out;
  for (int r = 0; r < SeaCells::kRings; ++r)
    for (int s = 0; s < SeaCells::kSectors; ++s) {
      const double density = cells.density[r][s];
      if (!(density > 1e-4 * most)) continue;
      const double inner = radius_of(cells.ring * r, end), outer = radius_of(cells.ring * (r + 1), end);
      const double from = kSector * (s - 0.5) + std::numbers::pi, to = from + kSector;
      const Spot a = spot(from, inner), b = spot(from, outer), c = spot(to, outer), d = spot(to, inner);
      out += fmt::format(
          "<path d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}A{:.1f} {:.1f} 0 0 0 {:.1f} {:.1f}L{:.1f} {:.1f}A{:.1f} {:.1f} 0 0 1 "
          "{:.1f} {:.1f}Z\" fill=\"{}\"/>",
          a.x, a.y, b.x, b.y, outer, outer, c.x, c.y, d.x, d.y, inner, inner, a.x, a.y, shade(density / most));
    }
  return out;
}

std::string rings_svg(double end) {
  std::string out;
  double last = 0.0;
  for (const double period : {30.0, 20.0, 15.0, 12.0, 10.0, 8.0, 7.0, 6.0, 5.0, 4.0, 3.0, 2.0, 1.5, 1.0}) {
    const double radius = radius_of(kTwoPi / period, end);
    if (radius > kRadius || radius < last + 22.0) continue;
    last = radius;
    out += fmt::format(
        "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\" fill=\"none\" stroke=\"#9aa5b1\" "
        "stroke-width=\"0.7\"/>",
        kCentreX, kCentreY, radius);
    const Spot at = spot(-67.5 * kDegree, radius);
    out += svg_text(at.x, at.y + 4.0, "middle", fmt::format("{:g} s", period),
                    " font-size=\"10.5\" stroke=\"#ffffff\" stroke-width=\"3\" paint-order=\"stroke\"");
  }
  for (int i = 0; i < 8; ++i) {
    const Spot a = spot(i * 45.0 * kDegree, kHub), b = spot(i * 45.0 * kDegree, kRadius);
    out += fmt::format("<path d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\" stroke=\"#9aa5b1\" stroke-width=\"0.7\"/>", a.x, a.y,
                       b.x, b.y);
  }
  out += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\" fill=\"none\" stroke=\"#3d4852\"/>", kCentreX,
                     kCentreY, kRadius);
  return out + svg_text(kCentreX, kCentreY - kRadius - 7.0, "middle", "from +x") +
         svg_text(kCentreX - kRadius - 7.0, kCentreY + 4.0, "end", "+y") +
         svg_text(kCentreX + kRadius + 7.0, kCentreY + 4.0, "start", "−y") +
         svg_text(kCentreX, kCentreY + kRadius + 17.0, "middle", "−x");
}

/// The vessel of the operation, or the first that floats, as a hull with its bow; nothing without one.
std::string vessel_svg(const Specification& spec) {
  const BodySpec* vessel = nullptr;
  const std::vector<std::string> names = operation_vessels(spec);
  for (const BodySpec& body : spec.bodies)
    if (!vessel && (names.empty() ? body.floats() || body.moved_by_sea() : body.name == names.front())) vessel = &body;
  if (!vessel) return {};
  return fmt::format(
      "<path d=\"M0 -20L7 -9V17H-7V-9Z\" fill=\"#ffffff\" stroke=\"#1c2329\" stroke-width=\"1.3\" "
      "transform=\"translate({:.1f} {:.1f}) rotate({:.1f})\"><title>{}, its bow at the sharp end</title></path>",
      kCentreX, kCentreY, -vessel->attitude.yaw / kDegree, escape_html(vessel->name));
}

std::string north_svg(double north) {
  const Spot a = spot(north, kRadius + 4.0), b = spot(north, kRadius + 16.0), c = spot(north, kRadius + 27.0);
  return fmt::format("<path d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\" stroke=\"#a4001d\" stroke-width=\"2.5\"/>", a.x, a.y,
                     b.x, b.y) +
         svg_text(c.x, c.y + 4.0, "middle", "N", " fill=\"#a4001d\" font-weight=\"700\"");
}

/// A number at the mean direction and peak of every system, and what it stands for beside the plot.
std::string systems_svg(const SeaStateSpec& state, double end) {
  std::vector<SeaStatistics> all = sea_statistics(state);
  if (all.size() > 1) all.pop_back();  // the whole
  std::string out;
  const bool marked = state.type != SeaType::spectrum;  // whose energy has no one place
  double y = 70.0;
  const double x = kCentreX + kRadius + 45.0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const SeaStatistics& s = all[i];
    const SeaStateSpec& of = state.type == SeaType::sum ? state.parts[i] : state;
    const Spot at = spot(s.heading + std::numbers::pi, std::min(radius_of(kTwoPi / s.peak_period, end), kRadius));
    const std::string number = std::to_string(i + 1);
    if (of.type == SeaType::regular)
      out += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"5\" fill=\"#083f81\"/>", at.x, at.y);
    if (marked)
      out += svg_text(
          at.x, at.y + 4.0, "middle", number,
          " font-weight=\"700\" fill=\"#a4001d\" stroke=\"#ffffff\" stroke-width=\"3\" paint-order=\"stroke\"");
    out += svg_text(x, y, "start", (marked ? number + "  " : "") + s.name, " font-weight=\"600\"");
    const std::string height = of.type == SeaType::regular
                                   ? fmt::format("H {} m, T", fixed_number(2.0 * of.amplitude, 2))
                                   : fmt::format("Hs {} m, Tp", fixed_number(s.significant_height, 2));
    out += svg_text(x + 16.0, y + 17.0, "start", fmt::format("{} {} s", height, fixed_number(s.peak_period, 1)));
    y += 46.0;
  }
  return out;
}

std::string key_svg(double most) {
  const double x = kCentreX + kRadius + 45.0, y = kCentreY + kRadius - 50.0;
  std::string out;
  constexpr int kSteps = 24;
  for (int i = 0; i < kSteps; ++i)
    out += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"6.2\" height=\"14\" fill=\"{}\"/>", x + 6.0 * i, y,
                       shade((i + 0.5) / kSteps));
  out += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"144\" height=\"14\" fill=\"none\" stroke=\"#3d4852\"/>",
                     x, y);
  out += svg_text(x, y + 30.0, "start", "0") +
         svg_text(x + 144.0, y + 30.0, "end", fmt::format("{} m² s/rad²", readable_number(most, 2)));
  return out + svg_text(x, y - 8.0, "start", "spectral density");
}

}  // namespace

SeaCells sea_cells(const SeaStateSpec& state) {
  SeaCells cells;
  cells.ring = end_of(state) / SeaCells::kRings;
  cells.density.assign(SeaCells::kRings, std::vector<double>(SeaCells::kSectors, 0.0));
  if (cells.ring > 0.0) add_cells(state, cells);
  return cells;
}

std::string draw_sea_polar(const Specification& spec, std::optional<double> north) {
  const SeaStateSpec* state = spec.sea.active_state();
  if (!state || state->type == SeaType::calm || state->type == SeaType::regular) return {};
  const SeaCells cells = sea_cells(*state);
  if (!(cells.ring > 0.0)) return {};
  const double end = cells.ring * SeaCells::kRings;
  double most = 0.0;
  for (const std::vector<double>& ring : cells.density) most = std::max(most, std::ranges::max(ring));
  std::string out = svg_begin(660.0, 450.0, "Where the waves come from, by their period") + cells_svg(cells, most) +
                    rings_svg(end) + vessel_svg(spec) + systems_svg(*state, end);
  if (most > 0.0) out += key_svg(most);
  if (north) out += north_svg(*north);
  return out + "</svg>";
}

}  // namespace stillhook
