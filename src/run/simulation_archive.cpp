// SPDX-License-Identifier: BSD-3-Clause
// What a run saves and restores.
#include "meniscus/error.hpp"
#include "run/initial_state.hpp"
#include "run/simulation.hpp"

#include <fmt/core.h>

namespace meniscus {

template <int D>
void Simulation<D>::archive(const Archive& a) {
  archive_orders(scene_.system, a.in("orders"));
  state_.archive(a, D);
  a("last_step", last_step_, dimension::time);
  require_saved(last_step_ >= 0 && last_step_ <= state_.time * (1 + 1e-9), a, "last_step");
  archive_viscosity(a);
  if (!stepper_->chooses_step()) {
    if (a.is_reading() && !a.has("step_control"))  // saved by a stepper that chose steps
      controller_->begin(state_);
    else
      controller_->archive(a.in("step_control"));
  }
  const Archive stepper = a.in("stepper").in(scene_.time.solver);
  if (a.is_reading() && !a.in("stepper").has(scene_.time.solver))  // saved by another one
    stepper_->begin(state_);
  else
    stepper_->archive(stepper, state_);
  if (a.is_reading()) audit_.begin(take_ledger(scene_.system, state_));  // sets the kinds of energy
  audit_.archive(a.in("audit"), D);
  // The books begin with the initial momenta and change by external impulses only.
  a.in("audit")("initial_momentum", state_.books.momentum, of_sum(dimension::momentum, D));
  a.in("audit")("initial_angular_momentum", state_.books.angular_momentum,
                of_sum(dimension::angular_momentum, D));
  archive_terms(a);
  archive_references(a.in("references"));
}

/// Saves or restores the viscosity that was chosen at the start of the run, if the scene leaves it
/// automatic.
template <int D>
void Simulation<D>::archive_viscosity(const Archive& a) {
  if (scene_.time.viscosity != "automatic") return;
  const Archive choice = a.in("viscosity");
  if (a.is_reading() && !a.has("viscosity")) return choose_viscosity();  // not automatic then
  bool implicit = implicit_viscosity_;
  choice("implicit", implicit);
  if (implicit != implicit_viscosity_) make_stepper(implicit);
}

template <int D>
void Simulation<D>::archive_terms(const Archive& a) {
  for (std::size_t k = 0; k < scene_.system.terms.size(); ++k) {
    ForceTerm& term = *scene_.system.terms[k];
    term.archive(a.in(fmt::format("terms/{} {}", k, term.name())));
  }
  if (const auto& constraints = scene_.system.constraints)
    for (const auto& one : constraints->all())
      one->archive(a.in(fmt::format("constraints/{} {}", one->number, one->name)));
  for (std::size_t k = 0; k < scene_.system.carried.size(); ++k)
    scene_.system.carried[k]->archive(a.in(fmt::format("carried/{}", k)));
}

/// Saves the references of remapped bodies. When a state is read, the scene has already been built
/// on its references; they are only compared.
template <int D>
void Simulation<D>::archive_references(const Archive& a) const {
  for (const Body<D>& body : scene_.system.bodies) {
    if (a.is_reading() && a.has(body.name) != (body.reference != nullptr))
      throw FileError(fmt::format("the state has another reference of body '{}'", body.name));
    if (!a.is_reading() && body.reference) {
      Reference<D> reference = *body.reference;
      reference.archive(a.in(body.name));
    }
  }
}

template <int D>
Snapshot Simulation<D>::snapshot() {
  complete_state();
  Snapshot snapshot;
  archive(Archive::writing(snapshot, [this](Dimension d) { return scene_.units.symbol(d); }));
  return snapshot;
}

template <int D>
Snapshot Simulation<D>::snapshot_of_first_rank() {
  if (ranks().first()) return snapshot();
  complete_state();
  archive(Archive::nowhere());
  return {};
}

template <int D>
void Simulation<D>::restore(const Snapshot& snapshot) {
  archive(Archive::reading(snapshot));
}

#define MENISCUS_INSTANTIATE(D)                               \
  template void Simulation<D>::archive(const Archive&);       \
  template void Simulation<D>::archive_terms(const Archive&); \
  template Snapshot Simulation<D>::snapshot();                \
  template Snapshot Simulation<D>::snapshot_of_first_rank();  \
  template void Simulation<D>::restore(const Snapshot&);
MENISCUS_INSTANTIATE(2)
MENISCUS_INSTANTIATE(3)
#undef MENISCUS_INSTANTIATE

}  // namespace meniscus
