// SPDX-License-Identifier: BSD-3-Clause
// What resists a step of implicit Euler: viscosity and inertia, as a potential of the increment.
#pragma once
#include "solve/system.hpp"

namespace meniscus {

/// (quasi-statics note 8) A step of tau from rest at u_n ends where E(u) + (u - u_n).R(u - u_n)/2
/// is least, R = C(u_n)/tau + M/tau^2: f = C v + M v/tau with v = (u - u_n)/tau, the viscosity
/// being that of the places at the beginning of the step. E falls in every step, however long.
template <int D>
class ImplicitEuler {
 public:
  explicit ImplicitEuler(System<D>& system);

  /// A step of `tau` from the displacement u at a time.
  void begin(Real time, const NodalVectors& u, Real tau);
  /// force -= R (u - u_n); returns the potential.
  Real add_force(const NodalVectors& u, NodalVectors& force);

  /// Before calls of add_change() that follow forces at other places.
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
