#include "problems/tangent_run.h"

namespace stillhook {

// For the time being by central differences of whole runs.
TangentRun run_with_tangents(const Case& c, const TangentRequest& request, const RunOptions& options) {
  if (request.from || request.by_initial_state) throw CaseError("derivatives by the initial state are not there yet");
  const auto run = [&](const Case& changed) {
    Specification specification = changed.specification;
    if (request.until > 0.0) specification.solver.max_duration = request.until;
    const Model model = build_model(specification);
    return simulate(model, build_operation(model), options);
  };
  TangentRun result;
  result.trajectory = run(c);
  const auto samples = static_cast<Eigen::Index>(result.trajectory.time.size());
  const auto columns = static_cast<Eigen::Index>(request.keys.size());
  result.tangent.assign(request.channels.size(), Eigen::MatrixXd::Zero(samples, columns));
  for (Eigen::Index j = 0; j < columns; ++j) {
    const std::string& key = request.keys[static_cast<std::size_t>(j)];
    const double x = key_value(c, key), step = 1e-5 * std::max(1e-3, std::abs(x));
    const Trajectory plus = run(with_values(c, {{key, x + step}})), minus = run(with_values(c, {{key, x - step}}));
    for (std::size_t k = 0; k < request.channels.size(); ++k) {
      const int channel = plus.find(request.channels[k]);
      if (channel < 0) throw CaseError("there is no channel '" + request.channels[k] + "'");
      const auto n = std::min({plus.time.size(), minus.time.size(), result.trajectory.time.size()});
      for (std::size_t i = 0; i < n; ++i)
        result.tangent[k](static_cast<Eigen::Index>(i), j) =
            (plus.values[static_cast<std::size_t>(channel)][i] - minus.values[static_cast<std::size_t>(channel)][i]) /
            (2.0 * step);
    }
  }
  result.valid = result.trajectory.status == RunStatus::completed;
  return result;
}

}  // namespace stillhook
