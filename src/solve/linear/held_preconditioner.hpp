// SPDX-License-Identifier: BSD-3-Clause
// The preconditioner of a system with prescribed displacements.
#pragma once
#include "solve/linear/element_preconditioner.hpp"

#include <Eigen/Cholesky>

namespace meniscus {

/// The inverse of P on the displacements that the constraints C u = g(t) leave free (quasi-statics
/// note 4):
///   z = P^-1 r - Y (C Y)^-1 C P^-1 r,   Y = P^-1 C^t.
/// Hence C z = 0, and forces C^t lambda have no effect. Without constraints it is P^-1.
template <int D>
class HeldPreconditioner {
 public:
  /// Throws like ElementPreconditioner.
  explicit HeldPreconditioner(System<D>& system, const ImplicitEuler<D>* step = nullptr);

  /// Computes the preconditioner again for another step.
  void renew(System<D>& system, const ImplicitEuler<D>* step);

  /// Sets z for the residual r; returns r . z.
  Real apply(const NodalVectors& r, NodalVectors& z) const;
  /// Moves u to its prescribed values at a time, with the smallest change in the norm of P.
  void meet(Real time, NodalVectors& u) const;
  const ElementPreconditioner<D>& elements() const { return elements_; }

 private:
  void find_responses();
  /// u += Y (C Y)^-1 b
  void add_response(std::vector<Real>& b, NodalVectors& u) const;

  ElementPreconditioner<D> elements_;
  const Constraints* constraints_;  // null without constraints
  Index particles_;
  NodalVectors Y_;  // [particle][row]
  Eigen::LDLT<Eigen::MatrixXd> factors_;
};

}  // namespace meniscus
