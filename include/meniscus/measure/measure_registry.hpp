// SPDX-License-Identifier: BSD-3-Clause
// Registry of the measures of bodies.
//
// A group of measures has a file of its own, which ends with
//
//   const bool registered = register_measures("name", my_measures<2>, my_measures<3>);
#pragma once
#include "body/body.hpp"
#include "input/registry.hpp"
#include "meniscus/physics/force_term.hpp"

#include <string_view>
#include <vector>

namespace meniscus {

/// Returns the measures of a body, or none if they do not apply to it. Costly parts are built at
/// the first evaluation, when `body` must be complete.
template <int D>
using MeasureMaker = std::vector<MeasureSource> (*)(const Body<D>& body, const UnitSystem& units);

template <int D>
struct MeasureEntry {
  static constexpr const char* kind = "group of measures";
  std::string_view name;
  MeasureMaker<D> make;
};

template <int D>
const Registry<MeasureEntry<D>>& measures() {
  return Registry<MeasureEntry<D>>::all();
}

/// Registers makers of measures in 2D and 3D; null if there are none in that dimension.
inline bool register_measures(std::string_view name, MeasureMaker<2> plane, MeasureMaker<3> space) {
  if (plane) register_entry(MeasureEntry<2>{name, plane});
  if (space) register_entry(MeasureEntry<3>{name, space});
  return true;
}

}  // namespace meniscus
