// SPDX-License-Identifier: BSD-3-Clause
// Factors of a sparse symmetric matrix by dense fronts (Duff and Reid, ACM Trans. Math. Softw. 9,
// 1983). This is ten times faster than column by column, and independent fronts are eliminated in
// parallel.
#include "numbers/buckets.hpp"
#include "parallel/parallel.hpp"
#include "solve/linear/elimination_tree.hpp"
#include "solve/linear/sparse_factors.hpp"

#include <Eigen/Dense>
#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>

namespace meniscus {
namespace {

using Dense = Eigen::MatrixXd;

/// A symmetric matrix by columns, with ascending rows in each column.
struct Columns {
  std::vector<Index> start;
  UnsetVector<Index> row;
  UnsetVector<Real> value;
};

/// The sum of the entries, multiplied by `scale` from both sides so that the diagonal is one.
Columns scaled_sum(Index n, std::span<const MatrixEntry> entries, Eigen::VectorXd& scale) {
  Eigen::VectorXd diagonal = Eigen::VectorXd::Zero(n);
  for (const MatrixEntry& e : entries)
    if (e.row == e.column) diagonal[e.row] += e.value;
  scale = diagonal.cwiseSqrt().cwiseInverse();
  Columns A;
  A.start = sort_into_buckets<Index>(
      n,
      [&](auto&& f) {
        for (const MatrixEntry& e : entries) f(e.column, e);
      },
      [&](Index count) {
        grow(A.row, static_cast<std::size_t>(count));
        grow(A.value, static_cast<std::size_t>(count));
      },
      [&](Index k, const MatrixEntry& e) {
        at(A.row, k) = e.row;
        at(A.value, k) = e.value * scale[e.row] * scale[e.column];
      });

  std::vector<Index> count(static_cast<std::size_t>(n));
  for_chunks(n, [&](Index, Index begin, Index end) {
    std::vector<Index> place(static_cast<std::size_t>(n), -1);  // [row] in the sums of a column
    std::vector<std::pair<Index, Real>> sums;
    for (Index j = begin; j < end; ++j) {
      sums.clear();
      for (Index k = at(A.start, j); k < at(A.start, j + 1); ++k) {
        Index& found = at(place, at(A.row, k));
        if (found < 0) {
          found = static_cast<Index>(sums.size());
          sums.emplace_back(at(A.row, k), 0);
        }
        at(sums, found).second += at(A.value, k);
      }
      for (const auto& [row, value] : sums) at(place, row) = -1;
      std::sort(sums.begin(), sums.end());
      at(count, j) = static_cast<Index>(sums.size());
      Index k = at(A.start, j);
      for (const auto& [row, value] : sums) {
        at(A.row, k) = row;
        at(A.value, k++) = value;
      }
    }
  });
  Index end = 0;
  for (Index j = 0; j < n; ++j) {
    const Index begin = std::exchange(at(A.start, j), end);
    for (Index k = begin; k < begin + at(count, j); ++k, ++end) {
      at(A.row, end) = at(A.row, k);
      at(A.value, end) = at(A.value, k);
    }
  }
  A.start.back() = end;
  A.row.resize(static_cast<std::size_t>(end));
  A.value.resize(static_cast<std::size_t>(end));
  return A;
}

/// Minimum-degree order: order[place] = row.
std::vector<Index> by_minimum_degree(const Columns& A) {
  const auto n = static_cast<Eigen::Index>(A.start.size()) - 1;
  const Eigen::SparseMatrix<Real> matrix = Eigen::Map<const Eigen::SparseMatrix<Real>>(
      n, n, static_cast<Eigen::Index>(A.row.size()), A.start.data(), A.row.data(), A.value.data());
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> order;
  Eigen::AMDOrdering<int>()(matrix, order);
  return {order.indices().begin(), order.indices().end()};
}

/// Factors L D L^T of the first `width` columns of a symmetric matrix, given by the lower triangle
/// of these columns. The diagonal of L is one and not stored. Zero pivots are left out.
void eliminate(Dense& columns, Eigen::VectorXd& pivots) {
  constexpr Eigen::Index most = 48;
  const Eigen::Index size = columns.rows(), width = columns.cols();
  pivots.resize(width);
  for (Eigen::Index begin = 0; begin < width; begin += most) {
    const Eigen::Index end = std::min(begin + most, width);
    for (Eigen::Index k = begin; k < end; ++k) {
      const Real d = pivots[k] = columns(k, k);
      const Eigen::Index below = size - k - 1;
      auto column = columns.col(k).tail(below);
      for (Eigen::Index j = k + 1; j < end; ++j) {
        const Real factor = d == 0 ? 0 : columns(j, k) / d;
        columns.col(j).tail(size - j) -= factor * columns.col(k).tail(size - j);
      }
      column *= d == 0 ? 0 : 1 / d;
    }
    const Eigen::Index rows = size - end, rest = width - end;
    if (rest == 0) continue;
    const auto L = columns.block(end, begin, rows, end - begin);
    const Dense LD = L.topRows(rest) * pivots.segment(begin, end - begin).asDiagonal();
    columns.block(end, end, rows, rest).noalias() -= L * LD.transpose();
  }
}

}  // namespace

struct SparseCholesky::Factors {
  struct OfFront {
    Dense L;  // [row of the front][column]; above the diagonal unused
    Eigen::VectorXd pivots;
  };

