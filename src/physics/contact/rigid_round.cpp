// SPDX-License-Identifier: BSD-3-Clause
// Rigid balls, cylinders and the cavities of their shape.
#include <type_traits>

#include "cylinder_field.hpp"
#include "rigid_checks.hpp"
#include "sphere_field.hpp"

namespace meniscus {
namespace {

template <int D>
std::unique_ptr<RigidPartner<D>> round(const ContactLaw& law, Real beta, const Vec<D>& centre,
                                       Real radius, bool cavity) {
  const std::string name = cavity ? "cavity" : "ball";
  require_kernel<D>(law, name);
  require_positive(radius, "the radius of a rigid " + name);
  using Field = std::conditional_t<D == 3, SphereField, CylinderField>;
  return std::make_unique<RoundPartner<D, Field>>(law, beta, centre, radius, cavity);
}

}  // namespace

template <int D>
std::unique_ptr<RigidPartner<D>> rigid_ball(const ContactLaw& law, Real beta, const Vec<D>& centre,
                                            Real radius) {
  return round<D>(law, beta, centre, radius, false);
}
template <int D>
std::unique_ptr<RigidPartner<D>> rigid_cavity(const ContactLaw& law, Real beta,
                                              const Vec<D>& centre, Real radius) {
  return round<D>(law, beta, centre, radius, true);
}
template std::unique_ptr<RigidPartner<2>> rigid_ball(const ContactLaw&, Real, const Vec<2>&, Real);
template std::unique_ptr<RigidPartner<3>> rigid_ball(const ContactLaw&, Real, const Vec<3>&, Real);
template std::unique_ptr<RigidPartner<2>> rigid_cavity(const ContactLaw&, Real, const Vec<2>&,
                                                       Real);
template std::unique_ptr<RigidPartner<3>> rigid_cavity(const ContactLaw&, Real, const Vec<3>&,
                                                       Real);

}  // namespace meniscus
