#include "sim/hull/rankine/band_joints.h"

#include <algorithm>
#include <cmath>

namespace stillhook::rankine {
namespace {

// How fast the correction fades that makes two parts of the band meet.
constexpr double kJoint = 3.0;
constexpr double kJump = 0.05;

/// What part p (side 0) or the next (side 1) takes of half the difference where they meet: -1 or 1 there, 0 at its other
/// end.
double share_at_joint(std::span<const PanelBand> bands, std::size_t p, int side, double w) {
  const PanelBand& band = bands[p + side];
  if (!(band.to > band.from)) return side == 0 ? -1.0 : 1.0;
  const double t = std::log(w / band.from) / std::log(band.to / band.from);
  return side == 0 ? -std::pow(t, kJoint) : std::pow(1.0 - t, kJoint);
}

/// Largest difference of the diagonals of two parts where they meet, of the largest value in either.
double jump_between(const std::vector<FrequencyCoefficients>& before, const std::vector<FrequencyCoefficients>& after) {
  double jump = 0.0;
  for (const MatrixX FrequencyCoefficients::* member : {&FrequencyCoefficients::A, &FrequencyCoefficients::B})
    for (Eigen::Index i = 0; i < before.back().A.rows(); ++i) {
      double most = 0.0;
      for (const auto* part : {&before, &after})
        for (const FrequencyCoefficients& at : *part) most = std::max(most, std::abs((at.*member)(i, i)));
      if (most > 0.0)
        jump = std::max(jump, std::abs((before.back().*member)(i, i) - (after.front().*member)(i, i)) / most);
    }
  return jump;
}

}  // namespace

void join_parts(std::span<const PanelBand> bands, std::vector<std::vector<FrequencyCoefficients>>& parts) {
  for (std::size_t p = 0; p + 1 < parts.size(); ++p) {
    if (jump_between(parts[p], parts[p + 1]) <= kJump) {
      parts[p].back() = parts[p + 1].front();
      continue;
    }
    const MatrixX A = 0.5 * (parts[p].back().A - parts[p + 1].front().A);
    const MatrixX B = 0.5 * (parts[p].back().B - parts[p + 1].front().B);
    for (const int side : {0, 1})
      for (FrequencyCoefficients& at : parts[p + side]) {
        const double share = share_at_joint(bands, p, side, at.frequency);
        at.A += share * A;
        at.B += share * B;
      }
  }
}

Eigen::MatrixXcd excitation_at(const ExcitationTable& X, double frequency, std::span<const int> modes) {
  const auto f = std::find(X.frequencies.begin(), X.frequencies.end(), frequency) - X.frequencies.begin();
  Eigen::MatrixXcd value(X.headings.size(), modes.size());
  for (std::size_t h = 0; h < X.headings.size(); ++h)
    for (std::size_t k = 0; k < modes.size(); ++k)
      value(h, k) = X.at(static_cast<int>(f), static_cast<int>(h), modes[k]);
  return value;
}

void join_excitation(std::span<const PanelBand> bands, std::size_t p, const Eigen::MatrixXcd& before,
                     std::span<const int> modes, ExcitationTable& X) {
  const double joint = bands[p].to;
  const Eigen::MatrixXcd after = excitation_at(X, joint, modes), half = 0.5 * (before - after);
  if (2.0 * half.cwiseAbs().maxCoeff() <= kJump * after.cwiseAbs().maxCoeff()) return;
  for (std::size_t f = 0; f < X.frequencies.size(); ++f) {
    const double w = X.frequencies[f];
    if (w < bands[p].from || w > bands[p + 1].to) continue;
    const double share = share_at_joint(bands, p, w < joint ? 0 : 1, w);
    for (std::size_t h = 0; h < X.headings.size(); ++h)
      for (std::size_t k = 0; k < modes.size(); ++k)
        X.at(static_cast<int>(f), static_cast<int>(h), modes[k]) += share * half(h, k);
  }
}

}  // namespace stillhook::rankine
