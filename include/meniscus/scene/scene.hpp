// SPDX-License-Identifier: BSD-3-Clause
// From a scene file to bodies, force terms and an initial state. The only place that knows all
// kinds of terms.
#pragma once
#include "meniscus/scene/settings.hpp"
#include "meniscus/solve/system.hpp"

#include <string>
#include <vector>

namespace meniscus {

/// A body of fluid under surface tension.
template <int D>
struct Drop {
  const Body<D>* body;
  Real gamma;
  std::function<Real(const Motion&)> area, volume;  ///< those of the forces
  bool inscribed;  ///< the area is of a polyhedron inside: smaller than what encloses the volume
};

template <int D>
struct Scene {
  std::string title;
  UnitSystem units;
  TimeSettings time;
  OutputSettings output;
  System<D> system;
  State initial;
  std::vector<std::vector<Real>> viscosity;  ///< [body][particle]; empty: a solid
  std::vector<Drop<D>> drops;
  bool steps_may_be_rejected = false;  ///< by a force term
  /// Measures by full name, e.g. "drop.aspect".
  std::vector<MeasureSource> measures;
  /// Fields of each body by name, in the order of the bodies.
  std::vector<std::vector<FieldSource>> fields;
  std::vector<std::pair<std::string, ExpectSettings>> expectations;
  std::vector<std::string> notes;     ///< what was decided while building, for the log
  std::vector<std::string> warnings;  ///< doubtful choices

  /// How a sum over bodies is written.
  std::string symbol_of_sum(Dimension d) const { return units.symbol(of_sum(d, D)); }
};

/// 2 or 3. Throws InputError if the scene does not say.
int scene_dimension(const SceneInput& input);

/// Reads the whole scene, then builds it. Throws InputError with all problems of the input at once,
/// SolveError if shape functions cannot be built.
template <int D>
Scene<D> build_scene(const SceneInput& input);

}  // namespace meniscus
