#include "sim/hull/rankine/memory.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "sim/hull/rankine/bands.h"
#include "sim/specification.h"

namespace stillhook {

double columns_of(const PanelBand& band, int hulls) {
  return std::max(1.5, 6.0 * hulls / band.classes) * static_cast<double>(band.frequencies.size());
}

double bytes_at_most(const PanelBand& band, int hulls) {
  const double F = band.surface_panels;
  // N of a class once more in single precision, and the directions of GMRES of the columns that it solves at a time.
  const double columns = std::min<double>(columns_of(band, hulls), rankine::kColumnsAtOnce);
  return band.bytes + 4.0 * F * F + 16.0 * F * kUsualIterations * columns;
}

namespace {

/// m2, below the water.
double wetted_area(const PanelHull& hull) {
  double area = 0.0;
  for (const auto& triangle : hull.mesh.triangles) {
    const Vector3 &a = hull.mesh.vertices[triangle[0]], &b = hull.mesh.vertices[triangle[1]],
                  &c = hull.mesh.vertices[triangle[2]];
    if ((a.z() + b.z() + c.z()) / 3.0 < hull.waterline) area += 0.5 * (b - a).cross(c - a).norm();
  }
  return area;
}

[[noreturn]] void refuse_memory(const std::vector<PanelHull>& hulls, const rankine::Layout& layout,
                                const PanelMethodOptions& options, double panel, double panels, double bytes) {
  std::size_t thinnest = 0;
  const auto width = [&](std::size_t k) { return std::min(layout.hulls[k].length, layout.hulls[k].breadth); };
  for (std::size_t k = 1; k < hulls.size(); ++k)
    if (width(k) < width(thinnest)) thinnest = k;
  const std::string& name = hulls[thinnest].name;
  std::ostringstream sentence;
  sentence.precision(3);
  sentence << "the panel method would take " << bytes / 1e9 << " GB, panel_method.memory_gb allows "
           << options.memory / 1e9 << ": " << std::round(panels) << " panels of " << panel << " m (each kept symmetry "
           << "counted once) for a hull " << width(thinnest) << " m wide";
  if (options.panel_length <= 0.0) sentence << ", an eighth of which a panel is at most";
  sentence << ". Longer panels take less, with the square of their number: bodies." << name
           << ".hydrodynamics.panel_length_m, or a panel_method.refinement below " << options.refinement
           << "; so does a lower panel_method.highest_rad_per_s";
  throw SpecificationError("bodies." + name, "hull", sentence.str());
}

}  // namespace

namespace rankine {

void measure_parts(const std::vector<PanelHull>& hulls, const Layout& layout, const PanelMethodOptions& options,
                   std::vector<PanelBand>& bands) {
  const double allowed = options.memory > 0.0 ? options.memory : INFINITY;
  const double classes = layout.symmetry.images();
  double area = 0.0;
  for (const PanelHull& hull : hulls) area += wetted_area(hull) / classes;
  for (PanelBand& band : bands) {
    // The kernels of the hull and its responses, by the area alone: so many panels are not even laid out.
    const double least = area / (band.panel_length * band.panel_length);
    if (const double bytes = 48.0 * classes * least * least; bytes > allowed)
      refuse_memory(hulls, layout, options, band.panel_length, least, bytes);
    const HullPanels panels = panels_of(hulls, layout, band.panel_length);
    const BoundarySizes sizes = sizes_of(panels, free_surface(panels, grid_of(band)));
    band.hull_panels = sizes.hull;
    band.surface_panels = sizes.surface;
    band.classes = sizes.classes;
    band.bytes = sizes.bytes;
    if (const double bytes = bytes_at_most(band, static_cast<int>(hulls.size())); bytes > allowed)
      refuse_memory(hulls, layout, options, band.panel_length, sizes.hull + sizes.surface, bytes);
  }
  const double panel = 0.5 * bands.front().panel_length, count = 4.0 * bands.front().hull_panels;
  if (const double bytes = 48.0 * classes * count * count; bytes > allowed)
    refuse_memory(hulls, layout, options, panel, count, bytes);
}

}  // namespace rankine
}  // namespace stillhook
