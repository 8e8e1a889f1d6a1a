// SPDX-License-Identifier: BSD-3-Clause
// Surface tension of the whole surface of a body, in four discrete forms (RKPM note 4).
#pragma once
#include "body/body.hpp"
#include "meniscus/physics/force_term.hpp"

#include <array>
#include <memory>
#include <string>

namespace meniscus {

/// The discrete forms, by the names of tension_form_names.
enum class TensionForm { balanced, weak, curvature, triangles };
inline constexpr std::array<const char*, 4> tension_form_names{"balanced", "weak", "curvature",
                                                               "triangles"};
inline const char* name_of(TensionForm form) {
  return tension_form_names[static_cast<std::size_t>(form)];
}

/// The exact gradient of gamma c A. A is the area of closed patches through positions
/// (SurfacePatches); c makes gamma c A exact in the reference. It is balanced together with a fluid
/// whose pressure works on the volume of the same patches (FluidPoints). At rest the body is then a
/// sphere without spurious currents.
///
/// With `face`, A is the area of the patches of this face alone, and c = 1: a correction of one
/// face would change angles at its edge. If the body has wetted faces, their areas have other
/// energies (tension_shares()), and c = 1.
template <int D>
std::unique_ptr<ForceTerm> balanced_surface_tension(const Body<D>& body, Real gamma,
                                                    const std::string& face = "");

/// f_A,i = -gamma sum_q da (I - n n)_ij F^-1_Kj N_A,K: the exact gradient of gamma times the
/// discrete area sum_q da. Needs first derivatives only. `points`: Gauss points per facet
/// direction.
template <int D>
std::unique_ptr<ForceTerm> weak_surface_tension(const Body<D>& body, Real gamma, int points);

/// f_A = sum_q N_A gamma 2 kappa n da with 2 kappa = T_KL (n_i G_iKL - N_K,L / s), the corrected
/// (2.42) of Fan 2014. The force is purely normal with the least nodal scatter, but is not a
/// gradient. Throws InputError if the surface is not smooth. This form alone needs second
/// derivatives.
template <int D>
std::unique_ptr<ForceTerm> curvature_surface_tension(const Body<D>& body, Real gamma, int points);

/// Area of a flat triangle (2D: length of a segment), and minus its gradient: the forces of unit
/// tension on the corners, f_I = (1/2) (x_I+2 - x_I+1) x n.
template <int D>
struct FlatPull {
  Real area;
  std::array<Vec<D>, D> force;
};
template <int D>
FlatPull<D> flat_pull(const std::array<Vec<D>, D>& corners);

/// The exact gradient of the area of flat triangles (2D: segments) between the positions x(X_B) of
/// the boundary particles. It is of low order; the corrected (2.44) of Fan 2014.
template <int D>
std::unique_ptr<ForceTerm> triangle_surface_tension(const Body<D>& body, Real gamma);

}  // namespace meniscus
