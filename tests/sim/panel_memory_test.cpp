// What a panel computation takes is told and bounded before it begins.
#include <catch2/catch.hpp>

#include "sim/hull/rankine/panel_method.h"
#include "sim/specification.h"

namespace stillhook {
namespace {

PanelHull box_of(const Vector3& size) {
  PanelHull hull;
  hull.name = "plate";
  hull.box_size = size;
  hull.mesh = box_mesh(size, Vector3::Zero(), 4.0);
  return hull;
}

}  // namespace

TEST_CASE("a plate whose panels would not fit is refused with its width, the panels and the keys", "[panel_memory]") {
  PanelMethodOptions options;
  options.memory = 4e9;
  bool begun = false;
  const auto progress = [&](double, const std::string&) { return begun = true; };
  try {
    panel_method({box_of({30.0, 0.1, 6.0})}, options, nullptr, progress);
    FAIL_CHECK("was accepted");
  } catch (const SpecificationError& error) {
    INFO(error.what());
    CHECK(error.entry == "bodies.plate");
    CHECK_THAT(error.what(), Catch::Contains("0.1 m wide") && Catch::Contains("panel_method.memory_gb") &&
                                 Catch::Contains("panel_length_m") && Catch::Contains("refinement"));
  }
  CHECK_FALSE(begun);
  CHECK_THROWS_AS(planned_bands({box_of({30.0, 0.1, 6.0})}, options), SpecificationError);
  // With panels as long as those of an ordinary hull it is taken, and so is the ordinary hull.
  options.panel_length = 1.5;
  CHECK_NOTHROW(planned_bands({box_of({30.0, 0.1, 6.0})}, options));
  options.panel_length = 0.0;
  const std::vector<PanelBand> bands = planned_bands({box_of({60.0, 20.0, 6.0})}, options);
  for (const PanelBand& band : bands) CHECK(bytes_at_most(band, 1) < 1e9);
}

}  // namespace stillhook
