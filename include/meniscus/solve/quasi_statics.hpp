// SPDX-License-Identifier: BSD-3-Clause
// Quasi-statics: equilibria from load step to load step, and the flow of fluids to them, by
// Newton's method.
#pragma once
#include "meniscus/solve/free_motions.hpp"
#include "meniscus/solve/held_preconditioner.hpp"
#include "meniscus/solve/rest.hpp"
#include "meniscus/solve/stepper.hpp"

#include <cmath>
#include <optional>

namespace meniscus {

/// (quasi-statics note 2) Each load step looks for the minimum of the potential of all terms at its
/// time, downhill from the equilibrium before: Newton's method, whose linear equations conjugate
/// gradients solve by actions of the tangent (ForceTerm::add_tangent) as exactly as is worth it,
/// with linear elements as preconditioner. A step that does not lower the potential enough is
/// halved. What is left when Newton's method stops is known as the energy that the next step
/// would release.
///
/// Where the tangent has a direction of negative curvature the state is not stable, and is left
/// along it: a body that snaps from one equilibrium to another releases energy that no outer work
/// accounts for. That is booked as dissipated, once pieces of the load step have shown that it does
/// not vanish with them. So is what the first state has been away from equilibrium.
///
/// There is no motion: what kinetic energy a state has is dissipated by the first step.
///
/// No shear brings a fluid back, so that with one the tangent is singular. It flows to its
/// equilibrium (quasi-statics note 8): a step is one of implicit Euler against viscosity and
/// inertia, from rest, and lasts as long as its time says. Steps are doubled while the energy that
/// they release does not fall fast, and the run ends where little is left to release.
template <int D>
class QuasiStatics final : public Stepper<D> {
 public:
  /// Every term has a potential, and there is no field beside the displacement.
  QuasiStatics(System<D>& system, const StepperChoice& choice);

  bool implicit() const override { return true; }
  void begin(const State& state) override;
  /// From wherever a run begins to the equilibrium at that time.
  void settle(State& state) override;
  /// The load step: that of the scene, or a twentieth of its time; less to meet the end of a ramp.
  /// With fluids the step of implicit Euler, which is not longer while loads change.
  Real longest_step(const State& state) override;
  /// Throws SolveError where no equilibrium is found.
  void step(State& state, Real dt) override;
  /// At the equilibrium of the final loads, or at the end of loads that never cease to change.
  bool arrived() const override { return arrived_; }
  std::vector<Residual> residuals(const State& state) const override;
  std::string obstacle(const State& state) const override;
  std::vector<std::string> take_notes() override { return std::exchange(notes_, {}); }
  std::string effort() const override;
  void archive(const Archive& a, const State& state) override;

  /// Least eigenvalue of the tangent, relative to the preconditioner, that the last iteration has
  /// seen: negative at a state that is not stable.
  Real stability() const { return stability_; }
  std::int64_t iterations() const { return iterations_; }
  std::int64_t tangents() const { return tangents_; }
  std::int64_t jumps() const { return jumps_; }

 private:
  /// A state on the way to equilibrium, with its forces in r_.
  struct Point {
    NodalVectors u;
    Real potential = 0;
  };
  /// What conjugate gradients found, in s_.
  struct Direction {
    Real decrement = 0;  ///< energy that the step would release
    bool bent = false;   ///< negative curvature was seen along p_
  };
  struct Solution {
    Point point;
    int iterations = 0;
    bool bent = false;    ///< negative curvature was seen on the way
    bool stuck = false;   ///< nothing lowers the energy, although a force is left
    bool hard = false;    ///< one of these, or many iterations
    bool far = false;     ///< it may be an equilibrium far from that before
    std::string failure;  ///< why there is none; empty: there is
  };

  /// In a piece of a step.
  struct Exchange {
    Real work = 0, stored = 0;
    Real released() const { return work - stored; }
    Real size() const { return std::abs(work) + std::abs(stored); }
  };
  Real load_step() const;
  Real stored_size(const State& state) const;
  Real scale_of_flow(Real stored) const;
  void flow(State& state, Real dt);
  Real work_of_forces(const State& from, const State& to);
  /// After a step of dt; `whole_step`: that was neither cut nor hard to find.
  void judge_rest(const State& state, Real dt, Real released, bool whole_step);
  Solution solve(const State& state, Real time);
  Solution iterated(const State& state, Real time);
  std::string pulled(Real time, const NodalVectors& u);
  bool begin_at(const State& state, Real time, Point& point);
  /// Fills force and point.potential for point.u; false where forces cannot be computed.
  bool evaluate(Real time, Point& point, NodalVectors& force);
  Direction direction(Real time, const NodalVectors& u, Real tolerance);
  /// q_ = A p_; returns p_.q_.
  Real apply(Real time, const NodalVectors& u);
  /// u += a s_ with a = 1, 1/2, .. until the potential is lower by a share of what is expected;
  /// false if it never is.
  bool search(Real time, Point& point, Real decrement);
  Exchange move(State& state, Real time, const NodalVectors& u);
  void reactions(const NodalVectors& force, std::vector<Real>& lambda) const;
  /// Where work is counted from, or to.
  struct Equilibrium {
    Real time;
    const NodalVectors& u;
    const std::vector<Real>& lambda;
  };
  std::vector<Real> work_between(const Equilibrium& before, const Equilibrium& after);
  void book(State& state, const std::vector<Real>& work) const;
  void book_bend(const State& before, State& state);
  void book_jump(State& state, Real since, Real released);
  Real stored_energy(const Motion& motion) const;
  std::string unbalanced(State& state, Real time);
  void stop_motion(State& state);
  Real dot(const NodalVectors& a, const NodalVectors& b) const;
  Real largest(const NodalVectors& w) const;

  System<D>& system_;
  StepperChoice choice_;
  std::optional<HeldPreconditioner<D>> preconditioner_;
  FluidRest<D> fluids_;
  std::optional<ImplicitEuler<D>> euler_;  // with fluids
  Real tolerance_;                         // of the energy that is left by a solution
  FreeMotions<D> free_;
  Real spacing_ = 0;
  NodalVectors still_, r_, trial_r_, s_, g_, z_, p_, q_, scaled_;
  std::vector<Real> lambda_;  // per row of the constraints
  std::vector<Real> work_;    // of work_between() in this piece of a step
  // Of the past.
  NodalVectors last_du_;                       // of the last piece of a step
  Real last_dt_ = 0;                           // 0: nothing is known to go on with
  std::vector<Real> last_work_, last_lambda_;  // of that piece, and at its beginning
  Real energy_scale_ = 0;                      // largest that an iteration has released
  Real left_ = 1;                              // of the last decrement, relative to that
  Real stability_ = 0;
  std::int64_t jumps_ = 0, iterations_ = 0, tangents_ = 0;
  // Of the flow, since loads are steady.
  Real tau_ = 0;                       // next step of implicit Euler; 0: not known
  Real power_ = 0, released_ = 0;      // of the last step, and energy by the last whole one
  Real all_released_ = 0, began_ = 0;  // energy so far, since that time
  Real moment_of_release_ = 0;         // sum of energy times its time
  bool at_equilibrium_ = false, arrived_ = false;
  std::vector<std::string> notes_;
  std::string broken_;  // why forces could not be computed where that was tried last
};

}  // namespace meniscus
