// SPDX-License-Identifier: BSD-3-Clause
// Warnings during a run about doubtful states.
#include "app/warnings.hpp"

#include "measure/drop_measures.hpp"
#include "parallel/ranks.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace meniscus {
namespace {

const MeasureSource* find_measure(const std::vector<MeasureSource>& measures,
                                  const std::string& name) {
  const auto found = std::find_if(measures.begin(), measures.end(),
                                  [&](const MeasureSource& m) { return m.name == name; });
  return found == measures.end() ? nullptr : &*found;
}

}  // namespace

template <int D>
Warnings<D>::Warnings(const Simulation<D>& simulation, std::function<void(const std::string&)> say)
    : say_(std::move(say)) {
  follow(simulation);
}

template <int D>
void Warnings<D>::follow(const Simulation<D>& simulation) {
  simulation_ = &simulation;
  enclosures_.clear();
  const Scene<D>& scene = simulation.scene();
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const Body<D>& body = scene.system.bodies[b];
    const SceneBody& own = scene.bodies[b];
    if (own.is_drop() && !own.tension->inscribed()) continue;  // a run refuses smaller errors
    const MeasureSource* area = find_measure(scene.measures, body.name + ".area");
    const MeasureSource* volume = find_measure(scene.measures, body.name + ".volume");
    if (area && volume) enclosures_.push_back({body.name, area, volume});
  }
}

template <int D>
void Warnings<D>::look(const Ledger& ledger) {
  doubtful_laws();
  imbalance(ledger);
  impossible_areas();
}

template <int D>
void Warnings<D>::doubtful_laws() {
  for (const auto& term : simulation_->scene().system.terms) {
    if (said_.contains(term->name())) continue;
    // A term looks at the rows of its process.
    const std::string warning =
        ranks().first_said(term->warning(simulation_->state().motion()).value_or(std::string()));
    if (warning.empty()) continue;
    say_(fmt::format("t = {:.6g}: {}", simulation_->state().time, warning));
    said_.insert(term->name());
  }
}

template <int D>
void Warnings<D>::imbalance(const Ledger& ledger) {
  const Real error = simulation_->audit().balance_error(ledger);
  // If almost no energy is exchanged, the balance consists of rounding errors: no warning.
  Real size = ledger.kinetic + ledger.dissipated + std::abs(ledger.external_work);
  for (const auto& [kind, energy] : ledger.stored) size += std::abs(energy);
  const Real change = ledger.balance() - simulation_->audit().initial_balance;
  if (std::abs(change) < 1e-10 * size) return;
  bool is_news = false;
  for (const Real bearable : {0.01, 0.03, 0.1, 0.3, 1.0})
    if (!(std::abs(error) < bearable))
      is_news |= said_.insert(fmt::format("energy balance {}", bearable)).second;
  if (!is_news) return;
  say_(fmt::format(
      "t = {:.6g}: the energy balance is off by {:.3g} % of the energy exchanged so far; the step "
      "is too long (lower time.{}) or the motion is not resolved by the particles",
      simulation_->state().time, 100 * error,
      simulation_->stepper().implicit() ? "step" : "safety"));
}

template <int D>
void Warnings<D>::impossible_areas() {
  constexpr Real bearable = 0.02;
  const Motion motion = simulation_->state().motion();
  for (const Enclosure& e : enclosures_) {
    const std::string kind = "area of " + e.body;
    if (said_.contains(kind)) continue;
    const Real area = e.area->compute(motion), volume = e.volume->compute(motion);
    const int space = simulation_->scene().system.bodies.front().space();
    const Real least = area / isoperimetric_ratio(area, volume, space);
    if (area > (1 - bearable) * least) continue;
    said_.insert(kind);
    say_(fmt::format(
        "t = {:.6g}: body '{}' has the {} {:.4g}, below the least possible {:.4g} for its {}: the "
        "surface is no longer resolved (finer particles, a larger support_factor, or a reference "
        "shape nearer to the present one)",
        simulation_->state().time, e.body, space == 3 ? "surface area" : "circumference", area,
        least, space == 3 ? "volume" : "area"));
  }
}

template class Warnings<2>;
template class Warnings<3>;

}  // namespace meniscus
