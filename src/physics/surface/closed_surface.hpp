// SPDX-License-Identifier: BSD-3-Clause
// Closed surface of a body, outer or inner: its enclosed volume and the gradient of this volume.
#pragma once
#include "body/body.hpp"
#include "body/surface/surface_points.hpp"
#include "meniscus/physics/force_term.hpp"
#include "physics/point_elements.hpp"

namespace meniscus {

/// A closed part of the surface with quadrature points q that move with the particles: positions
/// x_q = sum N_A d_A and area vectors m_q = cof(F_q) N_q with da = w_q |m_q|.
///
/// The enclosed volume (2D: area) is V = +-1/D sum w_q (x_q - xm) . m_q with xm = sum w_q x_q / sum
/// w_q. The sign is minus for an inner surface, whose normals point into the cavity. Positions
/// count from their mean, so that V does not change in translations even if the quadrature gives
/// sum w_q m_q != 0. The gradient of V then has no net force and no net torque.
template <int D>
class ClosedSurface {
 public:
  /// `points`: Gauss points per direction and facet. Throws InputError if the body has no such
  /// part.
  ClosedSurface(const Body<D>& body, SurfacePart part, int points);

  struct Size {
    Real volume = 0, area = 0;  ///< enclosed volume, area of the surface; 2D: area, length
  };
  /// The surface points at a motion.
  struct Placed {
    Size size;
    /// Position and area vector m of a point.
    Vec<D> place(Index point) const;
    Vec<D> area_vector(Index point) const;
    std::size_t bytes() const { return groups.size() * sizeof(Group); }

   private:
    friend class ClosedSurface;
    using Vector = std::array<Lanes, 3>;
    /// Four quadrature points.
    struct Group {
      Tensor<Lanes> F;
      Vector x, m;  // x from the origin
    };
    AlignedVector<Group> groups;
    Vec<D> origin;
    Vector mean_x, mean_m;
  };
  Placed placed(const Motion& motion) const;
  /// Like placed(), without allocation; `placed` has to come from this surface.
  void place(const Motion& motion, Placed& placed) const;
  Size size(const Motion& motion) const;

  /// force_A += factor dV/dd_A over the particles A of the body.
  void add_volume_gradient(const Placed& placed, Real factor, const ForceVector& force);

  /// Elements for the second derivatives of V. Derivatives of the mean position and the mean area
  /// vector are left out: they are errors of the quadrature, since sum w_q m_q is zero on a closed
  /// surface.
  void announce(StiffnessMatrix& K) { elements_.announce(rule_, body_.first, K); }
  /// The particles on which the volume depends.
  std::vector<Index> particles() const;
  /// K += factor d2V/dd2.
  void add_volume_stiffness(const Placed& placed, Real factor, StiffnessMatrix& K) const;

  const Body<D>& body() const { return body_; }
  const SurfacePoints<D>& reference() const { return reference_; }
  /// The particle with the largest shape function at a point, numbered in the body.
  Index owner(Index point) const;
  /// Registers the reads of a step: the motion of all points.
  void list_reads(StepReads& reads) const {
    reads.particles(rule_.rows.particle, body_.first);
    reads.rows(chunk_sums_, body_.first);
  }
  std::size_t bytes() const;
  Offset pairs() const { return rule_.pairs(); }

 private:
  using Group = typename Placed::Group;
  Group evaluate(Index group, const NodalVector* u) const;

  const Body<D>& body_;
  SurfacePoints<D> reference_;
  Real share_;       // +-1/D
  Real weight_ = 0;  // sum of the weights of all points
  Vec<D> origin_;
  PointRule<D> rule_;
  ChunkSums chunk_sums_;
  AlignedVector<Lanes> X_, N_;  // [group][k], X from origin_
  PointElements<D> elements_;
};

}  // namespace meniscus
