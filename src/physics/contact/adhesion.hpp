// SPDX-License-Identifier: BSD-3-Clause
// Adhesion that varies with time, and over a rigid partner or the ground.
#pragma once
#include "input/expression.hpp"

#include <array>
#include <optional>

namespace meniscus {

/// The formulas that give an adhesion, in units of the scene.
struct AdhesionFormulas {
  std::optional<Expression> angle;     ///< contact angle in degrees
  std::optional<Expression> adhesion;  ///< energy per area that contact releases
  std::optional<Expression>
      actin;  ///< added to the adhesion, or to the adhesion that follows from the angle

  /// True if no formula has a variable.
  bool constant() const;
};

/// The adhesion W(x, t) = adhesion + actin, or gamma (1 + cos angle) + actin. x is a place on the
/// partner in the frame in which it was made, or a place in the reference of the ground: the
/// pattern moves and deforms with them. Formulas should be smooth over a hundredth of the range,
/// since the gradient is a difference over this length.
class AdhesionPattern {
 public:
  /// `gamma`: surface tension of the liquid, used with an angle. `range`: range of the interaction.
  AdhesionPattern(AdhesionFormulas formulas, Real gamma, Real range);

  /// Throws SolveError with key, formula, value, place and time if a formula is not finite or out
  /// of range. Angles must be from 1 to 179, the adhesion must be >= 0.
  Real operator()(const Eigen::Vector3d& x, Real time) const;
  /// The gradient of W, by central differences of fourth order.
  Eigen::Vector3d gradient(const Eigen::Vector3d& x, Real time) const;
  bool depends_on_time() const { return depends_on_time_; }
  /// The time after which W is constant.
  Real steady_after() const { return steady_after_; }
  bool depends_on_place() const { return depends_on_[0] || depends_on_[1] || depends_on_[2]; }

 private:
  AdhesionFormulas formulas_;
  Real gamma_, step_;
  std::array<bool, 3> depends_on_{};  // x, y, z
  bool depends_on_time_ = false;
  Real steady_after_ = 0;
};

}  // namespace meniscus
