// SPDX-License-Identifier: BSD-3-Clause
// Holds the fluid behind a wetted face to the wall (sharp line note 1).
#pragma once
#include "body/surface/wetted_points.hpp"
#include "meniscus/physics/force_term.hpp"
#include "numbers/dual.hpp"

namespace meniscus {

/// The places of a wetted face are on the wall by construction (SurfacePatches), so that pressure
/// and tension do not press the fluid there. The points y of the face feel the force - k A d n,
/// where d n is their distance from the wall, A their share of the reference area, and k =
/// `stiffness` (force per volume).
template <int D>
class WallHold final : public ForceTerm {
 public:
  WallHold(const Body<D>& body, const WettedFace<D>& face, Real stiffness);

  std::string name() const override {
    return "hold of '" + body_.name + "' to the wall at '" + face_.face + "'";
  }
  std::string_view energy_kind() const override { return "wall"; }

  Report add_force(const Motion& motion, Forces force) override;
  void add_tangent(const Motion& motion, const Motion& change, Forces force) override;
  bool reads(StepReads& reads) override {
    reads.rows(chunk_sums_, body_.first);
    return true;
  }
  std::optional<Real> stored_energy(const Motion& motion) const override;
  Real steady_after() const override { return face_.steady_after(); }
  /// The sum of the forces on the body. All processes call this.
  Eigen::Vector3d force_on_body(const Motion& motion) const;
  std::size_t bytes() const override { return rows_.bytes() + chunk_sums_.bytes(); }
  Offset pairs() const override { return rows_.entries(); }

 private:
  template <class T>
  using Vector = std::array<T, D>;

  template <class T>
  Vector<T> place(Index q, const NodalVector* u, const NodalVector* du) const;
  template <class T>
  Vector<T> pull_on(Index q, const Vector<T>& y, const WettedWall<D>& wall) const;

  const Body<D>& body_;
  WettedFace<D> face_;
  Real stiffness_;
  WettedPoints<D> points_;
  PointRows<D> rows_;
  ChunkSums chunk_sums_;
  struct OfChunk {
    Resultant outside;
    Real power = 0;  // on the velocity of the wall
    friend OfChunk operator+(OfChunk a, const OfChunk& b) {
      a.outside += b.outside;
      a.power += b.power;
      return a;
    }
  };
  ChunkTally<OfChunk> of_chunks_;
};

}  // namespace meniscus
