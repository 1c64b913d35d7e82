#include "problems/spectra/spectrum_netcdf.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "results/netcdf_file.h"
#include "sim/guarded_read.h"
#include "sim/number_text.h"
#include "sim/spatial/constants.h"

namespace stillhook {
namespace {

using Format = SpectrumFileSpec::Format;
using Names = std::vector<std::string>;

const Names kTimes = {"time", "valid_time"}, kFrequencies = {"freq", "frequency", "frequencyNumber"},
            kDirections = {"dir", "direction", "directionNumber"}, kLatitudes = {"latitude", "lat"},
            kLongitudes = {"longitude", "lon"};

enum class Sense { from, towards, cartesian };

bool among(const std::string& name, const Names& names) { return std::ranges::find(names, name) != names.end(); }

class SpectrumReader {
 public:
  explicit SpectrumReader(const SpectrumFileSpec& spec)
      : spec_(spec), file_(spec.file, NetcdfFile::Mode::read, spec.file) {}

  RawSpectrum read() {
    choose_format();
    find_axes();
    RawSpectrum raw;
    raw.frequency = frequencies();
    raw.towards = directions();
    const std::size_t time = chosen_time(), point = chosen_point();
    raw.density = densities(time, point);
    raw.source = spec_.file.substr(spec_.file.find_last_of('/') + 1);
    if (!times_.empty()) raw.source += ", " + iso_of(times_[time]);
    raw.source += place_;
    return raw;
  }

 private:
  [[noreturn]] void fail(const std::string& sentence) const { throw FileError(spec_.file + ": " + sentence); }

  void choose_format() {
    const auto named = [&](Format format, const char* variable) {
      if (spec_.format != Format::automatic && spec_.format != format) return false;
      if (!file_.has(variable)) return false;
      format_ = format;
      variable_ = file_.find(variable);
      return true;
    };
    if (named(Format::era5, "d2fd") || named(Format::swan, "density")) return;
    if (file_.has("efth") && spec_.format == Format::automatic) {
      variable_ = file_.find("efth");
      format_ = Format::wavespectra;
      for (const auto& d : file_.dimensions(variable_))
        if (d.name == "frequency" || d.name == "direction") format_ = Format::ww3;
      return;
    }
    if (named(Format::wavespectra, "efth") || named(Format::ww3, "efth")) return;
    fail(
        "holds no 2-D spectrum that is known: no variable efth (wavespectra, WAVEWATCH III), d2fd (ERA5) or density "
        "(SWAN)" +
        std::string(spec_.format == Format::automatic ? "" : " of the format that is asked for"));
  }

  void find_axes() {
    axes_ = file_.dimensions(variable_);
    for (std::size_t i = 0; i < axes_.size(); ++i) {
      const auto take = [&](std::optional<std::size_t>& axis) {
        if (axis) fail("has two dimensions of one kind: " + axes_[*axis].name + " and " + axes_[i].name);
        axis = i;
      };
      if (among(axes_[i].name, kTimes))
        take(time_);
      else if (among(axes_[i].name, kFrequencies))
        take(frequency_);
      else if (among(axes_[i].name, kDirections))
        take(direction_);
      else
        places_.push_back(i);
    }
    if (!frequency_ || !direction_) fail("its spectrum has no dimension of frequency or none of direction");
    constexpr std::size_t kMostBins = 10000;
    if (axes_[*frequency_].size > kMostBins || axes_[*direction_].size > kMostBins)
      fail("has more than 10000 frequencies or directions");
  }

  /// The variable along an axis, if there is one.
  std::optional<int> along(std::size_t axis, const Names& names) const {
    Names all = {axes_[axis].name};
    all.insert(all.end(), names.begin(), names.end());
    for (const std::string& name : all) {
      if (!file_.has(name)) continue;
      const int id = file_.find(name);
      const auto of = file_.dimensions(id);
      if (of.size() == 1 && of[0].name == axes_[axis].name) return id;
    }
    return std::nullopt;
  }

  std::vector<double> frequencies() const {
    const std::size_t n = axes_[*frequency_].size;
    const std::optional<int> id = along(*frequency_, kFrequencies);
    const std::optional<std::string> unit = id ? file_.text_if_any(*id, "units") : std::nullopt;
    if (format_ == Format::era5 && (!unit || (*unit != "Hz" && *unit != "s-1"))) {
      if (n != 30) fail("has " + std::to_string(n) + " frequencies; those of ERA5, which go by index alone, are 30");
      std::vector<double> f(n);
      for (std::size_t i = 0; i < n; ++i) f[i] = 0.03453 * std::pow(1.1, static_cast<double>(i));
      return f;
    }
    if (!id) fail("does not say what its frequencies are: no variable " + axes_[*frequency_].name);
    std::vector<double> f = file_.first_doubles(*id, n);
    const double factor = unit ? frequency_factor(*unit, spec_.file) : 1.0;
    for (double& value : f) value *= factor;
    return f;
  }

