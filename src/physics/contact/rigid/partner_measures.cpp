// SPDX-License-Identifier: BSD-3-Clause
// Sums over the contact points beside a rigid partner, and measures based on these sums.
#include "physics/contact/rigid/partner_measures.hpp"

#include "numbers/dense.hpp"
#include "physics/contact/rigid/partner_field.hpp"
#include "physics/contact/rigid/partner_visits.hpp"

namespace meniscus {
namespace {

/// Contact points with the forces of the interaction of uniform strength, without its other
/// effects.
template <int D>
PartnerLayers<D> layers_without_effects(const BodyAndPartner<D>& pair, const Motion& motion) {
  PartnerLayers<D> layers = layers_at_rest(pair);
  choose_grades(pair, motion, layers);
  take_layers(pair, motion, layers);
  return layers;
}

/// The vector of one lane.
template <int D>
Eigen::Vector3d vector_of(const Lanes* field, int lane) {
  Vec<D> x;
  for (int i = 0; i < D; ++i) x[i] = field[i][lane];
  return spatial<D>(x);
}

template <int D>
Real wetted_area(const BodyAndPartner<D>& pair, const WallEffects<D>& effects,
                 const Motion& motion) {
  const PartnerLayers<D> uniform = layers_without_effects(pair, motion);
  return std::max(0.0, -unit_energy(pair, effects, motion, uniform) / effects.adhesion());
}

}  // namespace

template <int D>
PartnerLayers<D> layers_at(const BodyAndPartner<D>& pair, const WallEffects<D>& effects,
                           const Motion& motion) {
  PartnerLayers<D> layers = layers_without_effects(pair, motion);
  if (!effects.any()) return layers;
  for (std::size_t g = 0; g < layers.size(); ++g)
    pair.points[g].prepare_velocities(layers[g].visited, motion, layers[g].places);
  LayerTallies<WallSums> sums = layer_tallies<WallSums>(pair);
  add_effects(pair, effects, motion, layers, sums);
  return layers;
}

template <int D>
Real energy_of(const BodyAndPartner<D>& pair, const PartnerLayers<D>& layers) {
  Real energy = 0;
  for (const Real of_grade : sums_of_visited(pair, layers, 0.0, [&](std::size_t g, Index c) {
         Lanes E = Lanes::zero();
         for (int i = 0; i < D; ++i)
           E += at(layers[g].S, c * D + i) * layers[g].places.weight_of(c)[i];
         return sum(E);
       }))
    energy += of_grade;
  return energy;
}

template <int D>
void sum_resultants(const BodyAndPartner<D>& pair, const PartnerLayers<D>& layers,
                    LayerTallies<Resultant>& sums) {
  sum_visited(
      pair, layers, Resultant(),
      [&](std::size_t g, Index c) {
        Resultant of_cluster;
        for (int i = 0; i < D; ++i) of_cluster.force[i] = sum(at(layers[g].T, c * D + i));
        for (int lane = 0; lane < Lanes::width; ++lane) {
          of_cluster.moment += cross(vector_of<D>(layers[g].places.x_of(c), lane),
                                     vector_of<D>(&at(layers[g].T, c * D), lane));
          if (pair.form == ContactForm::energy)
            of_cluster.moment += cross(vector_of<D>(layers[g].places.weight_of(c), lane),
                                       vector_of<D>(&at(layers[g].S, c * D), lane));
        }
        return of_cluster;
      },
      sums);
}

Resultant resultant(const LayerTallies<Resultant>& sums) {
  Eigen::Vector3d force = Eigen::Vector3d::Zero(), moment = force;
  for (const ChunkTally<Resultant>& of_chunks : sums) {
    const Resultant of_grade = of_chunks.sum(Resultant());
    force -= of_grade.force;
    moment -= of_grade.moment;
  }
  return {force, moment};
}

template <int D>
Resultant resultant(const BodyAndPartner<D>& pair, const PartnerLayers<D>& layers) {
  LayerTallies<Resultant> sums = layer_tallies<Resultant>(pair);
  sum_resultants(pair, layers, sums);
  for (ChunkTally<Resultant>& of_grade : sums) GatherTogether()({{of_grade.gathered()}});
  return resultant(sums);
}

template <int D>
Real gap_at(const BodyAndPartner<D>& pair, const Motion& motion) {
  PartnerLayer<D> layer(pair, 0);
  move_points(pair, 0, motion, layer);
  take_distances(pair, 0, motion, layer);
  PartTally<Real> least(pair.division);
  if (Real* const mine = least.mine()) {
    *mine = unbounded;
    for (const Index c : layer.visited) *mine = std::min(*mine, layer.nearest_of(c));
  }
  GatherTogether()({{least.gathered()}});
  return *std::min_element(least.begin(), least.end());
}

template <int D>
std::vector<MeasureSource> measures_of(const BodyAndPartner<D>& pair, const WallEffects<D>& effects,
                                       bool wets) {
  const auto looked_at = [&pair, &effects](auto&& number) {
    return [&pair, &effects, number](const Motion& motion) {
      return Real(number(layers_at(pair, effects, motion)));
    };
  };
  std::vector<MeasureSource> all{
      {"energy", dimension::energy, "energy of the interaction",
       looked_at([&pair](const PartnerLayers<D>& layers) { return energy_of(pair, layers); })},
      {"gap", dimension::length, "least distance of the points of the body from the partner",
       [&pair](const Motion& motion) { return gap_at(pair, motion) - pair.interaction->recess(); }},
      {"gap_per_spacing", dimension::none,
       "the gap as the law counts it / distance of neighbouring points",
       [&pair](const Motion& motion) { return gap_at(pair, motion) / pair.finest().spacing(); }}};
  const bool revolved = pair.finest().body().geometry.grid.revolved;
  const int first = revolved ? 1 : 0;  // components across the axis balance each other
  for (int i = first; i < D; ++i)
    all.push_back({std::string("force_") + "xyz"[i], dimension::force, "force on the body",
                   looked_at([i, &pair](const PartnerLayers<D>& layers) {
                     return resultant(pair, layers).force[i];
                   })});
  for (int i = D == 3 ? 0 : 2; i < 3 && !revolved; ++i)
    all.push_back({std::string("torque_") + "xyz"[i], dimension::energy,
                   "torque on the body about the origin",
                   looked_at([i, &pair](const PartnerLayers<D>& layers) {
                     return resultant(pair, layers).moment[i];
                   })});
  if (wets) {
    for (int i = first; i < D; ++i)
      all.push_back({std::string("reaction_") + "xyz"[i], dimension::force, "force on the partner",
                     looked_at([i, &pair](const PartnerLayers<D>& layers) {
                       return -resultant(pair, layers).force[i];
                     })});
    all.push_back(
        {"wetted_area", of_sum(dimension::area, D),
         "area in full contact that has the energy of the adhesion (2D: length)",
         [&pair, &effects](const Motion& motion) { return wetted_area(pair, effects, motion); }});
  }
  if (effects.rubs())
    for (int i = first; i < D; ++i)
      all.push_back({std::string("slip_") + "xyz"[i], dimension::velocity,
                     "mean velocity along the partner and relative to it, over the area that rubs",
                     [i, &pair, &effects](const Motion& motion) {
                       PartnerLayers<D> layers = layers_without_effects(pair, motion);
                       return mean_slip(pair, effects, motion, layers)[i];
                     }});
  if (const PartnerPress<D>* press = pair.partner.motion.press()) {
    all.push_back({"way", dimension::length, "way of the pressed partner along its direction",
                   [press](const Motion&) { return press->way(); }});
    all.push_back({"press", dimension::force, "force that presses it: its own and its spring's",
                   [press](const Motion& motion) {
                     return press->force(motion.time) + press->spring_force(motion.time);
                   }});
  }
  if (pair.partner.motion.moves() || pair.partner.motion.press())
    for (int i = first; i < D; ++i)
      all.push_back({std::string("displacement_") + "xyz"[i], dimension::length,
                     "displacement of the partner",
                     [i, &pair](const Motion& motion) { return pair.shift(motion)[i]; }});
  return all;
}

#define MENISCUS_INSTANTIATE(D)                                                                    \
  template PartnerLayers<D> layers_at(const BodyAndPartner<D>&, const WallEffects<D>&,             \
                                      const Motion&);                                              \
  template Real energy_of(const BodyAndPartner<D>&, const PartnerLayers<D>&);                      \
  template Resultant resultant(const BodyAndPartner<D>&, const PartnerLayers<D>&);                 \
  template void sum_resultants(const BodyAndPartner<D>&, const PartnerLayers<D>&,                  \
                               LayerTallies<Resultant>&);                                          \
  template Real gap_at(const BodyAndPartner<D>&, const Motion&);                                   \
  template std::vector<MeasureSource> measures_of(const BodyAndPartner<D>&, const WallEffects<D>&, \
                                                  bool);
MENISCUS_INSTANTIATE(2)
MENISCUS_INSTANTIATE(3)
#undef MENISCUS_INSTANTIATE

}  // namespace meniscus
