// The design basis: what the case says and where it has it from.
#include <fmt/core.h>

#include <algorithm>
#include <array>

#include "results/html.h"
#include "results/report_parts.h"
#include "results/sea_polar.h"

namespace stillhook {
namespace {

using Rows = std::vector<std::vector<std::string>>;

/// "bodies.crane" of "bodies.crane.hull.size_m", "sea" of "sea.active".
std::string heading_of(const std::string& key) {
  const std::size_t first = key.find('.');
  if (first == std::string::npos) return {};
  const std::string top = key.substr(0, first);
  const std::size_t second = key.find('.', first + 1);
  const bool named = top == "sea" || top == "operation" || second == std::string::npos;
  return named ? top : key.substr(0, second);
}

bool has_sources(const std::vector<const BasisEntry*>& entries) {
  return std::any_of(entries.begin(), entries.end(), [](const BasisEntry* e) { return !e->source.empty(); });
}

Rows rows_of(const std::vector<const BasisEntry*>& entries) {
  const bool sources = has_sources(entries);
  Rows rows;
  std::string heading;
  for (const BasisEntry* e : entries) {
    if (const std::string now = heading_of(e->key); now != heading || rows.empty()) {
      heading = now;
      if (!now.empty()) rows.push_back({escape_html(readable_name(now))});  // "bodies.boom port"
    }
    const std::size_t skip = heading.empty() ? 0 : heading.size() + 1;
    rows.push_back({"<code>" + escape_html(e->key.substr(skip)) + "</code>", escape_html(e->value)});
    if (sources) rows.back().push_back(escape_html(e->source));
  }
  return rows;
}

/// What a reader wants to see without opening anything: the sea, the weights and hulls, the drives.
bool of_first_rank(const ReportData& data, const std::string& key) {
  const auto ends = [&](const char* end) { return key.ends_with(end); };
  if (key.starts_with("sea.states.")) return key.starts_with("sea.states." + data.specification.sea.active + ".");
  if (key.starts_with("sea.")) return true;
  if (key.starts_with("bodies."))
    return ends(".mass_t") || ends(".cog_m") || ends(".hull.size_m") || ends(".hull.mesh_file") ||
           ends(".hydrodynamics.kind") || key.find(".critical_fraction") != std::string::npos;
  if (key.starts_with("drives.")) return !ends(".name");
  if (key.starts_with("wires."))
    return ends("axial_stiffness_kN") || ends("breaking_load_kN") || ends("tension_max_kN");
  return key.starts_with("operation.target");
}

std::string values_table(const std::vector<const BasisEntry*>& entries) {
  std::vector<std::string> header = {"key, with its unit", "value"};
  if (has_sources(entries)) header.push_back("source, as the case file gives it");
  return html_table(header, rows_of(entries), -1);
}

}  // namespace

std::string basis_part(const ReportData& data) {
  if (data.basis.empty()) return {};
  std::vector<const BasisEntry*> all, first;
  for (const BasisEntry& e : data.basis) {
    all.push_back(&e);
    if (of_first_rank(data, e.key)) first.push_back(&e);
  }
  std::string out;
  if (const std::string sea = draw_sea_polar(data.specification, data.north); !sea.empty())
    out += "<figure><div class=\"scroll\" tabindex=\"0\">" + sea +
           "</div>"
           "<figcaption>The sea by the direction its waves come from and by their period, seen from above; the vessel "
           "lies in the "
           "middle. Shade: spectral density, on a scale of square roots. Long-crested waves are drawn ten degrees "
           "wide, regular waves as dots.</figcaption></figure>";
  out += values_table(first) + fmt::format("<details><summary>All {} values of the case</summary>{}</details>",
                                           all.size(), values_table(all));
  if (!has_sources(all))
    out += "<p><small>The case file names no sources: a remark behind a value is shown beside it here.</small></p>";
  return out + "<p><small>Limits and their sources are under Limits.</small></p>";
}

}  // namespace stillhook