  Sense sense(std::optional<int> id) const {
    const Sense by_format = format_ == Format::wavespectra || format_ == Format::swan ? Sense::from : Sense::towards;
    std::optional<Sense> said;
    if (const auto name = id ? file_.text_if_any(*id, "standard_name") : std::nullopt) {
      if (name->find("from_direction") != std::string::npos) said = Sense::from;
      if (name->find("to_direction") != std::string::npos) said = Sense::towards;
    }
    if (format_ == Format::swan) {
      const auto convention = file_.text_if_any(NetcdfFile::kGlobal, "Directional_convention");
      if (!convention && !said)
        fail(
            "does not say whether its directions are nautical or cartesian: the attribute Directional_convention, or a "
            "standard_name of the direction, must");
      if (convention && *convention == "cartesian") {
        if (said) fail("says that its directions are cartesian, and by standard_name that they are by compass");
        return Sense::cartesian;
      }
      if (convention && *convention != "nautical")
        fail("has a Directional_convention \"" + *convention + "\", which is neither nautical nor cartesian");
      if (convention && said == Sense::towards)
        fail("has nautical directions, from which waves come, and a standard_name that says they travel towards them");
      return said.value_or(Sense::from);
    }
    if (said && *said != by_format && spec_.format != Format::automatic)
      fail("says by standard_name that its directions are those " +
           std::string(*said == Sense::from ? "from which waves come" : "towards which waves travel") +
           ", which contradicts the format that the case names");
    return said.value_or(by_format);
  }

  /// deg clockwise from north, towards.
  std::vector<double> directions() const {
    const std::size_t n = axes_[*direction_].size;
    const std::optional<int> id = along(*direction_, kDirections);
    const std::optional<std::string> unit = id ? file_.text_if_any(*id, "units") : std::nullopt;
    std::vector<double> d(n);
    const bool by_index = format_ == Format::era5 && (!unit || unit->find("deg") == std::string::npos);
    if (by_index) {
      if (n != 24) fail("has " + std::to_string(n) + " directions; those of ERA5, which go by index alone, are 24");
      for (std::size_t i = 0; i < n; ++i) d[i] = 7.5 + 15.0 * static_cast<double>(i);
    } else {
      if (!id) fail("does not say what its directions are: no variable " + axes_[*direction_].name);
      d = file_.first_doubles(*id, n);
      const double factor = unit ? angle_factor(*unit, spec_.file) : format_ == Format::swan ? 1.0 / kDegree : 1.0;
      for (double& value : d) value *= factor;
    }
    const Sense which = sense(id);
    for (double& value : d) {
      if (!std::isfinite(value)) fail("has a direction that is no number");
      value = which == Sense::from ? value + 180.0 : which == Sense::cartesian ? 90.0 - value : value;
    }
    return d;
  }

  std::size_t chosen_time() {
    if (!time_) return 0;
    const std::size_t n = axes_[*time_].size;
    constexpr std::size_t kMostTimes = 10'000'000;
    if (n > kMostTimes) fail("has more than ten million times");
    if (const std::optional<int> id = along(*time_, kTimes)) {
      const std::string unit = file_.text_if_any(*id, "units").value_or("");
      const std::size_t since = unit.find(" since ");
      const std::string step = unit.substr(0, since);
      const double scale = step == "days" || step == "day"         ? 86400.0
                           : step == "hours" || step == "hour"     ? 3600.0
                           : step == "minutes" || step == "minute" ? 60.0
                           : step == "seconds" || step == "second" ? 1.0
                                                                   : 0.0;
      const double start = since == std::string::npos ? 0.0 : seconds_of(unit.substr(since + 7));
      if (scale > 0.0 && std::isfinite(start)) {
        times_ = file_.first_doubles(*id, n);
        for (double& t : times_) t = start + scale * t;
      }
    }
    if (!times_.empty()) return time_index(spec_, times_);
    const std::size_t index = time_index(spec_, std::vector<double>(n, std::numeric_limits<double>::quiet_NaN()));
    return index;
  }

