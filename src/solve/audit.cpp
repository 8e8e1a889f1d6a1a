// SPDX-License-Identifier: BSD-3-Clause
// Sums of energy and momentum over the particles.
#include "solve/audit.hpp"

#include "numbers/dense.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <cmath>

namespace meniscus {
namespace {

/// Momenta of coefficients: sum m v and sum m x cross v. Exact invariants of the discrete system.
template <int D>
Eigen::Matrix<Real, 6, 1> momenta(const System<D>& system, const State& state) {
  Eigen::Matrix<Real, 6, 1> zero = Eigen::Matrix<Real, 6, 1>::Zero();
  for (const Body<D>& body : system.bodies)
    zero += parallel_sum(body.size(), Eigen::Matrix<Real, 6, 1>(Eigen::Matrix<Real, 6, 1>::Zero()),
                         [&](Index A) {
                           const Index I = body.first + A;
                           Eigen::Vector3d x = spatial(at(state.u, I));
                           x.head<D>() += at(body.particles.X(), A);
                           Eigen::Vector3d p = at(system.mass, I) * spatial(at(state.v, I));
                           if (system.revolved()) {  // forces across the axis balance each other
                             x.setZero();
                             p[0] = 0;
                           }
                           Eigen::Matrix<Real, 6, 1> both;
                           both.head<3>() = p;
                           both.tail<3>() = cross(x, p);
                           return both;
                         });
  return zero;
}

std::optional<Real> stored_energy(const ForceTerm& term, const State& state) {
  for (const StoredEnergy& known : state.energies)
    if (known.term == &term) return known.value;
  return term.stored_energy(state.motion());
}

Real relative(Real change, Real scale) {
  return scale > 0 ? change / scale : 0;
}

}  // namespace

Real Ledger::balance() const {
  Real total = kinetic + dissipated - external_work - remapped;
  for (const auto& [kind, energy] : stored) total += energy;
  return total;
}

template <int D>
Ledger take_ledger(const System<D>& system, const State& state) {
  Ledger ledger;
  ledger.kinetic = parallel_sum(system.size(), 0.0, [&](Index A) {
    return 0.5 * at(system.mass, A) * sum(at(state.v, A) * at(state.v, A));
  });
  for (const Unknown& field : state.fields)
    if (field.spec.evolution == Evolution::inertial)
      ledger.kinetic += parallel_sum(system.size(), 0.0, [&](Index A) {
        return 0.5 * at(field.capacity, A) * sum(at(field.rate, A) * at(field.rate, A));
      });
  for (const auto& term : system.terms)
    if (const auto energy = stored_energy(*term, state))
      ledger.stored[std::string(term->energy_kind())] += *energy;
  ledger.dissipated = state.books.dissipated;
  ledger.external_work = state.books.external_work;
  ledger.remapped = state.books.remapped;
  const auto both = momenta(system, state);
  ledger.momentum = both.template head<3>();
  ledger.angular_momentum = both.template tail<3>();
  ledger.momentum_excess = ledger.momentum - state.books.momentum;
  ledger.angular_momentum_excess = ledger.angular_momentum - state.books.angular_momentum;
  if (system.revolved()) {
    ledger.momentum_excess[0] = 0;
    ledger.angular_momentum_excess.setZero();
  }
  ledger.impulses = state.books.impulses;
  ledger.angular_impulses = state.books.angular_impulses;
  return ledger;
}

void Audit::begin(const Ledger& ledger) {
  *this = {};
  initial_balance = ledger.balance();
  initial_stored = ledger.stored;
}

void Audit::archive(const Archive& a, int space_dimension) {
  const auto sum = [&](Dimension d) { return of_sum(d, space_dimension); };
  a("initial_balance", initial_balance, sum(dimension::energy));
  a("initial_stored", initial_stored, sum(dimension::energy));
  a("energy_scale", energy_scale, sum(dimension::energy));
  a("momentum_scale", momentum_scale, sum(dimension::momentum));
  a("angular_momentum_scale", angular_momentum_scale, sum(dimension::angular_momentum));
}

template <int D>
void Audit::follow(const System<D>& system, const State& state, const Ledger& ledger) {
  Real exchanged = ledger.kinetic + ledger.dissipated + std::abs(ledger.external_work);
  for (const auto& [kind, energy] : ledger.stored)
    exchanged = std::max(exchanged, std::abs(energy - initial_stored.at(kind)));
  energy_scale = std::max(energy_scale, exchanged);

  Real mass = 0, spread = 0;
  Eigen::Vector3d first = Eigen::Vector3d::Zero();
  for (const Body<D>& body : system.bodies)
    for (Index A = 0; A < body.size(); ++A) {
      const Index I = body.first + A;
      Eigen::Vector3d x = spatial(at(state.u, I));
      x.template head<D>() += at(body.particles.X(), A);
      mass += at(system.mass, I);
      first += at(system.mass, I) * x;
      spread += at(system.mass, I) * x.squaredNorm();
    }
  const Real momentum = std::sqrt(2 * mass * ledger.kinetic);
  const Real gyration = std::sqrt(std::max(0.0, spread / mass - (first / mass).squaredNorm()));
  momentum_scale = std::max({momentum_scale, momentum, ledger.impulses});
  angular_momentum_scale =
      std::max({angular_momentum_scale, momentum * gyration, ledger.angular_impulses});
}

Real Audit::balance_error(const Ledger& ledger) const {
  return relative(ledger.balance() - initial_balance, energy_scale);
}
Real Audit::momentum_error(const Ledger& ledger) const {
  return relative(ledger.momentum_excess.norm(), momentum_scale);
}
Real Audit::angular_momentum_error(const Ledger& ledger) const {
  return relative(ledger.angular_momentum_excess.norm(), angular_momentum_scale);
}

template Ledger take_ledger(const System<2>&, const State&);
template Ledger take_ledger(const System<3>&, const State&);
template void Audit::follow(const System<2>&, const State&, const Ledger&);
template void Audit::follow(const System<3>&, const State&, const Ledger&);

}  // namespace meniscus
