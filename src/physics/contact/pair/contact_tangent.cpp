// SPDX-License-Identifier: BSD-3-Clause
// The tangent: changes of contact points and of their forces. It has a file of its own so that it
// does not affect the compilation of the loops of the time step.
#include "physics/contact/points/contact_points.hpp"
#include "physics/contact/points/patch_points.hpp"

#include <algorithm>

namespace meniscus {

/// Like update_weights(), with dual numbers.
template <int D>
typename ContactPoints<D>::Turned ContactPoints<D>::turned(Index c, const Motion& motion,
                                                           const Motion& change) const {
  Tensor<Lanes> H, dH;
  made_->rule.gather(c, motion.u.data() + body_->first, H);
  made_->rule.gather(c, change.u.data() + body_->first, dH);
  return turned(c, dual(H, dH));
}

template <int D>
typename ContactPoints<D>::Turned ContactPoints<D>::turned(Index c,
                                                           const Tensor<Dual<Lanes>>& moved) const {
  Tensor<Dual<Lanes>> cof = cofactor_of_deformation(moved);
  const Dual<Lanes> one_over_J = 1.0 / (1.0 + volume_change(moved));
  Turned now;
  now.inverse = one_over_J * transpose(cof);
  if (density_ == SiteDensity::referential) cof = one_over_J * cof;
  const Lanes* N = reference_.data() + offset(c, D);
  for (int i = 0; i < D; ++i) {
    at(now.V, i) = cof(i, 0) * N[0];
    for (int K = 1; K < D; ++K) at(now.V, i) += cof(i, K) * N[K];
  }
  return now;
}

/// The derivative of stress(), by dual numbers.
template <int D>
Tensor<Lanes> ContactPoints<D>::stress_change(const Turned& now,
                                              const std::array<Dual<Lanes>, D>& S) const {
  Dual<Lanes> SV(0.0), pulled[3], area[3];
  for (int K = 0; K < 3; ++K) pulled[K] = area[K] = 0.0;
  for (int i = 0; i < D; ++i) {
    if (density_ == SiteDensity::constant) SV += at(S, i) * at(now.V, i);
    area[i] = at(now.V, i);
    for (int K = 0; K < D; ++K) pulled[K] += now.inverse(K, i) * at(S, i);
  }
  return Tensor<Lanes>::map(
      [&](int i, int K) { return (SV * now.inverse(K, i) - area[i] * pulled[K]).d; });
}

/// The derivatives of dE/dx and dE/dF with each component of x and F. On a circle about the axis
/// x_0 also stretches the circle.
template <int D>
void ContactPoints<D>::set_moduli(Index c, const Motion& motion, std::span<const Lanes> S,
                                  const std::array<Curvature, Lanes::width>& of,
                                  PointModuli<D>& moduli) const {
  const PointRows<D>& rows = made_->rule.rows;
  Lanes per_radius = Lanes::zero();  // stretch of the circle per x_0
  if (rows.folded)
    for (int lane = 0; lane < Lanes::width; ++lane)
      per_radius.set(lane, 1 / at(rows.radius, c * Lanes::width + lane));
  Tensor<Lanes> H;
  made_->rule.gather(c, motion.u.data() + body_->first, H);
  for (int j = 0; j < D; ++j)
    for (int b = 0; b <= D; ++b) {  // of x_j, F_j0, ...
      Tensor<Lanes> dH = Tensor<Lanes>::zero();
      if (b > 0)
        dH(j, b - 1) = Lanes(1.0);
      else if (j == 0)
        dH(2, 2) = per_radius;
      const Turned now = turned(c, dual(H, dH));
      std::array<Lanes, D> pull;
      std::array<Dual<Lanes>, D> turn;
      for (int i = 0; i < D; ++i) {
        at(pull, i) = Lanes::zero();
        at(turn, i) = {S[offset(c, D) + static_cast<std::size_t>(i)], Lanes::zero()};
        for (int lane = 0; lane < points_in(c); ++lane) {
          const Curvature& here = at(of, lane);
          Real change = b == 0 ? here.of_place(i, j) : 0;
          for (int k = 0; k < D; ++k) change += here.of_weight(i, k) * at(now.V, k).d[lane];
          at(pull, i).set(lane, change);
          if (b == 0) at(turn, i).d.set(lane, here.of_weight(j, i));
        }
      }
      const Tensor<Lanes> change = stress_change(now, turn);
      for (int i = 0; i < D; ++i) {
        moduli(i, 0, j, b) = at(pull, i);
        for (int M = 0; M < D; ++M) moduli(i, M + 1, j, b) = change(i, M);
      }
      moduli(0, 0, j, b) += per_radius * change(2, 2);
    }
}

template <int D>
ContactChanges<D> ContactPoints<D>::changes(std::span<const Index> clusters,
                                            const ContactPlaces<D>& places, const Motion& motion,
                                            const Motion& change) const {
  const NodalVector* du = change.u.data() + body_->first;
  ContactChanges<D> all;
  all.x.assign(offset(this->clusters(), D), Lanes::zero());
  all.weight.assign(offset(this->clusters(), components_), Lanes::zero());
  NodalVectors ahead, behind;
  if (made_->patches) {
    for (Index node = 0; node < made_->patches->node_count(); ++node)
      all.nodes.push_back(made_->patches->value(node, du));
    ahead = behind = places.nodes;
    for (std::size_t a = 0; a < ahead.size(); ++a) {
      ahead[a] += all.nodes[a];
      behind[a] -= all.nodes[a];
    }
  }
  parallel_for(
      static_cast<Index>(clusters.size()),
      [&](Index k) {
        const Index c = at(clusters, k);
        for (Index lane = 0; lane < Lanes::width; ++lane) {
          const Index q = c * Lanes::width + std::min(lane, points_in(c) - 1);
          Vec<D> dx;
          if (made_->patches) {
            dx = made_->patches->place(at(made_->order, q), all.nodes);
          } else {
            const Lanes moved = value_at(made_->rule.rows, q, du);
            for (int i = 0; i < D; ++i) dx[i] = moved[i];
          }
          for (int i = 0; i < D; ++i) at(all.x, c * D + i).set(lane, dx[i]);
          if (!made_->patches || lane >= points_in(c)) continue;
          // Quadratic in the positions of the nodes, so central differences are exact.
          const Vec<D> dV = 0.5 * beta_ *
                            (made_->patches->area_vector(at(made_->order, q), ahead) -
                             made_->patches->area_vector(at(made_->order, q), behind));
          for (int i = 0; i < D; ++i) at(all.weight, c * D + i).set(lane, dV[i]);
        }
        if (made_->patches || components_ == 1) return;
        const auto now = turned(c, motion, change);
        for (int i = 0; i < D; ++i) at(all.weight, c * D + i) = at(now.V, i).d;
      },
      16);
  return all;
}

template <int D>
void ContactPoints<D>::add_force_change(const ContactPlaces<D>& places,
                                        const ContactChanges<D>& changes, const Motion& motion,
                                        const Motion& change, std::span<const Index> clusters,
                                        std::span<const Lanes> dT, std::span<const Lanes> S,
                                        std::span<const Lanes> dS, const Forces& force) {
  if (made_->patches) return add_change_on_patches(places, changes, clusters, dT, S, dS, force);
  for (const Index c : clusters) at(pushed_, c) = 1;
  made_->chunk_sums.accumulate(
      body_->part(force), [&](int, Index begin, Index end, NodalVector* f) {
        for (Index c = begin; c < end; ++c) {
          if (!at(pushed_, c)) continue;
          const Lanes* pull = dT.data() + offset(c, D);
          const auto by_point = by_lane(pull[0], pull[1], D == 3 ? pull[D - 1] : Lanes::zero());
          for (Index lane = 0; lane < points_in(c); ++lane)
            scatter_value(made_->rule.rows, c * Lanes::width + lane, -at(by_point, lane), f);
          if (S.empty()) continue;
          const auto now = turned(c, motion, change);
          std::array<Dual<Lanes>, D> turn;
          for (int i = 0; i < D; ++i)
            at(turn, i) = {S[offset(c, D) + static_cast<std::size_t>(i)],
                           dS[offset(c, D) + static_cast<std::size_t>(i)]};
          made_->rule.scatter(c, -1.0 * stress_change(now, turn), f);
        }
      });
  for (const Index c : clusters) at(pushed_, c) = 0;
}

template <int D>
void ContactPoints<D>::add_change_on_patches(const ContactPlaces<D>& places,
                                             const ContactChanges<D>& changes,
                                             std::span<const Index> clusters,
                                             std::span<const Lanes> dT, std::span<const Lanes> S,
                                             std::span<const Lanes> dS, const Forces& force) {
  for (const Index c : clusters) at(pushed_, c) = 1;
  parallel_for(static_cast<Index>(made_->of_group.size()), [&](Index group) {
    made_->patches->begin_force(group);
    for (const Index q : at(made_->of_group, group)) {
      const Index c = q / Lanes::width, lane = q % Lanes::width;
      if (!at(pushed_, c)) continue;
      Vec<D> pull, turn = Vec<D>::Zero(), turned_by = turn;
      for (int i = 0; i < D; ++i) {
        const std::size_t k = offset(c, D) + static_cast<std::size_t>(i);
        pull[i] = dT[k][lane];
        if (S.empty()) continue;
        turn[i] = beta_ * S[k][lane];
        turned_by[i] = beta_ * dS[k][lane];
      }
      made_->patches->add(at(made_->order, q), pull, turned_by, places.nodes);
      // The force by the area vector is linear in the nodes in 3D and of circles; in plane strain
      // it is constant.
      if (D == 3 || body_->geometry.grid.revolved)
        made_->patches->add(at(made_->order, q), Vec<D>::Zero(), turn, changes.nodes);
    }
  });
  made_->patches->end_force(body_->part(force));
  for (const Index c : clusters) at(pushed_, c) = 0;
}

#define MENISCUS_INSTANTIATE(D)                                                             \
  template void ContactPoints<D>::set_moduli(Index, const Motion&, std::span<const Lanes>,  \
                                             const std::array<Curvature, Lanes::width>&,    \
                                             PointModuli<D>&) const;                        \
  template ContactChanges<D> ContactPoints<D>::changes(                                     \
      std::span<const Index>, const ContactPlaces<D>&, const Motion&, const Motion&) const; \
  template void ContactPoints<D>::add_force_change(                                         \
      const ContactPlaces<D>&, const ContactChanges<D>&, const Motion&, const Motion&,      \
      std::span<const Index>, std::span<const Lanes>, std::span<const Lanes>,               \
      std::span<const Lanes>, const Forces&);
MENISCUS_INSTANTIATE(2)
MENISCUS_INSTANTIATE(3)
#undef MENISCUS_INSTANTIATE

}  // namespace meniscus
