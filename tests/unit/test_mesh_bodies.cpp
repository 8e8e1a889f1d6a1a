// SPDX-License-Identifier: BSD-3-Clause
// Bodies from mesh files: nodal cells, surfaces, patch tests and an exact motion, for every kind of
// cell.
#include "body/grid/simplex.hpp"
#include "body/surface/face_cells.hpp"
#include "body/surface/surface_patches.hpp"
#include "body/surface/surface_points.hpp"
#include "meniscus/error.hpp"
#include "mesh_support.hpp"
#include "numbers/box.hpp"
#include "numbers/dense.hpp"
#include "run/simulation.hpp"
#include "support.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <numbers>
#include <optional>

namespace meniscus::test_mesh_bodies {
namespace {

using std::numbers::pi;

template <int D>
Grid<D> block(int n) {
  return test::brick<D>(std::vector<Real>(D, n), 0.3).grid;
}
/// A ball (2D: disk) with disordered inner nodes.
template <int D>
Grid<D> round_body(int n) {
  Geometry<D> body;
  if constexpr (D == 3)
    body = test::ball(n, n / 2);
  else
    body = test::disk(n, n / 2);
  body.grid.bulges.clear();
  body.grid.bulge_of.clear();
  jitter_interior(body.grid, 0.2, 3);
  return body.grid;
}

/// Calls f(simplices) for both kinds of cells: f(false) for hexahedra (2D: quadrilaterals), f(true)
/// for simplices.
template <class F>
void for_both_kinds(F&& f) {
  for (const bool simplices : {false, true}) {
    SCOPED_TRACE(simplices ? "simplices" : "hexahedra or quadrilaterals");
    f(simplices);
  }
}

/// Nodal cells tile the body, are closed, and fit together.
template <int D>
void expect_cells(const Geometry<D>& body) {
  const NodalCells<D> cells(body.grid);
  Real sum = 0;
  CellQuadrature<D> q;
  Vec<D> flux = Vec<D>::Zero();
  for (Index A = 0; A < cells.size(); ++A) {
    EXPECT_GT(cells.volume(A), 0);
    sum += cells.volume(A);
    cells.quadrature(A, q);
    Vec<D> closed = Vec<D>::Zero();
    Mat<D> moment = Mat<D>::Zero();
    Real area = 0;
    for (std::size_t p = 0; p < q.facet_X.size(); ++p) {
      closed += q.facet_dA[p];
      moment += (q.facet_X[p] - cells.centroid(A)) * q.facet_dA[p].transpose();
      area += q.facet_dA[p].norm();
      if (p < q.body_facets_begin) flux += q.facet_dA[p];
    }
    EXPECT_LT(closed.norm(), 1e-13 * area);
    EXPECT_LT((moment - cells.volume(A) * Mat<D>::Identity()).norm(), 1e-12 * cells.volume(A));
  }
  EXPECT_NEAR(sum, volume(body.grid), 1e-12 * sum);
  EXPECT_LT(flux.norm(), 1e-12);
}

template <int D>
void expect_nodal_cells() {
  for_both_kinds([](bool simplices) {
    expect_cells<D>(test::imported<D>(block<D>(3), simplices));
    expect_cells<D>(test::imported<D>(round_body<D>(4), simplices));
    expect_cells<D>(test::imported<D>(round_body<D>(2), simplices, test::refined_by(2)));
  });
}
TEST(MeshBodies, NodalCellsTileTheBody) {
  expect_nodal_cells<2>();
  expect_nodal_cells<3>();
}

/// The quarter of a straight tetrahedron at each corner has a quarter of its volume.
TEST(MeshBodies, PartsOfASimplexAreEqual) {
  Grid<3> grid;
  grid.X = {{0, 0, 0}, {2, 0.1, 0}, {0.3, 1, 0}, {0.2, 0.4, 3}};
  grid.cells = {collapsed(std::array<Index, 4>{0, 1, 2, 3})};
  find_boundary(grid);
  EXPECT_EQ(grid.facets.size(), 4u);
  const NodalCells<3> cells(grid);
  for (Index A = 0; A < 4; ++A) EXPECT_NEAR(cells.volume(A), volume(grid) / 4, 1e-15);
  Grid<2> plane;
  plane.X = {{0, 0}, {2, 0.1}, {0.3, 1}};
  plane.cells = {collapsed(std::array<Index, 3>{0, 1, 2})};
  find_boundary(plane);
  EXPECT_EQ(plane.facets.size(), 3u);
  const NodalCells<2> thirds(plane);
  for (Index A = 0; A < 3; ++A) EXPECT_NEAR(thirds.volume(A), volume(plane) / 3, 1e-15);
}

/// Linear displacements have the exact gradient at every stress point, and the total mass is
/// density times volume.
template <int D>
void expect_patch_test(const Geometry<D>& geometry) {
  const auto body = test::body_of<D>(geometry);
  const NodalVectors u = test::field_on<D>(*body, [](const Vec<D>& X) {
    return Vec<D>(0.1 * X + 0.2 * X[1] * Vec<D>::Unit(0) - 0.3 * X[0] * Vec<D>::Unit(D - 1));
  });
  const CellOperator<D> made = build_cell_rule(*body);
  Real worst = 0;
  for (Index L = 0; L < made.rule.groups(); ++L) {
    Tensor<Lanes> H;
    made.rule.gather(L, u.data(), H);
    for (int i = 0; i < D; ++i)
      for (int K = 0; K < D; ++K) {
        const Real expected =
            0.1 * (i == K) + 0.2 * (i == 0 && K == 1) - 0.3 * (i == D - 1 && K == 0);
        for (int lane = 0; lane < D + 1; ++lane)
          worst = std::max(worst, std::abs(H(i, K)[lane] - expected));
      }
  }
  EXPECT_LT(worst, 1e-12);
}

template <int D>
void expect_patch_tests() {
  for_both_kinds([](bool simplices) {
    expect_patch_test<D>(test::imported<D>(block<D>(4), simplices));
    expect_patch_test<D>(test::imported<D>(round_body<D>(4), simplices));
    expect_patch_test<D>(test::imported<D>(block<D>(2), simplices, test::refined_by(2)));
    expect_patch_test<D>(test::imported<D>(round_body<D>(2), simplices, test::refined_by(2)));
  });
}
TEST(MeshBodies, PassThePatchTest) {
  expect_patch_tests<2>();
  expect_patch_tests<3>();
}

struct SurfaceErrors {
  Real place = 0, normal = 0, curvature = 0, area = 0, volume = 0;
};
/// Errors for a unit ball.
template <int D>
SurfaceErrors errors_of(const Geometry<D>& body) {
  SurfaceErrors e;
  const SurfacePoints<D> p = surface_points(body, 3);
  Real area = 0, squares = 0;
  for (Index q = 0; q < p.size(); ++q) {
    const Vec<D> N = at(p.X, q).normalized();
    e.place = std::max(e.place, std::abs(at(p.X, q).norm() - 1));
    e.normal = std::max(e.normal, (at(p.N, q) - N).norm());
    squares += at(p.area, q) * std::pow(at(p.grad_N, q).trace() - (D - 1), 2);
    area += at(p.area, q);
  }
  e.curvature = std::sqrt(squares / area);
  e.area = std::abs(area / (D == 3 ? 4 * pi : 2 * pi) - 1);
  e.volume = std::abs(volume(body.grid) / (D == 3 ? 4 * pi / 3 : pi) - 1);
  return e;
}

template <int D>
void expect_round_surface() {
  for_both_kinds([](bool simplices) {
    const auto at_level = [&](int n) {
      return errors_of<D>(test::imported<D>(round_body<D>(n), simplices));
    };
    const SurfaceErrors coarse = at_level(4), fine = at_level(8);
    const auto order = [&](Real SurfaceErrors::*e) { return std::log2(coarse.*e / fine.*e); };
    EXPECT_GT(order(&SurfaceErrors::place), 2.5);
    EXPECT_GT(order(&SurfaceErrors::normal), 1.7);
    EXPECT_GT(order(&SurfaceErrors::curvature), 0.9);
    EXPECT_GT(order(&SurfaceErrors::volume), 2.5);
    EXPECT_LT(fine.place, 1e-3);
    EXPECT_LT(fine.volume, 1e-3);
  });
}
TEST(MeshBodies, HaveASmoothSurfaceWhereTheyAreRound) {
  expect_round_surface<2>();
  expect_round_surface<3>();
}

TEST(MeshBodies, KeepTheirEdgesAndNameTheirFaces) {
  for_both_kinds([](bool simplices) {
    const Geometry<3> body = test::imported<3>(block<3>(3), simplices);
    EXPECT_FALSE(body.surface->smooth());
    EXPECT_TRUE(body.grid.bulges.empty());
    EXPECT_EQ(face_names(body).size(), 6u);
    EXPECT_EQ(face_names(body)[0].first, "face_1");
    const auto error_of_cylinder = [&](int n) {
      Grid<3> grid = Cylinder{1, 2, n, n / 2, n, {0, 0, 0}}.geometry().grid;
      grid.bulges.clear();
      grid.bulge_of.clear();
      const Geometry<3> round = test::imported<3>(grid, simplices);
      EXPECT_EQ(face_names(round).size(), 3u);
      return std::abs(volume(round.grid) - 2 * pi);
    };
    const Real coarse = error_of_cylinder(4), fine = error_of_cylinder(8);
    EXPECT_GT(std::log2(coarse / fine), 2.5) << coarse << " " << fine;
    EXPECT_LT(fine, 3e-3);
  });
}

/// Drops need the area and volume of a closed surface.
TEST(MeshBodies, HaveAClosedSurface) {
  for_both_kinds([](bool simplices) {
    using Size = SurfacePatches<3>::Size;
    const auto errors = [&](int n) {
      const auto body = test::body_of<3>(test::imported<3>(round_body<3>(n), simplices));
      const SurfacePatches<3> patches(*body);
      const NodalVectors u = test::zeros(NodalVectors(static_cast<std::size_t>(body->size())));
      EXPECT_NEAR(patches.measure(Size::volume, u.data()), patches.reference(Size::volume), 1e-12);
      return Vec<2>(patches.reference(Size::area) - 4 * pi,
                    patches.reference(Size::volume) - 4 * pi / 3);
    };
    const Vec<2> coarse = errors(4), fine = errors(8);
    for (int k = 0; k < 2; ++k)
      EXPECT_GT(std::log2(coarse[k] / fine[k]), 2.5) << coarse[k] << " " << fine[k];
    EXPECT_LT(fine.cwiseAbs().maxCoeff(), 0.01);
  });
}

/// A unit square or cube with disordered inner nodes.
template <int D>
std::string file_of_unit_block(int n, bool simplices) {
  Grid<D> grid = test::brick<D>(std::vector<Real>(D, n), 0.2).grid;
  const Box<D> box = box_around<D>(grid.X);
  for (Vec<D>& X : grid.X) X = (X - box.low) / n;
  return test::written(
      fmt::format("unit_{}_{}.msh", D, n),
      test::msh_of<D>(grid, simplices ? test::simplices_of(grid) : test::cells_of(grid)));
}

/// The measures of a scene at its end time.
template <int D>
class Ended {
 public:
  explicit Ended(const std::string& text) : input_(SceneInput::from_text(text)) {
    scene_dimension(input_);
    scene_.emplace(build_scene<D>(input_));
    simulation_.emplace(*scene_);
    simulation_->begin();
    while (!simulation_->finished()) simulation_->advance();
  }
  Real measure(const std::string& name) const {
    const auto& state = simulation_->state();
    for (const auto& measure : scene_->measures)
      if (measure.name == name) return measure.compute({state.time, state.u, state.v});
    ADD_FAILURE() << name;
    return 0;
  }

