// SPDX-License-Identifier: BSD-3-Clause
// Face cells from the outer facets of nodal cells.
#include "body/surface/face_cells.hpp"

#include "meniscus/error.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <map>
#include <numeric>

namespace meniscus {
namespace {

/// The facet of the boundary at a side of a cell; facets are ordered by cell and side.
template <int D>
const Facet<D>& facet_at(const Grid<D>& grid, Index cell, int side) {
  return *std::lower_bound(grid.facets.begin(), grid.facets.end(), std::pair(cell, side),
                           [](const Facet<D>& facet, const std::pair<Index, int>& wanted) {
                             return std::pair(facet.cell, facet.side) < wanted;
                           });
}

template <int D>
class Chooser {
 public:
  Chooser(const Body<D>& body, const FaceChoice& choice) : body_(body), choice_(choice) {}

  bool operator()(const Facet<D>& facet, const CellQuadrature<D>& q,
                  const typename CellQuadrature<D>::BodyFacet& part) const {
    if (!choice_.face.empty() &&
        (facet.patch < 0 || body_.geometry.surface->face_name(facet.patch) != choice_.face))
      return false;
    if (!choice_.where) return true;
    Vec<D> middle = Vec<D>::Zero();
    for (std::size_t p = part.begin; p < part.end; ++p) middle += q.facet_X[p];
    return (*choice_.where)(spatial<D>(middle / static_cast<Real>(part.end - part.begin))) != 0;
  }

 private:
  const Body<D>& body_;
  const FaceChoice& choice_;
};

/// Rows of means from rows of points, entries by ascending particle.
template <int D>
void take_means(const PointRows<D>& points, FaceCells<D>& cells) {
  PointRows<D>& mean = cells.mean;
  mean.folded = points.folded;
  for (Index k = 0; k < cells.size(); ++k) {
    std::map<Index, std::array<Real, 2>> sum;  // the values, and those of the odd component
    for (Offset q = at(cells.begin, k); q < at(cells.begin, k + 1); ++q)
      for (Offset e = at(points.start, q); e < at(points.start, q + 1); ++e) {
        auto& [value, odd] = sum[at(points.particle, e)];
        value += at(cells.share, q) * at(points.value, e);
        if (points.folded) odd += at(cells.share, q) * at(points.odd_value, e);
      }
    for (const auto& [particle, values] : sum) {
      mean.particle.push_back(particle);
      mean.value.push_back(values[0]);
      if (points.folded) mean.odd_value.push_back(values[1]);
    }
    mean.start.push_back(static_cast<Offset>(mean.particle.size()));
  }
}

}  // namespace

template <int D>
Real FaceCells<D>::total_area() const {
  return std::accumulate(area.begin(), area.end(), 0.0);
}

template <int D>
FaceCells<D> face_cells(const Body<D>& body, const FaceChoice& choice) {
  const Grid<D>& grid = body.geometry.grid;
  const Chooser<D> chosen(body, choice);
  FaceCells<D> cells;
  CellQuadrature<D> q;
  for (const Index node : boundary_nodes(grid)) {
    body.cells.boundary_points(node, q);
    for (std::size_t p = 0; p < q.facet_X.size(); ++p) q.facet_dA[p] *= circle(grid, q.facet_X[p]);
    std::map<int, std::vector<std::size_t>> points;  // [patch] numbers of its points
    for (const auto& part : q.body_facets) {
      const Facet<D>& facet = facet_at(grid, part.cell, part.side);
      if (!chosen(facet, q, part)) continue;
      cells.parts.push_back({static_cast<Index>(&facet - grid.facets.data()), node});
      for (std::size_t p = part.begin; p < part.end; ++p) points[facet.patch].push_back(p);
    }
    for (const auto& [patch, own] : points) {
      Real area = 0;
      Vec<D> normal = Vec<D>::Zero(), centre = Vec<D>::Zero();
      for (const std::size_t p : own) {
        const Real dA = q.facet_dA[p].norm();
        area += dA;
        normal += q.facet_dA[p];
        centre += dA * q.facet_X[p];
      }
      for (const std::size_t p : own) {
        const Real dA = q.facet_dA[p].norm();
        cells.X.push_back(q.facet_X[p]);
        cells.N.push_back(q.facet_dA[p] / dA);
        cells.share.push_back(dA / area);
      }
      cells.cell.push_back(node);
      cells.area.push_back(area);
      cells.normal.push_back(normal / area);
      cells.centre.push_back(centre / area);
      cells.begin.push_back(static_cast<Offset>(cells.X.size()));
    }
  }
  if (cells.cell.empty())
    throw InputError(fmt::format("no facet of the surface of body '{}' is chosen", body.name));
  take_means(build_point_rows<D>(body.particles, cells.X, {.value = true}, body.name), cells);
  return cells;
}

template <int D>
std::vector<std::pair<std::string, Index>> face_names(const Geometry<D>& geometry) {
  std::map<int, Index> facets;
  for (const Facet<D>& facet : geometry.grid.facets)
    if (facet.patch >= 0) ++facets[facet.patch];
  std::vector<std::pair<std::string, Index>> names;
  for (const auto& [patch, count] : facets) {
    const std::string name = geometry.surface->face_name(patch);
    const auto known = std::find_if(names.begin(), names.end(),
                                    [&, n = name](const auto& other) { return other.first == n; });
    if (name.empty()) continue;
    if (known == names.end())
      names.emplace_back(name, count);
    else
      known->second += count;
  }
  return names;
}

#define MENISCUS_INSTANTIATE(D)                                        \
  template Real FaceCells<D>::total_area() const;                      \
  template FaceCells<D> face_cells(const Body<D>&, const FaceChoice&); \
  template std::vector<std::pair<std::string, Index>> face_names(const Geometry<D>&);
MENISCUS_INSTANTIATE(2)
MENISCUS_INSTANTIATE(3)
#undef MENISCUS_INSTANTIATE

}  // namespace meniscus
