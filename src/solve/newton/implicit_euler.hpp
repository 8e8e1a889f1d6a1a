// SPDX-License-Identifier: BSD-3-Clause
// Resistance to a step of implicit Euler: viscosity and inertia, as a potential of the increment.
#pragma once
#include "solve/system.hpp"

namespace meniscus {

/// A step of tau from rest at u_n (quasi-statics note 8). Its end u minimises E(u) + (u - u_n).R(u
/// - u_n)/2 with R = C(u_n)/tau + M/tau^2. This is f = C v + M v/tau with v = (u - u_n)/tau, with
/// the viscosity at the positions at the begin of the step. E decreases in every step, however long
/// it is.
template <int D>
class ImplicitEuler {
 public:
  explicit ImplicitEuler(System<D>& system);

  /// Begins a step of `tau` from the displacement u at a time.
  void begin(Real time, const NodalVectors& u, Real tau);
  /// force -= R (u - u_n); returns the potential.
  Real add_force(const NodalVectors& u, NodalVectors& force);

  /// Call this before add_change() if forces were computed at other positions since begin().
  void look_back();
  /// force -= R w
  void add_change(const NodalVectors& w, NodalVectors& force);

  const NodalVectors& from() const { return u_; }
  Real tau() const { return tau_; }

 private:
  System<D>& system_;
  NodalVectors u_, still_, w_, Rw_;
  Real time_ = 0, tau_ = 1;
};

}  // namespace meniscus
