// SPDX-License-Identifier: BSD-3-Clause
// A system of one body at rest, for tests of the time loop.
#pragma once
#include "solve/audit.hpp"
#include "solve/step/time_step.hpp"
#include "support.hpp"

namespace meniscus::test {

template <int D>
struct OneBody {
  System<D> system;
  State state;

  OneBody(Geometry<D> geometry, const std::string& law, const std::string& text) {
    order_spatially(geometry);
    ParticleSet<D> particles(geometry.grid.X, Support<D>{}, KernelFunction::cubic_spline);
    auto& one = system.bodies.emplace_back("body", std::move(geometry), std::move(particles));
    system.terms.push_back(internal_force<D>(one, law, text));
    system.mass = one.mass;
    state.u.assign(system.mass.size(), Lanes::zero());
    state.v = state.force = state.u;
  }
  OneBody(Geometry<D> geometry, const std::string& law)
      : OneBody(std::move(geometry), law, law_texts().at(law)) {}

  Body<D>& body() { return system.bodies.front(); }
};

}  // namespace meniscus::test
