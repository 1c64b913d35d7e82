#include "results/archive.h"

#include "results/archive_layout.h"
#include "results/files.h"
#include "results/netcdf_file.h"
#include "results/sealed_file.h"
#include "results/summary.h"
#include "sim/samples.h"

namespace stillhook {
namespace {

using namespace archive;

// A dimension of size zero means "unlimited" to NetCDF, so what is empty is left out, and missing reads back as empty.

void write_cost(NetcdfFile& file, const Trajectory& run) {
  file.attribute(NC_GLOBAL, "steps", static_cast<double>(run.steps));
  file.attribute(NC_GLOBAL, "residuals", static_cast<double>(run.residuals));
  file.attribute(NC_GLOBAL, "factorisations", static_cast<double>(run.factorisations));
}

void write_channels(NetcdfFile& file, const Trajectory& run) {
  if (run.channels.empty()) return;
  write_channel_table(file, run.channels);
  if (run.time.empty()) return;
  const SampleVariables variables =
      define_samples(file, run.channels, run.time.size(), NetcdfFile::Storage::compressed);
  file.put(variables.time, run.time);
  for (std::size_t c = 0; c < run.channels.size(); ++c) file.put(variables.channels[c], samples_of(run, c));
}

void write_phases(NetcdfFile& file, const Trajectory& run) {
  if (run.phases.empty()) return;
  const bool with_extremes = !run.channels.empty() && run.extremes.size() == run.phases.size();
  const PhaseVariables variables = define_phases(file, run.phases, with_extremes, NetcdfFile::Storage::compressed);
  file.put(variables.start, collect(run.phases, [](auto& p) { return p.start; }));
  file.put(variables.end, collect(run.phases, [](auto& p) { return p.end; }));
  file.put(variables.timed_out, collect(run.phases, [](auto& p) { return p.event_timed_out ? 1 : 0; }));
  for (std::size_t k = 0; k < variables.extremes.size(); ++k) {
    std::vector<double> values;
    for (const std::vector<Extreme>& extremes : run.extremes) {
      const std::vector<double> row = extreme_row(extremes, kExtremes[k].value, run.channels.size());
      values.insert(values.end(), row.begin(), row.end());
    }
    file.put(variables.extremes[k], values);
  }
}

void write_contacts(NetcdfFile& file, const Trajectory& run) {
  if (run.contacts.empty()) return;
  const int event = file.define_dimension("contact_event", run.contacts.size());
  const int vector = file.define_dimension("vector", 3);
  file.put_texts("contact_event_name", event, "name of the contact",
                 collect(run.contacts, [](auto& c) { return c.contact; }));
  file.put_texts("contact_event_phase", event, "phase of the first touch",
                 collect(run.contacts, [](auto& c) { return c.phase; }));
  const int role = file.define("contact_event_role", NC_INT, {event}, kContactRoleName);
  describe_roles(file, role);
  file.put(role, collect(run.contacts, [](auto& c) { return static_cast<int>(c.role); }));
  for (const ContactField& field : kContactFields)
    file.put(file.define(field.name, NC_DOUBLE, {event}, field.long_name, field.units),
             collect(run.contacts, [&](auto& c) { return c.*field.value; }));
  std::vector<double> places;
  for (const ContactEvent& c : run.contacts) places.insert(places.end(), {c.place.x(), c.place.y(), c.place.z()});
  file.put(file.define(kContactPlace, NC_DOUBLE, {event, vector}, kContactPlaceName, "m"), places);
}

}  // namespace

void write_archive(const Trajectory& trajectory, const ArchiveTitle& title, const std::string& path) {
  PendingFile pending(path);
  NetcdfFile file(pending.temporary(), NetcdfFile::Mode::create, path);
  write_title(file, title, status_name(trajectory.status), trajectory.message);
  write_cost(file, trajectory);
  write_channels(file, trajectory);
  write_phases(file, trajectory);
  write_contacts(file, trajectory);
  write_static_poses(file, trajectory.static_poses);
  file.close();
  seal_file(pending.temporary(), path);
  pending.commit();
}

}  // namespace stillhook
