// SPDX-License-Identifier: BSD-3-Clause
// Reseeding of a deformed body: patches, volume, contact line, energy, distortion.
#include "body/surface/quadratic_surface.hpp"
#include "body/surface/surface_points.hpp"
#include "remap/distortion.hpp"
#include "run/epochs.hpp"
#include "support.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

namespace meniscus::test_reseed {
namespace {

template <int D>
Geometry<D> ellipsoid(int core) {
  if constexpr (D == 3) {
    Ellipsoid shape;
    shape.semi_axes = {1.3, 1, 0.8};
    shape.core = core;
    shape.layers = core / 2;
    return shape.geometry();
  } else {
    Ellipse shape;
    shape.semi_axes = {1.3, 0.8};
    shape.core = core;
    shape.rings = core / 2;
    return shape.geometry();
  }
}

/// A body with the same cells, whose surface patches go through exact points.
template <int D>
Geometry<D> patched(const Geometry<D>& exact) {
  const PatchNodes<D> numbered(exact.grid);
  std::vector<Vec<D>> points(static_cast<std::size_t>(numbered.count()));
  for (std::size_t f = 0; f < exact.grid.facets.size(); ++f)
    for (int a = 0; a < PatchFunctions<D>::nodes; ++a)
      at(points, at(numbered.facet[f], a)) =
          surface_point<D>(exact, exact.grid.facets[f], patch_node<D>(a));
  return quadratic_geometry<D>(exact.grid, points);
}

/// Root mean square errors of positions, normals and curvatures, and the error of the area.
struct Errors {
  Real place = 0, normal = 0, curvature = 0, area = 0;
};

template <int D>
Errors errors(int core) {
  const Geometry<D> exact = ellipsoid<D>(core), quadratic = patched(exact);
  const auto a = surface_points(exact, 3), b = surface_points(quadratic, 3);
  Errors e;
  Real total = 0, other = 0;
  for (Index q = 0; q < a.size(); ++q) {
    const Real w = at(a.area, q);
    total += w;
    other += at(b.area, q);
    e.place += w * std::pow(at(a.N, q).dot(at(a.X, q) - at(b.X, q)), 2);
    e.normal += w * (at(a.N, q) - at(b.N, q)).squaredNorm();
    e.curvature += w * std::pow(at(a.grad_N, q).trace() - at(b.grad_N, q).trace(), 2);
    EXPECT_LT((at(b.grad_N, q) * at(b.N, q)).norm(), 1e-12);
  }
  return {std::sqrt(e.place / total), std::sqrt(e.normal / total), std::sqrt(e.curvature / total),
          std::abs(other / total - 1)};
}

template <int D>
void expect_orders(int core, int finer) {
  const Errors coarse = errors<D>(core), fine = errors<D>(finer);
  const auto order = [&](const char* of, Real a, Real b) {
    const Real p = std::log(a / b) / std::log(static_cast<Real>(finer) / core);
    fmt::print("patches of an ellipsoid, {}D, {}: {:.2e}, {:.2e}, order {:.2f}\n", D, of, a, b, p);
    return p;
  };
  EXPECT_GT(order("places", coarse.place, fine.place), 2.8);
  EXPECT_GT(order("normals", coarse.normal, fine.normal), 1.8);
  EXPECT_GT(order("curvature", coarse.curvature, fine.curvature), 0.8);
  EXPECT_GT(order("area", coarse.area, fine.area), 3.5);
}

TEST(QuadraticSurface, ConvergesToTheExactOne) {
  expect_orders<2>(6, 12);
  expect_orders<3>(4, 8);
}

TEST(QuadraticSurface, IsTheSameForNodesOfAnotherOrder) {
  Geometry<3> body = patched(ellipsoid<3>(4));
  const auto before = surface_points(body, 2);
  std::vector<Index> order(body.grid.X.size());
  std::iota(order.begin(), order.end(), 0);
  std::mt19937 random(3);
  std::shuffle(order.begin(), order.end(), random);
  body.surface = body.surface->renumbered(order);
  std::vector<Index> number(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) at(number, order[i]) = static_cast<Index>(i);
  for (Facet<3>& facet : body.grid.facets)
    for (Index& node : facet.nodes) node = at(number, node);
  const auto after = surface_points(body, 2);
  for (Index q = 0; q < before.size(); ++q)
    EXPECT_LT((at(before.X, q) - at(after.X, q)).norm(), 1e-15);
}

TEST(QuadraticSurface, IsMappedByItsPoints) {
  const Geometry<3> body = patched(ellipsoid<3>(4));
  Mat<3> A;
  A << 1.2, 0.1, 0, 0, 0.9, 0.2, 0.1, 0, 1.1;
  const auto moved = body.surface->mapped(affine_map<3>(A, {1, 2, 3}), body.grid);
  const auto before = surface_points(body, 2);
  const auto after = moved->points(body.grid, 2, SurfacePart::outer);
  for (Index q = 0; q < before.size(); ++q)
    EXPECT_LT((A * at(before.X, q) + Vec<3>(1, 2, 3) - at(after.X, q)).norm(), 1e-14);
  EXPECT_EQ(moved->points(body.grid, 2, SurfacePart::inner).size(), 0);
}

template <int D>
std::string drop(int n, const std::string& displacement) {
  return fmt::format(R"toml(
dimension = {}
[time]
end = 1e3
[[body]]
name = "drop"
shape = "{}"
radius = 1
core = {}
{} = {}
initial_displacement = [{}]
initial_velocity = [{}]
material = {{ type = "newtonian", density = 1, bulk_modulus = 20, viscosity = 0.3 }}
[[surface_tension]]
body = "drop"
gamma = 1
)toml",
                     D, D == 3 ? "ball" : "disk", n, D == 3 ? "layers" : "rings", n / 2,
                     displacement, D == 3 ? "'y', 'x*y', 'sin(z)'" : "'y', 'x*y'");
}

template <int D>
Epochs<D> begun(const std::string& text) {
  const SceneInput input = SceneInput::from_text(text);
  scene_dimension(input);
  Epochs<D> epochs(read_plan<D>(input));
  epochs.simulation().begin();
  return epochs;
}

/// Displacements that stretch a drop by 2 and 1/2 (3D: by 1.6 and, twice, 0.79) and bend it.
template <int D>
std::string stretched() {
  return D == 3 ? "'0.6*x', '-0.21*y', '-0.21*z + 0.1*x^2'" : "'x', '-0.5*y + 0.1*x^2'";
}

/// New node positions of a drop in its present configuration.
template <int D>
Seeds<D> seeds_of(const Epochs<D>& epochs, const std::optional<ContactLine<D>>& line = {}) {
  const Body<D>& body = epochs.scene().system.bodies.front();
  return reseeded(body, epochs.simulation().state().u.data(), body.geometry.grid, line, 0);
}

/// Ratio of the largest to the smallest area of facets.
template <int D>
Real unevenness(const Geometry<D>& geometry) {
  const SurfacePoints<D> points = surface_points(geometry, 3);
  std::vector<Real> area(geometry.grid.facets.size(), 0);
  for (Index q = 0; q < points.size(); ++q) at(area, at(points.facet, q)) += at(points.area, q);
  return *std::max_element(area.begin(), area.end()) / *std::min_element(area.begin(), area.end());
}

struct Jump {
  Real surface, kinetic;
};

/// Relative changes of energies by a remap of a stretched drop.
template <int D>
Jump jump(int n) {
  Epochs<D> epochs = begun<D>(drop<D>(n, stretched<D>()));
  const Body<D>* body = &epochs.scene().system.bodies.front();
  const Real volume = SurfacePatches<D>(*body).measure(SurfacePatches<D>::Size::volume,
                                                       epochs.simulation().state().u.data());
  EXPECT_GT(Distortion<D>(*body).condition(epochs.simulation().state().u.data()), 2);
  const auto before = take_ledger(epochs.scene().system, epochs.simulation().state());
  const Seeds<D> seeds = seeds_of(epochs);
  epochs.new_epoch({{"drop", seeds}});
  body = &epochs.scene().system.bodies.front();
  const auto after = take_ledger(epochs.scene().system, epochs.simulation().state());
  EXPECT_NEAR(SurfacePatches<D>(*body).reference(SurfacePatches<D>::Size::volume), volume,
              1e-12 * volume);
  EXPECT_LT((after.momentum - before.momentum).norm(), 1e-13);
  EXPECT_LT((after.angular_momentum - before.angular_momentum).norm(), 1e-13);
  EXPECT_LT(unevenness(body->geometry), D == 3 ? 4 : 2);  // before: 7 to 10
  EXPECT_LT(Distortion<D>(*body).condition(epochs.simulation().state().u.data()), 1 + 1e-12);
  return {std::abs(after.stored.at("surface") / before.stored.at("surface") - 1),
          std::abs(after.kinetic / before.kinetic - 1)};
}

template <int D>
void expect_small_jumps(int n, int finer, Real least_order) {
  const Jump coarse = jump<D>(n), fine = jump<D>(finer);
  const Real order =
      std::log(coarse.surface / fine.surface) / std::log(static_cast<Real>(finer) / n);
  fmt::print(
      "reseeded drop, {}D: surface energy {:.2e}, {:.2e}, order {:.2f}; kinetic {:.2e}, {:.2e}\n",
      D, coarse.surface, fine.surface, order, coarse.kinetic, fine.kinetic);
  EXPECT_GT(order, least_order);
  EXPECT_LT(std::max(coarse.kinetic, fine.kinetic), 1e-3);  // velocity coefficients are rough
}

TEST(Reseed, KeepsVolumeAndMomentaAndEnergyWithHighOrder) {
  expect_small_jumps<2>(6, 12, 2);
  expect_small_jumps<3>(4, 6, 2.5);
}

/// A ball that is wetted up to a given height: a ring of evenly spaced nodes lies at this height.
TEST(Reseed, PutsARingOfNodesOnTheContactLine) {
  constexpr Real level = 0.3;
  const Epochs<3> epochs = begun<3>(drop<3>(6, "0, 0, 0"));
  const ContactLine<3> line{[](const Vec<3>& x, Real) { return x[2] + 1; }, level};
  const Seeds<3> seeds = seeds_of<3>(epochs, line);
  const Grid<3>& grid = epochs.scene().system.bodies.front().geometry.grid;
  std::vector<Real> azimuths;
  for (const Index A : boundary_nodes(grid)) {
    const Vec<3>& x = at(seeds.nodes, A);
    EXPECT_NEAR(x.norm(), 1, 2e-4);
    if (std::abs(x[2] + 1 - level) < 1e-3) azimuths.push_back(std::atan2(x[1], x[0]));
  }
  ASSERT_EQ(azimuths.size(), 24U);
  std::sort(azimuths.begin(), azimuths.end());
  for (std::size_t j = 1; j < azimuths.size(); ++j)
    EXPECT_NEAR(azimuths[j] - azimuths[j - 1], 2 * std::numbers::pi / 24, 1e-3);

  const Epochs<2> plane = begun<2>(drop<2>(6, "0, 0"));
  const Seeds<2> ends =
      seeds_of<2>(plane, ContactLine<2>{[](const Vec<2>& x, Real) { return x[1] + 1; }, level});
  EXPECT_EQ(std::count_if(ends.nodes.begin(), ends.nodes.end(),
                          [&](const Vec<2>& x) {
                            return std::abs(x[1] + 1 - level) < 1e-3 &&
                                   std::abs(x.norm() - 1) < 1e-3;
                          }),
            2);
}

/// A drop that began as a half disk (3D: half ball), stretched along its flat face.
template <int D>
std::string half_drop(int n, const std::string& remap) {
  return fmt::format(R"toml(
dimension = {}
[time]
end = 0.1
step = 1e-3
[[body]]
name = "drop"
shape = "{}"
radius = 1
core = {}
{} = {}
initial_displacement = [{}]
material = {{ type = "newtonian", density = 1, bulk_modulus = 20, viscosity = 0.3 }}
[[surface_tension]]
body = "drop"
gamma = 1
[[remap]]
body = "drop"
{}
)toml",
                     D, D == 3 ? "half_sphere" : "half_disk", n, D == 3 ? "layers" : "rings", n / 2,
                     D == 3 ? "'0.3*x', '0.3*y', '-0.4*z'" : "'0.4*x', '-0.28*y'", remap);
}

