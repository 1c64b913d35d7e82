// Lift-off, re-hits, landing: from the contacts as they happened.
#include <algorithm>
#include <cmath>

#include "results/load_path.h"
#include "results/metrics/channel_set.h"
#include "results/metrics/metric_row.h"
#include "results/metrics/smooth_tools.h"
#include "sim/lifting/contact.h"
#include "sim/spatial/constants.h"

namespace stillhook {
namespace {

using Stage = PhaseSpec::Stage;

double lift_off_once(MetricRun& run) {
  return run.once("lift-off", [&] { return lift_off_time(run.view()); });
}

/// The contacts that begin in these phases; not those in which the load rests where the run starts.
std::vector<const ContactEvent*> beginning_in(const MetricRun& run, const Phases& phases) {
  const RunView& view = run.view();
  std::vector<const ContactEvent*> events;
  for (const ContactEvent& event : view.run().contacts) {
    if (event.start <= view.start()) continue;
    const bool inside = run.all(phases) || std::any_of(phases.begin(), phases.end(), [&](std::size_t p) {
                          return view.phase_at(event.start) == view.run().phases[p].name;
                        });
    if (inside) events.push_back(&event);
  }
  return events;
}

std::vector<const ContactEvent*> rehits_in(MetricRun& run, const Phases& phases) {
  const double lift_off = lift_off_once(run);
  std::vector<const ContactEvent*> rehits;
  for (const ContactEvent* event : beginning_in(run, phases))
    if (event->role == ContactSpec::Role::pickup && event->start > lift_off) rehits.push_back(event);
  return rehits;
}

Peak count_of_rehits(MetricRun& run, const std::string&, const Phases& phases) {
  if (std::isnan(lift_off_once(run))) return {};
  const auto rehits = rehits_in(run, phases);
  return {static_cast<double>(rehits.size()), rehits.empty() ? kNaN : rehits.back()->start};
}

/// The largest of a quantity of the re-hits; 0 without one.
template <double ContactEvent::*quantity>
Peak largest_of_rehits(MetricRun& run, const std::string&, const Phases& phases) {
  if (std::isnan(lift_off_once(run))) return {};
  Peak largest{0.0, kNaN};
  for (const ContactEvent* event : rehits_in(run, phases)) largest.take_larger(event->*quantity, event->start);
  return largest;
}

/// The largest of a quantity of all contacts that begin; 0 without one.
template <double ContactEvent::*quantity>
Peak largest_of_contacts(MetricRun& run, const std::string&, const Phases& phases) {
  if (run.specification().contacts.empty()) return {};
  Peak largest{0.0, kNaN};
  for (const ContactEvent* event : beginning_in(run, phases)) largest.take_larger(event->*quantity, event->start);
  return largest;
}

Peak largest_impulse(MetricRun& run, const std::string&, const Phases& phases) {
  if (run.specification().contacts.empty()) return {};
  const double lift_off = lift_off_once(run);
  Peak largest{0.0, kNaN};
  for (const ContactEvent* event : beginning_in(run, phases)) {
    // The impulse of a load at rest only grows with time, so neither waiting for lift-off nor lying at the end counts.
    const bool passing = event->end < run.view().end() && !(event->start < lift_off);
    if (passing) largest.take_larger(event->impulse, event->start);
  }
  return largest;
}

Peak speed_of_landing(MetricRun& run, const std::string&, const Phases& phases) {
  Peak landing;
  for (const ContactEvent* event : beginning_in(run, run.view().all_phases()))
    if (event->role == ContactSpec::Role::target && !(landing.time <= event->start))
      landing = {event->approach_speed, event->start};
  const auto here = beginning_in(run, phases);
  const bool inside =
      std::any_of(here.begin(), here.end(), [&](const ContactEvent* e) { return e->start == landing.time; });
  return inside ? landing : Peak{};
}

Peak time_of_lift_off(MetricRun& run, const std::string&, const Phases&) {
  const double t = lift_off_once(run);
  return {t, t};
}

std::optional<double> smooth_rehits(const RunView& view, const std::string&, const SmoothOptions& options) {
  const Specification& s = view.specification();
  Phases lifting = view.phases_of({Stage::transfer});
  if (lifting.empty()) lifting = view.phases_of({Stage::hanging});
  if (lifting.empty()) return std::nullopt;
  double mass = 0.0, sum = 0.0;
  for (const BodySpec& b : s.bodies)
    if (b.name == s.operation.load) mass = b.mass;
  for (const ContactSpec& contact : s.contacts) {
    if (contact.role != ContactSpec::Role::pickup) continue;
    const auto gap = view.series(contact_channels::gap.of(contact));
    const std::vector<double>& time = view.run().time;
    bool clear = false;
    double before = 0.0;
    for (std::size_t i = 0; i < gap.size(); ++i) {
      if (time[i] < view.run().phases[lifting.front()].start) continue;
      const double now = contact.stiffness * soft_positive(-gap[i], options.gap_width);
      if (clear) sum += 0.5 * (before + now) * (time[i] - time[i - 1]);
      clear = clear || gap[i] > options.gap_width;
      before = now;
    }
  }
  return mass > 0.0 ? std::optional(sum / (mass * options.rehit_speed)) : std::nullopt;
}

void pickup_gaps(ChannelSet& channels, const std::string&) {
  for (const ContactSpec& contact : channels.specification().contacts)
    if (contact.role == ContactSpec::Role::pickup) channels.add(contact.name, {contact_channels::gap});
}

using Value = Peak (*)(MetricRun&, const std::string&, const Phases&);

MetricRow contact_row(const char* name, Quantity quantity, const char* description, Value value) {
  MetricRow row;
  row.name = name;
  row.quantity = quantity;
  row.description = description;
  row.channels = [](ChannelSet&, const std::string&) {};
  row.value = value;
  return row;
}

}  // namespace

std::vector<MetricRow> contact_metrics() {
  std::vector<MetricRow> rows = {
      contact_row("lift_off_time", Quantity::time, "when the load first left its support", time_of_lift_off),
      contact_row("rehits", Quantity::count, "contacts with the support the load came from, after lift-off",
                  count_of_rehits),
      contact_row("rehit_speed_max", Quantity::speed, "largest approach speed of a re-hit; 0 without one",
                  largest_of_rehits<&ContactEvent::approach_speed>),
      contact_row("rehit_impulse_max", Quantity::impulse, "largest impulse of a re-hit; 0 without one",
                  largest_of_rehits<&ContactEvent::impulse>),
      contact_row("contact_speed_max", Quantity::speed,
                  "largest approach speed of any contact that begins during the run; 0 without one",
                  largest_of_contacts<&ContactEvent::approach_speed>),
      contact_row("contact_impulse_max", Quantity::impulse,
                  "largest impulse of a contact that begins after lift-off and ends again; 0 without one",
                  largest_impulse),
      contact_row("contact_force_max", Quantity::force,
                  "largest normal force of any contact that begins during the run; 0 without one",
                  largest_of_contacts<&ContactEvent::peak_force>),
      contact_row("setdown_speed", Quantity::speed, "approach speed of the first contact with the target",
                  speed_of_landing),
  };
  rows[0].by_phase = false;
  rows[1].channels = pickup_gaps;
  rows[1].smooth = smooth_rehits;
  return rows;
}

}  // namespace stillhook
