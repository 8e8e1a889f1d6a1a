// SPDX-License-Identifier: BSD-3-Clause
// The artificial inertia: the Laplacian of finite elements, an approximate inverse of the transform
// from coefficients to positions, and the fastest mode.
//
// The inverse is a polynomial of the transform. Factors of the transform of 31,112 particles take
// 70 s and 1.3 GB; a polynomial of degree 8 costs as much as a few forces. It is inaccurate only
// for soft modes, in which coefficients move and positions hardly do; this changes the number of
// steps by a tenth.
#include "solve/step/elastic_inertia.hpp"

#include "body/particle_values.hpp"
#include "kernel/row_sums.hpp"
#include "numbers/box.hpp"
#include "numbers/buckets.hpp"
#include "numbers/dense.hpp"
#include "parallel/nodal_algebra.hpp"
#include "parallel/parallel.hpp"
#include "solve/least_spacing.hpp"
#include "solve/linear/nested_dissection.hpp"
#include "solve/linear/sparse_factors.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meniscus {
namespace {

/// Matrix entries of `factor` times the integral of grad v . grad v, with trilinear (2D: bilinear)
/// elements and two Gauss points per direction.
template <int D>
UnsetVector<MatrixEntry> laplacian(const Grid<D>& grid, Real factor) {
  constexpr int corners_of_cell = 1 << D, of_cell = corners_of_cell * corners_of_cell;
  UnsetVector<MatrixEntry> entries;
  entries.reserve(grid.cells.size() * of_cell + grid.X.size());  // and the diagonal
  grow(entries, grid.cells.size() * of_cell);
  parallel_for(static_cast<Index>(grid.cells.size()), [&](Index c) {
    const auto& cell = at(grid.cells, c);
    const auto corners = grid.corner_points(cell);
    std::array<std::array<Real, corners_of_cell>, corners_of_cell> K{};
    for (int q = 0; q < corners_of_cell; ++q) {
      Vec<D> xi;
      for (int k = 0; k < D; ++k) xi[k] = corner_sign(q, k) / std::sqrt(3.0);
      const Mat<D> J = multilinear<D, D>(corners, xi).J;
      const Mat<D> to_place = inverse<D>(J).transpose();
      auto g = corner_slopes<D>(xi);
      for (Vec<D>& slope : g) slope = to_place * slope;
      const Real weight = factor * std::abs(determinant<D>(J));
      for (int a = 0; a < corners_of_cell; ++a)
        for (int b = 0; b < corners_of_cell; ++b)
          at(at(K, a), b) += weight * at(g, a).dot(at(g, b));
    }
    MatrixEntry* entry = entries.data() + static_cast<std::size_t>(c) * of_cell;
    for (int a = 0; a < corners_of_cell; ++a)
      for (int b = 0; b < corners_of_cell; ++b)
        *entry++ = {at(cell, a), at(cell, b), at(at(K, a), b)};
  });
  return entries;
}

template <int D>
Real surface_area(const Grid<D>& grid) {
  Real area = 0;
  for (const Facet<D>& facet : grid.facets) {
    std::array<Vec<D>, 1 << (D - 1)> corners;
    for (int a = 0; a < 1 << (D - 1); ++a) at(corners, a) = at(grid.X, at(facet.nodes, a));
    const auto J = multilinear<D, D - 1>(corners, Vec<D - 1>(Vec<D - 1>::Zero())).J;
    if constexpr (D == 2)
      area += 2 * J.norm();
    else
      area += 4 * cross(J.col(0), J.col(1)).norm();
  }
  return area;
}

template <int D>
Real extent_of(const Body<D>& body) {
  return box_around<D>(body.particles.X()).extent().maxCoeff();
}

/// The transpose of the matrix that gives values at the particles.
template <int D>
PointRows<D> transpose_of(const PointRows<D>& rows) {
  struct Entry {
    Index row;
    Real value;
  };
  const auto n = static_cast<Index>(rows.start.size()) - 1;
  PointRows<D> t;
  t.start = sort_into_buckets<Offset>(
      n,
      [&](auto&& f) {
        for (Index row = 0; row < n; ++row)
          for (Offset e = at(rows.start, row); e < at(rows.start, row + 1); ++e)
            f(at(rows.particle, e), Entry{row, at(rows.value, e)});
      },
      [&](Offset count) {
        grow(t.particle, static_cast<std::size_t>(count));
        grow(t.value, static_cast<std::size_t>(count));
      },
      [&](Offset k, const Entry& entry) {
        at(t.particle, k) = entry.row;
        at(t.value, k) = entry.value;
      });
  return t;
}

}  // namespace

