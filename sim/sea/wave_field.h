// Linear waves as a sum of components over a flat bed, with Wheeler's stretching of all that they do in the water.
//
//   zeta(x, y, t) = r(t) sum_j a_j cos(th_j),  th_j = k_j (x cos b_j + y sin b_j) - w_j t + e_j,  w_j^2 = g k_j tanh k_j h
//   p_dyn/(rho g)  = r(t) sum_j a_j C_j(z') cos(th_j)     so the total pressure is zero on z = zeta
//   u = sum_j a_j w_j cosh k_j(z' + h) / sinh k_j h  cos(th_j) (cos b_j, sin b_j),   w = the same with sinh and sin
//   C_j(z') = cosh k_j(z' + h) / cosh k_j h,   z' = h (z - zeta) / (h + zeta):  the surface becomes 0, the bed stays
//   deep water:  C_j = exp(k_j z'),  z' = z - zeta,  k_j = w_j^2 / g
//
// r(t) is a smooth ramp (C2) from 0 to 1. Heading b is the direction the wave travels towards. A field none of whose
// components feels the bed (dispersion.h) is one of deep water. (Faltinsen 1990, ch. 2; Wheeler 1970)
#pragma once

#include <array>
#include <limits>
#include <span>
#include <vector>

#include "sim/sea/sea_spec.h"
#include "sim/spatial/pose.h"

namespace stillhook {

struct WaveComponent {
  double amplitude;     // m
  double frequency;     // rad/s
  double wavenumber;    // 1/m
  double cos_heading, sin_heading;
  double phase;         // rad, added to theta
  bool operator==(const WaveComponent&) const = default;
};

/// Elevation and pressure head at points, and their spatial gradients. Arrays of equal length, structure of arrays.
struct WaveSamples {
  std::span<double> elevation;                  // m, zeta at (x, y)
  std::span<double> elevation_x, elevation_y;   // 1, d zeta/dx, d zeta/dy
  std::span<double> head;                       // m, (p - p_atm)/(rho g) = zeta-stretched dynamic head - z; 0 at z = zeta
  std::span<double> head_x, head_y, head_z;     // 1, total gradient of head
};

/// How the water's motion is carried to the moving surface: `wheeler` as above, which all pressures take; `vertical` as
/// it is below z = 0 and as it is there above, the usual alternative for slender members.
enum class Stretching { wheeler, vertical };

/// Of the undisturbed water at a point.
struct WaterMotion {
  Vector3 velocity = Vector3::Zero();      // m/s
  Vector3 acceleration = Vector3::Zero();  // m/s2, local (d/dt at the stretched place), without convection
};

class WaveField {
 public:
  WaveField() = default;  // calm
  /// depth: of the still water, m. The components' wave numbers must be those of this depth.
  WaveField(std::vector<WaveComponent> components, double ramp,
            double depth = std::numeric_limits<double>::infinity());

  bool operator==(const WaveField&) const = default;
  bool calm() const { return components_.empty(); }
  const std::vector<WaveComponent>& components() const { return components_; }
  /// No component feels the bed.
  bool deep() const { return depth_ == std::numeric_limits<double>::infinity(); }
  /// m; infinite where deep().
  double depth() const { return depth_; }

  /// r(t).
  double ramp(double t) const;
  /// r(t), r'(t) (1/s) and r''(t) (1/s2).
  std::array<double, 3> ramp_derivatives(double t) const;

  /// Elevation (m) at (x, y) (m) and time t (s).
  double elevation(double x, double y, double t) const;

  /// Fills elevation, head and, when `gradients`, the gradients. Above the surface the head is continued linearly:
  /// head = zeta - z. Points: x, y, z in W, m. An empty out.head means that only the elevation is wanted.
  void sample(double t, std::span<const double> x, std::span<const double> y, std::span<const double> z,
              bool gradients, const WaveSamples& out) const;

  /// Velocity and acceleration of the undisturbed water at p_W (m, in W). Above the surface those at the surface, below
  /// the bed those at the bed.
  WaterMotion motion(const Vector3& p_W, double t, Stretching stretching = Stretching::wheeler) const;
  /// The two alone, m/s and m/s2.
  Vector3 velocity(const Vector3& p_W, double t, Stretching stretching = Stretching::wheeler) const;
  Vector3 acceleration(const Vector3& p_W, double t, Stretching stretching = Stretching::wheeler) const;

 private:
  double stretched_height(const Vector3& p_W, double t, Stretching stretching) const;

  std::vector<WaveComponent> components_;
  double ramp_ = 0.0;
  double depth_ = std::numeric_limits<double>::infinity();
};

/// The wave field of one sea state in water of a depth (m); irregular seas draw phases (and amplitudes are
/// deterministic) from state.seed. Throws SpecificationError("sea.states.<name>") for a sea that cannot be.
WaveField build_wave_field(const SeaStateSpec& state, double gravity, double ramp,
                           double depth = std::numeric_limits<double>::infinity());

/// That of the active state of a case; calm when there is none.
WaveField build_wave_field(const SeaSpec& sea);

}  // namespace stillhook
