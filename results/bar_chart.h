// Bars by category, with whiskers, as SVG. Told apart in grey and with any colour vision.
#pragma once

#include <string>
#include <vector>

namespace stillhook {

struct BarChart {
  struct Bar {
    std::string category;
    double value = 0.0;            // NaN: no bar
    double low = 0.0, high = 0.0;  // ends of the whisker; NaN: none
    double mark = 0.0;             // a short line across; NaN: none
  };
  std::string title, y_label;
  std::string bar_label, whisker_label, mark_label;  // for the legend; an empty one is left out
  std::vector<Bar> bars;
  int decimals = 0;                      // of the numbers over the bars
  double width = 760.0, height = 260.0;  // user units
};

/// The axis begins at 0. Text is escaped.
std::string draw_bar_chart(const BarChart& chart);

}  // namespace stillhook
