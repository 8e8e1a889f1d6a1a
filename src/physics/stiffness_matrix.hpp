// SPDX-License-Identifier: BSD-3-Clause
// The tangent of forces as a sparse matrix, assembled from dense matrices of elements.
#pragma once
#include "parallel/aligned.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

namespace meniscus {

/// A symmetric sparse matrix, the sum of dense matrices of elements. Its unknowns belong to nodes:
/// the D displacement coefficients of each particle, and further unknowns of terms, such as
/// pressures, one for each node. An element is a set of nodes that all meet, such as the particles
/// of a nodal cell. A further node can also meet many particles by a column of its own.
class StiffnessMatrix {
 public:
  /// The dense matrix of an element. Its rows are the first components of all particles, then the
  /// second ones and so on, then the other nodes. Blocks of two components are read if they are not
  /// below the diagonal.
  class Element {
   public:
    Eigen::Map<Eigen::MatrixXd> resize(Eigen::Index size) {
      size_ = size;
      if (const auto needed = static_cast<std::size_t>(size * size); values_.size() < needed)
        values_.resize(needed);
      return {values_.data(), size, size};
    }
    const Real* column(Eigen::Index number) const { return values_.data() + number * size_; }

   private:
    std::vector<Real> values_;
    Eigen::Index size_ = 0;
  };

  StiffnessMatrix(Index particles, int dimension);

  /// Adds nodes of one unknown each; returns the number of the first one. Before close(). Such an
  /// unknown is eliminated: it gives one negative eigenvalue, or none if it is at a minimum of the
  /// energy (`least`).
  Index add_nodes(Index count, bool least = false);
  /// Number of negative eigenvalues of a stable state.
  Index negative_if_stable() const {
    return unknowns() - particles_ * dimension_ - static_cast<Index>(least_.size());
  }
  /// Announces an element with these nodes, in ascending order; returns its number. Before close().
  Index announce(std::span<const Index> nodes);
  /// Announces that a further node meets particles, which need not meet each other. Before close().
  void announce_column(Index node, std::vector<Index> particles);
  /// Finds the pattern of all elements.
  void close();
  /// True after close(): on the process that assembles the matrix.
  bool is_here() const { return !value_.empty(); }

  /// Sets all values to zero.
  void clear() { std::fill(value_.begin(), value_.end(), 0.0); }
  /// Adds the matrices that make(k, matrix) sets for the elements first + k, 0 <= k < count. The
  /// calls run in parallel; the sums have the same bits for any number of threads.
  template <class Make>
  void add(Index first, Index count, Make&& make) {
    add_batches(
        count, [first](Index k) { return first + k; }, make);
  }
  /// Adds the matrices that make(k, matrix) sets for the elements first + k for k in `some`.
  template <class Make>
  void add(Index first, std::span<const Index> some, Make&& make) {
    add_batches(
        static_cast<Index>(some.size()), [&](Index n) { return first + at(some, n); },
        [&](Index n, Element& element) { make(at(some, n), element); });
  }
  /// Adds a vector to the column and the row of a further node, at the particles that were
  /// announced for it.
  void add_column(Index node, std::span<const NodalVector> vector);
  /// Ends the addition of elements and columns. Further nodes without a diagonal entry get -1, or 1
  /// at a minimum.
  void complete();
  /// Adds a number to the diagonal entries of a node.
  void add_to_diagonal(Index node, Real amount);
  /// The mean of the absolute diagonal entries of particles.
  Real mean_diagonal() const;

  Index unknowns() const { return static_cast<Index>(column_start_.size()) - 1; }
  Index particles() const { return particles_; }
  /// Columns: the entries of column j are start()[j], ..., start()[j + 1] - 1, with ascending rows.
  std::span<const Index> start() const { return column_start_; }
  std::span<const Index> row() const { return row_; }
  std::span<const Real> value() const { return value_; }
  /// An order of elimination for which factors stay small: minimum degree of nodes. [place] unknown
  std::vector<Index> order() const;

 private:
  Index nodes() const { return static_cast<Index>(first_of_.size()) - 1; }
  int size_of(Index node) const { return node < particles_ ? dimension_ : 1; }
  std::span<const Index> nodes_of(Index element) const {
    const Offset begin = at(element_start_, element), end = at(element_start_, element + 1);
    return std::span(element_node_)
        .subspan(static_cast<std::size_t>(begin), static_cast<std::size_t>(end - begin));
  }
  template <class Number, class Make>
  void add_batches(Index count, Number&& number, Make&& make) {
    constexpr Index batch = 32;
    room_.resize(batch);
    std::vector<Index> numbers;
    for (Index begin = 0; begin < count; begin += batch) {
      const Index end = std::min(begin + batch, count);
      numbers.clear();
      for (Index n = begin; n < end; ++n) numbers.push_back(number(n));
      parallel_for(
          end - begin, [&](Index k) { make(begin + k, at(room_, k)); }, 1);
      scatter(numbers);
    }
  }
  /// Adds the matrices in room_ to these elements.
  void scatter(std::span<const Index> elements);
  void scatter(Index element, const Element& matrix, Index begin, Index end);

  Index particles_;
  int dimension_;
  std::vector<Index> least_;              // further nodes at a minimum
  std::vector<Index> first_of_;           // [node] its first unknown
  std::vector<Offset> element_start_{0};  // [element]
  std::vector<Index> element_node_;
  std::vector<std::pair<Index, std::vector<Index>>> columns_;  // announced for further nodes
  std::vector<Offset> neighbor_start_;                         // [node]
  std::vector<Index> neighbor_;  // nodes that it meets, ascending, with itself
  std::vector<Index> place_;     // [neighbor] its first row within a column of the node
  std::vector<Index> column_start_{0}, row_;
  std::vector<Index> diagonal_;  // [unknown] its diagonal entry
  std::vector<Index> source_;    // [entry] itself, or the entry on the other side of the diagonal
  std::vector<Real> value_;
  std::vector<Element> room_;
};

}  // namespace meniscus
