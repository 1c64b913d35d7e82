// Two boxes side by side on deep water, each 40 m long, 10 m broad and 4 m deep, 4 m apart, by another code.
//
// Capytaine 3.0.0 (M. Ancellin and F. Dias, J. Open Source Softw. 4(36), 1341, 2019), a boundary element method with the
// free-surface Green function after Delhommeau: no panels on the water, no damping of the gap, and nothing in common
// with panels of Rankine sources. 1,104 panels a box; a quarter as many change the values at 1.0 and 1.3 rad/s by 4 %, those
// beside the resonance (1.15) by 6 % and those on it (1.2) by a fifth. Density 1025 kg/m3, gravity 9.80665 m/s2.
#pragma once

namespace stillhook::truth {

/// Added mass over rho V and radiation damping over rho V w of the first box in sway (1) and heave (2), and of what the
/// motion of the second (3: sway, 4: heave) does to it. V = 1600 m3.
struct TwoBoxes {
  double frequency;  // rad/s
  double A11, A13, A22, A24, A12;
  double B11, B13, B22, B24;
};

inline constexpr TwoBoxes kTwoBoxes[] = {
    {1.00, 1.85707, -1.23680, 1.33515, 0.33188, -0.56391, 0.41818, 0.07332, 0.63075, 0.39056},
    {1.15, 4.53017, -4.08386, 1.51466, 0.58028, -1.64362, 2.69019, -2.20190, 1.31111, 1.13713},
    {1.20, -1.95024, 2.35266, -0.40206, -1.32727, 2.04673, 7.60416, -7.13694, 1.36142, 1.21043},
    {1.30, -1.31189, 1.65591, 0.63297, -0.28616, 0.73315, 0.83440, -0.41843, 0.08391, -0.02830}};

}  // namespace stillhook::truth
