// SPDX-License-Identifier: BSD-3-Clause
// Varying adhesion and friction of all contact points beside a rigid partner.
#include "physics/contact/rigid/layer_effects.hpp"

#include "meniscus/error.hpp"

namespace meniscus {
namespace {

/// Displacement and velocity of the partner, to which points are relative.
template <int D>
struct Frame {
  Vec<D> shift, velocity;
};

template <int D>
WallPoints<D> wall_points(const ContactPoints<D>& of_grade, Index cluster, const Motion& motion,
                          const Frame<D>& frame, PartnerLayer<D>& layer) {
  const Lanes *x = layer.places.x_of(cluster), *weight = layer.places.weight_of(cluster);
  Lanes v[D];
  of_grade.velocity(cluster, motion, layer.places, v);
  WallPoints<D> points;
  points.T = &at(layer.T, cluster * D);
  points.S = &at(layer.S, cluster * D);
  points.distance = at(layer.distances, cluster);
  for (int lane = 0; lane < Lanes::width; ++lane)
    for (int i = 0; i < D; ++i) {
      at(points.x, lane)[i] = x[i][lane] - frame.shift[i];
      at(points.v, lane)[i] = v[i][lane] - frame.velocity[i];
      at(points.V, lane)[i] = weight[i][lane];
    }
  return points;
}

}  // namespace

template <int D>
void require_adhesion(const BodyAndPartner<D>& pair, const AdhesionPattern& W) try {
  for (Index q = 0; q < pair.finest().size(); ++q) {
    const Vec<D> X = pair.finest().reference_place(q);
    const auto foot = pair.partner.surface->foot(X);
    W(spatial<D>(X - foot.distance * foot.normal), 0);
  }
} catch (const SolveError& error) {
  throw InputError(error.what());
}

template <int D>
void add_effects(const BodyAndPartner<D>& pair, const WallEffects<D>& effects, const Motion& motion,
                 PartnerLayers<D>& layers, LayerTallies<WallSums>& sums) {
  const Frame<D> frame{pair.shift(motion), pair.velocity(motion)};
  sum_visited(
      pair, layers, WallSums(),
      [&](std::size_t g, Index c) {
        if (!(layers[g].nearest_of(c) < pair.interaction->range())) return WallSums();
        WallPoints<D> points = wall_points(pair.points[g], c, motion, frame, layers[g]);
        return effects.add(points, motion.time);
      },
      sums);
}

template <int D>
void take_friction(const BodyAndPartner<D>& pair, const WallEffects<D>& effects,
                   const Motion& motion, PartnerLayers<D>& layers) {
  const Frame<D> frame{pair.shift(motion), Vec<D>::Zero()};
  for (std::size_t g = 0; g < layers.size(); ++g) {
    PartnerLayer<D>& layer = layers[g];
    std::fill(layer.T.begin(), layer.T.end(), Lanes::zero());
    parallel_for(static_cast<Index>(layer.near.size()), [&](Index k) {
      WallPoints<D> points = wall_points(pair.points[g], at(layer.near, k), motion, frame, layer);
      effects.rub(points);
    });
  }
}

template <int D>
Real unit_energy(const BodyAndPartner<D>& pair, const WallEffects<D>& effects, const Motion& motion,
                 const PartnerLayers<D>& layers) {
  const Vec<D> shift = pair.shift(motion);
  Real sum = 0;
  for (const Real of_grade : sums_of_visited(pair, layers, 0.0, [&](std::size_t g, Index c) {
         const PartnerLayer<D>& layer = layers[g];
         Real energy = 0;
         for (int lane = 0; lane < pair.points[g].points_in(c); ++lane) {
           Vec<D> V, S;
           for (int i = 0; i < D; ++i) {
             V[i] = layer.places.weight_of(c)[i][lane];
             S[i] = at(layer.S, c * D + i)[lane];
           }
           const Index q = c * Lanes::width + lane;
           energy += effects.unit_energy(layer.places.place(q) - shift, layer.distance(q), V, S);
         }
         return energy;
       }))
    sum += of_grade;
  return sum;
}

template <int D>
Vec<D> mean_slip(const BodyAndPartner<D>& pair, const WallEffects<D>& effects, const Motion& motion,
                 PartnerLayers<D>& layers) {
  const Frame<D> frame{pair.shift(motion), pair.velocity(motion)};
  using AreaAndSlip = Eigen::Matrix<Real, D + 1, 1>;
  const AreaAndSlip none = AreaAndSlip::Zero();
  for (std::size_t g = 0; g < layers.size(); ++g)
    pair.points[g].prepare_velocities(layers[g].visited, motion, layers[g].places);
  AreaAndSlip sum = none;
  for (const AreaAndSlip& of_grade :
       sums_of_visited(pair, layers, none, [&](std::size_t g, Index c) -> AreaAndSlip {
         const auto [area, slip] =
             effects.slip(wall_points(pair.points[g], c, motion, frame, layers[g]));
         AreaAndSlip both;
         both << area, slip;
         return both;
       }))
    sum += of_grade;
  const Vec<D> slip = sum.template tail<D>();
  return sum[0] > 0 ? Vec<D>(slip / sum[0]) : slip;
}

#define MENISCUS_INSTANTIATE(D)                                                               \
  template void require_adhesion(const BodyAndPartner<D>&, const AdhesionPattern&);           \
  template void add_effects(const BodyAndPartner<D>&, const WallEffects<D>&, const Motion&,   \
                            PartnerLayers<D>&, LayerTallies<WallSums>&);                      \
  template void take_friction(const BodyAndPartner<D>&, const WallEffects<D>&, const Motion&, \
                              PartnerLayers<D>&);                                             \
  template Real unit_energy(const BodyAndPartner<D>&, const WallEffects<D>&, const Motion&,   \
                            const PartnerLayers<D>&);                                         \
  template Vec<D> mean_slip(const BodyAndPartner<D>&, const WallEffects<D>&, const Motion&,   \
                            PartnerLayers<D>&);
MENISCUS_INSTANTIATE(2)
MENISCUS_INSTANTIATE(3)
#undef MENISCUS_INSTANTIATE

}  // namespace meniscus
