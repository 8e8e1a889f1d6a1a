// SPDX-License-Identifier: BSD-3-Clause
// Moves a pressed partner to where its forces are in balance, at each motion of the body.
#include "physics/contact/rigid/pressed_partner.hpp"

#include "numbers/box.hpp"
#include "numbers/dense.hpp"
#include "physics/contact/rigid/partner_field.hpp"
#include "physics/contact/rigid/partner_measures.hpp"
#include "physics/contact/rigid/partner_tangent.hpp"
#include "physics/contact/rigid/partner_visits.hpp"

namespace meniscus {

namespace {

/// The body at a motion that is known everywhere.
template <int D>
class PressedBody final : public PartnerPress<D>::Neighbour {
 public:
  PressedBody(const BodyAndPartner<D>& pair, const Motion& motion, PressedPoints<D>& points)
      : pair_(pair), motion_(motion), points_(points) {}

  Real pull() override {
    choose_visited(pair_, motion_, points_.list, points_.layers);
    take_layers(pair_, motion_, points_.layers);
    sum_resultants(pair_, points_.layers, points_.sums);
    for (auto& of_grade : points_.sums) GatherTogether()({{of_grade.gathered()}});
    const Vec<D>& n = pair_.partner.motion.press()->direction();
    return resultant(points_.sums).force.dot(spatial<D>(n));
  }
  Real gap() override { return gap_at(pair_, motion_); }

 private:
  const BodyAndPartner<D>& pair_;
  const Motion& motion_;
  PressedPoints<D>& points_;
};

}  // namespace

template <int D>
bool settle_partner(const BodyAndPartner<D>& pair, const Motion& motion, PressedPoints<D>& points) {
  constexpr Real many = 100;  // sizes of the body
  const Real size = box_around<D>(pair.finest().body().particles.X()).extent().norm();
  PressedBody<D> body(pair, motion, points);
  return pair.partner.motion.press()->settle(motion.time, body, pair.interaction->least_gap(),
                                             many * size);
}

namespace {

/// A field that is n on the body of a contact and zero on others.
template <int D>
NodalVectors along(const BodyAndPartner<D>& pair, std::size_t size) {
  const Vec<D>& n = pair.partner.motion.press()->direction();
  const Body<D>& body = pair.finest().body();
  NodalVectors field(size, Lanes::zero());
  for (Index A = body.first; A < body.first + body.size(); ++A)
    for (int i = 0; i < D; ++i) at(field, A).set(i, n[i]);
  return field;
}

/// dR.n/ds + k: a partner that moves by n ds is a body that moves by -n ds.
template <int D>
Real stiffness_of_way(const BodyAndPartner<D>& pair, const PartnerLayers<D>& layers,
                      const Motion& motion, const NodalVectors& n) {
  const PartnerPress<D>& press = *pair.partner.motion.press();
  return press.stiffness() -
         change_of_resultant(pair, layers, motion, {motion.time, n, n}).dot(press.direction());
}

}  // namespace

template <int D>
NodalVectors relative_change(const BodyAndPartner<D>& pair, const PartnerLayers<D>& layers,
                             const Motion& motion, const Motion& change) {
  NodalVectors du = along(pair, change.u.size());
  const Real of_way = stiffness_of_way(pair, layers, motion, du),
             pull = change_of_resultant(pair, layers, motion, change)
                        .dot(pair.partner.motion.press()->direction()),
             back = of_way > 0 ? pull / of_way : 0;  // without a minimum the partner stays
  for (std::size_t A = 0; A < du.size(); ++A) du[A] = change.u[A] + back * du[A];
  return du;
}

template <int D>
void add_stiffness_of_way(BodyAndPartner<D>& pair, const PartnerLayers<D>& layers,
                          const Motion& motion, Index node, StiffnessMatrix& K) {
  const NodalVectors n = along(pair, motion.u.size());
  const Real of_way = stiffness_of_way(pair, layers, motion, n);
  if (!K.is_here()) return;
  NodalVectors column(n.size(), Lanes::zero());
  add_tangent_of_partner(pair, layers, motion, {motion.time, n, n}, column);
  K.add_column(node, column);
  K.add_to_diagonal(node, of_way);
}

#define MENISCUS_INSTANTIATE(D)                                                                  \
  template bool settle_partner(const BodyAndPartner<D>&, const Motion&, PressedPoints<D>&);      \
  template NodalVectors relative_change(const BodyAndPartner<D>&, const PartnerLayers<D>&,       \
                                        const Motion&, const Motion&);                           \
  template void add_stiffness_of_way(BodyAndPartner<D>&, const PartnerLayers<D>&, const Motion&, \
                                     Index, StiffnessMatrix&);
MENISCUS_INSTANTIATE(2)
MENISCUS_INSTANTIATE(3)
#undef MENISCUS_INSTANTIATE

}  // namespace meniscus
