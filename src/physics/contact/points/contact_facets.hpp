// SPDX-License-Identifier: BSD-3-Clause
// Contact facets: the surface of a body as flat simplices, and its nearest point to a given point.
#pragma once
#include "body/body.hpp"
#include "meniscus/physics/force_term.hpp"
#include "parallel/shared_work.hpp"

#include <array>
#include <span>

namespace meniscus {

/// Triangles (2D: segments) through the positions of the boundary nodes.
template <int D>
class ContactFacets {
 public:
  /// Throws SolveError if shape functions cannot be built.
  explicit ContactFacets(const Body<D>& body);

  /// The facets at a motion.
  struct Places {
    std::vector<Vec<D>> corner;    ///< positions of the boundary nodes
    AlignedVector<Lanes> samples;  ///< [facet][i]: corners and middle, for a ContactList
    std::vector<Real> radius;      ///< [facet] largest distance of a corner from the middle
  };
  Places at_rest() const;
  /// Moves all facets with the body. Does not allocate.
  void move(const Motion& motion, Places& places) const;
  /// Like move(), but each process moves the corners whose rows it has. The result is to be
  /// gathered before take_placed().
  Gathered place(const SharedWork& work, const Motion& motion, Places& places) const;
  void take_placed(Places& places) const { sample(places); }

  /// The nearest point of the surface: sum_k share_k x_k over the corners of a facet. If the
  /// corners move by dx_k, the distance changes by -normal . sum_k share_k dx_k.
  struct Foot {
    Index facet = -1;  ///< -1 if there is none
    Real distance = unbounded;
    Vec<D> normal;  ///< unit vector from the foot to the given point
    std::array<Real, D> share;
  };
  /// The nearest point to x among these facets; the first facet of equally near ones.
  Foot foot(const Places& places, const Vec<D>& x, std::span<const Index> facets) const;

  /// The point of the surface below x, against `up`, on one of these facets that faces up.
  /// `distance` is the gap along `up`, negative if x is below the surface. `normal` is the gradient
  /// n / (n.up) of the gap with the normal n of the facet. Of several facets the one with the
  /// smallest |gap| is taken.
  Foot below(const Places& places, const Vec<D>& x, const Vec<D>& up,
             std::span<const Index> facets) const;
  /// The position of a foot in the reference.
  Vec<D> reference_place(const Foot& foot) const;
  /// The current gradient of a function with the given `gradient` in the reference. The function
  /// moves with the facet of the foot and is constant along `up`. If x moves by dx and the corners
  /// by dx_k, the function below x changes by this . (dx - sum_k share_k dx_k).
  Vec<D> carried(const Places& places, const Foot& foot, const Vec<D>& gradient,
                 const Vec<D>& up) const;
  /// Facets whose reference normal is less than 60 degrees from `up`.
  std::vector<Index> facing(const Vec<D>& up) const;
  /// The first of these facets that does not face up any more, or -1.
  Index turned_over(const Places& places, const Vec<D>& up, std::span<const Index> facets) const;

  const std::array<Index, D>& corners_of(Index facet) const { return at(simplices_, facet); }
  /// force_A += sum over the corners of N_A pull[corner].
  void add_force(const std::vector<Vec<D>>& pull, const Forces& force);

  /// Registers the reads of a force: the motion of all facets, or, unless `reads_all`, only of
  /// those whose rows this process has.
  void list_reads(StepReads& reads, bool reads_all) const {
    if (reads_all) reads.particles(rows_.particle, body_.first);
    reads.rows(chunk_sums_, body_.first);
  }

  /// The longest edge in the reference.
  Real longest_edge() const;
  const Body<D>& body() const { return body_; }
  std::size_t bytes() const;
  Offset pairs() const { return rows_.entries(); }
  /// The particle nearest to a facet, numbered over all bodies.
  Index particle_at(Index facet) const { return body_.first + at(particle_, corners_of(facet)[0]); }

 private:
  std::array<Vec<D>, D> corners(const std::vector<Vec<D>>& x, Index facet) const;
  void sample(Places& places) const;
  void move(const ItemRange& corners, const Motion& motion, Places& places) const;

  const Body<D>& body_;
  std::vector<std::array<Index, D>> simplices_;  // corners
  std::vector<Vec<D>> X_;                        // [corner]
  std::vector<Index> particle_;                  // [corner]
  PointRows<D> rows_;
  ChunkSums chunk_sums_;
};

}  // namespace meniscus
