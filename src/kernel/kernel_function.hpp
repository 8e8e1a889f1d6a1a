// SPDX-License-Identifier: BSD-3-Clause
// Kernel functions Phi(z), z = |x - x_A| / support_A, zero for z >= 1 (RKPM note 2.1).
#pragma once
#include "numbers/simd.hpp"

#include <array>
#include <string_view>

namespace meniscus {

/// The kernel functions by their names in scenes.
enum class KernelFunction {
  cubic_spline,
  quintic_spline,
  wendland_c2,
  wendland_c4,
  quartic_spline,
  triweight
};

inline constexpr std::array<std::string_view, 6> kernel_function_names{
    "cubic_spline", "quintic_spline", "wendland_c2", "wendland_c4", "quartic_spline", "triweight"};

/// Phi, alpha = Phi'/z and beta = Phi'' - Phi'/z: with u = (x - x_A)/|x - x_A|,
/// Phi,i = alpha (x - x_A)_i / support^2 and Phi,ij = (alpha delta_ij + beta u_i u_j) / support^2.
/// No division by z near zero, where alpha and beta stay finite.
struct KernelValue {
  Lanes phi, alpha, beta;
};

namespace kernel_function {

/// Cubic B-spline, C2; phi(0) = 2/3.
struct CubicSpline {
  static KernelValue at(Lanes z) {
    const Lanes t = max(1.0 - z, 0.0), t2 = t * t;
    const Lanes::Mask inner = z.v < 0.5;
    const Lanes outer_alpha = -4.0 * t2 / max(z, 0.5);
    return {select(inner, 2.0 / 3 + z * z * (4.0 * z - 4.0), (4.0 / 3) * t * t2),
            select(inner, 12.0 * z - 8.0, outer_alpha),
            select(inner, 12.0 * z, 8.0 * t - outer_alpha)};
  }
};

/// Quintic B-spline, C4; phi(0) = 11/20.
struct QuinticSpline {
  static KernelValue at(Lanes z) {
    const Lanes q = 3.0 * z;
    const Lanes a = max(3.0 - q, 0.0), b = max(2.0 - q, 0.0), c = max(1.0 - q, 0.0);
    const auto power = [](Lanes x, int n) {
      Lanes p = x;
      for (int i = 1; i < n; ++i) p *= x;
      return p;
    };
    const Lanes phi = (power(a, 5) - 6.0 * power(b, 5) + 15.0 * power(c, 5)) / 120.0;
    const Lanes slope = (power(a, 4) - 6.0 * power(b, 4) + 15.0 * power(c, 4)) / -8.0;
    const Lanes bend = 1.5 * (power(a, 3) - 6.0 * power(b, 3) + 15.0 * power(c, 3));
    const Lanes::Mask inner = q.v < 1.0;
    const Lanes outer_alpha = slope / max(z, 1.0 / 3);
    return {phi, select(inner, 9.0 * (q * q * (1.0 - 5.0 / 12 * q) - 1.0), outer_alpha),
            select(inner, q * q * (18.0 - 11.25 * q), bend - outer_alpha)};
  }
};

/// Wendland's C2 function; phi(0) = 1.
struct WendlandC2 {
  static KernelValue at(Lanes z) {
    const Lanes t = max(1.0 - z, 0.0), t2 = t * t;
    return {t2 * t2 * (4.0 * z + 1.0), -20.0 * t * t2, 60.0 * z * t2};
  }
};

/// Wendland's C4 function; phi(0) = 1.
struct WendlandC4 {
  static KernelValue at(Lanes z) {
    const Lanes t = max(1.0 - z, 0.0), t2 = t * t, t4 = t2 * t2;
    return {t4 * t2 * (z * (35.0 * z + 18.0) + 3.0) / 3.0, (-56.0 / 3) * (5.0 * z + 1.0) * t4 * t,
            560.0 * z * z * t4};
  }
};

/// Quartic spline of the element-free Galerkin method, C2; phi(0) = 1.
struct QuarticSpline {
  static KernelValue at(Lanes z) {
    const Lanes inside = min(z, 1.0), t = 1.0 - inside;
    return {t * t * t * (3.0 * inside + 1.0), -12.0 * t * t, 24.0 * inside * t};
  }
};

/// (1 - z^2)^3, C2; phi(0) = 1. The function of a particle has the factor 1/support^2, so that
/// particles of a fine layer weigh more than coarse ones behind it.
struct Triweight {
  static constexpr bool weighs_by_support = true;
  static KernelValue at(Lanes z) {
    const Lanes t = max(1.0 - z * z, 0.0), t2 = t * t;
    return {t * t2, -6.0 * t2, 24.0 * z * z * t};
  }
};

}  // namespace kernel_function

/// The factor of the kernel function of a particle with the support H / ratio. All particles around
/// a point have one H.
template <class W>
constexpr Real kernel_weight(Real ratio) {
  if constexpr (requires { W::weighs_by_support; }) return ratio * ratio;
  return 1;
}

/// Calls f with an object of the type of the kernel: it is chosen once, outside of all loops.
template <class F>
decltype(auto) with_kernel_function(KernelFunction kernel_function, F&& f) {
  switch (kernel_function) {
    case KernelFunction::quintic_spline:
      return f(kernel_function::QuinticSpline{});
    case KernelFunction::wendland_c2:
      return f(kernel_function::WendlandC2{});
    case KernelFunction::wendland_c4:
      return f(kernel_function::WendlandC4{});
    case KernelFunction::quartic_spline:
      return f(kernel_function::QuarticSpline{});
    case KernelFunction::triweight:
      return f(kernel_function::Triweight{});
    case KernelFunction::cubic_spline:
      break;
  }
  return f(kernel_function::CubicSpline{});
}

}  // namespace meniscus
