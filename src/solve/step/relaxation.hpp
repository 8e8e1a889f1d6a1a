// SPDX-License-Identifier: BSD-3-Clause
// Dynamic relaxation: explicit dynamics with the damping that its motion asks for.
#pragma once
#include "meniscus/solve/stepper.hpp"
#include "solve/step/elastic_inertia.hpp"
#include "solve/step/rest.hpp"

namespace meniscus {

/// Dynamic relaxation with adaptive damping (Underwood 1983): after every step of central
/// differences velocities shrink by exp(-2 zeta omega dt), zeta = 0.6, where omega^2 = - du.df /
/// du.M du is the Rayleigh quotient of the stiffness for the motion of that step. Fast vibrations
/// are braked hard, then omega falls to the slowest mode that moves. Forces are those of dynamics,
/// and so is the stable step, but for thin elastic bodies, whose motion is that of another inertia
/// with longer steps (ElasticInertia): they begin without motion, and what their kinetic energy is
/// more than that of their masses counts as dissipated. Loads with ramps run over the same time.
///
/// After the last ramp the bodies are observed over windows of an eighth of a period (a sixteenth
/// at least) of the slowest mode that moves: they are at rest when both measures below are small at
/// the end of two in a row. Neither momentum nor angular momentum comes into bodies that have none,
/// so that they do not drift. A body that drifts all the same is judged by its shape, and a fluid
/// by the change of its axes in the time of its clock, by its power and by the forces that would
/// set it in motion (FluidRest): nothing brings its particles back.
template <int D>
class Relaxation final : public Stepper<D> {
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
  /// With ElasticInertia, and steps of `safety` times the longest stable one.
  void relieve(Real safety);

  /// Begins to observe.
  void begin(const State& state) override;
  bool chooses_step() const override { return inertia_ != nullptr; }
  /// Its measures look at all particles at the ends of windows only.
  bool tell_reads(StepReads&) override { return !inertia_; }
  Real longest_step(const State& state) override;
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
  std::string effort() const override;
  void archive(const Archive& a, const State& state) override;

  /// Of the present state; of fluids FluidRest::force_of_power() + unbalanced_force().
  Real force_residual(const State& state) const;
  /// Left to go, as extrapolated from the last window; 1 before there was one.
  Real shape_change() const { return shape_change_; }
  /// When the last ramp of the system ends.
  Real steady_after() const;

 private:
  /// advance() with the elastic inertia.
  void glide(State& state, Real dt);
  /// What follows from a state and the momentum that goes with it.
  void take_up(const State& state);
  /// Kinetic, with the inertia that there is.
  Real energy_of_motion(const State& state) const;
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
  /// Since displacements u and forces f.
  Change change_since(const NodalVectors& u, const NodalVectors& f, const State& state) const;
  /// For changes du(A), df(A) of the particles to the present state, with M du = `impulse` where
  /// the inertia is elastic.
  template <class U, class F>
  Change change_of(U&& du_of, F&& df_of, const NodalVectors& impulse, const State& state) const;
  /// Sets shape_change_.
  Change judged_window(const State& state);
  /// Of places, relative to the extent of the body, by du_.
  Real largest_change() const;
  Real uncancelled_force(const State& state) const;

  System<D>& system_;
  Tolerances tolerances_;
  FluidRest<D> fluids_;
  NodalVectors last_u_, last_force_;            ///< before the step
  NodalVectors window_u_, window_force_;        ///< at the beginning of the window
  NodalVectors du_, df_;                        ///< of the window, free drift removed
  std::vector<Real> extents_;                   ///< of the bodies
  std::unique_ptr<ElasticInertia<D>> inertia_;  ///< null: that of the masses
  std::optional<ElasticStep<D>> elastic_step_;
  NodalVectors momentum_, acceleration_;   ///< of the elastic inertia
  NodalVectors impulse_, window_impulse_;  ///< M du of the last step, and since the window began
  Real beyond_ = 0;                        ///< kinetic energy beyond that of the masses
  bool starts_ = true;                     ///< with the next step, at rest
  Real window_begin_ = 0, window_length_ = 0;
  Real shape_change_ = 1;
  std::int64_t settled_windows_ = 0, pulled_windows_ = 0;  ///< in a row
};

}  // namespace meniscus
