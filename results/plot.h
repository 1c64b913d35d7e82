// Line plots over time as SVG: axes with round ticks and units, a legend, shaded phases, limit lines, event markers.
// Long series are thinned to the extremes of each pixel column, so that no peak is lost and a plot stays small.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace stillhook {

struct PlotLine {
  std::string label;
  std::vector<double> time, value;  // equal lengths, time increasing; a value that is not finite breaks the line
};

struct PlotPhase {
  std::string label;
  double start = 0.0, end = 0.0;
};

struct PlotLimit {
  std::string label;  // empty: drawn without one, for the second of a pair
  double value = 0.0;
};

/// A shaded range of values, such as static tension to static tension times the permitted amplification.
struct PlotRange {
  std::string label;
  double low = 0.0, high = 0.0;
};

struct PlotMarker {
  double time = 0.0;
  std::string label;  // may be empty
};

struct Plot {
  std::string title;
  std::string y_label;  // with unit, "tension, kN"
  std::string x_label = "time, s";
  bool periods = false;  // x is an angular frequency, rad/s: under each tick stands its period, too
  std::vector<PlotLine> lines;
  std::vector<PlotPhase> phases;
  std::vector<PlotLimit> limits;  // a limit far outside the data is named in the legend instead of drawn
  std::vector<PlotRange> ranges;
  std::vector<PlotMarker> markers;
  std::string marker_label;              // what the markers are, for the legend
  double width = 760.0, height = 260.0;  // user units; the drawing scales to the width it is given
};

/// Round tick values that cover [low, high], about `wanted` of them.
std::vector<double> nice_ticks(double low, double high, int wanted);

/// First, lowest, highest and last point of every one of `columns` equal slices of [low, high], in order of time;
/// points outside are dropped. A point that is not finite is kept as a gap (NaN).
std::vector<std::pair<double, double>> thin_out(const PlotLine& line, double low, double high, int columns);

/// The plot as one <svg> element with a title for screen readers. Text is escaped.
std::string draw_plot(const Plot& plot);

}  // namespace stillhook
