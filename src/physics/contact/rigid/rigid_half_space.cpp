// SPDX-License-Identifier: BSD-3-Clause
// Half space with any normal: S = S(a) m, grad S = U(a) m(x)m (CGCM note 3.1).
#include "physics/contact/rigid/plane_field.hpp"
#include "physics/contact/rigid/rigid_checks.hpp"
#include "physics/contact/rigid/rigid_partner.hpp"

namespace meniscus {
namespace {

template <int D>
class HalfSpace final : public RigidPartner<D> {
 public:
  HalfSpace(const ContactLaw& law, Real beta, const Vec<D>& point, const Vec<D>& normal)
      : plane_(law), beta_(beta), point_(point), normal_(normal.normalized()) {}

  RigidField<D> field(const Vec<D>& x) const override {
    const Real a = distance(x), U = beta_ * plane_.U(a);
    return {U, beta_ * plane_.S(a) * normal_, U * normal_ * normal_.transpose()};
  }
  Real distance(const Vec<D>& x) const override { return normal_.dot(x - point_); }

  LaneField<D> fields(const LanePlace<D>& x, int) const override {
    LaneField<D> f;
    f.distance = distances(x);
    f.U = beta_ * plane_.U(f.distance);
    const Lanes S = beta_ * plane_.S(f.distance);
    for (int i = 0; i < D; ++i) {
      at(f.S, i) = S * normal_[i];
      for (int j = 0; j < D; ++j) at(at(f.grad_S, i), j) = f.U * normal_[i] * normal_[j];
    }
    return f;
  }
  Lanes distances(const LanePlace<D>& x) const override {
    Lanes distance = Lanes::zero();
    for (int i = 0; i < D; ++i) distance += normal_[i] * (at(x, i) - point_[i]);
    return distance;
  }

 private:
  GuardedPlane plane_;
  Real beta_;
  Vec<D> point_, normal_;
};

}  // namespace

template <int D>
std::unique_ptr<RigidPartner<D>> rigid_half_space(const ContactLaw& law, Real beta,
                                                  const Vec<D>& point, const Vec<D>& normal) {
  require_kernel<D>(law, "half space", true);
  if (!(normal.norm() > 0)) throw InputError("a rigid half space needs a normal that is not zero");
  return std::make_unique<HalfSpace<D>>(law, beta, point, normal);
}
template std::unique_ptr<RigidPartner<2>> rigid_half_space(const ContactLaw&, Real, const Vec<2>&,
                                                           const Vec<2>&);
template std::unique_ptr<RigidPartner<3>> rigid_half_space(const ContactLaw&, Real, const Vec<3>&,
                                                           const Vec<3>&);

}  // namespace meniscus
