// SPDX-License-Identifier: BSD-3-Clause
// Relaxation of carried fields in stages.
#include "physics/director/carried_field.hpp"

#include "meniscus/error.hpp"
#include "parallel/parallel.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace meniscus {

CarriedField::CarriedField(std::size_t number, Index first, std::vector<Real> capacity,
                           std::string name, std::string slower)
    : number_(number),
      first_(first),
      capacity_(std::move(capacity)),
      name_(std::move(name)),
      slower_(std::move(slower)) {
  for (NodalVectors* array : {&from_, &middle_, &start_, &first_rate_, &before_, &force_})
    array->assign(capacity_.size(), Lanes::zero());
}

void CarriedField::hold_places(const NodalVector* u) {
  for (FieldEnergy* energy : energies_) energy->hold_places(u);
}

Real CarriedField::held_energy(const NodalVector* x) const {
  Real sum = 0;
  for (const FieldEnergy* energy : energies_) sum += energy->held_energy(x);
  return sum;
}

void CarriedField::held_force(const NodalVector* x, std::span<NodalVector> f) const {
  std::fill(f.begin(), f.end(), Lanes::zero());
  for (FieldEnergy* energy : energies_) energy->add_held_force(x, f);
  gather(f);
}

void CarriedField::depart(std::span<const NodalVector> u) {
  const auto own = part(u);
  std::copy(own.begin(), own.end(), from_.begin());
}

Real CarriedField::arrive(std::span<const NodalVector> u, Real dt, std::span<NodalVector> x) {
  const auto to = part(u);
  const auto own = part(x);
  for_chunks(static_cast<Index>(middle_.size()), [&](Index, Index begin, Index end) {
    for (Index A = begin; A < end; ++A) at(middle_, A) = 0.5 * (at(from_, A) + at(to, A));
  });
  carry(from_.data(), middle_.data(), own);
  hold_places(middle_.data());
  const Real before = held_energy(own.data());
  relax(dt, own);
  const Real heat = before - held_energy(own.data());
  carry(middle_.data(), to.data(), own);
  return heat;
}

/// Number of stages for the step dt. s stages are stable up to (s^2 + s - 2)/4 Euler steps (Meyer,
/// Balsara & Aslam 2014). The length of a stable Euler step comes from the last estimate. Throws
/// SolveError if more than 10,000 stages are needed.
int CarriedField::stages(Real dt) const {
  constexpr Real safety = 0.8, most = 10'000;
  const Real steps = dt / (safety * limit_);
  const Real needed = std::ceil((std::sqrt(9 + 16 * steps) - 1) / 2);
  if (!(needed <= most))
    throw SolveError(fmt::format(
        "the {} would relax in {:.3g} stages per step, and the most are {:.0f}; expected is {}, or "
        "a shorter time.step",
        name_, needed, most, slower_));
  return std::max(2, static_cast<int>(needed));
}

/// Relaxes x over dt by the scheme RKL2: Y_1 = x + m_1 dt R_0, Y_j = m Y_j-1 + n Y_j-2 + (1 - m -
/// n) x + k dt R_j-1 + g dt R_0.
void CarriedField::relax(Real dt, std::span<NodalVector> x) {
  const int s = stages(dt);
  const Real w = 4.0 / (s * s + s - 2);
  const auto b = [](int j) { return j < 2 ? 1.0 / 3 : (j * j + j - 2) / (2.0 * j * (j + 1)); };
  const auto n = static_cast<Index>(x.size());
  held_force(x.data(), force_);
  for_chunks(n, [&](Index, Index begin, Index end) {
    for (Index A = begin; A < end; ++A) {
      at(start_, A) = at(before_, A) = at(x, A);
      at(first_rate_, A) = at(force_, A) / at(capacity_, A);
      at(x, A) += (b(1) * w * dt) * at(first_rate_, A);
    }
  });
  for (int j = 2; j <= s; ++j) {
    const Real of_last = (2.0 * j - 1) / j * b(j) / b(j - 1),
               of_before = -(j - 1.0) / j * b(j) / b(j - 2), of_start = 1 - of_last - of_before,
               rate = of_last * w * dt, of_first_rate = -(1 - b(j - 1)) * rate;
    held_force(x.data(), force_);
    for_chunks(n, [&](Index, Index begin, Index end) {
      for (Index A = begin; A < end; ++A) {
        const Lanes last = at(x, A);
        at(x, A) = of_last * last + of_before * at(before_, A) + of_start * at(start_, A) +
                   (rate / at(capacity_, A)) * at(force_, A) + of_first_rate * at(first_rate_, A);
        at(before_, A) = last;
      }
    });
  }
}

void CarriedField::archive(const Archive& a) {
  a("limit", limit_, dimension::time);
}

std::size_t CarriedField::bytes() const {
  return capacity_.size() * (sizeof(Real) + 6 * sizeof(NodalVector));
}

}  // namespace meniscus
