// SPDX-License-Identifier: BSD-3-Clause
// Contact points that move with their body, and their forces on its particles.
#include "physics/contact/points/contact_points.hpp"

#include "body/surface/surface_points.hpp"
#include "numbers/box.hpp"
#include "physics/contact/points/patch_points.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace meniscus {
namespace {

/// Sorts `order` so that `together` consecutive points are near each other: halves it along the
/// longest edge of the bounding box, cutting at multiples of `together`.
template <int D>
void order_in_space(const std::vector<Vec<D>>& X, std::span<Index> order, std::size_t together) {
  if (order.size() <= together) return;
  Box<D> box;
  for (const Index q : order) box.include(at(X, q));
  Eigen::Index axis = 0;
  box.extent().maxCoeff(&axis);
  const auto less = [&](Index a, Index b) {
    return at(X, a)[axis] != at(X, b)[axis] ? at(X, a)[axis] < at(X, b)[axis] : a < b;
  };
  const std::size_t groups = (order.size() + together - 1) / together;
  const std::size_t half = groups / 2 * together;
  std::nth_element(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(half), order.end(),
                   less);
  order_in_space(X, order.first(half), together);
  order_in_space(X, order.subspan(half), together);
}

std::vector<Index> numbers(std::size_t count) {
  std::vector<Index> all(count);
  std::iota(all.begin(), all.end(), Index{0});
  return all;
}

/// The facets of a body, in an order in which near facets follow each other.
template <int D>
std::vector<Index> facets_in_space(const Grid<D>& grid) {
  std::vector<Vec<D>> centre;
  for (const Facet<D>& facet : grid.facets) {
    Vec<D> sum = Vec<D>::Zero();
    for (const Index node : facet.nodes) sum += at(grid.X, node);
    centre.push_back(sum);
  }
  std::vector<Index> order = numbers(centre.size());
  order_in_space<D>(centre, order, 1);
  return order;
}

}  // namespace

template <int D>
void ContactPoints<D>::place_points(const std::vector<Vec<D>>& X, const std::vector<Real>& measure,
                                    Clusters clusters) {
  const auto append = [&](std::span<const Index> points) {
    for (std::size_t k = 0; k < points.size(); k += Lanes::width)
      made_->points_in.push_back(
          static_cast<Index>(std::min<std::size_t>(Lanes::width, points.size() - k)));
    made_->order.insert(made_->order.end(), points.begin(), points.end());
  };
  std::vector<Index> order = numbers(X.size());
  if (clusters == Clusters::of_neighbours) {
    order_in_space<D>(X, order, Lanes::width);
    append(order);
  } else {
    const Grid<D>& grid = body_->geometry.grid;
    const std::size_t per_facet = X.size() / grid.facets.size();
    for (const Index facet : facets_in_space(grid)) {
      const std::span<Index> points(&at(order, facet * static_cast<Index>(per_facet)), per_facet);
      order_in_space<D>(X, points, Lanes::width);
      append(points);
      made_->order.resize(made_->points_in.size() * Lanes::width, points.back());
    }
  }
  const auto& search = body_->particles.search();
  std::vector<Index> nearest;
  for (Index q = 0; q < static_cast<Index>(made_->order.size()); ++q) {
    const Vec<D>& x = at(X, at(made_->order, q));
    made_->rule.point_weight.push_back(has_point(q) ? at(measure, at(made_->order, q)) : 0);
    search.within(x, search.distance_of_nearest(x, 1) * (1 + 1e-12), nearest);
    made_->rule.point_owner.push_back(nearest.front());
  }
  Real total = 0;
  for (std::size_t q = 0; q < X.size(); ++q)
    total += measure[q] / circle(body_->geometry.grid, X[q]);
  made_->spacing =
      std::pow(total / static_cast<Real>(X.size()), 1.0 / (components_ == 1 ? D : D - 1));
  made_->X.assign(offset(this->clusters(), D), Lanes::zero());
  for (Index c = 0; c < this->clusters(); ++c)
    for (int lane = 0; lane < Lanes::width; ++lane)
      for (int i = 0; i < D; ++i)
        at(made_->X, c * D + i)
            .set(lane,
                 at(X, at(made_->order, c * Lanes::width + std::min(lane, points_in(c) - 1)))[i]);
}

