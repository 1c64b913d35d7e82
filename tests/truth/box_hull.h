// Coefficients of a box barge 110 x 46 m, draft 4 m, deep water, rho 1025 kg/m3, g 9.80665 m/s2, about the origin at
// midship, centreplane and water plane: linear Richardson extrapolation in panel size of two meshes of the
// frequency-domain code Capytaine (2,420 and 6,016 panels; a second code agrees within 0.7 %).
#pragma once

#include <array>

namespace stillhook::truth {

struct BoxHull {
  double frequency;         // rad/s
  std::array<double, 6> A;  // kg, kg m2
  std::array<double, 6> B;
};
inline constexpr std::array<BoxHull, 4> kBoxHull{
    {{0.4,
      {2.409684e6, 6.411438e6, 1.207072e8, 9.103722e9, 8.872513e10, 4.778326e9},
      {1.194785e5, 2.220599e5, 2.647073e7, 2.374060e8, 4.874516e9, 1.029879e7}},
     {0.571,
      {2.366246e6, 6.871617e6, 8.930868e7, 8.818902e9, 7.790845e10, 5.717520e9},
      {4.721658e5, 1.478625e6, 3.367567e7, 1.230765e9, 1.556687e10, 3.160303e8}},
     {0.8,
      {2.187964e6, 4.761100e6, 7.041913e7, 6.780271e9, 5.826232e10, 5.636406e9},
      {1.126534e6, 3.616829e6, 2.934487e7, 1.979319e9, 2.040243e10, 2.502855e9}},
     {1.0,
      {1.450397e6, 3.041117e6, 6.818368e7, 5.965594e9, 5.110503e10, 4.013104e9},
      {1.878924e6, 4.685055e6, 2.148925e7, 1.659296e9, 1.612873e10, 3.677686e9}}}};

struct BoxExcitation {
  double frequency, heading;  // rad/s, deg towards
  int mode;                   // 0..5
  double amplitude, phase;    // N/m or N m/m, deg, lag behind the crest at the origin
};
inline constexpr std::array<BoxExcitation, 15> kBoxExcitation{{{0.571, 45.0, 0, 2.599462e6, -108.696},
                                                               {0.571, 45.0, 1, 3.475233e6, -90.861},
                                                               {0.571, 45.0, 2, 1.816876e7, -51.722},
                                                               {0.571, 45.0, 3, 9.745556e7, 89.110},
                                                               {0.571, 45.0, 4, 4.288965e8, -110.955},
                                                               {0.571, 45.0, 5, 8.108489e7, -0.072},
                                                               {0.571, 90.0, 1, 6.104996e6, -91.309},
                                                               {0.571, 90.0, 2, 2.387417e7, -50.014},
                                                               {0.571, 90.0, 3, 1.794503e8, 88.714},
                                                               {0.8, 90.0, 1, 7.137844e6, -112.085},
                                                               {0.8, 90.0, 2, 1.807662e7, -89.782},
                                                               {0.8, 90.0, 3, 1.758010e8, 69.013},
                                                               {1.0, 90.0, 1, 6.851500e6, -152.316},
                                                               {1.0, 90.0, 2, 1.253648e7, -138.607},
                                                               {1.0, 90.0, 3, 1.378969e8, 33.720}}};

}  // namespace stillhook::truth