template <int D>
class ElasticInertia<D>::OfBody {
 public:
  OfBody(const System<D>& system, const Body<D>& body)
      : first_(static_cast<std::size_t>(body.first)),
        size_(body.size()),
        to_places_(rows_of_all_particles(body)),
        from_places_(transpose_of(*to_places_)) {
    Real mass = 0;
    for (const Real m : body.part(std::span<const Real>(system.mass))) mass += m;
    const Real k = 2 * std::numbers::pi / extent_of(body);
    const Grid<D>& grid = body.geometry.grid;
    UnsetVector<MatrixEntry> entries = laplacian(grid, 0.5 * mass / volume(grid) / (k * k));
    for (Index A = 0; A < size_; ++A)
      entries.push_back({A, A, 0.5 * at(system.mass, body.first + A)});
    factors_ = std::make_unique<SparseCholesky>(size_, entries, nested_dissection(grid));
    residual_.resize(static_cast<std::size_t>(size_));
    way_ = image_ = x_ = residual_;
  }

  void solve(const NodalVectors& r, NodalVectors& z) {
    std::copy_n(r.begin() + static_cast<std::ptrdiff_t>(first_), x_.size(), x_.begin());
    divide_by(from_places_);
    factors_->solve(std::span(x_));
    divide_by(*to_places_);
    std::copy(x_.begin(), x_.end(), z.begin() + static_cast<std::ptrdiff_t>(first_));
  }

 private:
  /// Multiplies x by a polynomial of T that approximates T^-1: Chebyshev iteration for eigenvalues
  /// of T in [0.05, 1.1]. Smaller eigenvalues, whose modes hardly move any position, are treated
  /// like 0.05.
  void divide_by(const PointRows<D>& T) {
    constexpr int degree = 8;
    constexpr Real low = 0.05, high = 1.1, middle = (high + low) / 2, half = (high - low) / 2;
    sweep(size_, [&](Index begin, Index end) {
      for (Index A = begin; A < end; ++A) {
        at(residual_, A) = at(x_, A);
        at(x_, A) = at(way_, A) = (1 / middle) * at(x_, A);
      }
    });
    Real rho = half / middle;
    for (int k = 1; k < degree; ++k) {
      const Real next = 1 / (2 * middle / half - rho), carried = next * rho,
                 added = 2 * next / half;
      rho = next;
      for_chunks(size_, [&](Index, Index begin, Index end) {
        for (Index A = begin; A < end; ++A) at(image_, A) = value_at(T, A, way_.data());
      });
      sweep(size_, [&](Index begin, Index end) {
        for (Index A = begin; A < end; ++A) {
          at(residual_, A) -= at(image_, A);
          at(way_, A) = carried * at(way_, A) + added * at(residual_, A);
          at(x_, A) += at(way_, A);
        }
      });
    }
  }

  std::size_t first_;
  Index size_;
  std::shared_ptr<const PointRows<D>> to_places_;
  PointRows<D> from_places_;
  std::unique_ptr<SparseCholesky> factors_;
  NodalVectors residual_, way_, image_, x_;
};

template <int D>
ElasticInertia<D>::ElasticInertia(const System<D>& system) {
  for (const Body<D>& body : system.bodies)
    bodies_.push_back(std::make_unique<OfBody>(system, body));
}

template <int D>
ElasticInertia<D>::~ElasticInertia() = default;

template <int D>
void ElasticInertia<D>::solve(const NodalVectors& r, NodalVectors& z) const {
  z.resize(r.size());
  for (const auto& body : bodies_) body->solve(r, z);
}