template <int D>
void ContactPoints<D>::build_rows(RowContent content) {
  std::vector<Vec<D>> places;
  for (Index q = 0; q < size(); ++q)
    if (has_point(q)) places.push_back(reference_place(q));
  made_->rule.rows = build_point_rows<D>(body_->particles, places, content, body_->name);
  PointRows<D>& rows = made_->rule.rows;
  const std::vector<Offset> start = std::exchange(rows.start, {0});
  if (rows.folded) rows.radius.clear();
  for (Index q = 0, point = 0; q < size(); ++q) {
    rows.start.push_back(at(start, has_point(q) ? ++point : point));
    if (rows.folded) rows.radius.push_back(reference_place(q)[0]);
  }
  made_->chunk_sums = made_->rule.chunk_sums(*body_);
}

template <int D>
void ContactPoints<D>::list_particles() {
  std::vector<bool> moves(static_cast<std::size_t>(body_->size()));
  for (const Index A : (made_->patches ? made_->patches->rows() : made_->rule.rows).particle)
    moves[static_cast<std::size_t>(A)] = true;
  for (Index A = 0; A < body_->size(); ++A)
    if (moves[static_cast<std::size_t>(A)]) made_->particles.push_back(A);
}

template <int D>
template <class F>
void ContactPoints<D>::for_shape_functions(Index point, F&& f) const {
  if (made_->patches) return made_->patches->for_shape_functions(at(made_->order, point), f);
  const PointRows<D>& rows = made_->rule.rows;
  for (Offset e = at(rows.start, point); e < at(rows.start, point + 1); ++e)
    f(at(rows.particle, e), at(rows.value, e));  // folded rows: along the axis
}

/// Inertia: the smallest m_A / (sum_s w_s |N_A| sum_B |N_B|), the mass that a row of the contact
/// stiffness acts on. Gain: the largest sum_B |N_B|.
template <int D>
void ContactPoints<D>::take_inertia() {
  std::vector<Real> carried(body_->mass.size(), 0), sum(carried);
  std::vector<Index> touched;
  for (Index q = 0; q < size(); ++q) {
    touched.clear();
    for_shape_functions(q, [&](Index A, Real N) {
      if (at(sum, A) == 0) touched.push_back(A);
      at(sum, A) += N;
    });
    Real row = 0;
    for (const Index A : touched) row += std::abs(at(sum, A));
    made_->gain = std::max(made_->gain, row);
    for (const Index A : touched) {
      at(carried, A) += at(made_->rule.point_weight, q) * std::abs(at(sum, A)) * row;
      at(sum, A) = 0;
    }
  }
  made_->inertia = std::numeric_limits<Real>::infinity();
  for (std::size_t A = 0; A < carried.size(); ++A)
    if (carried[A] > 0) made_->inertia = std::min(made_->inertia, body_->mass[A] / carried[A]);
}

/// Uses the points of this name that another contact has made, or makes them with make().
template <int D>
template <class Make>
void ContactPoints<D>::share(const std::string& name, Make&& make) {
  made_ = body_->shared.template get<SharedContactPoints<D>>("contact points " + name, [&] {
    made_ = std::make_shared<SharedContactPoints<D>>();
    make();
    made_->all = numbers(made_->points_in.size());
    list_particles();
    take_inertia();
    is_first_ = true;
    return made_;
  });
}

template <int D>
ContactPoints<D> ContactPoints<D>::on_surface(const Body<D>& body, Real beta, SiteDensity density,
                                              int points, Clusters clusters) {
  const SurfacePoints<D> surface = surface_points(body.geometry, points);
  ContactPoints contact(body, D);
  contact.density_ = density;
  contact.share(fmt::format("on the surface {} {}", points, static_cast<int>(clusters)), [&] {
    contact.place_points(surface.X, surface.area, clusters);
    contact.build_rows({.value = true, .gradient = true});
  });
  contact.take_weights(
      [&](Index point) { return Vec<D>(beta * at(surface.area, point) * at(surface.N, point)); });
  return contact;
}

template <int D>
ContactPoints<D> ContactPoints<D>::on_patches(const Body<D>& body, Real beta, int points,
                                              Clusters clusters) {
  ContactPoints contact(body, D);
  contact.density_ = SiteDensity::constant;
  contact.beta_ = beta;
  contact.share(fmt::format("on patches {} {}", points, static_cast<int>(clusters)), [&] {
    contact.made_->patches = std::make_shared<PatchPoints<D>>(body, points);
    contact.place_points_of_patches(clusters);
  });
  const PatchPoints<D>& patches = *contact.made_->patches;
  contact.take_weights([&](Index point) {
    return Vec<D>(beta * patches.area_vector(point, patches.reference_nodes()));
  });
  return contact;
}

