// SPDX-License-Identifier: BSD-3-Clause
// Containment: tests whether a point, or a part of a body, is inside another body.
#pragma once
#include "body/body.hpp"
#include "meniscus/physics/force_term.hpp"
#include "numbers/box.hpp"

#include <functional>
#include <optional>
#include <vector>

namespace meniscus {

/// Positions of the particles of a body at a motion, with their bounding box.
template <int D>
struct PlacedBody {
  const Body<D>& body;
  std::vector<Vec<D>> x;
  Box<D> box;

  PlacedBody(const Body<D>& body, const Motion& motion);
};

/// The whole surface of a body as flat simplices between its particles. The winding number of the
/// surface around a point is the sum of the signed solid angles of the simplices (van Oosterom and
/// Strackee 1983) over 4 pi (2D: angles over 2 pi). It is 1 inside the body, and 0 outside and in
/// its cavities.
template <int D>
class Polyhedron {
 public:
  explicit Polyhedron(const PlacedBody<D>& body);

  Real winding_number(const Vec<D>& x) const;
  /// Depth of x below the nearest simplex if x is inside by more than a quarter of an edge;
  /// otherwise empty. Flat simplices may deviate from the surface by this much.
  std::optional<Real> depth(const Vec<D>& x) const;

 private:
  using Simplex = std::array<Vec<D>, D>;

  bool revolved_;
  std::vector<Simplex> simplices_;
  std::vector<Vec<D>> centres_;
  Box<D> box_;
  NeighborSearch<D> search_;  // over the centres
};

/// A particle of one body that is inside the other body; empty if there is none.
template <int D>
std::optional<Failure> body_inside(const Body<D>& first, const Body<D>& second,
                                   const Motion& motion);

/// The numbers of two bodies, and a particle of one of them that is inside the other.
struct Contained {
  std::size_t first, second;
  Failure failure;
};
/// The first pair of bodies of which one has a particle inside the other. Only pairs (first,
/// second) for which watched() is true are tested. All processes call this and get the same result.
template <int D>
std::optional<Contained> any_body_inside(
    const std::vector<const Body<D>*>& bodies, const Motion& motion,
    const std::function<bool(std::size_t, std::size_t)>& watched);

/// One of the positions `places` on a rigid partner that is inside the body; empty if all are
/// outside.
template <int D>
std::optional<Failure> partner_inside(const Body<D>& body, std::span<const Vec<D>> places,
                                      const Motion& motion);

}  // namespace meniscus
