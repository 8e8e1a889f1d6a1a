// SPDX-License-Identifier: BSD-3-Clause
// Sums over the Gauss points of four patches at once, and over the points of patches.
#pragma once
#include "body/surface/surface_patches.hpp"
#include "kernel/row_sums.hpp"

#include <algorithm>
#include <numbers>

namespace meniscus {

// T is Lanes or Dual<Lanes>.
template <class T>
T dot(const std::array<T, 2>& a, const std::array<T, 2>& b) {
  return a[0] * b[0] + a[1] * b[1];
}
template <class T>
T dot(const std::array<T, 3>& a, const std::array<T, 3>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template <class T>
std::array<T, 3> cross(const std::array<T, 3>& a, const std::array<T, 3>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

template <class T>
using Tangent2 = std::array<std::array<T, 2>, 1>;
template <class T>
using Tangents3 = std::array<std::array<T, 3>, 2>;

/// The area normal m; outward for outward facets.
template <class T>
std::array<T, 2> area_normal(const Tangent2<T>& t) {
  return {t[0][1], -t[0][0]};
}
template <class T>
std::array<T, 3> area_normal(const Tangents3<T>& t) {
  return cross(t[0], t[1]);
}
/// The coefficients c_k in b . dm = sum_k c_k . dt_k.
template <class T>
Tangent2<T> through_tangents(const Tangent2<T>&, const std::array<T, 2>& b) {
  return {{{-b[1], b[0]}}};
}
template <class T>
Tangents3<T> through_tangents(const Tangents3<T>& t, const std::array<T, 3>& b) {
  return {cross(t[1], b), cross(b, t[0])};
}

template <int D>
template <class T, class F>
T SurfacePatches<D>::group_sum(const Corners<T>& place, T* gradient, F&& integrand) const {
  const T zero(0.0);
  if (gradient) std::fill_n(gradient, nodes * D, zero);

  T total = zero;
  for (const PatchFunctions<D>& f : gauss_) {
    Vector<T> p;
    std::array<Vector<T>, D - 1> t;
    p.fill(zero);
    for (Vector<T>& tangent : t) tangent.fill(zero);
    for (int a = 0; a < nodes; ++a)
      for (int i = 0; i < D; ++i) {
        at(p, i) += at(f.L, a) * at(at(place, a), i);
        for (int k = 0; k < D - 1; ++k) at(at(t, k), i) += at(at(f.dL, k), a) * at(at(place, a), i);
      }
    // The result is sum s with the change ds = by_place . dx + by_normal . dm.
    const Vector<T> m = area_normal(t);
    Vector<T> by_place, by_normal;
    total += integrand(f.weight, p, m, by_place, by_normal);
    if (!gradient) continue;
    const auto c = through_tangents(t, by_normal);
    for (int a = 0; a < nodes; ++a)
      for (int i = 0; i < D; ++i) {
        T& g = gradient[a * D + i];
        g += at(f.L, a) * at(by_place, i);
        for (int k = 0; k < D - 1; ++k) g += at(at(f.dL, k), a) * at(at(c, k), i);
      }
  }
  return total;
}

template <int D>
template <class T>
T SurfacePatches<D>::group_area(const Corners<T>& place, T* gradient) const {
  return group_sum(place, gradient,
                   [this](Real weight, const Vector<T>& p, const Vector<T>& m, Vector<T>& by_place,
                          Vector<T>& by_normal) -> T {
                     const T length = sqrt(dot(m, m));
                     if (revolved_) {
                       const Real turn = 2 * std::numbers::pi * weight;
                       by_place.fill(T(0.0));
                       by_place[0] = turn * length;
                       for (int i = 0; i < D; ++i)
                         at(by_normal, i) = turn * p[0] * at(m, i) / length;
                       return turn * p[0] * length;
                     }
                     for (int i = 0; i < D; ++i) {
                       at(by_place, i) = T(0.0);
                       at(by_normal, i) = weight * at(m, i) / length;
                     }
                     return weight * length;
                   });
}

template <int D>
template <class T>
T SurfacePatches<D>::group_volume(const Corners<T>& place, T* gradient) const {
  return group_sum(place, gradient,
                   [this](Real weight, const Vector<T>& p, const Vector<T>& m, Vector<T>& by_place,
                          Vector<T>& by_normal) -> T {
                     if (revolved_) {
                       const T disk = std::numbers::pi * weight * p[0] * p[0];
                       by_place.fill(T(0.0));
                       by_normal.fill(T(0.0));
                       by_place[0] = 2 * std::numbers::pi * weight * p[0] * m[0];
                       by_normal[0] = disk;
                       return disk * m[0];
                     }
                     for (int i = 0; i < D; ++i) {
                       at(by_place, i) = (weight / D) * at(m, i);
                       at(by_normal, i) = (weight / D) * at(p, i);
                     }
                     return (weight / D) * dot(p, m);
                   });
}

template <int D>
template <class T>
T SurfacePatches<D>::group_size(Size size, Index group, const Corners<T>& place,
                                T* gradient) const {
  if (size == Size::volume) return group_volume(place, gradient);
  T area = group_area(place, gradient);
  if (area_share_.empty()) return area;
  const T share(at(area_share_, group));
  if (gradient)
    for (int k = 0; k < nodes * D; ++k) gradient[k] = share * gradient[k];
  return share * area;
}

template <int D>
template <class F>
void SurfacePatches<D>::add_to_particles(const ForceVector& force, F&& at_point) {
  chunk_sums_.accumulate(force, [&](int, Index begin, Index end, NodalVector* f) {
    for (Index q = begin; q < end; ++q) {
      const Lanes g = at_point(q);
      if (sum(g * g) != 0) scatter_value(rows_, q, g, f);
    }
  });
}

}  // namespace meniscus
