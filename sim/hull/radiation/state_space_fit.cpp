#include "sim/hull/radiation/state_space_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "sim/hull/radiation/pole_refinement.h"
#include "sim/specification.h"

namespace stillhook {
namespace {

// A fit whose |K_ii| outside the band exceeds its largest value within it by more than this has put a resonance where
// there are no data. K of a hull falls off on both sides of its peak, which the band has to hold.
constexpr double kBeyondBand = 1.1;
// Moving the poles has halved errors, at most quartered them: beyond this many tolerances a higher order is next.
constexpr double kHopeless = 5.0;

/// K(i w) over the band.
struct TransferData {
  std::string origin;
  std::vector<double> frequency;  // rad/s
  std::vector<double> weight;     // trapezoidal, sum 1
  std::vector<MatrixXc> K;        // symmetric
  VectorX largest, rms;           // of |K_ii|
  double asymmetry = 0.0;

  double relative(int i, int j) const { return std::sqrt(largest(i) * largest(j)); }
};

std::string pair_name(int i, int j) {
  std::ostringstream out;
  out << "K(" << i + 1 << ',' << j + 1 << ')';
  return out.str();
}

void require_options(const StateSpaceOptions& o, const std::string& source) {
  const auto require = [&](bool good, const char* field, const char* rule) {
    if (!good) throw SpecificationError(source, field, rule);
  };
  require(o.tolerance > 0.0 && o.tolerance < 1.0, "tolerance", "must be > 0 and < 1");
  require(o.lowest_order >= 2, "lowest_order", "must be at least 2");
  require(o.highest_order >= o.lowest_order, "highest_order", "must not be below lowest_order");
  require(o.negligible >= 0.0 && o.negligible < 0.1, "negligible", "must be >= 0 and < 0.1");
  require(o.damping_floor > 0.0 && o.damping_floor < 0.01, "damping_floor", "must be > 0 and < 0.01");
  require(o.highest_frequency > 0.0, "highest_frequency", "must be > 0 rad/s");
  require(o.fewest_frequencies >= 4, "fewest_frequencies", "must be at least 4");
}

void add_tables(const HydrodynamicCoefficients& c, TransferData& data) {
  data.origin = "tables of A(w), B(w)";
  for (const FrequencyCoefficients& f : c.frequency) {
    if (!(f.frequency > 0.0) || !std::isfinite(f.frequency)) continue;
    data.frequency.push_back(f.frequency);
    MatrixXc K(c.modes(), c.modes());
    K.real() = f.B;
    K.imag() = f.frequency * (f.A - c.A_inf);
    data.K.push_back(K);
  }
}

void add_kernels(const HydrodynamicCoefficients& c, double highest, int fewest, TransferData& data) {
  data.origin = "retardation functions";
  // A kernel of duration T varies over frequencies no faster than cos(w T).
  const double wanted = std::min(0.05, 1.5 / c.retardation.duration());
  const int count = std::max(fewest, static_cast<int>(std::ceil(highest / wanted)));
  for (int n = 1; n <= count; ++n) {
    const double w = highest * n / count;
    data.frequency.push_back(w);
    MatrixXc K(c.modes(), c.modes());
    K.real() = damping_from_kernels(c.retardation, c.modes(), w);
    K.imag() = w * added_mass_from_kernels(MatrixX::Zero(c.modes(), c.modes()), c.retardation, w);
    data.K.push_back(K);
  }
}

TransferData transfer_data(const HydrodynamicCoefficients& c, const StateSpaceOptions& options) {
  TransferData data;
  // Two real numbers at each frequency for every state and its pole, and as many again to judge the fit by.
  const int fewest = std::max(options.fewest_frequencies, 2 * options.lowest_order);
  const auto usable = [](const FrequencyCoefficients& f) { return f.frequency > 0.0 && std::isfinite(f.frequency); };
  const long tabulated = std::count_if(c.frequency.begin(), c.frequency.end(), usable);
  if (tabulated >= fewest) {
    add_tables(c, data);
  } else if (!c.retardation.empty()) {
    add_kernels(c, options.highest_frequency, fewest, data);
  } else {
    std::ostringstream sentence;
    sentence << "a state space needs retardation functions or A and B at " << fewest
             << " frequencies above zero at least; there are " << tabulated;
    throw SpecificationError(c.source, "", sentence.str());
  }
  const int n = static_cast<int>(data.frequency.size());
  double sum = 0.0;
  for (int k = 0; k < n; ++k) {
    const double before = k > 0 ? data.frequency[k - 1] : data.frequency[k];
    const double after = k + 1 < n ? data.frequency[k + 1] : data.frequency[k];
    data.weight.push_back(0.5 * (after - before));
    sum += data.weight[k];
    if (k > 0 && before >= data.frequency[k])
      throw SpecificationError(c.source, "", "the frequencies of A and B must ascend");
  }
  data.largest = data.rms = VectorX::Zero(c.modes());
  for (int k = 0; k < n; ++k) {
    if (!data.K[k].allFinite()) throw SpecificationError(c.source, "", "A, B or A_inf are not finite");
    data.weight[k] /= sum;
    const VectorX diagonal = data.K[k].diagonal().cwiseAbs();
    data.largest = data.largest.cwiseMax(diagonal);
    data.rms += data.weight[k] * diagonal.cwiseAbs2();
  }
  data.rms = data.rms.cwiseSqrt();
  for (MatrixXc& K : data.K) {
    const MatrixXc skew = 0.5 * (K - K.transpose());
    for (int i = 0; i < c.modes(); ++i)
      for (int j = 0; j < i; ++j)
        if (data.relative(i, j) > 0.0)
          data.asymmetry = std::max(data.asymmetry, std::abs(skew(i, j)) / data.relative(i, j));
    K -= skew;
  }
  return data;
}

/// Groups of modes that the data couple; modes without any radiation belong to none.
std::vector<std::vector<int>> coupled_modes(const TransferData& data, const HydrodynamicCoefficients& c,
                                            double negligible, double& neglected) {
  const int n = c.modes();
  std::vector<int> group(n);
  for (int i = 0; i < n; ++i) group[i] = i;
  for (int i = 0; i < n; ++i)
    for (int j = i + 1; j < n; ++j) {
      double largest = 0.0;
      for (const MatrixXc& K : data.K) largest = std::max(largest, std::abs(K(i, j)));
      if (largest == 0.0) continue;
      const double scale = data.relative(i, j);
      if (scale == 0.0)
        throw SpecificationError(c.source, "",
                                 pair_name(i, j).append(" couples a mode that has no radiation of its own"));
      if (largest <= negligible * scale) {
        neglected = std::max(neglected, largest / scale);
        continue;
      }
      const int from = group[j], to = group[i];
      std::replace(group.begin(), group.end(), from, to);
    }
  std::vector<std::vector<int>> groups;
  for (int g = 0; g < n; ++g) {
    std::vector<int> members;
    for (int i = 0; i < n; ++i)
      if (group[i] == g && data.largest(i) > 0.0) members.push_back(i);
    if (!members.empty()) groups.push_back(members);
  }
  return groups;
}

/// One block with one order.
struct Candidate {
  StateSpaceBlock block;
  StateSpaceBlockReport report;
  std::vector<StateSpacePair> pairs;
  double worst = 0.0;  // largest error of a pair