template <int D>
void ContactPoints<D>::place_points_of_patches(Clusters clusters) {
  const PatchPoints<D>& patches = *made_->patches;
  std::vector<Vec<D>> X;
  std::vector<Real> area;
  for (Index q = 0; q < patches.size(); ++q) {
    X.push_back(patches.place(q, patches.reference_nodes()));
    area.push_back(patches.area_vector(q, patches.reference_nodes()).norm());
  }
  place_points(X, area, clusters);
  made_->of_group.resize(static_cast<std::size_t>(patches.group_count()));
  for (Index q = 0; q < size(); ++q)
    if (has_point(q)) at(made_->of_group, patches.group(at(made_->order, q))).push_back(q);
}

template <int D>
ContactPoints<D> ContactPoints<D>::in_volume(const Body<D>& body, Real beta, int points) {
  const CellPoints<D> cells = cell_gauss_points(body.geometry.grid, points);
  ContactPoints contact(body, 1);
  contact.share(fmt::format("in the volume {}", points), [&] {
    contact.place_points(cells.X, cells.weight, Clusters::of_neighbours);
    contact.build_rows({.value = true});
  });
  contact.take_weights(
      [&](Index point) { return Eigen::Matrix<Real, 1, 1>(beta * at(cells.weight, point)); });
  return contact;
}

/// weight_of(number) returns the weight of a point by its number before it was sorted.
template <int D>
template <class F>
void ContactPoints<D>::take_weights(F&& weight_of) {
  reference_.assign(offset(clusters(), components_), Lanes::zero());
  pushed_.assign(made_->points_in.size(), 0);
  for (Index q = 0; q < size(); ++q) {
    if (!has_point(q)) continue;
    const auto weight = weight_of(at(made_->order, q));
    for (int i = 0; i < components_; ++i)
      at(reference_, q / Lanes::width * components_ + i).set(q % Lanes::width, weight[i]);
  }
}

template <int D>
ContactPlaces<D> ContactPoints<D>::at_rest() const {
  ContactPlaces<D> places{size(), components_, made_->X, reference_, {}};
  if (made_->patches) {
    places.nodes = made_->patches->reference_nodes();
    places.wanted.reserve(places.nodes.size());
    places.is_wanted.assign(places.nodes.size(), 0);
  } else if (components_ == D) {
    places.inverse.assign(static_cast<std::size_t>(clusters()), Tensor<Lanes>::identity());
  }
  return places;
}

/// Calls f(q, set) for the points of a cluster. set(lanes, value) stores a value of the point in
/// its lane; the value of the last point is also stored in lanes without a point.
template <int D>
template <class F>
void ContactPoints<D>::for_points(Index cluster, F&& f) const {
  const Index points = points_in(cluster);
  for (Index k = 0; k < points; ++k)
    f(cluster * Lanes::width + k, [&](Lanes& lanes, Real value) {
      for (Index lane = k; lane < (k + 1 < points ? k + 1 : Lanes::width); ++lane)
        lanes.set(lane, value);
    });
}

template <int D>
void ContactPoints<D>::move(Index c, const NodalVector* u, ContactPlaces<D>& places) const {
  for_points(c, [&](Index q, auto&& set) {
    const Index lane = q % Lanes::width;
    const Lanes moved = value_at(made_->rule.rows, q, u);
    for (int i = 0; i < D; ++i)
      set(at(places.x, c * D + i), at(made_->X, c * D + i)[lane] + moved[i]);
  });
}

template <int D>
void ContactPoints<D>::move_on_patches(Index c, ContactPlaces<D>& places) const {
  for_points(c, [&](Index q, auto&& set) {
    const Vec<D> x = made_->patches->place(at(made_->order, q), places.nodes);
    for (int i = 0; i < D; ++i) set(at(places.x, c * D + i), x[i]);
  });
}

template <int D>
void ContactPoints<D>::move(const Motion& motion, ContactPlaces<D>& places) const {
  move(all(), motion, places);
}

template <int D>
void ContactPoints<D>::move(const ItemRange& clusters, const Motion& motion,
                            ContactPlaces<D>& places) const {
  const NodalVector* u = motion.u.data() + body_->first;
  parallel_for(
      clusters, [&](Index c) { move(c, u, places); }, 16);
}

