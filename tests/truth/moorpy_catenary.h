// Loads of elastic catenaries as MoorPy's own test set gives them (NREL/MoorPy, tests/test_catenary.py).
#pragma once

#include <array>

namespace stillhook::truth {

struct CatenaryRow {
  double x, z, length, axial_stiffness, weight, friction;  // m, m, m, N, N/m, 1
  bool on_seabed;
  double H, V, grounded;  // N, N, m at the upper end
};

inline constexpr std::array<CatenaryRow, 5> kMoorPyCatenaries{{
    {400.0, 200.0, 500.0, 7.51e12, 800.0, 5.0, true, 96643.43501616362, 237751.75997440016, 202.81030003199982},
    {400.0, 200.0, 500.0, 7.51e12, 800.0, 0.0, true, 96643.42815934008, 237751.75535996316, 202.81030580004602},
    {400.0, 200.0, 500.0, 7.51e12, 800.0, 0.1, true, 96643.42877136687, 237751.75577183915, 202.81030528520108},
    // The lower end hangs above the seabed (their friction is minus its height).
    {400.0, 200.0, 500.0, 7.51e12, 200.0, 0.0, false, 43694.580989249596, 77634.40064978378, 0.0},
    {89.9, 59.2, 130.0, 7.51e8, 881.05, 0.0, false, 31373.229006023103, 87886.15872988368, 0.0},
}};

}  // namespace stillhook::truth
