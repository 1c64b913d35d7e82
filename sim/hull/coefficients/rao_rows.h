// The rows of a file of displacement RAOs, in SI and with phases after the crest; headings, signs, reference point and
// phase origin still those of the file (rao_table.h does the rest).
//
// CSV: a line of names and one row for each period and heading, in any order, "#" opens a comment. The units are in the
// names:
//
//   period_s | frequency_rad_per_s | frequency_hz          heading_deg | heading_rad
//   surge_m_per_m, sway_m_per_m, heave_m_per_m             roll_deg_per_m | roll_rad_per_m | roll_per_slope, ...
//   surge_phase_deg | surge_phase_rad, ...                 per_slope: of the slope k a of the wave, rad/rad = deg/deg
//
// WAMIT: <base>.4, rows PER BETA I Mod Pha Re Im with translations per amplitude and rotations times ULEN per
// amplitude; PER and BETA as in wamit_file.h, Pha a lead (of exp(+i w t)).
#pragma once

#include <array>
#include <string>
#include <vector>

#include "sim/hull/rao_spec.h"

namespace stillhook {

struct RaoRow {
  int line = 0;
  double frequency = 0.0;             // rad/s
  double heading = 0.0;               // rad, as the file means it
  std::array<double, 6> amplitude{};  // m/m, rad/m
  std::array<double, 6> lag{};        // rad behind the crest at the phase origin
};

struct RaoRows {
  std::string path;
  std::vector<RaoRow> rows;
  [[noreturn]] void fail(int line, const std::string& sentence) const;
};

/// Both throw SpecificationError("<path>:<line>").
RaoRows read_rao_csv(const RaoSpec& spec, double gravity, double depth);
RaoRows read_rao_wamit(const RaoSpec& spec);

}  // namespace stillhook
