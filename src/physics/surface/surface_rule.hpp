// SPDX-License-Identifier: BSD-3-Clause
// Gauss points of the surface of a body or of one face, and the deformation at these points, four
// at a time.
#pragma once
#include "body/body.hpp"
#include "meniscus/physics/force_term.hpp"
#include "numbers/dual.hpp"
#include "physics/surface/surface_law.hpp"
#include "physics/surface/surface_sites.hpp"

namespace meniscus {

template <int D>
struct SurfaceRule {
  PointRule<D> points;            ///< gradients, and values if requested; weights dA
  AlignedVector<Lanes> normal;    ///< [group][K] outward unit normal of the reference
  std::vector<Vec<D>> reference;  ///< [point] X

  SurfaceRule(const Body<D>& body, const SurfaceSites& sites, bool with_values = false) {
    SurfacePoints<D> surface = points_at(body, sites);
    points.rows = build_point_rows<D>(body.particles, surface.X,
                                      {.value = with_values, .gradient = true}, body.name);
    points.point_weight = surface.area;
    normal.assign(static_cast<std::size_t>(groups()) * D, Lanes::zero());
    for (Index q = 0; q < surface.size(); ++q)
      for (int K = 0; K < D; ++K) at(normal, q / 4 * D + K).set(q % 4, at(surface.N, q)[K]);
    reference = std::move(surface.X);
  }

  Index groups() const { return points.groups(); }
  std::size_t bytes() const {
    return points.bytes() + normal.size() * sizeof(Lanes) + reference.size() * sizeof(Vec<D>);
  }

  /// The gradient of a field at four points: H of the displacement.
  [[gnu::always_inline]] Tensor<Lanes> gradients(Index group, const NodalVector* field) const {
    Tensor<Lanes> H;
    points.gather(group, field, H);
    return H;
  }

  /// The state of four points; T is Lanes or Dual<Lanes>. Lanes without a point have N = 0 and
  /// stretch 1.
  template <class T>
  [[gnu::always_inline]] SurfaceState<T> state(Index group, const Tensor<T>& H) const {
    SurfaceState<T> s;
    s.H = H;
    s.cofactor = cofactor(deformation_gradient(s.H));
    const Lanes* N = normal.data() + static_cast<std::size_t>(group) * D;
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

  /// Current area (2D: length) at displacements `u` of the body.
  Real area(const NodalVector* u) const {
    return parallel_sum(groups(), 0.0, [&](Index g) {
      return sum(points.weight(g) * state(g, gradients(g, u)).stretch);
    });
  }
  MeasureSource area_measure(const Body<D>& body) const {
    return {"area", of_sum(dimension::area, D), "current area of the surface (2D: length)",
            [this, first = body.first](const Motion& m) { return area(m.u.data() + first); }};
  }
};

/// Common base of terms of a surface law on the surface of a body or on one face.
template <int D, class L>
class SurfaceTerm : public ForceTerm {
 public:
  SurfaceTerm(const Body<D>& body, const L& law, const SurfaceSites& sites)
      : body_(body),
        law_(law),
        face_(sites.face),
        surface_(body, sites),
        chunk_sums_(surface_.points.chunk_sums(body)) {}

  std::string name() const override {
    return std::string(L::type_name) +
           (face_.empty() ? " of the surface of '" : " of the face '" + face_ + "' of '") +
           body_.name + "'";
  }
  std::vector<MeasureSource> measures() const override { return {surface_.area_measure(body_)}; }
  /// Laws read the motion in the loop over rows only.
  bool reads(StepReads& reads) override {
    reads.rows(chunk_sums_, body_.first);
    return true;
  }
  std::size_t bytes() const override { return surface_.bytes() + chunk_sums_.bytes(); }
  Offset pairs() const override { return surface_.points.pairs(); }

 protected:
  const Body<D>& body_;
  L law_;
  std::string face_;  // empty: the whole surface
  SurfaceRule<D> surface_;
  ChunkSums chunk_sums_;
};

}  // namespace meniscus
