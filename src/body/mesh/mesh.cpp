// SPDX-License-Identifier: BSD-3-Clause
// Bodies made of mesh files.
#include "body/grid/simplex.hpp"
#include "body/mesh/mesh_checks.hpp"
#include "body/mesh/mesh_file.hpp"
#include "body/mesh/mesh_subdivision.hpp"
#include "body/shapes/cell_count.hpp"
#include "input/sha256.hpp"
#include "kernel/neighbor_search.hpp"
#include "meniscus/body/shapes.hpp"
#include "meniscus/error.hpp"
#include "numbers/box.hpp"
#include "numbers/dense.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <optional>
#include <utility>

namespace meniscus {
namespace {

constexpr std::string_view mesh_example[] = {"file = \"plate.msh\"\n", "file = \"block.msh\"\n"};

/// A body with the cells of a mesh file.
template <int D>
struct Mesh {
  static constexpr const char* name = "mesh";
  static constexpr const char* meaning = D == 3
                                             ? "hexahedra or tetrahedra of a .msh or .vtu file"
                                             : "quadrilaterals or triangles of a .msh or .vtu file";
  static constexpr std::string_view example = mesh_example[D - 2];
  std::string file;  ///< path; relative paths start at the folder of the scene
  std::string text;  ///< content of the file
  std::optional<Real> unit;
  std::string facets;
  int halvings = 0;  ///< how often the edges of its cells are halved

