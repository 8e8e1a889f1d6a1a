// SPDX-License-Identifier: BSD-3-Clause
// Builds the objects of a scene from its plan.
#include "scene/scene.hpp"

#include "meniscus/error.hpp"
#include "scene/add_director.hpp"
#include "scene/build_body.hpp"
#include "scene/resolved_places.hpp"
#include "scene/watch_surfaces.hpp"
#include "solve/newton/tangent_factors.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace meniscus {
namespace {

template <int D>
void set_initial_state(const Plan<D>& plan, Scene<D>& scene) {
  State& state = scene.initial;
  state.u.assign(static_cast<std::size_t>(scene.system.size()), Lanes::zero());
  state.v = state.u;
  state.force = state.u;
  state.fields = scene.system.fields;
  for (std::size_t b = 0; b < plan.bodies.size(); ++b) {
    const Body<D>& body = scene.system.bodies[b];
    const BodySettings& settings = plan.bodies[b].settings;
    Real farthest = 0;
    for (Index A = 0; A < body.size(); ++A) {
      const Eigen::Vector3d X = spatial<D>(body.origin(A));
      for (int i = 0; i < D; ++i) {
        if (!settings.initial_displacement.empty())
          at(state.u, body.first + A).set(i, at(settings.initial_displacement, i)(X));
        if (!settings.initial_velocity.empty())
          at(state.v, body.first + A).set(i, at(settings.initial_velocity, i)(X));
        farthest = std::max(farthest, std::abs(X[i] + at(state.u, body.first + A)[i]));
      }
    }
    const std::string lost =
        lost_in_rounding(farthest, shortest_edge(body.geometry.grid), scene.units);
    if (!lost.empty())
      throw InputError(fmt::format("body '{}': initial_displacement: {}", body.name, lost));
  }
}

/// The own reference of a body. Null if it has the reference of the scene.
template <int D>
std::shared_ptr<const Reference<D>> reference_of(const BodyPlan<D>& body,
                                                 const References<D>& references) {
  const auto found = references.find(body.settings.name);
  return found == references.end() ? nullptr : found->second;
}

/// Divides the rows of the bodies between the ranks. Newton's method factorises the tangent of
/// small bodies on one rank, which has all rows.
template <int D>
std::vector<Division> divide_bodies(const Plan<D>& plan, const References<D>& references) {
  std::vector<Index> particles;
  for (const BodyPlan<D>& body : plan.bodies) {
    const auto reference = reference_of(body, references);
    const Geometry<D>& geometry = reference ? reference->geometry : body.geometry;
    particles.push_back(static_cast<Index>(geometry.grid.X.size()));
  }
  if (plan.time.solver == "newton" &&
      TangentFactors<D>::fits(std::accumulate(particles.begin(), particles.end(), Offset{0})))
    return std::vector<Division>(particles.size(), Division(TangentFactors<D>::rank));
  return divide(particles);
}

}  // namespace

template <int D>
const FieldSource& field_named(const Scene<D>& scene, const std::string& name) {
  for (const BodyField& field : scene.fields)
    if (field.source.name == name) return field.source;
  throw std::logic_error("no body has a field '" + name + "'");
}

template <int D>
std::vector<Real> field_values(const Scene<D>& scene, const std::string& name,
                               const Motion& motion) {
  const int components = field_named(scene, name).components;
  std::vector<Real> values(static_cast<std::size_t>(scene.system.size() * components), 0.0), part;
  for (const BodyField& field : scene.fields) {
    if (field.source.name != name) continue;
    const Body<D>& body = scene.system.bodies[field.body];
    part.resize(static_cast<std::size_t>(body.size() * components));
    field.source.compute(motion, part);
    for (std::size_t k = 0; k < part.size(); ++k)
      values[static_cast<std::size_t>(body.first * components) + k] += part[k];
  }
  return values;
}

template <int D>
void require_remappable(const Scene<D>& scene, const std::string& body) {
  for (std::size_t b = 0; b < scene.bodies.size(); ++b)
    if (const std::string& why = scene.bodies[b].kept_reference;
        scene.system.bodies[b].name == body && !why.empty())
      throw InputError(fmt::format("body '{}' cannot be remapped: {}", body, why));
}

template <int D>
Scene<D> build(const Plan<D>& plan, const References<D>& references) {
  Scene<D> scene;
  static_cast<RunSettings&>(scene) = plan;
  const bool at_reference = references.empty() && plan.initial.from.empty();
  Assembly<D> assembly(scene, at_reference);
  std::vector<std::unique_ptr<NematicBody<D>>> nematics;
  const std::vector<Division> divisions = divide_bodies(plan, references);
  auto& bodies = scene.system.bodies;
  for (std::size_t b = 0; b < divisions.size(); ++b)
    place_body(plan.bodies[b], divisions[b], reference_of(plan.bodies[b], references), scene,
               assembly);
  on_each_rank([&] {
    for (std::size_t b = 0; b < divisions.size(); ++b) build_rows(plan.bodies[b], bodies[b]);
  });
  for (std::size_t b = 0; b < divisions.size(); ++b)
    nematics.push_back(build_body(plan.bodies[b], bodies[b], scene, assembly));
  for (std::size_t b = 0; b < nematics.size(); ++b)
    if (nematics[b]) add_director(scene.system.bodies[b], std::move(*nematics[b]), scene, assembly);
  set_initial_state(plan, scene);
  for (const auto& load : plan.loads) load->build(assembly);
  assembly.withhold_caps();
  if (auto constraints = assembly.take_constraints(); !constraints.empty())
    scene.system.hold(std::move(constraints), scene.initial);
  for (const PlannedRemap& remap : scene.remaps) require_remappable(scene, remap.body);
  watch_surfaces(scene, at_reference);
  return scene;
}

template <int D>
Scene<D> build_scene(const SceneInput& input) {
  return build(read_plan<D>(input));
}

template const FieldSource& field_named(const Scene<2>&, const std::string&);
template const FieldSource& field_named(const Scene<3>&, const std::string&);
template std::vector<Real> field_values(const Scene<2>&, const std::string&, const Motion&);
template std::vector<Real> field_values(const Scene<3>&, const std::string&, const Motion&);
template void require_remappable(const Scene<2>&, const std::string&);
template void require_remappable(const Scene<3>&, const std::string&);
template Scene<2> build(const Plan<2>&, const References<2>&);
template Scene<3> build(const Plan<3>&, const References<3>&);
template Scene<2> build_scene(const SceneInput&);
template Scene<3> build_scene(const SceneInput&);

}  // namespace meniscus
