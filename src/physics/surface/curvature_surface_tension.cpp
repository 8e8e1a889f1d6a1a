// SPDX-License-Identifier: BSD-3-Clause
// Surface tension as gamma times the curvature of the deformed surface, from F and its gradient.
#include "body/surface/surface_points.hpp"
#include "kernel/row_sums.hpp"
#include "meniscus/error.hpp"
#include "numbers/dual.hpp"
#include "numbers/surface_geometry.hpp"
#include "physics/surface/surface_tension.hpp"
#include "physics/surface/tension_term.hpp"

#include <fmt/core.h>

namespace meniscus {
namespace {

template <int D>
class CurvatureSurfaceTension final : public TensionTerm<D> {
 public:
  CurvatureSurfaceTension(const Body<D>& body, Real gamma, int points)
      : TensionTerm<D>(body, gamma), surface_(surface_points(body.geometry, points)) {
    if (!body.geometry.surface->smooth() || !surface_.exact)
      throw InputError(
          fmt::format("body '{}': the curvature form of surface tension needs a smooth analytic "
                      "surface, but this "
                      "shape has edges, where the curvature is undefined; use form = \"weak\"",
                      body.name));
    rows_ = build_point_rows<D>(body.particles, surface_.X,
                                {.value = true, .gradient = true, .hessian = true}, body.name);
    chunk_sums_ = body.chunk_sums(rows_.start, rows_.particle);
  }

  /// No potential: the force is not the gradient of the energy.
  std::optional<Real> potential(const Motion&) override { return std::nullopt; }

  Report add_force(const Motion& motion, Forces force) override {
    const NodalVector* u = this->displacements(motion);
    chunk_sums_.accumulate(this->own_part(force), [&](int, Index begin, Index end, NodalVector* f) {
      for (Index q = begin; q < end; ++q) {
        const auto frame = frame_at(q, u);
        const Real da = at(surface_.area, q) * frame.area_ratio;
        const Real t = gamma_ * curvature_at(q, u, frame) * da;
        scatter_value(rows_, q, Lanes(t * frame.n[0], t * frame.n[1], t * frame.n[2], 0.0), f);
      }
    });
    return {};
  }
  void add_tangent(const Motion& motion, const Motion& change, Forces force) override {
    const NodalVector *u = this->displacements(motion), *du = this->displacements(change);
    chunk_sums_.accumulate(this->own_part(force), [&](int, Index begin, Index end, NodalVector* f) {
      for (Index q = begin; q < end; ++q) {
        const auto frame = frame_of(q, dual(deformation(q, u), displacement_gradient(q, du)));
        const Dual<Real> t =
            gamma_ * curvature_at(q, u, du, frame) * (at(surface_.area, q) * frame.area_ratio);
        scatter_value(rows_, q,
                      Lanes((t * frame.n[0]).d, (t * frame.n[1]).d, (t * frame.n[2]).d, 0.0), f);
      }
    });
  }

  bool reads(StepReads& reads) override {
    reads.rows(chunk_sums_, body_.first);
    return true;
  }

  std::vector<MeasureSource> measures() const override {
    auto sources = TensionTerm<D>::measures();
    sources.push_back({"mean_curvature", Dimension{-1, 0, 0},
                       "area mean of 2 kappa = -div n (-2/R on a sphere, -1/R on a circle)",
                       [this](const Motion& motion) { return mean_curvature(motion); }});
    return sources;
  }
  std::size_t bytes() const override {
    return rows_.bytes() + chunk_sums_.bytes() +
           surface_.X.size() * (2 * sizeof(Vec<D>) + sizeof(Mat<D>) + sizeof(Real));
  }
  Offset pairs() const override { return rows_.entries(); }

 private:
  using TensionTerm<D>::body_;
  using TensionTerm<D>::gamma_;