  static Rows<Mesh> rows();
  Geometry<D> geometry() const;
};

/// The folder of the scene file that a table is in.
std::filesystem::path folder_of(const Block& block) {
  std::string place = block.place();
  place.resize(place.rfind(block.path()));
  for (int part = 0; part < 3; ++part) place.resize(std::min(place.rfind(':'), place.size()));
  return std::filesystem::path(place).parent_path();
}

template <int D>
Rows<Mesh<D>> Mesh<D>::rows() {
  return {{"file", "text", "", "", "required",
           "a Gmsh mesh (.msh, version 2.2 or 4.1) or an unstructured grid of VTK (.vtu); "
           "from the folder of the scene on",
           [](Mesh& m, const Block& block) {
             m.file = block.text("file", {});
             if (m.file.empty()) return;
             m.file = (folder_of(block) / m.file).string();
             try {
               m.text = text_of_mesh_file(m.file);
             } catch (const InputError& error) {
               block.problem("file", error.what());
             }
           }},
          {"sha256", "text", "", "", "that of the file",
           "digest that the file must have, as sha256sum prints it; a run is continued with the "
           "file that it began with only",
           [](Mesh& m, const Block& block) {
             const std::string digest = sha256(m.text), given = block.text("sha256", digest);
             if (!m.text.empty() && given != digest)
               block.problem("sha256", fmt::format("is {}, but that of '{}' is {}; expected is the "
                                                   "file that the digest is of",
                                                   given, m.file, digest));
           }},
          {"unit", "number", rows::si_symbol(dimension::length), "> 0", "that of the scene",
           "length of 1 in the file, e.g. \"1 mm\"",
           [](Mesh& m, const Block& block) {
             if (block.has("unit"))
               m.unit = block.real("unit", dimension::length, range::positive, {});
           }},
          choice_row("facets", &Mesh::facets, {"curved", "flat"},
                     "the surface goes through the nodes as a smooth one does between sharp edges, "
                     "where no cell folds by that; or its facets are flat",
                     "curved")};
}

constexpr bool is_solid(MeshShape shape, int D) {
  return D == 3 ? shape >= MeshShape::tetrahedron
                : shape == MeshShape::triangle || shape == MeshShape::quadrilateral;
}

const char* plural(MeshShape shape) {
  constexpr std::array<const char*, 5> names{"lines", "triangles", "quadrilaterals", "tetrahedra",
                                             "hexahedra"};
  return at(names, static_cast<int>(shape));
}

/// The kind of cell of which the body consists. Throws InputError if the file mixes kinds.
template <int D>
MeshShape only_shape(const MeshData& data) {
  const MeshCell* first = nullptr;
  bool surface = false;
  for (const MeshCell& cell : data.cells) {
    surface = surface || (D == 3 && is_solid(cell.shape, 2));
    if (D == 2 && is_solid(cell.shape, 3))
      throw InputError(
          fmt::format("{} is of {}; expected are triangles or quadrilaterals, for the "
                      "scene has dimension = 2",
                      cell.where, plural(cell.shape)));
    if (!is_solid(cell.shape, D)) continue;
    if (!first) first = &cell;
    if (cell.shape != first->shape)
      throw InputError(
          fmt::format("{} is of {}, but {} is of {}; expected are cells of one kind (gmsh: either "
                      "recombine all of them or none)",
                      cell.where, plural(cell.shape), first->where, plural(first->shape)));
  }
  if (first) return first->shape;
  if (surface)
    throw InputError(
        "it has a surface only; expected are hexahedra or tetrahedra, with which "
        "tools/mesh fills a closed surface");
  throw InputError(D == 3 ? "it has no hexahedra or tetrahedra; expected are some"
                          : "it has no quadrilaterals or triangles; expected are some");
}

/// Builds a body from the data of a mesh file.
template <int D>
class MeshMaker {
 public:
  MeshMaker(const MeshData& data, Real unit, int halvings) : data_(data), halvings_(halvings) {
    const MeshShape shape = only_shape<D>(data);
    const auto cells = std::count_if(data.cells.begin(), data.cells.end(),
                                     [&](const MeshCell& c) { return c.shape == shape; });
    require_affordable<D>(std::ldexp(Real(cells), D * halvings), Real(cells) / Real(data.X.size()));
    if constexpr (D == 2) require_flat();
    number_.assign(data.X.size(), -1);
    for (const MeshCell& cell : data.cells)
      if (cell.shape == shape) add(cell, unit);
    require_distinct();
    for (std::size_t e = 0; e < grid_.cells.size(); ++e) orient(static_cast<Index>(e));
    require_simple_body<D>(grid_, [&](Index e) { return at(cell_of_, e)->where; });
    note_middles(unit);
    for (const MeshCell& cell : data.cells)
      if (cell.shape < shape && !cell.group.empty())
        if (const auto key = own_nodes(cell.corners)) given_.face[*key] = cell.group;
    if (given_.regions == std::vector<std::string>{""}) given_.regions.clear();
  }

  Geometry<D> geometry(MeshFacets facets) && {
    Geometry<D> geometry = mesh_geometry(std::move(grid_), given_, facets);
    for (int k = 0; k < halvings_; ++k) {
      MeshParts<D> fine = halved(geometry, given_);
      given_ = std::move(fine.given);
      geometry = mesh_geometry(std::move(fine.grid), given_, facets);
    }
    return geometry;
  }

 private:
  void require_flat() const {
    Box<3> box;
    for (const MeshCell& cell : data_.cells)
      for (const Index node : cell.corners) box.include(at(data_.X, node));
    if (box.extent()[2] > 1e-9 * box.extent().maxCoeff())
      throw InputError(
          fmt::format("its z goes from {:.6g} to {:.6g}; expected is one z, for the "
                      "scene has dimension = 2",
                      box.low[2], box.high[2]));
  }

