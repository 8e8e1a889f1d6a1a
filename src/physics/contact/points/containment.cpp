// SPDX-License-Identifier: BSD-3-Clause
// Winding numbers of polyhedra, and bodies that contain each other.
#include "physics/contact/points/containment.hpp"

#include "body/particle_values.hpp"

#include <fmt/core.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace meniscus {
namespace {

/// Angle (3D: solid angle) under which a simplex is seen from x, positive if seen from behind.
Real angle(const std::array<Vec<2>, 2>& segment, const Vec<2>& x) {
  const Vec<2> a = segment[0] - x, b = segment[1] - x;
  return std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
}
Real angle(const std::array<Vec<3>, 3>& triangle, const Vec<3>& x) {
  const Vec<3> a = triangle[0] - x, b = triangle[1] - x, c = triangle[2] - x;
  const Real A = a.norm(), B = b.norm(), C = c.norm();
  return 2 * std::atan2(a.dot(b.cross(c)), A * B * C + a.dot(b) * C + b.dot(c) * A + c.dot(a) * B);
}

/// Outward area vector; its length is the size of the simplex.
Vec<2> area_vector(const std::array<Vec<2>, 2>& segment) {
  const Vec<2> along = segment[1] - segment[0];
  return {along.y(), -along.x()};
}
Vec<3> area_vector(const std::array<Vec<3>, 3>& triangle) {
  return 0.5 * (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]);
}

template <int D>
bool overlap(const Box<D>& a, const Box<D>& b) {
  return (a.low.array() <= b.high.array()).all() && (b.low.array() <= a.high.array()).all();
}

/// The first particle of a body that is inside the other body. Particles below the surface also
/// count, because two equal bodies may lie on each other.
template <int D>
std::optional<Failure> particle_inside(const PlacedBody<D>& placed, const PlacedBody<D>& other) {
  const Polyhedron<D> surface(other);
  for (Index A = 0; A < placed.body.size(); ++A)
    if (const auto depth = surface.depth(at(placed.x, A)))
      return Failure{
          placed.body.first + A,
          fmt::format("is inside of body '{}', {:.4g} below its surface", other.body.name, *depth)};
  return std::nullopt;
}

template <int D>
std::vector<Vec<D>> centres_of(const std::vector<std::array<Vec<D>, D>>& simplices) {
  std::vector<Vec<D>> centres;
  for (const auto& simplex : simplices) {
    Vec<D> centre = Vec<D>::Zero();
    for (const Vec<D>& corner : simplex) centre += corner / D;
    centres.push_back(centre);
  }
  return centres;
}

template <int D>
std::vector<std::array<Vec<D>, D>> simplices_of(const PlacedBody<D>& placed) {
  std::vector<std::array<Vec<D>, D>> simplices;
  for (const auto& corners : triangulate_boundary(placed.body.geometry.grid)) {
    std::array<Vec<D>, D>& simplex = simplices.emplace_back();
    for (int k = 0; k < D; ++k) at(simplex, k) = at(placed.x, at(corners, k));
  }
  return simplices;
}

}  // namespace

template <int D>
PlacedBody<D>::PlacedBody(const Body<D>& the_body, const Motion& motion)
    : body(the_body), x(body.particles.X().begin(), body.particles.X().end()) {
  const NodalVectors u = values_at_particles(body, motion.u.data() + body.first);
  for (Index A = 0; A < body.size(); ++A)
    for (int i = 0; i < D; ++i) at(x, A)[i] += at(u, A)[i];
  box = box_around<D>(x);
}

template <int D>
Polyhedron<D>::Polyhedron(const PlacedBody<D>& body)
    : revolved_(body.body.geometry.grid.revolved),
      simplices_(simplices_of(body)),
      centres_(centres_of<D>(simplices_)),
      box_(body.box),
      search_(centres_) {}

