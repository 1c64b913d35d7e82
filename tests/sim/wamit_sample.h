// WAMIT files of a made-up hull, small enough to compute every number by hand.
#pragma once

#include <catch2/catch.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "sim/hull/coefficients/wamit_file.h"
#include "tests/sim/temporary_folder.h"

namespace stillhook {

namespace wamit_sample {

// Two coupled modes at 0.5, 1 and 1.5 rad/s, in the order and with the digits WAMIT prints.
inline const char* const kRadiation =
    " -0.100000E+01     3     3  0.200000E+01\n"                   // 1
    " -0.100000E+01     3     5 -0.500000E+00\n"                   // 2
    " -0.100000E+01     5     3 -0.500000E+00\n"                   // 3
    " -0.100000E+01     5     5  0.400000E+01\n"                   // 4
    "  0.000000E+00     3     3  0.100000E+01\n"                   // 5
    "  0.000000E+00     3     5 -0.250000E+00\n"                   // 6
    "  0.000000E+00     5     3 -0.250000E+00\n"                   // 7
    "  0.000000E+00     5     5  0.300000E+01\n"                   // 8
    "  0.125663706144E+02     3     3  0.125D+01  0.500000E+00\n"  // 9
    "  0.125663706144E+02     3     5 -0.300000E+00  0.100000E+00\n"
    "  0.125663706144E+02     5     3 -0.300000E+00  0.100000E+00\n"
    "  0.125663706144E+02     5     5  0.350000E+01  0.250000E+00\n"
    "  0.628318530718E+01     3     3  0.110000E+01  0.300000E+00\n"
    "  0.628318530718E+01     3     5 -0.300000E+00  0.100000E+00\n"
    "  0.628318530718E+01     5     3 -0.300000E+00  0.100000E+00\n"
    "  0.628318530718E+01     5     5  0.350000E+01  0.250000E+00\n"
    "  0.418879020479E+01     3     3  0.105000E+01  0.100000E+00\n"
    "  0.418879020479E+01     3     5 -0.300000E+00  0.100000E-100\n"
    "  0.418879020479E+01     5     3 -0.300000E+00  0.100000-100\n"
    "  0.418879020479E+01     5     5  0.350000E+01  0.100000E+00\n";  // 20

/// 0.8 + 0.6 i in the even modes, 0.3 i in the odd ones at 90 deg.
inline std::string excitation(const std::vector<std::string>& headings = {"0", "90", "180"}) {
  std::string text;
  for (const std::string& b : headings)
    for (int i = 1; i <= 6; ++i) {
      text += "  0.628318530718E+01  " + b + "  " + std::to_string(i);
      if (i % 2 == 1)
        text += "  1.0  36.8698976458  0.8  0.6\n";
      else
        text += b == "90" ? "  0.3  90.0  0.0  0.3\n" : "  0.0  0.0  0.0  0.0\n";
    }
  return text;
}

inline const char* const kRestoring = "     3     3  0.120000E+02\n     3     5  0.000000E+00\n     5     5  0.700000E+02\n";

inline WamitUnits units() {
  WamitUnits u;
  u.ulen = 2.0;
  u.density = 1000.0;
  u.gravity = 10.0;
  return u;
}

inline DatabaseFrame frame() {
  DatabaseFrame f;
  f.bodies = {{Vector3::Zero(), 20.0}};
  f.length = 8.0;
  f.port_starboard = true;
  f.retardation = {10.0, 0.1};
  return f;
}

struct Files {
  TemporaryFolder folder;
  std::string base = folder / "hull";
  explicit Files(const std::string& radiation = kRadiation, const std::string& forces = excitation(),
                 const std::string& restoring = kRestoring) {
    folder.write("hull.1", radiation);
    folder.write("hull.3", forces);
    if (!restoring.empty()) folder.write("hull.hst", restoring);
  }
};

inline std::string replaced(std::string text, const std::string& old, const std::string& fresh) {
  const std::size_t at = text.find(old);
  REQUIRE(at != std::string::npos);
  return text.replace(at, old.size(), fresh);
}

/// The rows of kRadiation without those of infinite frequency.
inline std::string without_infinite() {
  std::istringstream in(kRadiation);
  std::string line, text;
  while (std::getline(in, line))
    if (line.find("  0.000000E+00") != 0) text += line + "\n";
  return text;
}

}  // namespace wamit_sample

}  // namespace stillhook