  void add(const MeshCell& cell, Real unit) {
    std::array<Index, Grid<D>::corners> nodes{};
    for (std::size_t a = 0; a < cell.corners.size(); ++a) {
      Index& number = at(number_, cell.corners[a]);
      if (number < 0) {
        number = grid_.node_count();
        grid_.X.push_back(unit * at(data_.X, cell.corners[a]).template head<D>());
        first_of_.push_back(&cell);
      }
      nodes[a] = number;
    }
    if (static_cast<int>(cell.corners.size()) == D + 1) {
      std::array<Index, D + 1> simplex;
      std::copy_n(nodes.begin(), D + 1, simplex.begin());
      grid_.cells.push_back(collapsed(simplex));
    } else {  // from the order of VTK to tensor order
      typename Grid<D>::Cell& own = grid_.cells.emplace_back();
      for (int a = 0; a < Grid<D>::corners; ++a) at(own, a ^ ((a >> 1) & 1)) = at(nodes, a);
    }
    cell_of_.push_back(&cell);
    given_.region_of.push_back(region_number(cell.group));
  }

  int region_number(const std::string& name) {
    const auto [known, is_new] = region_.try_emplace(name, std::ssize(given_.regions));
    if (is_new) given_.regions.push_back(name);
    return known->second;
  }

  /// Throws InputError if two nodes of the grid have the same position.
  void require_distinct() const {
    const NeighborSearch<D> search(grid_.X);
    const Real least = 1e-9 * box_around<D>(grid_.X).extent().norm();
    std::vector<Index> near;
    for (Index i = 0; i < grid_.node_count(); ++i) {
      search.within(at(grid_.X, i), least, near);
      if (near.size() > 1)
        throw InputError(fmt::format(
            "a node of {} and one of {} are at the same place; expected is one node, which cells "
            "share (gmsh: Coherence Mesh)",
            at(first_of_, near[0])->where, at(first_of_, near[1])->where));
    }
  }

  /// Reorders the nodes of a left-handed cell.
  void orient(Index e) {
    if (!find_fold(grid_, e)) return;
    typename Grid<D>::Cell& cell = at(grid_.cells, e);
    const typename Grid<D>::Cell given = cell;
    if (is_simplex<D>(cell)) {
      std::swap(cell[0], cell[1]);
    } else {
      for (int a = 0; a < Grid<D>::corners; ++a) at(cell, a) = at(given, a ^ (1 << (D - 1)));
    }
    const auto fold = find_fold(grid_, e);
    if (!fold) return;
    cell = given;
    throw InputError(fmt::format(
        "{} is folded: its Jacobian is not positive at ({:.6g}, {:.6g}{}), nor is it when turned "
        "round; expected is a cell whose sides do not cross",
        at(cell_of_, e)->where, fold->X[0], fold->X[1],
        D == 3 ? fmt::format(", {:.6g}", fold->X[D - 1]) : ""));
  }

  /// Numbers of these nodes in the grid, ascending. Empty if a node is not a corner of the body.
  std::optional<std::vector<Index>> own_nodes(const std::vector<Index>& nodes) const {
    std::vector<Index> own;
    for (const Index node : nodes) {
      if (at(number_, node) < 0) return {};
      own.push_back(at(number_, node));
    }
    std::sort(own.begin(), own.end());
    return own;
  }

  void note_middles(Real unit) {
    for (const auto& [corners, node] : data_.middles)
      if (const auto key = own_nodes(corners))
        given_.middle[*key] = unit * at(data_.X, node).template head<D>();
  }

  const MeshData& data_;
  int halvings_;
  Grid<D> grid_;
  std::vector<Index> number_;              ///< [node of the file] number in the grid
  std::vector<const MeshCell*> cell_of_;   ///< [cell] cell of the file
  std::vector<const MeshCell*> first_of_;  ///< [node] a cell of the file with this node
  std::map<std::string, int> region_;      ///< numbers of the regions by their names
  MeshSurface<D> given_;
};

template <int D>
Geometry<D> Mesh<D>::geometry() const {
  const MeshData data = read_mesh(text, file);
  try {
    return MeshMaker<D>(data, unit.value_or(1), halvings)
        .geometry(facets == "flat" ? MeshFacets::flat : MeshFacets::curved);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", file, error.what()));
  }
}

const bool mesh_registered = register_shape<3, Mesh<3>>() && register_shape<2, Mesh<2>>();

}  // namespace
}  // namespace meniscus
