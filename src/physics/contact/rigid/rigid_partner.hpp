// SPDX-License-Identifier: BSD-3-Clause
// Rigid bodies whose interaction with a point has a closed form (CGCM note 3). They need no mesh
// and have no quadrature error.
//
// They have no cut-off: a law with a cut-off meets a rigid partner with its full tail. Pairs of
// deformable bodies therefore adhere less than a body and a rigid partner, by `lost_adhesion` of
// contact_numbers.hpp.
#pragma once
#include "physics/contact/contact_law.hpp"

#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace meniscus {

/// Interaction of a point with a rigid body 2 that has the particle density beta2. The density
/// beta1 of the point's body is not included:
///
///   U = beta2 INT_2 phi dv2,   S = beta2 oint_2 u n2 da2,   div S = U,   grad S symmetric.
///
/// The energy of body 1 is beta1 oint_1 S.n1 da1. Tractions: form E from S and grad S; form B
/// -beta1 U n1; form A Sigma n1 with Sigma = -beta1 grad S.
template <int D>
struct RigidField {
  Real U;
  Vec<D> S;
  Mat<D> grad_S;  ///< (i, j): dS_i/dx_j
};

/// Four points and the fields at these points, one per lane.
template <int D>
using LanePlace = std::array<Lanes, D>;
template <int D>
struct LaneField {
  Lanes U, distance;
  std::array<Lanes, D> S;
  std::array<std::array<Lanes, D>, D> grad_S;  ///< [i][j]
};

/// A rigid body as a field that acts on points outside of it.
template <int D>
class RigidPartner {
 public:
  virtual ~RigidPartner() = default;

  /// The field at a point x in the frame of the partner (rigid_motion.hpp). It is exact for
  /// distance(x) >= guard x sigma0. Nearer, and inside the material, U grows linearly with the
  /// depth: a point that came through the surface is pushed back. S is continued accordingly, and
  /// grad S is its gradient (around corners of polygons: approximately).
  virtual RigidField<D> field(const Vec<D>& x) const = 0;

  /// Distance of x from the surface, negative inside the material.
  virtual Real distance(const Vec<D>& x) const = 0;

  /// Field and distance of the first `points` of four points; the other lanes get the distance of
  /// the last of them.
  virtual LaneField<D> fields(const LanePlace<D>& x, int points) const;
  virtual Lanes distances(const LanePlace<D>& x) const;
};

/// The functions below make partners. The kernel must be `integrated` or `planar` in 2D, and
/// `space` in 3D. They throw InputError for other kernels, for sizes that are not positive and for
/// a zero normal.

/// All points behind the plane through `point`. The normal, of any length, points out of the
/// material.
template <int D>
std::unique_ptr<RigidPartner<D>> rigid_half_space(const ContactLaw& law, Real beta,
                                                  const Vec<D>& point, const Vec<D>& normal);

/// A ball (2D: a cylinder normal to the plane).
template <int D>
std::unique_ptr<RigidPartner<D>> rigid_ball(const ContactLaw& law, Real beta, const Vec<D>& centre,
                                            Real radius);

/// All space around a spherical (2D: cylindrical) cavity.
template <int D>
std::unique_ptr<RigidPartner<D>> rigid_cavity(const ContactLaw& law, Real beta,
                                              const Vec<D>& centre, Real radius);

/// Closed polygons with the material on the left of every edge. A counter-clockwise polygon is a
/// body, a clockwise polygon is a hole; a body with holes needs both. Edges of different polygons
/// must not cross.
std::unique_ptr<RigidPartner<2>> rigid_polygons(const ContactLaw& law, Real beta,
                                                const std::vector<std::vector<Vec<2>>>& polygons);

/// A frame around the rectangle between the corners `low` and `high`; its thickness may be
/// infinite.
std::unique_ptr<RigidPartner<2>> rigid_frame(
    const ContactLaw& law, Real beta, const Vec<2>& low, const Vec<2>& high,
    Real thickness = std::numeric_limits<Real>::infinity());

}  // namespace meniscus
