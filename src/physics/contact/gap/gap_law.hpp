// SPDX-License-Identifier: BSD-3-Clause
// The law of the gap between two deformable surfaces: energy per area, adhesion, and the definition
// of the gap.
#pragma once
#include "physics/contact/adhesion.hpp"
#include "physics/contact/gap/interaction.hpp"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace meniscus {

/// Law of the gap of a contact. Between two bodies the gap is the distance, and e falls smoothly to
/// zero over the last quarter of its range. Above ground the gap is measured along `up`, and the
/// law is not changed.
template <int D>
class GapLaw {
 public:
  /// `up`: direction away from the ground; empty between two bodies.
  GapLaw(std::shared_ptr<const Interaction> interaction, const std::vector<Real>& up)
      : interaction_(std::move(interaction)),
        pattern_(interaction_->pattern()),
        range_(interaction_->range()),
        rest_(interaction_->flat().equilibrium_gap),
        deepest_(interaction_->at(rest_).energy) {
    if (!up.empty()) up_ = Vec<D>::Map(up.data()).normalized();
  }

  const Interaction& interaction() const { return *interaction_; }
  /// The gap beyond which there is no interaction.
  Real range() const { return range_; }
  const std::optional<Vec<D>>& up() const { return up_; }

  /// Null if the adhesion is constant and part of the interaction.
  const AdhesionPattern* pattern() const { return pattern_; }
  /// True if the adhesion is W(X, t) with X in the reference of the ground.
  bool placed() const { return pattern_ && pattern_->depends_on_place(); }
  /// The factor W(t) of an adhesion that is uniform in position.
  Real adhesion(Real time) const {
    return pattern_ && !placed() ? (*pattern_)(Eigen::Vector3d::Zero(), time) : 1;
  }
  /// Energy per area in full contact, of the factor 1 if the adhesion varies.
  Real contact_energy() const { return deepest_; }
  /// True if the stiffness at that gap comes from the varying adhesion, not from the fixed core.
  bool varies_at(Real gap) const { return pattern_ && gap >= rest_; }

  struct Energy {
    Real value, slope;
    Real unit;  ///< energy without the core; if the adhesion varies at unit adhesion
  };
  /// Energy per area and its derivative: e Q with Q = 1 - t^3 (10 - 15 t + 6 t^2), where t grows
  /// from 0 to 1 over the last quarter of the range.
  Energy energy(Real gap, Real adhesion) const {
    PlaneState plane = interaction_->at(std::max(gap, interaction_->least_gap()));
    const Real unit = gap < rest_ ? deepest_ : plane.energy;
    if (pattern_) plane = varied(plane, gap, adhesion);
    if (up_ && interaction_->ends()) return {plane.energy, -plane.pressure, unit};
    const Real t = std::max(0.0, 4 * gap / range_ - 3), s = 1 - t;
    const Real Q = 1 - t * t * t * (10 - t * (15 - 6 * t)), dQ = -30 * t * t * s * s * 4 / range_;
    return {plane.energy * Q, plane.energy * dQ - plane.pressure * Q, unit * Q};
  }

 private:
  /// The state for the adhesion W, from the state for unit adhesion. Below the equilibrium gap the
  /// core is added, which does not vary.
  PlaneState varied(const PlaneState& plane, Real gap, Real W) const {
    if (gap < rest_) return {plane.energy - (W - 1), plane.pressure, plane.stiffness};
    return {W * plane.energy, W * plane.pressure, W * plane.stiffness};
  }

  std::shared_ptr<const Interaction> interaction_;
  const AdhesionPattern* pattern_;
  Real range_, rest_;  // range and equilibrium gap
  Real deepest_;       // energy there
  std::optional<Vec<D>> up_;
};

}  // namespace meniscus
