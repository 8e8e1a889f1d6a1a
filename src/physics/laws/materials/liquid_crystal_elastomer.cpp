// SPDX-License-Identifier: BSD-3-Clause
// Liquid crystal elastomer without stress in its reference: neo-classical energy with a director h
// that follows the deformation (Fan 2014, (4.29), corrected in constitutive note 4.1). It has an
// active stress (4.28).
//
//   W = mu/2 [tr(l0 F^T l^-1 F) - 3] - mu ln J + U(J) + active part;
//   l0 = I + (s0 - 1) h0 h0,  l^-1 = I - (s - 1)/s h h,  |h0| = |h| = 1.
//
// The director is not a degree of freedom, because its Frank length is far below the particle
// spacing. h is a function of F, and P = dW/dF is the total derivative; the Kirchhoff stress is
// symmetric.
#include "input/ramp.hpp"
#include "meniscus/physics/law_registry.hpp"

#include <fmt/core.h>

namespace meniscus {
namespace {

template <class T>
using Vector = std::array<T, 3>;

template <class T>
[[gnu::always_inline]] inline T dot(const Vector<T>& a, const Vector<T>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
/// a + s b
template <class T>
[[gnu::always_inline]] inline Vector<T> add(const Vector<T>& a, const T& s, const Vector<T>& b) {
  return {a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]};
}
template <class T>
[[gnu::always_inline]] inline Vector<T> product(const Tensor<T>& A, const Vector<T>& x) {
  const auto row = [&](int i) { return A(i, 0) * x[0] + A(i, 1) * x[1] + A(i, 2) * x[2]; };
  return {row(0), row(1), row(2)};
}
/// a b + c d, a sum of dyads.
template <class T>
[[gnu::always_inline]] inline Tensor<T> dyads(const Vector<T>& a, const Vector<T>& b,
                                              const Vector<T>& c, const Vector<T>& d) {
  return Tensor<T>::map([&](int i, int j) { return at(a, i) * at(b, j) + at(c, i) * at(d, j); });
}

struct LiquidCrystalElastomer {
  static constexpr std::string_view type_name = "liquid_crystal_elastomer";
  static constexpr std::string_view meaning =
      "W = mu/2 (tr(l0 F^T l^-1 F) - 3) - mu ln J + K/2 (J - 1)^2, l0 = I + (s - 1) h0 h0 and l = "
      "I + (s - 1) h h of the step length s; with the stress -zeta h h of an activity";
  static constexpr bool viscous = false;
  enum class Follows { normal, convected };
  enum class VolumeEnergy { quadratic, logarithmic };

  Real density, mu, bulk_modulus;
  Real step_length;      ///< s0, at which the network was formed
  Real step_length_end;  ///< s after its ramp; 0: s0
  Real activity;         ///< zeta after its ramp
  Real frank_constant;   ///< kappa
  Ramp step_length_ramp, activity_ramp;
  Follows follows = Follows::normal;
  VolumeEnergy volume_energy = VolumeEnergy::quadratic;
  std::array<Real, 3> director{0, 0, 1};  ///< h0
  // Values at the present time, set by at_time():
  Real step_change = 0, step_rate = 0;  ///< s - s0, ds/dt
  Real zeta = 0, zeta_rate = 0;

  static Rows<LiquidCrystalElastomer> rows();

  std::optional<std::string> note(Real spacing) const;

  /// P-wave modulus along the director or across it. In between it is up to (s - 1) mu larger.
  Real p_wave_modulus() const { return bulk_modulus + 2 * mu; }

  /// Ratio of the bulk modulus K + 2/3 mu to the shear modulus mu of the isotropic part.
  Real bulk_over_shear() const { return bulk_modulus / mu + 2.0 / 3.0; }

  Real steady_after() const {
    return std::max(step_length_end > 0 ? step_length_ramp.end : 0,
                    activity != 0 ? activity_ramp.end : 0);
  }

