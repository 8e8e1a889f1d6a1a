// SPDX-License-Identifier: BSD-3-Clause
// Formulas of a 3D scene, in the half plane through an axis.
#pragma once
#include "input/constants.hpp"
#include "numbers/types.hpp"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace meniscus {

/// An axis parallel to x (0), y (1) or z (2), and the half plane on the side of the next direction
/// across it.
struct TwinAxis {
  int along = 2;
  Eigen::Vector3d through = Eigen::Vector3d::Zero();  ///< a place on it

  int across() const { return along == 0 ? 1 : 0; }    ///< becomes x
  int normal() const { return 3 - along - across(); }  ///< has no coordinate in the half plane
  std::string name() const { return std::string(1, "xyz"[along]); }
  /// The distance from the axis, and the coordinate along it.
  Vec<2> in_half_plane(const Eigen::Vector3d& x) const;
  Eigen::Vector3d turned(const Eigen::Vector3d& x, Real angle) const;
};

/// The axis parallel to x (0), y (1) or z (2) through the middle of the places.
TwinAxis axis_through_middle(int along, const std::vector<Eigen::Vector3d>& places);

/// Rewrites formulas of x, y, z with the variables of the half plane, and tests whether they are of
/// revolution at some of the places.
class HalfPlaneFormulas {
 public:
  HalfPlaneFormulas(const TwinAxis& axis, const Constants& constants,
                    const std::vector<Eigen::Vector3d>& places);

  const TwinAxis& axis() const { return axis_; }
  /// The formula with x, y, z replaced, except for the names in `arguments`.
  std::string rewritten(const std::string& formula,
                        const std::vector<std::string>& arguments = {}) const;
  /// Where the value of a formula changes by a turn about the axis; empty if it does not.
  std::optional<std::string> uneven(const std::string& formula) const;
  /// Where a vector is not turned with its place, or points around the axis; empty if it is of
  /// revolution. The vector is that from the axis if it is a `place`.
  std::optional<std::string> uneven(const std::array<std::string, 3>& vector, bool place) const;

 private:
  Expression parsed(const std::string& formula) const;
  template <class F>
  std::optional<std::string> first_of(F&& f) const;

  TwinAxis axis_;
  const Constants& constants_;
  std::vector<Eigen::Vector3d> samples_;
};

}  // namespace meniscus
