#include "sim/hull/parting_hydrodynamics.h"

#include <stdexcept>

namespace stillhook {

PartingHydrodynamics::PartingHydrodynamics(std::unique_ptr<const ForceElement> together,
                                           std::vector<std::unique_ptr<const ForceElement>> apart, int phase)
    : ForceElement(together->name()), phase_(phase) {
  elements_.push_back(std::move(together));
  for (auto& element : apart) elements_.push_back(std::move(element));
  std::vector<std::string> coupled, single;
  for (std::size_t i = 0; i < elements_.size(); ++i) {
    state_offset_.push_back(state_size_);
    scratch_offset_.push_back(scratch_size_);
    state_size_ += elements_[i]->state_size();
    scratch_size_ += elements_[i]->scratch_size();
    const std::vector<Channel> own = elements_[i]->channels();
    channels_.push_back(own.size());
    for (const Channel& channel : own) (i == 0 ? coupled : single).push_back(channel.name);
  }
  if (phase_ <= 0 || coupled != single)
    throw std::invalid_argument("parting hydrodynamics: the hulls apart are not those together");
}

Memory PartingHydrodynamics::memory(int i, Memory m) const {
  return {m.state.subspan(state_offset_[i], elements_[i]->state_size()),
          m.scratch.subspan(scratch_offset_[i], elements_[i]->scratch_size())};
}

void PartingHydrodynamics::start(const Instant& now, Memory m) const {
  for (int i = 0; i < static_cast<int>(elements_.size()); ++i) elements_[i]->start(now, memory(i, m));
}

void PartingHydrodynamics::begin_step(const Instant& before, double h, Memory m) const {
  for (int i = 0; i < static_cast<int>(elements_.size()); ++i) elements_[i]->begin_step(before, h, memory(i, m));
}

void PartingHydrodynamics::add_forces(const Instant& now, double h, Memory m, ForceSum& out) const {
  for (int i = first(now.phase); i < end(now.phase); ++i) elements_[i]->add_forces(now, h, memory(i, m), out);
}

void PartingHydrodynamics::add_jacobian(const Instant& now, double h, Memory m, JacobianSum& out) const {
  for (int i = first(now.phase); i < end(now.phase); ++i) elements_[i]->add_jacobian(now, h, memory(i, m), out);
}

void PartingHydrodynamics::end_step(const Instant& now, double h, Memory m) const {
  for (int i = 0; i < static_cast<int>(elements_.size()); ++i) elements_[i]->end_step(now, h, memory(i, m));
}

void PartingHydrodynamics::add_mass(MatrixX& M, int phase) const {
  for (int i = first(phase); i < end(phase); ++i) elements_[i]->add_mass(M, phase);
}

double PartingHydrodynamics::dissipated_power(const Instant& now, Memory m) const {
  double power = 0.0;
  for (int i = first(now.phase); i < end(now.phase); ++i) power += elements_[i]->dissipated_power(now, memory(i, m));
  return power;
}

std::vector<Channel> PartingHydrodynamics::channels() const { return elements_[0]->channels(); }

void PartingHydrodynamics::measure(const Instant& now, Memory m, std::span<double> out) const {
  std::size_t at = 0;
  for (int i = first(now.phase); i < end(now.phase); ++i) {
    elements_[i]->measure(now, memory(i, m), out.subspan(at, channels_[i]));
    at += channels_[i];
  }
}

}  // namespace stillhook
