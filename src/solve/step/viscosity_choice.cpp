// SPDX-License-Identifier: BSD-3-Clause
// Compares the stable steps with and without viscosity, and chooses explicit or implicit viscosity.
#include "solve/step/viscosity_choice.hpp"

#include "solve/step/time_step.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace meniscus {
namespace {

ViscosityChoice explicit_for(const std::string& reason) {
  return {false, "viscosity is explicit: " + reason};
}
ViscosityChoice implicit_for(const std::string& reason) {
  return {true, "viscosity is implicit: " + reason};
}

}  // namespace

template <int D>
ViscosityChoice choose_viscosity(System<D>& system, const State& start,
                                 const std::optional<Real>& fixed_step) {
  if (!system.viscous()) return explicit_for("nothing is viscous");
  State still = start;
  std::fill(still.v.begin(), still.v.end(), Lanes::zero());
  const Real limit = StableStepEstimator<D>(system).estimate(still).dt;
  if (fixed_step) {
    const std::string found = fmt::format("the explicit limit is {:.4g}", limit);
    return *fixed_step > limit ? implicit_for(found) : explicit_for(found);
  }
  constexpr Real worth_it = 2;
  const Real ratio = StableStepEstimator<D>(system, false).estimate(still).dt / limit;
  const std::string found =
      fmt::format("implicit steps may be {:.2g} times as long at the start", ratio);
  return ratio > worth_it ? implicit_for(found) : explicit_for(found);
}

template ViscosityChoice choose_viscosity(System<2>&, const State&, const std::optional<Real>&);
template ViscosityChoice choose_viscosity(System<3>&, const State&, const std::optional<Real>&);

}  // namespace meniscus
