// SPDX-License-Identifier: BSD-3-Clause
// Surface tension as gamma times the curvature of the deformed surface, from F and its gradient.
#include "meniscus/approx/row_sums.hpp"
#include "meniscus/body/surface_points.hpp"
#include "meniscus/core/error.hpp"
#include "meniscus/core/surface_geometry.hpp"
#include "meniscus/physics/surface_tension.hpp"
#include "meniscus/physics/tension_form.hpp"

#include <fmt/core.h>

namespace meniscus {
namespace {

template <int D>
class CurvatureSurfaceTension final : public TensionForm<D> {
 public:
  CurvatureSurfaceTension(const Body<D>& body, Real gamma, int points)
      : TensionForm<D>(body, gamma), surface_(surface_points(body.geometry, points)) {
    if (!body.geometry.smooth || !surface_.exact)
      throw InputError(
          fmt::format("body '{}': the curvature form of surface tension needs a smooth analytic "
                      "surface, but this "
                      "shape has edges, where the curvature is undefined; use form = \"weak\"",
                      body.name));
    rows_ = build_point_rows<D>(body.particles, surface_.X,
                                {.value = true, .gradient = true, .hessian = true}, body.name);
    windows_ = {rows_.start, rows_.particle, body.size()};
  }

  Report add_force(const Motion& motion, Forces force) override {
    const NodalVector* u = this->displacements(motion);
    windows_.accumulate(this->own_part(force), [&](int, Index begin, Index end, NodalVector* f) {
      for (Index q = begin; q < end; ++q) {
        const auto frame = frame_at(q, u);
        const Real da = at(surface_.area, q) * frame.area_ratio;
        const Real t = gamma_ * curvature_at(q, u, frame) * da;
        scatter_value(rows_, q, Lanes(t * frame.n[0], t * frame.n[1], t * frame.n[2], 0.0), f);
      }
    });
    return {};
  }

  std::vector<MeasureSource> measures() const override {
    auto sources = TensionForm<D>::measures();
    sources.push_back({"mean_curvature", Dimension{-1, 0, 0},
                       "area mean of 2 kappa = -div n (-2/R on a sphere, -1/R on a circle)",
                       [this](const Motion& motion) { return mean_curvature(motion); }});
    return sources;
  }
  std::size_t bytes() const override {
    return rows_.bytes() + windows_.bytes() +
           surface_.X.size() * (2 * sizeof(Vec<D>) + sizeof(Mat<D>) + sizeof(Real));
  }
  Offset pairs() const override { return rows_.entries(); }

 private:
  using TensionForm<D>::body_;
  using TensionForm<D>::gamma_;

  SurfaceFrame<Real> frame_at(Index q, const NodalVector* u) const {
    const auto column = gradient_at(rows_, q, u);
    Tensor<Real> F = Tensor<Real>::identity();
    for (int i = 0; i < D; ++i)
      for (int K = 0; K < D; ++K) F(i, K) += at(column, K)[i];
    return surface_frame(F, embed<D>(at(surface_.N, q)));
  }
  Real curvature_at(Index q, const NodalVector* u, const SurfaceFrame<Real>& frame) const {
    Vec<D> n;
    for (int i = 0; i < D; ++i) n[i] = at(frame.n, i);
    const auto packed = hessian_along<D>(rows_, q, u, n);
    Mat<D> nG;
    for (int K = 0; K < D; ++K)
      for (int L = 0; L < D; ++L) nG(K, L) = at(packed, hessian_index(D, K, L));
    return twice_mean_curvature(frame, embed<D>(nG, 0), embed<D>(at(surface_.grad_N, q), 0));
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
  ForceWindows windows_;
};

}  // namespace

template <int D>
std::unique_ptr<ForceTerm> curvature_surface_tension(const Body<D>& body, Real gamma, int points) {
  return std::make_unique<CurvatureSurfaceTension<D>>(body, gamma, points);
}
template std::unique_ptr<ForceTerm> curvature_surface_tension(const Body<2>&, Real, int);
template std::unique_ptr<ForceTerm> curvature_surface_tension(const Body<3>&, Real, int);

}  // namespace meniscus
