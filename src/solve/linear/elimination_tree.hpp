// SPDX-License-Identifier: BSD-3-Clause
// Which columns of sparse factors are eliminated together, and which rows they touch.
#pragma once
#include "numbers/types.hpp"

#include <span>
#include <vector>

namespace meniscus {

/// Neighbouring columns [first, last) of L with the same rows below them: a dense matrix, of which
/// what is left after their elimination is added to that of the parent.
struct Front {
  Index first = 0, last = 0;
  std::vector<Index> below;  ///< rows from `last` on, ascending
  Index parent = -1;         ///< front of the first of them; -1: there are none
  std::vector<Index> children;

  Index width() const { return last - first; }
  Index size() const { return width() + static_cast<Index>(below.size()); }
};

/// Fronts [first, last): a subtree, or one front.
struct FrontRange {
  Index first, last;
};

struct Elimination {
  std::vector<Index> order;   ///< [place] row of the matrix; each after what its rows depend on
  std::vector<Front> fronts;  ///< children before parents, subtree by subtree
  /// Ranges of a stage do not depend on each other, but on those of the stages before: many
  /// subtrees of about the same work, then the fronts above them from height to height. One range
  /// if there is little work.
  std::vector<std::vector<FrontRange>> stages;
};

/// Of the symmetric matrix with these columns of rows, both triangles given. `order` [place] is
/// that of few entries in the factors: it is kept but for places that do not depend on each other.
Elimination plan_elimination(std::span<const Index> start, std::span<const Index> row,
                             std::span<const Index> order);

}  // namespace meniscus
