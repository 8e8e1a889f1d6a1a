// SPDX-License-Identifier: BSD-3-Clause
// Conversion between coefficients of fields and their values at particles, and the inverse of a
// motion.
#include "remap/nodal_values.hpp"

#include "body/particle_values.hpp"
#include "kernel/row_sums.hpp"
#include "meniscus/error.hpp"
#include "numbers/dense.hpp"
#include "parallel/parallel.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace meniscus {
template <int D>
NodalVectors values_at(const PointRows<D>& rows, const NodalVector* c) {
  NodalVectors values(static_cast<std::size_t>(rows.size()));
  parallel_for(rows.size(), [&](Index q) { at(values, q) = value_at(rows, q, c); });
  return values;
}

NodalVectors shifted(NodalVectors f, const NodalVectors& from, const NodalVectors& to) {
  for (std::size_t A = 0; A < f.size(); ++A) f[A] += at(to, A) - at(from, A);
  return f;
}

template <int D>
NodalVectors coefficients_of(const Body<D>& body, const NodalVectors& f, NodalVectors guess) {
  constexpr int sweeps = 8;
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    const NodalVectors values = values_at_particles(body, guess.data());
    for (std::size_t A = 0; A < f.size(); ++A) guess[A] += f[A] - values[A];
  }
  return guess;
}

template <int D>
std::vector<Vec<D>> places(const Body<D>& body, const NodalVector* u) {
  const NodalVectors moved = values_at_particles(body, u);
  std::vector<Vec<D>> x(body.particles.X().begin(), body.particles.X().end());
  for (Index A = 0; A < body.size(); ++A)
    for (int i = 0; i < D; ++i) at(x, A)[i] += at(moved, A)[i];
  return x;
}

template <int D>
std::vector<Vec<D>> pre_images(const Body<D>& body, const NodalVector* u,
                               std::span<const Vec<D>> x) {
  constexpr int most_iterations = 30;
  const Real spacing = mean_spacing(body.geometry.grid);
  // Rounding errors of positions grow with the distance from the origin.
  Real farthest = 0;
  for (const Vec<D>& place : x) farthest = std::max(farthest, place.cwiseAbs().maxCoeff());
  const Real round_off =
      std::max(1e-13 * spacing, 8 * std::numeric_limits<Real>::epsilon() * farthest);
  const auto reference = body.particles.X();
  const std::vector<Vec<D>> now = places(body, u);
  const NeighborSearch<D> search(now);
  std::vector<Vec<D>> X;
  std::vector<Index> near;
  for (const Vec<D>& place : x) {
    search.within(place, search.distance_of_nearest(place, 1) * (1 + 1e-12), near);
    if (near.empty())
      throw SolveError(fmt::format(
          "body '{}': the place of a node of its new reference is not a finite number", body.name));
    X.push_back(at(reference, near.front()));
  }
  std::vector<Real> left(X.size());
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    const auto rows =
        build_point_rows<D>(body.particles, X, {.value = true, .gradient = true}, body.name);
    parallel_for(rows.size(), [&](Index q) {
      const Lanes moved = value_at(rows, q, u);
      const std::array<Lanes, D> gradient = gradient_at(rows, q, u);
      Mat<D> F = Mat<D>::Identity();
      Vec<D> miss = at(x, q) - at(X, q);
      for (int i = 0; i < D; ++i) {
        miss[i] -= moved[i];
        for (int K = 0; K < D; ++K) F(i, K) += at(gradient, K)[i];
      }
      at(left, q) = miss.norm();
      if (at(left, q) == 0) return;
      // Limit the step of Newton's method: far from the solution, F belongs to another point.
      Vec<D> step = inverse<D>(F) * miss;
      step *= std::min(1.0, spacing / step.norm());
      if (at(left, q) > 1e-15 * spacing) at(X, q) += step;
    });
    if (*std::max_element(left.begin(), left.end()) <= round_off) return X;
  }
  const auto worst = std::max_element(left.begin(), left.end());
  // Round-off is larger where shape functions are nearly undetermined.
  constexpr Real bearable = 1e-10;
  if (*worst <= bearable * spacing) return X;
  std::string place;
  for (int i = 0; i < D; ++i)
    place += fmt::format("{}{:.6g}", i ? ", " : "", at(x, worst - left.begin())[i]);
  throw SolveError(
      fmt::format("body '{}': no point of it is at ({}); the nearest misses it by {:.3g}",
                  body.name, place, *worst));
}

#define MENISCUS_INSTANTIATE(D)                                                             \
  template NodalVectors values_at(const PointRows<D>&, const NodalVector*);                 \
  template NodalVectors coefficients_of(const Body<D>&, const NodalVectors&, NodalVectors); \
  template std::vector<Vec<D>> places(const Body<D>&, const NodalVector*);                  \
  template std::vector<Vec<D>> pre_images(const Body<D>&, const NodalVector*,               \
                                          std::span<const Vec<D>>);
MENISCUS_INSTANTIATE(2)
MENISCUS_INSTANTIATE(3)
#undef MENISCUS_INSTANTIATE

}  // namespace meniscus
