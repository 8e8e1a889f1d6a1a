// SPDX-License-Identifier: BSD-3-Clause
// Mesh files: both formats, orders, orientation, units, and refused files.
#include "body/mesh/mesh_file.hpp"
#include "body/surface/face_cells.hpp"
#include "body/surface/surface_points.hpp"
#include "meniscus/error.hpp"
#include "mesh_support.hpp"
#include "numbers/box.hpp"
#include "support.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <numbers>
#include <random>
#include <set>

namespace meniscus::test_mesh_files {
namespace {

using std::numbers::pi;

/// A square of two quadrilaterals with a named side, one of them left-handed.
const std::string square_41 = R"($MeshFormat
4.1 0 8
$EndMeshFormat
$Comments
what nobody reads
$EndComments
$PhysicalNames
2
1 7 "wet side"
2 9 "inside"
$EndPhysicalNames
$Entities
0 1 1 0
3 0 0 0 0 1 0 1 7 0
5 0 0 0 2 1 0 1 9 1 3
$EndEntities
$Nodes
2 6 1 6
1 3 0 2
1
4
0 0 0
0 1 0
2 5 0 4
2
3
5
6
1 0 0
2 0 0
1 1 0
2 1 0
$EndNodes
$Elements
2 3 1 3
1 3 1 1
1 1 4
2 5 3 2
2 1 2 5 4
3 2 5 6 3
$EndElements
)";
const std::string square_22 = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
1
1 7 "wet side"
$EndPhysicalNames
$Nodes
6
1 0 0 0
4 0 1 0
2 1 0 0
3 2 0 0
5 1 1 0
6 2 1 0
$EndNodes
$Elements
3
1 1 2 7 3 1 4
2 3 2 9 5 1 2 5 4
3 3 2 9 5 2 5 6 3
$EndElements
)";

std::string vtu(const std::string& attributes, const std::string& points, const std::string& nodes,
                const std::string& ends, const std::string& types,
                const std::string& format = "ascii") {
  return "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" "
         "byte_order=\"LittleEndian\"" +
         attributes +
         ">\n<!-- made by hand -->\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"6\" "
         "NumberOfCells=\"2\">\n<PointData><DataArray type=\"Float64\" Name=\"q\" "
         "format=\"ascii\">1 "
         "2</DataArray></PointData>\n<Points>\n<DataArray type=\"Float64\" "
         "NumberOfComponents=\"3\" "
         "format=\"" +
         format + "\">" + points +
         "</DataArray>\n</Points>\n<Cells>\n<DataArray type=\"Int64\" Name=\"connectivity\" "
         "format=\"" +
         format + "\">" + nodes +
         "</DataArray>\n<DataArray type=\"Int64\" Name=\"offsets\" format=\"" + format + "\">" +
         ends + "</DataArray>\n<DataArray type=\"UInt8\" Name=\"types\" format=\"" + format +
         "\">" + types + "</DataArray>\n</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
}
const std::string square_vtu =
    vtu("", "0 0 0  1 0 0  2 0 0\n0 1 0  1 1 0  2 1 0", "0 1 4 3 1 4 5 2", "4 8", "9 9");

template <class T>
std::string base64(const std::vector<T>& values, int header_bytes) {
  const std::uint64_t length = values.size() * sizeof(T);
  std::string bytes(static_cast<std::size_t>(header_bytes) + length, '\0');
  std::memcpy(bytes.data(), &length, static_cast<std::size_t>(header_bytes));
  std::memcpy(bytes.data() + header_bytes, values.data(), length);
  constexpr std::string_view letters =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k)
      bits = bits << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k)
      text += i + k > bytes.size() ? '=' : letters[bits >> (18 - 6 * k) & 63];
  }
  return text;
}
std::string square_base64(bool wide) {
  const int header = wide ? 8 : 4;
  return vtu(wide ? " header_type=\"UInt64\"" : "",
             base64<double>({0, 0, 0, 1, 0, 0, 2, 0, 0, 0, 1, 0, 1, 1, 0, 2, 1, 0}, header),
             base64<std::int64_t>({0, 1, 4, 3, 1, 4, 5, 2}, header),
             base64<std::int64_t>({4, 8}, header), base64<std::uint8_t>({9, 9}, header), "binary");
}