  [[gnu::always_inline]] LiquidCrystalElastomer at_time(Real time) const {
    LiquidCrystalElastomer now = *this;
    const Real change = step_length_end > 0 ? step_length_end - step_length : 0;
    now.step_change = change * step_length_ramp.fraction(time);
    now.step_rate = change * step_length_ramp.rate(time);
    now.zeta = activity * activity_ramp.fraction(time);
    now.zeta_rate = activity * activity_ramp.rate(time);
    return now;
  }

  /// Energy per reference volume, with the vectors d (tilt) and q (stretch) for `normal`, or e
  /// (shear) and p (stretch) for `convected`; they are described below.
  ///   normal:     W = W_neo-Hooke + mu/2 (s0 - 1) |d|^2 + mu/2 (s0/s - 1)(|q|^2 - 1) - zeta ln
  ///   |q|; convected:  W = W_neo-Hooke - mu/2 (1 - 1/s) |e|^2/|p|^2 + mu/2 (s0/s - 1)(|p|^2 - 1)
  ///               - zeta ln |p|.
  /// The energy terms with ramps (s, zeta) are zero at |q| = 1 or |p| = 1.
  template <class T>
  T energy_density(const Tensor<T>& H) const {
    if (follows == Follows::convected) {
      const Line<T> line(H, reference<T>());
      return neo_hooke_energy(H) - 0.5 * mu * softness() * line.e2 / line.p2 +
             stretch_energy(line.p2_change);
    }
    const Normal<T> normal(H, reference<T>());
    return neo_hooke_energy(H) + 0.5 * mu * (step_length - 1) * dot(normal.d, normal.d) +
           stretch_energy(normal.q2_change);
  }

  template <class T>
  [[gnu::always_inline]] Tensor<T> stress(const Tensor<T>& H) const {
    const Vector<T> h0 = reference<T>();
    const Tensor<T> P = neo_hooke_stress(H);
    if (follows == Follows::convected) {
      // d|p|^2/2 = p h0, d|e|^2/2 = p e + (F e) h0
      const Line<T> line(H, h0);
      const T b = mu * softness() / line.p2;
      const T stretch = b * line.e2 / line.p2 + (unbalance() - zeta / line.p2);
      const Vector<T> Fe = add(line.e, T(1.0), product(H, line.e));
      const Vector<T> none{T(0.0), T(0.0), T(0.0)};
      return P + dyads(line.p, add(add(none, stretch, h0), -b, line.e), add(none, -b, Fe), h0);
    }
    // d|d|^2/2 = d h0 + q (F^-1 d), d|q|^2/2 = q (F^-1 q)
    const Normal<T> normal(H, h0);
    const T tilt = T(mu * (step_length - 1)), stretch = unbalance() - zeta / normal.q2;
    const Vector<T> none{T(0.0), T(0.0), T(0.0)};
    const Vector<T> td = add(none, tilt, normal.d);
    return P + dyads(td, h0, normal.q, normal.pulled_back(add(td, stretch, normal.q)));
  }

  template <class T>
  [[gnu::always_inline]] T energy_rate(const Tensor<T>& H) const {
    const Real s = step_length + step_change, over_s_rate = -step_rate / (s * s);
    if (follows == Follows::convected) {
      const Line<T> line(H, reference<T>());
      return 0.5 * mu * over_s_rate * (line.e2 / line.p2 + step_length * line.p2_change) -
             0.5 * zeta_rate * log1p(line.p2_change);
    }
    const T change = Normal<T>(H, reference<T>()).q2_change;
    return 0.5 * mu * over_s_rate * step_length * change - 0.5 * zeta_rate * log1p(change);
  }

