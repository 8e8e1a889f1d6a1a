// SPDX-License-Identifier: BSD-3-Clause
// The preconditioner of a system whose places are held in part.
#pragma once
#include "solve/linear/element_preconditioner.hpp"

#include <Eigen/Cholesky>

namespace meniscus {

/// (quasi-statics note 4) With C u = g(t) what the constraints of the system prescribe,
///   z = P^-1 r - Y (C Y)^-1 C P^-1 r,   Y = P^-1 C^t,
/// the inverse of P among the displacements that they leave free: C z = 0, and forces C^t lambda
/// count for nothing. Without constraints P^-1.
template <int D>
class HeldPreconditioner {
 public:
  /// Throws as ElementPreconditioner.
  explicit HeldPreconditioner(System<D>& system, const ImplicitEuler<D>* step = nullptr);

  /// For another step.
  void renew(System<D>& system, const ImplicitEuler<D>* step);

  /// z of r; returns r . z.
  Real apply(const NodalVectors& r, NodalVectors& z) const;
  /// Moves u to where it is prescribed at a time, as little as possible in the norm of P.
  void meet(Real time, NodalVectors& u) const;
  const ElementPreconditioner<D>& elements() const { return elements_; }

 private:
  void find_responses();
  /// u += Y (C Y)^-1 b
  void add_response(std::vector<Real>& b, NodalVectors& u) const;

  ElementPreconditioner<D> elements_;
  const Constraints* constraints_;  // null: there are none
  Index particles_;
  NodalVectors Y_;  // [particle][row]
  Eigen::LDLT<Eigen::MatrixXd> factors_;
};

}  // namespace meniscus