/// The flat face stays flat and its edge sharp, with the same nodes. A restart builds the same
/// body.
template <int D>
void expect_edge_kept(int n, const std::string& remap) {
  const std::string text = half_drop<D>(n, remap);
  Epochs<D> epochs = begun<D>(text);
  const auto flat_nodes = [](const Epochs<D>& e) {
    const Body<D>& body = e.scene().system.bodies.front();
    std::vector<Index> on_edge;
    for (const Index A : boundary_nodes(body.geometry.grid)) {
      const Vec<D>& X = at(body.particles.X(), A);
      const Real stretch = D == 3 ? 1.3 : 1.4;
      if (std::abs(X[D - 1]) < 1e-3 && X.head(D - 1).norm() > 0.995 * stretch) on_edge.push_back(A);
    }
    return on_edge;
  };
  const Body<D>* body = &epochs.scene().system.bodies.front();
  const Real volume = SurfacePatches<D>(*body).measure(SurfacePatches<D>::Size::volume,
                                                       epochs.simulation().state().u.data());
  const auto before = take_ledger(epochs.scene().system, epochs.simulation().state());
  const auto remapped = epochs.advance();
  ASSERT_TRUE(remapped.new_epoch) << (remapped.warnings.empty() ? "" : remapped.warnings.front());
  const auto after = take_ledger(epochs.scene().system, epochs.simulation().state());
  body = &epochs.scene().system.bodies.front();
  EXPECT_FALSE(body->geometry.surface->smooth());
  EXPECT_NEAR(SurfacePatches<D>(*body).reference(SurfacePatches<D>::Size::volume), volume,
              1e-3 * volume);  // of a step
  EXPECT_NEAR(after.stored.at("surface"), before.stored.at("surface"),
              1e-3 * before.stored.at("surface"));
  EXPECT_EQ(flat_nodes(epochs).size(), D == 3 ? 4 * n : 2);
  const Snapshot state = epochs.simulation().snapshot();
  const SceneInput input = SceneInput::from_text(text);
  scene_dimension(input);
  Epochs<D> restarted(read_plan<D>(input), &state);
  EXPECT_EQ(restarted.simulation().snapshot().hash(), state.hash());
  epochs.advance();
  restarted.advance();
  EXPECT_EQ(restarted.simulation().snapshot().hash(), epochs.simulation().snapshot().hash());
}