 private:
  /// Director h along n = F^-T h0, the normal of the layers. The material line p = F h0 is q + d: q
  /// along n, and d, the tilt, across it. Let c = cof F h0 = J n and w = p - c, which are small or
  /// exact near the reference. Then d = (I - c c/|c|^2) w, and |q| = J/|c| = 1/|n|.
  template <class T>
  struct Normal {
    Tensor<T> cof_less_identity;
    T J;
    Vector<T> d, q;
    T q2, q2_change;  ///< |q|^2, |q|^2 - 1

    [[gnu::always_inline]] Normal(const Tensor<T>& H, const Vector<T>& h0) {
      const T theta = volume_change(H), one(1.0);
      J = 1.0 + theta;
      cof_less_identity = add_diagonal(cofactor(H) - transpose(H), trace(H));
      const Vector<T> c_less_h0 = product(cof_less_identity, h0), c = add(h0, one, c_less_h0);
      const Vector<T> w = add(product(H, h0), T(-1.0), c_less_h0);
      const T c2_change = 2.0 * dot(h0, c_less_h0) + dot(c_less_h0, c_less_h0);
      const T over_c2 = 1.0 / (1.0 + c2_change);
      d = add(w, -(dot(c, w) * over_c2), c);
      q = add(add(add(h0, one, c_less_h0), one, w), T(-1.0), d);
      q2_change = (theta * (2.0 + theta) - c2_change) * over_c2;
      q2 = 1.0 + q2_change;
    }

    /// F^-1 x = (cof F)^T x / J
    [[gnu::always_inline]] Vector<T> pulled_back(const Vector<T>& x) const {
      const Vector<T> y = add(x, T(1.0), product(transpose(cof_less_identity), x));
      const T over_J = 1.0 / J;
      return {over_J * y[0], over_J * y[1], over_J * y[2]};
    }
  };

  /// Director h along p = F h0. e = (I - h0 h0) F^T F h0 is the shear of the planes across h0.
  template <class T>
  struct Line {
    Vector<T> p, e;
    T p2, p2_change, e2;  ///< |p|^2, |p|^2 - 1, |e|^2

    [[gnu::always_inline]] Line(const Tensor<T>& H, const Vector<T>& h0) {
      const Vector<T> p_less_h0 = product(H, h0);
      p = add(h0, T(1.0), p_less_h0);
      const Vector<T> strain = add(p_less_h0, T(1.0), product(transpose(H), p));  // C h0 - h0
      e = add(strain, -dot(h0, strain), h0);
      p2_change = 2.0 * dot(h0, p_less_h0) + dot(p_less_h0, p_less_h0);
      p2 = 1.0 + p2_change;
      e2 = dot(e, e);
    }
  };

  template <class T>
  [[gnu::always_inline]] Vector<T> reference() const {
    return {T(director[0]), T(director[1]), T(director[2])};
  }
  /// 1 - 1/s
  Real softness() const { return 1 - 1 / (step_length + step_change); }
  /// mu (s0/s - 1): the tension along h when s differs from s0.
  Real unbalance() const { return -mu * step_change / (step_length + step_change); }

  template <class T>
  T stretch_energy(const T& square_change) const {
    return 0.5 * unbalance() * square_change - 0.5 * zeta * log1p(square_change);
  }

