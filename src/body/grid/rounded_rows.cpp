// SPDX-License-Identifier: BSD-3-Clause
// Chooses the entries of a row that compensate the rounding of the others, and corrects them.
#include "body/grid/rounded_rows.hpp"

#include "kernel/monomials.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <numeric>

namespace meniscus {

template <int D>
std::size_t make_up_for_rounding(std::span<const Vec<D>> X, const Vec<D>& centre,
                                 std::vector<Index>& particle,
                                 std::vector<std::array<Lanes, D>>& gradient) {
  constexpr int terms = monomial_count(D, 2), columns = 4 * D;
  constexpr std::size_t among = 6 * terms;  // nearest entries: distant ones have small coefficients
  constexpr Real worst = 1e-4;              // smallest pivot, relative to the largest
  const std::size_t size = particle.size();
  if (size <= terms) return size;
  std::vector<Real> distance(size);
  for (std::size_t e = 0; e < size; ++e) distance[e] = (at(X, particle[e]) - centre).squaredNorm();
  std::vector<std::size_t> order(size);
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::tie(distance[a], particle[a]) < std::tie(distance[b], particle[b]);
  });
  const std::size_t near = std::min(size, among);
  const Real length = std::sqrt(distance[order[near - 1]]);
  const auto monomials = [&](std::size_t e) {
    const Vec<D> s = (at(X, particle[e]) - centre) / length;
    Eigen::Matrix<Real, terms, 1> p;
    p[0] = 1;
    p.template segment<D>(1) = s;
    for (int i = 0; i < D; ++i)
      for (int j = i; j < D; ++j) p[1 + D + hessian_index(D, i, j)] = s[i] * s[j];
    return p;
  };
  Eigen::Matrix<Real, terms, Eigen::Dynamic> P(terms, near);
  for (std::size_t k = 0; k < near; ++k) P.col(static_cast<Eigen::Index>(k)) = monomials(order[k]);
  const Eigen::ColPivHouseholderQR<Eigen::Matrix<Real, terms, Eigen::Dynamic>> choice(P);
  const auto& R = choice.matrixQR();
  if (!(std::abs(R(terms - 1, terms - 1)) > worst * std::abs(R(0, 0)))) return size;

  std::vector<std::size_t> exact;
  for (int k = 0; k < terms; ++k)
    exact.push_back(order[static_cast<std::size_t>(choice.colsPermutation().indices()[k])]);
  std::sort(exact.begin(), exact.end());
  std::vector<bool> is_exact(size, false);
  for (const std::size_t e : exact) is_exact[e] = true;

  Eigen::Matrix<Real, terms, columns> missing = Eigen::Matrix<Real, terms, columns>::Zero();
  for (std::size_t e = 0; e < size; ++e) {
    if (is_exact[e]) continue;
    Eigen::Matrix<Real, 1, columns> lost;
    for (int K = 0; K < D; ++K) {
      const Lanes& g = at(gradient[e], K);
      const Lanes difference = g - SingleLanes::rounded(g).widened();
      for (int lane = 0; lane < 4; ++lane) lost[4 * K + lane] = difference[lane];
    }
    missing += monomials(e) * lost;
  }
  Eigen::Matrix<Real, terms, terms> own;
  for (int k = 0; k < terms; ++k) own.col(k) = monomials(exact[static_cast<std::size_t>(k)]);
  const Eigen::Matrix<Real, terms, columns> more = own.fullPivLu().solve(missing);
  for (int k = 0; k < terms; ++k)
    for (int K = 0; K < D; ++K) {
      Lanes& g = at(gradient[exact[static_cast<std::size_t>(k)]], K);
      for (int lane = 0; lane < 4; ++lane) g.set(lane, g[lane] + more(k, 4 * K + lane));
    }

  std::vector<std::size_t> sequence = exact;
  for (std::size_t e = 0; e < size; ++e)
    if (!is_exact[e]) sequence.push_back(e);
  const std::vector<Index> old_particle = particle;
  const std::vector<std::array<Lanes, D>> old_gradient = gradient;
  for (std::size_t k = 0; k < size; ++k) {
    particle[k] = old_particle[sequence[k]];
    gradient[k] = old_gradient[sequence[k]];
  }
  return exact.size();
}

template std::size_t make_up_for_rounding<2>(std::span<const Vec<2>>, const Vec<2>&,
                                             std::vector<Index>&,
                                             std::vector<std::array<Lanes, 2>>&);
template std::size_t make_up_for_rounding<3>(std::span<const Vec<3>>, const Vec<3>&,
                                             std::vector<Index>&,
                                             std::vector<std::array<Lanes, 3>>&);

}  // namespace meniscus
