// What passes a body: the wind above the water or the current in it.
//
//   wind     u = (U(z) + u'(z, t)) (cos b, sin b, 0), z above still water                                     (gusts.h)
//   current  u = U(d) (cos b(d), sin b(d), 0),        d = zeta(x, y, t) - z below the surface of the moment
//
// U(z) and u' of the wind: gusts.h. Profiles of the current, U0 at the surface of water of depth h:
//   power    U = U0 (1 - d/h)^a, a = 1/7 by default: tidal streams       uniform  U = U0
//   table    linear in the components of the velocity between the layers, constant outside
// The power holds down to a hundredth of the depth above the bed. The water's own motion in the waves is not in the
// current, nor are waves longer or steeper for it.
#pragma once

#include <memory>
#include <span>

#include "sim/environment/current_spec.h"
#include "sim/environment/gusts.h"
#include "sim/sea/wave_field.h"

namespace stillhook {

/// A fluid at a place.
struct StreamPoint {
  Vector3 velocity = Vector3::Zero();         // m/s, in W
  Matrix3 by_place = Matrix3::Zero();         // 1/s, its derivative by the place in W
  double inside = 0.0;                        // m, how far the place lies within the fluid; < 0 outside
  Vector3 inside_by_place = Vector3::Zero();  // 1
};

class Stream {
 public:
  virtual ~Stream() = default;
  virtual StreamPoint at(const Vector3& p_W, const Instant& now, std::span<double> memory) const = 0;
  /// Numbers that at() wants to keep from one question to the next, zero at first.
  virtual int memory_size() const { return 0; }
  /// The velocity that a floating hull meets: at a fixed height above (wind) or depth below (current) the mean surface.
  virtual Vector3 at_hull(double distance, const Instant& now, std::span<double> memory) const = 0;
  virtual double density() const = 0;  // kg/m3
  virtual bool same_as(const Stream& other) const = 0;
};

class WindStream final : public Stream {
 public:
  /// Gusts of the seed that grow over `ramp` (s). Throws SpecificationError("wind").
  WindStream(const WindSpec& wind, int seed, double ramp);
  StreamPoint at(const Vector3& p_W, const Instant& now, std::span<double> memory) const override;
  int memory_size() const override { return gusts_.none() ? 0 : Gusts::kMemory; }
  Vector3 at_hull(double distance, const Instant& now, std::span<double> memory) const override;
  double density() const override { return wind_.density; }
  bool same_as(const Stream& other) const override;

 private:
  WindSpec wind_;
  Gusts gusts_;
  Vector3 direction_;
};

class CurrentStream final : public Stream {
 public:
  /// In water of `depth` (m, 0 = no bed). Throws SpecificationError("sea.current").
  CurrentStream(const CurrentSpec& current, std::shared_ptr<const WaveField> waves, double depth, double density);
  StreamPoint at(const Vector3& p_W, const Instant& now, std::span<double> memory) const override;
  Vector3 at_hull(double distance, const Instant& now, std::span<double> memory) const override;
  double density() const override { return density_; }
  bool same_as(const Stream& other) const override;

 private:
  struct Velocity {
    Vector3 value, by_depth;  // m/s, 1/s
  };
  Velocity at_depth(double d, const Instant& now) const;
  Velocity in_table(double d, const Instant& now) const;

  CurrentSpec current_;
  std::shared_ptr<const WaveField> waves_;
  double depth_, density_;
  Vector3 surface_ = Vector3::Zero();  // m/s
};

}  // namespace stillhook
