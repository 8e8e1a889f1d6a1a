// SPDX-License-Identifier: BSD-3-Clause
// Forces of a surface law on the whole surface of a body: the exact gradient of the discrete
// surface energy E = sum_q A_q w(F_q), that is f_A = -sum_q A_q P(F_q) grad N_A with P = dw/dF
// (RKPM note 4). Needs first derivatives only. Instantiated once per law, at its registration.
#pragma once
#include "meniscus/body/body.hpp"
#include "meniscus/body/surface_points.hpp"
#include "meniscus/core/dual.hpp"
#include "meniscus/physics/force_term.hpp"
#include "meniscus/physics/surface_law.hpp"

namespace meniscus {

template <int D, SurfaceLaw L>
class SurfaceForce final : public ForceTerm {
 public:
  /// `points` Gauss points per direction of every facet.
  SurfaceForce(const Body<D>& body, const L& law, int points) : body_(body), law_(law) {
    const SurfacePoints<D> surface = surface_points(body.geometry, points);
    rule_.rows = build_point_rows<D>(body.particles, surface.X, {.gradient = true}, body.name);
    rule_.point_weight = surface.area;
    normal_.assign(static_cast<std::size_t>(rule_.groups()) * D, Lanes::zero());
    for (Index q = 0; q < surface.size(); ++q)
      for (int K = 0; K < D; ++K) at(normal_, q / 4 * D + K).set(q % 4, at(surface.N, q)[K]);
    windows_ = rule_.windows(body.size());
  }

  std::string name() const override {
    return std::string(L::type_name) + " of the surface of '" + body_.name + "'";
  }
  std::string_view energy_kind() const override { return "surface"; }

  Report add_force(const Motion& motion, Forces force) override {
    const NodalVector* u = displacements(motion);
    windows_.accumulate(body_.part(force), [&](int, Index begin, Index end, NodalVector* f) {
      for (Index g = begin; g < end; ++g)
        rule_.scatter(g, law_.stress(state(g, gradients(g, u)), -rule_.weight(g)), f);
    });
    return {};
  }
  void add_tangent(const Motion& motion, const Motion& change, Forces force) override {
    const NodalVector *u = displacements(motion), *du = displacements(change);
    windows_.accumulate(body_.part(force), [&](int, Index begin, Index end, NodalVector* f) {
      for (Index g = begin; g < end; ++g) {
        const auto s = state(g, dual(gradients(g, u), gradients(g, du)));
        rule_.scatter(g, derivative(law_.stress(s, Dual<Lanes>(-rule_.weight(g)))), f);
      }
    });
  }

  std::optional<Real> stored_energy(const Motion& motion) const override {
    const NodalVector* u = displacements(motion);
    return parallel_sum(rule_.groups(), 0.0, [&](Index g) {
      return sum(rule_.weight(g) * law_.energy_density(state(g, gradients(g, u))));
    });
  }

  std::vector<MeasureSource> measures() const override {
    return {{"area", D == 3 ? dimension::area : dimension::length,
             "current area of the surface (2D: length)", [this](const Motion& motion) {
               const NodalVector* u = displacements(motion);
               return parallel_sum(rule_.groups(), 0.0, [&](Index g) {
                 return sum(rule_.weight(g) * state(g, gradients(g, u)).stretch);
               });
             }}};
  }

  std::size_t bytes() const override {
    return rule_.bytes() + windows_.bytes() + normal_.size() * sizeof(Lanes);
  }
  Offset pairs() const override { return rule_.pairs(); }

 private:
  const Lanes* displacements(const Motion& motion) const { return motion.u.data() + body_.first; }

  /// H at four points.
  [[gnu::always_inline]] Tensor<Lanes> gradients(Index group, const NodalVector* u) const {
    Tensor<Lanes> H;
    rule_.gather(group, u, H);
    return H;
  }

  /// Four points; T is Lanes or Dual<Lanes>. Lanes without a point have N = 0; their stretch is set
  /// to 1.
  template <class T>
  [[gnu::always_inline]] SurfaceState<T> state(Index group, const Tensor<T>& H) const {
    SurfaceState<T> s;
    s.H = H;
    s.cofactor = cofactor(deformation_gradient(s.H));
    const Lanes* N = normal_.data() + static_cast<std::size_t>(group) * D;
    s.N = {N[0], N[1], T(0.0)};
    if constexpr (D == 3) s.N[2] = N[2];
    for (int i = 0; i < 3; ++i) {
      at(s.m, i) = s.cofactor(i, 0) * N[0] + s.cofactor(i, 1) * N[1];
      if constexpr (D == 3) at(s.m, i) += s.cofactor(i, 2) * N[2];
    }
    const T square = s.m[0] * s.m[0] + s.m[1] * s.m[1] + s.m[2] * s.m[2];
    s.stretch = sqrt(select(value(square).v > 0.0, square, T(1.0)));
    return s;
  }

  const Body<D>& body_;
  L law_;
  PointRule<D> rule_;
  AlignedVector<Lanes> normal_;  // [group][K]
  ForceWindows windows_;
};

}  // namespace meniscus
