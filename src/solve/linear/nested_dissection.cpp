// SPDX-License-Identifier: BSD-3-Clause
// Nested dissection of a grid, by the positions of its nodes.
#include "solve/linear/nested_dissection.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace meniscus {
namespace {

template <int D>
class Dissection {
 public:
  explicit Dissection(const Grid<D>& grid)
      : X_(grid.X), neighbors_(grid.X.size()), half_of_(grid.X.size(), 0) {
    for (const auto& cell : grid.cells)
      for (const Index a : cell)
        for (const Index b : cell)
          if (a != b) at(neighbors_, a).push_back(b);
    std::vector<Index> all(grid.X.size());
    std::iota(all.begin(), all.end(), 0);
    order_.reserve(all.size());
    cut(std::move(all));
  }

  std::vector<Index> order() && { return std::move(order_); }

 private:
  void cut(std::vector<Index> nodes) {
    constexpr std::size_t few = 16;
    if (nodes.size() <= few) {
      order_.insert(order_.end(), nodes.begin(), nodes.end());
      return;
    }
    Vec<D> low = at(X_, nodes.front()), high = low;
    for (const Index n : nodes) {
      low = low.cwiseMin(at(X_, n));
      high = high.cwiseMax(at(X_, n));
    }
    int axis = 0;
    (high - low).maxCoeff(&axis);
    const auto middle = nodes.begin() + static_cast<std::ptrdiff_t>(nodes.size() / 2);
    const auto before = [&](Index a, Index b) {
      return std::pair(at(X_, a)[axis], a) < std::pair(at(X_, b)[axis], b);
    };
    std::nth_element(nodes.begin(), middle, nodes.end(), before);
    // Nodes with the same coordinate stay together.
    const Real place = at(X_, *middle)[axis];
    auto half =
        std::partition(nodes.begin(), middle, [&](Index n) { return at(X_, n)[axis] < place; });
    if (half == nodes.begin()) half = middle;
    std::vector<Index> first, between, second(half, nodes.end());
    ++cuts_;
    for (const Index n : second) at(half_of_, n) = cuts_;
    for (auto n = nodes.begin(); n != half; ++n) {
      const auto& near = at(neighbors_, *n);
      const bool touches =
          std::any_of(near.begin(), near.end(), [&](Index m) { return at(half_of_, m) == cuts_; });
      (touches ? between : first).push_back(*n);
    }
    nodes = {};
    // Sort, because partitioning leaves an order that depends on the standard library.
    for (auto* part : {&first, &second, &between}) std::sort(part->begin(), part->end());
    cut(std::move(first));
    cut(std::move(second));
    order_.insert(order_.end(), between.begin(), between.end());
  }

  const std::vector<Vec<D>>& X_;
  std::vector<std::vector<Index>> neighbors_;
  std::vector<Index> half_of_;  ///< [node] the last cut that put it into the second half
  Index cuts_ = 0;
  std::vector<Index> order_;
};

}  // namespace

template <int D>
std::vector<Index> nested_dissection(const Grid<D>& grid) {
  return Dissection<D>(grid).order();
}

template std::vector<Index> nested_dissection(const Grid<2>&);
template std::vector<Index> nested_dissection(const Grid<3>&);

}  // namespace meniscus
