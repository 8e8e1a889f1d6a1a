// SPDX-License-Identifier: BSD-3-Clause
// Dynamic relaxation: explicit dynamics with adaptive damping.
#pragma once
#include "meniscus/solve/stepper.hpp"
#include "solve/step/rest.hpp"

namespace meniscus {

/// Dynamic relaxation with adaptive damping (Underwood 1983). After every step of central
/// differences, velocities are multiplied by exp(-2 zeta omega dt) with zeta = 0.6. Here omega^2 =
/// - du.df / du.M du is the Rayleigh quotient of the stiffness for the motion du of this step. Fast
/// vibrations are damped strongly first; later omega decreases to the slowest mode that moves.
/// Forces, stable step and ramps are as in dynamics. PseudoTime moves thin bodies with another
/// inertia.
///
/// After the last ramp, the bodies are observed over intervals of at most an eighth (at least a
/// sixteenth) of a period of the slowest mode that moves. They are at rest if both measures below
/// are small at the end of two consecutive intervals. A body that has no momentum and angular
/// momentum gets none by damping, so it does not drift. A body that drifts for another reason is
/// judged by its shape. A fluid has no stress that restores positions. It is judged by the change
/// of its axes over the time of its clock, by its power, and by the forces that would set it in
/// motion (FluidRest).
template <int D>
class Relaxation : public Stepper<D> {
 public:
  struct Tolerances {
    /// Tolerance of the force residual: sum |f_A| over the particles, relative to the forces before
    /// they cancel (ForceTerm::uncancelled_force).
    Real force;
    /// Tolerance of the largest displacement that is left, relative to the extent of the body. It
    /// is extrapolated from the change in an interval, using force and velocity of that motion.
    Real shape;
  };

  /// zeta, and the smallest number of steps in an interval.
  static constexpr Real damping_ratio = 0.6;
  static constexpr int least_steps = 40;

  /// `fluid` [body]: true for fluids. Empty if there are none.
  Relaxation(System<D>& system, const Tolerances& tolerances, const std::vector<bool>& fluid = {});

  /// Begins the observation of rest.
  void begin(const State& state) override;
  /// The measures of rest read all particles, but only at the ends of intervals.
  bool reads(StepReads&) override { return true; }
  void step(State& state, Real dt) override;
  /// True if the bodies are at rest.
  bool arrived() const override { return settled_intervals_ >= 2; }
  /// True if shapes have been constant for long, but unbalanced forces pull on bodies.
  bool blocked() const override { return pulled_intervals_ >= 10; }
  std::vector<Residual> residuals(const State& state) const override;
  std::string obstacle(const State& state) const override { return net_forces(system_, state); }
  /// Computed for solids only, if all forces have a potential and the particles are few enough for
  /// factors of their elements.
  std::optional<Real> stability(const State& state) const override;
  void archive(const Archive& a, const State& state) override;

  /// Force residual of the present state. A fluid contributes FluidRest::force_of_power() +
  /// unbalanced_force().
  Real force_residual(const State& state) const;
  /// Displacement that is left, extrapolated from the last interval; 1 before the first interval.
  Real shape_change() const { return shape_change_; }
  /// The end of the last ramp of the system.
  Real steady_after() const;

  /// Sums of a change du, df of the motion: - du.df, du.M du, du.f and du.M v.
  using ModeSums = Lanes;

 protected:
  // These functions depend on the inertia M. Here M is the mass matrix of the particles.

  /// Makes one step without damping. Throws like advance().
  virtual void move(State& state, Real dt);
  /// Kinetic energy v.M v/2.
  virtual Real energy_of_motion(const State& state) const;
  /// The sums for the last step, and for the interval that ends with `state` (du_ and df_).
  virtual ModeSums sums_of_step(const State& state) const;
  virtual ModeSums sums_of_interval(const State& state) const;
  /// Called after damping has multiplied the velocities by `factor`. `omega_dt` is the frequency of
  /// the motion times the step.
  virtual void follow_brake(State&, [[maybe_unused]] Real factor, [[maybe_unused]] Real omega_dt) {}
  /// Smallest number of steps in an interval.
  virtual Real fewest_steps() const { return least_steps; }
  virtual void begin_interval() {}

  System<D>& system_;
  NodalVectors last_u_, last_force_;  ///< before the step
  NodalVectors du_, df_;              ///< changes in the interval, free drift removed

 private:
  /// Damps the velocities and books the lost kinetic energy as dissipated. Judges the state at the
  /// end of an interval.
  void damp(State& state, Real dt);
  void open_interval(const State& state, Real length);
  void judge(State& state, Real dt);
  bool pulled(const State& state) const;
  struct Change {
    Real omega;  ///< sqrt(- du.df / du.M du); 0 if there is no such frequency
    Real left;   ///< remaining amplitude of that motion, in units of du
  };
  Change change_of(const ModeSums& sums) const;
  /// Sets shape_change_.
  Change judged_interval(const State& state);
  /// Largest change of position by du_, relative to the extent of the body.
  Real largest_change() const;
  Real uncancelled_force(const State& state) const;

  Tolerances tolerances_;
  FluidRest<D> fluids_;
  NodalVectors interval_u_, interval_force_;  ///< at the begin of the interval
  std::vector<Real> extents_;                 ///< of the bodies
  Real interval_begin_ = 0, interval_length_ = 0;
  Real shape_change_ = 1;
  std::int64_t settled_intervals_ = 0, pulled_intervals_ = 0;  ///< numbers of consecutive intervals
};

/// The kinetic energy of the masses.
template <int D>
Real kinetic_energy(const System<D>& system, const State& state);

}  // namespace meniscus
