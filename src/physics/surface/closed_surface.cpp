// SPDX-License-Identifier: BSD-3-Clause
// Enclosed volume and its gradient.
#include "physics/surface/closed_surface.hpp"

#include "meniscus/error.hpp"

namespace meniscus {

namespace {

using Vector = std::array<Lanes, 3>;

/// Sums over the points of a surface.
struct Sums {
  Real x_dot_m = 0, area = 0;
  Lanes x = Lanes::zero(), m = Lanes::zero();  // a lane per component
  /// Sets the sums of components across the axis to zero, as around a whole circle.
  void balance_across_axis() {
    x.set(0, 0);
    m.set(0, 0);
  }
  friend Sums operator+(const Sums& a, const Sums& b) {
    return {a.x_dot_m + b.x_dot_m, a.area + b.area, a.x + b.x, a.m + b.m};
  }
};

Lanes dot(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Lanes weighted_sums(Lanes w, const Vector& a) {
  return {sum(w * a[0]), sum(w * a[1]), sum(w * a[2]), 0.0};
}
Sums sums_of(Lanes w, const Vector& x, const Vector& m) {
  return {sum(w * dot(x, m)), sum(w * sqrt(dot(m, m))), weighted_sums(w, x), weighted_sums(w, m)};
}
/// V / (+-1/D). `weight`: sum of the weights of all points.
Real volume(const Sums& sums, Real weight) {
  return sums.x_dot_m - sum(sums.x * sums.m) / weight;
}
Vector each_lane(Lanes a, Real factor) {
  return {Lanes(factor * a[0]), Lanes(factor * a[1]), Lanes(factor * a[2])};
}

}  // namespace

template <int D>
ClosedSurface<D>::ClosedSurface(const Body<D>& body, SurfacePart part, int points)
    : body_(body),
      reference_(surface_points(body.geometry, points, part)),
      share_((part == SurfacePart::inner ? -1.0 : 1.0) / space_dimension(body.geometry.grid)) {
  if (reference_.size() == 0)
    throw InputError("body '" + body.name + "' has no " +
                     (part == SurfacePart::inner ? "inner" : "outer") + " surface");
  rule_.rows = build_point_rows<D>(body.particles, reference_.X, {.value = true, .gradient = true},
                                   body.name);
  rule_.point_weight = reference_.area;
  chunk_sums_ = rule_.chunk_sums(body);

  origin_ = Vec<D>::Zero();
  for (Index q = 0; q < reference_.size(); ++q) {
    weight_ += at(reference_.area, q);
    origin_ += at(reference_.area, q) * at(reference_.X, q);
  }
  origin_ /= weight_;
  if (body.geometry.grid.revolved) origin_[0] = 0;
  const std::size_t groups = static_cast<std::size_t>(rule_.groups());
  X_.assign(groups * D, Lanes::zero());
  N_ = X_;
  for (Index q = 0; q < reference_.size(); ++q)
    for (int k = 0; k < D; ++k) {
      at(X_, q / 4 * D + k).set(q % 4, at(reference_.X, q)[k] - origin_[k]);
      at(N_, q / 4 * D + k).set(q % 4, at(reference_.N, q)[k]);
    }
}

template <int D>
typename ClosedSurface<D>::Group ClosedSurface<D>::evaluate(Index group,
                                                            const NodalVector* u) const {
  Group points;
  Tensor<Lanes> H;
  rule_.gather(group, u, H);
  points.F = deformation_gradient(H);
  points.x.fill(Lanes::zero());
  for (int k = 0; k < D; ++k) at(points.x, k) = at(X_, group * D + k);
  for (int lane = 0; lane < 4 && group * 4 + lane < reference_.size(); ++lane) {
    const Lanes displacement = value_at(rule_.rows, group * 4 + lane, u);
    for (int k = 0; k < D; ++k) at(points.x, k).set(lane, at(points.x, k)[lane] + displacement[k]);
  }
  const Tensor<Lanes> cof = cofactor(points.F);
  for (int i = 0; i < 3; ++i) {
    at(points.m, i) = Lanes::zero();
    for (int k = 0; k < D; ++k) at(points.m, i) += cof(i, k) * at(N_, group * D + k);
  }
  return points;
}

template <int D>
typename ClosedSurface<D>::Placed ClosedSurface<D>::placed(const Motion& motion) const {
  Placed points;
  points.groups.resize(static_cast<std::size_t>(rule_.groups()));
  points.origin = origin_;
  place(motion, points);
  return points;
}

template <int D>
void ClosedSurface<D>::place(const Motion& motion, Placed& placed) const {
  const NodalVector* u = motion.u.data() + body_.first;
  Sums sums = parallel_sum(rule_.groups(), Sums{}, [&](Index g) {
    const Group& points = at(placed.groups, g) = evaluate(g, u);
    return sums_of(rule_.weight(g), points.x, points.m);
  });
  if (body_.geometry.grid.revolved) sums.balance_across_axis();
  placed.mean_x = each_lane(sums.x, 1 / weight_);
  placed.mean_m = each_lane(sums.m, 1 / weight_);
  placed.size = {share_ * volume(sums, weight_), sums.area};
}

template <int D>
typename ClosedSurface<D>::Size ClosedSurface<D>::size(const Motion& motion) const {
  const NodalVector* u = motion.u.data() + body_.first;
  Sums sums = parallel_sum(rule_.groups(), Sums{}, [&](Index g) {
    const Group points = evaluate(g, u);
    return sums_of(rule_.weight(g), points.x, points.m);
  });
  if (body_.geometry.grid.revolved) sums.balance_across_axis();
  return {share_ * volume(sums, weight_), sums.area};
}

/// Adds factor times dV/dd_A = +-1/D sum_q w_q [(m_q - mean m) N_A + d(x'.m)/dF grad N_A] with x' =
/// x - mean x. With the columns f_K of F, x'.m = sum_K N_K x'.(f_K+1 x f_K+2). Column L of the
/// derivative is therefore x' x (N_L+1 f_L+2 - N_L+2 f_L+1).
template <int D>
void ClosedSurface<D>::add_volume_gradient(const Placed& placed, Real factor,
                                           const ForceVector& force) {
  chunk_sums_.accumulate(force, [&](int, Index begin, Index end, NodalVector* f) {
    for (Index g = begin; g < end; ++g) {
      const Group& points = at(placed.groups, g);
      const Lanes w = factor * share_ * rule_.weight(g);
      Vector N{Lanes::zero(), Lanes::zero(), Lanes::zero()}, x, m;
      for (int k = 0; k < D; ++k) at(N, k) = at(N_, g * D + k);
      for (int i = 0; i < 3; ++i) {
        at(x, i) = at(points.x, i) - at(placed.mean_x, i);
        at(m, i) = w * (at(points.m, i) - at(placed.mean_m, i));
      }
      std::array<Vector, 3> column;
      for (int L = 0; L < 3; ++L) {
        const int a = (L + 1) % 3, b = (L + 2) % 3;
        Vector turned;
        for (int i = 0; i < 3; ++i)
          at(turned, i) = at(N, a) * points.F(i, b) - at(N, b) * points.F(i, a);
        at(column, L) = cross(x, turned);
      }
      rule_.scatter(g, Tensor<Lanes>::map([&](int i, int L) { return w * at(at(column, L), i); }),
                    f);
      for (int lane = 0; lane < 4 && g * 4 + lane < reference_.size(); ++lane)
        scatter_value(rule_.rows, g * 4 + lane, Lanes(m[0][lane], m[1][lane], m[2][lane], 0.0), f);
    }
  });
}

template <int D>
Vec<D> ClosedSurface<D>::Placed::place(Index point) const {
  Vec<D> x = origin;
  for (int k = 0; k < D; ++k) x[k] += at(at(groups, point / 4).x, k)[point % 4];
  return x;
}

template <int D>
Vec<D> ClosedSurface<D>::Placed::area_vector(Index point) const {
  Vec<D> m;
  for (int k = 0; k < D; ++k) m[k] = at(at(groups, point / 4).m, k)[point % 4];
  return m;
}

template <int D>
Index ClosedSurface<D>::owner(Index point) const {
  const PointRows<D>& rows = rule_.rows;
  Offset largest = at(rows.start, point);
  for (Offset e = largest; e < at(rows.start, point + 1); ++e)
    if (at(rows.value, e) > at(rows.value, largest)) largest = e;
  return at(rows.particle, largest);
}

template <int D>
std::size_t ClosedSurface<D>::bytes() const {
  return rule_.bytes() + chunk_sums_.bytes() + (X_.size() + N_.size()) * sizeof(Lanes);
}

template class ClosedSurface<2>;
template class ClosedSurface<3>;

}  // namespace meniscus
