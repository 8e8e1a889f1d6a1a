// SPDX-License-Identifier: BSD-3-Clause
// Demonstration: a surface law in one file, without a change elsewhere. A skin that resists a
// change of its area; the tests of everything registered find it.
#include "meniscus/physics/surface_registry.hpp"

namespace meniscus::demo_surface_law {
namespace {

/// w = K (Js - 1)^2 / 2, dw/dF = K (Js - 1) dJs/dF.
struct DemoSkin {
  static constexpr std::string_view type_name = "demo_skin", example = "stiffness = 1\n";
  Real stiffness = 0;

  static Rows<DemoSkin> rows() {
    return {real_row("stiffness", &DemoSkin::stiffness, dimension::tension, range::positive,
                     "energy per area and squared relative change of area")};
  }
  template <class T>
  T energy_density(const SurfaceState<T>& s) const {
    return 0.5 * stiffness * (s.stretch - 1.0) * (s.stretch - 1.0);
  }
  template <class T>
  Tensor<T> stress(const SurfaceState<T>& s, T weight) const {
    // dJs/dF_iK = (Js^2 cof_iK - m_i (m_j cof_jK)) / (Js J)
    const T factor =
        weight * stiffness * (s.stretch - 1.0) / (s.stretch * (1.0 + volume_change(s.H)));
    return Tensor<T>::map([&](int i, int K) {
      T along = s.m[0] * s.cofactor(0, K);
      for (int j = 1; j < 3; ++j) along += at(s.m, j) * s.cofactor(j, K);
      return factor * (s.stretch * s.stretch * s.cofactor(i, K) - at(s.m, i) * along);
    });
  }
};

const bool registered = register_surface_law<DemoSkin>("demonstration: resists a change of area");

}  // namespace
}  // namespace meniscus::demo_surface_law
