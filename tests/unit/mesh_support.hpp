// SPDX-License-Identifier: BSD-3-Clause
// Mesh files for tests: grids unchanged, or cut into tetrahedra (2D: triangles).
#pragma once
#include "geometry_of_lines.hpp"
#include "meniscus/body/shapes.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

namespace meniscus::test {

/// Corners in the order of VTK.
using CellList = std::vector<std::vector<Index>>;

template <int D>
CellList cells_of(const Grid<D>& grid) {
  CellList cells;
  for (const auto& cell : grid.cells) {
    auto& own = cells.emplace_back();
    for (int a = 0; a < Grid<D>::corners; ++a) own.push_back(at(cell, a ^ ((a >> 1) & 1)));
  }
  return cells;
}

/// Each quadrilateral is cut at its node of least number, so that neighbours have the same cut.
inline CellList simplices_of(const Grid<2>& grid) {
  CellList cells;
  for (const auto& c : grid.cells) {
    const std::vector<Index> around{c[0], c[1], c[3], c[2]};
    const auto least = std::min_element(around.begin(), around.end()) - around.begin();
    const auto n = [&](std::ptrdiff_t k) {
      return around[static_cast<std::size_t>((least + k) % 4)];
    };
    cells.push_back({n(0), n(1), n(2)});
    cells.push_back({n(0), n(2), n(3)});
  }
  return cells;
}
inline CellList simplices_of(const Grid<3>& grid) {
  constexpr int sides[6][4] = {{0, 2, 6, 4}, {1, 5, 7, 3}, {0, 4, 5, 1},
                               {2, 3, 7, 6}, {0, 1, 3, 2}, {4, 6, 7, 5}};
  CellList cells;
  for (const auto& c : grid.cells) {
    const Index apex = *std::min_element(c.begin(), c.end());
    for (const auto& side : sides) {
      std::vector<Index> around;
      for (const int a : side) around.push_back(at(c, a));
      if (std::find(around.begin(), around.end(), apex) != around.end()) continue;
      const auto least = std::min_element(around.begin(), around.end()) - around.begin();
      const auto n = [&](std::ptrdiff_t k) {
        return around[static_cast<std::size_t>((least + k) % 4)];
      };
      cells.push_back({n(0), n(1), n(2), apex});
      cells.push_back({n(0), n(2), n(3), apex});
    }
  }
  return cells;
}

template <int D>
int gmsh_type(const std::vector<Index>& cell) {
  return D == 3 ? (cell.size() == 8 ? 5 : 4) : (cell.size() == 4 ? 3 : 2);
}

/// A text mesh of Gmsh, version 2.2. `group` is the number of the physical group of a cell by its
/// middle, 0: none; `names` are those of the groups 1, 2, ...
template <int D>
std::string msh_of(const Grid<D>& grid, const CellList& cells,
                   const std::function<int(const Vec<D>&)>& group = {},
                   const std::vector<std::string>& names = {}) {
  std::string text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
  if (!names.empty()) text += fmt::format("$PhysicalNames\n{}\n", names.size());
  for (std::size_t k = 0; k < names.size(); ++k)
    text += fmt::format("{} {} \"{}\"\n", D, k + 1, names[k]);
  if (!names.empty()) text += "$EndPhysicalNames\n";
  text += fmt::format("$Nodes\n{}\n", grid.X.size());
  for (std::size_t i = 0; i < grid.X.size(); ++i) {
    const Eigen::Vector3d X = spatial<D>(grid.X[i]);
    text += fmt::format("{} {:.17g} {:.17g} {:.17g}\n", i + 1, X[0], X[1], X[2]);
  }
  text += fmt::format("$EndNodes\n$Elements\n{}\n", cells.size());
  for (std::size_t e = 0; e < cells.size(); ++e) {
    Vec<D> middle = Vec<D>::Zero();
    for (const Index node : cells[e]) middle += at(grid.X, node) / Real(cells[e].size());
    text += fmt::format("{} {} 2 {} 1", e + 1, gmsh_type<D>(cells[e]), group ? group(middle) : 0);
    for (const Index node : cells[e]) text += fmt::format(" {}", node + 1);
    text += '\n';
  }
  return text + "$EndElements\n";
}

/// A folder for the files of this process, removed at its end.
class MeshFolder {
 public:
  MeshFolder() { std::filesystem::create_directories(path_); }
  ~MeshFolder() {
    std::error_code ignored;  // an exception here would end the process
    std::filesystem::remove_all(path_, ignored);
  }
  MeshFolder(const MeshFolder&) = delete;
  MeshFolder& operator=(const MeshFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_ = std::filesystem::temp_directory_path() /
                                fmt::format("meniscus_mesh_{}", static_cast<long>(::getpid()));
};

/// Writes a file with this text, which exists until the process ends; returns its name.
inline std::string written(const std::string& name, const std::string& text) {
  static const MeshFolder folder;
  const std::filesystem::path file = folder.path() / name;
  std::ofstream(file) << text;
  return file.string();
}

/// Writes a file to the working directory of the test, where examples of keys look for it. Several
/// tests may do so at once.
inline void write_example(const std::string& name, const std::string& text) {
  const std::string unfinished = fmt::format("{}.{}", name, static_cast<long>(::getpid()));
  std::ofstream(unfinished) << text;
  std::filesystem::rename(unfinished, name);
}

/// Reads a body from a mesh file.
template <int D>
Geometry<D> geometry_of_file(const std::string& file, const std::string& more = "") {
  return geometry_of_lines<D>("shape = 'mesh'\nfile = '" + file + "'\n" + more);
}

/// A body imported from the cells of the grid, or from simplices; `more` are lines of its table.
template <int D>
Geometry<D> imported(const Grid<D>& grid, bool simplices, const std::string& more = "") {
  const std::string name = fmt::format("imported_{}_{}.msh", D, simplices);
  return geometry_of_file<D>(
      written(name, msh_of<D>(grid, simplices ? simplices_of(grid) : cells_of(grid))), more);
}

/// Lines behind those of a body: its edges are k times finer.
inline std::string refined_by(int k) {
  return fmt::format("[resolution]\nrefine = {}\n", k);
}

}  // namespace meniscus::test
