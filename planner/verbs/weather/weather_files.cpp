#include "planner/verbs/weather/weather_files.h"

#include <fmt/format.h>

#include <cmath>

#include "planner/verbs/weather/weather_tables.h"
#include "planner/version.h"
#include "results/files.h"
#include "results/netcdf_file.h"

namespace stillhook {
namespace {

/// The shortest form that reads back to the same number; nothing for NaN.
std::string number_field(double value) { return std::isnan(value) ? "" : fmt::format("{}", value); }

int add_numbers(NetcdfFile& file, const char* name, const std::vector<int>& dimensions, const char* meaning,
                const char* unit, const std::vector<double>& values) {
  const int id = file.define(name, NC_DOUBLE, dimensions, meaning, unit, NetcdfFile::Storage::compressed);
  file.put(id, values);
  return id;
}

void add_samples(NetcdfFile& file, const HindcastStudy& h, int time, int window) {
  const std::size_t n = h.record.size();
  std::vector<double> seconds, waits;
  std::vector<int> states;
  for (std::size_t i = 0; i < n; ++i) {
    seconds.push_back(static_cast<double>(h.record.time(i)));
    states.push_back(static_cast<int>(h.workability.state[i]));
    for (const WindowStatistics& w : h.windows) waits.push_back(w.wait_h[i]);
  }
  const int times =
      add_numbers(file, "time", {time}, "beginning of the sample", "seconds since 1970-01-01 00:00:00", seconds);
  file.attribute(times, "standard_name", "time");
  file.attribute(times, "calendar", "standard");
  const int heights = add_numbers(file, "hs", {time}, "significant wave height", "m", h.record.height);
  file.attribute(heights, "standard_name", "sea_surface_wave_significant_height");
  add_numbers(file, "limit", {time}, "limiting significant wave height", "m", h.workability.limit);
  const int state = file.define("state", NC_INT, {time}, "what the sample is", "", NetcdfFile::Storage::compressed);
  file.attribute(state, "flag_values", std::vector<int>{0, 1, 2, 3, 4, 5});
  file.attribute(state, "flag_meanings",
                 "workable waves_too_high too_much_wind no_daylight outside_the_limits missing");
  file.put(state, states);
  add_numbers(file, "wait", {time, window}, "time until the next window starts", "h", waits);
}

void add_months(NetcdfFile& file, const HindcastStudy& h, int month, int window) {
  std::vector<double> numbers, share(h.months.share.begin(), h.months.share.end()), waits, starts;
  for (std::size_t m = 0; m < 12; ++m) {
    numbers.push_back(static_cast<double>(m + 1));
    for (const WindowStatistics& w : h.windows) {
      waits.push_back(w.by_month[m].mean_h);
      starts.push_back(w.by_month[m].start_share);
    }
  }
  add_numbers(file, "month", {month}, "month of the year", "1", numbers);
  add_numbers(file, "workable_by_month", {month}, "workable share of the samples", "1", share);
  add_numbers(file, "wait_by_month", {month, window}, "mean wait for a window", "h", waits);
  add_numbers(file, "starts_by_month", {month, window}, "share of samples at which a window starts", "1", starts);
}

}  // namespace

std::string samples_csv(const HindcastStudy& h) {
  std::string out = "time,hs [m],limit [m],state";
  for (const WindowStatistics& w : h.windows) out += fmt::format(",wait for {:g} h [h]", w.duration_h);
  out += "\n";
  for (std::size_t i = 0; i < h.record.size(); ++i) {
    out += fmt::format("{},{},{},{}", instant_text(h.record.time(i)), number_field(h.record.height[i]),
                       number_field(h.workability.limit[i]), state_text(h.workability.state[i]));
    for (const WindowStatistics& w : h.windows) out += "," + number_field(w.wait_h[i]);
    out += "\n";
  }
  return out;
}

std::string months_csv(const HindcastStudy& h) {
  std::string out = "month,year,workable";
  for (const WindowStatistics& w : h.windows) out += fmt::format(",mean wait for {:g} h [h]", w.duration_h);
  out += "\n";
  for (std::size_t m = 0; m < 12; ++m) {
    if (h.months.samples[m] == 0) continue;
    out += fmt::format("{},all,{}", m + 1, number_field(h.months.share[m]));
    for (const WindowStatistics& w : h.windows) out += "," + number_field(w.by_month[m].mean_h);
    out += "\n";
    const YearSpread& years = h.months.by_year[m];
    for (std::size_t y = 0; y < years.years.size(); ++y) {
      out += fmt::format("{},{},{}", m + 1, years.years[y], number_field(years.values[y]));
      for (const WindowStatistics& w : h.windows) {
        const YearSpread& means = w.mean_by_year[m];
        double mean = std::nan("");
        for (std::size_t k = 0; k < means.years.size(); ++k)
          if (means.years[k] == years.years[y]) mean = means.values[k];
        out += "," + number_field(mean);
      }
      out += "\n";
    }
  }
  return out;
}

std::string forecast_csv(const ForecastStudy& f) {
  std::string out = "time,hs [m]";
  for (const PlannedPhase& phase : f.decision.phases) {
    const std::string name = phase_title(phase.name);
    out += fmt::format(",{0} OP_LIM [m],{0} alpha,{0} OP_WF [m]", name);
  }
  out += ",start allowed\n";
  for (std::size_t i = 0; i < f.record.size(); ++i) {
    out += instant_text(f.record.time(i)) + "," + number_field(f.record.height[i]);
    for (const auto& samples : f.decision.samples)
      out += fmt::format(",{},{},{}", number_field(samples[i].limit), number_field(samples[i].alpha),
                         number_field(samples[i].allowed));
    out += f.decision.start_allowed[i] ? ",1\n" : ",0\n";
  }
  return out;
}

void write_weather_netcdf(const HindcastStudy& h, const std::string& title, const std::string& path) {
  PendingFile pending(path);
  NetcdfFile file(pending.temporary(), NetcdfFile::Mode::create, path);
  file.attribute(NC_GLOBAL, "Conventions", "CF-1.8");
  file.attribute(NC_GLOBAL, "title", title);
  file.attribute(NC_GLOBAL, "source", std::string("stillhook ") + kVersion);
  const int time = file.define_dimension("time", h.record.size());
  const int window = file.define_dimension("window", h.windows.size());
  const int month = file.define_dimension("month", 12);
  std::vector<double> durations;
  for (const WindowStatistics& w : h.windows) durations.push_back(w.duration_h);
  add_numbers(file, "window", {window}, "duration of the window", "h", durations);
  add_samples(file, h, time, window);
  add_months(file, h, month, window);
  file.close();
  pending.commit();
}

}  // namespace stillhook