  /// Work space of a solution. `taken`: front after front, the amounts that a front subtracts from
  /// the rows below it.
  template <class Vector>
  struct Solution {
    AlignedVector<Vector> x;  // unknowns in the order of the factors
    AlignedVector<Vector> taken;
  };

  Elimination plan;
  Columns pattern;          // empty unless the values can change
  std::vector<OfFront> of;  // [front]
  Eigen::VectorXd scale;
  std::vector<Offset> taken_by;            // [front] its first place in `taken`
  std::vector<Offset> sources_of, source;  // [row] places in `taken`, by ascending front
  Solution<Lanes> vectors;
  Solution<Real> numbers;

  void compute(const Columns& A);
  void compute_front(const Columns& A, std::span<const Index> place, Index f,
                     std::vector<Dense>& left);
  void find_sources();
  template <class Work>
  void for_stage(const std::vector<FrontRange>& stage, Work&& work) const;
  template <class Vector>
  void solve(std::span<Vector> b, Solution<Vector>& solution) const;
  template <class Vector>
  void eliminate_from(Index f, Solution<Vector>& solution) const;
  template <class Vector>
  void substitute(Index f, AlignedVector<Vector>& x) const;
};

/// Eliminates a front and stores the remaining matrix of its rows below in left[f]. `place` is the
/// inverse of the order.
void SparseCholesky::Factors::compute_front(const Columns& A, std::span<const Index> place, Index f,
                                            std::vector<Dense>& left) {
  thread_local std::vector<Index> number;  // [place] row of the front; other entries unused
  number.resize(std::max(number.size(), plan.order.size()));
  const Front& front = at(plan.fronts, f);
  const Index width = front.width();
  for (Index j = front.first; j < front.last; ++j) at(number, j) = j - front.first;
  for (std::size_t k = 0; k < front.below.size(); ++k)
    at(number, front.below[k]) = width + static_cast<Index>(k);

  Dense& L = at(of, f).L;
  Dense& rest = at(left, f);
  L = Dense::Zero(front.size(), width);
  rest = Dense::Zero(front.size() - width, front.size() - width);
  for (Index j = front.first; j < front.last; ++j) {
    const Index column = at(plan.order, j);
    for (Index e = at(A.start, column); e < at(A.start, column + 1); ++e)
      if (const Index i = at(place, at(A.row, e)); i >= j)
        L(at(number, i), j - front.first) += at(A.value, e);
  }
  for (const Index child : front.children) {
    Dense& from = at(left, child);
    const std::vector<Index>& rows = at(plan.fronts, child).below;
    for (std::size_t b = 0; b < rows.size(); ++b) {
      const Index column = at(number, rows[b]);
      Real* to = column < width ? &L(0, column) : &rest(0, column - width) - width;
      for (std::size_t a = b; a < rows.size(); ++a)
        to[at(number, rows[a])] += from(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b));
    }
    from.resize(0, 0);
  }
  eliminate(L, at(of, f).pivots);
  if (rest.size() == 0) return;
  const auto below = L.bottomRows(rest.rows());
  const Dense scaled = below * at(of, f).pivots.asDiagonal();
  rest.triangularView<Eigen::Lower>() -= below * scaled.transpose();
}

