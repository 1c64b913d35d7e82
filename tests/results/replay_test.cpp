// The data that a report carries for its replay, read back by an independent decoder.
#include "results/replay.h"

#include <zlib.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>

#include "results/series_codec.h"
#include "tests/results/synthetic_lift.h"

using namespace stillhook;

namespace {

std::string unbase64(const std::string& text) {
  std::string out;
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    if (c == '=') break;
    const int v = c >= 'A' && c <= 'Z'   ? c - 'A'
                  : c >= 'a' && c <= 'z' ? c - 'a' + 26
                  : c >= '0' && c <= '9' ? c - '0' + 52
                  : c == '+'             ? 62
                                         : 63;
    bits = bits << 6 | static_cast<std::uint32_t>(v);
    if ((count += 6) >= 8) out += static_cast<char>(bits >> (count -= 8) & 0xff);
  }
  return out;
}

std::string inflated(const std::string& packed) {
  std::string out(200 * packed.size() + 100000, '\0');
  uLongf size = out.size();
  REQUIRE(uncompress(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(packed.data()),
                     packed.size()) == Z_OK);
  out.resize(size);
  return out;
}

/// Zigzag-coded differences in byte planes, back to numbers modulo 2^(8 width).
std::vector<std::uint32_t> integers(const std::string& bytes, std::size_t at, std::size_t count, int width, int order) {
  const std::uint64_t modulus = std::uint64_t{1} << (8 * width);
  std::vector<std::uint32_t> values(count);
  for (std::size_t i = 0; i < count; ++i) {
    std::uint64_t coded = 0;
    for (int p = 0; p < width; ++p)
      coded |= std::uint64_t{static_cast<unsigned char>(bytes[at + static_cast<std::size_t>(p) * count + i])} << 8 * p;
    values[i] = static_cast<std::uint32_t>((coded % 2 ? modulus - (coded + 1) / 2 : coded / 2) % modulus);
  }
  for (int pass = 0; pass < order; ++pass)
    for (std::size_t i = 1; i < count; ++i)
      values[i] = static_cast<std::uint32_t>((std::uint64_t{values[i]} + values[i - 1]) % modulus);
  return values;
}

std::vector<double> series(const std::string& bytes, std::size_t at, std::size_t count, double low, double step,
                           int order) {
  std::vector<double> out;
  for (const std::uint32_t q : integers(bytes, at, count, 2, order))
    out.push_back(q == 65535 ? std::nan("") : low + step * q);
  return out;
}

struct Replay {
  nlohmann::json header;
  std::string blocks;

  explicit Replay(const std::string& text) {
    const std::string bytes = inflated(unbase64(text));
    std::uint32_t length = 0;
    for (int i = 3; i >= 0; --i) length = length << 8 | static_cast<unsigned char>(bytes[static_cast<std::size_t>(i)]);
    header = nlohmann::json::parse(bytes.substr(4, length));
    blocks = bytes.substr(4 + length);
  }
  std::vector<double> time() const {
    const std::size_t count = header["time"]["count"];
    std::vector<double> out;
    for (const std::uint32_t ms : integers(blocks, header["time"]["at"], count, 4, 2))
      out.push_back(header["time"]["start"].get<double>() + ms / 1000.0);
    return out;
  }
  std::vector<double> at(const nlohmann::json& index) const {
    const nlohmann::json& s = header["series"][index.get<std::size_t>()];
    return series(blocks, s["at"], header["time"]["count"], s["low"], s["step"], s["order"]);
  }
  const nlohmann::json& plot(const std::string& title) const {
    for (const nlohmann::json& p : header["plots"])
      if (p["title"] == title) return p;
    FAIL("no plot " << title);
    return header;
  }
};

Replay replay_of(const truth::SyntheticLift& lift, std::size_t budget = 6'000'000) {
  const Metrics metrics = compute_metrics(lift.specification, lift.trajectory);
  const std::vector<LimitCheck> checks = check_limits(lift.limits, metrics);
  const ReportData data{"Lift", "", "", "0.1.0", lift.specification, lift.trajectory, metrics, checks, {}, {}, {}};
  const RunView view(lift.specification, lift.trajectory);
  return Replay(
      replay_text(data, view, build_scene(lift.specification, lift.trajectory), report_figures(data, view), budget));
}

}  // namespace