template <int D>
void ContactPoints<D>::move(std::span<const Index> clusters, const Motion& motion,
                            ContactPlaces<D>& places) const {
  const NodalVector* u = motion.u.data() + body_->first;
  if (made_->patches) {
    want_nodes(clusters, places);
    parallel_for(static_cast<Index>(places.wanted.size()), [&](Index k) {
      const Index node = at(places.wanted, k);
      at(places.nodes, node) = made_->patches->place_of_node(node, u);
    });
  }
  parallel_for(
      static_cast<Index>(clusters.size()),
      [&](Index k) {
        const Index c = at(clusters, k);
        made_->patches ? move_on_patches(c, places) : move(c, u, places);
      },
      16);
}

template <int D>
void ContactPoints<D>::update_weights(std::span<const Index> clusters, const Motion& motion,
                                      ContactPlaces<D>& places) const {
  if (components_ == 1) return;
  const NodalVector* u = motion.u.data() + body_->first;
  parallel_for(
      static_cast<Index>(clusters.size()),
      [&](Index k) { update_weights(at(clusters, k), u, places); }, 16);
}

template <int D>
void ContactPoints<D>::update_weights(Index c, const NodalVector* u,
                                      ContactPlaces<D>& places) const {
  if (made_->patches) {
    for (Index lane = 0; lane < points_in(c); ++lane) {
      const Vec<D> V = beta_ * made_->patches->area_vector(
                                   at(made_->order, c * Lanes::width + lane), places.nodes);
      for (int i = 0; i < D; ++i) at(places.weight, c * D + i).set(lane, V[i]);
    }
    return;
  }
  Tensor<Lanes> H;
  made_->rule.gather(c, u, H);
  Tensor<Lanes> cof = cofactor_of_deformation(H);
  const Lanes one_over_J = 1.0 / (1.0 + volume_change(H));
  at(places.inverse, c) = one_over_J * transpose(cof);
  if (density_ == SiteDensity::referential) cof = one_over_J * cof;
  const Lanes* N = reference_.data() + offset(c, D);
  for (int i = 0; i < D; ++i) {
    Lanes V = cof(i, 0) * N[0];
    for (int K = 1; K < D; ++K) V += cof(i, K) * N[K];
    at(places.weight, c * D + i) = V;
  }
}

template <int D>
void ContactPoints<D>::want_nodes(std::span<const Index> clusters, ContactPlaces<D>& places) const {
  std::fill(places.is_wanted.begin(), places.is_wanted.end(), std::uint8_t{0});
  for (const Index c : clusters)
    for (Index lane = 0; lane < points_in(c); ++lane)
      made_->patches->want(at(made_->order, c * Lanes::width + lane), places.is_wanted);
  places.wanted.clear();
  for (Index a = 0; a < made_->patches->node_count(); ++a)
    if (at(places.is_wanted, a)) places.wanted.push_back(a);
}

template <int D>
void ContactPoints<D>::prepare_velocities(std::span<const Index> clusters, const Motion& motion,
                                          ContactPlaces<D>& places) const {
  if (!made_->patches) return;
  want_nodes(clusters, places);
  places.node_v.resize(places.nodes.size());
  for (const Index node : places.wanted)
    at(places.node_v, node) = made_->patches->value(node, motion.v.data() + body_->first);
}

template <int D>
void ContactPoints<D>::velocity(Index cluster, const Motion& motion, const ContactPlaces<D>& places,
                                Lanes* v) const {
  if (!made_->patches) return velocity_nearby(cluster, motion, v);
  for_points(cluster, [&](Index q, auto&& set) {
    const Vec<D> rate = made_->patches->place(at(made_->order, q), places.node_v);
    for (int i = 0; i < D; ++i) set(v[i], rate[i]);
  });
}

template <int D>
void ContactPoints<D>::velocity_nearby(Index cluster, const Motion& motion, Lanes* v) const {
  const NodalVector* field = motion.v.data() + body_->first;
  for_points(cluster, [&](Index q, auto&& set) {
    const Lanes rate = made_->patches ? made_->patches->value(
                                            made_->patches->node_nearby(at(made_->order, q)), field)
                                      : value_at(made_->rule.rows, q, field);
    for (int i = 0; i < D; ++i) set(v[i], rate[i]);
  });
}

