// SPDX-License-Identifier: BSD-3-Clause
// Registry of the measures of bodies.
//
// Measures live in a file of their own, which ends with
//   const bool registered = register_measures("name", my_measures<2>, my_measures<3>);
#pragma once
#include "meniscus/body/body.hpp"
#include "meniscus/core/registry.hpp"
#include "meniscus/physics/force_term.hpp"

#include <string_view>
#include <vector>

namespace meniscus {

/// The measures that bodies of a sort have; none for a body of another sort. Nothing that takes
/// time is built before one of them is asked for; `body` must be complete then.
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

/// Null for no measures in that dimension.
inline bool register_measures(std::string_view name, MeasureMaker<2> plane, MeasureMaker<3> space) {
  if (plane) register_entry(MeasureEntry<2>{name, plane});
  if (space) register_entry(MeasureEntry<3>{name, space});
  return true;
}

}  // namespace meniscus
