// What a case says about the sea. SI and radians.
#pragma once

#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sim/environment/current_spec.h"

namespace stillhook {

/// Energy over frequency and direction, as a hindcast or a buoy gives it, in our sense of direction.
struct DirectionalSpectrum {
  std::vector<double> frequency;  // rad/s, rising
  std::vector<double> heading;    // rad, travels towards it, from +x counter-clockwise; even steps once round, rising
  std::vector<double> density;    // m2 s/rad2, >= 0: [frequency * headings + heading], linear between frequencies
  std::string source;             // what was read, in words
};

/// The surface at one place, measured.
struct ElevationRecord {
  double step = 0.0;              // s, between values
  std::vector<double> elevation;  // m
  std::string source;             // what was read, in words
};

/// How the file of a 2-D spectrum is to be read (problems/spectra).
struct SpectrumFileSpec {
  enum class Format { automatic, wavespectra, ww3, era5, swan };
  std::string file;
  Format format = Format::automatic;
  std::string time = "0";           // index from 0, or a time as ISO 8601
  std::vector<double> point;        // index from 0 alone, or latitude and longitude, deg; empty: the only one
  double bearing_of_x = 0.0;        // rad, compass bearing that the world's +x points to, clockwise from north
  double scale_to_height = 0.0;     // m, Hs that the spectrum is scaled to; 0 = as the file has it
};

/// How the file of a measured elevation is to be read.
struct RecordFileSpec {
  enum class Unit { metres, centimetres, feet };
  std::string file;
  std::string column;               // its name in the first line
  Unit unit = Unit::metres;
  std::array<double, 2> point = {0.0, 0.0};  // m, where it was measured, in W
  double lowest = 0.0;              // rad/s, longer waves are left out
  double highest = std::numeric_limits<double>::infinity();  // rad/s, shorter ones are
};

struct SeaStateSpec {
  enum class Type { calm, regular, jonswap, pierson_moskowitz, ochi_hubble, spectrum, record, sum };
  std::string name;
  Type type = Type::calm;
  double amplitude = 0.0;       // m, regular
  double frequency = 0.0;       // rad/s, regular
  double phase = 0.0;           // rad, lag of the crest at the world origin at t = 0, regular
  double significant_height = 0.0;  // m, irregular
  double peak_period = 0.0;     // s, irregular
  double gamma = 0.0;           // 1, JONSWAP peakedness; 0 = by the DNV rule from Hs and Tp
  double lambda = 1.0;          // 1, shape of Ochi & Hubble's spectrum
  double heading = 0.0;         // rad, direction the waves travel towards, from +x counter-clockwise
  double spreading = 0.0;       // exponent n of cos^n; 0 = long-crested
  double spreading_2s = 0.0;    // s of cos^2s of half the angle; 0 = long-crested
  int components = 60;          // irregular: number of frequencies
  int directions = 1;           // irregular: number of directions, > 1 only with spreading
  int waves = 300;              // of a 2-D spectrum
  int seed = 1;                 // irregular: phases come from this index
  std::optional<int> part_seed; // of a part of a sum; without it the sum's seed and the part's place count
  SpectrumFileSpec spectrum_file;
  std::shared_ptr<const DirectionalSpectrum> spectrum;  // what stands in it
  RecordFileSpec record_file;
  std::shared_ptr<const ElevationRecord> record;
  std::vector<SeaStateSpec> parts;  // of a sum

  /// The phases of its waves are drawn from a seed.
  bool seeded() const {
    for (const SeaStateSpec& part : parts)
      if (type == Type::sum && part.seeded()) return true;
    return type == Type::jonswap || type == Type::pierson_moskowitz || type == Type::ochi_hubble ||
           type == Type::spectrum;
  }
  /// One heading says where all its waves go or, of a short-crested sea, go on the whole.
  bool has_heading() const { return type != Type::calm && type != Type::spectrum && type != Type::sum; }
};

struct SeaSpec {
  std::string active;           // name of the state used
  double ramp = 30.0;           // s, the waves grow smoothly from nothing over this time
  double density = 1025.0;      // kg/m3
  double gravity = 9.80665;     // m/s2
  double depth = 0.0;           // m, 0 = deep; of the moorings and the waves
  bool deep_waves = false;      // the waves are those of deep water whatever the depth
  CurrentSpec current;
  std::vector<SeaStateSpec> states;

  /// m, the depth that the waves feel; infinite in deep water.
  double wave_depth() const {
    return depth > 0.0 && !deep_waves ? depth : std::numeric_limits<double>::infinity();
  }
  /// The state used, nullptr for calm water.
  const SeaStateSpec* active_state() const {
    for (const SeaStateSpec& state : states)
      if (state.name == active) return &state;
    return nullptr;
  }
};

}  // namespace stillhook
