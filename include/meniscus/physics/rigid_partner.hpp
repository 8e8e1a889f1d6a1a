// SPDX-License-Identifier: BSD-3-Clause
// Rigid bodies whose interaction with a point is known in closed form (CGCM note 3). They have no
// mesh and no error of quadrature.
//
// They have no cut-off either: a law with one still meets a rigid partner with its full tail, so
// that pairs of deformable bodies adhere less than the same law does to a rigid partner, by the
// `lost_adhesion` of contact_numbers.hpp.
#pragma once
#include "meniscus/physics/contact_law.hpp"

#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace meniscus {

/// Interaction of a point with a rigid body 2, with the density beta2 of its particles and without
/// beta1 of the point's:
///   U = beta2 INT_2 phi dv2,   S = beta2 oint_2 u n2 da2,   div S = U,   grad S symmetric.
/// The energy of body 1 is beta1 oint_1 S.n1 da1. Tractions: form E from S and grad S; form B
/// -beta1 U n1; form A Sigma n1 with Sigma = -beta1 grad S.
template <int D>
struct RigidField {
  Real U;
  Vec<D> S;
  Mat<D> grad_S;  ///< (i, j): dS_i/dx_j
};

/// Four points and the fields there, a lane per point.
template <int D>
using LanePlace = std::array<Lanes, D>;
template <int D>
struct LaneField {
  Lanes U, distance;
  std::array<Lanes, D> S;
  std::array<std::array<Lanes, D>, D> grad_S;  ///< [i][j]
};

/// A rigid body as a field: what it does to a point outside of it.
template <int D>
class RigidPartner {
 public:
  virtual ~RigidPartner() = default;

  /// At a point x of its own frame (see rigid_motion.hpp). Exact where distance(x) is at least
  /// guard x sigma0. Nearer, and inside of the material, U goes on growing linearly with the
  /// depth, so that a point that came through the surface is pushed back and not pulled in; S goes
  /// with it, and grad S is its gradient (around corners of polygons: approximately).
  virtual RigidField<D> field(const Vec<D>& x) const = 0;

  /// Distance of x from the surface, negative inside of the material.
  virtual Real distance(const Vec<D>& x) const = 0;

  /// Field and distance of the first `points` of four points, with the distance of the last of them
  /// for the others.
  virtual LaneField<D> fields(const LanePlace<D>& x, int points) const;
  virtual Lanes distances(const LanePlace<D>& x) const;
};

/// The kernel of a partner in two dimensions is `integrated` or `planar`, in three `space`; the
/// makers throw InputError for others, for sizes that are not positive and for no direction.

/// All points behind the plane through `point` whose normal (of any length) points out of it.
template <int D>
std::unique_ptr<RigidPartner<D>> rigid_half_space(const ContactLaw& law, Real beta,
                                                  const Vec<D>& point, const Vec<D>& normal);

/// Ball (2D: cylinder across the plane).
template <int D>
std::unique_ptr<RigidPartner<D>> rigid_ball(const ContactLaw& law, Real beta, const Vec<D>& centre,
                                            Real radius);

/// All space around a spherical (2D: cylindrical) cavity.
template <int D>
std::unique_ptr<RigidPartner<D>> rigid_cavity(const ContactLaw& law, Real beta,
                                              const Vec<D>& centre, Real radius);

/// Closed polygons: the material is on the left of every edge. A polygon whose vertices turn left
/// is a body, one whose vertices turn right a hole; a body with holes is given by both. Edges of
/// different polygons must not cross.
std::unique_ptr<RigidPartner<2>> rigid_polygons(const ContactLaw& law, Real beta,
                                                const std::vector<std::vector<Vec<2>>>& polygons);

/// A frame around the rectangle between the corners `low` and `high`, of a thickness that may be
/// infinite.
std::unique_ptr<RigidPartner<2>> rigid_frame(
    const ContactLaw& law, Real beta, const Vec<2>& low, const Vec<2>& high,
    Real thickness = std::numeric_limits<Real>::infinity());

}  // namespace meniscus
