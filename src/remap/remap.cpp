// SPDX-License-Identifier: BSD-3-Clause
// New reference configurations, and the transfer of velocities and fields to them.
#include "remap/remap.hpp"

#include "body/particle_values.hpp"
#include "body/surface/quadratic_surface.hpp"
#include "meniscus/error.hpp"
#include "numbers/dense.hpp"
#include "remap/nodal_values.hpp"
#include "remap/present_surface.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace meniscus {
namespace {

template <int D>
PointRows<D> value_rows(const Body<D>& body, std::span<const Vec<D>> points) {
  return build_point_rows<D>(body.particles, points, {.value = true}, body.name);
}

template <int D>
std::vector<Vec<D>> centroids(const NodalCells<D>& cells) {
  std::vector<Vec<D>> X;
  for (Index A = 0; A < cells.size(); ++A) X.push_back(cells.centroid(A));
  return X;
}

/// Positions in the reference of the scene, after particles or cells have moved within the
/// reference of the body.
template <int D>
std::vector<Vec<D>> origins(const std::vector<Vec<D>>& origin, auto&& from,
                            const PointRows<D>& to) {
  NodalVectors f(origin.size(), Lanes::zero());
  for (std::size_t A = 0; A < origin.size(); ++A) set_vector<D>(f, A, origin[A]);
  const NodalVectors moved = shifted(f, from(f.data()), values_at(to, f.data()));
  std::vector<Vec<D>> result = origin;
  for (std::size_t A = 0; A < result.size(); ++A)
    for (int i = 0; i < D; ++i) result[A][i] = moved[A][i];
  return result;
}

/// J - 1 of the nodal cells after they have moved within the reference of the body.
template <int D>
std::vector<Real> volume_changes(std::span<const Real> of_cells, const PointRows<D>& from,
                                 const PointRows<D>& to) {
  NodalVectors f;
  // Component 1 also suits folded rows, whose component 0 is odd.
  for (const Real theta : of_cells) f.push_back({0, theta, 0, 0});
  std::vector<Real> theta;
  for (const Lanes& value : shifted(f, values_at(from, f.data()), values_at(to, f.data())))
    theta.push_back(value[1]);
  return theta;
}

/// Mass, first moment, momentum, angular momentum, and inertia about the centre of mass, all
/// computed from coefficients.
struct RigidSums {
  Real mass = 0;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero(), momentum = centre, angular_momentum = centre;
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
};

template <int D>
RigidSums rigid_sums(const Body<D>& body, const State& state) {
  RigidSums sums;
  const auto x = [&](Index A) {
    Eigen::Vector3d place = spatial<D>(at(body.particles.X(), A));
    for (int i = 0; i < D; ++i) place[i] += at(state.u, body.first + A)[i];
    return place;
  };
  for (Index A = 0; A < body.size(); ++A) {
    const Lanes& v = at(state.v, body.first + A);
    const Eigen::Vector3d p = at(body.mass, A) * Eigen::Vector3d(v[0], v[1], v[2]);
    sums.mass += at(body.mass, A);
    sums.centre += at(body.mass, A) * x(A);
    sums.momentum += p;
    sums.angular_momentum += cross(x(A), p);
  }
  sums.centre /= sums.mass;
  for (Index A = 0; A < body.size(); ++A) {
    const Eigen::Vector3d r = x(A) - sums.centre;
    sums.inertia +=
        at(body.mass, A) * (r.squaredNorm() * Eigen::Matrix3d::Identity() - r * r.transpose());
  }
  return sums;
}

/// Adds a rigid motion a + w x (x - centre), so that momentum and angular momentum become equal to
/// `target`.
template <int D>
void restore_momenta(const Body<D>& body, const RigidSums& target, State& state) {
  const RigidSums now = rigid_sums(body, state);
  Eigen::Vector3d a = (target.momentum - now.momentum) / now.mass;
  const Eigen::Vector3d spin_left = target.angular_momentum - now.angular_momentum -
                                    cross(now.centre, target.momentum - now.momentum);
  // In 2D the body spins about z only, with the plane moment of inertia.
  Eigen::Vector3d w = D == 3 ? Eigen::Vector3d(solve_symmetric(now.inertia, spin_left))
                             : Eigen::Vector3d(0, 0, spin_left[2] / now.inertia(2, 2));
  if (body.geometry.grid.revolved) {  // it moves along the axis only
    a[0] = 0;
    w.setZero();
  }
  for (Index A = 0; A < body.size(); ++A) {
    const Eigen::Vector3d dv = a + cross(w, spatial<D>(at(body.particles.X(), A)) - now.centre);
    at(state.v, body.first + A) += Lanes(dv[0], dv[1], D == 3 ? dv[2] : 0.0, 0);
  }
}

}  // namespace

template <int D>
std::vector<Vec<D>> present_nodes(const Body<D>& body, const NodalVector* u,
                                  std::span<const Real> volume_change) {
  std::vector<Vec<D>> x = places(body, u);
  Real present = 0;
  Vec<D> middle = Vec<D>::Zero();
  for (Index A = 0; A < body.size(); ++A) {
    present += body.cells.volume(A) * (1 + at(volume_change, A)) / body.volume_ratio(A);
    middle += at(x, A) / body.size();
  }
  if (body.geometry.grid.revolved) middle[0] = 0;
  const Real stretch =
      std::pow(present / volume(moved(body.geometry, x, true).grid), 1.0 / body.space());
  for (Vec<D>& place : x) place = middle + stretch * (place - middle);
  return x;
}

