// SPDX-License-Identifier: BSD-3-Clause
// Reproducing-kernel shape functions N_A with their exact first and second derivatives, at four
// evaluation points at once. The derivatives of the moment matrix are never formed (RKPM note 2.1,
// fixed-origin form).
#pragma once
#include "kernel/kernel_function.hpp"
#include "kernel/monomials.hpp"

#include <span>
#include <vector>

namespace meniscus {

/// The highest order of derivatives to be computed.
enum class Derivatives { none, first, second };

/// A particle that may reach an evaluation point.
template <int D>
struct Candidate {
  Index particle;
  Real support;
  Vec<D> X;
};

/// Shape functions that reproduce polynomials up to `Degree`, evaluated for batches of four points
/// that share a list of candidate particles. Candidates that do not reach a point get N = 0 there.
///
/// At each point x, p(s) are the monomials of s = (y - x)/H and P_A = p((x_A - x)/H), with one H
/// for the whole batch. The shape functions N_A and their derivatives follow from:
///
///   M = sum P_A P_A^T Phi_A,                     M c     = e_0;
///   M c,i  = p,i  - sum Phi_A,i P_A (P_A.c);
///   M c,ij = p,ij - sum P_A [Phi_A,ij (P_A.c) + Phi_A,i (P_A.c,j) + Phi_A,j (P_A.c,i)];
///   N_A    = (P_A.c) Phi_A, N_A,i and N_A,ij by the product rule at fixed P_A.
template <int D, int Degree = 2>
class ReproducingKernel {
 public:
  static constexpr int basis_size = monomial_count(D, Degree);
  using BasisVector = std::array<Lanes, static_cast<std::size_t>(basis_size)>;

  explicit ReproducingKernel(KernelFunction kernel_function) : kernel_function_(kernel_function) {}
  void use(KernelFunction kernel_function) { kernel_function_ = kernel_function; }

  /// Evaluates at four points (for fewer points, repeat one). Results are valid until the next
  /// call.
  void evaluate(const std::array<Vec<D>, 4>& points, std::span<const Candidate<D>> candidates,
                Derivatives order);

  /// True if candidate k reaches the point of this lane.
  bool reaches(std::size_t k, int lane) const { return kernel_[k].phi[lane] > 0; }
  /// N_A, N_A,i and N_A,ij (packed as in hessian_index) of candidate k, one lane per point.
  Lanes value(std::size_t k) const { return value_[k]; }
  Lanes gradient(std::size_t k, int i) const {
    return gradient_[k * D + static_cast<std::size_t>(i)];
  }
  Lanes hessian(std::size_t k, int ij) const {
    return hessian_[k * hessian_count(D) + static_cast<std::size_t>(ij)];
  }
  /// Smallest squared pivot of the Jacobi-scaled moment matrix, one lane per point: the deficiency
  /// monitor of RKPM note 2.4. Values >= 3e-2 are good; values < 1e-3 and NaN are unusable.
  Lanes quality() const { return quality_; }

  /// H of the last evaluation.
  Real scale() const { return scale_of_places_; }
  /// Evaluates, at the points of the last evaluation, the functions f_A = Phi_A P_A.(M^-1 b) for
  /// each b. They satisfy sum f_A p((x_A - x)/H) = b; b = e_0 gives f_A = N_A.
  void evaluate_functionals(std::span<const BasisVector> b);
  /// f_A of candidate k for b[j].
  Lanes functional(std::size_t k, std::size_t j) const {
    return functional_[k * solved_.size() + j];
  }

 private:
  /// With s = (x_A - x) / H: H Phi,i = -a s_i, H^2 Phi,ij = a delta_ij + b s_i s_j.
  struct Kernel {
    std::array<Lanes, D> s;
    Lanes phi, a, b;
  };

  template <class W>
  void evaluate_functions(const std::array<Vec<D>, 4>& points,
                          std::span<const Candidate<D>> candidates, Derivatives order, Real H);
  template <Derivatives order>
  void evaluate_order(const std::array<Vec<D>, 4>& points,
                      std::span<const Candidate<D>> candidates);
  void sum_moments();
  void factorise_moments();
  BasisVector solve(const BasisVector& right_hand_side) const;
  /// Right-hand sides of H c,i and of H^2 c,ij.
  std::array<BasisVector, D> first_right_hand_sides(const BasisVector& c) const;
  std::array<BasisVector, static_cast<std::size_t>(hessian_count(D))> second_right_hand_sides(
      const BasisVector& c, const std::array<BasisVector, D>& c_i) const;

  KernelFunction kernel_function_;
  std::vector<Kernel> kernel_;  // [candidate], padded to an even number
  std::vector<Lanes> value_, gradient_, hessian_, functional_;
  std::vector<BasisVector> solved_;  // M^-1 b
  Real scale_of_places_ = 0;
  std::array<Lanes, static_cast<std::size_t>(basis_size* basis_size)> factor_;
  BasisVector scale_, inverse_pivot_;
  Lanes quality_ = Lanes::zero();
};

extern template class ReproducingKernel<2, 1>;
extern template class ReproducingKernel<2, 2>;
extern template class ReproducingKernel<2, 3>;
extern template class ReproducingKernel<3, 1>;
extern template class ReproducingKernel<3, 2>;
extern template class ReproducingKernel<3, 3>;

}  // namespace meniscus
