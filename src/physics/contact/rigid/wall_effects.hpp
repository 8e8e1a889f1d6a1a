// SPDX-License-Identifier: BSD-3-Clause
// Effects of a rigid partner in addition to the interaction of uniform strength: adhesion that
// varies with position and time, and friction.
#pragma once
#include "meniscus/physics/partner_registry.hpp"
#include "physics/contact/adhesion_work.hpp"
#include "physics/contact/contact_terms.hpp"

#include <algorithm>
#include <utility>

namespace meniscus {

/// Four contact points: positions and velocities relative to the partner, area vectors, distances,
/// and the forces computed so far.
template <int D>
struct WallPoints {
  std::array<Vec<D>, Lanes::width> x, v, V;
  Lanes distance;
  Lanes *T, *S;  ///< [i] dE/dx and dE/dV, as in contact_points.hpp
};

/// Sums of the effects over all contact points.
struct WallSums {
  AdhesionSupply supply;  ///< work of an adhesion that changes with time
  Real heat = 0;          ///< power of friction
  Real adhesion = 0;      ///< largest adhesion of a point

  friend WallSums operator+(const WallSums& a, const WallSums& b) {
    return {a.supply + b.supply, a.heat + b.heat, std::max(a.adhesion, b.adhesion)};
  }
};

template <int D>
class WallEffects {
 public:
  WallEffects(const Interaction& interaction, const MovingPartner<D>& partner, Real friction)
      : interaction_(interaction),
        pattern_(interaction.pattern()),
        surface_(partner.surface),
        friction_(friction),
        flat_(interaction.flat()) {}

  bool any() const { return pattern_ != nullptr || friction_ > 0; }
  bool rubs() const { return friction_ > 0; }
  const AdhesionPattern* pattern() const { return pattern_; }
  /// True if the stiffness at that gap comes from the varying adhesion, not from the fixed core.
  bool varies_at(Real gap) const { return pattern_ && gap >= flat_.equilibrium_gap; }
  /// Energy per area in full contact for the factor W = 1.
  Real adhesion() const { return pattern_ ? 1 : flat_.adhesion; }

  /// Energy of a point at x with the area vector V and the field S, if the adhesion varies at unit
  /// adhesion. The core is left out: it belongs to the load, not to the area.
  Real unit_energy(const Vec<D>& x, Real distance, const Vec<D>& V, const Vec<D>& S) const {
    return distance < flat_.equilibrium_gap ? adhesion() * surface_->foot(x).normal.dot(V)
                                            : S.dot(V);
  }

  /// Adds the effects at `time` to the forces of four points.
  WallSums add(WallPoints<D>& points, Real time) const {
    WallSums sums;
    for (int lane = 0; lane < Lanes::width; ++lane) {
      if (!(points.distance[lane] < interaction_.range())) continue;
      if (pattern_) sums = sums + vary(points, lane, time);
      if (friction_ > 0) sums.heat += rub(points, lane);
    }
    return sums;
  }
  /// Adds friction only. Returns its heat.
  Real rub(WallPoints<D>& points) const {
    Real heat = 0;
    for (int lane = 0; lane < Lanes::width; ++lane)
      if (points.distance[lane] < interaction_.range()) heat += rub(points, lane);
    return heat;
  }

  /// Sum of the areas with friction (weight chi), and the integral of the slip velocity over them.
  std::pair<Real, Vec<D>> slip(const WallPoints<D>& points) const {
    std::pair<Real, Vec<D>> sum{0, Vec<D>::Zero()};
    for (int lane = 0; lane < Lanes::width; ++lane) {
      if (!(points.distance[lane] < interaction_.range())) continue;
      const Slipping slip = slipping(points, lane);
      sum.first += slip.chi * slip.faced;
      sum.second += slip.chi * slip.faced * slip.velocity;
    }
    return sum;
  }

  /// Work of the changing adhesion since the last accepted step.
  Real work(const WallSums& sums) const { return work_.since_step(sums.supply); }
  /// Sets the start time; must be called at the beginning of a run.
  void begin(Real time) { work_.begin(time); }
  /// Accepts the step that ends at `time` and has these sums.
  void commit(Real time, const WallSums& sums) { work_.commit(time, sums.supply); }
  void archive(const Archive& a) {
    if (keeps_work()) work_.archive(a, D);
  }

 private:
  bool keeps_work() const { return pattern_ && pattern_->depends_on_time(); }
  /// Replaces the forces at unit adhesion by the forces at W(x, t). The energy is E = W e, so that
  ///
  ///   dE/dV = W S,   dE/dx = W T + (S.V) grad W.
  ///
  /// Below the equilibrium gap, the core is added to the adhesion. The core does not vary; there
  /// the field of the adhesion is n.
  WallSums vary(WallPoints<D>& points, int lane, Real time) const {
    const Eigen::Vector3d x = spatial<D>(at(points.x, lane));
    const Real W = (*pattern_)(x, time);
    const Eigen::Vector3d slope = pattern_->gradient(x, time);
    Real e = 0;
    if (points.distance[lane] < flat_.equilibrium_gap) {
      const auto foot = surface_->foot(at(points.x, lane));
      e = foot.normal.dot(at(points.V, lane));
      const Vec<D> turned = foot.bend * at(points.V, lane);
      for (int i = 0; i < D; ++i) {
        points.T[i].set(lane, points.T[i][lane] + (W - 1) * turned[i] + e * slope[i]);
        points.S[i].set(lane, points.S[i][lane] + (W - 1) * foot.normal[i]);
      }
    } else {
      for (int i = 0; i < D; ++i) e += points.S[i][lane] * at(points.V, lane)[i];
      for (int i = 0; i < D; ++i) {
        points.T[i].set(lane, W * points.T[i][lane] + e * slope[i]);
        points.S[i].set(lane, W * points.S[i][lane]);
      }
    }
    WallSums sums;
    sums.adhesion = W;
    if (pattern_->depends_on_time()) sums.supply = work_.supply(*pattern_, x, W, e, time);
    return sums;
  }

  /// Slip at a point: chi, the area that faces the partner, and the velocity along the partner.
  struct Slipping {
    Real chi, faced;
    Vec<D> velocity;
  };
  Slipping slipping(const WallPoints<D>& points, int lane) const {
    const Vec<D> n = surface_->foot(at(points.x, lane)).normal;
    return {wetted(points.distance[lane]), std::max(0.0, -n.dot(at(points.V, lane))),
            at(points.v, lane) - n.dot(at(points.v, lane)) * n};
  }

  /// Adds the traction - friction chi v_t on the area that faces the partner. Returns its heat.
  Real rub(WallPoints<D>& points, int lane) const {
    const Slipping slip = slipping(points, lane);
    const Real drag = friction_ * slip.chi * slip.faced;
    for (int i = 0; i < D; ++i) points.T[i].set(lane, points.T[i][lane] + drag * slip.velocity[i]);
    return drag * slip.velocity.squaredNorm();
  }

  /// The weight chi: 1 in contact; beyond, it falls smoothly to 0 with the energy of the
  /// interaction.
  Real wetted(Real gap) const {
    if (gap <= flat_.equilibrium_gap) return 1;
    return std::clamp(-interaction_.at(gap).energy / adhesion(), 0.0, 1.0);
  }

  const Interaction& interaction_;
  const AdhesionPattern* pattern_;  // null if adhesion is uniform and constant
  std::shared_ptr<const PartnerShape<D>> surface_;
  Real friction_;
  PlaneContact flat_;
  AdhesionWork work_;
};

}  // namespace meniscus
