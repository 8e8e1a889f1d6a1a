// SPDX-License-Identifier: BSD-3-Clause
// Output of a body with internal stress: fields and measures from the state at its quadrature
// points, which the law and the integration rule provide.
#pragma once
#include "meniscus/physics/force_term.hpp"
#include "numbers/tensor.hpp"

namespace meniscus {

/// The state at one quadrature point of a body.
struct StressPoint {
  Index owner;        ///< particle whose cell it lies in, numbered in the body
  Real weight;        ///< reference volume (2D: area)
  Tensor<Real> H;     ///< F - I
  Tensor<Real> P;     ///< elastic first Piola stress
  Real J;             ///< det F, or that which cells share
  Real volume_ratio;  ///< J_0 of the reference (body/reference.hpp)
};

/// Calls the function for all quadrature points of a body in a fixed order.
using VisitStressPoints =
    std::function<void(const Motion&, const std::function<void(const StressPoint&)>&)>;

/// A particle without quadrature points takes the output of the nearest particle that owns some.
/// With one Gauss point per grid cell there are many such particles.
struct StandIn {
  Index particle, owner;
};

/// The stand-ins for the particles at X; owns[A] is true if particle A has quadrature points. Empty
/// if no particle has any.
template <int D>
std::vector<StandIn> stand_ins(std::span<const Vec<D>> X, const std::vector<bool>& owns);

/// J, F, pressure, von Mises and Cauchy stress: means over the quadrature points of each particle's
/// cell, weighted by volume. `particles` is the size of the body.
std::vector<FieldSource> stress_fields(const VisitStressPoints& visit, Index particles,
                                       std::vector<StandIn> stand_ins);

/// Current volume, smallest det F from the current reference, and mean pressure of a body.
std::vector<MeasureSource> stress_measures(const VisitStressPoints& visit, int space_dimension);

}  // namespace meniscus
