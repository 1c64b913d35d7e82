// Units of case keys. The suffix stands in the key ("speed_max_m_per_min"), the text in messages and documents
// ("m/min"), and a value times the factor is in SI and radians.
#pragma once

#include <string>

namespace stillhook {

struct Unit {
  std::string suffix, text;
  double factor = 1.0;
};

namespace unit {

inline constexpr double kRadPerDeg = 3.14159265358979323846 / 180.0;
inline constexpr double kPerMin = 1.0 / 60.0;

inline const Unit one{"", "", 1.0};
inline const Unit share{"share", "", 1.0};
inline const Unit m{"m", "m", 1.0};
inline const Unit mm{"mm", "mm", 1e-3};
inline const Unit m2{"m2", "m2", 1.0};
inline const Unit s{"s", "s", 1.0};
inline const Unit h{"h", "h", 3600.0};
inline const Unit day{"days", "days", 86400.0};
inline const Unit deg{"deg", "deg", kRadPerDeg};
inline const Unit t{"t", "t", 1e3};
inline const Unit t_m2{"t_m2", "t m2", 1e3};
inline const Unit t_m{"t_m", "t, t m, t m2", 1e3};
inline const Unit kg_per_m3{"kg_per_m3", "kg/m3", 1.0};
inline const Unit m_per_s{"m_per_s", "m/s", 1.0};
inline const Unit m_per_s2{"m_per_s2", "m/s2", 1.0};
inline const Unit m_per_min{"m_per_min", "m/min", kPerMin};
inline const Unit rad_per_s{"rad_per_s", "rad/s", 1.0};
inline const Unit deg_per_s{"deg_per_s", "deg/s", kRadPerDeg};
inline const Unit deg_per_s2{"deg_per_s2", "deg/s2", kRadPerDeg};
inline const Unit share_per_min{"share_per_min", "1/min", kPerMin};
inline const Unit share_per_s2{"share_per_s2", "1/s2", 1.0};
inline const Unit kN{"kN", "kN", 1e3};
inline const Unit N_per_m{"N_per_m", "N/m", 1.0};
inline const Unit kN_per_m{"kN_per_m", "kN/m", 1e3};
inline const Unit kN_s_per_m{"kN_s_per_m", "kN s/m", 1e3};
inline const Unit kN_s2_per_m2{"kN_s2_per_m2", "kN s2/m2", 1e3};
inline const Unit kN_m_per_rad{"kN_m_per_rad", "kN m/rad", 1e3};
inline const Unit kN_m_s_per_rad{"kN_m_s_per_rad", "kN m s/rad", 1e3};
inline const Unit kN_m_s2_per_rad2{"kN_m_s2_per_rad2", "kN m s2/rad2", 1e3};
inline const Unit kN_m{"kN_m", "kN/m, kN, kN m", 1e3};
inline const Unit kN_s_m{"kN_s_m", "kN s/m, kN s, kN m s", 1e3};
inline const Unit kN_per_deg{"kN_per_deg", "kN/deg", 1e3 / kRadPerDeg};
inline const Unit kN_s_per_deg{"kN_s_per_deg", "kN s/deg", 1e3 / kRadPerDeg};

}  // namespace unit
}  // namespace stillhook
