// SPDX-License-Identifier: BSD-3-Clause
// Newton's method: the state of least energy at one time.
#pragma once
#include "solve/free_motions.hpp"
#include "solve/linear/held_preconditioner.hpp"

#include <functional>
#include <optional>
#include <string>

namespace meniscus {

/// Steps for which no solution is found are cut into pieces down to this part of them.
inline constexpr Real least_piece = 1.0 / 256;

/// (quasi-statics note 2) The minimum of the potential of all terms, and of what resists a step of
/// implicit Euler if there is one, downhill from a state nearby: Newton's method, whose linear
/// equations conjugate gradients solve by actions of the tangent (ForceTerm::add_tangent) as
/// exactly as is worth it, with linear elements as preconditioner. What is left when Newton's
/// method stops is known as the energy that the next step would release. Where the tangent has a
/// direction of negative curvature the state is not stable, and is left along it.
template <int D>
class NewtonMethod {
 public:
  /// `step`: of implicit Euler, null where there is none. `tolerance`: of the energy that is left,
  /// relative to the largest that an iteration has released.
  NewtonMethod(System<D>& system, ImplicitEuler<D>* step, Real tolerance);

  /// For the reference of the system, or for another step of implicit Euler. Throws as
  /// ElementPreconditioner.
  void prepare();

  struct Start {
    Real time;
    const NodalVectors& u;         ///< the state before
    const NodalVectors* expected;  ///< nearer to the solution if forces can be computed; or null
    Real idle = 0;                 ///< energy that does not count
  };
  struct Solution {
    NodalVectors u;
    int iterations = 0;
    bool bent = false;    ///< negative curvature was seen on the way
    int saddles = 0;      ///< equilibria on the way that were not stable, and were left
    bool stuck = false;   ///< nothing lowers the energy, although a force is left
    std::string failure;  ///< why there is none; empty: there is
    /// Such that it may be far from the state before.
    bool winding() const;
    bool hard() const { return winding() || stuck; }
  };
  /// Throws Interrupted when it is asked to stop.
  Solution solve(const Start& start);
  void stop_when(const std::function<bool()>& asked) { asked_to_stop_ = asked; }

  /// Least eigenvalue of the tangent, relative to the preconditioner: negative at a state that is
  /// not stable. At an equilibrium it is looked for among all modes; after a step of implicit Euler
  /// it is the least one that the last iteration has seen.
  Real stability() const { return stability_; }
  /// Sets stability() at an equilibrium `u` that something else has found, and returns it. Throws
  /// as prepare().
  Real find_stability(Real time, const NodalVectors& u);
  /// Energy that the last solution has left, relative to the largest released.
  Real left() const { return left_; }
  Real spacing() const { return spacing_; }
  std::int64_t iterations() const { return iterations_; }
  std::int64_t tangents() const { return tangents_; }
  /// In words, for the end of the log.
  std::string effort() const;

  void archive(const Archive& a);

 private:
  /// A state on the way, with its forces in r_.
  struct Point {
    NodalVectors u;
    Real potential = 0;
  };
  /// What conjugate gradients found, in s_.
  struct Direction {
    Real decrement = 0;  ///< energy that the step would release
    bool bent = false;   ///< negative curvature was seen along p_
  };
  std::string pulled(Real time, const NodalVectors& u);
  bool begin_at(const Start& start, Point& point);
  /// Fills force and point.potential for point.u; false where forces cannot be computed.
  bool evaluate(Real time, Point& point, NodalVectors& force);
  Direction direction(Real time, const NodalVectors& u, Real share);
  /// Numbers of Lanczos' method.
  struct Lanczos {
    std::vector<Real> diagonal, beside;
    Real least() const;  ///< eigenvalue
  };
  template <class Done>
  bool conjugate_gradients(Real time, const NodalVectors& u, Lanczos& seen, const Done& done);
  /// Sets stability_. Where it returns false p_ is a direction of negative curvature.
  bool is_stable_at(Real time, const NodalVectors& u);
  bool stays(Real time, Point& point, Solution& solution);
  /// q_ = A p_; returns p_.q_.
  Real apply(Real time, const NodalVectors& u);
  /// u += a s_ with a = 1, 1/2, .. until the potential is lower by a share of what is expected;
  /// false if it never is.
  bool search(Real time, Point& point, Real decrement);
  void iterate(const Start& start, Solution& solution, Point& point);
  /// s_ along p_, downhill.
  void leave_saddle();

  System<D>& system_;
  ImplicitEuler<D>* step_;
  Real tolerance_, spacing_;
  std::optional<HeldPreconditioner<D>> preconditioner_;
  FreeMotions<D> free_;
  NodalVectors still_, r_, trial_r_, s_, g_, z_, p_, q_, scaled_;
  std::vector<Real> lambda_;  // per row of the constraints
  Real energy_scale_ = 0;     // largest that an iteration has released
  Real left_ = 1;             // of the last decrement, relative to that
  Real stability_ = 0;
  std::int64_t iterations_ = 0, tangents_ = 0;
  std::function<bool()> asked_to_stop_ = [] { return false; };
  std::string broken_;  // why forces could not be computed where that was tried last
};

}  // namespace meniscus
