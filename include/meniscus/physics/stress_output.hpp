// SPDX-License-Identifier: BSD-3-Clause
// Output of a body with internal stress: fields and measures from the state at its stress points.
// Apart from the law and the integration rule, which only say what that state is.
#pragma once
#include "meniscus/core/tensor.hpp"
#include "meniscus/physics/force_term.hpp"

namespace meniscus {

/// One stress point of a body.
struct StressPoint {
  Index owner;        ///< particle of the body whose cell it lies in
  Real weight;        ///< reference volume (2D: area)
  Tensor<Real> H;     ///< F - I
  Tensor<Real> P;     ///< elastic first Piola stress
  Real volume_ratio;  ///< J_0 of the reference (body/reference.hpp)
};

/// Calls the function for all stress points of a body in a fixed order.
using VisitStressPoints =
    std::function<void(const Motion&, const std::function<void(const StressPoint&)>&)>;

/// A particle that owns no stress point, as many do with one Gauss point per grid cell, reports
/// what the nearest one reports that does.
struct StandIn {
  Index particle, owner;
};

/// Those of the particles at X; `owns` says which own stress points. None if none does.
template <int D>
std::vector<StandIn> stand_ins(std::span<const Vec<D>> X, const std::vector<bool>& owns);

/// J, F, pressure, von Mises and Cauchy stress: averages over the stress points of each particle's
/// cell, weighted by volume. `particles` is the size of the body.
std::vector<FieldSource> stress_fields(const VisitStressPoints& visit, Index particles,
                                       std::vector<StandIn> stand_ins);

/// Current volume, smallest J and mean pressure of a body in `space_dimension` dimensions.
std::vector<MeasureSource> stress_measures(const VisitStressPoints& visit, int space_dimension);

}  // namespace meniscus
