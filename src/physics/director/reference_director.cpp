// SPDX-License-Identifier: BSD-3-Clause
// Directors given by formulas, or by the walls of a shape.
#include "physics/director/reference_director.hpp"

#include "meniscus/error.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meniscus {

ReferenceDirector::ReferenceDirector(const Block& block, int dimension) : place_(block.place(key)) {
  if (!block.has(key)) return;
  formulas_ = block.expressions(key, static_cast<std::size_t>(dimension), dimension::none,
                                std::vector<Expression>(static_cast<std::size_t>(dimension), 1.0),
                                Variables::place);
}

bool ReferenceDirector::uniform() const {
  return !formulas_.empty() &&
         std::all_of(formulas_.begin(), formulas_.end(),
                     [](const Expression& formula) { return formula.constant(); });
}

template <int D>
Eigen::Vector3d ReferenceDirector::at(const Vec<D>& X, const Geometry<D>& geometry) const {
  const Eigen::Vector3d place = spatial<D>(X);
  Eigen::Vector3d h = Eigen::Vector3d::Zero();
  if (!formulas_.empty()) {
    for (int i = 0; i < D; ++i) h[i] = meniscus::at(formulas_, i).unchecked(place);
  } else if (geometry.director) {
    h.head<D>() = geometry.director(X);
  } else {
    throw InputError(fmt::format(
        "{}: {} is missing: the shape has no walls whose normal it could be; give {} numbers or "
        "formulas",
        place_, key, D));
  }
  const Real length = h.norm();
  if (!(length > 0) || !std::isfinite(length))
    throw InputError(
        fmt::format("{}: ({:.6g}, {:.6g}, {:.6g}) has no direction at X = ({:.6g}, "
                    "{:.6g}, {:.6g})",
                    place_, h[0], h[1], h[2], place[0], place[1], place[2]));
  return h / length;
}

template <int D>
Real largest_turn(const Grid<D>& grid, std::span<const Eigen::Vector3d> director) {
  Real least_cosine = 1;
  for (const auto& cell : grid.cells)
    for (int a = 0; a < Grid<D>::corners; ++a)
      for (int k = 0; k < D; ++k)
        if (const int b = a | 1 << k; b != a)
          least_cosine = std::min(
              least_cosine, std::abs(meniscus::at(director, meniscus::at(cell, a))
                                         .dot(meniscus::at(director, meniscus::at(cell, b)))));
  return std::acos(least_cosine);
}

std::optional<std::string> doubt_of_director(Real turn) {
  constexpr Real bearable = 0.005;
  const Real error = turn * turn / 12;
  if (error < bearable) return std::nullopt;
  return fmt::format(
      "the director turns by up to {:.0f} degrees from cell to cell, but integration = \"q_scni\" "
      "has one per cell: energies are off by up to {:.1g} there; use finer cells, or integration = "
      "\"gauss\"",
      turn * 180 / std::numbers::pi, error);
}

template Real largest_turn(const Grid<2>&, std::span<const Eigen::Vector3d>);
template Real largest_turn(const Grid<3>&, std::span<const Eigen::Vector3d>);
template Eigen::Vector3d ReferenceDirector::at(const Vec<2>&, const Geometry<2>&) const;
template Eigen::Vector3d ReferenceDirector::at(const Vec<3>&, const Geometry<3>&) const;

}  // namespace meniscus
