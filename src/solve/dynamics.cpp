// SPDX-License-Identifier: BSD-3-Clause
// Dynamics: the motion as it is.
#include "meniscus/solve/central_difference.hpp"
#include "meniscus/solve/energy_resolution.hpp"
#include "meniscus/solve/stepper.hpp"

namespace meniscus {
namespace {

template <int D>
class Dynamics final : public Stepper<D> {
 public:
  explicit Dynamics(System<D>& system) : system_(system) {}
  Real longest_step(const State& state) override {
    return resolution_.longest_step(system_, state);
  }
  void step(State& state, Real dt) override { advance(system_, state, dt); }
  void archive(const Archive& a, const State&) override {
    resolution_.archive(a.in("energy_resolution"));
  }

 private:
  System<D>& system_;
  EnergyResolution<D> resolution_;
};

template <int D>
std::unique_ptr<Stepper<D>> make(System<D>& system, const StepperChoice&) {
  return std::make_unique<Dynamics<D>>(system);
}

const bool registered = register_entry(StepperEntry{"dynamics", {}, make<2>, make<3>});

}  // namespace
}  // namespace meniscus