  Tensor<Real> displacement_gradient(Index q, const NodalVector* u, Real diagonal = 0) const {
    const auto column = gradient_at(rows_, q, u);
    Tensor<Real> F = Tensor<Real>::diagonal(diagonal);
    for (int i = 0; i < D; ++i)
      for (int K = 0; K < D; ++K) F(i, K) += at(column, K)[i];
    if (rows_.folded) F(2, 2) += value_at(rows_, q, u)[0] / at(rows_.radius, q);
    return F;
  }
  Tensor<Real> deformation(Index q, const NodalVector* u) const {
    return displacement_gradient(q, u, 1);
  }
  template <class T>
  SurfaceFrame<T> frame_of(Index q, const Tensor<T>& F) const {
    const auto N = embed<D>(at(surface_.N, q));
    return surface_frame(F, {T(N[0]), T(N[1]), T(N[2])});
  }
  SurfaceFrame<Real> frame_at(Index q, const NodalVector* u) const {
    return frame_of(q, deformation(q, u));
  }
  /// The tensor n_i u_i,KL. In a body of revolution (2, 2) is the bending -n_0 (X_0 + u_0)/X_0^2 of
  /// the circle, which gives it the curvature -n_0/x_0. `one`: 1, or 0 for changes of u.
  Tensor<Real> bending(Index q, const NodalVector* u, const std::array<Real, 3>& n,
                       Real one = 1) const {
    Vec<D> direction;
    for (int i = 0; i < D; ++i) direction[i] = at(n, i);
    const auto packed = hessian_along<D>(rows_, q, u, direction);
    Mat<D> nG;
    for (int K = 0; K < D; ++K)
      for (int L = 0; L < D; ++L) nG(K, L) = at(packed, hessian_index(D, K, L));
    if (!rows_.folded) return embed<D>(nG, 0);
    const Real radius = at(rows_.radius, q);
    return embed<D>(nG, -n[0] * (one + value_at(rows_, q, u)[0] / radius) / radius);
  }
  Real curvature_at(Index q, const NodalVector* u, const SurfaceFrame<Real>& frame) const {
    return twice_mean_curvature(frame, bending(q, u, frame.n), embed<D>(at(surface_.grad_N, q), 0));
  }
  Dual<Real> curvature_at(Index q, const NodalVector* u, const NodalVector* du,
                          const SurfaceFrame<Dual<Real>>& frame) const {
    const auto& n = frame.n;
    const std::array<Real, 3> value{n[0].v, n[1].v, n[2].v}, change{n[0].d, n[1].d, n[2].d};
    const Tensor<Real> grad_N = embed<D>(at(surface_.grad_N, q), 0);
    return twice_mean_curvature(
        frame, dual(bending(q, u, value), bending(q, du, value, 0) + bending(q, u, change)),
        dual(grad_N, Tensor<Real>::zero()));
  }
  Real area(const Motion& motion) const override {
    const NodalVector* u = this->displacements(motion);
    return parallel_sum(rows_.size(), 0.0,
                        [&](Index q) { return at(surface_.area, q) * frame_at(q, u).area_ratio; });
  }
  Real mean_curvature(const Motion& motion) const {
    const NodalVector* u = this->displacements(motion);
    const Real integral = parallel_sum(rows_.size(), 0.0, [&](Index q) {
      const auto frame = frame_at(q, u);
      return at(surface_.area, q) * frame.area_ratio * curvature_at(q, u, frame);
    });
    return integral / area(motion);
  }

  SurfacePoints<D> surface_;
  PointRows<D> rows_;
  ChunkSums chunk_sums_;
};

}  // namespace

template <int D>
std::unique_ptr<ForceTerm> curvature_surface_tension(const Body<D>& body, Real gamma, int points) {
  return std::make_unique<CurvatureSurfaceTension<D>>(body, gamma, points);
}
template std::unique_ptr<ForceTerm> curvature_surface_tension(const Body<2>&, Real, int);
template std::unique_ptr<ForceTerm> curvature_surface_tension(const Body<3>&, Real, int);

}  // namespace meniscus
