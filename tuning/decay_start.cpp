#include "tuning/decay_start.h"

#include <algorithm>
#include <cmath>

#include "sim/model.h"

namespace stillhook {
namespace {

constexpr double kFileUnit = 1e-3;  // t, kN and what is made of them, per SI

struct Keys {
  std::string inertia, linear, quadratic;
};

Keys keys_of(const std::string& body, int k) {
  const std::string at = "bodies." + body + ".hydrodynamics.", item = "." + std::to_string(k % 3);
  if (k < 3)
    return {at + "added_mass_t" + item, at + "linear_damping_kN_s_per_m" + item,
            at + "quadratic_damping_kN_s2_per_m2" + item};
  return {at + "added_inertia_t_m2" + item, at + "linear_angular_damping_kN_m_s_per_rad" + item,
          at + "quadratic_angular_damping_kN_m_s2_per_rad2" + item};
}

/// The value a key has, or nothing where the case has no such key.
std::optional<double> value_of(const Case& c, const std::string& key) {
  try {
    return key_value(c, key);
  } catch (const CaseError&) {
    return std::nullopt;
  }
}

}  // namespace

std::vector<DecayComparison> compare_decays(const RecordModel& model, const Prediction& simulated) {
  std::vector<DecayComparison> lines;
  if (model.data.kind != FitRecordSpec::Kind::decay) return lines;
  for (std::size_t k = 0; k < model.data.channels.size(); ++k) {
    const std::string& name = model.data.channels[k].spec.channel;
    const std::string quantity = name.substr(name.find_last_of('.') + 1);
    const auto& names = start_coordinate_names();
    const auto at = std::find(names.begin(), names.begin() + 6, quantity);
    if (at == names.begin() + 6) continue;
    DecayComparison line{name, analyse_decay(model.data.time, model.data.channels[k].value), {}};
    if (simulated.ok) {
      const VectorX& z = simulated.value[k];
      line.simulated = analyse_decay(model.data.time, std::vector<double>(z.data(), z.data() + z.size()));
    } else {
      line.simulated.message = simulated.message;
    }
    lines.push_back(std::move(line));
  }
  return lines;
}

std::map<std::string, double> start_from_decay(const RecordModel& model, const std::vector<DecayComparison>& lines) {
  std::map<std::string, double> start;
  if (model.body < 0) return start;
  const std::string& body = model.base.specification.bodies[static_cast<std::size_t>(model.body)].name;
  const Model built = build_model(model.base.specification);
  for (const DecayComparison& line : lines) {
    if (!line.measured.usable() || !line.simulated.usable()) continue;
    if (line.channel.substr(0, line.channel.find_last_of('.')) != body) continue;
    const auto& names = start_coordinate_names();
    const int k = static_cast<int>(
        std::find(names.begin(), names.end(), line.channel.substr(line.channel.find_last_of('.') + 1)) - names.begin());
    const double inertia = built.system().mass()(6 * model.body + k, 6 * model.body + k);
    const double stretch = std::pow(line.measured.period / line.simulated.period, 2);
    const Keys keys = keys_of(body, k);
    // The stiffness C = I w^2 is the model's; the inertia that gives the measured period follows.
    const double needed = inertia * stretch;
    const auto set = [&](const std::string& key, double change) {
      if (const auto now = value_of(model.base, key)) start[key] = std::max(0.0, *now + kFileUnit * change);
    };
    set(keys.inertia, needed - inertia);
    set(keys.linear, line.measured.linear(needed) - line.simulated.linear(inertia));
    set(keys.quadratic, line.measured.quadratic(needed) - line.simulated.quadratic(inertia));
  }
  return start;
}

}  // namespace stillhook
