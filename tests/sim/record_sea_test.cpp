// A sea made of a measured elevation: no operation outlasts the record, and its long waves are told.
#include <catch2/catch.hpp>
#include <cmath>
#include <memory>
#include <numbers>

#include "sim/model.h"
#include "sim/operation.h"
#include "sim/sea/sea_statistics.h"
#include "sim/specification.h"

namespace stillhook {
namespace {

using Catch::Matchers::Contains;

/// 400 s of 0.5 m waves of 6 s, with swell of 0.2 m and 16 s: 14 % of the energy.
SeaStateSpec measured() {
  auto record = std::make_shared<ElevationRecord>();
  record->step = 0.5;
  for (int i = 0; i < 800; ++i) {
    const double t = 0.5 * i;
    record->elevation.push_back(0.5 * std::sin(2.0 * std::numbers::pi * t / 6.0) +
                                0.2 * std::sin(2.0 * std::numbers::pi * t / 16.0));
  }
  SeaStateSpec s;
  s.name = "gauge";
  s.type = SeaStateSpec::Type::record;
  s.record = record;
  return s;
}

}  // namespace

TEST_CASE("an operation longer than the record of its sea is refused", "[record]") {
  Specification spec;
  spec.name = "float";
  BodySpec body;
  body.name = "hull";
  body.mass = 1025.0 * 40.0 * 20.0 * 2.0;
  body.inertia = body.mass * Vector3(36.0, 130.0, 150.0).asDiagonal();
  body.hull.shape = HullSpec::Shape::box;
  body.hull.size = Vector3(40.0, 20.0, 4.0);
  body.hydrodynamics.kind = HydrodynamicsSpec::Kind::constant;
  spec.bodies.push_back(body);
  spec.sea.states = {measured()};
  spec.sea.active = "gauge";
  PhaseSpec phase;
  phase.name = "waiting";
  phase.duration = 390.0;
  spec.operation.phases = {phase};
  const Model model = build_model(spec);
  CHECK_NOTHROW(build_operation(model));
  spec.operation.phases[0].duration = 401.0;
  const Model longer = build_model(spec);
  CHECK_THROWS_WITH(build_operation(longer), Contains("sea.states.gauge") && Contains("401"));
}

TEST_CASE("long waves beside the peak of a file's sea are told", "[record]") {
  const SeaStatistics record = sea_statistics(measured()).back();
  CHECK(record.peak_period == Approx(6.0).epsilon(0.02));
  CHECK(record.long_period == Approx(16.0).epsilon(0.05));  // lines of 400 s are 4 % apart there

  auto spectrum = std::make_shared<DirectionalSpectrum>();
  for (int i = 0; i < 60; ++i) spectrum->frequency.push_back(0.2 + 0.02 * i);
  for (int j = 0; j < 12; ++j) spectrum->heading.push_back(2.0 * std::numbers::pi / 12.0 * j);
  for (const double w : spectrum->frequency)
    for (int j = 0; j < 12; ++j)
      spectrum->density.push_back(std::exp(-std::pow((w - 1.0) / 0.1, 2)) +
                                  0.5 * std::exp(-std::pow((w - 0.4) / 0.03, 2)));
  SeaStateSpec file;
  file.name = "file";
  file.type = SeaStateSpec::Type::spectrum;
  file.spectrum = spectrum;
  const SeaStatistics told = sea_statistics(file).back();
  CHECK(told.peak_period == Approx(2.0 * std::numbers::pi).epsilon(1e-3));
  // A third of 0.13 of the energy lies below the lower flank of the second peak: between 0.35 and 0.4 rad/s.
  CHECK(told.long_period > 2.0 * std::numbers::pi / 0.4);
  CHECK(told.long_period < 2.0 * std::numbers::pi / 0.35);

  SeaStateSpec shape;
  shape.name = "wind_sea";
  shape.type = SeaStateSpec::Type::pierson_moskowitz;
  shape.significant_height = 1.0;
  shape.peak_period = 7.0;
  CHECK(sea_statistics(shape).back().long_period == sea_statistics(shape).back().peak_period);
}

}  // namespace stillhook
