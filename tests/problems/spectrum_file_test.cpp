// 2-D spectra and records from files: the conventions of each format, and what is refused.
#include "problems/spectra/sea_files.h"

#include <unistd.h>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <numbers>

#include "problems/spectra/elevation_file.h"
#include "problems/spectra/raw_spectrum.h"
#include "results/netcdf_file.h"
#include "sim/body_spec.h"
#include "sim/sea/sea_statistics.h"
#include "sim/sea/spectrum.h"
#include "sim/sea/wave_record.h"

namespace stillhook {
namespace {

namespace fs = std::filesystem;
using Catch::Matchers::Contains;
using Format = SpectrumFileSpec::Format;

constexpr double kDeg = std::numbers::pi / 180.0, kTurn = 2.0 * std::numbers::pi, kRho = 1025.0, kG = 9.80665;

/// A file of one test, gone with it.
struct Scratch {
  explicit Scratch(const std::string& name)
      : folder(fs::temp_directory_path() / ("stillhook-spectra-" + std::to_string(::getpid()))),
        path((fs::create_directories(folder), folder / name).string()) {
    fs::remove(path);
  }
  ~Scratch() { fs::remove_all(folder); }
  void write(const std::string& text) const { std::ofstream(path, std::ios::binary) << text; }
  fs::path folder;
  std::string path;
};

/// What a NetCDF file of the test holds: energy by the compass direction that waves travel to.
struct Made {
  std::string variable = "efth", frequency_name = "freq", direction_name = "dir", unit, direction_unit = "degree",
              standard_name, convention;
  std::vector<double> frequency, stored;                  // Hz; directions as they stand in the file
  std::function<double(std::size_t, std::size_t)> value;  // stored
  bool axes = true;                                       // variables for frequency and direction
};

void make(const std::string& path, const Made& m) {
  NetcdfFile file(path, NetcdfFile::Mode::create, path);
  const int time = file.define_dimension("time", 2), f = file.define_dimension(m.frequency_name, m.frequency.size()),
            d = file.define_dimension(m.direction_name, m.stored.size());
  const int times = file.define("time", NC_DOUBLE, {time}, "time", "hours since 2026-11-30 00:00:00");
  const int density = file.define(m.variable, NC_DOUBLE, {time, f, d}, "energy", m.unit);
  int of_f = -1, of_d = -1;
  if (m.axes) {
    of_f = file.define(m.frequency_name, NC_DOUBLE, {f}, "frequency", "Hz");
    of_d = file.define(m.direction_name, NC_DOUBLE, {d}, "direction", m.direction_unit);
    if (!m.standard_name.empty()) file.attribute(of_d, "standard_name", m.standard_name);
  }
  if (!m.convention.empty()) file.attribute(NetcdfFile::kGlobal, "Directional_convention", m.convention);
  file.put(times, std::vector<double>{0.0, 6.0});
  if (m.axes) file.put(of_f, m.frequency), file.put(of_d, m.stored);
  std::vector<double> values;
  for (const double share : {1.0, 0.25})  // half the height at the second time
    for (std::size_t i = 0; i < m.frequency.size(); ++i)
      for (std::size_t j = 0; j < m.stored.size(); ++j) {
        const double v = m.value(i, j);
        values.push_back(m.variable == "d2fd" ? v + std::log10(share) : share * v);
      }
  file.put(density, values);
  file.close();
}

std::vector<double> compass(double step, double first = 0.0) {
  std::vector<double> d;
  for (double a = 0.0; a < 360.0 - 1e-9; a += step) d.push_back(first + a);
  return d;
}

SpectrumFileSpec spec_of(const std::string& path, double bearing_deg = 0.0, Format format = Format::automatic) {
  SpectrumFileSpec spec;
  spec.file = path;
  spec.format = format;
  spec.bearing_of_x = bearing_deg * kDeg;
  return spec;
}

DirectionalSpectrum read(const SpectrumFileSpec& spec) { return read_spectrum_file(spec, kRho, kG); }

SeaStatistics told(const DirectionalSpectrum& spectrum) {
  SeaStateSpec s;
  s.name = "sea";
  s.type = SeaStateSpec::Type::spectrum;
  s.spectrum = std::make_shared<const DirectionalSpectrum>(spectrum);
  return sea_statistics(s).back();
}

std::string refusal(const std::function<void()>& f) {
  try {
    f();
  } catch (const FileError& error) {
    return error.what();
  }
  return "";
}

/// One bin holds the energy: frequency 0.1 Hz, the direction at `stored` degrees in the file's own sense.
Made one_bin(double stored, double unit_value) {
  Made m;
  m.frequency = {0.08, 0.1, 0.12};
  m.stored = compass(10.0);
  m.value = [=, directions = m.stored](std::size_t i, std::size_t j) {
    return i == 1 && std::abs(directions[j] - stored) < 1e-9 ? unit_value : 0.0;
  };
  return m;
}

TEST_CASE("one bin of energy has the same direction and height in every format") {
  // Waves from 200 deg, which travel to 20 deg by compass; +x points to 60 deg: heading 40 deg. 1 m2/(Hz rad) in a bin
  // of 10 deg, a triangle over 0.04 Hz: m0 = 0.02 * 10 deg.
  const double m0 = 0.02 * 10.0 * kDeg, heading = 40.0;
  const auto check = [&](const std::string& path, Format format) {
    for (const Format as : {Format::automatic, format}) {
      const SeaStatistics s = told(read(spec_of(path, 60.0, as)));
      CHECK(s.significant_height == Approx(4.0 * std::sqrt(m0)).epsilon(1e-9));
      CHECK(s.heading / kDeg == Approx(heading).epsilon(1e-9));
      CHECK(s.peak_period == Approx(10.0).epsilon(1e-12));
      CHECK(s.spread < 1e-6);
    }
  };
  SECTION("wavespectra: from, per degree") {
    const Scratch f("a.nc");
    Made m = one_bin(200.0, kDeg);
    m.unit = "m2 s degree-1";
    m.standard_name = "sea_surface_wave_from_direction";
    make(f.path, m);
    check(f.path, Format::wavespectra);
  }
  SECTION("WAVEWATCH III: towards, per radian, stored falling") {
    const Scratch f("a.nc");
    Made m = one_bin(20.0, 1.0);
    m.frequency_name = "frequency", m.direction_name = "direction", m.unit = "m2 s rad-1";
    m.standard_name = "sea_surface_wave_to_direction";
    m.stored.clear();
    for (int j = 0; j < 36; ++j) m.stored.push_back(std::fmod(450.0 - 10.0 * j, 360.0));  // 90 80 70 ...
    m.value = [directions = m.stored](std::size_t i, std::size_t j) {
      return i == 1 && directions[j] == 20.0 ? 1.0 : 0.0;
    };
    make(f.path, m);
    check(f.path, Format::ww3);
  }
  SECTION("SWAN NetCDF: radians, by its attribute") {
    for (const bool nautical : {true, false}) {
      const Scratch f("a.nc");
      // Nautical 200 deg; Cartesian, counter-clockwise from east: 90 - 20.
      Made m = one_bin(nautical ? 200.0 : 70.0, 1.0);
      m.variable = "density", m.frequency_name = "frequency", m.direction_name = "direction", m.unit = "m2 s rad-1";
      m.direction_unit = "radian", m.convention = nautical ? "nautical" : "cartesian";
      for (double& d : m.stored) d *= kDeg;
      make(f.path, m);
      check(f.path, Format::swan);
    }
  }
  SECTION("SWAN text: NDIR from, CDIR towards") {
    for (const bool nautical : {true, false}) {
      const Scratch f("a.spc");
      std::string text =
          "SWAN   1   Swan standard spectral file, version\n$ a remark\nTIME\n 1\nLONLAT\n 1\n 5.0 54.0\nAFREQ\n 3\n"
          " 0.08\n 0.10\n 0.12\n" +
          std::string(nautical ? "NDIR" : "CDIR") + "\n 36\n";
      for (int j = 0; j < 36; ++j) text += std::to_string(10 * j) + "\n";
      text +=
          "QUANT\n 1\nVaDens variance densities\nm2/Hz/degr\n -99\n20261130.000000\nFACTOR\n 0.000174532925199433\n";
      for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 36; ++j) text += i == 1 && j == (nautical ? 20 : 7) ? " 100" : " 0";
        text += "\n";
      }
      f.write(text);
      check(f.path, Format::swan);
    }
  }
}

