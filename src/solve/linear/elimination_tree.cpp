// SPDX-License-Identifier: BSD-3-Clause
// The elimination tree of a sparse symmetric matrix (Liu, SIAM J. Matrix Anal. Appl. 11, 1990) and
// its fronts.
#include "solve/linear/elimination_tree.hpp"

#include <algorithm>
#include <numeric>

namespace meniscus {
namespace {

/// A matrix in its order of elimination.
struct Ordered {
  std::span<const Index> start, row;
  std::vector<Index> order, place;  // inverse of each other

  Ordered(std::span<const Index> starts, std::span<const Index> rows, std::vector<Index> of_places)
      : start(starts), row(rows), order(std::move(of_places)), place(order.size()) {
    for (Index k = 0; k < size(); ++k) at(place, at(order, k)) = k;
  }
  Index size() const { return static_cast<Index>(order.size()); }

  /// Calls f(i) for the places of the entries of column j, in arbitrary order.
  template <class F>
  void for_column(Index j, F&& f) const {
    const Index column = at(order, j);
    for (Index e = at(start, column); e < at(start, column + 1); ++e) f(at(place, at(row, e)));
  }
};

/// Parents in the elimination tree: the first row below the diagonal of each column of L, or -1.
std::vector<Index> parents(const Ordered& A) {
  std::vector<Index> parent(A.order.size(), -1), ancestor = parent;
  for (Index j = 0; j < A.size(); ++j)
    A.for_column(j, [&](Index i) {
      while (i < j && i >= 0) {  // go up the tree and leave shortcuts to j
        const Index next = at(ancestor, i);
        at(ancestor, i) = j;
        if (next < 0) at(parent, i) = j;
        i = next;
      }
    });
  return parent;
}

/// Postorder of the tree, subtree by subtree with children directly before their parents: [new
/// place] old place.
std::vector<Index> by_subtrees(std::span<const Index> parent) {
  const auto n = static_cast<Index>(parent.size());
  std::vector<Index> first_child(parent.size(), -1), next_sibling = first_child, order, open;
  for (Index j = n - 1; j >= 0; --j)
    if (const Index p = at(parent, j); p >= 0) {
      at(next_sibling, j) = at(first_child, p);
      at(first_child, p) = j;
    }
  for (Index root = 0; root < n; ++root) {
    if (at(parent, root) >= 0) continue;
    open.push_back(root);
    while (!open.empty()) {
      const Index j = open.back();
      if (const Index child = at(first_child, j); child >= 0) {
        at(first_child, j) = at(next_sibling, child);
        open.push_back(child);
      } else {
        order.push_back(j);
        open.pop_back();
      }
    }
  }
  return order;
}

/// Number of entries below the diagonal in each column of L.
std::vector<Index> counts(const Ordered& A, std::span<const Index> parent) {
  std::vector<Index> count(A.order.size(), 0), last_row(A.order.size(), -1);
  for (Index i = 0; i < A.size(); ++i) {
    at(last_row, i) = i;
    A.for_column(i, [&](Index j) {  // row i of L: the paths from its entries in A up to i
      for (; j < i && at(last_row, j) != i; j = at(parent, j)) {
        ++at(count, j);
        at(last_row, j) = i;
      }
    });
  }
  return count;
}

/// Fronts: columns with the same rows, and columns before them if this adds few zeros.
std::vector<Front> fronts_of(std::span<const Index> parent, std::span<const Index> count) {
  constexpr Index small = 4;
  constexpr Real most_zeros = 0.05;  // fraction of the entries
  struct Group {
    Index first, last;
    Real zeros;
  };
  std::vector<Group> groups;
  for (Index j = 0; j < static_cast<Index>(parent.size()); ++j) {
    Group group{j, j + 1, 0};
    const Index below = at(count, j);
    while (!groups.empty()) {
      // Does the last group end with a child of this one?
      const Group& child = groups.back();
      if (at(parent, child.last - 1) != group.first) break;
      const Index width = child.last - child.first, all = group.last - child.first;
      const Real zeros =
          group.zeros + child.zeros +
          Real(width) * (group.last - group.first + below - at(count, child.last - 1));
      const Real entries = Real(all) * (all + 1) / 2 + Real(all) * below;
      if (zeros > 0 && all > small && zeros > most_zeros * entries) break;
      group = {child.first, group.last, zeros};
      groups.pop_back();
    }
    groups.push_back(group);
  }
  std::vector<Front> fronts(groups.size());
  for (std::size_t f = 0; f < groups.size(); ++f) {
    fronts[f].first = groups[f].first;
    fronts[f].last = groups[f].last;
  }
  return fronts;
}

void find_rows(const Ordered& A, std::vector<Front>& fronts) {
  std::vector<Index> front_of(A.order.size()), seen(A.order.size(), -1);
  for (std::size_t f = 0; f < fronts.size(); ++f)
    for (Index j = fronts[f].first; j < fronts[f].last; ++j)
      at(front_of, j) = static_cast<Index>(f);
  for (Index f = 0; f < static_cast<Index>(fronts.size()); ++f) {
    Front& front = at(fronts, f);
    const auto include = [&](Index i) {
      if (i < front.last || at(seen, i) == f) return;
      at(seen, i) = f;
      front.below.push_back(i);
    };
    for (Index j = front.first; j < front.last; ++j) A.for_column(j, include);
    for (const Index child : front.children)
      for (const Index i : at(fronts, child).below) include(i);
    std::sort(front.below.begin(), front.below.end());
    if (front.below.empty()) continue;
    front.parent = at(front_of, front.below.front());
    at(fronts, front.parent).children.push_back(f);
  }
}

std::vector<std::vector<FrontRange>> stages_of(std::span<const Front> fronts) {
  constexpr Offset worth_threads = 100'000;  // least number of entries
  constexpr Offset subtrees = 64;
  const auto n = static_cast<Index>(fronts.size());
  std::vector<Offset> work(fronts.size());  // [front] work of its subtree
  std::vector<Index> first(fronts.size());  // [front] first front of its subtree
  Offset all = 0;
  for (Index f = 0; f < n; ++f) {
    const Front& front = at(fronts, f);
    const Offset own = Offset{front.width()} * front.size();
    all += own;
    at(work, f) = own;
    at(first, f) = front.children.empty() ? f : at(first, front.children.front());
    for (const Index child : front.children) at(work, f) += at(work, child);
  }
  if (all < worth_threads) return {{{0, n}}};
  std::vector<std::vector<FrontRange>> stages(1);
  std::vector<std::size_t> stage(fronts.size(), 0);
  for (Index f = 0; f < n; ++f) {
    const Front& front = at(fronts, f);
    const bool whole = at(work, f) * subtrees <= all;
    if (whole && front.parent >= 0 && at(work, front.parent) * subtrees <= all) continue;
    if (!whole)
      for (const Index child : front.children)
        at(stage, f) = std::max(at(stage, f), at(stage, child) + 1);
    stages.resize(std::max(stages.size(), at(stage, f) + 1));
    stages[at(stage, f)].push_back({whole ? at(first, f) : f, f + 1});
  }
  return stages;
}

}  // namespace

Elimination plan_elimination(std::span<const Index> start, std::span<const Index> row,
                             std::span<const Index> order) {
  const Ordered asked(start, row, {order.begin(), order.end()});
  Elimination result;
  for (const Index k : by_subtrees(parents(asked))) result.order.push_back(at(asked.order, k));
  const Ordered A(start, row, result.order);
  const std::vector<Index> parent = parents(A);
  result.fronts = fronts_of(parent, counts(A, parent));
  find_rows(A, result.fronts);
  result.stages = stages_of(result.fronts);
  return result;
}

}  // namespace meniscus