  /// mu/2 (|F|^2 - 3) - mu ln J + U(J); first-order parts are cancelled analytically.
  template <class T>
  T neo_hooke_energy(const Tensor<T>& H) const {
    const T theta = volume_change(H);  // J - 1
    const T isochoric = 0.5 * contract(H, H) - higher_volume_change(H) - log1p_remainder(theta);
    const T volumetric = volume_energy == VolumeEnergy::quadratic ? theta : log1p(theta);
    return mu * isochoric + 0.5 * bulk_modulus * volumetric * volumetric;
  }
  /// mu (F - F^-T) + U'(J) cof F, as in neo_hookean.cpp.
  template <class T>
  [[gnu::always_inline]] Tensor<T> neo_hooke_stress(const Tensor<T>& H) const {
    const T theta = volume_change(H), over_J = 1.0 / (1.0 + theta);
    const T a = mu * over_J;
    const T b = volume_energy == VolumeEnergy::quadratic ? bulk_modulus * theta
                                                         : bulk_modulus * log1p(theta) * over_J;
    const T diagonal = a * higher_volume_change(H) + b * (1.0 + trace(H));
    return add_diagonal(T(mu) * H + (a - b) * (transpose(H) - cofactor(H)), diagonal);
  }
};

/// Input key of an enum. Its values have the texts `names` in the order of the enum; the first is
/// the default.
template <class E>
Row<LiquidCrystalElastomer> enum_row(std::string key, E LiquidCrystalElastomer::*member,
                                     std::vector<std::string> names, std::string meaning) {
  Row<LiquidCrystalElastomer> row = choice_row<LiquidCrystalElastomer>(
      std::move(key), nullptr, names, std::move(meaning), names.front());
  row.read = [key = row.key, member, names](LiquidCrystalElastomer& law, const Block& block) {
    const std::string name = block.choice(key, names, names.front());
    for (std::size_t i = 0; i < names.size(); ++i)
      if (names[i] == name) law.*member = static_cast<E>(i);
  };
  return row;
}

Rows<LiquidCrystalElastomer> LiquidCrystalElastomer::rows() {
  using L = LiquidCrystalElastomer;
  return {
      parameter_row<L>("density", &L::density, dimension::density, range::positive,
                       "mass per reference volume", 1.25),
      parameter_row<L>("mu", &L::mu, dimension::pressure, range::positive, "shear modulus", 0.75),
      parameter_row<L>("bulk_modulus", &L::bulk_modulus, dimension::pressure, range::positive,
                       "K of the energy of volume changes; with mu, K + 2/3 mu resists small ones",
                       1.5),
      enum_row<VolumeEnergy>("volume_energy", &L::volume_energy, {"quadratic", "logarithmic"},
                             "K/2 (J - 1)^2 or K/2 ln^2 J"),
      enum_row<Follows>("director", &L::follows, {"normal", "convected"},
                        "what the director follows: the normal F^-T h0 of layers (shear modulus "
                        "s mu along them), or the line F h0 (mu/s)"),
      parameter_row<L>("step_length", &L::step_length, dimension::none, range::positive,
                       "anisotropy s of the chains when the network was formed", 2.5),
      parameter_row<L>("step_length_end", &L::step_length_end, dimension::none, range::non_negative,
                       "s after its ramp, e.g. 1 of a heated network; 0: no change", 0, 0),
      ramp_row<L>("step_length_ramp", &L::step_length_ramp, "step_length"),
      parameter_row<L>("activity", &L::activity, dimension::pressure, range::any,
                       "zeta of the active Kirchhoff stress -zeta h h; extensile if positive", 0,
                       0),
      ramp_row<L>("activity_ramp", &L::activity_ramp, "activity from 0"),
      parameter_row<L>("frank_constant", &L::frank_constant, dimension::force, range::non_negative,
                       "kappa of Frank elasticity, which is reported, not simulated", 0, 0)};
}

/// Note with the Frank energy density of a director that turns by a radian per spacing: K/(2
/// spacing^2) with K = kappa (s - 1)^2/s (constitutive note 4.1).
std::optional<std::string> LiquidCrystalElastomer::note(Real spacing) const {
  if (frank_constant == 0) return {};
  const Real length = std::sqrt(frank_constant / mu) / spacing;
  const Real s = step_length, energy = 0.5 * length * length * (s - 1) * (s - 1) / s;
  return fmt::format(
      "Frank elasticity is not simulated: its length sqrt(kappa/mu) is {:.3g} of the mean "
      "spacing{}; "
      "a director that turns by 1 rad per spacing would store {:.3g} mu per volume",
      length, length < 1 ? ", which does not resolve it" : "", energy);
}

const bool registered = register_law<LiquidCrystalElastomer>();

}  // namespace
}  // namespace meniscus