TEST_CASE("ERA5 goes by index, in logarithms, and a missing value is no energy") {
  const Scratch f("era.nc");
  Made m;
  m.variable = "d2fd", m.frequency_name = "frequencyNumber", m.direction_name = "directionNumber";
  m.unit = "m**2 s radian**-1";
  m.axes = false;
  m.frequency.resize(30), m.stored.resize(24);
  m.value = [](std::size_t i, std::size_t j) { return i == 10 && j == 3 ? std::log10(2.0) : std::nan(""); };
  make(f.path, m);
  const SeaStatistics s = told(read(spec_of(f.path)));
  // Frequency 0.03453 x 1.1^10, towards 7.5 + 3 x 15 = 52.5 deg; +x north: heading -52.5.
  const double peak = 0.03453 * std::pow(1.1, 10);
  CHECK(s.peak_period == Approx(1.0 / peak).epsilon(1e-12));
  CHECK(s.heading / kDeg == Approx(-52.5).epsilon(1e-9));
  const double m0 = 2.0 * 15.0 * kDeg * 0.5 * (peak * 1.1 - peak / 1.1);
  CHECK(s.significant_height == Approx(4.0 * std::sqrt(m0)).epsilon(1e-9));
  // The second time, by its index and by its date: half the height.
  for (const char* time : {"1", "2026-11-30T06:00", "2026-11-30 06:00:00Z"}) {
    SpectrumFileSpec spec = spec_of(f.path);
    spec.time = time;
    CHECK(told(read(spec)).significant_height == Approx(2.0 * std::sqrt(m0)).epsilon(1e-9));
  }
  SpectrumFileSpec spec = spec_of(f.path);
  spec.time = "2026-11-30T03:00";
  CHECK_THAT(
      refusal([&] { read(spec); }),
      Contains("has no spectrum of 2026-11-30T03:00, its times go from 2026-11-30T00:00:00Z to 2026-11-30T06:00:00Z"));
  spec.time = "2";
  CHECK_THAT(refusal([&] { read(spec); }), Contains("has 2 times, the first is 0"));
  spec.time = "yesterday";
  CHECK_THAT(refusal([&] { read(spec); }), Contains("must be an index from 0 or a time"));
}

