// SPDX-License-Identifier: BSD-3-Clause
// Contact facets: the surface of a body as flat simplices, and the point of it nearest to a place.
#pragma once
#include "meniscus/body/body.hpp"
#include "meniscus/physics/force_term.hpp"

#include <array>
#include <span>

namespace meniscus {

/// Triangles (2D: segments) through the places of the boundary nodes.
template <int D>
class ContactFacets {
 public:
  /// Throws SolveError if shape functions cannot be built.
  explicit ContactFacets(const Body<D>& body);

  /// Where the facets are at a motion.
  struct Places {
    std::vector<Vec<D>> corner;    ///< places of the boundary nodes
    AlignedVector<Lanes> samples;  ///< [facet][i]: its corners and its middle, for a ContactList
    std::vector<Real> radius;      ///< [facet] of its corners about its middle
  };
  Places at_rest() const;
  /// Moves all facets along with the body, divided so. Takes no memory.
  void move(const Motion& motion, Places& places, const Division& division) const;

  /// The nearest point of the surface: sum_k share_k x_k over the corners of a facet. Moving the
  /// corners by dx_k changes the distance by -normal . sum_k share_k dx_k.
  struct Foot {
    Index facet = -1;  ///< -1: there is none
    Real distance = unbounded;
    Vec<D> normal;  ///< unit vector from there to the place
    std::array<Real, D> share;
  };
  /// Among these facets; of equally near ones the first.
  Foot foot(const Places& places, const Vec<D>& x, std::span<const Index> facets) const;

  /// The point of the surface straight below x, against `up`, on one of these facets if it faces
  /// up: `distance` is the gap along `up`, negative where x is below the surface, and `normal` its
  /// gradient, the normal of the facet n / (n.up). Of several the one with the least |gap|.
  Foot below(const Places& places, const Vec<D>& x, const Vec<D>& up,
             std::span<const Index> facets) const;
  /// Where a foot is in the reference.
  Vec<D> reference_place(const Foot& foot) const;
  /// The gradient in space of a function that has `gradient` in the reference, is carried along by
  /// the facet of the foot and is the same all the way along `up`: with a foot that is below x it
  /// changes by this . (dx - sum_k share_k dx_k) as the place x and the corners x_k move.
  Vec<D> carried(const Places& places, const Foot& foot, const Vec<D>& gradient,
                 const Vec<D>& up) const;
  /// Facets of the reference that face up, by less than 60 degrees from it.
  std::vector<Index> facing(const Vec<D>& up) const;
  /// The first of these facets that does not face up at all; -1: all do.
  Index turned_over(const Places& places, const Vec<D>& up, std::span<const Index> facets) const;

  const std::array<Index, D>& corners_of(Index facet) const { return at(simplices_, facet); }
  /// force_A += sum over the corners of N_A `pull`, which is [corner].
  void add_force(const std::vector<Vec<D>>& pull, std::span<NodalVector> force);

  /// This rank reads the motion of all facets, or, but for its own rows, of none.
  void tell_reads(StepReads& reads, bool reads_all) {
    if (reads_all) reads.particles(rows_.particle, body_.first);
    reads.rows(windows_, body_.first);
  }

  /// Longest edge in the reference.
  Real longest_edge() const;
  const Body<D>& body() const { return body_; }
  std::size_t bytes() const;
  Offset pairs() const { return rows_.entries(); }
  /// The particle nearest to a facet, counted over all bodies.
  Index particle_at(Index facet) const { return body_.first + at(particle_, corners_of(facet)[0]); }

 private:
  std::array<Vec<D>, D> corners(const std::vector<Vec<D>>& x, Index facet) const;
  void sample(Places& places) const;

  const Body<D>& body_;
  std::vector<std::array<Index, D>> simplices_;  // corners
  std::vector<Vec<D>> X_;                        // [corner]
  std::vector<Index> particle_;                  // [corner]
  PointRows<D> rows_;
  ForceWindows windows_;
};

}  // namespace meniscus