 private:
  SceneInput input_;
  std::optional<Scene<D>> scene_;
  std::optional<Simulation<D>> simulation_;
};

/// A free elastic body in its Lame mode, u = A sin(w t) (cos(pi x) sin(pi y), -sin(pi x) cos(pi
/// y)), over a quarter of a period: the largest error of the state.
template <int D>
Real lame_error(int n, bool simplices) {
  const std::string zero = D == 3 ? ", '0'" : "";
  const Ended<D> ended(fmt::format(
      R"toml(
dimension = {}
[time]
end = 0.57
[[body]]
name = "block"
shape = "mesh"
file = "{}"
initial_velocity = ["2.755359030227e-05*cos(pi*x)*sin(pi*y)", "-2.755359030227e-05*sin(pi*x)*cos(pi*y)"{}]
material = {{ type = "neo_hookean", density = 1, mu = 0.384615384615385, lambda = 0.576923076923077 }}
[[exact]]
body = "block"
displacement = ["1e-5*sin(2.755359030227*t)*cos(pi*x)*sin(pi*y)", "-1e-5*sin(2.755359030227*t)*sin(pi*x)*cos(pi*y)"{}]
velocity = ["2.755359030227e-05*cos(2.755359030227*t)*cos(pi*x)*sin(pi*y)", "-2.755359030227e-05*cos(2.755359030227*t)*sin(pi*x)*cos(pi*y)"{}]
rate = 2.755359030227
)toml",
      D, file_of_unit_block<D>(n, simplices), zero, zero, zero));
  return ended.measure("block.state_error");
}
template <int D>
void expect_exact_motion(int n, Real bound) {
  for_both_kinds([&](bool simplices) {
    const Real coarse = lame_error<D>(n / 2, simplices), fine = lame_error<D>(n, simplices);
    EXPECT_GT(fine, 0);
    EXPECT_LT(fine, bound);
    EXPECT_GT(std::log2(coarse / fine), 1.5) << coarse << " " << fine;
  });
}
TEST(MeshBodies, FollowAnExactMotion) {
  expect_exact_motion<2>(12, 0.03);
  expect_exact_motion<3>(8, 0.1);
}

/// The mean pressure of a drop at rest is (D - 1) gamma / R (Young and Laplace). For any surface, D
/// times pressure and volume is D - 1 times tension and area (virial).
template <int D>
void expect_young_laplace(int n) {
  for_both_kinds([&](bool simplices) {
    const Grid<D> grid = round_body<D>(n);
    const std::string file = test::written(
        fmt::format("drop_{}.msh", D),
        test::msh_of<D>(grid, simplices ? test::simplices_of(grid) : test::cells_of(grid)));
    const Ended<D> drop(fmt::format(
        R"toml(
dimension = {}
[time]
end = 2
[output]
measures = ["drop.mean_pressure", "drop.volume", "drop.area"]
[[body]]
name = "drop"
shape = "mesh"
file = "{}"
material = {{ type = "newtonian", density = 1, bulk_modulus = 20, equation_of_state = "linear", viscosity = 1, bulk_viscosity = 2 }}
[[surface_tension]]
body = "drop"
gamma = 1
)toml",
        D, file));
    const Real p = drop.measure("drop.mean_pressure"), V = drop.measure("drop.volume"),
               A = drop.measure("drop.area");
    const Real R = D == 3 ? std::cbrt(3 * V / (4 * pi)) : std::sqrt(V / pi);
    EXPECT_NEAR(p * R / (D - 1), 1, 0.01);
    EXPECT_NEAR(D * p * V / ((D - 1) * A), 1, 2e-3);
  });
}
TEST(MeshBodies, HaveThePressureOfYoungAndLaplace) {
  expect_young_laplace<2>(6);
  expect_young_laplace<3>(4);
}

