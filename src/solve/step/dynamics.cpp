// SPDX-License-Identifier: BSD-3-Clause
// Stepper for the physical motion, without damping or artificial inertia.
#include "meniscus/solve/stepper.hpp"
#include "solve/step/central_difference.hpp"
#include "solve/step/energy_resolution.hpp"
#include "solve/step/implicit_viscosity.hpp"

#include <fmt/core.h>

#include <optional>

namespace meniscus {
namespace {

template <int D>
class Dynamics final : public Stepper<D> {
 public:
  Dynamics(System<D>& system, bool implicit_viscosity) : system_(system) {
    if (implicit_viscosity) viscosity_.emplace(system);
  }
  Real longest_step(const State& state) override {
    return resolution_.longest_step(system_, state);
  }
  void step(State& state, Real dt) override {
    if (viscosity_)
      viscosity_->advance(state, dt);
    else
      advance(system_, state, dt);
  }
  void try_step(State& state, Real dt) override {
    if (viscosity_)
      viscosity_->advance(state, dt);
    else
      advance<D>(system_, state, dt,
                 [&](const State& after) { resolution_.judge(system_, after, dt); });
  }
  bool may_reject_steps() const override { return true; }
  bool reads(StepReads& reads) override {
    if (viscosity_) viscosity_->list_reads(reads);
    return true;
  }
  std::string effort() const override {
    return viscosity_ ? fmt::format("{:.2f} iterations of the viscosity per step",
                                    viscosity_->mean_iterations())
                      : "";
  }
  void archive(const Archive& a, const State&) override {
    resolution_.archive(a.in("energy_resolution"));
    // Absent in checkpoints of a run whose viscosity was explicit so far.
    if (viscosity_ && (!a.is_reading() || a.has("implicit_viscosity")))
      viscosity_->archive(a.in("implicit_viscosity"));
  }

 private:
  System<D>& system_;
  EnergyResolution<D> resolution_;
  std::optional<ImplicitViscosity<D>> viscosity_;
};

template <int D>
std::unique_ptr<Stepper<D>> make(System<D>& system, const StepperChoice& choice) {
  return std::make_unique<Dynamics<D>>(system, choice.implicit_viscosity);
}

const bool registered = register_entry(StepperEntry{"dynamics", {}, make<2>, make<3>});

}  // namespace
}  // namespace meniscus