template <int D>
ElasticStep<D>::ElasticStep(System<D>& system, Real safety)
    : system_(system), safety_(safety), spacing_(least_spacing(system.bodies)) {
  const auto n = static_cast<std::size_t>(system.size());
  mode_.resize(n);
  momentum_ = trial_ = force_ = mode_;
  // A start vector with all wavelengths.
  for (Index A = 0; A < system.size(); ++A)
    at(momentum_, A) =
        Lanes(std::sin(12.9898 * A), std::sin(78.233 * A), D == 3 ? std::sin(37.719 * A) : 0.0, 0);
}

template <int D>
void ElasticStep<D>::iterate(const ElasticInertia<D>& inertia, const State& state, int most) {
  constexpr Real settled = 0.01;
  const NodalVectors still(state.u.size(), Lanes::zero());
  for (int n = 0; n < most; ++n) {
    inertia.solve(momentum_, mode_);
    const Real size = largest(mode_), inertial = dot(mode_, momentum_);
    if (!(inertial > 0) || !std::isfinite(inertial)) break;
    const Real h = 1e-6 * spacing_ / size;
    trial_ = state.u;
    add(trial_, h, mode_);
    system_.add_up({state.time, trial_, still, state.fields}, {force_, {}});
    ++evaluations_;
    sweep(system_.size(), [&](Index begin, Index end) {
      for (Index A = begin; A < end; ++A)
        at(momentum_, A) = (1 / h) * (at(state.force, A) - at(force_, A));
    });
    const Real before = stiffness_;
    stiffness_ = std::abs(dot(mode_, momentum_)) / inertial;
    for (NodalVector& p : momentum_) p *= 1 / stiffness_;
    if (n > 0 && std::abs(stiffness_ - before) < settled * stiffness_) break;
  }
  if (!(stiffness_ > 0) || !std::isfinite(stiffness_))
    throw SolveError(
        "no stable step of relaxation can be found: the forces at the current state do not make "
        "sense (are all moduli positive and all cells unfolded?)");
}

template <int D>
Real ElasticStep<D>::at_state(const ElasticInertia<D>& inertia, const State& state) {
  constexpr Real shortest = 20, longest = 160, tolerated = 0.02;
  constexpr int from_nothing = 60, from_last = 4;
  if (stiffness_ == 0) {
    iterate(inertia, state, from_nothing);
    interval_ = shortest;
    next_ = state.step + static_cast<std::int64_t>(interval_);
  } else if (state.step >= next_) {
    const Real before = stiffness_;
    iterate(inertia, state, from_last);
    const Real change = 0.5 * std::abs(std::log(stiffness_ / before));
    interval_ = std::clamp(interval_ * std::min(2.0, tolerated / std::max(change, 1e-9)), shortest,
                           longest);
    next_ = state.step + static_cast<std::int64_t>(interval_);
  }
  return std::min(safety_ * 2 / std::sqrt(stiffness_), state.demand.longest);
}

template <int D>
void ElasticStep<D>::archive(const Archive& a) {
  a("momentum", momentum_, D);
  a("stiffness", stiffness_, {0, -2, 0});
  a("interval", interval_);
  a("next", next_);
  require_saved(stiffness_ >= 0, a, "stiffness");
  require_saved(interval_ >= 0 && interval_ <= 1e9, a, "interval");
}

template <int D>
bool is_thin_and_elastic(const System<D>& system, const std::vector<bool>& fluid) {
  constexpr Real thinnest = 0.1;  // largest thickness / extent
  const auto is_set = [](bool is) { return is; };
  const auto asks_for_more = [](const auto& term) {
    return term->viscous() || term->may_reject_steps();
  };
  if (D == 2 || system.constraints || !system.fields.empty() || !system.carried.empty() ||
      std::any_of(fluid.begin(), fluid.end(), is_set) ||
      std::any_of(system.terms.begin(), system.terms.end(), asks_for_more))
    return false;
  return std::all_of(system.bodies.begin(), system.bodies.end(), [](const Body<D>& body) {
    const Grid<D>& grid = body.geometry.grid;
    return 2 * volume(grid) < thinnest * extent_of(body) * surface_area(grid);
  });
}

template class ElasticInertia<2>;
template class ElasticInertia<3>;
template class ElasticStep<2>;
template class ElasticStep<3>;
template bool is_thin_and_elastic(const System<2>&, const std::vector<bool>&);
template bool is_thin_and_elastic(const System<3>&, const std::vector<bool>&);

}  // namespace meniscus
