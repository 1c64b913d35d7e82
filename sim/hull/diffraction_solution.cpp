// The diffraction problem solved for itself, which Haskind's relation is checked against.
#include "sim/hull/rankine/bands.h"
#include "sim/hull/rankine/hull_modes.h"
#include "sim/hull/rankine/panel_method.h"

namespace stillhook {

Eigen::MatrixXcd diffraction_by_solution(const std::vector<PanelHull>& hulls, const PanelMethodOptions& options,
                                         double frequency, const std::vector<double>& headings) {
  using namespace rankine;
  require_options(options);
  const Layout layout = place(hulls);
  PanelMethodOptions one = options;
  one.chosen = {frequency};
  const PanelBand band = bands_of(layout, one).front();
  const HullPanels panels = panels_of(hulls, layout, band.panel_length);
  SurfacePanels surface = free_surface(panels, grid_of(band));
  mark_gap(layout, panels, surface);
  const Beach beach = beach_of(band, options);
  const VectorX weight = panel_weights(panels, options.density);
  const int count = static_cast<int>(headings.size());
  Eigen::MatrixXcd X = Eigen::MatrixXcd::Zero(6 * hulls.size(), count);
  for (const BoundaryClass& c : boundary_problem(panels, surface, bed_within(band.width, layout, options))) {
    const ClassModes modes = modes_of(panels, layout, c.parity);
    if (modes.modes.empty()) continue;
    Eigen::MatrixXcd v(panels.panels.size(), count);
    for (int h = 0; h < count; ++h)
      v.col(h) = -incident_velocity(panels, c.parity, frequency, headings[h], options.gravity, options.depth);
    const auto response = frequency_responses(c, surface, beach, options.gravity, {{frequency}}, {&v, 1});
    const Eigen::MatrixXcd weighted = weight.cast<Complex>().asDiagonal() * response.front().hull;
    const Eigen::MatrixXcd F = Complex(0.0, -frequency) * (modes.normal.transpose().cast<Complex>() * weighted);
    for (std::size_t k = 0; k < modes.modes.size(); ++k)
      for (int h = 0; h < count; ++h)
        X(modes.modes[k], h) = F(k, h) * phase_at_origin(layout.hulls[modes.modes[k] / 6], frequency, headings[h],
                                                         options.gravity, options.depth);
  }
  return to_middle(layout).transpose().cast<Complex>() * X;
}

}  // namespace stillhook
