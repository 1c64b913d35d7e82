// First screen: verdict, headline numbers, the operation as a timeline.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "results/html.h"
#include "results/report_parts.h"
#include "results/summary.h"
#include "results/viewer_bundle.h"

namespace stillhook {
namespace {

const char* stage_class(PhaseSpec::Stage stage) {
  switch (stage) {
    case PhaseSpec::Stage::on_barge:
      return "on_barge";
    case PhaseSpec::Stage::transfer:
      return "transfer";
    case PhaseSpec::Stage::hanging:
      return "hanging";
    case PhaseSpec::Stage::set_down:
      return "set_down";
    case PhaseSpec::Stage::landed:
      break;
  }
  return "landed";
}

std::string value_with_unit(const std::string& name, double value) {
  const Shown shown = show_metric(name, value);
  return shown.value + (shown.unit.empty() ? "" : " " + shown.unit);
}

std::string governing_sentence(const ReportData& data) {
  const LimitCheck* governing = governing_check(data.limits);
  if (!governing) return "<p>The case sets no limits.</p>";
  const MetricDefinition* definition = metric_definition(governing->metric);
  // The meaning first, then the name that the case gives it.
  const std::string key = "<code>" + escape_html(governing->metric) + "</code>";
  const std::string name = definition ? "<b>" + escape_html(definition->description) + "</b> (" + key + ")" : key;
  if (!std::isfinite(governing->value))
    return fmt::format("<p>Governing limit: {}. It has no value in this run, so it cannot be shown to be kept.</p>",
                       name);
  std::string when;
  if (!governing->phase.empty()) when += " in " + escape_html(readable_name(governing->phase));
  if (!governing->scenario.empty()) when += " in scenario " + escape_html(governing->scenario);
  if (std::isfinite(governing->time)) when += " at " + time_in(data, governing->scenario, governing->time);
  std::string share = limit_use_text(*governing);
  if (!share.empty()) share = ": " + share;
  return fmt::format("<p>Governing limit: {}: <b>{}</b>, {} {}{}{}.</p>", name,
                     value_with_unit(governing->metric, governing->value), governing->is_max ? "limit" : "at least",
                     value_with_unit(governing->metric, governing->limit), share, when);
}

/// How much the verdict rests on: one seed, the scenarios of a search, fresh conditions.
std::string ground_of_verdict(const ReportData& data) {
  const SeaSpec& sea = data.specification.sea;
  const auto state =
      std::find_if(sea.states.begin(), sea.states.end(), [&](const SeaStateSpec& s) { return s.name == sea.active; });
  const bool irregular = state != sea.states.end() && state->seeded();
  const bool gusts = data.specification.wind.seeded();
  const SearchSection* search = data.search;
  std::string out;
  if (search && search->scenarios.size() > 1)
    out += fmt::format(
        "<p>Limits are judged in all {} scenarios of the search; replay, plots and the tables by phase are of one of "
        "them, {}.</p>",
        search->scenarios.size(), escape_html(readable_name(search->shown)));
  else if (irregular || gusts)
    out += fmt::format(
        "<p>This is one run in one seed of {} ({}): other seeds have other extremes. <code>plan</code> tries "
        "several, and with <code>certify</code> fresh ones.</p>",
        irregular && gusts ? "sea and gusts"
        : irregular        ? "the sea"
                           : "the gusts",
        irregular && gusts && data.specification.gust_seed() != state->seed
            ? fmt::format("{} and {}", state->seed, data.specification.gust_seed())
        : irregular ? std::to_string(state->seed)
                    : std::to_string(data.specification.gust_seed()));
  if (!search) return out;
  if (!search->certificate.empty())
    return out + fmt::format("<p class=\"certificate\"><b class=\"{}\">Certificate:</b> {}</p>",
                             search->certificate_kept ? "pass" : "fail", escape_html(search->certificate));
  return out +
         "<p>The plan has not been tried in conditions that its search has not seen (<code>plan.certify</code>).</p>";
}

/// A number that matters, beside the limit it has.
std::string tile(const ReportData& data, const std::string& metric, const std::string& label, bool operator_unit) {
  const Metric* m = data.metrics.find(metric);
  if (!m) return {};
  const auto text = [&](double v) {
    const Shown shown = show_metric(m->name, v);
    if (!operator_unit || shown.aside.empty()) return std::pair(shown.value, shown.unit);
    const std::size_t space = shown.aside.find(' ');
    return std::pair(shown.aside.substr(0, space), space == std::string::npos ? "" : shown.aside.substr(space + 1));
  };
  std::string limits;
  for (const LimitCheck& c : data.limits)
    if (c.metric == metric)
      limits += fmt::format(" <span class=\"{}\">{}&nbsp;{}</span>",
                            c.pass   ? "pass"
                            : c.hard ? "fail"
                                     : "warn",
                            c.is_max ? "≤" : "≥", text(c.limit).first);
  const auto [value, unit] = text(m->value);
  return fmt::format("<div class=\"tile\"><b>{} <span>{}</span></b><div>{}{}</div></div>", value, unit, label, limits);
}

/// The clearance that comes closest to its limit, or without limits the smallest.
std::string closest_clearance(const ReportData& data) {
  const LimitCheck* closest = nullptr;
  for (const LimitCheck& c : data.limits)
    if (c.metric.starts_with("clearance_min.") && (!closest || relative_margin(c) < relative_margin(*closest)))
      closest = &c;
  std::string name = closest ? closest->metric : "";
  double smallest = std::numeric_limits<double>::infinity();
  if (!closest)
    for (const Metric& m : data.metrics.items)
      if (m.name.starts_with("clearance_min.") && m.value < smallest) {
        smallest = m.value;
        name = m.name;
      }
  return name.empty() ? "" : tile(data, name, escape_html(readable_name(name.substr(14))), false);
}

/// The phases to scale, numbered and named, with marks for contacts.
std::string timeline(const ReportData& data) {
  const std::vector<PhaseRecord>& phases = data.trajectory.phases;
  if (phases.empty()) return "<p>No phase was begun.</p>";
  const double start = phases.front().start, span = std::max(1e-9, phases.back().end - start);
  std::string bars, list, ticks;
  for (std::size_t i = 0; i < phases.size(); ++i) {
    const PhaseRecord& p = phases[i];
    const double share = 100.0 * (p.end - p.start) / span;
    const char* cls = stage_class(p.stage);
    bars += fmt::format("<i class=\"{}\" style=\"width:{:.3f}%\" title=\"{}\">{}</i>", cls, share,
                        escape_html(readable_name(p.name)), share > 2.2 ? std::to_string(i + 1) : "");
    list += fmt::format("<li><b class=\"{}\">{}</b><span>{}{}</span><small>{} + {}</small></li>", cls, i + 1,
                        escape_html(readable_name(p.name)),
                        p.event_timed_out ? " <span class=\"warn\">event timed out</span>" : "", clock_time(p.start),
                        clock_time(p.end - p.start));
  }
  std::size_t shown = 0;
  for (const ContactEvent& c : data.trajectory.contacts)
    if (c.start > start && shown++ < 400)
      ticks += fmt::format("<b style=\"left:{:.2f}%\" title=\"{} at {}\"></b>", 100.0 * (c.start - start) / span,
                           escape_html(c.contact), clock_time(c.start));
  return fmt::format(
      "<div class=\"track\" role=\"img\" aria-label=\"Phases of the operation to scale\">{}</div>"
      "<div class=\"ticks\" aria-hidden=\"true\">{}</div><ol class=\"phases\">{}</ol>"
      "<small class=\"key\">Start + duration, h:min:s.{} "
      "<b style=\"color:#5b6672\">on the barge</b>, <b style=\"color:#a83a00\">load transfer</b>, "
      "<b style=\"color:#005c94\">hanging</b>, <b style=\"color:#87357a\">set-down</b>, "
      "<b style=\"color:#00603a\">landed</b>.</small>",
      bars, ticks, list, ticks.empty() ? "" : " Marks: contacts.");
}

}  // namespace

std::string verdict_part(const ReportData& data) {
  const auto failed =
      std::count_if(data.limits.begin(), data.limits.end(), [](const LimitCheck& c) { return c.hard && !c.pass; });
  const auto warned =
      std::count_if(data.limits.begin(), data.limits.end(), [](const LimitCheck& c) { return !c.hard && !c.pass; });
  std::string cls, headline, detail;
  if (data.metrics.status == RunStatus::failed) {
    cls = " fail";
    headline = "Failed";
    detail = "<p>" + escape_html(data.metrics.message) + ".</p>";
  } else if (data.trajectory.status != RunStatus::completed) {
    cls = " fail";
    headline = "Not completed: " + readable_name(status_name(data.trajectory.status));
    detail = "<p>" + escape_html(data.trajectory.message) + "</p><p>What follows covers the part that ran.</p>";
  } else if (!within_limits(data.metrics, data.limits)) {
    cls = " fail";
    headline = fmt::format("Outside limits: {} of {} criteria", failed, data.limits.size());
  } else if (warned > 0) {
    cls = " warn";
    headline = fmt::format("Within limits, with {} warning{}", warned, warned == 1 ? "" : "s");
  } else if (data.search && !data.search->certificate_kept) {
    cls = " warn";
    headline = "Within limits in the search's conditions, not in fresh ones";
  } else {
    headline = data.limits.empty() ? "Completed" : "Within limits";
  }
  std::string out = fmt::format("<div class=\"verdict{}\" role=\"status\"><strong>{}</strong>{}{}{}</div>", cls,
                                escape_html(headline), detail, governing_sentence(data), ground_of_verdict(data));
  out += "<div class=\"tiles\">";
  out += tile(data, "daf_total", "DAF, hook load", false) + tile(data, "hook_load_max", "largest hook load", true);
  out += tile(data, "sway_peak", "largest sway", false) + closest_clearance(data);
  out += tile(data, "offlead_max", "off-lead", false) + tile(data, "sidelead_max", "side-lead", false);
  out += tile(data, "rehits", "re-hits", false) + tile(data, "setdown_speed", "set-down speed", false);
  out += tile(data, "setdown_offset", "off target", false) + tile(data, "duration", "duration, h:min:s", true);
  return out + "</div>";
}

std::string replay_part(const ReportData& data, bool with_viewer) {
  std::string stage;
  if (with_viewer)
    stage =
        "<div id=\"stage\"><p class=\"muted\">The 3-D replay starts here in a browser with JavaScript and "
        "WebGL 2.</p></div>";
  else
    stage = fmt::format("<p class=\"muted\">There is no 3-D replay in this report: {}.</p>",
                        viewer_missing().empty() ? "nothing was recorded" : escape_html(viewer_missing()));
  return "<div class=\"replay\" id=\"replay\">" + stage + timeline(data) + "</div>";
}

}  // namespace stillhook
