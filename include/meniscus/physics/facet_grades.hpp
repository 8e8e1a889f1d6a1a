// SPDX-License-Identifier: BSD-3-Clause
// How many contact points a facet needs at its distance from a rigid partner.
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

  /// Points per direction, by grade.
  const std::vector<int>& points() const { return points_; }
  int count() const { return static_cast<int>(points_.size()); }
  /// Of a facet of this edge whose coarsest points are at this distance.
  int grade(Real distance, Real edge) const {
    int grade = count() - 1;
    while (grade > 0 && distance < edges_away_[static_cast<std::size_t>(grade)] * edge) --grade;
    return grade;
  }

 private:
  std::vector<int> points_;
  std::vector<Real> edges_away_;  // [grade] distance / edge from which on it is enough
};

}  // namespace meniscus
