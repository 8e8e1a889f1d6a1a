// SPDX-License-Identifier: BSD-3-Clause
// Lumped masses: row sums of the mass matrix with a lower bound. Neighbours give the mass that the
// bound adds.
#include "body/body.hpp"
#include "kernel/monomials.hpp"
#include "numbers/dense.hpp"

#include <algorithm>
#include <cmath>

namespace meniscus {
namespace {

/// Least mass of a particle, as a fraction of the mass of its nodal cell. On the axis of a body of
/// revolution, row sums at the surface are far below zero (axisymmetry note 4).
template <int D>
Real least_mass_share(const Body<D>& body, Index A) {
  return body.on_axis(A) ? 1 : 0.3;
}

/// Monomials up to degree 2 of the reference position, relative to the centre of the body and in
/// units of its size. This keeps systems of their moments well conditioned.
template <int D>
class QuadraticBasis {
 public:
  static constexpr int size = monomial_count(D, 2);
  using Values = Eigen::Matrix<Real, size, 1>;

  explicit QuadraticBasis(std::span<const Vec<D>> X) : middle_(Vec<D>::Zero()), scale_(0) {
    for (const Vec<D>& place : X) middle_ += place / static_cast<Real>(X.size());
    for (const Vec<D>& place : X) scale_ = std::max(scale_, (place - middle_).norm());
  }

  Values operator()(const Vec<D>& X) const {
    constexpr Monomials<D, 2> monomials;
    const Vec<D> x = (X - middle_) / scale_;
    Values p;
    p[0] = 1;
    for (std::size_t k = 1; k < static_cast<std::size_t>(size); ++k)
      p[static_cast<int>(k)] = p[monomials.factor[k]] * x[monomials.variable[k]];
    return p;
  }

 private:
  Vec<D> middle_;
  Real scale_;
};

/// Masses that the particles give away, with the prescribed moments `wanted` up to `degree` and the
/// least sum of squares divided by `margin`. Empty if some particle would have to give more than
/// its margin.
template <int D>
std::optional<std::vector<Real>> gifts(std::span<const Vec<D>> X, const std::vector<Real>& margin,
                                       const typename QuadraticBasis<D>::Values& wanted,
                                       int degree) {
  const QuadraticBasis<D> basis(X);
  const int n = monomial_count(D, degree);
  Eigen::MatrixXd moments = Eigen::MatrixXd::Zero(n, n);
  for (std::size_t A = 0; A < X.size(); ++A) {
    const Eigen::VectorXd p = basis(X[A]).head(n);
    moments += margin[A] * p * p.transpose();
  }
  const Eigen::VectorXd factor = solve_symmetric(moments, wanted.head(n));
  std::vector<Real> gift(X.size());
  Eigen::VectorXd left = wanted.head(n);
  for (std::size_t A = 0; A < X.size(); ++A) {
    const Eigen::VectorXd p = basis(X[A]).head(n);
    gift[A] = margin[A] * p.dot(factor);
    if (!(gift[A] <= margin[A])) return std::nullopt;
    left -= gift[A] * p;
  }
  // If the givers are too few, the system has no solution.
  if (!(left.cwiseAbs().maxCoeff() <= 1e-11 * wanted[0])) return std::nullopt;
  return gift;
}

}  // namespace

template <int D>
MassReport lump_mass(Body<D>& body, const std::vector<Real>& density,
                     const std::vector<Real>& shape_integral) {
  const auto X = body.particles.X();
  const auto n = static_cast<std::size_t>(body.size());
  MassReport report;
  std::vector<Real> floor(n), excess(n, 0.0), margin(n), near(n, 0.0);
  body.mass.resize(n);
  body.mass_integral.resize(n);
  Real sum = 0, added = 0;
  for (Index A = 0; A < body.size(); ++A) {
    const Real row_sum = at(density, A) * at(shape_integral, A);
    at(floor, A) = least_mass_share(body, A) * at(density, A) * body.cells.volume(A);
    at(body.mass_integral, A) = row_sum;
    at(body.mass, A) = std::max(row_sum, at(floor, A));
    at(excess, A) = at(body.mass, A) - row_sum;
    at(margin, A) = at(body.mass, A) - at(floor, A);
    report.raised += at(excess, A) > 0;
    sum += row_sum;
    added += at(excess, A);
  }
  if (report.raised == 0) return report;

  // Neighbours of the raised particles give the mass. If they cannot give enough, all particles do.
  const QuadraticBasis<D> basis(X);
  typename QuadraticBasis<D>::Values wanted = QuadraticBasis<D>::Values::Zero();
  std::vector<std::uint8_t> raised_near(n, 0);  // found in the rows of this rank
  for (Index A = 0; A < body.size(); ++A) {
    if (at(excess, A) == 0) continue;
    wanted += at(excess, A) * basis(at(X, A));
    for (const Index B : body.at_particles.of_rows(A, A + 1)) at(raised_near, B) = 1;
  }
  for (int rank = 0; rank < ranks().size(); ++rank) {
    std::vector<std::uint8_t> said = raised_near;
    ranks().hand_out(rank, said.data(), said.size());
    for (std::size_t B = 0; B < n; ++B)
      if (said[B]) near[B] = margin[B];
  }
  for (report.kept_degree = 2; report.kept_degree >= 0; --report.kept_degree)
    for (const std::vector<Real>* givers : {&near, &margin})
      if (const auto gift = gifts<D>(X, *givers, wanted, report.kept_degree)) {
        for (std::size_t A = 0; A < n; ++A) body.mass[A] -= (*gift)[A];
        return report;
      }
  report.added = added / sum;
  return report;
}

template MassReport lump_mass(Body<2>&, const std::vector<Real>&, const std::vector<Real>&);
template MassReport lump_mass(Body<3>&, const std::vector<Real>&, const std::vector<Real>&);

}  // namespace meniscus
