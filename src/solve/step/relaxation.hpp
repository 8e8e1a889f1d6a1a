// SPDX-License-Identifier: BSD-3-Clause
// Dynamic relaxation: explicit dynamics with the damping that its motion asks for.
#pragma once
#include "meniscus/solve/stepper.hpp"
#include "solve/step/rest.hpp"

namespace meniscus {

/// Dynamic relaxation with adaptive damping (Underwood 1983): after every step of central
/// differences velocities shrink by exp(-2 zeta omega dt), zeta = 0.6, where omega^2 = - du.df /
/// du.M du is the Rayleigh quotient of the stiffness for the motion of that step. Fast vibrations
/// are braked hard, then omega falls to the slowest mode that moves. Forces and the stable step are
/// those of dynamics, and loads with ramps run over the same time. PseudoTime moves thin bodies
/// with another inertia.
///
/// After the last ramp the bodies are observed over windows of an eighth of a period (a sixteenth
/// at least) of the slowest mode that moves: they are at rest when both measures below are small at
/// the end of two in a row. Neither momentum nor angular momentum comes into bodies that have none,
/// so that they do not drift. A body that drifts all the same is judged by its shape, and a fluid
/// by the change of its axes in the time of its clock, by its power and by the forces that would
/// set it in motion (FluidRest): nothing brings its particles back.
template <int D>
class Relaxation : public Stepper<D> {
 public:
  struct Tolerances {
    /// Of sum |f_A| over the particles, relative to the forces before they cancel
    /// (ForceTerm::uncancelled_force).
    Real force;
    /// Of the largest change of place that is left, relative to the extent of its body: what was
    /// seen in a window, continued to where force and velocity of that motion take it.
    Real shape;
  };

  /// `fluid`: which bodies are fluids; none if it is empty.
  Relaxation(System<D>& system, const Tolerances& tolerances, const std::vector<bool>& fluid = {});

  /// Begins to observe.
  void begin(const State& state) override;
  /// Its measures look at all particles at the ends of windows only.
  bool tell_reads(StepReads&) override { return true; }
  void step(State& state, Real dt) override;
  /// Whether the bodies are at rest.
  bool arrived() const override { return settled_windows_ >= 2; }
  /// Whether shapes have long been settled while bodies are pulled on by what nothing balances.
  bool blocked() const override { return pulled_windows_ >= 10; }
  std::vector<Residual> residuals(const State& state) const override;
  std::string obstacle(const State& state) const override { return net_forces(system_, state); }
  /// Of solids whose forces all have a potential, and of so many particles that the factors of
  /// their elements are quickly made.
  std::optional<Real> stability(const State& state) const override;
  void archive(const Archive& a, const State& state) override;

  /// Of the present state; of fluids FluidRest::force_of_power() + unbalanced_force().
  Real force_residual(const State& state) const;
  /// Left to go, as extrapolated from the last window; 1 before there was one.
  Real shape_change() const { return shape_change_; }
  /// When the last ramp of the system ends.
  Real steady_after() const;

  /// Sums of a change du, df of the motion: - du.df, du.M du, du.f and du.M v.
  using ModeSums = Lanes;

 protected:
  // What depends on the inertia M; here it is that of the masses.

  /// One step without damping. Throws as advance().
  virtual void move(State& state, Real dt);
  /// v.M v/2
  virtual Real energy_of_motion(const State& state) const;
  /// Of the last step, and of the window up to `state`; du and df in the window are given.
  virtual ModeSums sums_of_step(const State& state) const;
  virtual ModeSums sums_of_window(const State& state) const;
  /// After the velocities have been multiplied by `factor` in a step of dt, where the motion had
  /// the frequency omega.
  virtual void follow_brake(State&, [[maybe_unused]] Real factor, [[maybe_unused]] Real omega_dt) {}
  /// Steps of a window.
  virtual Real fewest_steps() const { return 40; }
  virtual void begin_window() {}

  System<D>& system_;
  NodalVectors last_u_, last_force_;  ///< before the step
  NodalVectors du_, df_;              ///< of the window, free drift removed

 private:
  /// Damps the velocities, books what that takes from the kinetic energy as dissipated, and judges
  /// the state at the end of a window.
  void damp(State& state, Real dt);
  void open_window(const State& state, Real length);
  void judge(State& state, Real dt);
  bool pulled(const State& state) const;
  struct Change {
    Real omega;  ///< sqrt(- du.df / du.M du); 0 if there is no such frequency
    Real left;   ///< amplitude of that motion from now on, in units of du
  };
  Change change_of(const ModeSums& sums) const;
  /// Sets shape_change_.
  Change judged_window(const State& state);
  /// Of places, relative to the extent of the body, by du_.
  Real largest_change() const;
  Real uncancelled_force(const State& state) const;

  Tolerances tolerances_;
  FluidRest<D> fluids_;
  NodalVectors window_u_, window_force_;  ///< at the beginning of the window
  std::vector<Real> extents_;             ///< of the bodies
  Real window_begin_ = 0, window_length_ = 0;
  Real shape_change_ = 1;
  std::int64_t settled_windows_ = 0, pulled_windows_ = 0;  ///< in a row
};

/// The kinetic energy of the masses.
template <int D>
Real kinetic_energy(const System<D>& system, const State& state);

}  // namespace meniscus
