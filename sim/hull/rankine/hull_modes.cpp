#include "sim/hull/rankine/hull_modes.h"

#include <cmath>

#include "sim/sea/dispersion.h"

namespace stillhook::rankine {

ClassModes modes_of(const HullPanels& panels, const Layout& layout, const Parity& parity) {
  ClassModes result;
  const int count = 6 * static_cast<int>(layout.hulls.size());
  for (int mode = 0; mode < count; ++mode)
    if (mode_parity(panels.symmetry, mode % 6) == parity) result.modes.push_back(mode);
  result.normal.resize(panels.panels.size(), result.modes.size());
  for (std::size_t k = 0; k < result.modes.size(); ++k) {
    const int hull = result.modes[k] / 6;
    result.normal.col(k) = mode_normal(panels, hull, result.modes[k] % 6, layout.hulls[hull].reference);
  }
  return result;
}

VectorX panel_weights(const HullPanels& panels, double density) {
  VectorX weight(panels.panels.size());
  for (int i = 0; i < weight.size(); ++i) weight(i) = density * panels.panels[i].area * panels.symmetry.images();
  return weight;
}

MatrixX inertia_of(const MatrixX& response, const ClassModes& modes, const VectorX& weight) {
  return -modes.normal.transpose() * weight.asDiagonal() * (response * modes.normal);
}

Eigen::VectorXcd incident_velocity(const HullPanels& panels, const Parity& parity, double frequency, double heading,
                                   double gravity, double depth) {
  using Complex = std::complex<double>;
  const double k = wave_number(frequency, gravity, depth), c = std::cos(heading), s = std::sin(heading);
  const double bed = bed_reflection(k, depth);
  Eigen::VectorXcd v = Eigen::VectorXcd::Zero(panels.panels.size());
  // cosh k(z + h)/cosh kh as a part that falls with the depth and one that comes back from the bed.
  for (const int upwards : {1, -1}) {
    const Complex amplitude(0.0, -gravity / frequency * (upwards > 0 ? 1.0 : bed) / (1.0 + bed));
    if (amplitude == 0.0) continue;
    for (int image = 0; image < 4; ++image) {
      if (((image & 1) && !panels.symmetry.x) || ((image & 2) && !panels.symmetry.y)) continue;
      const double mx = image & 1 ? -1.0 : 1.0, my = image & 2 ? -1.0 : 1.0;
      const double sign = (image & 1 ? parity.x : 1) * (image & 2 ? parity.y : 1);
      for (std::size_t j = 0; j < panels.panels.size(); ++j) {
        const Vector3 &x = panels.panels[j].centroid, &n = panels.panels[j].normal;
        // Mean over the panel to second order in k times its size: exp(K.r), K = k (i cos b, i sin b, +-1).
        const Eigen::Vector3cd K(Complex(0.0, k * mx * c), Complex(0.0, k * my * s), upwards * k);
        const Complex spread = 0.5 * (K.transpose() * panels.panels[j].moment * K)(0) / panels.panels[j].area;
        const Complex phi = amplitude * std::exp(K.x() * x.x() + K.y() * x.y() + K.z() * x.z() + spread);
        v(j) += sign * k * phi * Complex(upwards * n.z(), mx * n.x() * c + my * n.y() * s);
      }
    }
  }
  return v / panels.symmetry.images();
}

std::complex<double> phase_at_origin(const Placement& hull, double frequency, double heading, double gravity,
                                     double depth) {
  const double k = wave_number(frequency, gravity, depth);
  return std::polar(1.0, -k * (hull.Bo_x * std::cos(heading) + hull.Bo_y * std::sin(heading)));
}

}  // namespace stillhook::rankine