template <int D>
Real Polyhedron<D>::winding_number(const Vec<D>& x) const {
  Real sum = 0;
  for (const Simplex& simplex : simplices_) sum += angle(simplex, x);
  if (revolved_) {  // the other half of the section is seen from x like this one from its image
    Vec<D> image = x;
    image[0] = -x[0];
    for (const Simplex& simplex : simplices_) sum += angle(simplex, image);
  }
  return sum / (D == 3 ? 4 * std::numbers::pi : 2 * std::numbers::pi);
}

template <int D>
std::optional<Real> Polyhedron<D>::depth(const Vec<D>& x) const {
  if (!overlap(box_, Box<D>{x, x})) return std::nullopt;
  std::vector<Index> nearest;
  search_.within(x, search_.distance_of_nearest(x, 1) * (1 + 1e-12), nearest);
  const Vec<D> area = area_vector(at(simplices_, nearest.front()));
  const Real size = area.norm(), edge = D == 3 ? std::sqrt(2 * size) : size;
  const Real depth = area.dot(at(centres_, nearest.front()) - x) / size;
  if (!(depth > 0.25 * edge) || winding_number(x) < 0.5) return std::nullopt;
  return depth;
}

namespace {

template <int D>
std::optional<Failure> either_inside(const PlacedBody<D>& one, const PlacedBody<D>& two) {
  if (!overlap(one.box, two.box)) return std::nullopt;
  if (const auto failure = particle_inside(one, two)) return failure;
  return particle_inside(two, one);
}

}  // namespace

template <int D>
std::optional<Failure> body_inside(const Body<D>& first, const Body<D>& second,
                                   const Motion& motion) {
  return either_inside<D>({first, motion}, {second, motion});
}

template <int D>
std::optional<Contained> any_body_inside(
    const std::vector<const Body<D>*>& bodies, const Motion& motion,
    const std::function<bool(std::size_t, std::size_t)>& watched) {
  std::vector<PlacedBody<D>> placed;
  for (const Body<D>* body : bodies) placed.emplace_back(*body, motion);
  for (std::size_t a = 0; a < placed.size(); ++a)
    for (std::size_t b = a + 1; b < placed.size(); ++b)
      if (watched(a, b))
        if (auto failure = either_inside(placed[a], placed[b]))
          return Contained{a, b, std::move(*failure)};
  return std::nullopt;
}

template <int D>
std::optional<Failure> partner_inside(const Body<D>& body, std::span<const Vec<D>> places,
                                      const Motion& motion) {
  const PlacedBody<D> placed(body, motion);
  if (!overlap(box_around<D>(places), placed.box)) return std::nullopt;
  const Polyhedron<D> surface(placed);
  for (const Vec<D>& x : places) {
    if (!surface.depth(x)) continue;
    const auto nearer = [&](const Vec<D>& a, const Vec<D>& b) {
      return (a - x).squaredNorm() < (b - x).squaredNorm();
    };
    const auto A = std::min_element(placed.x.begin(), placed.x.end(), nearer) - placed.x.begin();
    return Failure{body.first + static_cast<Index>(A),
                   "is the nearest to a place of the rigid partner that is inside of the body"};
  }
  return std::nullopt;
}

#define MENISCUS_INSTANTIATE(D)                                                               \
  template struct PlacedBody<D>;                                                              \
  template class Polyhedron<D>;                                                               \
  template std::optional<Failure> body_inside(const Body<D>&, const Body<D>&, const Motion&); \
  template std::optional<Contained> any_body_inside(                                          \
      const std::vector<const Body<D>*>&, const Motion&,                                      \
      const std::function<bool(std::size_t, std::size_t)>&);                                  \
  template std::optional<Failure> partner_inside(const Body<D>&, std::span<const Vec<D>>,     \
                                                 const Motion&);
MENISCUS_INSTANTIATE(2)
MENISCUS_INSTANTIATE(3)
#undef MENISCUS_INSTANTIATE

}  // namespace meniscus