TEST(MeshFiles, EveryFormatIsTheSameSquare) {
  for (const auto& [name, text] : {std::pair<std::string, std::string>{"a.msh", square_41},
                                   {"b.msh", square_22},
                                   {"c.vtu", square_vtu},
                                   {"d.vtu", square_base64(false)},
                                   {"e.vtu", square_base64(true)}}) {
    SCOPED_TRACE(name);
    const Geometry<2> body =
        test::geometry_of_file<2>(test::written(name, text), "unit = '2 mm'\n");
    EXPECT_EQ(body.grid.node_count(), 6);
    EXPECT_EQ(body.grid.cell_count(), 2);
    EXPECT_NEAR(volume(body.grid), 2 * 4e-6, 1e-20) << "a left-handed cell is turned round";
    EXPECT_EQ(body.grid.facets.size(), 6u);
    if (name.ends_with(".msh")) {
      ASSERT_EQ(face_names(body).size(), 1u);
      EXPECT_EQ(face_names(body)[0], (std::pair<std::string, Index>("wet side", 1)));
    }
  }
}

/// A ball with second-order cells: a coarse ball whose middle nodes lie on the sphere.
std::string ball_of_second_order(int n, bool simplices, bool as_vtu) {
  Grid<3> grid = test::ball(n, n / 2).grid;
  std::set<Index> surface;
  for (const Index node : boundary_nodes(grid)) surface.insert(node);
  const test::CellList corners = simplices ? test::simplices_of(grid) : test::cells_of(grid);
  const std::vector<std::pair<int, int>> edges =
      simplices
          ? (as_vtu
                 ? std::vector<std::pair<int, int>>{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}
                 : std::vector<std::pair<int, int>>{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {2, 3}, {1, 3}})
      : as_vtu ? std::vector<std::pair<int, int>>{{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6},
                                                  {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}
               : std::vector<std::pair<int, int>>{{0, 1}, {0, 3}, {0, 4}, {1, 2}, {1, 5}, {2, 3},
                                                  {2, 6}, {3, 7}, {4, 5}, {4, 7}, {5, 6}, {6, 7}};
  // Only edges of the surface bulge. An edge through the inside may join two surface nodes of a
  // coarse ball, too.
  std::set<std::pair<Index, Index>> outside;
  find_boundary(grid);
  for (const auto& facet : grid.facets)
    for (const Index a : facet.nodes)
      for (const Index b : facet.nodes) outside.insert({a, b});
  std::map<std::pair<Index, Index>, Index> middle;
  std::string elements, ends, types;
  std::size_t written = 0;
  for (std::size_t e = 0; e < corners.size(); ++e) {
    std::vector<Index> nodes = corners[e];
    // Simplices of the test grid may be left-handed; mesh files may contain such cells.
    for (const auto& [i, k] : edges) {
      const Index a = at(corners[e], i), b = at(corners[e], k);
      const auto [found, is_new] =
          middle.try_emplace({std::min(a, b), std::max(a, b)}, grid.node_count());
      if (is_new) {
        Vec<3> X = 0.5 * (at(grid.X, a) + at(grid.X, b));
        if (outside.count({a, b})) X.normalize();
        grid.X.push_back(X);
      }
      nodes.push_back(found->second);
    }
    if (!as_vtu) elements += fmt::format("{} {} 2 0 1", e + 1, simplices ? 11 : 17);
    for (const Index node : nodes) elements += fmt::format(" {}", node + !as_vtu);
    elements += '\n';
    written += nodes.size();
    ends += fmt::format(" {}", written);
    types += simplices ? " 24" : " 25";
  }
  std::string nodes;
  for (std::size_t i = 0; i < grid.X.size(); ++i)
    nodes += (as_vtu ? "" : fmt::format("{} ", i + 1)) +
             fmt::format("{:.17g} {:.17g} {:.17g}\n", grid.X[i][0], grid.X[i][1], grid.X[i][2]);
  if (as_vtu)
    return fmt::format(
        "<VTKFile type='UnstructuredGrid'><UnstructuredGrid><Piece NumberOfPoints='{}' "
        "NumberOfCells='{}'><Points><DataArray type='Float64' NumberOfComponents='3' "
        "format='ascii'>{}</DataArray></Points><Cells><DataArray Name='connectivity' "
        "format='ascii'>{}</DataArray><DataArray Name='offsets' format='ascii'>{}</DataArray>"
        "<DataArray Name='types' format='ascii'>{}</DataArray></Cells></Piece></UnstructuredGrid>"
        "</VTKFile>",
        grid.X.size(), corners.size(), nodes, elements, ends, types);
  return fmt::format(
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n{}\n{}$EndNodes\n$Elements\n{}\n{}"
      "$EndElements\n",
      grid.X.size(), nodes, corners.size(), elements);
}

TEST(MeshFiles, CellsOfSecondOrderAreCurvedAsTheFileSays) {
  for (const bool simplices : {false, true})
    for (const bool as_vtu : {false, true}) {
      SCOPED_TRACE(fmt::format("{} {}", simplices, as_vtu));
      const Geometry<3> body = test::geometry_of_file<3>(test::written(
          as_vtu ? "ball.vtu" : "ball.msh", ball_of_second_order(4, simplices, as_vtu)));
      EXPECT_TRUE(body.surface->smooth());
      EXPECT_NEAR(volume(body.grid), 4 * pi / 3, 0.006);
      EXPECT_LT(volume(test::geometry_of_file<3>(
                           test::written("straight.msh",
                                         test::msh_of<3>(test::ball(4, 2).grid,
                                                         test::cells_of(test::ball(4, 2).grid))))
                           .grid),
                4.2);
      const SurfacePoints<3> points = surface_points(body, 3);
      Real area = 0, off = 0;
      for (Index q = 0; q < points.size(); ++q) {
        area += at(points.area, q);
        off = std::max(off, std::abs(at(points.X, q).norm() - 1));
        EXPECT_NEAR(at(points.grad_N, q).trace(), 2, 0.5);
      }
      EXPECT_NEAR(area, 4 * pi, 0.02);
      EXPECT_LT(off, 0.004);
    }
}

std::string problem_of(const std::string& name, const std::string& text, int dimension = 2) {
  try {
    const std::string file = test::written(name, text);
    dimension == 2 ? (void)test::geometry_of_file<2>(file) : (void)test::geometry_of_file<3>(file);
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

std::string changed(std::string text, const std::string& from, const std::string& to) {
  const std::size_t place = text.find(from);
  EXPECT_NE(place, text.npos) << from;
  return text.replace(place, from.size(), to);
}

TEST(MeshFiles, SayWhatIsWrongAndWhere) {
  const auto expect = [](const std::string& found, const std::string& words) {
    EXPECT_NE(found.find(words), found.npos) << found << "\nshould say: " << words;
    EXPECT_EQ(std::count(found.begin(), found.end(), '\n'), 0) << found;
  };
  const auto msh = [&](const std::string& from, const std::string& to) {
    return problem_of("bad.msh", changed(square_22, from, to));
  };
  expect(msh("2.2 0 8", "4 0 8"), "line 2: version '4' is not known; expected is 2.2 or 4.1");
  expect(msh("2.2 0 8", "2.2 1 8"), "the bytes are in the order of another machine");
  expect(msh("2 1 0 0", "2 1 0 nan"), "line 12: 'nan' is no finite number");
  expect(msh("2 1 0 0", "2 1 0 0\n2 1 0 0"), "node 2 is there twice");
  expect(msh("5 2 5 6 3", "5 2 5 6 66"), "has the node 66, which the file does not have");
  expect(msh("3 3 2 9 5 2 5 6 3", "3 6 2 9 5 2 5 6 3 1 4"), "element 3 is a prism; expected are");
  expect(msh("3 3 2 9 5 2 5 6 3", "3 3 2 9 5 2 6 5 3"), "line 21: element 3 is folded");
  expect(msh("3 3 2 9 5 2 5 6 3", "3 3 2 9 5 2 5 5 3"), "has a corner twice");
  expect(msh("3 3 2 9 5 2 5 6 3", "3 2 2 9 5 2 5 6"),
         "line 21: element 3 is of triangles, but line 20: element 2 is of quadrilaterals");
  expect(msh("6 2 1 0", "6 2 1 0.5"), "its z goes from 0 to 0.5");
  expect(msh("$EndNodes", "7 0 0 0\n$EndNodes"), "expected is $EndNodes");
  expect(problem_of("bad.msh", "solid cube\n"), "expected is a section, such as $Nodes");
  expect(problem_of("bad.msh", ""), "the file is empty");
  expect(problem_of("bad.stl", "solid"), "expected is a file whose name ends with .msh or .vtu");
  expect(problem_of("bad.msh", square_22, 3),
         "has a surface only; expected are hexahedra or tetrahedra");
  expect(problem_of("bad.msh", test::msh_of<3>(test::brick<3>({1, 1, 1}).grid,
                                               test::cells_of(test::brick<3>({1, 1, 1}).grid))),
         "expected are triangles or quadrilaterals, for the scene has dimension = 2");
  const auto vtk = [&](const std::string& from, const std::string& to) {
    return problem_of("bad.vtu", changed(square_vtu, from, to));
  };
  expect(vtk("0 1 4 3 1 4 5 2", "0 1 4 3 1 4 5 6"),
         "cell 1 has the node 6; expected are nodes from 0 to 5");
  expect(vtk("4 8<", "4 9<"), "the array has 8 numbers; expected are 9");
  expect(vtk("9 9<", "9 13<"), "cell 1 is a wedge; expected are");
  expect(vtk("LittleEndian", "BigEndian"), "expected is LittleEndian");
  expect(vtk("format=\"ascii\">0 0", "format=\"hex\">0 0"),
         "expected is ascii, binary or appended");
  expect(vtk("NumberOfPoints=\"6\"", "NumberOfPoints=\"-6\""), "-6 is out of range");
  expect(vtk("Name=\"types\"", "Name=\"typos\""), "the array Cells types is missing");
  const auto missing = [] {
    try {
      test::geometry_of_file<2>("/nowhere/at_all.msh");
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("none");
  };
  expect(missing(), "cannot read '/nowhere/at_all.msh': No such file or directory");
  Grid<2> twice = test::brick<2>({2, 1}).grid;
  test::CellList cells = test::cells_of(twice);
  for (Index& node : cells[1]) {
    twice.X.push_back(at(twice.X, node));
    node = twice.node_count() - 1;
  }
  expect(problem_of("bad.msh", test::msh_of<2>(twice, cells)), "are at the same place");
}

/// After a problem with the shape, the keys of placement are not reported as unknown.
TEST(MeshFiles, OneThatIsMissingIsTheOnlyProblem) {
  const SceneInput scene = SceneInput::from_text(
      "[body]\nshape = 'mesh'\nfile = 'nowhere.msh'\nmove = [1, 0]\nrotate = 30\n");
  const Block block = *scene.root().table("body");
  read_geometry<2>(block);
  block.done();
  try {
    scene.check();
    FAIL();
  } catch (const InputError& error) {
    const std::string said = error.what();
    EXPECT_NE(said.find("scene:3:8: body.file: cannot read 'nowhere.msh'"), said.npos) << said;
    EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 0) << said;
  }
}

/// A file that is cut off or changed at any place is read or refused with an InputError.
TEST(MeshFiles, HarmfulOnesAreRefused) {
  std::mt19937 random(4);
  const std::vector<std::pair<std::string, std::string>> files{{"x.msh", square_41},
                                                               {"x.msh", square_22},
                                                               {"x.vtu", square_vtu},
                                                               {"x.vtu", square_base64(true)}};
  const auto read = [](const std::string& name, const std::string& text) {
    try {
      name.ends_with("msh") ? read_msh(text, name) : read_vtu(text, name);
    } catch (const InputError&) {
    }
  };
  for (const auto& [name, text] : files) {
    for (std::size_t end = 0; end < text.size(); ++end) read(name, text.substr(0, end));
    for (int k = 0; k < 3000; ++k) {
      std::string other = text;
      for (int changes = 1 + static_cast<int>(random() % 3); changes > 0; --changes) {
        const std::size_t place = random() % other.size();
        switch (random() % 4) {
          case 0:
            other[place] = static_cast<char>(random() % 256);
            break;
          case 1:
            other[place] = static_cast<char>('0' + random() % 10);
            break;
          case 2:
            other.erase(place, random() % 20);
            break;
          default:
            other.insert(place, std::to_string(random()));
        }
        if (other.empty()) break;
      }
      read(name, other);
      if (k % 30 == 0) problem_of(name, other);
    }
  }
}

}  // namespace
}  // namespace meniscus::test_mesh_files
