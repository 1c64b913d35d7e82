#include "results/replay.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <unordered_map>

#include "results/crane_readings.h"
#include "results/html.h"
#include "results/series_codec.h"
#include "sim/lifting/mooring.h"
#include "sim/run_channels.h"
#include "sim/sea/wave_field.h"
#include "sim/spatial/constants.h"

namespace stillhook {
namespace {

using Json = nlohmann::ordered_json;
constexpr double kTonne = kTonneForce;
constexpr double kBeforeLiftOff = 5.0;  // s, that the replay opens before it

Json numbers(const Vector3& v) { return {v.x(), v.y(), v.z()}; }
Json number_or_null(double v) { return std::isfinite(v) ? Json(v) : Json(nullptr); }

/// Which samples the page gets: all of them, or of every `bucket` of them two.
class Samples {
 public:
  Samples(const std::vector<double>& time, std::size_t series, std::size_t budget) : time_(time) {
    while (series * count() > budget && bucket_ < time.size()) bucket_ = bucket_ == 1 ? 4 : bucket_ + 2;
  }
  bool all() const { return bucket_ == 1; }
  std::size_t count() const { return all() ? time_.size() : 2 * ((time_.size() + bucket_ - 1) / bucket_); }
  /// Index of the sample that slot i stands for.
  std::size_t index(std::size_t i) const {
    return all() ? i : std::min(i / 2 * bucket_ + i % 2 * (bucket_ / 2), time_.size() - 1);
  }
  /// A signal sampled as it is, for poses.
  std::vector<double> plain(std::span<const double> values) const {
    std::vector<double> out(count());
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = values[index(i)];
    return out;
  }
  /// A signal with its peaks kept, for plots.
  std::vector<double> peaks(std::span<const double> values) const {
    if (all()) return {values.begin(), values.end()};
    std::vector<double> out(count(), kNaN);
    for (std::size_t b = 0; 2 * b < out.size(); ++b) {
      std::size_t lowest = values.size(), highest = values.size();
      for (std::size_t i = b * bucket_; i < std::min(values.size(), (b + 1) * bucket_); ++i) {
        if (!std::isfinite(values[i])) continue;
        if (lowest == values.size() || values[i] < values[lowest]) lowest = i;
        if (highest == values.size() || values[i] > values[highest]) highest = i;
      }
      if (lowest == values.size()) continue;
      out[2 * b] = values[std::min(lowest, highest)];
      out[2 * b + 1] = values[std::max(lowest, highest)];
    }
    return out;
  }

 private:
  const std::vector<double>& time_;
  std::size_t bucket_ = 1;
};

class Payload {
 public:
  explicit Payload(const Samples& samples) : samples_(samples) {}

  int add_series(std::span<const double> values) {
    const PackedSeries packed = pack_series(values);
    const std::size_t at = add_block(packed.bytes);
    const Json entry = {{"at", at}, {"low", packed.low}, {"step", packed.step}, {"order", packed.order}};
    const auto [known, fresh] = series_index_.emplace(entry.dump(), static_cast<int>(series_.size()));
    if (fresh) series_.push_back(entry);
    return known->second;
  }
  std::size_t add_block(const std::string& bytes) {
    // The same signal in another unit has the same levels: it is stored once.
    const auto [known, fresh] = block_at_.emplace(std::hash<std::string>{}(bytes), blocks_.size());
    if (!fresh && blocks_.compare(known->second, bytes.size(), bytes) == 0) return known->second;
    const std::size_t at = blocks_.size();
    blocks_ += bytes;
    return at;
  }
  const Samples& samples() const { return samples_; }

  std::string text(Json header) const {
    header["series"] = series_;
    const std::string head = header.dump();
    std::string bytes(4, '\0');
    for (int i = 0; i < 4; ++i) bytes[static_cast<std::size_t>(i)] = static_cast<char>(head.size() >> (8 * i) & 0xff);
    return base64(deflated(bytes + head + blocks_));
  }

