// SPDX-License-Identifier: BSD-3-Clause
// Result frames of bodies of revolution as 3D surfaces.
#include "app/revolved_frames.hpp"

#include <cmath>
#include <deque>
#include <numbers>

namespace meniscus {
namespace {

constexpr Index turns = 48;

/// Scalars, or vectors of the half plane as vectors of space, at the images of particles.
std::vector<Real> turned(std::span<const Real> values, int components,
                         const std::vector<std::vector<Index>>& bodies) {
  std::vector<Real> all;
  for (const std::vector<Index>& particles : bodies)
    for (Index k = 0; k < turns; ++k) {
      const Real angle = 2 * std::numbers::pi * static_cast<Real>(k) / turns;
      for (const Index A : particles) {
        const Real* value = &at(values, A * components);
        if (components == 1)
          all.push_back(value[0]);
        else
          all.insert(all.end(), {value[0] * std::cos(angle), value[1], value[0] * std::sin(angle)});
      }
    }
  return all;
}

/// Quadrilaterals between neighbouring images of the edges of a section with `count` particles.
std::vector<Index> quadrilaterals(const std::vector<std::array<Index, 2>>& edges, Index count) {
  std::vector<Index> corners;
  for (Index k = 0; k < turns; ++k) {
    const Index here = k * count, next = (k + 1) % turns * count;
    for (const auto& [a, b] : edges)
      corners.insert(corners.end(), {here + a, here + b, next + b, next + a});
  }
  return corners;
}

}  // namespace

template <int D>
RevolvedFrames<D>::RevolvedFrames(const Simulation<D>& simulation, const RunDirectory& directory,
                                  const Provenance& provenance, bool continued) {
  const Scene<D>& scene = simulation.scene();
  if (!scene.output.revolved) return;
  std::deque<std::vector<Real>> X;
  std::deque<std::vector<Index>> cells;
  std::vector<BodyReference> surfaces;
  for (const Body<D>& body : scene.system.bodies) {
    std::vector<Index>& particles = on_surface_.emplace_back();
    std::vector<Index> number(static_cast<std::size_t>(body.size()), -1);
    std::vector<std::array<Index, 2>> edges;
    std::vector<Real> section;
    for (const auto& facet : body.geometry.grid.facets) {
      for (int k = 0; k < 2; ++k) {
        const Index A = at(facet.nodes, k);
        if (at(number, A) >= 0) continue;
        at(number, A) = static_cast<Index>(particles.size());
        particles.push_back(body.first + A);
        section.insert(section.end(), {at(body.particles.X(), A)[0], at(body.particles.X(), A)[1]});
      }
      edges.push_back({at(number, at(facet.nodes, 0)), at(number, at(facet.nodes, 1))});
    }
    const auto count = static_cast<Index>(particles.size());
    std::vector<Index> all(particles.size());
    for (Index k = 0; k < count; ++k) at(all, k) = k;
    X.push_back(turned(section, 2, {all}));
    cells.push_back(quadrilaterals(edges, count));
    surfaces.push_back({body.name,
                        {{"X", 3, scene.units.symbol(dimension::length), X.back()}},
                        4,
                        cells.back(),
                        {}});
  }
  ResultOptions options;
  options.name = "revolved";
  options.time_unit = scene.units.symbol(dimension::time);
  if (continued) options.continue_after = simulation.state().step;
  file_ = std::make_unique<ResultFile>(directory, provenance, surfaces, options);
}

template <int D>
void RevolvedFrames<D>::write(std::int64_t step, Real time, std::span<const ResultField> fields) {
  if (!file_) return;
  std::deque<std::vector<Real>> storage;
  std::vector<ResultField> all;
  for (const ResultField& field : fields)
    if (field.components <= 2)
      all.push_back({field.name, field.components == 1 ? 1 : 3, field.unit,
                     storage.emplace_back(turned(field.values, field.components, on_surface_))});
  file_->write_frame(step, time, all);
}

template class RevolvedFrames<2>;
template class RevolvedFrames<3>;

}  // namespace meniscus
