// SPDX-License-Identifier: BSD-3-Clause
// Changes of the forces of a rigid partner with positions and area vectors of contact points.
#include "physics/contact/rigid/partner_tangent.hpp"

namespace meniscus {
namespace {

constexpr Real part_of_gap = 3e-4;

/// The fourth-order difference of values at steps 1, -1, 2, -2.
template <class T>
T slope(const T& ahead, const T& behind, const T& ahead2, const T& behind2, Real step) {
  return (8 * (ahead - behind) - (ahead2 - behind2)) / (12 * step);
}

/// Changes of the points of a grade and of their forces.
template <int D>
struct ForceChange {
  ContactChanges<D> points;
  AlignedVector<Lanes> T, S;
};

/// Changes of forces are dT = (grad grad S dx) V + grad S dV and dS = grad S dx; for the pressure
/// form, dT = (grad U dx) V + U dV. Derivatives of the field are fourth-order differences over a
/// small part of the gap.
template <int D>
ForceChange<D> force_change(const BodyAndPartner<D>& pair, std::size_t grade,
                            const PartnerLayers<D>& layers, const Motion& motion,
                            const Motion& change) {
  const PartnerLayer<D>& layer = layers[grade];
  const Vec<D> shift = pair.shift(motion);
  ForceChange<D> d{pair.points[grade].changes(layer.visited, layer.places, motion, change), {}, {}};
  d.T.assign(layer.S.size(), Lanes::zero());
  d.S = d.T;
  const auto change_of_point = [&](Index c, int lane) {
    Vec<D> place, dx, V, dV;
    for (int i = 0; i < D; ++i) {
      place[i] = layer.places.x_of(c)[i][lane] - shift[i];
      dx[i] = d.points.x_of(c)[i][lane];
      V[i] = layer.places.weight_of(c)[i][lane];
      dV[i] = at(d.points.weight, c * D + i)[lane];
    }
    const Real length = dx.norm();
    if (length == 0 && dV.isZero(0)) return;
    const Real gap = std::max(at(layer.distances, c)[lane], pair.interaction->least_gap());
    const Real h = length > 0 ? part_of_gap * gap / length : 1;
    const auto field = [&](Real s) { return pair.partner.shape->field(place + s * h * dx); };
    const RigidField<D> here = field(0), ahead = field(1), behind = field(-1), ahead2 = field(2),
                        behind2 = field(-2);
    Vec<D> pull;
    if (pair.form == ContactForm::pressure)
      pull = slope(ahead.U, behind.U, ahead2.U, behind2.U, h) * V + here.U * dV;
    else
      pull = slope<Mat<D>>(ahead.grad_S, behind.grad_S, ahead2.grad_S, behind2.grad_S, h) * V +
             here.grad_S * dV;
    const Vec<D> turn = here.grad_S * dx;
    for (int i = 0; i < D; ++i) {
      at(d.T, c * D + i).set(lane, pull[i]);
      at(d.S, c * D + i).set(lane, turn[i]);
    }
  };
  parallel_for(
      static_cast<Index>(layer.visited.size()),
      [&](Index k) {
        for (int lane = 0; lane < Lanes::width; ++lane) change_of_point(at(layer.visited, k), lane);
      },
      16);
  return d;
}

}  // namespace

template <int D>
void add_tangent_of_partner(BodyAndPartner<D>& pair, const PartnerLayers<D>& layers,
                            const Motion& motion, const Motion& change, const Forces& force) {
  for (std::size_t g = 0; g < layers.size(); ++g) {
    const ForceChange<D> d = force_change(pair, g, layers, motion, change);
    pair.points[g].add_force_change(layers[g].places, d.points, motion, change, layers[g].visited,
                                    d.T, layers[g].moment(pair.form), d.S, force);
  }
}

template <int D>
Vec<D> change_of_resultant(const BodyAndPartner<D>& pair, const PartnerLayers<D>& layers,
                           const Motion& motion, const Motion& change) {
  std::vector<ForceChange<D>> d;
  for (std::size_t g = 0; g < layers.size(); ++g)
    d.push_back(force_change(pair, g, layers, motion, change));
  Vec<D> all = Vec<D>::Zero();
  for (const Vec<D>&of_grade :
       sums_of_visited(pair, layers, Vec<D>(Vec<D>::Zero()), [&](std::size_t g, Index c) {
         Vec<D> of_cluster;
         for (int i = 0; i < D; ++i) of_cluster[i] = sum(at(d[g].T, c * D + i));
         return of_cluster;
       }))
    all -= of_grade;
  return all;
}

template <int D>
void add_stiffness_of_partner(const BodyAndPartner<D>& pair, const PartnerLayers<D>& layers,
                              const Motion& motion, StiffnessMatrix& K) {
  const Vec<D> shift = pair.shift(motion);
  for (std::size_t g = 0; g < layers.size(); ++g) {
    const PartnerLayer<D>& layer = layers[g];
    pair.points[g].add_stiffness(layer.visited, motion, layer.S, K, [&](Index c, int lane) {
      Vec<D> place, V;
      for (int i = 0; i < D; ++i) {
        place[i] = layer.places.x_of(c)[i][lane] - shift[i];
        V[i] = layer.places.weight_of(c)[i][lane];
      }
      const Real h =
          part_of_gap * std::max(at(layer.distances, c)[lane], pair.interaction->least_gap());
      typename ContactPoints<D>::Curvature of;
      of.of_weight = pair.partner.shape->field(place).grad_S;
      for (int j = 0; j < D; ++j) {
        const auto pull = [&](Real s) -> Vec<D> {
          return pair.partner.shape->field(place + s * h * Vec<D>::Unit(j)).grad_S * V;
        };
        of.of_place.col(j) = slope<Vec<D>>(pull(1), pull(-1), pull(2), pull(-2), h);
      }
      return of;
    });
  }
}

#define MENISCUS_INSTANTIATE(D)                                                                    \
  template void add_tangent_of_partner(BodyAndPartner<D>&, const PartnerLayers<D>&, const Motion&, \
                                       const Motion&, const Forces&);                              \
  template Vec<D> change_of_resultant(const BodyAndPartner<D>&, const PartnerLayers<D>&,           \
                                      const Motion&, const Motion&);                               \
  template void add_stiffness_of_partner(const BodyAndPartner<D>&, const PartnerLayers<D>&,        \
                                         const Motion&, StiffnessMatrix&);
MENISCUS_INSTANTIATE(2)
MENISCUS_INSTANTIATE(3)
#undef MENISCUS_INSTANTIATE

}  // namespace meniscus
