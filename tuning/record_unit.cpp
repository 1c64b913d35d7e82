#include "tuning/record_unit.h"

#include <cmath>
#include <memory>

namespace stillhook {

VectorX FitParameters::span() const {
  VectorX s(static_cast<Eigen::Index>(specs.size()));
  for (std::size_t i = 0; i < specs.size(); ++i) s[static_cast<Eigen::Index>(i)] = specs[i].upper - specs[i].lower;
  return s;
}

VectorX FitParameters::scaled(const VectorX& values) const {
  VectorX x = values;
  for (std::size_t i = 0; i < specs.size(); ++i) x[static_cast<Eigen::Index>(i)] -= specs[i].lower;
  return x.cwiseQuotient(span());
}

VectorX FitParameters::values(const VectorX& scaled) const {
  VectorX p = scaled.cwiseProduct(span());
  for (std::size_t i = 0; i < specs.size(); ++i) {
    double& value = p[static_cast<Eigen::Index>(i)];
    value = std::clamp(value + specs[i].lower, specs[i].lower, specs[i].upper);  // rounding must not leave the range
  }
  return p;
}

VectorX FitParameters::of(const RecordModel& model, const VectorX& values) const {
  VectorX own(static_cast<Eigen::Index>(model.parameters.size()));
  for (std::size_t i = 0; i < model.parameters.size(); ++i) own[static_cast<Eigen::Index>(i)] = values[model.parameters[i]];
  return own;
}

SampleIndex valid_samples(const MeasuredRecord& record) {
  SampleIndex index;
  for (std::size_t k = 0; k < record.channels.size(); ++k)
    for (std::size_t i = 0; i < record.channels[k].value.size(); ++i) {
      if (std::isnan(record.channels[k].value[i])) continue;
      index.channel.push_back(static_cast<int>(k));
      index.sample.push_back(static_cast<Eigen::Index>(i));
    }
  return index;
}

FitUnit record_unit(const RecordModel& model, const FitParameters& parameters, const std::vector<double>& sigma,
                    int own_block, const RunOptions& options) {
  const auto index = std::make_shared<const SampleIndex>(valid_samples(model.data));
  FitUnit unit;
  unit.blocks = {0};
  FitGroup group;
  group.uses = {0};
  if (model.own() > 0) {
    unit.blocks.push_back(own_block);
    group.uses.push_back(1);
  }
  group.count = static_cast<int>(index->size());
  unit.groups = {group};
  const VectorX span = parameters.span();
  unit.evaluate = [&model, &parameters, sigma, index, span, options](const std::vector<VectorX>& x, VectorX& r,
                                                            std::vector<MatrixX>& J) -> std::string {
    const VectorX values = parameters.values(x[0]);
    const Prediction p = predict(model, parameters.of(model, values), model.own() > 0 ? x[1] : VectorX(), true, options);
    if (!p.ok) return model.data.name + ": " + p.message;
    const auto rows = static_cast<Eigen::Index>(index->size());
    const auto keys = static_cast<Eigen::Index>(model.keys.size());
    r.resize(rows);
    J.assign(x.size(), MatrixX());
    J[0] = MatrixX::Zero(rows, x[0].size());
    if (x.size() > 1) J[1] = MatrixX::Zero(rows, x[1].size());
    for (Eigen::Index row = 0; row < rows; ++row) {
      const auto k = static_cast<std::size_t>(index->channel[static_cast<std::size_t>(row)]);
      const Eigen::Index i = index->sample[static_cast<std::size_t>(row)];
      const double weight = 1.0 / sigma[k];
      r[row] = weight * (p.value[k][i] - model.data.channels[k].value[static_cast<std::size_t>(i)]);
      for (Eigen::Index j = 0; j < keys; ++j) {
        const int parameter = model.parameters[static_cast<std::size_t>(j)];
        J[0](row, parameter) = weight * p.tangent[k](i, j) * span[parameter];
      }
      if (x.size() > 1) J[1].row(row) = weight * p.tangent[k].row(i).tail(x[1].size());
    }
    return {};
  };
  return unit;
}

FitUnit prior_unit(const FitParameters& parameters) {
  std::vector<int> known;
  for (std::size_t i = 0; i < parameters.specs.size(); ++i)
    if (parameters.specs[i].prior_sd) known.push_back(static_cast<int>(i));
  FitUnit unit;
  unit.blocks = {0};
  unit.groups = {{{0}, static_cast<int>(known.size()), false}};
  unit.simulates = false;
  unit.evaluate = [&parameters, known](const std::vector<VectorX>& x, VectorX& r, std::vector<MatrixX>& J) -> std::string {
    const VectorX values = parameters.values(x[0]), span = parameters.span();
    r.resize(static_cast<Eigen::Index>(known.size()));
    J.assign(1, MatrixX::Zero(r.size(), x[0].size()));
    for (Eigen::Index row = 0; row < r.size(); ++row) {
      const int i = known[static_cast<std::size_t>(row)];
      const FitParameterSpec& spec = parameters.specs[static_cast<std::size_t>(i)];
      r[row] = (values[i] - *spec.prior_mean) / *spec.prior_sd;
      J[0](row, i) = span[i] / *spec.prior_sd;
    }
    return {};
  };
  return unit;
}

}  // namespace stillhook
