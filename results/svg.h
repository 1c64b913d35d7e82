// Pieces of SVG that the drawings of results share.
#pragma once

#include <string>

namespace stillhook {

/// Text at a point, escaped. `anchor`: start, middle or end; `extra`: more attributes, with a blank before each.
std::string svg_text(double x, double y, const char* anchor, const std::string& content, const std::string& extra = "");

/// Everything before the drawing, with the title for screen readers and, bold, on top.
std::string svg_begin(double width, double height, const std::string& title);

/// Width of a text in DejaVu Sans or Helvetica, on the safe side.
double svg_text_width(const std::string& text, double size = 12.0);

}  // namespace stillhook
