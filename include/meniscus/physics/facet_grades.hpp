// SPDX-License-Identifier: BSD-3-Clause
// How many contact points a facet needs at its distance from a rigid partner, or a pair of facets
// of two bodies at theirs.
#pragma once
#include "meniscus/physics/interaction.hpp"

#include <vector>

namespace meniscus {

/// Where an interaction falls by a power of the distance, fewer Gauss points per direction do far
/// away than close by. Grade 0 are the points asked for, each further grade has about half as many,
/// the last two. A facet of the edge h has the coarsest grade of n points whose error at its
/// distance a,
///   c_n (h/a)^(2n) p(a),   c_n = (n!)^4 (2n + k - 1)! / ((k - 1)! (2n + 1) ((2n)!)^3),
/// that of n points for a^-k over a length h, is below 1e-6 of the largest traction (CGCM note 7).
class FacetGrades {
 public:
  /// One grade for interactions without such a power. `edge` is that of the smallest facets.
  FacetGrades(int points, const Interaction& interaction, Real edge);
  /// For pairs of facets of two bodies, both summed by their points, each further grade with about
  /// two thirds of them. The least distance a is that of the coarsest points, two per direction;
  /// the centres of two facets in line are a + 0.58 h apart, and their error
  ///   2 c_n (h^2/((a + 0.58 h) (a - 0.42 h)))^n p(a)
  /// has the k of the force between two facets, two more than that of the pressure. It may be 1e-5
  /// of the largest traction. Where a law is switched off two points see too little of that: they
  /// only tell the distance (CGCM note 7).
  static FacetGrades of_pairs(int points, const Interaction& interaction, Real edge);

  /// Points per direction, by grade.
  const std::vector<int>& points() const { return points_; }
  int count() const { return static_cast<int>(points_.size()); }
  /// Of a facet of this edge whose coarsest points are at this distance, or of a pair of which the
  /// larger has this edge.
  int grade(Real distance, Real edge) const {
    int grade = count() - 1;
    while (grade > 0 && distance < edges_away_[static_cast<std::size_t>(grade)] * edge) --grade;
    return grade;
  }

 private:
  explicit FacetGrades(int points) : points_{points}, edges_away_{0} {}
  /// Further ones, with `part` of the points per direction of the one before, and
  /// `distance_for(points)` in edges.
  template <class F>
  void add_grades(Real part, F&& distance_for);

  std::vector<int> points_;
  std::vector<Real> edges_away_;  // [grade] distance / edge from which on it is enough
};

}  // namespace meniscus
