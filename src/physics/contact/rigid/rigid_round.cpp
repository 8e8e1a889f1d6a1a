// SPDX-License-Identifier: BSD-3-Clause
// Rigid balls, cylinders, and cavities of these shapes.
#include "physics/contact/rigid/rigid_checks.hpp"
#include "physics/contact/rigid/rigid_partner.hpp"
#include "physics/contact/rigid/round_field.hpp"

#include <cmath>
#include <type_traits>

namespace meniscus {
namespace {

/// Ball or cavity from the closed form `Exact` of a ball: SphereField or CylinderField. `space` is
/// the dimension of the space of its field: 3 in the half plane of a body of revolution, with the
/// centre on the axis.
template <int D, class Exact, int space = D>
class RoundPartner final : public RigidPartner<D> {
 public:
  RoundPartner(const ContactLaw& law, Real beta, const Vec<D>& centre, Real radius, bool cavity)
      : exact_(law, radius),
        centre_(centre),
        radius_(radius),
        cavity_(cavity),
        beta_(cavity ? -beta : beta),  // a cavity is all space minus the ball
        core_(cavity ? radius - law.guard * law.sigma0 : radius + law.guard * law.sigma0) {
    at_core_ = exact_.at(core_);
    slope_ = exact_.slope(core_);
  }

  RigidField<D> field(const Vec<D>& x) const override {
    const Vec<D> from_centre = x - centre_;
    const Real a = from_centre.norm();
    const Vec<D> k = a > 0 ? Vec<D>(from_centre / a) : Vec<D>::Unit(0);
    const RadialField f = inside_core(a) ? continued(a) : exact_.at(a);
    const Mat<D> kk = k * k.transpose();
    const Real radial = f.U - (space - 1) * f.tangent;
    return {beta_ * f.U, beta_ * f.tangent * from_centre,
            beta_ * (f.tangent * (Mat<D>::Identity() - kk) + radial * kk)};
  }

  Real distance(const Vec<D>& x) const override {
    const Real outside = (x - centre_).norm() - radius_;
    return cavity_ ? -outside : outside;
  }

 private:
  bool inside_core(Real a) const { return cavity_ ? a > core_ : a < core_; }

  /// The field below the smallest gap: U continues linearly, U = U_c + U_c' (a - a_c). a^D tangent
  /// = a^(D-1) S follows from the integral of a^(D-1) U.
  RadialField continued(Real a) const {
    const Real U0 = at_core_.U - slope_ * core_, c = core_;
    const auto flux = [&](Real r) {
      return std::pow(r, space) * (U0 / space + slope_ * r / (space + 1));
    };
    const Real least = 1e-6 * radius_;  // S has a pole in the centre of a ball
    const Real r = a > least ? a : least;
    return {U0 + slope_ * r,
            (std::pow(c, space) * at_core_.tangent + flux(r) - flux(c)) / std::pow(r, space)};
  }

  Exact exact_;
  Vec<D> centre_;
  Real radius_;
  bool cavity_;
  Real beta_, core_;
  RadialField at_core_{};
  Real slope_ = 0;
};

template <int D>
std::unique_ptr<RigidPartner<D>> round_partner(const ContactLaw& law, Real beta,
                                               const Vec<D>& centre, Real radius, bool cavity) {
  const std::string name = cavity ? "cavity" : "ball";
  require_kernel<D>(law, name, true);
  require_positive(radius, "the radius of a rigid " + name);
  if (cavity && !(radius > law.guard * law.sigma0))
    throw InputError("the radius of a rigid cavity must be greater than " +
                     std::to_string(law.guard) + " sigma0");
  if (D == 2 && dimension_of(law.kernel) == 3)
    return std::make_unique<RoundPartner<D, SphereField, 3>>(law, beta, centre, radius, cavity);
  using Field = std::conditional_t<D == 3, SphereField, CylinderField>;
  return std::make_unique<RoundPartner<D, Field>>(law, beta, centre, radius, cavity);
}

}  // namespace

template <int D>
std::unique_ptr<RigidPartner<D>> rigid_ball(const ContactLaw& law, Real beta, const Vec<D>& centre,
                                            Real radius) {
  return round_partner<D>(law, beta, centre, radius, false);
}
template <int D>
std::unique_ptr<RigidPartner<D>> rigid_cavity(const ContactLaw& law, Real beta,
                                              const Vec<D>& centre, Real radius) {
  return round_partner<D>(law, beta, centre, radius, true);
}
template std::unique_ptr<RigidPartner<2>> rigid_ball(const ContactLaw&, Real, const Vec<2>&, Real);
template std::unique_ptr<RigidPartner<3>> rigid_ball(const ContactLaw&, Real, const Vec<3>&, Real);
template std::unique_ptr<RigidPartner<2>> rigid_cavity(const ContactLaw&, Real, const Vec<2>&,
                                                       Real);
template std::unique_ptr<RigidPartner<3>> rigid_cavity(const ContactLaw&, Real, const Vec<3>&,
                                                       Real);

}  // namespace meniscus