/// Calls work(range) for all ranges of a stage, in parallel since they are independent.
template <class Work>
void SparseCholesky::Factors::for_stage(const std::vector<FrontRange>& stage, Work&& work) const {
  if (stage.size() == 1) return work(stage.front());
  parallel_for(
      static_cast<Index>(stage.size()), [&](Index k) { work(at(stage, k)); }, 1);
}

void SparseCholesky::Factors::compute(const Columns& A) {
  std::vector<Index> place(plan.order.size());
  for (std::size_t k = 0; k < place.size(); ++k) at(place, plan.order[k]) = static_cast<Index>(k);
  of.assign(plan.fronts.size(), {});
  std::vector<Dense> left(plan.fronts.size());
  for (const std::vector<FrontRange>& stage : plan.stages)
    for_stage(stage, [&](FrontRange range) {
      for (Index f = range.first; f < range.last; ++f) compute_front(A, place, f, left);
    });
}

void SparseCholesky::Factors::find_sources() {
  taken_by.assign(1, 0);
  for (const Front& front : plan.fronts)
    taken_by.push_back(taken_by.back() + static_cast<Offset>(front.below.size()));
  sources_of = sort_into_buckets<Offset>(
      static_cast<Index>(plan.order.size()),
      [&](auto&& f) {
        Offset place = 0;
        for (const Front& front : plan.fronts)
          for (const Index row : front.below) f(row, place++);
      },
      [&](Offset count) { source.resize(static_cast<std::size_t>(count)); },
      [&](Offset k, Offset place) { at(source, k) = place; });
}

SparseCholesky::SparseCholesky(Index n, std::span<const MatrixEntry> entries,
                               std::vector<Index> order)
    : factors_(std::make_unique<Factors>()) {
  const Columns A = scaled_sum(n, entries, factors_->scale);
  if (order.empty()) order = by_minimum_degree(A);
  factors_->plan = plan_elimination(A.start, A.row, order);
  factors_->compute(A);
  factors_->find_sources();
}

SparseCholesky::SparseCholesky(std::span<const Index> start, std::span<const Index> row,
                               std::vector<Index> order)
    : factors_(std::make_unique<Factors>()) {
  Columns& A = factors_->pattern;
  A.start.assign(start.begin(), start.end());
  A.row.assign(row.begin(), row.end());
  A.value.resize(A.row.size());
  factors_->plan = plan_elimination(A.start, A.row, order);
  factors_->find_sources();
}

void SparseCholesky::factor(std::span<const Real> value) {
  Columns& A = factors_->pattern;
  const auto n = static_cast<Index>(A.start.size()) - 1;
  Eigen::VectorXd& scale = factors_->scale;
  scale = Eigen::VectorXd::Ones(n);
  for_chunks(n, [&](Index, Index begin, Index end) {
    for (Index j = begin; j < end; ++j)
      for (Index e = at(A.start, j); e < at(A.start, j + 1); ++e)
        if (at(A.row, e) == j) scale[j] = 1 / std::sqrt(std::abs(at(value, e)));
  });
  for_chunks(n, [&](Index, Index begin, Index end) {
    for (Index j = begin; j < end; ++j)
      for (Index e = at(A.start, j); e < at(A.start, j + 1); ++e)
        at(A.value, e) = at(value, e) * scale[j] * scale[at(A.row, e)];
  });
  factors_->compute(A);
}

Index SparseCholesky::negative_eigenvalues() const {
  Index count = 0;
  for (const auto& front : factors_->of)
    for (const Real pivot : front.pivots) count += !(pivot > 0);  // also counts NaN
  return count;
}