TEST_CASE("a spectrum file made from a JONSWAP sea gives its height, period, direction and spread") {
  SeaStateSpec s;
  s.type = SeaStateSpec::Type::jonswap;
  s.significant_height = 2.3;
  s.peak_period = 10.0;
  s.gamma = 3.3;
  const double n = 15.0, to = 130.0;  // cos^2s, travels to 130 deg by compass
  Made m;
  m.unit = "m2 s degree-1";
  for (int i = 0; i < 400; ++i) m.frequency.push_back(0.04 + 0.001 * i);
  m.stored = compass(5.0);
  double area = 0.0;
  for (const double d : m.stored) area += 5.0 * std::pow(std::abs(std::cos(0.5 * (d - to - 180.0) * kDeg)), 2.0 * n);
  m.value = [&](std::size_t i, std::size_t j) {
    return kTurn * spectral_density(s, kTurn * m.frequency[i]) *
           std::pow(std::abs(std::cos(0.5 * (m.stored[j] - to - 180.0) * kDeg)), 2.0 * n) / area;
  };
  const Scratch f("sea.nc");
  make(f.path, m);
  SpectrumFileSpec spec = spec_of(f.path);
  double m0 = 0.0;  // of what the file holds: by the trapezoidal rule over its frequencies
  for (std::size_t i = 0; i + 1 < m.frequency.size(); ++i)
    m0 += 0.5e-3 * kTurn *
          (spectral_density(s, kTurn * m.frequency[i]) + spectral_density(s, kTurn * m.frequency[i + 1]));
  const DirectionalSpectrum spectrum = read(spec);
  CHECK(told(spectrum).significant_height == Approx(4.0 * std::sqrt(m0)).epsilon(1e-6));
  CHECK(told(spectrum).peak_period == Approx(10.0).epsilon(1e-6));
  CHECK(told(spectrum).heading / kDeg == Approx(-130.0).epsilon(1e-6));
  CHECK(told(spectrum).spread == Approx(circular_spread_cos_2s(n)).epsilon(1e-6));
  spec.scale_to_height = 1.5;
  CHECK(told(read(spec)).significant_height == Approx(1.5).epsilon(1e-12));
  // The waves drawn from it: Hs exact, mean direction and spread to the scatter of 300 draws of 20 deg.
  SeaStateSpec sea;
  sea.name = "file";
  sea.type = SeaStateSpec::Type::spectrum;
  sea.spectrum = std::make_shared<const DirectionalSpectrum>(spectrum);
  const auto waves = spectrum_components(sea, kG);
  REQUIRE(waves.size() == 300);
  double variance = 0.0, mean_w2 = 0.0;
  Eigen::Vector2d direction = Eigen::Vector2d::Zero();
  for (const WaveComponent& c : waves) {
    variance += 0.5 * c.amplitude * c.amplitude;
    mean_w2 += c.frequency * c.frequency / 300.0;
    direction += Eigen::Vector2d(c.cos_heading, c.sin_heading) / 300.0;
  }
  CHECK(4.0 * std::sqrt(variance) == Approx(told(spectrum).significant_height).epsilon(1e-12));
  CHECK(std::atan2(direction.y(), direction.x()) / kDeg == Approx(-130.0).margin(4.0 * 20.0 / std::sqrt(300.0)));
  CHECK(kTurn / std::sqrt(mean_w2) == Approx(told(spectrum).zero_crossing_period).epsilon(0.01));
}

