// A vessel that moves by displacement RAOs: its truth in the time domain, and tables of it in any convention.
#pragma once

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "sim/hull/rao_motion.h"
#include "sim/simulate.h"
#include "sim/spatial/constants.h"
#include "tests/sim/lift_parts.h"

namespace stillhook::rao_sample {

inline constexpr double kG = 9.80665;
inline constexpr std::array<const char*, 6> kNames = {"surge", "sway", "heave", "roll", "pitch", "yaw"};

/// A vessel whose point G answers a wave with these amplitudes (m/m, rad/m) and lags (rad) behind the crest at G, in its
/// own axes (x forward, y port, z up). Everything below is in the time domain; no complex numbers.
struct Truth {
  Vector3 G{1.5, 0.0, 2.0};
  std::array<double, 6> amplitude = {0.6, 0.45, 0.9, 0.031, 0.017, 0.008};
  std::array<double, 6> lag = {1.4, -1.2, 0.25, 2.0, -2.4, 0.7};

  double wave(const Vector3& at, double w, double b, double t) const {
    return std::cos(w * t - w * w / kG * (at.x() * std::cos(b) + at.y() * std::sin(b)));
  }
  /// Translation of a point and turn, in a wave of 1 m that travels towards b.
  Vector6 motion(const Vector3& point, double w, double b, double t) const {
    Vector6 q;
    for (int i = 0; i < 6; ++i) {
      const auto n = static_cast<std::size_t>(i);
      q[i] = amplitude[n] * std::cos(w * t - w * w / kG * (G.x() * std::cos(b) + G.y() * std::sin(b)) - lag[n]);
    }
    q.head<3>() += q.tail<3>().cross(point - G);
    return q;
  }
};

/// Amplitude and phase of a function of time with the frequency w: m = A cos(w t - phase).
inline std::pair<double, double> harmonic(const std::function<double(double)>& m, double w) {
  double c = 0.0, s = 0.0;
  constexpr int n = 24;
  for (int k = 0; k < n; ++k) {
    const double t = kTwoPi / w * k / n;
    c += 2.0 / n * m(t) * std::cos(w * t);
    s += 2.0 / n * m(t) * std::sin(w * t);
  }
  return {std::hypot(c, s), std::atan2(s, c)};
}

inline std::string header(const std::string& first = "period_s", const std::string& turn = "_deg_per_m") {
  std::string text = first + ",heading_deg";
  for (std::size_t i = 0; i < 6; ++i)
    text += std::string(",") + kNames[i] + (i < 3 ? "_m_per_m" : turn) + "," + kNames[i] + "_phase_deg";
  return text + "\n";
}

/// A row as its owner would have measured it, by the conventions of `spec`.
inline std::string row(const Truth& truth, const RaoSpec& spec, double w, double towards, bool period = true) {
  std::ostringstream text;
  text.precision(15);
  const double given = spec.direction == RaoSpec::Direction::towards ? towards : towards + std::numbers::pi;
  text << (period ? kTwoPi / w : w) << "," << (spec.turn == RaoSpec::Turn::port ? given : -given) / kDegree;
  const Vector3 origin(spec.phase_x, spec.phase_y, 0.0);
  const double crest = harmonic([&](double t) { return truth.wave(origin, w, towards, t); }, w).second;
  const double event = crest + (spec.event == RaoSpec::Event::crest    ? 0.0
                                : spec.event == RaoSpec::Event::trough ? std::numbers::pi
                                : spec.event == RaoSpec::Event::rising ? -0.5 * std::numbers::pi
                                                                       : 0.5 * std::numbers::pi);
  for (int i = 0; i < 6; ++i) {
    const double sign = spec.reversed[static_cast<std::size_t>(i)] ? -1.0 : 1.0;
    const auto [A, peak] = harmonic([&](double t) { return sign * truth.motion(spec.reference, w, towards, t)[i]; }, w);
    const double lag = peak - event, phase = spec.phase == RaoSpec::Phase::lag ? lag : -lag;
    text << "," << (i < 3 ? A : A / kDegree) << "," << std::remainder(phase, kTwoPi) / kDegree;
  }
  text << "\n";
  return text.str();
}

inline BodySpec vessel(const RaoSpec& rao) {
  BodySpec b;
  b.name = "vessel";
  b.mass = 2e7;
  b.cog = Vector3(4.0, 0.0, 3.0);
  b.inertia = Vector3(2e9, 3e10, 3e10).asDiagonal();
  b.position = Vector3(30.0, -12.0, 0.4);
  b.attitude = {0.0, 0.0, 0.7};
  b.hydrodynamics.kind = HydrodynamicsSpec::Kind::rao;
  b.hydrodynamics.rao = rao;
  return b;
}

inline std::shared_ptr<const WaveField> regular_wave(double a, double w, double towards, double ramp = 20.0) {
  SeaStateSpec s;
  s.type = SeaStateSpec::Type::regular;
  s.amplitude = a;
  s.frequency = w;
  s.heading = towards;
  return std::make_shared<const WaveField>(build_wave_field(s, kG, ramp));
}

/// A table of the truth at these frequencies, every 30 deg.
inline std::string table_text(const Truth& truth, const RaoSpec& spec, const std::vector<double>& frequencies) {
  std::string text = header();
  for (const double w : frequencies)
    for (int h = 0; h < 12; ++h) text += row(truth, spec, w, 30.0 * kDegree * h);
  return text;
}

inline const std::vector<double>& series(const Trajectory& run, const std::string& channel) {
  for (std::size_t i = 0; i < run.channels.size(); ++i)
    if (run.channels[i].name == channel) return run.values[i];
  FAIL("no channel " << channel);
  return run.values.front();
}

inline LiftParts vessel_alone(const RaoSpec& rao) {
  LiftParts lift;
  lift.spec.bodies.push_back(vessel(rao));
  lift.spec.solver.time_step = 0.05;
  lift.spec.solver.output_interval = 0.5;
  lift.spec.solver.max_duration = 60.0;
  return lift;
}

inline void regular_sea(Specification& spec, double a, double w, double towards, double ramp) {
  SeaStateSpec s;
  s.name = "swell";
  s.type = SeaStateSpec::Type::regular;
  s.amplitude = a;
  s.frequency = w;
  s.heading = towards;
  spec.sea.states = {s};
  spec.sea.active = "swell";
  spec.sea.ramp = ramp;
}

inline std::string refusal(const std::function<void()>& what) {
  try {
    what();
  } catch (const SpecificationError& error) {
    return error.what();
  }
  return "";
}

}  // namespace stillhook::rao_sample
