// Added mass and damping of a floating hemisphere, centre at the still water plane, deep water: exact linear solution by
// multipole expansion (Ursell 1949; Havelock 1955), values in heave as printed by Hulme (1982, J. Fluid Mech. 121,
// 443-463, table 1); surge by the same method, own computation. A over rho 2/3 pi a^3, B over that times omega.
#pragma once

#include <array>

namespace stillhook::truth {

struct Hemisphere {
  double Ka, A_heave, B_heave, A_surge, B_surge;
};
inline constexpr std::array<Hemisphere, 8> kHemisphere{{{0.2, 0.79383, 0.27930, 0.55153, 0.00815},
                                                        {0.4, 0.64519, 0.34101, 0.61752, 0.05572},
                                                        {0.6, 0.53810, 0.32712, 0.65862, 0.15156},
                                                        {0.8, 0.46979, 0.28989, 0.64212, 0.26531},
                                                        {1.0, 0.42843, 0.24840, 0.57395, 0.35349},
                                                        {1.2, 0.40473, 0.20957, 0.48599, 0.39784},
                                                        {1.4, 0.39235, 0.17562, 0.40375, 0.40609},
                                                        {1.6, 0.38714, 0.14687, 0.33711, 0.39289}}};
// Largest values over all Ka, of which the damping's tolerance is a share.
inline constexpr double kMostHeaveDamping = 0.3417, kMostSurgeDamping = 0.4061;
// Limits: infinite frequency, and zero (heave 0.8310, surge 0.5).
inline constexpr double kHeaveInfinite = 0.5, kSurgeInfinite = 0.2732, kHeaveZero = 0.8310, kSurgeZero = 0.5;

}  // namespace stillhook::truth