TEST_CASE("files that do not say what their numbers mean are refused") {
  const auto refused = [](const std::function<void(Made&)>& change, Format format = Format::automatic) {
    const Scratch f("bad.nc");
    Made m = one_bin(200.0, 1.0);
    m.unit = "m2 s degree-1";
    change(m);
    make(f.path, m);
    return refusal([&] { read(spec_of(f.path, 0.0, format)); });
  };
  CHECK(refused([](Made&) {}).empty());
  CHECK_THAT(refused([](Made& m) { m.unit = "furlong2 s"; }), Contains("the density is in \"furlong2 s\""));
  CHECK_THAT(refused([](Made& m) { m.direction_unit = "gon"; }), Contains("the directions are in \"gon\""));
  CHECK_THAT(refused([](Made& m) { m.standard_name = "sea_surface_wave_to_direction"; }, Format::wavespectra),
             Contains("contradicts the format that the case names"));
  CHECK(refused([](Made& m) { m.standard_name = "sea_surface_wave_to_direction"; }).empty());
  CHECK_THAT(refused([](Made& m) { m.variable = "hs"; }), Contains("holds no 2-D spectrum that is known"));
  CHECK_THAT(refused([](Made& m) { m.variable = "density"; }), Contains("the attribute Directional_convention"));
  CHECK_THAT(refused([](Made& m) { m.value = [](std::size_t, std::size_t) { return -1.0; }; }),
             Contains("has a density that is not a number >= 0 at frequency 1, direction 1"));
  CHECK_THAT(refused([](Made& m) { m.value = [](std::size_t, std::size_t) { return std::nan(""); }; }),
             Contains("has a density that is not a number"));
  CHECK_THAT(refused([](Made& m) { m.value = [](std::size_t, std::size_t) { return 0.0; }; }),
             Contains("has no energy"));
  CHECK_THAT(refused([](Made& m) { m.frequency[1] = 0.07; }), Contains("frequencies that do not rise"));
  CHECK_THAT(refused([](Made& m) { m.stored = compass(10.0), m.stored.pop_back(); }),
             Contains("do not go round the circle"));
  CHECK_THAT(refused([](Made& m) { m.stored = compass(60.0); }), Contains("needs at least 8 directions, has 6"));
  const Scratch f("text.nc");
  f.write("no spectrum at all");
  CHECK_THAT(refusal([&] { read(spec_of(f.path)); }), Contains("text.nc"));
}

