// SPDX-License-Identifier: BSD-3-Clause
// Inertia and viscosity of a step of implicit Euler. Viscosity is evaluated at the positions at the
// beginning of the step.
#include "solve/newton/implicit_euler.hpp"

#include "parallel/parallel.hpp"

namespace meniscus {

template <int D>
ImplicitEuler<D>::ImplicitEuler(System<D>& system) : system_(system) {
  still_.assign(static_cast<std::size_t>(system.size()), Lanes::zero());
  u_ = w_ = Rw_ = still_;
  for (auto& term : system.terms)
    if (term->viscous()) term->expect_viscous_calls();
}

template <int D>
void ImplicitEuler<D>::begin(Real time, const NodalVectors& u, Real tau) {
  time_ = time;
  u_ = u;
  tau_ = tau;
}

template <int D>
Real ImplicitEuler<D>::add_force(const NodalVectors& u, NodalVectors& force) {
  NodalVectors velocity(u.size());
  sweep(system_.size(), [&](Index begin, Index end) {
    for (Index A = begin; A < end; ++A) {
      at(w_, A) = at(u, A) - at(u_, A);
      at(velocity, A) = at(w_, A) / tau_;
      at(Rw_, A) = (-at(system_.mass, A) / tau_) * at(velocity, A);
    }
  });
  // Add viscous forces as tangents, because add_viscous() would need the last force to be at the
  // positions u_.
  system_.add_tangent({time_, u_, still_}, {time_, still_, velocity}, Rw_, System<D>::viscous);
  sweep(system_.size(), [&](Index begin, Index end) {
    for (Index A = begin; A < end; ++A) at(force, A) += at(Rw_, A);
  });
  return -0.5 *
         parallel_sum(system_.size(), 0.0, [&](Index A) { return sum(at(w_, A) * at(Rw_, A)); });
}

template <int D>
void ImplicitEuler<D>::look_back() {
  for (auto& term : system_.terms)
    if (term->viscous()) system_.add_force(*term, {time_, u_, still_}, Rw_);
}

template <int D>
void ImplicitEuler<D>::add_change(const NodalVectors& w, NodalVectors& force) {
  sweep(system_.size(), [&](Index begin, Index end) {
    for (Index A = begin; A < end; ++A) {
      at(w_, A) = at(w, A) / tau_;
      at(force, A) -= (at(system_.mass, A) / tau_) * at(w_, A);
    }
  });
  system_.add_viscous({time_, u_, w_}, force);
}

template class ImplicitEuler<2>;
template class ImplicitEuler<3>;

}  // namespace meniscus
