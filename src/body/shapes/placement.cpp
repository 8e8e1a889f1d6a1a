// SPDX-License-Identifier: BSD-3-Clause
// Bodies mapped by formulas, turned and moved.
#include "body/shapes/placement.hpp"

#include "body/surface/surface_points.hpp"
#include "kernel/neighbor_search.hpp"
#include "meniscus/error.hpp"
#include "numbers/box.hpp"
#include "numbers/dense.hpp"

#include <fmt/core.h>

#include <Eigen/Geometry>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>

namespace meniscus {
namespace {

template <int D>
std::string coordinates(const Vec<D>& X) {
  std::string text;
  for (int k = 0; k < D; ++k) text += fmt::format("{}{} = {:.6g}", k ? ", " : "", "xyz"[k], X[k]);
  return text;
}

/// Throws InputError if the map folds the body. Checks the nodes, the middles of cells and the
/// surface, where a fold appears first.
template <int D>
void require_no_fold(const SmoothMap<D>& map, const Geometry<D>& geometry) {
  const auto check = [&](const Vec<D>& X) {
    const MapPoint<D> p = map(X);
    bool finite = p.x.allFinite() && p.F.allFinite();
    for (const Mat<D>& G : p.G) finite = finite && G.allFinite();
    if (!finite)
      throw InputError(fmt::format(
          "is not finite, or has no finite first and second derivatives, at {}", coordinates(X)));
    const Real J = determinant<D>(p.F);
    if (!(J > 0))
      throw InputError(
          fmt::format("folds the body at {}: its Jacobian is {:.4g} there, but must be positive",
                      coordinates(X), J));
  };
  for (const Vec<D>& X : geometry.grid.X) check(X);
  for (const Vec<D>& X : cell_gauss_points(geometry.grid, 1).X) check(X);
  for (const Vec<D>& X : surface_points(geometry, 2).X) check(X);
}

/// The inverse of the map: finds X0 with x(X0) = x by Newton's method, starting from the nearest
/// node.
template <int D>
class Inverse {
 public:
  Inverse(SmoothMap<D> map, std::vector<Vec<D>> nodes)
      : map_(std::move(map)), nodes_(std::move(nodes)) {
    std::vector<Vec<D>> x;
    for (const Vec<D>& X : nodes_) x.push_back(map_(X).x);
    spread_ = box_around<D>(x).extent().norm();
    mapped_ = std::make_unique<NeighborSearch<D>>(std::move(x));
  }

  Vec<D> operator()(const Vec<D>& x) const {
    std::vector<Index> near;
    mapped_->within(x, mapped_->distance_of_nearest(x, 1) * (1 + 1e-9) + 1e-9 * spread_, near);
    Vec<D> X0 = at(nodes_, near.front());
    for (int k = 0; k < 50; ++k) {
      const MapPoint<D> p = map_(X0);
      const Vec<D> error = x - p.x;
      X0 += inverse<D>(p.F) * error;
      if (error.norm() < 1e-13 * spread_) break;
    }
    return X0;
  }

 private:
  SmoothMap<D> map_;
  std::vector<Vec<D>> nodes_;
  Real spread_;
  std::unique_ptr<NeighborSearch<D>> mapped_;
};

template <int D>
std::function<Vec<D>(const Vec<D>&)> inverse_of(const SmoothMap<D>& map,
                                                const std::vector<Vec<D>>& nodes) {
  return [inverse = std::make_shared<const Inverse<D>>(map, nodes)](const Vec<D>& x) {
    return (*inverse)(x);
  };
}

template <int D>
std::optional<Mat<D>> read_rotation(const Block& block) {
  const Real angle = block.real("rotate", dimension::degrees, range::any, 0.0);
  Vec<D> axis = Vec<D>::Unit(D - 1);
  if constexpr (D == 3) {
    const auto given =
        block.reals("rotate_axis", 3, dimension::none, range::any, std::vector<Real>{0, 0, 1});
    axis = Vec<3>::Map(given.data());
    if (!(axis.norm() > 0)) {
      block.problem("rotate_axis", "has no direction; allowed are three numbers not all zero");
      return {};
    }
    if (block.has("rotate_axis") && !block.has("rotate"))
      block.problem("rotate_axis", "has no meaning without rotate, an angle");
  }
  if (angle == 0) return {};
  const Real radians = angle * std::numbers::pi / 180;
  if constexpr (D == 3)
    return Eigen::AngleAxis<Real>(radians, axis.normalized()).toRotationMatrix();
  else
    return Eigen::Rotation2D<Real>(radians).toRotationMatrix();
}

}  // namespace

template <int D>
SmoothMap<D> formula_map(std::vector<Expression> formulas) {
  return [formulas = std::move(formulas)](const Vec<D>& X) {
    MapPoint<D> point;
    for (int i = 0; i < D; ++i) {
      const Jet<3> x = at(formulas, i).jet(spatial<D>(X));
      point.x[i] = x.value;
      point.F.row(i) = x.gradient.template head<D>().transpose();
      at(point.G, i) = x.hessian.template topLeftCorner<D, D>();
    }
    return point;
  };
}

template <int D>
Geometry<D> placed(const SmoothMap<D>& map, Geometry<D> geometry) {
  require_no_fold(map, geometry);
  const auto before = geometry.director;
  std::function<Vec<D>(const Vec<D>&)> back;
  if (before) back = inverse_of(map, geometry.grid.X);
  geometry = apply_map(map, std::move(geometry));
  if (before)
    geometry.director = [map, before, back](const Vec<D>& X) -> Vec<D> {
      const Vec<D> X0 = back(X);
      return (inverse<D>(map(X0).F).transpose() * before(X0)).normalized();
    };
  return geometry;
}

template <int D>
Geometry<D> read_placement(const Block& block, Geometry<D> geometry) {
  std::vector<Expression> formulas;
  if (block.has("map"))
    formulas = block.expressions("map", D, dimension::length, {}, Variables::place);
  const std::optional<Mat<D>> rotation = read_rotation<D>(block);
  const std::vector<Real> move =
      block.reals("move", D, dimension::length, range::any, std::vector<Real>(D, 0.0));
  if (!block.in_order()) return geometry;
  const auto apply = [&](const char* key, const SmoothMap<D>& map) {
    try {
      geometry = placed(map, std::move(geometry));
    } catch (const InputError& error) {
      block.problem(key, error.what());
    }
    return block.in_order();
  };
  if (!formulas.empty() && !apply("map", formula_map<D>(std::move(formulas)))) return geometry;
  if (rotation) {
    const Vec<D> middle = box_around<D>(geometry.grid.X).centre();
    if (!apply("rotate", affine_map<D>(*rotation, middle - *rotation * middle))) return geometry;
  }
  const Vec<D> shift = Vec<D>::Map(move.data());
  if (!shift.isZero(0)) apply("move", affine_map<D>(Mat<D>::Identity(), shift));
  return geometry;
}

#define MENISCUS_INSTANTIATE(D)                                  \
  template SmoothMap<D> formula_map(std::vector<Expression>);    \
  template Geometry<D> placed(const SmoothMap<D>&, Geometry<D>); \
  template Geometry<D> read_placement(const Block&, Geometry<D>);
MENISCUS_INSTANTIATE(2)
MENISCUS_INSTANTIATE(3)
#undef MENISCUS_INSTANTIATE

}  // namespace meniscus
