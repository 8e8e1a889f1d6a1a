// SPDX-License-Identifier: BSD-3-Clause
// A simulation that follows the equilibria of another one, whose scene has slightly other numbers.
#include "meniscus/error.hpp"
#include "parallel/nodal_algebra.hpp"
#include "run/simulation.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace meniscus {

template <int D>
void Simulation<D>::follow(Simulation& base) {
  System<D>& system = scene_.system;
  if (state_.u.size() != base.state_.u.size())
    throw InputError(
        "the scene beside the run has other particles: allowed are changes of numbers that leave "
        "their number as it is");
  const auto balance = [&] {
    system.compute_forces(state_.motion(), state_.forces());
    if (system.constraints) system.constraints->balance(state_.force, state_.reactions.force);
  };
  base.complete_state();
  state_.time = base.state_.time;
  state_.step = base.state_.step;
  state_.u = base.state_.u;
  if (system.constraints) {
    const Constraints& constraints = *system.constraints;
    std::vector<Real> off(static_cast<std::size_t>(constraints.rows())), is = off;
    constraints.targets(state_.time, off);
    constraints.apply(state_.u, is);
    for (std::size_t r = 0; r < off.size(); ++r) off[r] -= is[r];
    constraints.solve(off);
    constraints.add_over_mass(off, 1, state_.u);
  }
  balance();
  constexpr int most = 10;
  constexpr Real exact = 1e-8, round_off = 1e-12;  // parts of the change, and of u
  constexpr Real bearable = 1e-4, unseen = 1e-9;   // likewise
  Real first = 0, last = 0;
  for (int k = 0; k < most; ++k) {
    const auto change = base.stepper_->response(base.state_, state_.force);
    if (!change)
      throw InputError(scene_.time.solver_place +
                       ": a scene beside the run needs equilibria of solids, which newton finds");
    add(state_.u, 1, *change);
    balance();
    last = largest(*change);
    first = std::max(first, last);
    if (last <= exact * first + round_off * largest(state_.u)) break;
  }
  if (last > bearable * first + unseen * largest(state_.u))
    throw SolveError(
        fmt::format("t = {:.6g}: the scene beside the run has no equilibrium near that of the run",
                    state_.time));
  system.commit(state_.motion());
}

template void Simulation<2>::follow(Simulation&);
template void Simulation<3>::follow(Simulation&);

}  // namespace meniscus
