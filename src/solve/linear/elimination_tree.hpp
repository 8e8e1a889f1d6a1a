// SPDX-License-Identifier: BSD-3-Clause
// Plan of a sparse factorisation: which columns are eliminated together, and which rows they
// modify.
#pragma once
#include "numbers/types.hpp"

#include <span>
#include <vector>

namespace meniscus {

/// Adjacent columns [first, last) of L with the same rows below them. They form a dense matrix;
/// after their elimination, the remaining part is added to the matrix of the parent.
struct Front {
  Index first = 0, last = 0;
  std::vector<Index> below;  ///< rows from `last` on, ascending
  Index parent = -1;         ///< front of the first row below; -1: no rows below
  std::vector<Index> children;

  Index width() const { return last - first; }
  Index size() const { return width() + static_cast<Index>(below.size()); }
};

/// Fronts [first, last): a subtree, or one front.
struct FrontRange {
  Index first, last;
};

struct Elimination {
  std::vector<Index> order;   ///< [place] row of the matrix; dependencies come first
  std::vector<Front> fronts;  ///< children before parents, subtree by subtree
  /// Ranges of one stage are independent of each other, but need the earlier stages. First come
  /// many subtrees with about equal work, then the fronts above them, level by level. Only one
  /// range if there is little work.
  std::vector<std::vector<FrontRange>> stages;
};

/// Plans the elimination of a symmetric matrix, given by the row numbers of all its columns (both
/// triangles). `order` [place] should give few entries in the factors; only places that are
/// independent of each other are reordered.
Elimination plan_elimination(std::span<const Index> start, std::span<const Index> row,
                             std::span<const Index> order);

}  // namespace meniscus
