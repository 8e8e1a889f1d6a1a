// SPDX-License-Identifier: BSD-3-Clause
// Stepper "newton": load steps of solids, or the flow of fluids to rest.
#include "solve/newton/flow_to_rest.hpp"
#include "solve/newton/quasi_statics.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace meniscus {
namespace {

template <int D>
bool is_inviscid(System<D>& system, const Body<D>& body) {
  constexpr Real round_off = 1e-12;
  const ElasticModuli at_rest = elastic_moduli(system, body),
                      sheared = elastic_moduli(system, body, 1);
  return sheared.shear - at_rest.shear <= round_off * at_rest.lame;
}

/// Of a force without a potential: what would give it one.
std::string remedy_of(const std::string& term) {
  if (!term.starts_with("traction")) return "";
  return "an even pressure has an energy on a closed face, or on a face whose whole edge lies on "
         "other faces "
         "that are [[held]] without displacement, in all components or along the axis normal to "
         "the plane of "
         "the edge; hold them so, or ";
}

template <int D>
std::unique_ptr<Stepper<D>> make(System<D>& system, const StepperChoice& choice) {
  const auto refuse = [&](const std::string& what) {
    throw InputError(choice.place + ": \"newton\" looks for states of least energy; " + what);
  };
  for (std::size_t b = 0; b < choice.fluid.size(); ++b)
    if (choice.fluid[b] && is_inviscid(system, system.bodies[b]))
      refuse(
          fmt::format("body '{}' is a fluid without viscosity, whose flow to rest nothing resists; "
                      "give its material a viscosity, which changes the way but not the rest, or "
                      "use \"relax\"",
                      system.bodies[b].name));
  for (const Unknown& field : system.fields)
    refuse(fmt::format("the field '{}' is another unknown beside the displacement; use \"relax\"",
                       field.spec.name));
  const NodalVectors rest(static_cast<std::size_t>(system.size()), Lanes::zero());
  for (auto& term : system.terms)
    if (!term->potential({0, rest, rest, system.fields}))
      refuse(
          fmt::format("the force of {} is not the gradient of an energy, so that there is no "
                      "least one; {}use \"relax\"",
                      term->name(), remedy_of(term->name())));
  if (std::find(choice.fluid.begin(), choice.fluid.end(), true) != choice.fluid.end())
    return std::make_unique<FlowToRest<D>>(system, choice);
  return std::make_unique<QuasiStatics<D>>(system, choice);
}

const bool registered =
    register_entry(StepperEntry{"newton", {"energy_left", "stability", "jumps"}, make<2>, make<3>});

}  // namespace

}  // namespace meniscus
