// SPDX-License-Identifier: BSD-3-Clause
// Adhesion that varies with time, and over a rigid partner or ground.
#pragma once
#include "meniscus/core/expression.hpp"

#include <array>
#include <optional>

namespace meniscus {

/// The formulas from which an adhesion follows, in units of the scene.
struct AdhesionFormulas {
  std::optional<Expression> angle;     ///< contact angle in degrees, or
  std::optional<Expression> adhesion;  ///< energy per area that contact releases
  std::optional<Expression> actin;     ///< is added to either

  /// Whether none of them has a variable.
  bool constant() const;
};

/// W(x, t) = adhesion, or gamma (1 + cos angle), + actin: of the place x on the partner, in the
/// frame in which it was made, or in the reference of ground. What is moved or deformed takes its
/// pattern along. Formulas are to be smooth over a hundredth of the range: the gradient is a
/// difference over it.
class AdhesionPattern {
 public:
  /// gamma: of the liquid, where an angle is given. range: of the interaction.
  AdhesionPattern(AdhesionFormulas formulas, Real gamma, Real range);

  /// Throws SolveError with key, formula, value, place and time if a formula is not finite or
  /// leaves what is allowed: angles from 1 to 179, adhesion >= 0.
  Real operator()(const Eigen::Vector3d& x, Real time) const;
  /// Central differences of fourth order.
  Eigen::Vector3d gradient(const Eigen::Vector3d& x, Real time) const;
  bool depends_on_time() const { return depends_on_time_; }
  bool depends_on_place() const { return depends_on_[0] || depends_on_[1] || depends_on_[2]; }

 private:
  AdhesionFormulas formulas_;
  Real gamma_, step_;
  std::array<bool, 3> depends_on_{};  // x, y, z
  bool depends_on_time_ = false;
};

}  // namespace meniscus
