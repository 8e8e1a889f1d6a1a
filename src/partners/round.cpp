// SPDX-License-Identifier: BSD-3-Clause
// Rigid ball, and rigid walls around a spherical cavity.
#include "meniscus/physics/partner_registry.hpp"

namespace meniscus {
namespace {

template <int D>
struct Round {
  std::vector<Real> centre;
  Real radius = 0;
};

template <int D, class Partner>
Rows<Partner> round_rows() {
  return {
      reals_row<Partner>("centre", &Partner::centre, D, dimension::length, range::any, "centre"),
      real_row<Partner>("radius", &Partner::radius, dimension::length, range::positive, "radius")};
}

template <int D>
struct Ball : Round<D> {
  static Rows<Ball> rows() { return round_rows<D, Ball>(); }
  std::unique_ptr<RigidPartner<D>> make(const ContactLaw& law, Real beta) const {
    return rigid_ball<D>(law, beta, Vec<D>::Map(this->centre.data()), this->radius);
  }
};

template <int D>
struct Cavity : Round<D> {
  static Rows<Cavity> rows() { return round_rows<D, Cavity>(); }
  std::unique_ptr<RigidPartner<D>> make(const ContactLaw& law, Real beta) const {
    return rigid_cavity<D>(law, beta, Vec<D>::Map(this->centre.data()), this->radius);
  }
};

constexpr const char *ball = "ball; in 2D a cylinder across the plane",
                     *cavity = "all that is around a ball; in 2D around a cylinder";
const bool registered = register_partner<2, Ball<2>>("ball", ball) &&
                        register_partner<3, Ball<3>>("ball", ball) &&
                        register_partner<2, Cavity<2>>("cavity", cavity) &&
                        register_partner<3, Cavity<3>>("cavity", cavity);

}  // namespace
}  // namespace meniscus
