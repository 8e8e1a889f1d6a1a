// SPDX-License-Identifier: BSD-3-Clause
// Number of contact points of a facet as a function of its distance from a rigid partner, or of a
// pair of facets of two bodies as a function of their distance.
#pragma once
#include "physics/contact/gap/interaction.hpp"

#include <vector>

namespace meniscus {

/// Far away fewer Gauss points per direction suffice, if the interaction falls by a power of the
/// distance. Grade 0 has all points, each further grade about half as many, the last grade two. A
/// facet with edge h at distance a gets the coarsest grade whose error with n points,
///
///   c_n (h/a)^(2n) p(a),   c_n = (n!)^4 (2n + k - 1)! / ((k - 1)! (2n + 1) ((2n)!)^3),
///
/// is below 1e-6 of the largest traction (CGCM note 7). It is the error of n points for a^-k over a
/// length h.
class FacetGrades {
 public:
  /// Makes one grade if the interaction does not fall by a power. `edge`: edge of the smallest
  /// facets.
  FacetGrades(int points, const Interaction& interaction, Real edge);
  /// Grades for pairs of facets of two bodies, both summed by their points. Each further grade has
  /// about two thirds of the points per direction. The distance a is the smallest distance of the
  /// coarsest points, two per direction. The centres of two facets in line are a + 0.58 h apart.
  /// The error is
  ///
  ///   2 c_n (h^2/((a + 0.58 h) (a - 0.42 h)))^n p(a)
  ///
  /// with k of the force between two facets, which is two more than for the pressure. It may be
  /// 1e-5 of the largest traction. Two points resolve the switch of a law badly; they only give the
  /// distance (CGCM note 7).
  static FacetGrades of_pairs(int points, const Interaction& interaction, Real edge);

  /// Points per direction, [grade].
  const std::vector<int>& points() const { return points_; }
  int count() const { return static_cast<int>(points_.size()); }
  /// The grade of a facet with this edge, whose coarsest points are at this distance. For a pair,
  /// `edge` is the larger edge.
  int grade(Real distance, Real edge) const {
    int grade = count() - 1;
    while (grade > 0 && distance < edges_away_[static_cast<std::size_t>(grade)] * edge) --grade;
    return grade;
  }

 private:
  explicit FacetGrades(int points) : points_{points}, edges_away_{0} {}
  /// Adds grades with `part` of the points per direction of the grade before; distance_for(points)
  /// is the smallest distance of a grade in edges.
  template <class F>
  void add_grades(Real part, F&& distance_for);

  std::vector<int> points_;
  std::vector<Real> edges_away_;  // [grade] smallest distance / edge at which it is accurate
};

}  // namespace meniscus
