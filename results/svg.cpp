#include "results/svg.h"

#include <fmt/core.h>

#include "results/html.h"

namespace stillhook {

std::string svg_text(double x, double y, const char* anchor, const std::string& content, const std::string& extra) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\"{}>{}</text>", x, y, anchor, extra,
                     escape_html(content));
}

std::string svg_begin(double width, double height, const std::string& title) {
  return fmt::format(
             "<svg class=\"plot\" xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {:.0f} {:.0f}\" role=\"img\" "
             "font-family=\"system-ui,'Segoe UI',Helvetica,Arial,sans-serif\" font-size=\"12\" fill=\"#1c2329\">"
             "<title>{}</title>",
             width, height, escape_html(title)) +
         svg_text(10.0, 16.0, "start", title, " font-size=\"13.5\" font-weight=\"600\"");
}

double svg_text_width(const std::string& text, double size) {
  double width = 0.0;
  for (const char c : text)
    if ((static_cast<unsigned char>(c) & 0xC0) != 0x80) width += 0.62 * size;  // continuation bytes of UTF-8 have none
  return width;
}

}  // namespace stillhook
