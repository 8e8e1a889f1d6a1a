// SPDX-License-Identifier: BSD-3-Clause
// Extension of pressures to the boundary, and the projection on extended pressures.
#include "physics/internal/pressure_projection.hpp"

#include "numbers/dense.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace meniscus {
namespace {

/// Relative error of the polynomial for the inverse of M. The null space of Pi, and so the absence
/// of locking, does not depend on it.
constexpr Real error_of_inverse = 0.05;
/// A direction without inner cells has an eigenvalue of SUM d d^T/d^2 below this share.
constexpr Real without_cells = 0.03;

/// A term of a row of Phi.
struct ExtensionEntry {
  Index unknown;
  Real value;
};
using ExtensionRow = std::vector<ExtensionEntry>;

/// Rows of Phi. The unknown A is the pressure of cell A; the unknown (1 + i) n + A is the slope of
/// the pressure at cell A along the i-th direction in which A has no inner neighbour.
template <int D>
class PressureExtension {
 public:
  explicit PressureExtension(const Body<D>& body)
      : body_(body),
        spacing_(mean_spacing(body.geometry.grid)),
        cells_of_(cells_of_nodes(body.geometry.grid)),
        inner_(static_cast<std::size_t>(body.size()), true) {
    for (const Index A : boundary_nodes(body.geometry.grid)) at(inner_, A) = false;
    // A particle on the axis can move along it only, too little for a pressure of its own.
    for (Index A = 0; A < body.size(); ++A)
      if (body.on_axis(A)) at(inner_, A) = false;
  }

  bool inner(Index cell) const { return at(inner_, cell); }
  /// The row of a cell at the boundary; empty if there is no inner cell up to two grid cells away.
  ExtensionRow row(Index cell) const {
    ExtensionRow row;
    const std::vector<Index> all = leads(cell);
    for (const Index lead : all)
      for (const auto& [unknown, value] : extended_from(lead, cell))
        row.push_back({unknown, value / static_cast<Real>(all.size())});
    return row;
  }

 private:
  /// The other cells that share a grid cell with this one, in ascending order.
  std::vector<Index> near(Index cell) const {
    std::vector<Index> all;
    for (const auto& entry : cells_of_.of(cell))
      for (const Index B : at(body_.geometry.grid.cells, entry.cell))
        if (B != cell) all.push_back(B);
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
  }

  /// The nearest inner cells; several if their distances are equal, so that symmetric bodies have
  /// symmetric pressures.
  std::vector<Index> leads(Index cell) const {
    std::vector<Index> found = nearest_inner(cell, near(cell));
    if (!found.empty()) return found;
    std::vector<Index> further;
    for (const Index B : near(cell))
      for (const Index C : near(B)) further.push_back(C);
    std::sort(further.begin(), further.end());
    further.erase(std::unique(further.begin(), further.end()), further.end());
    return nearest_inner(cell, further);
  }
  std::vector<Index> nearest_inner(Index cell, const std::vector<Index>& candidates) const {
    constexpr Real equal = 1e-6;
    std::vector<Index> found;
    Real least = std::numeric_limits<Real>::max();
    for (const Index B : candidates)
      if (inner(B)) least = std::min(least, distance(cell, B));
    for (const Index B : candidates)
      if (inner(B) && distance(cell, B) <= (1 + equal) * least) found.push_back(B);
    return found;
  }
  Real distance(Index A, Index B) const {
    return (at(body_.particles.X(), A) - at(body_.particles.X(), B)).norm();
  }

