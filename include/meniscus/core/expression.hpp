// SPDX-License-Identifier: BSD-3-Clause
// Formulas in scenes, such as "2e9*(1 + 0.1*x)". The only place that knows muParser.
#pragma once
#include <memory>
#include <string>
#include <string_view>

#include "meniscus/core/types.hpp"

namespace meniscus {

/// A real function of reference position x, y, z and time t (pi is known). Copies share the parsed
/// formula; evaluation is not meant for the time loop and not for several threads at once.
class Expression {
 public:
  /// A constant.
  Expression(Real value = 0);
  /// Throws InputError (without a place) naming the offending part of the formula.
  explicit Expression(std::string formula);

  Real operator()(const Eigen::Vector3d& X, Real t = 0) const;
  const std::string& text() const { return text_; }

 private:
  struct Parsed;
  std::string text_;
  std::shared_ptr<const Parsed> parsed_;
};

}  // namespace meniscus
