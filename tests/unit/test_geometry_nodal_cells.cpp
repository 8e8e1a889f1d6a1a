// SPDX-License-Identifier: BSD-3-Clause
// Nodal cells: reference values, discrete identities, and points shared bit for bit.
#include "body/grid/nodal_cells.hpp"
#include "meniscus/body/shapes.hpp"
#include "meniscus/error.hpp"
#include "thrown.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <map>
#include <vector>

namespace meniscus::test_geometry_nodal_cells {
namespace {

template <int D>
Grid<D> jittered_brick() {
  Brick<D> brick;
  brick.cells = D == 3 ? std::vector<Real>{4, 3, 5} : std::vector<Real>{6, 7};
  brick.centre.assign(D, 20);
  Grid<D> grid = brick.geometry().grid;
  jitter_interior(grid, 0.2, 7);
  return grid;
}

/// Equal cells with oblique edges, whose moments are known without quadrature points.
template <int D>
Grid<D> oblique_brick() {
  Brick<D> brick;
  brick.cells = D == 3 ? std::vector<Real>{4, 3, 5} : std::vector<Real>{6, 7};
  Grid<D> grid = brick.geometry().grid;
  Mat<D> F = Mat<D>::Identity();
  for (int i = 0; i < D; ++i)
    for (int k = 0; k < D; ++k) F(i, k) += 0.3 * i - 0.1 * k;
  for (Vec<D>& X : grid.X) X = F * X;
  return grid;
}

template <int D>
Grid<D> round_grid() {
  if constexpr (D == 3) {
    Ball ball;
    ball.core = 4;
    ball.layers = 2;
    return ball.geometry().grid;
  } else {
    return Disk{}.geometry().grid;
  }
}

/// oint n dA = 0 and oint n_K (X - Xb)_M dA = V delta_KM over every nodal cell, the volumes add up,
/// and centroid and covariance are the moments of the volume points.
template <int D>
void expect_identities(const Grid<D>& grid) {
  const NodalCells<D> cells(grid);
  CellQuadrature<D> q;
  Real total = 0;
  for (Index node = 0; node < cells.size(); ++node) {
    cells.quadrature(node, q);
    const Real V = cells.volume(node);
    const Vec<D> centre = cells.centroid(node);
    Vec<D> closed = Vec<D>::Zero(), first = Vec<D>::Zero();
    Mat<D> moment = Mat<D>::Zero(), second = Mat<D>::Zero();
    Real area = 0, volume_sum = 0;
    for (std::size_t p = 0; p < q.facet_X.size(); ++p) {
      closed += q.facet_dA[p];
      area += q.facet_dA[p].norm();
      moment += q.facet_dA[p] * (q.facet_X[p] - centre).transpose();
    }
    for (std::size_t p = 0; p < q.volume_X.size(); ++p) {
      const Vec<D> arm = q.volume_X[p] - centre;
      volume_sum += q.volume_w[p];
      first += q.volume_w[p] * arm;
      second += q.volume_w[p] * (arm * arm.transpose());
    }
    const Real length = V / area;
    ASSERT_LT(closed.norm(), 1e-14 * area) << "node " << node;
    ASSERT_LT((moment - V * Mat<D>::Identity()).norm(), 1e-13 * V) << "node " << node;
    ASSERT_NEAR(volume_sum, V, 1e-14 * V);
    // Positions near 20 carry rounding errors of 4e-15.
    ASSERT_LT(first.norm(), 1e-12 * V * length);
    ASSERT_LT((second / V - cells.covariance(node)).norm(), 1e-12 * length * length);
    total += V;
  }
  EXPECT_NEAR(total, volume(grid), 1e-13 * total);
}

TEST(NodalCells, IdentitiesOnJitteredBrick) {
  expect_identities(jittered_brick<2>());
  expect_identities(jittered_brick<3>());
}

TEST(NodalCells, IdentitiesOnObliqueBricks) {
  expect_identities(oblique_brick<2>());
  expect_identities(oblique_brick<3>());
}

TEST(NodalCells, IdentitiesOnRoundGrids) {
  expect_identities(round_grid<2>());
  expect_identities(round_grid<3>());
}

TEST(NodalCells, LatticeMatchesReference) {
  std::ifstream file(MENISCUS_TEST_DATA "/nodal_cells.json");
  const auto data = nlohmann::json::parse(file);
  Brick<3> brick;
  brick.size = {2, 2, 2};
  brick.cells = {2, 2, 2};
  brick.corner = {0, 0, 0};
  const Grid<3> grid = brick.geometry().grid;
  const NodalCells<3> cells(grid);
  ASSERT_EQ(data.at("cases").size(), 2u);
  for (const auto& test : data.at("cases")) {
    const int number = test.at("node");
    const Vec<3> place(number / 9, number / 3 % 3, number % 3);
    const auto found = std::find_if(grid.X.begin(), grid.X.end(),
                                    [&](const Vec<3>& X) { return (X - place).norm() < 1e-12; });
    ASSERT_NE(found, grid.X.end());
    const auto node = static_cast<Index>(found - grid.X.begin());
    EXPECT_NEAR(cells.volume(node), test.at("V").get<Real>(), 1e-13);
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(cells.centroid(node)[i], test.at("centroid").at(i).get<Real>(), 1e-13);
      for (int j = 0; j < 3; ++j)
        EXPECT_NEAR(cells.covariance(node)(i, j), test.at("S").at(i).at(j).get<Real>(), 1e-13);
    }
  }
}

template <int D>
std::vector<Real> bits_of(const Vec<D>& X, const Vec<D>& dA) {
  std::vector<Real> key(X.data(), X.data() + D);
  key.insert(key.end(), dA.data(), dA.data() + D);
  for (Real& value : key) value += 0.0;  // -0 becomes +0
  return key;
}

/// Every point between two nodal cells occurs twice with opposite vectors, bit for bit; the others
/// bound the body.
template <int D>
void expect_shared_points(const Grid<D>& grid) {
  const NodalCells<D> cells(grid);
  std::map<std::vector<Real>, int> balance;
  Vec<D> body = Vec<D>::Zero();
  Mat<D> moment = Mat<D>::Zero();
  CellQuadrature<D> q;
  std::size_t inner_points = 0;
  for (Index node = 0; node < cells.size(); ++node) {
    cells.quadrature(node, q);
    inner_points += q.body_facets_begin;
    for (std::size_t p = 0; p < q.body_facets_begin; ++p) {
      const auto key = bits_of<D>(q.facet_X[p], q.facet_dA[p]);
      const auto opposite = bits_of<D>(q.facet_X[p], -q.facet_dA[p]);
      if (const auto partner = balance.find(opposite); partner != balance.end()) {
        if (--partner->second == 0) balance.erase(partner);
      } else {
        ++balance[key];
      }
    }
    for (std::size_t p = q.body_facets_begin; p < q.facet_X.size(); ++p) {
      body += q.facet_dA[p];
      moment += q.facet_dA[p] * q.facet_X[p].transpose();
    }
  }
  EXPECT_TRUE(balance.empty());
  std::size_t expected = 0;  // every octant has a facet across each direction
  for (Index e = 0; e < grid.cell_count(); ++e)
    for (int across = 0; across < D; ++across) {
      std::size_t points = 1;
      for (int k = 0; k < D; ++k)
        if (k != across) points *= grid.bulge(e) && (grid.bulge(e)->curved >> k) & 1 ? D + 2 : 3;
      expected += points << D;
    }
  EXPECT_EQ(inner_points, expected);
  const Real V = volume(grid);
  EXPECT_LT(body.norm(), 1e-13 * V);
  EXPECT_LT((moment - V * Mat<D>::Identity()).norm(), 1e-12 * V);
}

TEST(NodalCells, NeighboursShareTheirPoints) {
  expect_shared_points(round_grid<2>());
  expect_shared_points(round_grid<3>());
  expect_shared_points(jittered_brick<3>());
}

TEST(NodalCells, NodeWithoutCellIsRefused) {
  Grid<2> grid = jittered_brick<2>();
  grid.X.push_back(Vec<2>(9, 9));
  EXPECT_THROW_WITH(NodalCells<2>{grid}, InputError, "belongs to no cell");
}

}  // namespace
}  // namespace meniscus::test_geometry_nodal_cells