/// Row sums of tetrahedra made by tools/mesh: few or no particles need the floor of the masses.
TEST(MeshBodies, OfCgalHaveRowSumsNearTheirCells) {
  for (const auto& [name, least] :
       {std::pair("drops/meshes/ball_tetrahedra", 0.2), {"cells/meshes/red_cell", 0.3}}) {
    const auto body = test::body_of<3>(
        test::geometry_of_file<3>(fmt::format("{}/../../inputs/{}.msh", MENISCUS_TEST_DATA, name)));
    const std::vector<Real> sums = shape_integrals(*body);
    for (Index A = 0; A < body->size(); ++A)
      EXPECT_GT(at(sums, A), least * body->cells.volume(A)) << name << " " << A;
  }
}

TEST(MeshBodies, MayBeDisorderedAndMapped) {
  const auto error_of_ellipsoid = [](int n) {
    const Grid<3> grid = round_body<3>(n);
    const std::string file =
        test::written("again.msh", test::msh_of<3>(grid, test::simplices_of(grid)));
    const Geometry<3> ellipsoid =
        test::geometry_of_file<3>(file, "map = ['2*x', 'y', 'z']\njitter = 0.1\n");
    expect_cells<3>(ellipsoid);
    return std::abs(volume(ellipsoid.grid) - 8 * pi / 3);
  };
  const Real coarse = error_of_ellipsoid(4), fine = error_of_ellipsoid(8);
  EXPECT_GT(std::log2(coarse / fine), 2.0) << coarse << " " << fine;
}

}  // namespace
}  // namespace meniscus::test_mesh_bodies
