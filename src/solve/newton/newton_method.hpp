// SPDX-License-Identifier: BSD-3-Clause
// Newton's method: finds the state of least energy at a given time.
#pragma once
#include "solve/free_motions.hpp"
#include "solve/linear/held_preconditioner.hpp"
#include "solve/newton/tangent_factors.hpp"

#include <functional>
#include <optional>
#include <string>

namespace meniscus {

/// Steps without a solution are divided into pieces, at most to this fraction of the step.
inline constexpr Real least_piece = 1.0 / 256;

/// Finds states where the sum of the potentials of all terms, and of the potential of a step of
/// implicit Euler if there is one, is least, from a nearby state.
///
/// Small bodies, if the tangents of all forces are assembled: iterations with factors of the
/// tangent and expected pressures (quasi-statics note 10), which end by the forces left. They look
/// at the energy only where the tangent has negative eigenvalues. Every equilibrium is tested for
/// these, and left if it has any.
///
/// All others: downhill (quasi-statics note 2). Each iteration solves its linear equations by
/// conjugate gradients with actions of the tangent (ForceTerm::add_tangent), only as exactly as is
/// useful. Linear elements are the preconditioner. The iterations end by the energy that the next
/// one would release. A state at which the tangent has negative curvature is unstable; it is left
/// in the direction of this curvature.
template <int D>
class NewtonMethod {
 public:
  /// `step`: the step of implicit Euler, or null. `tolerance`: energy left to release, relative to
  /// the largest energy that an iteration has released.
  NewtonMethod(System<D>& system, ImplicitEuler<D>* step, Real tolerance);

  /// Makes the preconditioner, for the reference of the system or for another step of implicit
  /// Euler. Throws like ElementPreconditioner.
  void prepare();

  struct Start {
    Real time;
    const NodalVectors& u;         ///< the previous state
    const NodalVectors* expected;  ///< a better guess, used if its forces can be computed; or null
    Real idle = 0;                 ///< energy that may be left
    Real before = time;            ///< time of the previous state
  };
  struct Solution {
    NodalVectors u;
    int iterations = 0;
    bool bent = false;    ///< negative curvature was found
    int saddles = 0;      ///< number of unstable equilibria that were found and left
    bool stuck = false;   ///< a force is left, but no step lowers the energy
    bool mixed = false;   ///< found with factors of the tangent
    bool flat = false;    ///< forces are left along a valley in which the energy hardly changes
    std::string failure;  ///< why there is no solution; empty if there is one
    /// True if the solution may be far from the previous state.
    bool winding() const;
    bool hard() const { return winding() || stuck; }
  };
  /// Throws Interrupted if stop_when() asks to stop.
  Solution solve(const Start& start);
  void stop_when(const std::function<bool()>& asked) { asked_to_stop_ = asked; }

  /// With factors of the tangent: the squared lowest frequency over its value in the reference of
  /// the bodies without loads and contacts. Else the smallest eigenvalue of the tangent relative to
  /// the preconditioner. Negative if the state is unstable. At an equilibrium, all modes are
  /// searched. After a step of implicit Euler, it is the smallest value that the last iteration has
  /// found.
  Real stability() const { return stability_; }
  /// Sets stability() for an equilibrium `u` found by another method, and returns it. Throws like
  /// prepare().
  Real find_stability(Real time, const NodalVectors& u);
  /// The change of the equilibrium `u` by small forces: K^-1 f with the tangent K. Throws
  /// SolveError if the equilibrium is not stable.
  NodalVectors response(Real time, const NodalVectors& u, const NodalVectors& force);
  /// Energy left by the last solution, relative to the largest energy released; with factors of the
  /// tangent, forces left relative to loads and reactions.
  Real left() const { return left_; }
  Real spacing() const { return spacing_; }
  std::int64_t iterations() const { return iterations_; }
  std::int64_t tangents() const { return tangents_; }
  /// Number of iterations in the present call of solve(), and the share of forces or energy left.
  std::string doing() const;
  /// The effort as a text for the end of the log.
  std::string effort() const;

  void archive(const Archive& a);

 private:
  /// A state during the iteration. Its forces are in r_.
  struct Point {
    NodalVectors u;
    Real potential = 0;
  };
  /// Result of conjugate gradients; the direction itself is in s_.
  struct Direction {
    Real decrement = 0;  ///< energy that a full step would release
    bool bent = false;   ///< negative curvature was found along p_
  };
  using OfGroups = typename TangentFactors<D>::OfGroups;
  /// Pressures and their derivatives. [force][group]
  using Pressures = std::vector<std::vector<Dual<Lanes>>>;
  static constexpr const char* too_far = "the next equilibrium is too far";

