// SPDX-License-Identifier: BSD-3-Clause
// Forms of contact: the force of one contact point on another, and sums over partners for four
// points at a time, one per lane (CGCM notes 2 and 4).
//
// With the own point x, r = x - y from the other point to it, and weights V of the own and W of the
// other point, a form adds to
//
// - T: minus the force on the point,
// - S (energy form only): dE/dV, the energy per change of V = b cof(F) N dA.
#pragma once
#include "physics/contact/contact_law.hpp"
#include "physics/contact/pair/ring_law.hpp"
#include "physics/contact/points/contact_points.hpp"

namespace meniscus {

namespace contact {

template <int D, class Scalar>
[[gnu::always_inline]] inline Scalar dot(const Scalar* a, const Scalar* b) {
  Scalar sum = a[0] * b[0];
  for (int i = 1; i < D; ++i) sum += a[i] * b[i];
  return sum;
}

/// E = sum u V.W, T = psi (V.W) r, S = u W. Over closed surfaces E is the energy of the volumes.
template <int D>
struct Energy {
  static constexpr int components = D;  ///< of a weight
  static constexpr bool moment = true;  ///< has S
  template <class Law, class Scalar>
  [[gnu::always_inline]] static void add(const Law& law, Scalar square, const Scalar*,
                                         const Scalar* r, const Scalar* V, const Scalar* W,
                                         Scalar* T, Scalar* S) {
    const auto [u, psi] = law.surface(square);
    const Scalar w = psi * dot<D>(V, W);
    for (int i = 0; i < D; ++i) {
      T[i] += w * r[i];
      S[i] += u * W[i];
    }
  }
};

/// T = V psi (r.W)
template <int D>
struct Pressure {
  static constexpr int components = D;
  static constexpr bool moment = false;
  template <class Law, class Scalar>
  [[gnu::always_inline]] static void add(const Law& law, Scalar square, const Scalar*,
                                         const Scalar* r, const Scalar* V, const Scalar* W,
                                         Scalar* T, Scalar*) {
    const Scalar w = law.surface(square).psi * dot<D>(r, W);
    for (int i = 0; i < D; ++i) T[i] += w * V[i];
  }
};

/// T = W psi (r.V)
template <int D>
struct Dissertation {
  static constexpr int components = D;
  static constexpr bool moment = false;
  template <class Law, class Scalar>
  [[gnu::always_inline]] static void add(const Law& law, Scalar square, const Scalar*,
                                         const Scalar* r, const Scalar* V, const Scalar* W,
                                         Scalar* T, Scalar*) {
    const Scalar w = law.surface(square).psi * dot<D>(r, V);
    for (int i = 0; i < D; ++i) T[i] += w * W[i];
  }
};

/// T = (dphi/dr / r) V W r between points of volumes.
template <int D>
struct Volume {
  static constexpr int components = 1;
  static constexpr bool moment = false;
  template <class Law, class Scalar>
  [[gnu::always_inline]] static void add(const Law& law, Scalar square, const Scalar*,
                                         const Scalar* r, const Scalar* V, const Scalar* W,
                                         Scalar* T, Scalar*) {
    const Scalar w = law.volume(square).dphi_by_r * (V[0] * W[0]);
    for (int i = 0; i < D; ++i) T[i] += w * r[i];
  }
};

/// Potential energy of a point: sum u V.W, or sum phi V W between points of volumes.
template <int D, int Components>
struct Potential {
  static constexpr int components = Components;
  template <class Law>
  [[gnu::always_inline]] static void add(const Law& law, Lanes square, const Lanes*, const Lanes*,
                                         const Lanes* V, const Lanes* W, Lanes* T, Lanes*) {
    if constexpr (Components == D)
      T[0] += law.surface(square).u * dot<D>(V, W);
    else
      T[0] += law.volume(square).phi * (V[0] * W[0]);
  }
};

/// E of circles about the axis x = 0, for RingLaw.
struct RingEnergy {
  static constexpr int components = 2;
  static constexpr bool moment = true;
  template <class Scalar>
  [[gnu::always_inline]] static void add(const RingLaw& law, Scalar square, const Scalar* x,
                                         const Scalar* r, const Scalar* V, const Scalar* W,
                                         Scalar* T, Scalar* S) {
    const auto [along, across] = law(x[0], r, square);
    const Scalar a = V[0] * W[0], b = V[1] * W[1];
    T[0] += a * across.by_r + b * along.by_r;
    T[1] += a * across.by_z + b * along.by_z;
    S[0] += across.value * W[0];
    S[1] += along.value * W[1];
  }
};

/// Potential energy of a circle.
struct RingPotential {
  static constexpr int components = 2;
  static void add(const RingLaw& law, Lanes square, const Lanes* x, const Lanes* r, const Lanes* V,
                  const Lanes* W, Lanes* T, Lanes*) {
    const auto [along, across] = law(x[0], r, square);
    T[0] += V[0] * W[0] * across.value + V[1] * W[1] * along.value;
  }
};

/// Adds up Form over the partners of the four points x with weights V. Each partner is a run of
/// `run` clusters. Returns the smallest squared distance of each point. Points beyond `reach`, the
/// cut-off of the law, add exactly zero.
template <class Form, int D, class Law>
Lanes sum_over_partners(const Law& law, Real reach, const Lanes* x, const Lanes* V,
                        std::span<const Index> partners, Index run, const ContactPlaces<D>& others,
                        Lanes* T, Lanes* S) {
  Lanes nearest = unbounded;
  for (const Index partner : partners)
    for (Index c = partner * run; c < (partner + 1) * run; ++c) {
      const Lanes *y = others.x_of(c), *weight = others.weight_of(c);
      for (int lane = 0; lane < Lanes::width; ++lane) {
        Lanes r[D], W[Form::components];
        for (int i = 0; i < D; ++i) r[i] = x[i] - detail::components(y[i])[lane];
        for (int i = 0; i < Form::components; ++i) W[i] = detail::components(weight[i])[lane];
        const Lanes square = dot<D>(r, r);
        nearest = min(square, nearest);
        if (any(square.v < reach * reach)) Form::add(law, square, x, r, V, W, T, S);
      }
    }
  return nearest;
}

/// The changes of T and S for changes dx, dV of the four points and `changes` of the others.
template <class Form, int D, class Law>
void sum_changes_over_partners(const Law& law, Real reach, const Lanes* x, const Lanes* dx,
                               const Lanes* V, const Lanes* dV, std::span<const Index> partners,
                               Index run, const ContactPlaces<D>& others,
                               const ContactChanges<D>& changes, Dual<Lanes>* T, Dual<Lanes>* S) {
  Dual<Lanes> own[Form::components], place[D];
  for (int i = 0; i < Form::components; ++i) own[i] = {V[i], dV[i]};
  for (int i = 0; i < D; ++i) place[i] = {x[i], dx[i]};
  for (const Index partner : partners)
    for (Index c = partner * run; c < (partner + 1) * run; ++c) {
      const Lanes *y = others.x_of(c), *dy = changes.x_of(c);
      const Lanes *weight = others.weight_of(c),
                  *dweight = &at(changes.weight, c * Form::components);
      for (int lane = 0; lane < Lanes::width; ++lane) {
        Dual<Lanes> r[D], W[Form::components];
        for (int i = 0; i < D; ++i)
          r[i] = {x[i] - detail::components(y[i])[lane], dx[i] - detail::components(dy[i])[lane]};
        for (int i = 0; i < Form::components; ++i)
          W[i] = {Lanes(detail::components(weight[i])[lane]),
                  Lanes(detail::components(dweight[i])[lane])};
        const Dual<Lanes> square = dot<D>(r, r);
        if (any(square.v.v < reach * reach)) Form::add(law, square, place, r, own, W, T, S);
      }
    }
}

}  // namespace contact

}  // namespace meniscus