  /// The pressure at `cell`, extended linearly from an inner cell. Its slope is fitted to the
  /// inner neighbours with weights 1/d^2, and free in directions without such neighbours.
  ExtensionRow extended_from(Index lead, Index cell) const {
    std::vector<Index> neighbors;
    Mat<D> S = Mat<D>::Zero();
    for (const Index B : near(lead)) {
      if (!inner(B)) continue;
      const Vec<D> d = offset(lead, B);
      S += d * d.transpose() / d.squaredNorm();
      neighbors.push_back(B);
    }
    const SymmetricAxes<D> axes = symmetric_axes<D>(S);
    const Real enough = without_cells * std::max(1.0, axes.values[D - 1]);
    const Vec<D> x = offset(lead, cell);
    ExtensionRow row{{lead, 1}};
    Vec<D> fitted = Vec<D>::Zero();  // S^-1 x
    for (int i = 0; i < D; ++i) {
      const Vec<D> axis = axes.axes.col(i);
      if (axes.values[i] > enough)
        fitted += axis * (axis.dot(x) / axes.values[i]);
      else
        row.push_back({(1 + i) * body_.size() + lead, axis.dot(x) / spacing_});
    }
    for (const Index B : neighbors) {
      const Vec<D> d = offset(lead, B);
      const Real share = fitted.dot(d) / d.squaredNorm();
      row.push_back({B, share});
      row.front().value -= share;
    }
    return row;
  }
  Vec<D> offset(Index from, Index to) const {
    return body_.cells.centroid(to) - body_.cells.centroid(from);
  }

