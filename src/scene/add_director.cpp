// SPDX-License-Identifier: BSD-3-Clause
// Makes the director of a nematic body a field of the scene.
#include "scene/add_director.hpp"

#include "physics/director/director.hpp"
#include "physics/director/frank_energy.hpp"
#include "remap/nodal_values.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace meniscus {

template <int D>
void add_director(const Body<D>& body, NematicBody<D> nematic, Scene<D>& scene,
                  Assembly<D>& assembly) {
  System<D>& system = scene.system;
  std::vector<Real> capacity(system.mass.size(), 0.0);
  for (Index A = 0; A < body.size(); ++A)
    at(capacity, body.first + A) = nematic.numbers.rotational_viscosity * at(nematic.volume, A);
  const std::size_t number =
      system.add_field({"director", D, dimension::none, Evolution::carried, 1}, capacity);
  // The scene gives values of the director at the particles, which are converted to coefficients.
  // Using values as coefficients would smooth the director.
  NodalVectors values(static_cast<std::size_t>(body.size()), Lanes::zero());
  for (Index A = 0; A < body.size(); ++A) {
    set_vector<D>(values, A, at(nematic.director, A));
    if (body.on_axis(A)) at(values, A).set(0, 0);
  }
  const NodalVectors coefficients = coefficients_of(body, values, values);
  std::copy(coefficients.begin(), coefficients.end(), system.fields[number].x.begin() + body.first);

  auto director = std::make_unique<Director<D>>(body, number, nematic);
  for (FieldSource& field : director->fields()) assembly.field(body.name, std::move(field));
  for (MeasureSource& measure : director->measures())
    assembly.measure(body.name, std::move(measure));
  assembly.note(fmt::format("body '{}': a director with the core length {:.4g} {}", body.name,
                            nematic.numbers.core_length,
                            assembly.units().symbol(dimension::length)));
  if (nematic.core_by_cells)
    assembly.length_by_cells(fmt::format("body.{}.material.core_length", body.name),
                             nematic.numbers.core_length);
  auto frank =
      std::make_unique<FrankEnergy<D>>(body, number, nematic.numbers, std::move(nematic.rule));
  director->add(*frank);
  assembly.add(std::move(frank), body.name);
  assembly.of(body.name).director = director.get();
  system.carried.push_back(std::move(director));
}

template void add_director(const Body<2>&, NematicBody<2>, Scene<2>&, Assembly<2>&);
template void add_director(const Body<3>&, NematicBody<3>, Scene<3>&, Assembly<3>&);

}  // namespace meniscus
