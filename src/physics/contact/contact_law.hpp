// SPDX-License-Identifier: BSD-3-Clause
// The pair interaction of two bodies: the Lennard-Jones potential phi(r) = epsilon (x^2 - 2 x) with
// x = (sigma0/r)^6, integrated over both bodies (CGCM note 1).
//
//   phi             energy of a pair of volume elements
//   psi = r^-D INT_r^inf phi t^(D-1) dt,   div(r psi) = -phi    pair of surface elements, force
//   u   = -INT_r^inf psi t dt,   u' = r psi, laplace u = -phi   pair of surface elements, energy
//   chi = -INT_r^inf phi t dt,   grad chi = phi r
//
// All contain epsilon, but not the densities beta of the interaction sites. With a cut-off, u is
// switched off: u_c = u Q, where Q falls from 1 to 0 between 3/4 r_c and r_c with two continuous
// derivatives. psi, phi and chi are derived from u_c, so that every identity stays exact (CGCM note
// 6).
#pragma once
#include "numbers/dual.hpp"
#include "numbers/elementary.hpp"

#include <string_view>
#include <type_traits>

namespace meniscus {

/// The space over which the energy phi is integrated.
enum class PairKernel {
  space,       ///< 3D; beta per volume, epsilon an energy
  integrated,  ///< plane strain, phi integrated along the infinite third axis: all results per
               ///< depth, beta still per volume and epsilon an energy
  planar       ///< phi itself in 2D; beta per area, epsilon an energy per depth
};

/// "space", "integrated" or "planar".
std::string_view name_of(PairKernel kernel);
/// Throws InputError for any other name.
PairKernel pair_kernel_named(std::string_view name);

constexpr int dimension_of(PairKernel kernel) {
  return kernel == PairKernel::space ? 3 : 2;
}

/// Smallest gap in units of sigma0, unless a law sets another: smaller gaps are failures of the
/// time step. The stiffness of half spaces at this gap is 2800 times the stiffness at rest.
inline constexpr Real least_gap = 0.3;
/// The switch begins at this fraction of the cut-off.
inline constexpr Real switch_begin = 0.75;
/// Smallest cut-off in sigma0: the largest traction and the softening then lie before the switch.
inline constexpr Real least_cutoff = 1.5;

/// The parameters of an interaction.
struct ContactLaw {
  PairKernel kernel = PairKernel::space;
  Real epsilon = 1, sigma0 = 1;
  /// r_c in sigma0, at least `least_cutoff`; infinity without a cut-off.
  Real cutoff = std::numeric_limits<Real>::infinity();
  /// Smallest gap in sigma0: smaller gaps are failures, rigid partners are exact above it.
  Real guard = least_gap;

  bool cut() const { return cutoff < std::numeric_limits<Real>::infinity(); }
  /// r_c as a length.
  Real reach() const { return cutoff * sigma0; }
};

/// phi = epsilon r^odd (phi12 x^2 + phi6 x), psi likewise, u and chi with r^(odd + 2).
struct PairCoefficients {
  int dimension, odd;
  Real phi12, phi6, psi12, psi6, u12, u6;
};

constexpr PairCoefficients pair_coefficients(PairKernel kernel) {
  constexpr Real pi = std::numbers::pi;
  const bool integrated = kernel == PairKernel::integrated;
  PairCoefficients c{};
  c.dimension = dimension_of(kernel);
  c.odd = integrated ? 1 : 0;
  c.phi12 = integrated ? 63 * pi / 256 : 1.0;
  c.phi6 = integrated ? -3 * pi / 4 : -2.0;
  // INT_r^inf t^-p t^(D-1) dt = r^(D-p)/(p - D), and for u with t once more.
  const int p12 = 12 - c.odd, p6 = 6 - c.odd;
  c.psi12 = c.phi12 / (p12 - c.dimension);
  c.psi6 = c.phi6 / (p6 - c.dimension);
  c.u12 = -c.psi12 / (p12 - 2);
  c.u6 = -c.psi6 / (p6 - 2);
  return c;
}

/// Pair functions of two surface points.
template <class T>
struct SurfacePair {
  T u, psi;
};
/// Pair functions of two volume points: the force on the first is -dphi_by_r (x1 - x2).
template <class T>
struct VolumePair {
  T phi, dphi_by_r;
};

/// The pair functions of r^2 for the pair loop; T is Real or Lanes. They use no branch, no power,
/// one division and one square root. A law without cut-off costs the same and has exactly Q = 1.
/// Beyond the cut-off all values are exactly zero.
template <PairKernel K>
class PairLaw {
 public:
  explicit PairLaw(const ContactLaw& law)
      : epsilon_(law.epsilon),
        sigma_squared_(law.sigma0 * law.sigma0),
        begin_(law.cut() ? switch_begin * law.reach() : 0),
        per_width_(law.cut() ? 1 / ((1 - switch_begin) * law.reach()) : 0) {}