  const Body<D>& body_;
  Real spacing_;
  NodeCells cells_of_;
  std::vector<bool> inner_;
};

/// Numbers the unknowns of rows in ascending order. Returns their number.
Index number_unknowns(std::vector<ExtensionRow>& rows) {
  std::vector<Index> unknowns;
  for (const ExtensionRow& row : rows)
    for (const ExtensionEntry& entry : row) unknowns.push_back(entry.unknown);
  std::sort(unknowns.begin(), unknowns.end());
  unknowns.erase(std::unique(unknowns.begin(), unknowns.end()), unknowns.end());
  for (ExtensionRow& row : rows)
    for (ExtensionEntry& entry : row)
      entry.unknown = static_cast<Index>(
          std::lower_bound(unknowns.begin(), unknowns.end(), entry.unknown) - unknowns.begin());
  return static_cast<Index>(unknowns.size());
}

/// The sum of the products of a row with x, in four sums that do not wait for each other.
template <class Rows, class X>
[[gnu::always_inline]] inline auto row_times(const Rows& matrix, Index row, const X& x) {
  using T = std::decay_t<decltype(x[0])>;
  const Index* column = matrix.innerIndexPtr();
  const Real* value = matrix.valuePtr();
  Index e = matrix.outerIndexPtr()[row];
  const Index end = matrix.outerIndexPtr()[row + 1];
  T sums[4] = {T(0.0), T(0.0), T(0.0), T(0.0)};
  for (; e + 4 <= end; e += 4)
    for (int i = 0; i < 4; ++i) sums[i] += value[e + i] * at(x, column[e + i]);
  for (; e < end; ++e) sums[0] += value[e] * at(x, column[e]);
  return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

}  // namespace

template <int D>
PressureProjection<D>::PressureProjection(const Body<D>& body)
    : number_(static_cast<std::size_t>(body.size()), -1) {
  const PressureExtension<D> extension(body);
  std::vector<ExtensionRow> rows(static_cast<std::size_t>(body.size()));
  for (Index A = 0; A < body.size(); ++A) {
    if (extension.inner(A)) continue;
    at(rows, A) = extension.row(A);
    for (const ExtensionEntry& entry : at(rows, A))
      if (entry.unknown < body.size()) at(rows, entry.unknown) = {{entry.unknown, 1}};
  }
  std::vector<ExtensionRow> taking_part;
  for (Index A = 0; A < body.size(); ++A) {
    if (at(rows, A).empty()) continue;
    at(number_, A) = static_cast<Index>(cells_.size());
    cells_.push_back(A);
    volume_.push_back(body.cells.volume(A));
    taking_part.push_back(std::move(at(rows, A)));
  }
  if (cells_.empty()) return;
  const auto count = static_cast<Index>(cells_.size());
  const Index unknowns = number_unknowns(taking_part);

  std::vector<Real> square(static_cast<std::size_t>(unknowns), 0.0);  // M_ii, nearly
  for (Index k = 0; k < count; ++k)
    for (const ExtensionEntry& entry : at(taking_part, k))
      at(square, entry.unknown) += at(volume_, k) * entry.value * entry.value;
  std::vector<Eigen::Triplet<Real, Index>> entries;
  for (Index k = 0; k < count; ++k)
    for (const ExtensionEntry& entry : at(taking_part, k))
      if (at(square, entry.unknown) > 0)
        entries.emplace_back(k, entry.unknown, entry.value / std::sqrt(at(square, entry.unknown)));
  extension_.resize(count, unknowns);
  extension_.setFromTriplets(entries.begin(), entries.end());
  const Eigen::Map<const Eigen::VectorXd> W(volume_.data(), count);
  weighted_ = Rows(extension_.transpose()) * W.asDiagonal();
  gram_ = weighted_ * extension_;
  set_linear_fields(body);
  bound_eigenvalues();
}

/// Orthonormal fields that span 1, X_1, ..., X_D.
template <int D>
void PressureProjection<D>::set_linear_fields(const Body<D>& body) {
  const auto count = static_cast<Index>(cells_.size());
  linear_.assign(cells_.size(), {});
  const Real spacing = mean_spacing(body.geometry.grid);
  for (int i = 0; i <= D; ++i) {
    for (Index k = 0; k < count; ++k)
      at(linear_, k)[static_cast<std::size_t>(i)] =
          i == 0 ? 1 : body.cells.centroid(at(cells_, k))[i - 1] / spacing;
    const auto inner = [&](int j) {
      return parallel_sum<Cost::little>(count, 0.0, [&](Index k) {
        return at(volume_, k) * at(at(linear_, k), i) * at(at(linear_, k), j);
      });
    };
    for (int round = 0; round < 2; ++round)
      for (int j = 0; j < i; ++j) {
        const Real part = inner(j);
        for (Index k = 0; k < count; ++k) at(at(linear_, k), i) -= part * at(at(linear_, k), j);
      }
    Real total = 0;
    for (const Real volume : volume_) total += volume;
    const Real size = std::sqrt(inner(i));
    // A field that the others span, as in a plane of cells, is left out.
    const Real factor = size > 1e-6 * std::sqrt(total) ? 1 / size : 0;
    for (Index k = 0; k < count; ++k) at(at(linear_, k), i) *= factor;
  }
}

/// Bounds the eigenvalues of M by the power method, for M and for most_ I - M, with margins. The
/// polynomial loses accuracy beyond the bounds, but no symmetry.
template <int D>
void PressureProjection<D>::bound_eigenvalues() {
  constexpr Real above = 1.05, below = 0.9, narrowest = 0.02;
  most_ = above * greatest_eigenvalue(0, 1);
  least_ = std::max(below * (most_ - greatest_eigenvalue(most_, -1)), narrowest * most_);
  const Real middle = (most_ + least_) / std::max(most_ - least_, 1e-3 * most_);
  degree_ = static_cast<int>(std::ceil(std::acosh(1 / error_of_inverse) / std::acosh(middle)));
}

/// The greatest eigenvalue of shift I + sign M, nearly.
template <int D>
Real PressureProjection<D>::greatest_eigenvalue(Real shift, Real sign) const {
  constexpr int rounds = 60;
  const auto n = static_cast<Index>(gram_.rows());
  std::vector<Real> x, y(static_cast<std::size_t>(n));
  for (Index i = 0; i < n; ++i) x.push_back(i % 2 == 0 ? 1 + 0.3 * (i % 7) : -1 - 0.3 * (i % 5));
  Real largest = 0;
  for (int round = 0; round < rounds; ++round) {
    Real xx = 0, xy = 0, yy = 0;
    for (Index i = 0; i < n; ++i) {
      at(y, i) = shift * at(x, i) + sign * row_times(gram_, i, x);
      xx += at(x, i) * at(x, i);
      xy += at(x, i) * at(y, i);
      yy += at(y, i) * at(y, i);
    }
    largest = std::max(largest, xy / xx);
    if (!(yy > 0)) break;
    for (Index i = 0; i < n; ++i) at(x, i) = at(y, i) / std::sqrt(yy);
  }
  return largest;
}

/// Takes the part out of `values` that is linear in X, and returns it as factors of linear_.
template <int D>
template <class T>
std::array<T, D + 1> PressureProjection<D>::take_linear_part(std::span<T> values) const {
  struct Factors {
    std::array<T, D + 1> x;
    Factors operator+(const Factors& other) const {
      Factors sum = *this;
      for (int i = 0; i <= D; ++i) at(sum.x, i) += at(other.x, i);
      return sum;
    }
  };
  Factors zero;
  zero.x.fill(T(0.0));
  const auto n = static_cast<Index>(values.size());
  const Factors factors = parallel_sum<Cost::little>(n, zero, [&](Index k) {
    Factors part;
    for (int i = 0; i <= D; ++i)
      at(part.x, i) = at(volume_, k) * at(at(linear_, k), i) * at(values, k);
    return part;
  });
  sweep(n, [&](Index begin, Index end) {
    for (Index k = begin; k < end; ++k)
      for (int i = 0; i <= D; ++i) at(values, k) += -at(at(linear_, k), i) * at(factors.x, i);
  });
  return factors.x;
}

/// Pi with the inverse of M by Chebyshev's semi-iteration (Saad 2003, algorithm 12.1). Keeps the
/// part of the values that is linear in X.
template <int D>
template <class T>
void PressureProjection<D>::apply(std::span<T> values) const {
  if (cells_.empty()) return;
  const std::array<T, D + 1> linear = take_linear_part(values);
  Room<T>& room = std::get<Room<T>>(room_);
  std::vector<T>&x = room.x, &residual = room.residual, &direction = room.direction,
  &next = room.next;
  const auto unknowns = static_cast<Index>(gram_.rows());
  for (std::vector<T>* all : {&x, &residual, &direction, &next})
    all->resize(static_cast<std::size_t>(unknowns));
  const Real middle = 0.5 * (most_ + least_), radius = 0.5 * std::max(most_ - least_, 1e-3 * most_);
  const Real sigma = middle / radius;
  sweep(unknowns, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i) {
      at(residual, i) = row_times(weighted_, i, values);
      at(direction, i) = at(x, i) = at(residual, i) * (1 / middle);
    }
  });
  Real rho = 1 / sigma;
  for (int k = 1; k < degree_; ++k) {
    const Real rho_next = 1 / (2 * sigma - rho), keep = rho_next * rho,
               turn = 2 * rho_next / radius;
    sweep(unknowns, [&](Index begin, Index end) {
      for (Index i = begin; i < end; ++i) {
        at(residual, i) += -row_times(gram_, i, direction);
        at(next, i) = keep * at(direction, i) + turn * at(residual, i);
        at(x, i) += at(next, i);
      }
    });
    std::swap(direction, next);
    rho = rho_next;
  }
  sweep(static_cast<Index>(values.size()), [&](Index begin, Index end) {
    for (Index k = begin; k < end; ++k) at(values, k) = row_times(extension_, k, x);
  });
  take_linear_part(values);
  sweep(static_cast<Index>(values.size()), [&](Index begin, Index end) {
    for (Index k = begin; k < end; ++k)
      for (int i = 0; i <= D; ++i) at(values, k) += at(at(linear_, k), i) * at(linear, i);
  });
}

template <int D>
std::size_t PressureProjection<D>::bytes() const {
  const auto of = [](const Rows& rows) {
    return static_cast<std::size_t>(rows.nonZeros()) * (sizeof(Real) + sizeof(Index)) +
           static_cast<std::size_t>(rows.rows()) * sizeof(Index);
  };
  return number_.size() * sizeof(Index) + of(extension_) + of(weighted_) + of(gram_) +
         cells_.size() * (sizeof(Index) + sizeof(Real) + sizeof(linear_[0])) +
         4 * static_cast<std::size_t>(gram_.rows()) * sizeof(Real);
}

#define MENISCUS_INSTANTIATE(D)                                      \
  template class PressureProjection<D>;                              \
  template void PressureProjection<D>::apply(std::span<Real>) const; \
  template void PressureProjection<D>::apply(std::span<Dual<Real>>) const;
MENISCUS_INSTANTIATE(2)
MENISCUS_INSTANTIATE(3)
#undef MENISCUS_INSTANTIATE

}  // namespace meniscus