  const StateSpacePair& worst_pair() const {
    return *std::max_element(pairs.begin(), pairs.end(),
                             [](const auto& a, const auto& b) { return a.error < b.error; });
  }
};

bool meets(const Candidate& candidate, double tolerance) {
  return candidate.worst <= tolerance && candidate.report.beyond_band <= kBeyondBand;
}

bool resonates_outside(const Candidate& candidate) { return candidate.report.beyond_band > kBeyondBand; }

/// w0 of passivity.h.
double middle_of_band(const TransferData& data) { return data.frequency.back() / 3.0; }

TransferSamples samples_of(const TransferData& data, const std::vector<int>& modes) {
  TransferSamples samples{data.frequency, data.weight, {}};
  for (std::size_t i = 0; i < modes.size(); ++i)
    for (std::size_t j = i; j < modes.size(); ++j) {
      std::vector<Complex> entry;
      for (const MatrixXc& K : data.K) entry.push_back(K(modes[i], modes[j]) / data.relative(modes[i], modes[j]));
      samples.entries.push_back(std::move(entry));
    }
  return samples;
}

/// Largest |K_ii| outside the band over the largest within; `K` in relative units.
double beyond_band(const PoleResidue& K, double lowest, double highest) {
  std::vector<double> outside;
  for (int n = 0; n <= 200; ++n) {
    outside.push_back(highest * std::pow(100.0, n / 200.0));
    outside.push_back(lowest * n / 200.0);
  }
  for (const Complex& p : K.poles) {  // a sharp resonance peaks here
    const double w = std::abs(p);
    if (w > highest || w < lowest) outside.push_back(w);
  }
  double largest = 0.0;
  for (double w : outside) largest = std::max(largest, K.transfer({0.0, w}).diagonal().cwiseAbs().maxCoeff());
  return largest;
}

void measure_errors(const TransferData& data, Candidate& candidate) {
  const std::vector<int>& modes = candidate.block.modes;
  std::vector<MatrixXc> fitted;
  for (double w : data.frequency) fitted.push_back(candidate.block.K.transfer({0.0, w}));
  for (std::size_t a = 0; a < modes.size(); ++a)
    for (std::size_t b = a; b < modes.size(); ++b) {
      const int i = modes[a], j = modes[b];
      Complex mean = 0.0;
      for (std::size_t k = 0; k < fitted.size(); ++k) mean += data.weight[k] * data.K[k](i, j);
      double squares = 0.0, about_mean = 0.0;
      for (std::size_t k = 0; k < fitted.size(); ++k) {
        squares += data.weight[k] * std::norm(fitted[k](a, b) - data.K[k](i, j));
        about_mean += data.weight[k] * std::norm(data.K[k](i, j) - mean);
      }
      StateSpacePair pair{i, j, std::sqrt(squares / (data.rms(i) * data.rms(j))), 1.0 - squares / about_mean};
      candidate.worst = std::max(candidate.worst, pair.error);
      candidate.pairs.push_back(pair);
    }
}

Candidate with_poles(const TransferData& data, const TransferSamples& samples, const std::vector<int>& modes,
                     const std::vector<Complex>& poles, double floor) {
  const int m = static_cast<int>(modes.size());
  const double w0 = middle_of_band(data);
  PassiveResidues passive = fit_passive_residues(PoleBasis(poles), samples, m, w0, floor);
  Candidate candidate;
  candidate.report = {modes,
                      passive.model.order(),
                      0.25 * passive.test.least,
                      passive.test.frequency,
                      passive.constrained,
                      beyond_band(passive.model, data.frequency.front(), data.frequency.back())};
  candidate.block = {modes, std::move(passive.model)};
  for (MatrixXc& R : candidate.block.K.residues)
    for (int i = 0; i < m; ++i)
      for (int j = 0; j < m; ++j) R(i, j) *= data.relative(modes[i], modes[j]);
  measure_errors(data, candidate);
  return candidate;
}

/// The poles of vector fitting where they serve, else refined ones.
Candidate fit_block(const TransferData& data, const TransferSamples& samples, const std::vector<int>& modes, int order,
                    const StateSpaceOptions& options) {
  const double floor = 4.0 * options.damping_floor;  // P = 4 Re K at w0
  const std::vector<Complex> poles = fit_poles(samples, order);
  Candidate fitted = with_poles(data, samples, modes, poles, floor);
  if (meets(fitted, options.tolerance) || fitted.worst > kHopeless * options.tolerance) return fitted;
  const int m = static_cast<int>(modes.size());
  Candidate refined =
      with_poles(data, samples, modes, refine_poles(poles, samples, m, middle_of_band(data), floor), floor);
  return refined.worst < fitted.worst ? refined : fitted;
}

/// The block with the lowest order that meets the tolerance.
Candidate fit_lowest_order(const TransferData& data, const std::vector<int>& modes, const StateSpaceOptions& options,
                           const std::string& source) {
  const TransferSamples samples = samples_of(data, modes);
  const int highest = std::min(options.highest_order, static_cast<int>(data.frequency.size()) / 2);
  Candidate best;
  best.worst = best.report.beyond_band = std::numeric_limits<double>::infinity();
  for (int order = options.lowest_order; order <= highest; ++order) {
    Candidate candidate = fit_block(data, samples, modes, order, options);
    if (meets(candidate, options.tolerance)) return candidate;
    // One that resonates outside the data is taken for want of another only.
    const bool alike = resonates_outside(candidate) == resonates_outside(best);
    if (alike ? candidate.worst < best.worst : resonates_outside(best)) best = std::move(candidate);
  }
  if (meets(best, options.acceptable)) return best;
  std::ostringstream sentence;
  const StateSpacePair& pair = best.worst_pair();
  sentence << "no state space of " << options.lowest_order << " to " << highest << " states per mode fits "
           << pair_name(pair.i, pair.j);
  if (best.worst > options.tolerance)
    sentence << ": the best, with " << best.report.order << ", is off by " << pair.error << ", allowed "
             << options.tolerance;
  else
    sentence << " without a resonance outside the data's " << data.frequency.front() << " to " << data.frequency.back()
             << " rad/s: the best reaches " << best.report.beyond_band << " times the largest value within";
  throw SpecificationError(source, "", sentence.str());
}

}  // namespace

int StateSpaceFit::states() const {
  int sum = 0;
  for (const StateSpaceBlock& block : blocks) sum += block.K.order() * static_cast<int>(block.modes.size());
  return sum;
}

MatrixXc StateSpaceFit::transfer(Complex s) const {
  MatrixXc K = MatrixXc::Zero(modes, modes);
  for (const StateSpaceBlock& block : blocks) K(block.modes, block.modes) = block.K.transfer(s);
  return K;
}

MatrixX StateSpaceFit::damping(double frequency) const { return transfer({0.0, frequency}).real(); }

MatrixX StateSpaceFit::added_mass_change(double frequency) const {
  return transfer({0.0, frequency}).imag() / frequency;
}

MatrixX StateSpaceFit::retardation(double t) const {
  MatrixX K = MatrixX::Zero(modes, modes);
  for (const StateSpaceBlock& block : blocks) K(block.modes, block.modes) = block.K.impulse_response(t);
  return K;
}

double StateSpaceReport::worst_r_squared() const {
  double worst = 1.0;
  for (const StateSpacePair& pair : pairs)
    if (pair.i == pair.j) worst = std::min(worst, pair.r_squared);
  return worst;
}

double StateSpaceReport::worst_error() const {
  double worst = 0.0;
  for (const StateSpacePair& pair : pairs) worst = std::max(worst, pair.error);
  return worst;
}

StateSpaceModel fit_state_space(const HydrodynamicCoefficients& c, const StateSpaceOptions& options) {
  require_options(options, c.source);
  const TransferData data = transfer_data(c, options);
  StateSpaceModel result;
  result.fit.modes = c.modes();
  result.report.data = data.origin;
  result.report.lowest = data.frequency.front();
  result.report.highest = data.frequency.back();
  result.report.frequencies = static_cast<int>(data.frequency.size());
  result.report.tolerance = options.tolerance;
  result.report.asymmetry = data.asymmetry;
  for (const std::vector<int>& modes : coupled_modes(data, c, options.negligible, result.report.neglected)) {
    Candidate block = fit_lowest_order(data, modes, options, c.source);
    result.fit.blocks.push_back(std::move(block.block));
    result.report.blocks.push_back(std::move(block.report));
    result.report.pairs.insert(result.report.pairs.end(), block.pairs.begin(), block.pairs.end());
  }
  if (result.fit.blocks.empty())
    throw SpecificationError(c.source, "", "there is no radiation to fit: A(w) = A_inf and B(w) = 0");
  result.report.states = result.fit.states();
  return result;
}

}  // namespace stillhook