  Real least_loads();
  Real size_of_loads(Real time, const NodalVectors& u);
  Real energy_of_bodies(Real time, const NodalVectors& u);
  Pressures pressures(Real time, const NodalVectors& u, const NodalVectors& change);
  void renew_factors(Real time, const NodalVectors& u, const OfGroups& expected, Real shift);
  void factor_at(Real time, const NodalVectors& u);
  bool solve_tangent(Real time, const NodalVectors& u, const NodalVectors& r, Real share);
  Real gradients(const NodalVectors& w);
  OfGroups pressures_after(const Pressures& along, Real a, const OfGroups& expected);
  bool step_mixed(Real time, Point& point, OfGroups& expected);
  bool step_downhill(Real time, Point& point, Real& shift);
  void polish(Real time, Solution& solution, Point& point);
  void approach(Real time, Solution& solution, Point& point, OfGroups expected);
  bool begin_mixed(const Start& start, Point& point, OfGroups& expected);
  void iterate_mixed(const Start& start, Solution& solution, Point& point);
  Real lowest_frequency();
  void find_lowest_of_reference();
  const HeldPreconditioner<D>& elements();

  std::string forces_left(Real time, const NodalVectors& u);
  std::string pulled(Real time, const NodalVectors& u);
  bool begin_at(const Start& start, Point& point);
  /// Sets force and point.potential for point.u. Returns false if forces cannot be computed.
  bool evaluate(Real time, Point& point, NodalVectors& force);
  Direction direction(Real time, const NodalVectors& u, Real share);
  /// Coefficients of Lanczos' method: a tridiagonal matrix.
  struct Lanczos {
    std::vector<Real> diagonal, beside;
    Real least() const;  ///< smallest eigenvalue
  };
  /// Judges the residual; gets the first one too, both squared in the norm of the preconditioner.
  using Done = std::function<bool(Real first, Real left)>;
  /// Sets z = P^-1 r.
  using Precondition = std::function<void(const NodalVectors& r, NodalVectors& z)>;
  Precondition by_elements() {
    return [this](const NodalVectors& r, NodalVectors& z) { elements().apply(r, z); };
  }
  bool conjugate_gradients(Real time, const NodalVectors& u, Lanczos& seen,
                           const Precondition& respond, const Done& done);
  /// Sets stability_. If it returns false, p_ is a direction of negative curvature.
  bool is_stable_at(Real time, const NodalVectors& u);
  bool stays(Real time, Point& point, Solution& solution);
  /// q_ = A p_. Returns p_.q_.
  Real apply(Real time, const NodalVectors& u);
  /// Line search: u += a s_ with a = 1, 1/2, ... until the potential decreases by a given fraction
  /// of the expected decrease. Returns false if it never does.
  bool search(Real time, Point& point, Real decrement);
  Real shorten_direction();
  void iterate(const Start& start, Solution& solution, Point& point);
  /// Sets s_ along p_, in the downhill direction.
  void leave_saddle();

  System<D>& system_;
  ImplicitEuler<D>* step_;
  Real tolerance_, spacing_;
  bool small_;  // TangentFactors::suit()
  std::optional<HeldPreconditioner<D>> preconditioner_;
  std::optional<TangentFactors<D>> factors_;
  Index negative_ = 0;  // eigenvalues of the last tangent
  /// The state whose tangent is factored; without u if it is the tangent of no state.
  struct {
    Real time = 0;
    FreeMotions<D> free;
    NodalVectors u;
  } factored_;
  Real lowest_ = 0;  // lowest_frequency() of the reference; 0: unknown
  OfGroups off_;     // pressures of the tangent less those of the state; empty: zero
  FreeMotions<D> free_;
  NodalVectors still_, r_, trial_r_, s_, g_, z_, p_, q_, scaled_;
  std::vector<Real> lambda_;  // [row of the constraints]
  Real energy_scale_ = 0;     // largest energy that an iteration has released
  Real least_loads_ = 0;      // 0: unknown
  Real left_ = 1;             // last decrement / energy_scale_
  Real stability_ = 0;
  std::int64_t iterations_ = 0, tangents_ = 0;
  std::int64_t iterations_before_ = 0, tangents_before_ = 0;  // before the last solve()
  std::function<bool()> asked_to_stop_ = [] { return false; };
  std::string broken_;  // why forces could not be computed at the last attempt
};

}  // namespace meniscus