 private:
  const Samples& samples_;
  std::string blocks_;
  Json series_ = Json::array();
  std::unordered_map<std::size_t, std::size_t> block_at_;
  std::unordered_map<std::string, int> series_index_;
};

std::string float_bytes(const std::vector<float>& values) {
  std::string bytes(values.size() * sizeof(float), '\0');
  std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

Json mesh_entry(const Mesh& mesh, Payload& payload) {
  if (mesh.triangles.empty()) return nullptr;
  std::vector<float> vertices;
  for (const Vector3& v : mesh.vertices)
    for (int i = 0; i < 3; ++i) vertices.push_back(static_cast<float>(v[i]));
  std::vector<std::uint32_t> corners;
  for (const auto& triangle : mesh.triangles)
    for (const int corner : triangle) corners.push_back(static_cast<std::uint32_t>(corner));
  return {{"vertices", payload.add_block(float_bytes(vertices))},
          {"vertex_count", mesh.vertices.size()},
          {"corners", payload.add_block(pack_integers(corners))},
          {"corner_count", corners.size()}};
}

/// Position and attitude of a body as seven series; empty if it was not recorded.
Json pose_entry(const RunView& view, const std::string& body, Payload& payload) {
  Json pose = Json::array();
  std::array<std::span<const double>, 3> angles;
  for (const auto& axis : body_channels::position) {
    const auto values = view.series(axis.of(body));
    if (values.empty()) return Json::array();
    pose.push_back(payload.add_series(payload.samples().plain(values)));
  }
  for (std::size_t i = 0; i < 3; ++i) {
    angles[i] = view.series(body_channels::attitude[i].of(body));
    if (angles[i].empty()) return Json::array();
  }
  const std::size_t n = payload.samples().count();
  std::array<std::vector<double>, 4> parts;
  for (auto& part : parts) part.resize(n);
  Eigen::Vector4d before = Eigen::Vector4d::Zero();
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t i = payload.samples().index(k);
    const Eigen::Quaterniond q(rotation_from({angles[0][i], angles[1][i], angles[2][i]}));
    Eigen::Vector4d now(q.w(), q.x(), q.y(), q.z());
    if (now.dot(before) < 0.0) now = -now;  // q and -q are one attitude: stay on one side
    for (std::size_t c = 0; c < 4; ++c) parts[c][k] = now[static_cast<Eigen::Index>(c)];
    before = now;
  }
  for (const auto& part : parts) pose.push_back(payload.add_series(part));
  return pose;
}

const char* kind_name(SceneBody::Kind kind) {
  switch (kind) {
    case SceneBody::Kind::crane:
      return "crane";
    case SceneBody::Kind::load:
      return "load";
    case SceneBody::Kind::vessel:
      return "vessel";
    case SceneBody::Kind::member:
      break;
  }
  return "member";
}

const char* kind_name(SceneLine::Kind kind) {
  static constexpr std::array<const char*, 6> kNames = {"hoist", "luffing", "stay", "sling", "other", "tagline"};
  return kNames[static_cast<std::size_t>(kind)];
}

const char* role_name(ContactSpec::Role role) {
  return role == ContactSpec::Role::pickup ? "pickup" : role == ContactSpec::Role::target ? "target" : "other";
}

const char* stage_name(PhaseSpec::Stage stage) {
  static constexpr std::array<const char*, 5> kNames = {"on_barge", "transfer", "hanging", "set_down", "landed"};
  return kNames[static_cast<std::size_t>(stage)];
}

/// A channel as a series, -1 if it was not recorded.
int channel_series(const RunView& view, const std::string& name, Payload& payload, double factor = 1.0) {
  const auto values = view.series(name);
  if (values.empty()) return -1;
  std::vector<double> scaled = payload.samples().peaks(values);
  for (double& v : scaled) v *= factor;
  return payload.add_series(scaled);
}

Json sea_entry(const SeaSpec& sea) {
  Json entry = {{"ramp", sea.ramp}, {"depth", sea.depth}, {"components", Json::array()}};
  const WaveField field = build_wave_field(sea);
  for (const WaveComponent& c : field.components())
    entry["components"].push_back(
        {c.amplitude, c.frequency, c.wavenumber * c.cos_heading, c.wavenumber * c.sin_heading, c.phase});
  return entry;
}

Json bodies_entry(const Scene& scene, const RunView& view, Payload& payload) {
  Json bodies = Json::array();
  for (const SceneBody& body : scene.bodies) {
    const auto bars = [](const std::vector<SceneBody::Member>& members) {
      Json out = Json::array();
      for (const SceneBody::Member& m : members)
        out.push_back({{"from", numbers(m.from)}, {"to", numbers(m.to)}, {"radius", m.radius}});
      return out;
    };
    bodies.push_back({{"name", readable_name(body.name)},
                      {"kind", kind_name(body.kind)},
                      {"floats", body.floats},
                      {"mesh", mesh_entry(body.mesh, payload)},
                      {"envelope", mesh_entry(body.envelope, payload)},
                      {"members", bars(body.members)},
                      {"pedestals", bars(body.pedestals)},
                      {"pose", pose_entry(view, body.name, payload)}});
  }
  return bodies;
}

Json scene_entry(const ReportData& data, const RunView& view, const Scene& scene, Payload& payload) {
  Json out = {{"sea", sea_entry(data.specification.sea)},
              {"north", data.north ? Json(*data.north) : Json(nullptr)},
              {"target", numbers(data.specification.operation.target)},
              {"load_reference", numbers(data.specification.operation.load_reference)},
              {"bodies", bodies_entry(scene, view, payload)},
              {"lines", Json::array()},
              {"moorings", Json::array()},
              {"surfaces", Json::array()},
              {"arrows", Json::array()}};
  for (const SceneLine& line : scene.lines)
    out["lines"].push_back({{"name", readable_name(line.name)},
                            {"kind", kind_name(line.kind)},
                            {"from", line.from},
                            {"to", line.to},
                            {"point_from", numbers(line.point_from)},
                            {"point_to", numbers(line.point_to)},
                            {"reference", line.reference / kTonne},
                            {"shown_from", number_or_null(line.shown_from)},
                            {"tension", channel_series(view, line.tension, payload, 1.0 / kTonne)}});
  for (const SceneMooring& m : scene.moorings)
    out["moorings"].push_back(
        {{"name", readable_name(m.name)},
         {"body", m.body},
         {"fairlead", numbers(m.fairlead)},
         {"anchor", numbers(m.anchor)},
         {"weight", m.weight},
         {"horizontal", channel_series(view, mooring_channels::horizontal_tension.of(m.name), payload)},
         {"tow", m.tow.empty() ? -1 : channel_series(view, drive_channels::position.of(m.tow), payload)},
         {"tow_direction", numbers(m.tow_direction)}});
  for (const SceneArrow& arrow : scene.arrows)
    out["arrows"].push_back(
        {{"name", readable_name(arrow.name)},
         {"body", arrow.body},
         {"point", numbers(arrow.point)},
         {"reference", arrow.reference},
         {"force",
          {channel_series(view, arrow.force[0], payload), channel_series(view, arrow.force[1], payload),
           channel_series(view, arrow.force[2], payload)}}});
  for (const SceneSurface& s : scene.surfaces)
    out["surfaces"].push_back({{"name", readable_name(s.name)},
                               {"role", role_name(s.role)},
                               {"body", s.body},
                               {"centre", numbers(s.centre)},
                               {"length", s.length},
                               {"breadth", s.breadth}});
  return out;
}

Json phases_entry(const Trajectory& run) {
  Json out = Json::array();
  for (const PhaseRecord& p : run.phases)
    out.push_back(
        {{"name", readable_name(p.name)}, {"stage", stage_name(p.stage)}, {"start", p.start}, {"end", p.end}});
  return out;
}

/// Where the replay opens: just before the load lifts off, or where something begins to move.
double opening_time(const ReportData& data) {
  const std::vector<PhaseRecord>& phases = data.trajectory.phases;
  if (phases.empty()) return 0.0;
  const double lift_off = data.metrics.value("lift_off_time");
  if (std::isfinite(lift_off)) return std::max(phases.front().start, lift_off - kBeforeLiftOff);
  for (const PhaseRecord& phase : phases)
    if (phase.stage != PhaseSpec::Stage::on_barge) return phase.start;
  return phases.front().start;
}

Json contacts_entry(const ReportData& data) {
  Json out = Json::array();
  for (const ContactEvent& c : data.trajectory.contacts) {
    if (out.size() == kShownContacts) break;
    out.push_back({{"name", readable_name(c.contact)},
                   {"kind", contact_kind(data, c)},
                   {"time", c.start},
                   {"place", numbers(c.place)},
                   {"speed", c.approach_speed},
                   {"force", c.peak_force / kTonne}});
  }
  return out;
}

/// Values of a line at the run's sample times, straight between its points; gaps before, after and across gaps.
std::vector<double> on_samples(const PlotLine& line, const std::vector<double>& time) {
  if (line.time.size() == time.size()) return line.value;
  std::vector<double> out(time.size(), kNaN);
  std::size_t after = 0;
  for (std::size_t i = 0; i < time.size(); ++i) {
    while (after < line.time.size() && line.time[after] < time[i]) ++after;
    if (after == line.time.size()) break;
    if (line.time[after] == time[i])
      out[i] = line.value[after];
    else if (after > 0)
      out[i] = line.value[after - 1] + (line.value[after] - line.value[after - 1]) * (time[i] - line.time[after - 1]) /
                                           (line.time[after] - line.time[after - 1]);
  }
  return out;
}

Json plot_entry(const Plot& plot, const std::vector<double>& time, Payload& payload) {
  Json out = {{"title", plot.title},
              {"y_label", plot.y_label},
              {"lines", Json::array()},
              {"limits", Json::array()},
              {"ranges", Json::array()}};
  for (const PlotLine& line : plot.lines)
    out["lines"].push_back(
        {{"label", line.label}, {"series", payload.add_series(payload.samples().peaks(on_samples(line, time)))}});
  for (const PlotLimit& limit : plot.limits)
    out["limits"].push_back({{"label", limit.label}, {"value", number_or_null(limit.value)}});
  for (const PlotRange& range : plot.ranges)
    out["ranges"].push_back(
        {{"label", range.label}, {"low", number_or_null(range.low)}, {"high", number_or_null(range.high)}});
  return out;
}

Json readings_entry(const ReportData& data, const RunView& view, Payload& payload) {
  Json out = Json::array();
  const auto add = [&](const std::string& label, const std::string& unit, int decimals, int series) {
    if (series >= 0) out.push_back({{"label", label}, {"unit", unit}, {"decimals", decimals}, {"series", series}});
  };
  for (const CraneReading& reading : crane_readings(view))
    add(reading.label, reading.unit, reading.decimals, payload.add_series(payload.samples().peaks(reading.values)));
  add("load height", "m", 2, channel_series(view, body_channels::z.of(data.specification.operation.load), payload));
  add("wave", "m", 2, channel_series(view, sea_channels::elevation, payload));
  return out;
}

}  // namespace

std::string replay_text(const ReportData& data, const RunView& view, const Scene& scene,
                        const std::vector<ReportFigure>& figures, std::size_t budget) {
  const std::vector<double>& time = data.trajectory.time;
  std::size_t series = 7 * scene.bodies.size() + scene.lines.size() + 2 * scene.moorings.size() +
                       3 * scene.arrows.size() + 3 +
                       3 * scene.lines.size();  // readings: at most three for each hoist wire
  for (const ReportFigure& figure : figures) series += figure.plot.lines.size();
  const Samples samples(time, series, budget);
  Payload payload(samples);

  std::vector<std::uint32_t> milliseconds;
  const double start = time.empty() ? 0.0 : time.front();
  for (std::size_t i = 0; i < samples.count(); ++i)
    milliseconds.push_back(static_cast<std::uint32_t>(std::llround(1000.0 * (time[samples.index(i)] - start))));
  Json header = {
      {"title", data.title.empty() ? data.specification.name : data.title},
      {"time",
       {{"at", payload.add_block(pack_integers(milliseconds))}, {"count", milliseconds.size()}, {"start", start}}},
      {"opens", opening_time(data)},
      {"phases", phases_entry(data.trajectory)},
      {"contacts", contacts_entry(data)},
      {"scene", scene_entry(data, view, scene, payload)},
      {"readings", readings_entry(data, view, payload)},
      {"plots", Json::array()}};
  for (const ReportFigure& figure : figures) header["plots"].push_back(plot_entry(figure.plot, time, payload));
  return payload.text(std::move(header));
}

}  // namespace stillhook
