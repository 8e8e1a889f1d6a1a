// SPDX-License-Identifier: BSD-3-Clause
// Surface tension: an energy gamma per current area, w = gamma Js.
#include "meniscus/physics/surface_registry.hpp"
#include "physics/surface/surface_tension.hpp"

namespace meniscus {
namespace {

struct Tension {
  static constexpr std::string_view type_name = "tension", example = "gamma = 1\n";
  Real gamma = 0;

  static Rows<Tension> rows() {
    return {
        real_row("gamma", &Tension::gamma, dimension::tension, range::positive, "surface tension")};
  }

  template <class T>
  T energy_density(const SurfaceState<T>& s) const {
    return gamma * s.stretch;
  }

  /// The stress P = dw/dF = gamma Js (I - n n) F^-T = gamma (Js/J) (cof F - m (m . cof F) / Js^2).
  template <class T>
  [[gnu::always_inline]] Tensor<T> stress(const SurfaceState<T>& s, T weight) const {
    const T factor = gamma * weight * s.stretch / (1.0 + volume_change(s.H));
    std::array<T, 3> n_cof;
    for (int K = 0; K < 3; ++K)
      at(n_cof, K) =
          (s.m[0] * s.cofactor(0, K) + s.m[1] * s.cofactor(1, K) + s.m[2] * s.cofactor(2, K)) /
          (s.stretch * s.stretch);
    return Tensor<T>::map(
        [&](int i, int K) { return factor * (s.cofactor(i, K) - at(s.m, i) * at(n_cof, K)); });
  }
};

const bool registered = register_surface_law<Tension>("an energy per current area");

}  // namespace

template <int D>
std::unique_ptr<ForceTerm> weak_surface_tension(const Body<D>& body, Real gamma, int points) {
  return std::make_unique<SurfaceForce<D, Tension>>(body, Tension{gamma}, points);
}
template std::unique_ptr<ForceTerm> weak_surface_tension(const Body<2>&, Real, int);
template std::unique_ptr<ForceTerm> weak_surface_tension(const Body<3>&, Real, int);

}  // namespace meniscus