TEST_CASE("a measured elevation is reproduced at its gauge") {
  const Scratch f("gauge.csv");
  std::string text = "time_s,elevation\n";
  const int n = 1200;
  const double step = 0.5;
  std::vector<double> wanted;
  for (int i = 0; i < n; ++i) {
    const double t = step * i;
    wanted.push_back(100.0 * (0.6 * std::sin(0.71 * t) + 0.3 * std::cos(1.13 * t + 0.4) + 0.1 * std::sin(2.0 * t)) +
                     20.0);
    char row[80];
    std::snprintf(row, sizeof row, "%.17g,%.17g\n", t, wanted.back());
    text += row;
  }
  f.write(text);
  SeaStateSpec s;
  s.name = "gauge";
  s.type = SeaStateSpec::Type::record;
  s.heading = 0.8;
  s.record_file.file = f.path;
  s.record_file.column = "elevation";
  s.record_file.unit = RecordFileSpec::Unit::centimetres;
  s.record_file.point = {30.0, -12.0};
  read_sea_file(s, kRho, kG);
  REQUIRE(s.record);
  CHECK(s.record->step == Approx(step).epsilon(1e-12));
  CHECK(record_length(*s.record) == Approx(600.0));
  const WaveField field = build_wave_field(s, kG, 0.0, 25.0);
  CHECK(field.components().size() == 600);
  // Between the tapers, less one constant, the mean under the taper. Hs is 2.6 m.
  double shift = 0.0;
  for (int i = 80; i < n - 80; i += 7) {
    const double got = field.elevation(30.0, -12.0, step * i), want = 0.01 * wanted[static_cast<std::size_t>(i)];
    if (i == 80) shift = want - got;
    CHECK(std::abs(got + shift - want) < 1e-10 * 2.6);
  }
  // A band leaves out what is outside: the wave of 2 rad/s has 0.1^2 of 0.46 of the variance, 2.2 %; that of 1.13, 20
  // %.
  s.record_file.highest = 1.6;
  CHECK(record_share_left_out(s) == Approx(0.022).epsilon(0.05));
  CHECK_NOTHROW(build_wave_field(s, kG, 0.0));
  s.record_file.highest = 1.0;
  CHECK_THROWS_WITH(build_wave_field(s, kG, 0.0), Contains("of its variance outside the band from 0 to 1 rad/s"));
}

TEST_CASE("tables without a record are refused") {
  const Scratch f("gauge.csv");
  RecordFileSpec spec;
  spec.file = f.path;
  spec.column = "eta";
  const auto refused = [&](const std::string& text) {
    f.write(text);
    return refusal([&] { read_elevation_file(spec); });
  };
  CHECK(refused("t,eta\n0,1\n1,2\n2,1\n").empty());
  CHECK_THAT(refused("t,etta\n0,1\n"), Contains("has no column \"eta\", did you mean \"etta\"?"));
  CHECK_THAT(refused("t,eta\n0,1\n1,x\n"), Contains("gauge.csv:3: expected a number in \"eta\", got \"x\""));
  CHECK_THAT(refused("t,eta\n0,1\n1,2\n3,1\n"), Contains("must rise in even steps"));
  CHECK_THAT(refused("t,eta\n0,1\n1\n"), Contains("has no cell under \"eta\""));
  CHECK_THAT(refused("eta\n0\n1\n"), Contains("the first column is the time in s"));
  CHECK_THAT(refused("t,eta\n0,1\n"), Contains("needs at least two rows"));
}

}  // namespace
}  // namespace stillhook
