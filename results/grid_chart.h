// A table as a picture: cells shaded by their value, with the number in each, and lines over them, as SVG. The shade
// goes from white to dark in one hue, so that it reads in grey.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace stillhook {

struct GridChart {
  struct Line {
    std::string label;
    std::vector<std::pair<double, double>> points;  // in cells from the lower left corner; NaN breaks the line
    bool dashed = false;
  };
  std::string title, x_label, y_label;
  std::vector<std::string> columns, rows;       // labels; rows from the bottom up
  bool labels_at_edges = false;                 // a label names the lower edge of its cell, not its middle
  std::vector<std::vector<double>> values;      // [row][column]; NaN: blank
  std::vector<std::vector<std::string>> texts;  // [row][column]; may be empty
  double darkest = 0.0;                         // the value of the darkest shade; 0: the largest
  std::vector<Line> lines;
  double width = 760.0, cell_height = 20.0;  // user units
};

std::string draw_grid_chart(const GridChart& chart);

}  // namespace stillhook
