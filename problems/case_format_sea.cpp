// Field tables of the water and its waves.
#include <cmath>

#include "problems/case_format.h"

namespace stillhook {
namespace {

using SeaTable = TableOf<SeaStateSpec>;
using SeaKind = SeaStateSpec::Type;

const std::vector<std::string> kShaped = {"jonswap", "pierson_moskowitz", "ochi_hubble"};

/// Keys of one system of waves, which a state and a part of a sum have alike.
void add_wave_keys(SeaTable& t) {
  using S = SeaStateSpec;
  t.number("amplitude_m", &S::amplitude, unit::m, not_negative(), "Amplitude, half the wave height.")
      .only_when("type", {"regular"})
      .require();
  t.number("frequency_rad_per_s", &S::frequency, unit::rad_per_s, positive(), "Circular frequency.")
      .only_when("type", {"regular"})
      .require();
  t.number("phase_deg", &S::phase, unit::deg, any_value(), "Lag of the crest at the world's origin at time 0.")
      .only_when("type", {"regular"});
  t.number("significant_height_m", &S::significant_height, unit::m, not_negative(), "Significant wave height Hs.")
      .only_when("type", kShaped)
      .require();
  t.number("peak_period_s", &S::peak_period, unit::s, positive(), "Peak period Tp.")
      .only_when("type", kShaped)
      .require();
  t.number("gamma", &S::gamma, unit::one, Range{1.0, 10.0, false}, "Peakedness of the JONSWAP spectrum.")
      .only_when("type", {"jonswap"})
      .absent("by the DNV rule from Hs and Tp");
  t.number("lambda", &S::lambda, unit::one, Range{0.7, 30.0, false},
           "Shape of the Ochi-Hubble spectrum: 1 is Pierson-Moskowitz, more is narrower.")
      .only_when("type", {"ochi_hubble"});
  t.number("heading_deg", &S::heading, unit::deg, Range{-360.0, 360.0, false},
           "Direction the waves travel towards, from +x, counter-clockwise.");
  t.number("spreading", &S::spreading, unit::one, Range{0.0, 100.0, false},
           "Exponent n of the cos^n spreading within 90 degrees; 0 is long-crested.")
      .only_when("type", kShaped);
  t.number("spreading_2s", &S::spreading_2s, unit::one, Range{0.0, 200.0, false},
           "In place of spreading: s of cos^2s of half the angle, over the whole circle.")
      .only_when("type", kShaped);
  t.integer("components", &S::components, Range{1, 2000, false}, "Number of frequencies.").only_when("type", kShaped);
  t.integer("directions", &S::directions, Range{1, 181, false},
            "Number of directions; more than 1 only with spreading or spreading_2s.")
      .only_when("type", kShaped);
}

/// Keys of a 2-D spectrum in a file.
void add_spectrum_keys(SeaTable& t) {
  using S = SeaStateSpec;
  using F = SpectrumFileSpec;
  const std::vector<std::string> here = {"spectrum"};
  t.file(
       "spectrum_file", [](S & s) -> auto& { return s.spectrum_file.file; },
       "File with a 2-D spectrum, energy over frequency and direction.")
      .only_when("type", here)
      .require();
  const auto format = [](S & s) -> auto& { return s.spectrum_file.format; };
  t.choice<decltype(format), F::Format>("format", format,
                                        {{"automatic", F::Format::automatic},
                                         {"wavespectra", F::Format::wavespectra},
                                         {"ww3", F::Format::ww3},
                                         {"era5", F::Format::era5},
                                         {"swan", F::Format::swan}},
                                        "Who wrote the file; `automatic` takes it from the names in the file.")
      .only_when("type", here);
  t.text(
       "time", [](S & s) -> auto& { return s.spectrum_file.time; },
       "Which time of the file: \"2026-11-30T06:00\", or its index from 0, in quotes.")
      .only_when("type", here);
  t.numbers(
       "point", {1, 2}, [](S& s, const std::vector<double>& v) { s.spectrum_file.point = v; }, unit::one, any_value(),
       "Which point of the file: [index from 0], or [latitude, longitude] in degrees.")
      .only_when("type", here)
      .absent("the only one");
  t.number(
       "bearing_of_x_deg", [](S & s) -> auto& { return s.spectrum_file.bearing_of_x; }, unit::deg,
       Range{-360.0, 360.0, false}, "Compass bearing that the world's +x points to: 0 north, 90 east.")
      .only_when("type", here)
      .require();
  t.number(
       "scale_to_height_m", [](S & s) -> auto& { return s.spectrum_file.scale_to_height; }, unit::m, positive(),
       "Hs that the spectrum is scaled to.")
      .only_when("type", here)
      .absent("as the file has it");
  t.integer("waves", &S::waves, Range{1, 1024, false},
            "Number of waves that the spectrum is made of, each in a direction drawn from those at its frequency.")
      .only_when("type", here);
}

/// Keys of a measured elevation.
void add_record_keys(SeaTable& t) {
  using S = SeaStateSpec;
  using R = RecordFileSpec;
  const std::vector<std::string> here = {"record"};
  t.file(
       "record_file", [](S & s) -> auto& { return s.record_file.file; },
       "Table with a measured elevation of the surface, its first column the time in s, in even steps.")
      .only_when("type", here)
      .require();
  t.text(
       "column", [](S & s) -> auto& { return s.record_file.column; }, "Name of the column.")
      .only_when("type", here)
      .require();
  const auto unit_of = [](S & s) -> auto& { return s.record_file.unit; };
  t.choice<decltype(unit_of), R::Unit>("unit", unit_of,
                                       {{"m", R::Unit::metres}, {"cm", R::Unit::centimetres}, {"ft", R::Unit::feet}},
                                       "Unit of the column.")
      .only_when("type", here);
  t.numbers(
       "point_m", {2},
       [](S& s, const std::vector<double>& v) {
         s.record_file.point = {v[0], v[1]};
       },
       unit::m, any_value(), "Where it was measured, x and y in the world.")
      .only_when("type", here)
      .absent("the world's origin");
  t.number(
       "lowest_rad_per_s", [](S & s) -> auto& { return s.record_file.lowest; }, unit::rad_per_s, not_negative(),
       "Longer waves of the record are left out; they may have 5 % of its variance with those above the highest.")
      .only_when("type", here);
  Field& highest = t.number(
      "highest_rad_per_s", [](S & s) -> auto& { return s.record_file.highest; }, unit::rad_per_s, positive(),
      "Shorter waves of the record are left out.");
  highest.get = [](const void* s) -> std::optional<Value> {
    const double value = static_cast<const S*>(s)->record_file.highest;
    return std::isfinite(value) ? std::optional<Value>(value) : std::nullopt;
  };
  highest.only_when("type", here).absent("none are");
}

const Table& sea_part_table() {
  static const Table table = [] {
    using S = SeaStateSpec;
    std::vector<std::string> seeded = kShaped;
    seeded.push_back("spectrum");
    SeaTable t("sea.states.parts", "One system of waves of a sum: the swell, the wind sea.");
    t.name("name", &S::name, "Name.");
    t.choice<decltype(&S::type), SeaKind>("type", &S::type,
                                          {{"regular", SeaKind::regular},
                                           {"jonswap", SeaKind::jonswap},
                                           {"pierson_moskowitz", SeaKind::pierson_moskowitz},
                                           {"ochi_hubble", SeaKind::ochi_hubble},
                                           {"spectrum", SeaKind::spectrum}},
                                          "Kind of waves.")
        .require();
    add_wave_keys(t);
    add_spectrum_keys(t);
    t.integer("seed", &S::part_seed, Range{0, 2147483647, false},
              "Index that the phases come from. With it this part stays as it is while the seed of the state changes.")
        .only_when("type", seeded)
        .absent("the state's seed and the part's place, from 0");
    return t.build();
  }();
  return table;
}

const Table& sea_state_table() {
  static const Table table = [] {
    using S = SeaStateSpec;
    SeaTable t("sea.states", "A sea that the lift can meet; `sea.active` picks one, a scenario of the plan another.");
    std::vector<std::string> seeded = kShaped;
    seeded.insert(seeded.end(), {"spectrum", "sum"});
    t.name("name", &S::name, "Name.");
    t.choice<decltype(&S::type), SeaKind>("type", &S::type,
                                          {{"calm", SeaKind::calm},
                                           {"regular", SeaKind::regular},
                                           {"jonswap", SeaKind::jonswap},
                                           {"pierson_moskowitz", SeaKind::pierson_moskowitz},
                                           {"ochi_hubble", SeaKind::ochi_hubble},
                                           {"spectrum", SeaKind::spectrum},
                                           {"record", SeaKind::record},
                                           {"sum", SeaKind::sum}},
                                          "Kind of sea: one wave, a spectrum by formula or from a file, a measured "
                                          "elevation; `sum` is several at once, each with its own direction.")
        .require();
    add_wave_keys(t);
    add_spectrum_keys(t);
    add_record_keys(t);
    t.integer("seed", &S::seed, Range{0, 2147483647, false}, "Index that the phases come from.")
        .only_when("type", seeded);
    t.tables("parts", &S::parts, "name", &sea_part_table, "The systems of waves that come together.")
        .only_when("type", {"sum"})
        .require();
    return t.build();
  }();
  return table;
}

}  // namespace

const Table& sea_table() {
  static const Table table = [] {
    using S = SeaSpec;
    TableOf<S> t("sea", "The water, and the seas the lift can meet.");
    t.text("active", &S::active, "The sea state of a single run, or `calm`.")
        .names(Reference::sea_state)
        .absent("calm water");
    t.number("ramp_s", &S::ramp, unit::s, not_negative(), "The waves grow smoothly from nothing over this time.");
    t.number("density_kg_per_m3", &S::density, unit::kg_per_m3, positive(), "Density of the water.");
    t.number("gravity_m_per_s2", &S::gravity, unit::m_per_s2, positive(), "Acceleration of gravity.");
    t.number(
         "depth_m", &S::depth, unit::m, positive(),
         "Water depth, for moorings, waves and hulls: waves are as long as they are over a flat bed of this depth, and "
         "`panels` are computed over it. Coefficients from files that do not say a depth are those of deep water, and "
         "a warning says where that matters.")
        .absent("deep");
    t.boolean(
        "deep_waves", &S::deep_waves,
        "The waves, and what hulls do to them, are those of deep water whatever `depth_m` says, which then serves "
        "the moorings alone.");
    t.table("current", &S::current, &current_table, "The current.").absent("none");
    t.tables("states", &S::states, "name", &sea_state_table, "Sea states.");
    return t.build();
  }();
  return table;
}

}  // namespace stillhook