  /// Latitudes or longitudes of all points: along their own axis, or one for each place of the only other axis.
  std::vector<double> coordinates(const Names& names) const {
    for (const std::string& name : names) {
      if (!file_.has(name)) continue;
      const int id = file_.find(name);
      const auto of = file_.dimensions(id);
      std::vector<std::size_t> start(of.size(), 0), count(of.size(), 1);
      for (std::size_t i = 0; i < of.size(); ++i)
        if (!among(of[i].name, kTimes)) count[i] = of[i].size;
      const std::vector<double> values = file_.block(id, start, count);
      if (of.empty() || of.size() > 2) return {};
      // Spread over the grid of points, the last axis running fastest.
      std::vector<double> all;
      for (std::size_t p = 0; p < points(); ++p) {
        std::size_t rest = p;
        for (std::size_t i = places_.size(); i-- > 0;) {
          const std::size_t at = rest % axes_[places_[i]].size;
          rest /= axes_[places_[i]].size;
          if (axes_[places_[i]].name == of.back().name && at < values.size()) all.push_back(values[at]);
        }
      }
      return all;
    }
    return {};
  }

  std::size_t points() const {
    std::size_t n = 1;
    for (const std::size_t i : places_) n *= axes_[i].size;
    return n;
  }

  std::size_t chosen_point() {
    constexpr std::size_t kMostPoints = 10'000'000;
    std::size_t n = 1;
    for (const std::size_t i : places_) {
      n = axes_[i].size > kMostPoints ? kMostPoints + 1 : n * axes_[i].size;
      if (n > kMostPoints) fail("has more than ten million points");
    }
    const std::vector<double> latitude = coordinates(kLatitudes), longitude = coordinates(kLongitudes);
    const std::size_t point = point_index(spec_, n, latitude, longitude);
    if (latitude.size() == n && longitude.size() == n)
      place_ = ", " + number_text(latitude[point]) + " N " + number_text(longitude[point]) + " E";
    else if (n > 1)
      place_ = ", point " + std::to_string(point);
    return point;
  }

  std::vector<double> densities(std::size_t time, std::size_t point) const {
    std::vector<std::size_t> start(axes_.size(), 0), count(axes_.size(), 1);
    if (time_) start[*time_] = time;
    for (std::size_t i = places_.size(), rest = point; i-- > 0; rest /= axes_[places_[i]].size)
      start[places_[i]] = rest % axes_[places_[i]].size;
    count[*frequency_] = axes_[*frequency_].size;
    count[*direction_] = axes_[*direction_].size;
    const std::vector<double> stored = file_.block(variable_, start, count);
    const double scale = file_.number_if_any(variable_, "scale_factor").value_or(1.0);
    const double offset = file_.number_if_any(variable_, "add_offset").value_or(0.0);
    const auto fill = file_.number_if_any(variable_, "_FillValue"),
               missing = file_.number_if_any(variable_, "missing_value");
    const auto unit = file_.text_if_any(variable_, "units");
    const double documented = format_ == Format::wavespectra ? 1.0 / kDegree : 1.0;
    const double factor = unit && !(format_ == Format::era5 && logarithm(*unit))
                              ? density_factor(unit_of(*unit), spec_.file)
                              : documented;
    const std::size_t nf = axes_[*frequency_].size, nd = axes_[*direction_].size;
    std::vector<double> density(nf * nd);
    for (std::size_t f = 0; f < nf; ++f)
      for (std::size_t d = 0; d < nd; ++d) {
        const double value = stored[*frequency_ < *direction_ ? f * nd + d : d * nf + f];
        const bool none = std::isnan(value) || (fill && value == *fill) || (missing && value == *missing);
        double& to = density[f * nd + d];
        if (none)
          to = format_ == Format::era5 ? 0.0 : std::numeric_limits<double>::quiet_NaN();
        else
          to = factor * (format_ == Format::era5 ? std::pow(10.0, scale * value + offset) : scale * value + offset);
      }
    return density;
  }

  /// ERA5's unit is that of what the logarithm is taken of, or says nothing.
  static bool logarithm(const std::string& unit) { return unit.find("~") != std::string::npos || unit == "1"; }
  static std::string unit_of(const std::string& unit) {
    const std::size_t open = unit.find("log10(");
    return open == std::string::npos ? unit : unit.substr(open + 6, unit.find_last_of(')') - open - 6);
  }

  const SpectrumFileSpec& spec_;
  NetcdfFile file_;
  Format format_ = Format::automatic;
  int variable_ = -1;
  std::vector<NetcdfFile::Dimension> axes_;
  std::optional<std::size_t> time_, frequency_, direction_;
  std::vector<std::size_t> places_;  // axes of the points
  std::vector<double> times_;        // s since 1970, where the file has them
  std::string place_;
};

}  // namespace

RawSpectrum read_netcdf_spectrum(const SpectrumFileSpec& spec) {
  try_reading(spec.file, [&] { SpectrumReader(spec).read(); });
  return SpectrumReader(spec).read();
}

}  // namespace stillhook
