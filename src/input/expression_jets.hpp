// SPDX-License-Identifier: BSD-3-Clause
// The derivatives of a formula with respect to the position.
#pragma once
#include "input/expression.hpp"
#include "numbers/jet.hpp"

namespace meniscus {

/// Parses a valid formula again, with jets in place of numbers. One thread at a time.
class ExpressionJets {
 public:
  ExpressionJets(const std::string& formula, const NamedNumbers& constants);
  ~ExpressionJets();
  ExpressionJets(const ExpressionJets&) = delete;

  Jet<3> operator()(const Eigen::Vector3d& X, Real t);

 private:
  struct Parsed;
  std::unique_ptr<Parsed> parsed_;
};

}  // namespace meniscus
