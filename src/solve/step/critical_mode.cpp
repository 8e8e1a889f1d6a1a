// SPDX-License-Identifier: BSD-3-Clause
// Finds the critical mode of the time step by combining trial modes (Rayleigh-Ritz).
#include "solve/step/critical_mode.hpp"

#include "numbers/dense.hpp"
#include "parallel/followed_particles.hpp"

#include <utility>

namespace meniscus {
namespace {

/// a = factor_of_a a + factor b. An empty a counts as zero. If b is empty (no viscosity), nothing
/// changes.
void mix(const FollowedParticles& particles, NodalScratch& a, Real factor_of_a,
         const NodalScratch& b, Real factor) {
  if (b.empty()) return;
  const bool is_new = a.empty();
  a.resize(b.size());
  particles.for_each(static_cast<Index>(a.size()), [&](Index begin, Index end) {
    for (Index A = begin; A < end; ++A)
      at(a, A) = factor_of_a * (is_new ? Lanes::zero() : at(a, A)) + factor * at(b, A);
  });
}

void mix(const FollowedParticles& particles, TrialMode& a, Real factor_of_a, const TrialMode& b,
         Real factor) {
  mix(particles, a.w, factor_of_a, b.w, factor);
  mix(particles, a.Kw, factor_of_a, b.Kw, factor);
  mix(particles, a.Cw, factor_of_a, b.Cw, factor);
}

}  // namespace

Lanes CriticalMode::force(const TrialMode& of, Real dt, Index A) const {
  const Lanes stiff = (dt * dt / 4) * at(of.Kw, A);
  return of.Cw.empty() ? stiff : stiff + (dt / 2) * at(of.Cw, A);
}

void CriticalMode::begin(std::span<const NodalVector> start) {
  trial.w.resize(start.size());
  particles_.copy(start, trial.w);
  for (TrialMode* none : {&mode, &way_})
    for (NodalScratch* field : {&none->w, &none->Kw, &none->Cw}) field->clear();
}

ModeRates CriticalMode::rates(const TrialMode& of) const {
  struct Sums {
    Real mass, stiffness, viscosity;
    Sums operator+(const Sums& b) const {
      return {mass + b.mass, stiffness + b.stiffness, viscosity + b.viscosity};
    }
  };
  const bool viscous = !of.Cw.empty();
  const Sums all = particles_.sum(static_cast<Index>(of.w.size()), Sums{}, [&](Index A) {
    const Lanes& w = at(of.w, A);
    return Sums{at(mass_, A) * sum(w * w), sum(w * at(of.Kw, A)),
                viscous ? sum(w * at(of.Cw, A)) : 0};
  });
  return {all.stiffness / all.mass, all.viscosity / all.mass};
}

void CriticalMode::propose_trial(Real dt) {
  const ModeRates q = rates(mode);
  const Real lambda = dt * dt / 4 * q.stiffness + dt / 2 * q.viscosity;
  trial.w.resize(mode.w.size());
  particles_.for_each(static_cast<Index>(mode.w.size()), [&](Index begin, Index end) {
    for (Index A = begin; A < end; ++A)
      at(trial.w, A) = (1 / at(mass_, A)) * force(mode, dt, A) - lambda * at(mode.w, A);
  });
}

void CriticalMode::include_trial(Real dt) {
  if (mode.w.empty()) return std::swap(mode, trial);
  using Products = Eigen::Matrix<Real, 3, 6>;  // products with M, then with A
  const std::array<const TrialMode*, 3> all{&mode, &trial, &way_};
  const int count = way_.w.empty() ? 2 : 3;
  const Products products =
      particles_.sum(static_cast<Index>(mode.w.size()), Products(Products::Zero()), [&](Index A) {
        Products p = Products::Zero();
        for (int j = 0; j < count; ++j) {
          const Lanes momentum = at(mass_, A) * at(at(all, j)->w, A), f = force(*at(all, j), dt, A);
          for (int i = 0; i < count; ++i) {
            p(i, j) = sum(at(at(all, i)->w, A) * momentum);
            p(i, 3 + j) = sum(at(at(all, i)->w, A) * f);
          }
        }
        return p;
      });
  // Scale the vectors to length one. Drop the last one if it nearly is a combination of the others.
  constexpr Real independent = 1e-6;
  const Vec<3> size = products.leftCols<3>().diagonal().cwiseSqrt();
  if (!(size[1] > 0)) return;
  Mat<3> M = Mat<3>::Identity(), A = Mat<3>::Zero();
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < count; ++j) {
      M(i, j) = products(i, j) / (size[i] * size[j]);
      A(i, j) = 0.5 * (products(i, 3 + j) + products(j, 3 + i)) / (size[i] * size[j]);
    }
  if (!(1 - M(1, 0) * M(1, 0) > independent)) return;
  const int kept = count == 3 && determinant<3>(M) > independent ? 3 : 2;
  const Vec<3> best = greatest_quotient(A, M, kept);
  mix(particles_, way_, kept == 3 ? best[2] / size[2] : 0, trial, best[1] / size[1]);
  mix(particles_, mode, best[0] / size[0], way_, 1);
}

}  // namespace meniscus
