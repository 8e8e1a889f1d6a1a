// SPDX-License-Identifier: BSD-3-Clause
// Positions, area vectors and forces of contact points on patches.
#include "physics/contact/points/patch_points.hpp"

#include <algorithm>
#include <numbers>

namespace meniscus {
namespace {

template <int D>
Vec<D> vector_of(const Lanes& x) {
  Vec<D> y;
  for (int i = 0; i < D; ++i) y[i] = x[i];
  return y;
}

Vec<3> cross(const Vec<3>& a, const Vec<3>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Vec<2> area_normal(const std::array<Vec<2>, 1>& t) {
  return {t[0][1], -t[0][0]};
}
Vec<3> area_normal(const std::array<Vec<3>, 2>& t) {
  return cross(t[0], t[1]);
}
/// The vectors c_k of b . dm = sum_k c_k . dt_k.
std::array<Vec<2>, 1> through_tangents(const std::array<Vec<2>, 1>&, const Vec<2>& b) {
  return {Vec<2>(-b[1], b[0])};
}
std::array<Vec<3>, 2> through_tangents(const std::array<Vec<3>, 2>& t, const Vec<3>& b) {
  return {cross(t[1], b), cross(b, t[0])};
}

}  // namespace

template <int D>
PatchPoints<D>::PatchPoints(const Body<D>& body, int points)
    : revolved_(body.geometry.grid.revolved),
      surface_(body),
      functions_(patch_functions<D>(points)) {
  for (Index a = 0; a < surface_.point_count(); ++a) {
    const Vec<D>& X = surface_.reference_place(a);
    reference_.push_back(Lanes(X[0], X[1], D == 3 ? X[D - 1] : 0.0, 0.0));
  }
  gradient_.assign(static_cast<std::size_t>(surface_.group_count()) * nodes * D, Lanes::zero());
}

template <int D>
void PatchPoints<D>::want(Index point, std::span<std::uint8_t> is_wanted) const {
  for (const Index node : surface_.points_of(patch(point))) at(is_wanted, node) = 1;
}

template <int D>
Vec<D> PatchPoints<D>::place(Index point, const NodalVectors& places) const {
  const auto& node = surface_.points_of(patch(point));
  Lanes x = Lanes::zero();
  for (int a = 0; a < nodes; ++a) x += at(functions(point).L, a) * at(places, at(node, a));
  return vector_of<D>(x);
}

template <int D>
std::array<Vec<D>, D - 1> PatchPoints<D>::tangents(Index point, const NodalVectors& places) const {
  const auto& node = surface_.points_of(patch(point));
  std::array<Vec<D>, D - 1> all;
  for (int k = 0; k < D - 1; ++k) {
    Lanes t = Lanes::zero();
    for (int a = 0; a < nodes; ++a)
      t += at(at(functions(point).dL, k), a) * at(places, at(node, a));
    at(all, k) = vector_of<D>(t);
  }
  return all;
}

template <int D>
Vec<D> PatchPoints<D>::area_vector(Index point, const NodalVectors& places) const {
  return weight(point, places) * area_normal(tangents(point, places));
}

template <int D>
Real PatchPoints<D>::weight(Index point, const NodalVectors& places) const {
  const Real of_curve = functions(point).weight;
  return revolved_ ? 2 * std::numbers::pi * place(point, places)[0] * of_curve : of_curve;
}

template <int D>
Index PatchPoints<D>::node_nearby(Index point) const {
  const auto& L = functions(point).L;
  const auto nearest = std::max_element(L.begin(), L.end()) - L.begin();
  return at(surface_.points_of(patch(point)), nearest);
}

template <int D>
void PatchPoints<D>::begin_force(Index group) {
  std::fill_n(gradient_.begin() + group * nodes * D, nodes * D, Lanes::zero());
}

template <int D>
void PatchPoints<D>::add(Index point, const Vec<D>& T, const Vec<D>& S,
                         const NodalVectors& places) {
  const PatchFunctions<D>& f = functions(point);
  const auto t = tangents(point, places);
  const auto c = through_tangents(t, weight(point, places) * S);
  Vec<D> pull = T;
  if (revolved_) pull[0] += 2 * std::numbers::pi * f.weight * S.dot(area_normal(t));
  Lanes* gradient = gradient_.data() + static_cast<std::size_t>(group(point)) * nodes * D;
  const int lane = patch(point) % Lanes::width;
  for (int a = 0; a < nodes; ++a) {
    Vec<D> g = at(f.L, a) * pull;
    for (int k = 0; k < D - 1; ++k) g += at(at(f.dL, k), a) * at(c, k);
    for (int i = 0; i < D; ++i) {
      Lanes& sum = gradient[a * D + i];
      sum.set(lane, sum[lane] + g[i]);
    }
  }
}

template class PatchPoints<2>;
template class PatchPoints<3>;

}  // namespace meniscus
