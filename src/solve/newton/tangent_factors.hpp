// SPDX-License-Identifier: BSD-3-Clause
// Factors of the tangent of elastic bodies at a state.
#pragma once
#include "physics/assembled_force.hpp"
#include "solve/free_motions.hpp"
#include "solve/linear/sparse_factors.hpp"
#include "solve/system.hpp"

#include <memory>
#include <vector>

namespace meniscus {

/// Solves K z = r with the tangent K of the forces at a state, on the displacements that the
/// constraints C u = g(t) leave free. Held places are stiff springs gamma C^T C in K, and z and r
/// are projected: C z = 0 to round-off, and forces C^T lambda have no effect. Forces without an
/// assembled tangent are left out. Pressures can be further unknowns.
template <int D>
class TangentFactors {
 public:
  /// For each force, numbers of its groups of pressures.
  using OfGroups = std::vector<std::vector<Lanes>>;

  /// The rank that must have all rows. It assembles, factorises and solves for all.
  static constexpr int rank = 0;
  /// True for so many particles that factors are faster than iterations.
  static bool fits(Offset particles) { return particles <= (D == 2 ? 20000 : 1500); }
  /// True if all internal forces have an assembled tangent, and the bodies are small.
  static bool suit(const System<D>& system);
  /// True for the internal force of a body.
  static bool is_internal(const ForceTerm& term) { return term.energy_kind() == "strain"; }
  /// True if forces have a tangent at a motion that is missing in K.
  static bool others_resist(System<D>& system, const Motion& motion);

  /// Finds the pattern. Requires suit().
  explicit TangentFactors(System<D>& system);

  /// Assembles the tangent at a state, with the pressures of the state plus `off` (empty: zero).
  /// The free motions of the state get a stiffness.
  void assemble(Real time, const NodalVectors& u, const OfGroups& off, const FreeMotions<D>& free);
  /// Assembles the tangent of the internal forces alone, in the reference.
  void assemble_reference(const FreeMotions<D>& free);
  /// Factorises the assembled tangent, with `shift` times the volume of each particle added to its
  /// diagonal. Returns the number of its negative eigenvalues.
  Index factor(Real shift);

  /// z = K^-1 r.
  void apply(const NodalVectors& r, NodalVectors& z);
  /// Moves u to its prescribed values at a time, with the smallest change in the norm of K.
  void meet(Real time, NodalVectors& u);

  /// A shift that is small beside the stiffness of strains of the size of a body. In the reference,
  /// loads that will hold a body exert no forces yet, so that rotations have no stiffness.
  Real small_shift() const { return small_shift_; }
  /// A shift just above round-off, for counts of negative eigenvalues.
  Real least_shift() const { return 1e-3 * small_shift_; }
  std::span<AssembledForce* const> forces() const { return forces_; }
  std::size_t bytes() const { return factors_->bytes(); }

 private:
  static bool is_here() { return ranks().rank() == rank; }
  void end(const FreeMotions<D>& free);
  void add_held_places();
  void solve(const NodalVectors& r, NodalVectors& z);

  System<D>& system_;
  std::vector<AssembledForce*> forces_, internal_;
  StiffnessMatrix K_;
  std::vector<Real> volume_;  // [particle]
  Index held_element_ = -1, first_free_ = -1;
  Real small_shift_ = 0, scale_ = 0;
  std::unique_ptr<SparseCholesky> factors_;
  NodalVectors balanced_;
  std::vector<Real> b_, lambda_;
};

}  // namespace meniscus
