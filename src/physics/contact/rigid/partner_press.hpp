// SPDX-License-Identifier: BSD-3-Clause
// A rigid partner that a force or a spring presses against a body.
#pragma once
#include "input/expression.hpp"
#include "input/ramp.hpp"
#include "state/archive.hpp"

#include <algorithm>

namespace meniscus {

/// A partner without mass that moves along a direction n by a way s. A force F(t) pushes it, and a
/// spring of stiffness k draws it to the way b(t) of its base. At each motion of the body it is
/// where
///
///   R.n + k (s - b) = F,
///
/// R being the force of the partner on the body. This is a minimum over s of E(u, s) + U(s, t),
/// with the energy E of the contact and U = k/2 (s - b)^2 - F s (CGCM note 3.5). A partner at rest
/// at this place would give the same forces on the body.
template <int D>
class PartnerPress {
 public:
  struct Settings {
    Vec<D> direction;  ///< n, of unit length
    Expression force, base;
    Real stiffness = 0;
    Ramp ramp;  ///< of the force
  };
  explicit PartnerPress(Settings settings) : settings_(std::move(settings)) {}

  const Vec<D>& direction() const { return settings_.direction; }
  /// The present way s, and the displacement s n.
  Real way() const { return way_; }
  Vec<D> displacement() const { return way_ * direction(); }
  void set_way(Real way) { way_ = way; }

  Real force(Real time) const {
    return settings_.ramp.fraction(time) * settings_.force(Eigen::Vector3d::Zero(), time);
  }
  Real base(Real time) const { return settings_.base(Eigen::Vector3d::Zero(), time); }
  /// The time after which both are constant.
  Real steady_after() const {
    return std::max(
        {settings_.force.steady_after(), settings_.base.steady_after(), settings_.ramp.end});
  }
  Real stiffness() const { return settings_.stiffness; }
  /// Force of the spring on the partner along n, k (b - s).
  Real spring_force(Real time) const { return stiffness() * (base(time) - way_); }
  /// U at the present way.
  Real energy(Real time) const;
  /// A time, with the way, the force and the base at it.
  struct Moment {
    Real way = 0, force = 0, base = 0;
  };
  Moment now(Real time) const { return {way_, force(time), base(time)}; }
  /// Work of a changing force and of a moving base between two moments, with the mean of the ways:
  /// the integral of - s dF - k (s - b) db.
  Real work(const Moment& before, const Moment& after) const;
  /// This work since the last accepted step.
  Real work_since_step(Real time) const { return begun_ ? work(last_, now(time)) : 0; }
  /// Accepts the step that ends at `time` with the present way.
  void commit(Real time) {
    begun_ = true;
    last_ = now(time);
  }
  /// D: dimension of the scene, which determines the unit of forces.
  void archive(const Archive& a);

  /// The body beside the partner at its present way.
  class Neighbour {
   public:
    virtual ~Neighbour() = default;
    virtual Real pull() = 0;  ///< R.n
    virtual Real gap() = 0;   ///< distance from the partner
  };
  /// Finds the way at `time`, beginning at the last accepted one: the next minimum downhill. All
  /// processes call this. `length`: over which forces change, such as the least gap. Returns false
  /// if nothing stops the partner within the way `longest`.
  bool settle(Real time, Neighbour& body, Real length, Real longest);

 private:
  Settings settings_;
  Real way_ = 0;
  bool begun_ = false;
  Moment last_;  // of the last accepted step
};

}  // namespace meniscus
