// SPDX-License-Identifier: BSD-3-Clause
// Materials of the regions of a mesh: shares of nodal cells, bars of two materials side by side and
// one after the other, against exact solutions; what is refused.
#include "body/grid/ordering.hpp"
#include "body/mesh/mesh_regions.hpp"
#include "cases.hpp"
#include "meniscus/error.hpp"
#include "mesh_support.hpp"
#include "run/simulation.hpp"
#include "support.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace meniscus::test_mesh_regions {
namespace {

constexpr Real soft_mu = 1, soft_lambda = 1.5, stiff_mu = 4, stiff_lambda = 2;

/// A bar with 2 n cells along x from 0 to 2 and m across; it changes at x = 1, or in the middle of
/// y.
template <int D>
Grid<D> bar(int n, int m) {
  Brick<D> brick;
  brick.size.assign(D, 0.5);
  brick.size[0] = 2;
  brick.cells.assign(D, m);
  brick.cells[0] = 2 * n;
  brick.corner.assign(D, 0);
  return brick.geometry().grid;
}

template <int D>
std::string file_of(const Grid<D>& grid, bool simplices, int axis) {
  return test::written(
      "regions.msh",
      test::msh_of<D>(grid, simplices ? test::simplices_of(grid) : test::cells_of(grid),
                      [=](const Vec<D>& X) { return X[axis] < (axis == 0 ? 1 : 0.25) ? 2 : 1; },
                      {"stiff", "soft"}));
}

std::string material(const std::string& keys, Real density, Real mu, Real lambda) {
  return fmt::format(
      "[[body.material]]\n{}\ntype = \"neo_hookean\"\ndensity = {}\nmu = {}\nlambda = {}\n", keys,
      density, mu, lambda);
}

template <int D>
std::string body(const std::string& file, const std::string& more, Real stiff_to_soft = 1) {
  return fmt::format(
             "dimension = {}\n[time]\nsolver = \"newton\"\nend = 1\nstep = 0.5\n[[body]]\n"
             "name = \"bar\"\nshape = \"mesh\"\nfile = \"{}\"\n{}",
             D, file, more) +
         material("region = \"soft\"", 1, soft_mu, soft_lambda) +
         material("region = \"stiff\"", 3, stiff_mu, stiff_to_soft * soft_lambda);
}

/// Sides that do not move across, the end at x = 0 held along x, the other one moved by `pull`.
template <int D>
std::string pulled(Real pull) {
  const std::string names = "xyz";
  std::string text = fmt::format(
      "[[held]]\nname = \"low\"\nbody = \"bar\"\nwhere = \"x < 1e-9\"\ncomponents = [\"x\"]\n"
      "[[held]]\nname = \"grip\"\nbody = \"bar\"\nwhere = \"x > 2 - 1e-9\"\ncomponents = [\"x\"]\n"
      "displacement = [{}, 0{}]\nramp = [0, 1]\n",
      pull, D == 3 ? ", 0" : "");
  for (std::size_t k = 1; k < D; ++k)
    text += fmt::format(
        "[[held]]\nname = \"side_{0}\"\nbody = \"bar\"\nwhere = \"({0} < 1e-9) + ({0} > 0.5 "
        "- 1e-9)\"\ncomponents = [\"{0}\"]\n",
        names[k]);
  return text;
}

template <int D>
Real force_at_grip(const std::string& text) {
  Scene<D> scene = test::scene_of<D>(text);
  Simulation<D> simulation(scene);
  simulation.begin();
  while (!simulation.finished()) simulation.advance();
  for (const MeasureSource& measure : scene.measures)
    if (measure.name == "grip.force_x") return measure.compute(simulation.state().motion());
  ADD_FAILURE();
  return 0;
}

/// P_xx of a stretch along x alone, mu (s - 1/s) + lambda (s - 1).
Real stress(Real mu, Real lambda, Real s) {
  return mu * (s - 1 / s) + lambda * (s - 1);
}

/// Of two lengths 1 one after the other, together longer by `pull`: the stress in both, by
/// bisection of the stretch of the soft one.
Real exact_in_series(Real pull) {
  Real low = 1, high = 1 + pull;
  for (int k = 0; k < 100; ++k) {
    const Real s = (low + high) / 2;
    (stress(soft_mu, soft_lambda, s) < stress(stiff_mu, stiff_lambda, 2 + pull - s) ? low : high) =
        s;
  }
  return stress(soft_mu, soft_lambda, low);
}

template <int D>
void expect_series(bool simplices, const std::vector<int>& cells) {
  constexpr Real pull = 0.4;
  const Real section = std::pow(0.5, D - 1), exact = section * exact_in_series(pull);
  std::vector<Real> errors;
  for (const int n : cells)
    errors.push_back(force_at_grip<D>(body<D>(file_of(bar<D>(n, 2), simplices, 0), "",
                                              stiff_lambda / soft_lambda) +
                                      pulled<D>(pull)) /
                         exact -
                     1);
  for (std::size_t k = 1; k < cells.size(); ++k) {
    const Real order =
        std::log(errors[k - 1] / errors[k]) / std::log(Real(cells[k]) / cells[k - 1]);
    EXPECT_GT(order, 0.85) << errors[k - 1] << " " << errors[k];
    EXPECT_LT(order, 1.3) << errors[k - 1] << " " << errors[k];
  }
  EXPECT_LT(std::abs(errors.back()), 0.25 / cells.back());
}
TEST(MeshRegions, BarsOneAfterTheOtherAreOfFirstOrder) {
  expect_series<2>(false, {4, 8, 16});
  expect_series<2>(true, {4, 8, 16});
  expect_series<3>(false, {4, 8});
  expect_series<3>(true, {4, 8});
}

/// The error of the force on two bars side by side, with 2 n cells along them and n across.
template <int D>
Real error_in_parallel(bool simplices, int n) {
  constexpr Real pull = 0.4, s = 1 + pull / 2;
  const Real section = std::pow(0.5, D - 1),
             exact = section * 0.5 *
                     (stress(soft_mu, soft_lambda, s) + stress(stiff_mu, soft_lambda, s));
  const std::string text = body<D>(file_of(bar<D>(n, n), simplices, 1), "") + pulled<D>(pull);
  return std::abs(force_at_grip<D>(text) / exact - 1);
}
TEST(MeshRegions, BarsSideBySideAreExact) {
  EXPECT_LT(error_in_parallel<2>(false, 4), 1e-8);
  EXPECT_LT(error_in_parallel<3>(false, 4), 1e-8);
}

/// Nodal cells of simplices are not the same along the interface, where one cell has the mean of
/// both energies: an error of second order.
TEST(MeshRegions, BarsOfSimplicesSideBySideAreOfSecondOrder) {
  EXPECT_GT(std::log2(error_in_parallel<2>(true, 4) / error_in_parallel<2>(true, 8)), 1.8);
  EXPECT_GT(std::log(error_in_parallel<3>(true, 4) / error_in_parallel<3>(true, 6)) / std::log(1.5),
            1.8);
}

/// The order of the nodes and of the cells changes when a body is made.
template <int D>
void expect_shares(bool simplices, int refine) {
  Geometry<D> geometry =
      test::geometry_of_file<D>(file_of(bar<D>(3, 2), simplices, 0), test::refined_by(refine));
  order_spatially(geometry);
  const Grid<D>& grid = geometry.grid;
  const MeshRegions* regions = mesh_regions(geometry);
  ASSERT_TRUE(regions);
  ASSERT_EQ(regions->names.size(), 2u);
  EXPECT_EQ(regions->cells[0], regions->cells[1]);
  const std::size_t soft = regions->names[0] == "soft" ? 0 : 1;
  std::array<Real, 2> volumes{};
  const NodalCells<D> cells(grid);
  for (Index A = 0; A < grid.node_count(); ++A) {
    const auto own = regions->at_node(A);
    EXPECT_NEAR(own[0] + own[1], 1, 1e-14);
    const Real x = at(grid.X, A)[0];
    if (std::abs(x - 1) > 1e-9) {
      EXPECT_EQ(own[soft], x < 1 ? 1 : 0);
    } else {
      EXPECT_GT(own[0] * own[1], 0.1);
    }
    for (std::size_t r = 0; r < 2; ++r) volumes.at(r) += own[r] * cells.volume(A);
  }
  EXPECT_NEAR(volumes[0], volumes[1], 1e-13);
}
TEST(MeshRegions, NodalCellsHaveTheSharesOfTheirVolumes) {
  for (const bool simplices : {false, true})
    for (const int refine : {1, 2}) {
      expect_shares<2>(simplices, refine);
      expect_shares<3>(simplices, refine);
    }
}

TEST(MeshRegions, TheMassIsThatOfTheRegions) {
  Scene<2> scene = test::scene_of<2>(body<2>(file_of(bar<2>(4, 2), false, 0), ""));
  EXPECT_NEAR(std::accumulate(scene.system.mass.begin(), scene.system.mass.end(), 0.0), 0.5 + 1.5,
              1e-12);
}

/// A region may have formulas, which hold in it only.
TEST(MeshRegions, FormulasAreOfTheirRegion) {
  const std::string file = file_of(bar<2>(6, 2), false, 0),
                    text = body<2>(file, "") + pulled<2>(0.4);
  const std::string formula = "\"1 + 1e-9*x\"";
  std::string varying = text;
  varying.replace(varying.find("mu = 1\n"), 6, "mu = " + formula);
  EXPECT_NEAR(force_at_grip<2>(varying) / force_at_grip<2>(text), 1, 1e-7);
}

std::string problems_of(const std::string& text) {
  try {
    test::scene_of<2>(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

TEST(MeshRegions, WrongTablesAreRefused) {
  const std::string file = file_of(bar<2>(4, 2), false, 0), right = body<2>(file, "");
  EXPECT_EQ(problems_of(right), "none");
  const auto expect = [&](const std::string& old, const std::string& changed,
                          const std::string& words) {
    std::string text = right;
    const std::size_t where = text.find(old);
    ASSERT_NE(where, text.npos) << old;
    text.replace(where, old.size(), changed);
    const std::string found = problems_of(text);
    EXPECT_NE(found.find(words), found.npos) << found << "\nshould say: " << words;
  };
  expect("\"soft\"", "\"sofd\"",
         "body[0].material[0].region: the mesh has no region 'sofd'; allowed are soft, stiff");
  expect("\"soft\"", "\"stiff\"",
         "body[0].material[1].region: region 'stiff' has a material already; allowed is one");
  expect("region = \"soft\"\n", "", "body[0].material[0].region: missing; allowed is a text");
  const std::string second = right.substr(right.rfind("[[body.material]]"));
  expect(
      second, "",
      "body[0].material: region 'stiff' of the mesh has no material; give it a [[body.material]] "
      "with region = \"stiff\"");
  std::string other = second;
  other.replace(other.find("neo_hookean"), 11, "st_venant_kirchhoff");
  expect(second, other,
         "body[0].material[1].type: regions of a body differ in the numbers of one law");
  expect(second, second + "viscosity = 1\n",
         "body[0].material[1].viscosity: differs from that of region '");
  expect(
      "shape = \"mesh\"\nfile = \"" + file + "\"",
      "shape = \"rectangle\"\nsize = [1, 1]\nspacing = 0.2",
      "body[0].material[0].region: the body has no regions; allowed is this key for a mesh (.msh) "
      "with physical surfaces");
  expect("[[body.material]]", "integration = \"gauss\"\n[[body.material]]",
         "body[0].integration: 'gauss' has no nodal cells");
  // Cells in no group have no material.
  const Grid<2> grid = bar<2>(4, 2);
  const std::string some = test::written(
      "some.msh", test::msh_of<2>(grid, test::cells_of(grid),
                                  [](const Vec<2>& X) { return X[0] < 0.5 ? 0
                                                               : X[0] < 1 ? 2
                                                                          : 1; },
                                  {"stiff", "soft"}));
  expect(file, some, "body[0].material: the mesh has cells in no physical surface");
}

}  // namespace
}  // namespace meniscus::test_mesh_regions