  template <class T>
  [[gnu::always_inline]] SurfacePair<T> surface(T r_squared) const {
    const Bare<T> f(*this, r_squared);
    const Switch<T> Q(f.r, begin_, per_width_);
    return {f.u * Q.value, f.psi * Q.value + f.u * Q.first * f.by_r};
  }

  /// phi_c is continuous, but its slope jumps by u Q''' at both ends of the switch.
  template <class T>
  [[gnu::always_inline]] VolumePair<T> volume(T r_squared) const {
    constexpr PairCoefficients c = pair_coefficients(K);
    constexpr Real p12 = 12 - c.odd, p6 = 6 - c.odd, side = c.dimension - 1;
    const Bare<T> f(*this, r_squared);
    const Switch<T> Q(f.r, begin_, per_width_);
    const T phi = f.scale * (f.x * (f.x * c.phi12 + c.phi6));
    const T dphi_r = f.scale * (f.x * (f.x * (-p12 * c.phi12) - p6 * c.phi6));
    const T ddu = -phi - f.psi * side;
    // phi_c = -(u_c'' + (D - 1) u_c'/r) with u_c = u Q, u' = r psi.
    const T phi_c = phi * Q.value - f.psi * f.r * Q.first * 2.0 - f.u * Q.second -
                    f.u * Q.first * f.by_r * side;
    const T slope = dphi_r * f.by_r * Q.value + phi * Q.first - ddu * Q.first * 2.0 -
                    f.psi * f.r * Q.second * 3.0 - f.u * Q.third -
                    (f.psi * Q.first + (f.u * f.by_r) * (Q.second - Q.first * f.by_r)) * side;
    return {phi_c, slope * f.by_r};
  }

  /// Q = 1 - t^3 (10 - 15 t + 6 t^2), t = (r - r_s)/(r_c - r_s) in [0, 1], and its derivatives.
  template <class T>
  struct Switch {
    T value, first, second, third;

    [[gnu::always_inline]] Switch(T r, Real begin, Real per_width) {
      const T t = clamp((r - begin) * per_width), s = 1.0 - t;
      const Real k = per_width, inside = 60 * k * k * k;
      value = 1.0 - t * t * t * (10.0 - t * (15.0 - t * 6.0));
      first = t * t * s * s * (-30 * k);
      second = t * s * (s - t) * (-60 * k * k);
      third = only_inside(t, (t * s * 6.0 - 1.0) * inside);
    }
  };

 private:
  /// The functions without cut-off.
  template <class T>
  struct Bare {
    T r, by_r, x, scale, psi, u;

    [[gnu::always_inline]] Bare(const PairLaw& law, T r_squared) {
      using std::sqrt;
      constexpr PairCoefficients c = pair_coefficients(K);
      const T by_r_squared = 1.0 / r_squared;
      r = sqrt(r_squared);
      by_r = r * by_r_squared;
      const T s = by_r_squared * law.sigma_squared_;
      x = s * s * s;
      if constexpr (c.odd == 1)
        scale = r * law.epsilon_;
      else
        scale = T(law.epsilon_);
      psi = scale * (x * (x * c.psi12 + c.psi6));
      u = scale * r_squared * (x * (x * c.u12 + c.u6));
    }
  };

  static Real clamp(Real t) { return t < 0 ? 0 : t > 1 ? 1 : t; }
  static Lanes clamp(Lanes t) { return max(min(t, 1.0), 0.0); }
  static Dual<Lanes> clamp(const Dual<Lanes>& t) {
    return select(t.v.v > 0.0, select(t.v.v < 1.0, t, Dual<Lanes>(1.0)), Dual<Lanes>(0.0));
  }
  static Real only_inside(Real t, Real y) { return t > 0 && t < 1 ? y : 0; }
  static Lanes only_inside(Lanes t, Lanes y) {
    return select(t.v > 0.0, select(t.v < 1.0, y, 0.0), 0.0);
  }
  static Dual<Lanes> only_inside(const Dual<Lanes>& t, const Dual<Lanes>& y) {
    return select(t.v.v > 0.0, select(t.v.v < 1.0, y, Dual<Lanes>(0.0)), Dual<Lanes>(0.0));
  }

  Real epsilon_, sigma_squared_;
  Real begin_, per_width_;  // of the switch; zeros without cut-off, which keep t = 0
};

/// Calls f(std::integral_constant<PairKernel, K>) for a kernel known at run time, so that loops are
/// compiled for it.
template <class F>
decltype(auto) with_kernel(PairKernel kernel, F&& f) {
  using enum PairKernel;
  switch (kernel) {
    case space:
      return f(std::integral_constant<PairKernel, space>{});
    case integrated:
      return f(std::integral_constant<PairKernel, integrated>{});
    default:
      return f(std::integral_constant<PairKernel, planar>{});
  }
}

/// All functions of a pair with their derivatives (d: d/dr), for reports, studies and tests.
template <class T>
struct PairFunctions {
  T u, du, ddu, psi, dpsi, phi, dphi, chi;
};
/// The functions at distance r > 0; T is Real or Complex (complex-step derivatives).
template <class T>
PairFunctions<T> pair_functions(const ContactLaw& law, T r);

}  // namespace meniscus