TEST(Reseed, KeepsTheEdgeOfAFlatFace) {
  expect_edge_kept<2>(6, "at = [1e-3]");
  expect_edge_kept<2>(6, "at = [1e-3]\nnodes = \"particles\"");
  expect_edge_kept<3>(4, "at = [1e-3]");
  expect_edge_kept<3>(4, "at = [1e-3]\nnodes = \"particles\"");
}

/// The stretches are 2, 1/2 and 1, followed by a rotation by an angle with the cosine 0.8.
TEST(Reseed, FindsTheConditionOfAHomogeneousDeformation) {
  const Epochs<3> epochs = begun<3>(drop<3>(4, "'1.6*x - 0.3*y - x', '1.2*x + 0.4*y - y', '0'"));
  const Body<3>& body = epochs.scene().system.bodies.front();
  EXPECT_NEAR(Distortion<3>(body).condition(epochs.simulation().state().u.data()), 4, 1e-9);
}

/// A plane drop spreads on a wall to 60 degrees. Remaps end when it has come to rest, although its
/// cells go on to stretch beyond the condition.
TEST(Reseed, EndsAtRest) {
  Epochs<2> epochs = begun<2>(
      "dimension = 2\n[time]\nviscosity = \"implicit\"\nend = 20\n[[body]]\nname = \"drop\"\n"
      "shape = \"disk\"\nradius = 1\ncore = 4\nrings = 2\n[body.material]\ntype = \"newtonian\"\n"
      "density = 1\nbulk_modulus = 151\nviscosity = 1\n[[surface_tension]]\nbody = \"drop\"\n"
      "gamma = 1\n[[contact]]\nname = \"wall\"\nbodies = [\"drop\"]\ncontact_angle = 60\n"
      "range = 0.2\npartner = { type = \"half_space\", point = [0, -1.02], normal = [0, 1] }\n"
      "[[remap]]\nbody = \"drop\"\ncondition = 1.5\n");
  const auto condition = [&] {
    return Distortion<2>(epochs.scene().system.bodies.front())
        .condition(epochs.simulation().state().u.data());
  };
  Real last = 0;
  int said = 0;
  for (int step = 0; step < 5000 && !epochs.simulation().finished(); ++step) {
    const auto remapped = epochs.advance();
    if (remapped.new_epoch) last = epochs.simulation().state().time;
    for (const std::string& note : remapped.notes)
      said += note.find("'drop' keeps its reference at rest") != std::string::npos;
  }
  EXPECT_TRUE(epochs.simulation().finished());
  EXPECT_GT(epochs.simulation().state().epoch, 2);
  EXPECT_LT(last, 10);
  EXPECT_GT(condition(), 1.5);
  EXPECT_EQ(said, 1);
}

/// A drop that is drawn out is remapped automatically. Restarts from any state give the same bits.
TEST(Reseed, IsDoneWhenTheConditionIsReachedAndRestartsWithTheSameBits) {
  const std::string text =
      drop<2>(6, "'0.6*x', '-0.375*y'") + "[[remap]]\nbody = \"drop\"\ncondition = 2\n";
  Epochs<2> epochs = begun<2>(text);
  std::vector<Snapshot> states;
  int remaps = 0;
  for (int step = 0; step < 120; ++step) {
    remaps += epochs.advance().new_epoch;
    states.push_back(epochs.simulation().snapshot());
  }
  EXPECT_GE(remaps, 1);
  const SceneInput input = SceneInput::from_text(text);
  scene_dimension(input);
  for (const std::size_t k : {std::size_t{20}, std::size_t{80}}) {
    Epochs<2> restarted(read_plan<2>(input), &states[k]);
    for (std::size_t l = k + 1; l < states.size(); ++l) restarted.advance();
    EXPECT_EQ(restarted.simulation().snapshot().hash(), states.back().hash());
  }
}

}  // namespace
}  // namespace meniscus::test_reseed
