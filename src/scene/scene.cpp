// SPDX-License-Identifier: BSD-3-Clause
// Building what a scene says: one short block per kind of table.
#include "meniscus/scene/scene.hpp"

#include "meniscus/body/ordering.hpp"
#include "meniscus/body/surface_points.hpp"
#include "meniscus/body/wall_supports.hpp"
#include "meniscus/physics/body_force.hpp"
#include "meniscus/physics/cavity.hpp"
#include "meniscus/physics/coefficient_damping.hpp"
#include "meniscus/physics/surface_tension.hpp"
#include "meniscus/solve/cell_measures.hpp"
#include "meniscus/solve/drop_measures.hpp"
#include "meniscus/solve/shape_measures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "plan.hpp"

namespace meniscus {
namespace {

/// Mean edge of a cell.
template <int D>
Real spacing_of(const Geometry<D>& geometry) {
  return mean_spacing(geometry.grid);
}

template <int D>
ParticleSet<D> make_particles(const BodySettings& settings, const Geometry<D>& geometry) {
  Window window{};
  for (std::size_t k = 0; k < window_names.size(); ++k)
    if (window_names[k] == settings.window) window = static_cast<Window>(k);
  if (settings.support_spacings > 0)
    return {geometry.grid.X, settings.support_spacings * spacing_of(geometry), window};
  typename ParticleSet<D>::AdaptiveSupport rule;
  rule.factor = settings.support_factor;
  if (settings.support_rank > 0) rule.rank = settings.support_rank;
  return {geometry.grid.X, rule, window};
}

/// Where the deficiency monitor looks: particles, cell centres, and a point per surface facet.
template <int D>
std::vector<Vec<D>> probe_points(const Geometry<D>& geometry) {
  std::vector<Vec<D>> points = geometry.grid.X;
  const auto centres = cell_gauss_points(geometry.grid, 1).X;
  points.insert(points.end(), centres.begin(), centres.end());
  const auto surface = surface_points(geometry, 1);
  points.insert(points.end(), surface.X.begin(), surface.X.end());
  return points;
}

template <int D>
void build_body(typename Plan<D>::PlannedBody& planned, Scene<D>& scene) {
  const std::string& name = planned.settings.name;
  order_spatially(planned.geometry);
  ParticleSet<D> particles = make_particles(planned.settings, planned.geometry);
  const WallReport wall = keep_supports_in_wall(particles, planned.geometry);
  if (wall.shortened > 0)
    scene.notes.push_back(
        fmt::format("body '{}': the supports of {} of {} particles were shortened, to {:.0f} % at "
                    "least, to end "
                    "before the other side of the cavity",
                    name, wall.shortened, particles.size(), 100 * wall.least_share));
  if (wall.least_share < 0.6)
    scene.warnings.push_back(fmt::format(
        "body '{}': the cavity is narrow for the distance of the particles, {:.0f} % of a support "
        "are left; use a finer spacing",
        name, 100 * wall.least_share));
  const Index enlarged = particles.ensure_quality(probe_points(planned.geometry), name);
  if (enlarged > 0)
    scene.warnings.push_back(fmt::format(
        "body '{}': the supports of {} of {} particles were enlarged, their moment matrices were "
        "poorly conditioned",
        name, enlarged, particles.size()));

  Body<D>& body =
      scene.system.bodies.emplace_back(name, std::move(planned.geometry), std::move(particles));
  body.first = scene.system.size();
  body.at_particles =
      build_point_rows<D>(body.particles, body.particles.X(), {.value = true}, body.name);
  auto built =
      planned.material->build(body, {planned.settings.integration, planned.settings.gauss_points,
                                     planned.settings.volumetric, planned.enclosed});
  scene.system.mass.insert(scene.system.mass.end(), body.mass.begin(), body.mass.end());
  scene.notes.push_back(fmt::format(
      "body '{}': {} particles, {} cells, mean spacing {:.4g} {}, {:.1f} neighbours per particle, "
      "{:.1f} pairs per particle, {:.1f} MB for the internal force",
      name, body.size(), body.geometry.grid.cell_count(), spacing_of(body.geometry),
      scene.units.symbol(dimension::length),
      static_cast<Real>(body.at_particles.entries()) / body.size(),
      static_cast<Real>(built.force->pairs()) / body.size(),
      1e-6 * static_cast<Real>(built.force->bytes())));
  if (built.cell_average)
    scene.notes.push_back(
        fmt::format("body '{}': the volume change is averaged over each nodal cell (volumetric = "
                    "\"cell_average\")",
                    name));
  if (built.mass.raised > 0)
    scene.notes.push_back(
        fmt::format("body '{}': the masses of {} particles were raised to 0.3 of their cells, the "
                    "total by {:.2g}",
                    name, built.mass.raised, built.mass.added));
  if (built.note) scene.notes.push_back(fmt::format("body '{}': {}", name, *built.note));
  if (planned.settings.integration == "nodal")
    scene.warnings.push_back(
        fmt::format("body '{}': integration = \"nodal\" has modes without energy and is unstable; "
                    "for comparison "
                    "only",
                    name));

  auto fields = built.force->fields();
  for (MeasureSource& m : built.force->measures()) {
    m.name = name + "." + m.name;
    scene.measures.push_back(std::move(m));
  }
  for (MeasureSource& m : shape_measures(body)) {
    m.name = name + "." + m.name;
    scene.measures.push_back(std::move(m));
  }
  for (MeasureSource& m : cell_measures(body, 1e-6 / scene.units.in_si(dimension::length))) {
    m.name = name + "." + m.name;
    scene.measures.push_back(std::move(m));
  }
  scene.fields.push_back(std::move(fields));
  scene.viscosity.push_back(std::move(built.viscosity));
  scene.system.terms.push_back(std::move(built.force));
}

template <int D>
void build_cavities(const Plan<D>& plan, Scene<D>& scene) {
  for (const CavitySettings& settings : plan.cavities) {
    const Body<D>& body = body_named(scene.system, settings.body);
    auto term = cavity(
        body, settings.surface == "inner" ? SurfacePart::inner : SurfacePart::outer,
        {settings.pressure, settings.volume_target, settings.penalty.value_or(0), settings.ramp},
        settings.points);
    for (MeasureSource& m : term->measures()) {
      m.name = body.name + "." + m.name;
      scene.measures.push_back(std::move(m));
    }
    scene.system.terms.push_back(std::move(term));
  }
  if constexpr (D == 3)
    for (const ProfileSettings& settings : plan.profiles) {
      const Body<D>& body = body_named(scene.system, settings.body);
      MeasureSource m = profile_rms(body, settings.r, settings.z);
      m.name = body.name + "." + m.name;
      scene.measures.push_back(std::move(m));
    }
}

template <int D>
std::unique_ptr<ForceTerm> tension_of(const Body<D>& body, const TensionSettings& tension) {
  if (tension.form == "balanced") return balanced_surface_tension(body, tension.gamma);
  if (tension.form == "weak") return weak_surface_tension(body, tension.gamma, tension.points);
  if (tension.form == "curvature")
    return curvature_surface_tension(body, tension.gamma, tension.points);
  return triangle_surface_tension(body, tension.gamma);
}

template <int D>
void add_measures(const Body<D>& body, std::vector<MeasureSource> measures, Scene<D>& scene) {
  for (MeasureSource& m : measures) {
    m.name = body.name + "." + m.name;
    scene.measures.push_back(std::move(m));
  }
}

template <int D>
std::function<Real(const Motion&)> measure_named(const Scene<D>& scene, const std::string& name) {
  const auto found = std::find_if(scene.measures.begin(), scene.measures.end(),
                                  [&](const MeasureSource& m) { return m.name == name; });
  return found->compute;
}

template <int D>
void build_tensions(const Plan<D>& plan, Scene<D>& scene) {
  for (const TensionSettings& tension : plan.tensions) {
    const Body<D>& body = body_named(scene.system, tension.body);
    const auto same = [&](const Body<D>& other) { return &other == &body; };
    const auto number = std::find_if(scene.system.bodies.begin(), scene.system.bodies.end(), same) -
                        scene.system.bodies.begin();
    const std::vector<Real>& viscosity = at(scene.viscosity, number);
    auto term = tension_of(body, tension);
    add_measures(body, term->measures(), scene);
    add_measures(body, drop_measures(body, viscosity, tension.gamma), scene);
    scene.system.terms.push_back(std::move(term));
    const auto viscous = [](Real mu) { return mu > 0; };
    if (tension.form == "balanced" && tension.coefficient_damping > 0 &&
        std::any_of(viscosity.begin(), viscosity.end(), viscous))
      scene.system.terms.push_back(
          coefficient_damping(body, viscosity, tension.coefficient_damping));
    if (!viscosity.empty())
      scene.drops.push_back({&body, tension.gamma, measure_named(scene, body.name + ".area"),
                             measure_named(scene, body.name + ".volume"),
                             tension.form == "triangles"});
  }
}

template <int D>
void build_loads(const Plan<D>& plan, Scene<D>& scene) {
  build_tensions(plan, scene);
  build_cavities(plan, scene);
  for (const BodyForceSettings& load : plan.body_forces)
    scene.system.terms.push_back(
        body_force(body_named(scene.system, load.body), load.acceleration));
  for (const ExactSettings& exact : plan.exact) {
    const Body<D>& body = body_named(scene.system, exact.body);
    MeasureSource m = state_error(body, {exact.displacement, exact.velocity, exact.rate});
    m.name = body.name + "." + m.name;
    scene.measures.push_back(std::move(m));
  }
}

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
    for (Index A = 0; A < body.size(); ++A) {
      const Eigen::Vector3d X = spatial<D>(at(body.particles.X(), A));
      for (int i = 0; i < D; ++i) {
        if (!settings.initial_displacement.empty())
          at(state.u, body.first + A).set(i, at(settings.initial_displacement, i)(X));
        if (!settings.initial_velocity.empty())
          at(state.v, body.first + A).set(i, at(settings.initial_velocity, i)(X));
      }
    }
  }
}

