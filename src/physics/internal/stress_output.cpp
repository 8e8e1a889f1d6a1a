// SPDX-License-Identifier: BSD-3-Clause
// Fields and measures from the state at the quadrature points.
#include "physics/internal/stress_output.hpp"

#include "kernel/neighbor_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <tuple>
#include <type_traits>

namespace meniscus {
namespace {

Real jacobian(const StressPoint& point) {
  return 1 + volume_change(point.H);
}

Tensor<Real> cauchy_stress(const StressPoint& point) {
  return (1 / jacobian(point)) * (point.P * transpose(deformation_gradient(point.H)));
}

std::array<Real, 9> row_major(const Tensor<Real>& x) {
  std::array<Real, 9> a;
  for (int k = 0; k < 9; ++k) at(a, k) = x(k / 3, k % 3);
  return a;
}

Real von_mises(const Tensor<Real>& sigma) {
  const Tensor<Real> deviator = sigma - Tensor<Real>::diagonal(trace(sigma) / 3);
  return std::sqrt(1.5 * contract(deviator, deviator));
}

/// A field whose value at a quadrature point is the array value(point).
template <class Value>
FieldSource averaged(const VisitStressPoints& visit, Index particles,
                     std::shared_ptr<const std::vector<StandIn>> stand_ins, std::string name,
                     Dimension dimension, std::string meaning, Value value) {
  constexpr int components =
      static_cast<int>(std::tuple_size_v<std::invoke_result_t<Value, const StressPoint&>>);
  const auto compute = [visit, particles, stand_ins, value](const Motion& motion,
                                                            std::span<Real> out) {
    std::vector<Real> volume(static_cast<std::size_t>(particles), 0.0);
    std::fill(out.begin(), out.end(), 0.0);
    visit(motion, [&](const StressPoint& point) {
      at(volume, point.owner) += point.weight;
      const auto x = value(point);
      for (int c = 0; c < components; ++c)
        at(out, point.owner * components + c) += point.weight * at(x, c);
    });
    for (Index A = 0; A < particles; ++A)
      for (int c = 0; c < components; ++c)
        if (at(volume, A) > 0) at(out, A * components + c) /= at(volume, A);
    for (const StandIn& s : *stand_ins)
      for (int c = 0; c < components; ++c)
        at(out, s.particle * components + c) = at(out, s.owner * components + c);
  };
  return {std::move(name), components, dimension, std::move(meaning), compute};
}

}  // namespace

template <int D>
std::vector<StandIn> stand_ins(std::span<const Vec<D>> X, const std::vector<bool>& owns) {
  std::vector<Index> owners, found;
  std::vector<Vec<D>> places;
  for (std::size_t A = 0; A < X.size(); ++A)
    if (owns[A]) {
      owners.push_back(static_cast<Index>(A));
      places.push_back(X[A]);
    }
  if (owners.empty() || owners.size() == X.size()) return {};
  const NeighborSearch<D> search(places);
  std::vector<StandIn> result;
  for (std::size_t A = 0; A < X.size(); ++A) {
    if (owns[A]) continue;
    search.within(X[A], search.distance_of_nearest(X[A], 1) * (1 + 1e-12), found);
    result.push_back({static_cast<Index>(A), at(owners, found.front())});
  }
  return result;
}

template std::vector<StandIn> stand_ins(std::span<const Vec<2>>, const std::vector<bool>&);
template std::vector<StandIn> stand_ins(std::span<const Vec<3>>, const std::vector<bool>&);

std::vector<FieldSource> stress_fields(const VisitStressPoints& visit, Index particles,
                                       std::vector<StandIn> stand_ins) {
  const auto others = std::make_shared<const std::vector<StandIn>>(std::move(stand_ins));
  const auto scalar = [](Real x) { return std::array{x}; };
  return {
      averaged(visit, particles, others, "J", dimension::none,
               "volume / that in the reference of the scene, mean over the particle's cell",
               [=](const StressPoint& p) { return scalar(p.volume_ratio * p.J); }),
      averaged(visit, particles, others, "F", dimension::none,
               "deformation gradient, mean over the particle's cell, row-major",
               [](const StressPoint& point) { return row_major(deformation_gradient(point.H)); }),
      averaged(visit, particles, others, "pressure", dimension::pressure,
               "- tr(sigma)/3 of the elastic Cauchy stress",
               [=](const StressPoint& point) { return scalar(-trace(cauchy_stress(point)) / 3); }),
      averaged(visit, particles, others, "von_mises", dimension::pressure,
               "von Mises stress of the elastic Cauchy stress",
               [=](const StressPoint& point) { return scalar(von_mises(cauchy_stress(point))); }),
      averaged(visit, particles, others, "cauchy_stress", dimension::pressure,
               "elastic Cauchy stress, row-major",
               [](const StressPoint& point) { return row_major(cauchy_stress(point)); }),
  };
}

std::vector<MeasureSource> stress_measures(const VisitStressPoints& visit, int space_dimension) {
  const auto volume = [visit](const Motion& motion) {
    Real V = 0;
    visit(motion, [&](const StressPoint& point) { V += point.weight * jacobian(point); });
    return V;
  };
  const auto least_jacobian = [visit](const Motion& motion) {
    Real least = std::numeric_limits<Real>::max();
    visit(motion, [&](const StressPoint& point) {
      least = std::min(least, point.volume_ratio * jacobian(point));
    });
    return least;
  };
  // J tr(sigma) = P : F, and J times the weight is the current volume.
  const auto mean_pressure = [visit](const Motion& motion) {
    Real sum = 0, V = 0;
    visit(motion, [&](const StressPoint& point) {
      sum -= point.weight * contract(point.P, deformation_gradient(point.H)) / 3;
      V += point.weight * jacobian(point);
    });
    return sum / V;
  };
  return {
      {"volume", space_dimension == 3 ? dimension::volume : dimension::area,
       "current volume (2D: area)", volume},
      {"min_J", dimension::none,
       "smallest J of all stress points, volume / that in the reference of the scene",
       least_jacobian},
      {"mean_pressure", dimension::pressure, "pressure, mean over the current volume",
       mean_pressure},
  };
}

}  // namespace meniscus
