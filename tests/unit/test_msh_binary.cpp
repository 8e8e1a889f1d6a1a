// SPDX-License-Identifier: BSD-3-Clause
// Binary files of Gmsh, partitioned meshes, and nodes with parameters.
#include "body/mesh/mesh_file.hpp"
#include "body/surface/face_cells.hpp"
#include "meniscus/error.hpp"
#include "mesh_support.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <random>

namespace meniscus::test_msh_binary {
namespace {

/// Text and bytes of a file, in the order in which they are written.
class Bytes {
 public:
  Bytes& text(const std::string& words) {
    all_ += words;
    return *this;
  }
  template <class T>
  Bytes& numbers(std::initializer_list<T> values) {
    all_.append(reinterpret_cast<const char*>(values.begin()), values.size() * sizeof(T));
    return *this;
  }
  Bytes& ints(std::initializer_list<std::int32_t> values) { return numbers(values); }
  Bytes& sizes(std::initializer_list<std::uint64_t> values) { return numbers(values); }
  Bytes& reals(std::initializer_list<double> values) { return numbers(values); }
  const std::string& all() const { return all_; }

 private:
  std::string all_;
};

const std::string names =
    "$PhysicalNames\n2\n1 7 \"wet side\"\n2 9 \"inside\"\n$EndPhysicalNames\n";

/// Two quadrilaterals and a named line. The bytes of the coordinates contain white space.
std::string square_41() {
  Bytes b;
  b.text("$MeshFormat\n4.1 1 8\n").ints({1}).text("\n$EndMeshFormat\n" + names);
  b.text("$Entities\n").sizes({0, 1, 1, 0});
  b.ints({3}).reals({0, 0, 0, 0, 1, 0}).sizes({1}).ints({7}).sizes({0});
  b.ints({5}).reals({0, 0, 0, 2, 1, 0}).sizes({1}).ints({9}).sizes({1}).ints({3});
  b.text("\n$EndEntities\n$PartitionedEntities\n").sizes({2, 1}).ints({1, 1}).sizes({0, 1, 0, 0});
  b.ints({4, 1, 3}).sizes({2}).ints({1, 2}).reals({0, 0, 0, 0, 1, 0}).sizes({1}).ints({7});
  b.sizes({1}).ints({-3});
  b.text("\n$EndPartitionedEntities\n$Comments\n$Nodes are not here\n$EndComments\n");
  b.text("$Nodes\n").sizes({2, 6, 1, 6}).ints({1, 3, 1}).sizes({2, 1, 4});
  b.reals({0, 0, 0, 0.5, 0, 1, 0, 0.7}).ints({2, 5, 0}).sizes({4, 2, 3, 5, 6});
  b.reals({1, 0, 0, 2, 0, 0, 1, 1, 0, 2, 1, 0});
  b.text("\n$EndNodes\n$Elements\n").sizes({2, 3, 1, 3}).ints({1, 4, 1}).sizes({1, 1, 1, 4});
  b.ints({2, 5, 3}).sizes({2, 2, 1, 2, 5, 4, 3, 2, 5, 6, 3}).text("\n$EndElements\n");
  return b.all();
}

std::string square_22(bool parametric) {
  Bytes b;
  const std::string nodes = parametric ? "ParametricNodes" : "Nodes";
  b.text("$MeshFormat\n2.2 1 8\n").ints({1}).text("\n$EndMeshFormat\n" + names);
  b.text("$" + nodes + "\n6\n");
  const auto node = [&](int number, double x, double y, int dimension) {
    b.ints({number}).reals({x, y, 0});
    if (!parametric) return;
    b.ints({dimension, 1});
    for (int k = 0; k < dimension % 3; ++k) b.reals({0.25});
  };
  node(1, 0, 0, 0);
  node(4, 0, 1, 1);
  node(2, 1, 0, 2);
  node(3, 2, 0, 3);
  node(5, 1, 1, 2);
  node(6, 2, 1, 0);
  b.text("\n$End" + nodes + "\n$Elements\n3\n");
  b.ints({1, 1, 2, 1, 7, 3, 1, 4}).ints({3, 2, 2, 2, 9, 5, 1, 2, 5, 4, 3, 9, 5, 2, 5, 6, 3});
  b.text("\n$EndElements\n");
  return b.all();
}

/// A file that Gmsh 4.8 writes with -parametric: nodes have one parameter on curves, two on
/// surfaces.
const std::string parametric_22 = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n" + names +
                                  R"($ParametricNodes
6
1 0 0 0 0 1
4 0 1 0 1 3 6.97
2 1 0 0 2 1 0.5 0.1
3 2 0 0 3 1
5 1 1 0 2 1 0.5 0.9
6 2 1 0 0 2
$EndParametricNodes
$Elements
3
1 1 2 7 3 1 4
2 3 2 9 5 1 2 5 4
3 3 2 9 5 2 5 6 3
$EndElements
)";

TEST(MshBinary, EveryFormatIsTheSameSquare) {
  // Some programs end the bytes of a section without a new line.
  const std::string data = square_22(false) + "$ElementData\n1\n\"a\"\n\x01\x02$EndElementData\n";
  for (const std::string& text :
       {square_41(), square_22(false), square_22(true), parametric_22, data}) {
    const Geometry<2> body = test::geometry_of_file<2>(test::written("binary.msh", text));
    EXPECT_EQ(body.grid.node_count(), 6);
    EXPECT_EQ(body.grid.cell_count(), 2);
    EXPECT_NEAR(volume(body.grid), 2, 1e-15);
    ASSERT_EQ(face_names(body).size(), 1u);
    EXPECT_EQ(face_names(body)[0], (std::pair<std::string, Index>("wet side", 1)));
  }
}

std::string problem_of(const std::string& text) {
  try {
    read_msh(text, "x.msh");
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

TEST(MshBinary, SaysWhatIsWrong) {
  const auto expect = [](const std::string& found, const std::string& words) {
    EXPECT_NE(found.find(words), found.npos) << found << "\nshould say: " << words;
    EXPECT_EQ(std::count(found.begin(), found.end(), '\n'), 0) << found;
  };
  const auto nodes = [](std::uint64_t count) { return Bytes().sizes({2, count, 1, 6}).all(); };
  const auto elements = [](std::uint64_t count) { return Bytes().sizes({2, count, 1, 3}).all(); };
  expect(problem_of(changed(square_41(), nodes(6), nodes(7))),
         "the blocks have 6 nodes in all, but 7 were announced");
  expect(problem_of(changed(square_41(), elements(3), elements(2))),
         "the blocks have 3 elements in all, but 2 were announced");
  expect(problem_of(changed(square_41(), nodes(6), nodes(std::uint64_t{1} << 40))),
         "1099511627776 is out of range; expected is a number of nodes");
  expect(problem_of(changed(square_41(), "4.1 1 8", "4.1 1 4")), "line 2: 4 is out of range");
  expect(problem_of(changed(square_41(), "4.1 1 8", "4.1 2 8")), "line 2: 2 is out of range");
  expect(problem_of(changed(square_22(false), "$Elements\n3", "$Elements\n4")), "byte ");
  const std::string whole = square_41();
  expect(problem_of(whole.substr(0, whole.find("$Nodes\n\x02") + 100)), "the file ends");
}

TEST(MshBinary, DamagedOnesAreRefusedOrRead) {
  std::mt19937 random(8);
  for (const std::string& text : {square_41(), square_22(false), square_22(true)}) {
    for (std::size_t end = 0; end < text.size(); ++end) problem_of(text.substr(0, end));
    for (int k = 0; k < 3000; ++k) {
      std::string other = text;
      for (int changes = 1 + static_cast<int>(random() % 3); changes > 0; --changes) {
        const std::size_t place = random() % other.size();
        if (random() % 2 == 0)
          other[place] = static_cast<char>(random() % 256);
        else
          other.erase(place, random() % 3);
      }
      problem_of(other);
    }
  }
}

}  // namespace
}  // namespace meniscus::test_msh_binary