template <int D>
Seeds<D> on_present_patches(const Body<D>& body, const NodalVector* u) {
  const Grid<D>& grid = body.geometry.grid;
  const PresentSurface<D> surface(body, u);
  Seeds<D> seeds(places(body, u));
  seeds.surface = surface.points();
  for (const auto& [key, number] : PatchNodes<D>(grid).number)
    if (key.size() == 1) at(seeds.nodes, key.front()) = at(seeds.surface, number);
  return seeds;
}

template <int D>
Remap<D> remap(const Body<D>& body, const NodalVector* u, Seeds<D> seeds,
               std::span<const Real> volume_change) {
  std::vector<Vec<D>>& x = seeds.nodes;
  const Reference<D>* old = body.reference.get();
  const std::vector<Index> boundary = boundary_nodes(body.geometry.grid);
  const bool same_boundary = std::all_of(boundary.begin(), boundary.end(), [&](Index A) {
    return at(x, A) == at(body.particles.X(), A);
  });
  auto next = std::make_shared<Reference<D>>();
  Remap<D> result;
  result.nodes = pre_images<D>(body, u, x);
  if (!seeds.surface.empty()) {
    next->surface = std::move(seeds.surface);
    Grid<D> grid = body.geometry.grid;
    grid.X = std::move(x);
    next->geometry =
        quadratic_geometry(std::move(grid), next->surface, body.geometry.surface->smooth());
  } else {
    if (same_boundary && old) next->surface = old->surface;
    next->recovered = !same_boundary || (old && old->recovered);
    next->geometry = moved(body.geometry, std::move(x), next->recovered);
  }
  const NodalCells<D> cells(next->geometry.grid);
  const std::vector<Vec<D>> cell_places = pre_images<D>(body, u, centroids(cells));
  const PointRows<D> old_cells = value_rows<D>(body, centroids(body.cells)),
                     new_cells = value_rows<D>(body, cell_places);
  if (old) {
    next->origin = origins<D>(
        old->origin, [&](const NodalVector* f) { return values_at_particles(body, f); },
        value_rows<D>(body, result.nodes));
    next->cell_origin = origins<D>(
        old->cell_origin, [&](const NodalVector* f) { return values_at(old_cells, f); }, new_cells);
  } else {
    next->origin = result.nodes;
    next->cell_origin = cell_places;
  }
  Real volume_before = 0, volume_now = 0;  // volumes in the reference of the scene
  const std::vector<Real> theta = volume_changes<D>(volume_change, old_cells, new_cells);
  for (Index A = 0; A < body.size(); ++A) {
    if (!(at(theta, A) > -1))
      throw SolveError(fmt::format("body '{}': J = {:.4g} in the nodal cell of particle {}",
                                   body.name, 1 + at(theta, A), A));
    volume_before += body.cells.volume(A) / body.volume_ratio(A);
    volume_now += cells.volume(A) / (1 + at(theta, A));
  }
  const Real scale = volume_now / volume_before;
  for (const Real t : theta) next->volume_ratio.push_back(scale * (1 + t));
  next->mass = std::accumulate(body.mass.begin(), body.mass.end(), 0.0);
  result.reference = std::move(next);
  return result;
}

template <int D>
State carried(const System<D>& before, const State& state, const System<D>& after,
              const std::map<std::string, Remap<D>>& remaps) {
  State result = state;
  for (std::size_t b = 0; b < before.bodies.size(); ++b) {
    const Body<D>&old = before.bodies[b], &body = after.bodies[b];
    const auto found = remaps.find(body.name);
    if (found == remaps.end()) continue;
    const PointRows<D> rows = value_rows<D>(old, found->second.nodes);
    const auto carry = [&](NodalVectors& field) {
      const auto own = old.part(std::span<NodalVector>(field));
      const NodalVectors coefficients(own.begin(), own.end());
      const NodalVectors there = values_at(rows, coefficients.data());
      const NodalVectors c = coefficients_of(
          body, there, shifted(coefficients, values_at_particles(old, coefficients.data()), there));
      std::copy(c.begin(), c.end(), own.begin());
    };
    carry(result.v);
    const auto u = body.part(std::span<NodalVector>(result.u));
    std::fill(u.begin(), u.end(), Lanes::zero());
    restore_momenta(body, rigid_sums(old, state), result);
    for (Unknown& field : result.fields) {
      carry(field.x);
      carry(field.rate);
    }
  }
  for (std::size_t k = 0; k < result.fields.size(); ++k)
    result.fields[k].capacity = after.fields[k].capacity;
  return result;
}

#define MENISCUS_INSTANTIATE(D)                                                                 \
  template std::vector<Vec<D>> present_nodes(const Body<D>&, const NodalVector*,                \
                                             std::span<const Real>);                            \
  template Seeds<D> on_present_patches(const Body<D>&, const NodalVector*);                     \
  template Remap<D> remap(const Body<D>&, const NodalVector*, Seeds<D>, std::span<const Real>); \
  template State carried(const System<D>&, const State&, const System<D>&,                      \
                         const std::map<std::string, Remap<D>>&);
MENISCUS_INSTANTIATE(2)
MENISCUS_INSTANTIATE(3)
#undef MENISCUS_INSTANTIATE

}  // namespace meniscus
