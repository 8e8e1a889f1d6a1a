// SPDX-License-Identifier: BSD-3-Clause
// Surface tension in weak form: an internal force with the energy gamma |cof(F) N| per reference
// area.
#include "meniscus/body/surface_points.hpp"
#include "meniscus/physics/surface_tension.hpp"
#include "meniscus/physics/tension_form.hpp"

namespace meniscus {
namespace {

template <int D>
class WeakSurfaceTension final : public TensionForm<D> {
 public:
  WeakSurfaceTension(const Body<D>& body, Real gamma, int points) : TensionForm<D>(body, gamma) {
    const SurfacePoints<D> surface = surface_points(body.geometry, points);
    rule_.rows = build_point_rows<D>(body.particles, surface.X, {.gradient = true}, body.name);
    rule_.point_weight = surface.area;
    normal_.assign(static_cast<std::size_t>(rule_.groups()) * D, Lanes::zero());
    for (Index q = 0; q < surface.size(); ++q)
      for (int K = 0; K < D; ++K) at(normal_, q / 4 * D + K).set(q % 4, at(surface.N, q)[K]);
    windows_ = rule_.windows(body.size());
  }

  Report add_force(const Motion& motion, Forces force) override {
    const Lanes* u = this->displacements(motion);
    windows_.accumulate(this->own_part(force), [&](int, Index begin, Index end, Lanes* f) {
      for (Index g = begin; g < end; ++g) {
        // P = gamma (Js/J) (I - n n) cof F, with m = cof(F) N = Js n.
        Tensor<Lanes> H;
        rule_.gather(g, u, H);
        const Tensor<Lanes> cof = cofactor(deformation_gradient(H));
        std::array<Lanes, 3> m;
        const Lanes stretch = current_normal(g, cof, m);
        const Lanes factor = gamma_ * rule_.weight(g) * stretch / (1.0 + volume_change(H));
        std::array<Lanes, 3> n_cof;
        for (int K = 0; K < 3; ++K)
          at(n_cof, K) =
              (m[0] * cof(0, K) + m[1] * cof(1, K) + m[2] * cof(2, K)) / (stretch * stretch);
        rule_.scatter(g, Tensor<Lanes>::map([&](int i, int K) {
                        return -factor * (cof(i, K) - at(m, i) * at(n_cof, K));
                      }),
                      f);
      }
    });
    return {};
  }

  std::size_t bytes() const override {
    return rule_.bytes() + windows_.bytes() + normal_.size() * sizeof(Lanes);
  }
  Offset pairs() const override { return rule_.pairs(); }

 private:
  using TensionForm<D>::body_;
  using TensionForm<D>::gamma_;

  /// m = cof(F) N; returns |m|, the area ratio da/dA. Lanes without a point get n = e_1 and 1.
  Lanes current_normal(Index group, const Tensor<Lanes>& cof, std::array<Lanes, 3>& m) const {
    const Lanes* N = normal_.data() + static_cast<std::size_t>(group) * D;
    for (int i = 0; i < 3; ++i) {
      at(m, i) = cof(i, 0) * N[0] + cof(i, 1) * N[1];
      if constexpr (D == 3) at(m, i) += cof(i, 2) * N[2];
    }
    const Lanes square = m[0] * m[0] + m[1] * m[1] + m[2] * m[2];
    return sqrt(select(square.v > 0.0, square, 1.0));
  }
  Real area(const Motion& motion) const override {
    const Lanes* u = this->displacements(motion);
    return parallel_sum(rule_.groups(), 0.0, [&](Index g) {
      Tensor<Lanes> H;
      rule_.gather(g, u, H);
      std::array<Lanes, 3> m;
      return sum(rule_.weight(g) * current_normal(g, cofactor(deformation_gradient(H)), m));
    });
  }

  PointRule<D> rule_;
  AlignedVector<Lanes> normal_;  // [group][K]
  ForceWindows windows_;
};

}  // namespace

template <int D>
std::unique_ptr<ForceTerm> weak_surface_tension(const Body<D>& body, Real gamma, int points) {
  return std::make_unique<WeakSurfaceTension<D>>(body, gamma, points);
}
template std::unique_ptr<ForceTerm> weak_surface_tension(const Body<2>&, Real, int);
template std::unique_ptr<ForceTerm> weak_surface_tension(const Body<3>&, Real, int);

}  // namespace meniscus
