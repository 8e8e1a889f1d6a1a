// SPDX-License-Identifier: BSD-3-Clause
// Invariants of the strain of a surface and stresses of isotropic membranes, for surface laws that
// are written in the trace of Cs = Fs^T Fs and the area ratio Js (membranes note 1).
#pragma once
#include "physics/surface/surface_law.hpp"

namespace meniscus {

/// Strain Es = (Cs - I)/2 of a point of a surface with its invariants in the surface. No terms of
/// order one cancel near the reference.
template <class T>
struct MembraneStrain {
  Tensor<T> E;    ///< Es
  T sum;          ///< tr Es
  T square;       ///< tr Es^2
  T determinant;  ///< of Es as a 2 x 2 tensor
  T area_square;  ///< Js^2 - 1 = 2 tr Es + 4 det Es

  explicit MembraneStrain(const SurfaceState<T>& s)
      : E(surface_strain(s)), sum(trace(E)), square(contract(E, E)) {
    determinant = 0.5 * (sum * sum - square);
    area_square = 2.0 * sum + 4.0 * determinant;
  }
};

/// The surface stress P = Fs (along_strain Es + along_cofactor cof Cs + along_unit I), where cof Cs
/// = Js^2 Cs^-1 = (1 + 2 tr Es) I - 2 Es in the surface. An energy w(Js) has along_cofactor =
/// w'(Js)/Js.
template <class T>
[[gnu::always_inline]] inline Tensor<T> membrane_stress(const SurfaceState<T>& s,
                                                        const MembraneStrain<T>& strain,
                                                        const T& along_strain,
                                                        const T& along_cofactor,
                                                        const T& along_unit) {
  const Tensor<T> S = add_diagonal((along_strain - 2.0 * along_cofactor) * strain.E,
                                   along_unit + along_cofactor * (1.0 + 2.0 * strain.sum));
  return in_reference_plane(deformation_gradient(s.H) * S, s);
}

/// An energy per modulus that keeps the area of a membrane from vanishing: (0.2/Js - 1)^3 at area
/// ratios Js < 0.2, and zero above. Laws of membranes that have a finite energy at Js = 0 add it.
struct AreaBarrier {
  static constexpr Real begins = 0.2;

  template <class T>
  static T energy(const T& stretch) {
    const T depth = depth_at(stretch);
    return depth * depth * depth;
  }
  /// Derivative of energy() with respect to Js, divided by Js.
  template <class T>
  static T slope_per_stretch(const T& stretch) {
    const T depth = depth_at(stretch);
    return -3.0 * begins * depth * depth / (stretch * stretch * stretch);
  }

 private:
  template <class T>
  static T depth_at(const T& stretch) {
    return select(value(stretch).v < begins, begins / stretch - 1.0, T(0.0));
  }
};

}  // namespace meniscus