/// Bodies that share space: particles of one closer to one of the other than half its spacing.
template <int D>
void warn_of_overlaps(Scene<D>& scene) {
  const auto& bodies = scene.system.bodies;
  for (std::size_t a = 0; a < bodies.size(); ++a)
    for (std::size_t b = a + 1; b < bodies.size(); ++b) {
      const Real near = 0.5 * spacing_of(bodies[b].geometry);
      Index count = 0;
      for (const Vec<D>& X : bodies[a].particles.X())
        count += bodies[b].particles.search().distance_of_nearest(X, 1) < near;
      if (count > 0)
        scene.warnings.push_back(
            fmt::format("bodies '{}' and '{}' overlap: {} particles of the first "
                        "lie within half a spacing of the second",
                        bodies[a].name, bodies[b].name, count));
    }
}

}  // namespace

int scene_dimension(const SceneInput& input) {
  const auto dimension = input.root().integer("dimension", {2, 3}, std::nullopt);
  if (dimension != 2 && dimension != 3) input.check();
  return static_cast<int>(dimension);
}

template <int D>
Scene<D> build_scene(const SceneInput& input) {
  Scene<D> scene;
  Plan<D> plan = read_plan(input, scene);
  for (auto& body : plan.bodies) build_body<D>(body, scene);
  build_loads(plan, scene);
  set_initial_state(plan, scene);
  build_contacts(plan, scene);
  warn_of_overlaps(scene);
  return scene;
}

template Scene<2> build_scene<2>(const SceneInput&);
template Scene<3> build_scene<3>(const SceneInput&);

}  // namespace meniscus
