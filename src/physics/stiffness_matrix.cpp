// SPDX-License-Identifier: BSD-3-Clause
// Pattern and assembly of stiffness matrices.
#include "physics/stiffness_matrix.hpp"

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>
#include <cmath>

namespace meniscus {

StiffnessMatrix::StiffnessMatrix(Index particles, int dimension)
    : particles_(particles), dimension_(dimension) {
  for (Index A = 0; A <= particles; ++A) first_of_.push_back(A * dimension);
}

Index StiffnessMatrix::add_nodes(Index count, bool least) {
  const Index first = nodes();
  for (Index k = 0; k < count; ++k) {
    if (least) least_.push_back(nodes());
    first_of_.push_back(first_of_.back() + 1);
  }
  return first;
}

Index StiffnessMatrix::announce(std::span<const Index> nodes) {
  element_node_.insert(element_node_.end(), nodes.begin(), nodes.end());
  element_start_.push_back(static_cast<Offset>(element_node_.size()));
  return static_cast<Index>(element_start_.size()) - 2;
}

void StiffnessMatrix::announce_column(Index node, std::vector<Index> particles) {
  columns_.emplace_back(node, std::move(particles));
}

void StiffnessMatrix::close() {
  const auto elements = static_cast<Index>(element_start_.size()) - 1;
  std::vector<std::vector<Index>> elements_of(static_cast<std::size_t>(nodes())),
      neighbors(static_cast<std::size_t>(nodes()));
  for (Index e = 0; e < elements; ++e)
    for (const Index node : nodes_of(e)) at(elements_of, node).push_back(e);
  for (const auto& [node, particles] : columns_)
    for (const Index A : particles) {
      at(neighbors, A).push_back(node);
      at(neighbors, node).push_back(A);
    }
  for_chunks(nodes(), [&](Index, Index begin, Index end) {
    std::vector<Index> seen(static_cast<std::size_t>(nodes()), -1);
    for (Index node = begin; node < end; ++node) {
      std::vector<Index> all;
      const auto take = [&](Index other) {
        if (std::exchange(at(seen, other), node) != node) all.push_back(other);
      };
      take(node);
      for (const Index e : at(elements_of, node))
        for (const Index other : nodes_of(e)) take(other);
      for (const Index other : at(neighbors, node)) take(other);
      std::sort(all.begin(), all.end());
      at(neighbors, node).swap(all);
    }
  });
  neighbor_start_.assign(1, 0);
  for (Index node = 0; node < nodes(); ++node) {
    Index rows = 0;
    for (const Index other : at(neighbors, node)) {
      neighbor_.push_back(other);
      place_.push_back(rows);
      rows += size_of(other);
    }
    neighbor_start_.push_back(static_cast<Offset>(neighbor_.size()));
    for (int j = 0; j < size_of(node); ++j) {
      for (const Index other : at(neighbors, node))
        for (int i = 0; i < size_of(other); ++i) row_.push_back(at(first_of_, other) + i);
      column_start_.push_back(static_cast<Index>(row_.size()));
    }
  }
  value_.resize(row_.size());
  std::vector<Index> component(static_cast<std::size_t>(unknowns()), dimension_);
  for (Index j = 0; j < particles_ * dimension_; ++j) at(component, j) = j % dimension_;
  // Elements give blocks of two components above the diagonal, and the lower part of blocks on it.
  const auto is_given = [&](Index row, Index column) {
    const Index i = at(component, row), j = at(component, column);
    return i < j || (i == j && row >= column);
  };
  // Rows ascend in each column, and the pattern is symmetric: going through the columns in order
  // meets the entries of each row in the order in which they stand in its column.
  std::vector<Index> next(column_start_.begin(), column_start_.end() - 1);
  for (Index column = 0; column < unknowns(); ++column)
    for (Index e = at(column_start_, column); e < at(column_start_, column + 1); ++e) {
      const Index other = at(next, at(row_, e))++;
      source_.push_back(is_given(at(row_, e), column) ? e : other);
      if (at(row_, e) == column) diagonal_.push_back(e);
    }
}

void StiffnessMatrix::scatter(std::span<const Index> elements) {
  constexpr Index parts = 16;  // of the columns
  parallel_for(
      parts,
      [&](Index part) {
        const auto begin = static_cast<Index>(Offset{nodes()} * part / parts),
                   end = static_cast<Index>(Offset{nodes()} * (part + 1) / parts);
        for (std::size_t k = 0; k < elements.size(); ++k)
          scatter(elements[k], room_[k], begin, end);
      },
      1);
}

/// Adds the columns of the nodes begin, ..., end - 1 of an element.
void StiffnessMatrix::scatter(Index element, const Element& matrix, Index begin, Index end) {
  const std::span<const Index> nodes = nodes_of(element);
  const auto position = [&](Index node) {
    return static_cast<Index>(std::lower_bound(nodes.begin(), nodes.end(), node) - nodes.begin());
  };
  const Index all = static_cast<Index>(nodes.size()), m = position(particles_);
  thread_local std::vector<Index> place;  // of the nodes in columns of b
  for (Index b = position(begin); b < all && at(nodes, b) < end; ++b) {
    place.clear();
    Offset neighbor = at(neighbor_start_, at(nodes, b));
    for (const Index other : nodes) {
      while (at(neighbor_, neighbor) != other) ++neighbor;
      place.push_back(at(place_, neighbor));
    }
    const auto add = [&](Real* to, Index first, const Real* from, Index i) {
      for (Index a = first; a < m; ++a) to[at(place, a) + i] += from[i * m + a];
    };
    Real* to = value_.data() + at(column_start_, at(first_of_, at(nodes, b)));
    const auto rows = at(column_start_, at(first_of_, at(nodes, b)) + 1) -
                      at(column_start_, at(first_of_, at(nodes, b)));
    if (b < m) {
      for (int j = 0; j < dimension_; ++j, to += rows) {
        for (int i = 0; i < j; ++i) add(to, 0, matrix.column(j * m + b), i);
        add(to, b, matrix.column(j * m + b), j);
      }
    } else {
      const Index of_particles = m * (dimension_ - 1);
      const Real* from = matrix.column(of_particles + b);
      for (int i = 0; i < dimension_; ++i) add(to, 0, from, i);
      for (Index a = b; a < all; ++a) to[at(place, a)] += from[of_particles + a];
    }
  }
}

void StiffnessMatrix::add_column(Index node, std::span<const NodalVector> vector) {
  const Index column = at(first_of_, node);
  for (Index e = at(column_start_, column); e < at(column_start_, column + 1); ++e)
    if (const Index row = at(row_, e); row < particles_ * dimension_)
      at(value_, e) += at(vector, row / dimension_)[row % dimension_];
}

/// Fills in the entries that elements and columns do not give.
void StiffnessMatrix::complete() {
  for (const Index node : least_)
    if (Real& own = at(value_, at(diagonal_, at(first_of_, node))); own == 0) own = 1;
  for (Index j = particles_ * dimension_; j < unknowns(); ++j)
    if (Real& own = at(value_, at(diagonal_, j)); own == 0) own = -1;
  sweep(static_cast<Index>(value_.size()), [&](Index begin, Index end) {
    for (Index e = begin; e < end; ++e)
      if (at(source_, e) != e) at(value_, e) = at(value_, at(source_, e));
  });
}

void StiffnessMatrix::add_to_diagonal(Index node, Real amount) {
  for (int j = 0; j < size_of(node); ++j)
    at(value_, at(diagonal_, at(first_of_, node) + j)) += amount;
}

Real StiffnessMatrix::mean_diagonal() const {
  const Index count = particles_ * dimension_;
  Real sum = 0;
  for (Index j = 0; j < count; ++j) sum += std::abs(at(value_, at(diagonal_, j)));
  return sum / std::max<Index>(count, 1);
}

std::vector<Index> StiffnessMatrix::order() const {
  const std::vector<int> start(neighbor_start_.begin(), neighbor_start_.end());
  const std::vector<Real> ones(neighbor_.size(), 1.0);
  const Eigen::SparseMatrix<Real> pattern = Eigen::Map<const Eigen::SparseMatrix<Real>>(
      nodes(), nodes(), static_cast<Eigen::Index>(neighbor_.size()), start.data(), neighbor_.data(),
      ones.data());
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> of_nodes;
  Eigen::AMDOrdering<int>()(pattern, of_nodes);
  std::vector<Index> order;
  for (const int node : of_nodes.indices())
    for (int i = 0; i < size_of(node); ++i) order.push_back(at(first_of_, node) + i);
  return order;
}

}  // namespace meniscus