TEST_CASE("a packed series reads back within half a step, gaps stay gaps, a constant is exact") {
  std::vector<double> values;
  for (int i = 0; i < 5000; ++i) values.push_back(3.0e6 * std::sin(0.01 * i) + 2.0e5 * std::sin(1.7 * i * i));
  values[17] = values[4000] = std::nan("");
  const PackedSeries packed = pack_series(values);
  CHECK(packed.step == Approx(6.4e6 / 65534).epsilon(0.01));  // the signal reaches about +-3.2e6
  const std::vector<double> back = series(packed.bytes, 0, values.size(), packed.low, packed.step, packed.order);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::isnan(values[i]))
      CHECK(std::isnan(back[i]));
    else if (std::abs(back[i] - values[i]) > 0.5001 * packed.step)  // half a step and rounding
      FAIL("sample " << i << ": " << back[i] << " for " << values[i]);
  }
  const std::vector<double> level(100, -7.25);
  const PackedSeries flat = pack_series(level);
  CHECK(series(flat.bytes, 0, 100, flat.low, flat.step, flat.order) == level);
}

TEST_CASE("base64 as in the examples of RFC 4648") {
  CHECK(base64("") == "");
  CHECK(base64("f") == "Zg==");
  CHECK(base64("fo") == "Zm8=");
  CHECK(base64("foo") == "Zm9v");
  CHECK(base64("fooba") == "Zm9vYmE=");
  CHECK(base64("foobar") == "Zm9vYmFy");
}

TEST_CASE("the replay holds the run: times, poses, tensions, phases and contacts") {
  const truth::SyntheticLift lift;
  const Replay replay = replay_of(lift);
  const Trajectory& run = lift.trajectory;
  const std::vector<double> time = replay.time();
  REQUIRE(time.size() == run.time.size());
  for (std::size_t i = 0; i < time.size(); ++i) REQUIRE(time[i] == Approx(run.time[i]).margin(0.0006));  // whole ms

  const nlohmann::json& bodies = replay.header["scene"]["bodies"];
  REQUIRE(bodies.size() == lift.specification.bodies.size());
  for (const nlohmann::json& body : bodies) {
    if (body["kind"] != "load") continue;
    const std::vector<double> x = replay.at(body["pose"][0]), w = replay.at(body["pose"][3]);
    const auto& truth_x = run.values[static_cast<std::size_t>(run.find("load.x"))];
    // Half of 1/65534 of the range of x, which is the swing and the travel, 10.4 m.
    for (std::size_t i = 0; i < x.size(); i += 97) CHECK(x[i] == Approx(truth_x[i]).margin(1.0e-4));
    for (std::size_t i = 0; i < x.size(); i += 97) {
      double norm = 0.0;
      for (std::size_t k = 3; k < 7; ++k) norm += std::pow(replay.at(body["pose"][k])[i], 2);
      CHECK(norm == Approx(1.0).margin(1e-4));
    }
    CHECK(w.front() > 0.9);  // the load stands upright
  }
  CHECK(replay.header["phases"].size() == run.phases.size());
  CHECK(replay.header["phases"][1]["stage"] == "transfer");
  CHECK(replay.header["contacts"].size() == run.contacts.size());
}