template <int D>
void ContactPoints<D>::velocity_nearby(Index cluster, const SharedWork& work,
                                       const Vec<D>& otherwise, const Motion& motion,
                                       Lanes* v) const {
  if (!made_->patches) return velocity_nearby(cluster, motion, v);
  const ItemRange own = work.rows(body_->division).own_rows(made_->patches->node_count());
  for_points(cluster, [&](Index q, auto&& set) {
    const Index node = made_->patches->node_nearby(at(made_->order, q));
    Vec<D> rate = otherwise;
    if (node >= own.begin && node < own.end) {
      const Lanes known = made_->patches->value(node, motion.v.data() + body_->first);
      for (int i = 0; i < D; ++i) rate[i] = known[i];
    }
    for (int i = 0; i < D; ++i) set(v[i], rate[i]);
  });
}

/// The first Piola stress (S.V) F^-T [constant density only] - V (F^-1 S)^T of a cluster.
template <int D>
Tensor<Lanes> ContactPoints<D>::stress(const ContactPlaces<D>& places, Index cluster,
                                       const Lanes* S) const {
  const Tensor<Lanes>& inverse = at(places.inverse, cluster);
  const Lanes* V = places.weight_of(cluster);
  Lanes SV = Lanes::zero(), pulled[3], area[3];
  for (int K = 0; K < 3; ++K) pulled[K] = area[K] = Lanes::zero();
  for (int i = 0; i < D; ++i) {
    if (density_ == SiteDensity::constant) SV += S[i] * V[i];
    area[i] = V[i];
    for (int K = 0; K < D; ++K) pulled[K] += inverse(K, i) * S[i];
  }
  return Tensor<Lanes>::map([&](int i, int K) { return SV * inverse(K, i) - area[i] * pulled[K]; });
}

template <int D>
void ContactPoints<D>::add_force(const ContactPlaces<D>& places, std::span<const Index> clusters,
                                 std::span<const Lanes> T, std::span<const Lanes> S,
                                 const Forces& force) {
  if (made_->patches) return add_force_on_patches(places, clusters, T, S, force);
  for (const Index c : clusters) at(pushed_, c) = 1;
  made_->chunk_sums.accumulate(
      body_->part(force), [&](int, Index begin, Index end, NodalVector* f) {
        for (Index c = begin; c < end; ++c) {
          if (!at(pushed_, c)) continue;
          const Lanes* pull = T.data() + offset(c, D);
          const auto by_point = by_lane(pull[0], pull[1], D == 3 ? pull[D - 1] : Lanes::zero());
          for (Index lane = 0; lane < points_in(c); ++lane)
            scatter_value(made_->rule.rows, c * Lanes::width + lane, -at(by_point, lane), f);
          if (!S.empty())
            made_->rule.scatter(c, -1.0 * stress(places, c, S.data() + offset(c, D)), f);
        }
      });
  for (const Index c : clusters) at(pushed_, c) = 0;
}

template <int D>
void ContactPoints<D>::add_force_on_patches(const ContactPlaces<D>& places,
                                            std::span<const Index> clusters,
                                            std::span<const Lanes> T, std::span<const Lanes> S,
                                            const Forces& force) {
  for (const Index c : clusters) at(pushed_, c) = 1;
  parallel_for(static_cast<Index>(made_->of_group.size()), [&](Index group) {
    made_->patches->begin_force(group);
    for (const Index q : at(made_->of_group, group)) {
      const Index c = q / Lanes::width, lane = q % Lanes::width;
      if (!at(pushed_, c)) continue;
      Vec<D> pull, turn = Vec<D>::Zero();
      for (int i = 0; i < D; ++i) {
        pull[i] = T[offset(c, D) + static_cast<std::size_t>(i)][lane];
        if (!S.empty()) turn[i] = beta_ * S[offset(c, D) + static_cast<std::size_t>(i)][lane];
      }
      made_->patches->add(at(made_->order, q), pull, turn, places.nodes);
    }
  });
  made_->patches->end_force(body_->part(force));
  for (const Index c : clusters) at(pushed_, c) = 0;
}

template <int D>
Offset ContactPoints<D>::pairs() const {
  return made_->patches ? made_->patches->pairs() : made_->rule.rows.entries();
}

template <int D>
std::size_t SharedContactPoints<D>::bytes() const {
  return rule.bytes() + chunk_sums.bytes() + X.size() * sizeof(Lanes) +
         (order.size() + points_in.size() + particles.size() + all.size()) * sizeof(Index) +
         (patches ? patches->bytes() : 0);
}

template <int D>
std::size_t ContactPoints<D>::bytes() const {
  return (is_first_ ? made_->bytes() : 0) + reference_.size() * sizeof(Lanes);
}

template class ContactPoints<2>;
template class ContactPoints<3>;

}  // namespace meniscus