SparseCholesky::~SparseCholesky() = default;

SparseCholesky::Pivot SparseCholesky::smallest_pivot() const {
  Pivot least{unbounded, 0};
  for (std::size_t f = 0; f < factors_->of.size(); ++f)
    for (Index k = 0; k < factors_->plan.fronts[f].width(); ++k)
      if (const Real d = factors_->of[f].pivots[k]; d < least.value)
        least = {d, at(factors_->plan.order, factors_->plan.fronts[f].first + k)};
  return least;
}

/// x = L^-1 x for the rows of a front; also computes what the front subtracts from the rows below
/// it.
template <class Vector>
void SparseCholesky::Factors::eliminate_from(Index f, Solution<Vector>& solution) const {
  const Front& front = at(plan.fronts, f);
  const Index width = front.width(), size = front.size();
  Vector* x = solution.x.data() + front.first;
  Vector* taken = solution.taken.data() + at(taken_by, f) - width;
  for (Index k = 0; k < width; ++k)
    for (Offset e = at(sources_of, front.first + k); e < at(sources_of, front.first + k + 1); ++e)
      x[k] -= at(solution.taken, at(source, e));
  for (Index i = width; i < size; ++i) taken[i] = Vector(0.0);
  for (Index k = 0; k < width; ++k) {
    const Vector known = x[k];
    const Real* L = &at(of, f).L(0, k);
    for (Index i = k + 1; i < width; ++i) x[i] -= L[i] * known;
    for (Index i = width; i < size; ++i) taken[i] += L[i] * known;
  }
}

/// x = L^-t D^-1 x for the rows of a front.
template <class Vector>
void SparseCholesky::Factors::substitute(Index f, AlignedVector<Vector>& x) const {
  thread_local AlignedVector<Vector> below;
  const Front& front = at(plan.fronts, f);
  const Index width = front.width(), size = front.size();
  below.resize(front.below.size());
  for (std::size_t i = 0; i < below.size(); ++i) below[i] = at(x, front.below[i]);
  for (Index k = width - 1; k >= 0; --k) {
    const Real* L = &at(of, f).L(0, k);
    Vector even = at(x, front.first + k) / at(of, f).pivots[k], odd(0.0);  // two hide latency
    Index i = width;
    for (; i + 1 < size; i += 2) {
      even -= L[i] * at(below, i - width);
      odd -= L[i + 1] * at(below, i + 1 - width);
    }
    if (i < size) even -= L[i] * at(below, i - width);
    for (i = k + 1; i < width; ++i) odd -= L[i] * at(x, front.first + i);
    at(x, front.first + k) = even + odd;
  }
}

template <class Vector>
void SparseCholesky::Factors::solve(std::span<Vector> b, Solution<Vector>& solution) const {
  AlignedVector<Vector>& x = solution.x;
  x.resize(b.size());
  for (std::size_t k = 0; k < x.size(); ++k) x[k] = scale[plan.order[k]] * at(b, plan.order[k]);
  solution.taken.resize(source.size());
  for (const std::vector<FrontRange>& stage : plan.stages)
    for_stage(stage, [&](FrontRange range) {
      for (Index f = range.first; f < range.last; ++f) eliminate_from(f, solution);
    });
  for (std::size_t k = plan.stages.size(); k-- > 0;)
    for_stage(plan.stages[k], [&](FrontRange range) {
      for (Index f = range.last; f-- > range.first;) substitute(f, x);
    });
  for (std::size_t k = 0; k < x.size(); ++k) at(b, plan.order[k]) = scale[plan.order[k]] * x[k];
}

void SparseCholesky::solve(std::vector<Real>& b) const {
  factors_->solve(std::span(b), factors_->numbers);
}

void SparseCholesky::solve(std::span<NodalVector> b) const {
  factors_->solve(b, factors_->vectors);
}

std::size_t SparseCholesky::bytes() const {
  std::size_t entries = 0;
  for (const auto& of_front : factors_->of) entries += static_cast<std::size_t>(of_front.L.size());
  return entries * sizeof(Real);
}

}  // namespace meniscus
