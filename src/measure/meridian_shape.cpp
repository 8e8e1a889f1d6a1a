// SPDX-License-Identifier: BSD-3-Clause
// Meridians of a body of revolution after its deformation.
#include "measure/meridian_shape.hpp"

#include "kernel/row_sums.hpp"
#include "numbers/dense.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meniscus {

namespace {

template <int D>
constexpr int meridians = D == 3 ? 24 : 1;
constexpr int points_of_meridian = 193;  // number of points, including both poles

/// The value of z at the first crossing of the curve with r = where, by linear interpolation.
Real height_at(std::span<const Real> r, std::span<const Real> z, Real where) {
  for (std::size_t k = 0; k + 1 < r.size(); ++k) {
    if ((r[k] - where) * (r[k + 1] - where) > 0 || r[k] == r[k + 1]) continue;
    const Real s = (where - r[k]) / (r[k + 1] - r[k]);
    return (1 - s) * z[k] + s * z[k + 1];
  }
  return z[where < r.front() ? 0 : r.size() - 1];
}

/// Number of the largest sample that has neighbours on both sides.
std::size_t largest_inside(const std::vector<Real>& samples) {
  return static_cast<std::size_t>(std::max_element(samples.begin() + 1, samples.end() - 1) -
                                  samples.begin());
}

/// Largest value of a sampled function: the vertex of the parabola through the sample `k` and its
/// neighbours.
Real vertex(const std::vector<Real>& samples, std::size_t k) {
  const Real left = samples[k - 1], largest = samples[k], right = samples[k + 1];
  const Real bend = 2 * largest - left - right;
  return bend > 0 ? largest + (right - left) * (right - left) / (8 * bend) : largest;
}

}  // namespace

Real MeanMeridian::upper(Real x) const {
  return height_at({r.data(), rim + 1}, {z.data(), rim + 1}, x * r[rim]);
}
Real MeanMeridian::lower(Real x) const {
  const std::vector<Real> from_pole_r(r.rbegin(), r.rend() - static_cast<std::ptrdiff_t>(rim));
  const std::vector<Real> from_pole_z(z.rbegin(), z.rend() - static_cast<std::ptrdiff_t>(rim));
  return height_at(from_pole_r, from_pole_z, x * r[rim]);
}

Real MeanMeridian::distance(Real at_r, Real at_z) const {
  const Vec<2> place(at_r, at_z);
  Real nearest = unbounded;
  for (std::size_t k = 0; k + 1 < r.size(); ++k) {
    const Vec<2> a(r[k], z[k]), edge = Vec<2>(r[k + 1], z[k + 1]) - a;
    const Real s = std::clamp((place - a).dot(edge) / edge.squaredNorm(), 0.0, 1.0);
    nearest = std::min(nearest, (place - a - s * edge).norm());
  }
  return nearest;
}

Real evans_fung_thickness(Real x) {
  const Real x2 = x * x;
  return std::sqrt(std::max(0.0, 1 - x2)) * (0.81 + 7.83 * x2 - 4.39 * x2 * x2);
}

template <int D>
Meridians<D>::Meridians(const Body<D>& body) : body_(body), centre_(Vec<D>::Zero()) {
  const SmoothMap<D>& map = mapped_patches(*body.geometry.surface).map();
  Real total = 0;
  for (int m = 0; m < meridians<D>; ++m)
    for (int k = 0; k < points_of_meridian; ++k) {
      const Real phi = 2 * std::numbers::pi * (m + 0.5) / meridians<D>;
      const Real theta = std::numbers::pi * k / (points_of_meridian - 1);
      Vec<D> direction;
      direction[0] = std::sin(theta);
      if constexpr (D == 3) {
        direction[0] *= std::cos(phi);
        direction[1] = std::sin(theta) * std::sin(phi);
      }
      direction[D - 1] = std::cos(theta);
      X_.push_back(map(direction).x);
      weight_.push_back(std::sin(theta));
      total += weight_.back();
      centre_ += weight_.back() * X_.back();
    }
  centre_ /= total;
  if (D == 2) centre_[0] = 0;
  for (Real& w : weight_) w /= total;
  rows_ = build_point_rows<D>(body.particles, X_, {.value = true}, body.name);
}

template <int D>
MeanMeridian Meridians<D>::mean(const Motion& motion) const {
  const NodalVector* u = motion.u.data() + body_.first;
  std::vector<Vec<D>> x(X_.size());
  parallel_for(static_cast<Index>(x.size()), [&](Index q) {
    const Lanes displacement = value_at(rows_, q, u);
    for (int i = 0; i < D; ++i) at(x, q)[i] = at(X_, q)[i] + displacement[i];
  });
  Vec<D> centre = Vec<D>::Zero();
  for (std::size_t q = 0; q < x.size(); ++q) centre += weight_[q] * x[q];
  Mat<D> back = Mat<D>::Identity();
  if constexpr (D == 3) {
    Mat<3> moment = Mat<3>::Zero();
    for (std::size_t q = 0; q < x.size(); ++q)
      moment += weight_[q] * (x[q] - centre) * (X_[q] - centre_).transpose();
    back = best_rotation(moment).transpose();
  } else {
    centre[0] = 0;
  }

  MeanMeridian mean;
  mean.r.assign(points_of_meridian, 0);
  mean.z.assign(points_of_meridian, 0);
  for (std::size_t m = 0; m < meridians<D>; ++m) {
    std::vector<Real> r;
    for (std::size_t k = 0; k < points_of_meridian; ++k) {
      const Vec<D> y = back * (x[m * points_of_meridian + k] - centre);
      r.push_back(D == 3 ? std::hypot(y[0], y[1]) : y[0]);
      mean.r[k] += r.back() / meridians<D>;
      mean.z[k] += y[D - 1] / meridians<D>;
    }
    mean.rim_radius.push_back(vertex(r, largest_inside(r)));
  }
  mean.r.front() = mean.r.back() = 0;  // all meridians meet there
  mean.rim = largest_inside(mean.r);
  mean.radius_at_rim = vertex(mean.r, mean.rim);
  return mean;
}

template class Meridians<2>;
template class Meridians<3>;

}  // namespace meniscus
