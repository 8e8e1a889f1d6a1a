// SPDX-License-Identifier: BSD-3-Clause
// Builds the bodies of a scene.
#include "scene/build_body.hpp"

#include "body/grid/curved_facets.hpp"
#include "body/grid/ordering.hpp"
#include "body/surface/surface_points.hpp"
#include "body/wall_supports.hpp"
#include "meniscus/measure/measure_registry.hpp"
#include "physics/internal/material.hpp"
#include "physics/internal/solid_viscosity.hpp"

#include <fmt/core.h>

#include <cmath>
#include <numeric>
#include <utility>

namespace meniscus {
namespace {

template <int D>
ParticleSet<D> make_particles(const BodySettings& settings, const Geometry<D>& geometry) {
  KernelFunction kernel_function{};
  for (std::size_t k = 0; k < kernel_function_names.size(); ++k)
    if (kernel_function_names[k] == settings.window)
      kernel_function = static_cast<KernelFunction>(k);
  // Supports follow the mean shape of the cells in round bodies only. In bodies with edges or a
  // cavity, the shape of cells serves their walls.
  const bool round = geometry.surface->smooth() && !is_hollow(geometry);
  const Mat<D> stretch = round ? mean_stretch(geometry.grid) : Mat<D>(Mat<D>::Identity());
  const ParticleCloud<D> cloud(geometry.grid.X, geometry.grid.revolved);
  if (settings.support_spacings > 0)
    return {cloud, settings.support_spacings * mean_spacing(geometry.grid), kernel_function,
            stretch};
  if (settings.support_by == "cells")
    return {cloud, supports_by_cells(geometry.grid, stretch, settings.support_factor.value()),
            kernel_function, stretch};
  typename ParticleSet<D>::AdaptiveSupport rule;
  rule.factor = settings.support_factor.value();
  if (settings.support_rank > 0) rule.rank = settings.support_rank;
  return {cloud, rule, kernel_function, stretch};
}

/// Points at which the quality of shape functions is checked: particles, cell centres, and one
/// point per surface facet. They follow the order of the particles, so that neighbours in the list
/// are near each other.
template <int D>
std::vector<Vec<D>> probe_points(const Geometry<D>& geometry) {
  const Grid<D>& grid = geometry.grid;
  const auto centres = cell_gauss_points(grid, 1).X;
  const auto surface = surface_points(geometry, 1).X;
  std::vector<Vec<D>> points;
  points.reserve(grid.X.size() + centres.size() + surface.size());
  std::size_t facet = 0;
  Index cell = 0;
  for (Index A = 0; A < grid.node_count(); ++A) {
    points.push_back(at(grid.X, A));
    for (; cell < grid.cell_count() && lowest_node(at(grid.cells, cell)) <= A; ++cell) {
      points.push_back(at(centres, cell));
      for (; facet < surface.size() && grid.facets[facet].cell <= cell; ++facet)
        points.push_back(surface[facet]);
    }
  }
  return points;
}

/// Particles with well-conditioned shape functions everywhere. In a hollow body, supports do not
/// reach across the cavity.
template <int D>
ParticleSet<D> sound_particles(const BodySettings& settings, const Geometry<D>& geometry,
                               Assembly<D>& assembly) {
  const std::string& name = settings.name;
  ParticleSet<D> particles = make_particles(settings, geometry);
  const WallReport wall = keep_supports_in_wall(particles, geometry);
  if (wall.shortened > 0)
    assembly.note(fmt::format(
        "body '{}': the supports of {} of {} particles were shortened, to {:.0f} % at least, to "
        "end before the other side of the cavity",
        name, wall.shortened, particles.size(), 100 * wall.least_share));
  if (wall.least_share < 0.6)
    assembly.warn(fmt::format(
        "body '{}': the cavity is narrow for the distance of the particles, {:.0f} % of a support "
        "are left; use a finer spacing",
        name, 100 * wall.least_share));
  const Index enlarged = particles.ensure_quality(probe_points(geometry), name);
  if (enlarged > 0)
    assembly.warn(fmt::format(
        "body '{}': the supports of {} of {} particles were enlarged, their moment matrices were "
        "poorly conditioned",
        name, enlarged, particles.size()));
  return particles;
}

/// Logs how many lumped masses were raised to their lower bound, and which moments were kept.
template <int D>
void report_masses(const std::string& name, const MassReport& mass, Assembly<D>& assembly) {
  if (mass.raised == 0) return;
  std::string note = fmt::format(
      "body '{}': the masses of {} particles were raised to 0.3 of their cells", name, mass.raised);
  if (mass.kept_degree >= 0)
    note += fmt::format(", the others give as much; {} kept",
                        mass.kept_degree == 2   ? "mass, first and second moments are"
                        : mass.kept_degree == 1 ? "mass and first moments are"
                                                : "the mass is");
  assembly.note(note);
  if (mass.added > 1e-3)
    assembly.warn(
        fmt::format("body '{}': the floor of the lumped masses adds {:.2g} to the total mass; use "
                    "more cells or "
                    "a smaller support_factor",
                    name, mass.added));
}

/// Nearly incompressible solids are too stiff (locking) if each stress point keeps its volume,
/// which leaves too few ways to deform: at a ratio of 25 by 5 % where a beam has two cells across.
/// Throws InputError for a rule without a remedy, and warns where the remedy is left out.
template <int D>
void look_for_locking(const Body<D>& body, const typename Material<D>::Built& built,
                      const BodySettings& settings, Assembly<D>& assembly) {
  constexpr Real locks_by_5_percent = 25, warns_from = 10;
  if (settings.integration != "q_scni" && built.bulk_over_shear > locks_by_5_percent)
    throw InputError(fmt::format(
        "{}: is '{}' for body '{}', whose bulk / shear modulus is {:.3g}; above {:g} coarse bodies "
        "are more than 5 % too stiff with it (locking); allowed is 'q_scni'",
        settings.integration_place, settings.integration, body.name, built.bulk_over_shear,
        locks_by_5_percent));
  if (built.bulk_over_shear >= warns_from &&
      (settings.volumetric == "full" || settings.integration != "q_scni"))
    assembly.warn(fmt::format(
        "body '{}': bulk / shear modulus is {:.3g}: from {:g} on coarse solids are too stiff "
        "(locking) with one volume change per stress point, by up to 25 % where a beam has two "
        "cells across, by multiples where a closed wall has three; leave out {}",
        body.name, built.bulk_over_shear, warns_from,
        settings.integration != "q_scni" ? "integration" : "volumetric"));
}

template <int D>
void report(const Body<D>& body, const typename Material<D>::Built& built,
            const BodySettings& settings, Assembly<D>& assembly) {
  const std::string& name = body.name;
  const std::vector<Offset> of_ranks = said_by_ranks(body.at_particles.entries());
  const Offset neighbours = std::accumulate(of_ranks.begin(), of_ranks.end(), Offset{0});
  assembly.note(fmt::format(
      "body '{}': {} particles, {} cells, mean spacing {:.4g} {}, {:.1f} neighbours per particle, "
      "{:.1f} pairs per particle, {:.1f} MB for the internal force",
      name, body.size(), body.geometry.grid.cell_count(), mean_spacing(body.geometry.grid),
      assembly.units().symbol(dimension::length), static_cast<Real>(neighbours) / body.size(),
      static_cast<Real>(built.force->pairs()) / body.size(),
      1e-6 * static_cast<Real>(built.force->bytes())));
  if (built.cell_average)
    assembly.note(
        fmt::format("body '{}': the volume change is averaged over each nodal cell (volumetric = "
                    "\"cell_average\")",
                    name));
  const CurvedFacets curved = curved_facets(body.geometry);
  if (std::abs(curved.added_volume) > 1e-3)
    assembly.note(fmt::format(
        "body '{}': its surface is curved between the nodes of the mesh: its volume is {:.2g} % {} "
        "than with straight facets (facets = \"flat\")",
        name, std::abs(100 * curved.added_volume), curved.added_volume > 0 ? "more" : "less"));
  if (curved.straightened > 0)
    assembly.warn(fmt::format(
        "body '{}': {} of {} facets of the mesh have a straight edge where the surface is curved, "
        "for a cell would fold otherwise; use smaller cells there, or facets = \"flat\"",
        name, curved.straightened, body.geometry.grid.facets.size()));
  report_masses(name, built.mass, assembly);
  if (built.warning) assembly.warn(fmt::format("body '{}': {}", name, *built.warning));
  if (built.note) assembly.note(fmt::format("body '{}': {}", name, *built.note));
  look_for_locking(body, built, settings, assembly);
  if (settings.integration == "nodal")
    assembly.warn(
        fmt::format("body '{}': integration = \"nodal\" has modes without energy and is unstable; "
                    "for comparison only",
                    name));
}

/// Scales the masses of a body to their sum before its remap. Masses whose sum differs by round-off
/// only are not changed.
template <int D>
void keep_mass(Body<D>& body) {
  constexpr Real round_off = 1e-13;
  for (std::vector<Real>* masses : {&body.mass, &body.mass_integral}) {
    const Real factor = body.reference->mass / std::accumulate(masses->begin(), masses->end(), 0.0);
    if (std::abs(factor - 1) <= round_off) continue;
    for (Real& mass : *masses) mass *= factor;
  }
}

}  // namespace

template <int D>
void place_body(const BodyPlan<D>& planned, const Division& division,
                std::shared_ptr<const Reference<D>> reference, Scene<D>& scene,
                Assembly<D>& assembly) {
  const BodySettings& settings = planned.settings;
  Geometry<D> geometry = reference ? reference->geometry : planned.geometry;
  if (!reference) order_spatially(geometry);
  ParticleSet<D> particles = sound_particles(settings, geometry, assembly);
  auto& bodies = scene.system.bodies;
  const Index first = bodies.empty() ? 0 : bodies.back().first + bodies.back().size();
  Body<D>& body =
      bodies.emplace_back(settings.name, std::move(geometry), std::move(particles), division);
  body.first = first;
  body.reference = std::move(reference);
  body.loaded_faces = planned.loaded_faces;
  body.wetted = planned.wetted;
  constexpr Real small = 1e-6;
  for (WettedFace<D>& face : body.wetted) face.time_step = small * assembly.end_time();
}

template <int D>
void build_rows(const BodyPlan<D>& planned, Body<D>& body) {
  body.build_values();
  if (planned.settings.integration == "q_scni")
    body.cell_rows = std::make_unique<CellRows<D>>(body, body.division.own_rows(body.size()));
}

template <int D>
std::unique_ptr<NematicBody<D>> build_body(const BodyPlan<D>& planned, Body<D>& body,
                                           Scene<D>& scene, Assembly<D>& assembly) {
  const BodySettings& settings = planned.settings;
  System<D>& system = scene.system;
  auto built = planned.material->build(
      body, {settings.integration, settings.gauss_points, settings.volumetric,
             planned.enclosed && planned.material->fluid()});
  if (body.reference) keep_mass(body);
  system.mass.insert(system.mass.end(), body.mass.begin(), body.mass.end());
  report(body, built, settings, assembly);
  scene.bodies.push_back({built.force.get(), std::move(built.viscosity), built.bulk_modulus});
  if (!planned.material->fluid())
    assembly.keep_reference(body.name, "the stress of a solid depends on its first reference");
  if (settings.integration != "q_scni")
    assembly.keep_reference(body.name, "only integration = \"q_scni\" knows J by nodal cell");
  if (is_hollow(body.geometry))
    assembly.keep_reference(body.name, "walls of a cavity are known by its shape only");
  assembly.add(std::move(built.force), body.name);
  if (planned.solid.viscosity > 0)
    assembly.add(solid_viscosity(body, planned.solid.viscosity, 0), body.name);
  for (const auto& [name, group] : measures<D>())
    for (MeasureSource& source : group.make(body, scene.units))
      assembly.measure(body.name, std::move(source));
  return std::move(built.nematic);
}

#define MENISCUS_INSTANTIATE(D)                                                                \
  template void place_body(const BodyPlan<D>&, const Division&,                                \
                           std::shared_ptr<const Reference<D>>, Scene<D>&, Assembly<D>&);      \
  template void build_rows(const BodyPlan<D>&, Body<D>&);                                      \
  template std::unique_ptr<NematicBody<D>> build_body(const BodyPlan<D>&, Body<D>&, Scene<D>&, \
                                                      Assembly<D>&);
MENISCUS_INSTANTIATE(2)
MENISCUS_INSTANTIATE(3)
#undef MENISCUS_INSTANTIATE

}  // namespace meniscus