TEST_CASE("the replay turns bodies as the run did: roll, then pitch, then yaw, about the world's axes") {
  truth::SyntheticLift lift;
  Trajectory& run = lift.trajectory;
  const auto channel = [&](const char* name) -> std::vector<double>& {
    return run.values[static_cast<std::size_t>(run.find(name))];
  };
  // Three different angles, each large: another order, a mirrored turn or swapped parts of the quaternion show.
  const auto angles = [](double t) {
    return std::array{0.5 + 0.2 * std::sin(0.01 * t), -0.9 + 0.1 * std::cos(0.02 * t), 2.5 - 0.004 * t};
  };
  for (std::size_t i = 0; i < run.time.size(); ++i) {
    const auto [roll, pitch, yaw] = angles(run.time[i]);
    channel("load.roll")[i] = roll;
    channel("load.pitch")[i] = pitch;
    channel("load.yaw")[i] = yaw;
  }
  const Replay replay = replay_of(lift);
  const std::vector<double> time = replay.time();
  for (const nlohmann::json& body : replay.header["scene"]["bodies"]) {
    if (body["kind"] != "load") continue;
    std::array<std::vector<double>, 4> q;  // w, x, y, z
    for (std::size_t k = 0; k < 4; ++k) q[k] = replay.at(body["pose"][3 + k]);
    for (std::size_t i = 0; i < time.size(); i += 61) {
      CAPTURE(time[i]);
      const auto [roll, pitch, yaw] = angles(run.time[i]);
      const double cr = std::cos(roll), sr = std::sin(roll), cp = std::cos(pitch), sp = std::sin(pitch), cy = std::cos(yaw),
                   sy = std::sin(yaw);
      // Rz(yaw) Ry(pitch) Rx(roll) written out, and the matrix of a unit quaternion from the textbook.
      const double euler[3][3] = {{cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr},
                                  {sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr},
                                  {-sp, cp * sr, cp * cr}};
      const double w = q[0][i], x = q[1][i], y = q[2][i], z = q[3][i];
      const double turned[3][3] = {{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
                                   {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
                                   {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}};
      // Each part is stored to half of 1/65534 of its range of at most 2.
      for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column) CHECK(turned[row][column] == Approx(euler[row][column]).margin(2e-4));
    }
  }
}

TEST_CASE("a run beyond the budget keeps the peaks of every line") {
  truth::SyntheticLift lift;
  auto& z = lift.trajectory.values[static_cast<std::size_t>(lift.trajectory.find("load.z"))];
  z[1234] += 40.0;  // one sample high, one low, neither of which a sample every so often would meet
  z[2345] -= 30.0;
  const double highest = *std::max_element(z.begin(), z.end()), lowest = *std::min_element(z.begin(), z.end());
  const Replay replay = replay_of(lift, 30'000);
  CHECK(replay.header["time"]["count"].get<std::size_t>() < lift.trajectory.time.size() / 4);
  const std::vector<double> kept = replay.at(replay.plot("Load, height (z)")["lines"][0]["series"]);
  CHECK(*std::max_element(kept.begin(), kept.end()) == Approx(highest).margin(1e-3));  // a step of 1e-3 m
  CHECK(*std::min_element(kept.begin(), kept.end()) == Approx(lowest).margin(1e-3));
  const std::vector<double> time = replay.time();
  CHECK(std::is_sorted(time.begin(), time.end()));
}

TEST_CASE("the replay opens just before lift-off, and without one where the load begins to be taken over") {
  truth::SyntheticLift lift;
  CHECK(replay_of(lift).header["opens"].get<double>() == 85.0);  // lift-off at 90 s
  Trajectory& run = lift.trajectory;
  for (const char* wire : {"hoist_port.tension", "hoist_starboard.tension"})
    for (double& v : run.values[static_cast<std::size_t>(run.find(wire))]) v = 0.0;
  std::erase_if(run.contacts, [](const ContactEvent& c) { return c.role == ContactSpec::Role::pickup; });
  if (!std::isfinite(compute_metrics(lift.specification, run).value("lift_off_time")))
    CHECK(replay_of(lift).header["opens"].get<double>() == 60.0);
}

TEST_CASE("the scene knows where north is only if the case says so") {
  const truth::SyntheticLift lift;
  CHECK(replay_of(lift).header["scene"]["north"].is_null());
  const Metrics metrics = compute_metrics(lift.specification, lift.trajectory);
  const std::vector<LimitCheck> checks = check_limits(lift.limits, metrics);
  const ReportData data{
      "Lift", "", "", "0.1.0", lift.specification, lift.trajectory, metrics, checks, {}, {}, {}, nullptr,
      {},     {}, {}, 0.5};
  const RunView view(lift.specification, lift.trajectory);
  const Replay replay(replay_text(data, view, build_scene(lift.specification, lift.trajectory), {}));
  CHECK(replay.header["scene"]["north"].get<double>() == 0.5);
}
