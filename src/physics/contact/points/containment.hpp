// SPDX-License-Identifier: BSD-3-Clause
// Containment: whether a point, or a part of a body, is inside of another body.
#pragma once
#include "body/body.hpp"
#include "meniscus/physics/force_term.hpp"
#include "numbers/box.hpp"

#include <functional>
#include <optional>
#include <vector>

namespace meniscus {

/// Where the particles of a body are at a motion.
template <int D>
struct PlacedBody {
  const Body<D>& body;
  std::vector<Vec<D>> x;
  Box<D> box;

  PlacedBody(const Body<D>& body, const Motion& motion);
};

/// The whole surface of a body, cut into flat simplices between its particles. Its winding number
/// around a point, the sum of their signed solid angles (van Oosterom and Strackee 1983) over 4 pi
/// (2D: angles over 2 pi), is 1 inside of the body and 0 outside and in its cavities.
template <int D>
class Polyhedron {
 public:
  explicit Polyhedron(const PlacedBody<D>& body);

  Real winding_number(const Vec<D>& x) const;
  /// How deep x is behind the nearest simplex, if it is inside by more than the flat simplices may
  /// deviate from the surface they stand for, a quarter of an edge.
  std::optional<Real> depth(const Vec<D>& x) const;

 private:
  using Simplex = std::array<Vec<D>, D>;

  std::vector<Simplex> simplices_;
  std::vector<Vec<D>> centres_;
  Box<D> box_;
  NeighborSearch<D> search_;  // over the centres
};

/// A particle of one of the bodies in the other; none while they are apart.
template <int D>
std::optional<Failure> body_inside(const Body<D>& first, const Body<D>& second,
                                   const Motion& motion);

/// The numbers of two bodies and a particle of one of them in the other.
struct Contained {
  std::size_t first, second;
  Failure failure;
};
/// The first pair of bodies, among those that are `watched`, of which one is inside of the other.
/// All ranks call this and find the same.
template <int D>
std::optional<Contained> any_body_inside(
    const std::vector<const Body<D>*>& bodies, const Motion& motion,
    const std::function<bool(std::size_t, std::size_t)>& watched);

/// One of these places of a rigid partner in the body; none while all are outside.
template <int D>
std::optional<Failure> partner_inside(const Body<D>& body, std::span<const Vec<D>> places,
                                      const Motion& motion);

}  // namespace meniscus
