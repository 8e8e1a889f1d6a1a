// SPDX-License-Identifier: BSD-3-Clause
// Cavity: the force of a filling on the surface around it.
#include "physics/loads/cavity.hpp"

#include "physics/assembled_force.hpp"
#include "physics/loads/cavity_gap.hpp"

#include <fmt/core.h>

#include <cmath>

namespace meniscus {

namespace {

template <int D>
class Cavity final : public ForceTerm, public AssembledForce {
 public:
  Cavity(const Body<D>& body, SurfacePart part, const CavityFilling& filling, int points)
      : surface_(body, part, points), filling_(filling) {
    const NodalVectors rest(static_cast<std::size_t>(body.first + body.size()), Lanes::zero());
    now_ = surface_.placed({0, rest, rest});
    reference_volume_ = now_.size.volume;
    if (part == SurfacePart::inner) gap_.emplace(body, surface_.reference());
  }

  std::string name() const override { return "cavity of '" + surface_.body().name + "'"; }
  std::string_view energy_kind() const override { return vented() ? "" : "cavity"; }

  Report add_force(const Motion& motion, Forces force) override {
    Report report;
    if (vented() && !gap_) return report;
    surface_.place(motion, now_);
    report.failure = crossing();
    if (vented()) return report;
    const Real V = now_.size.volume;
    report.external_power = ramp_power(motion.time, V);
    surface_.add_volume_gradient(now_, pressure(motion.time, V),
                                 surface_.body().part(std::span<NodalVector>(force)));
    return report;
  }

  void add_tangent(const Motion& motion, const Motion& change, Forces force) override {
    if (vented()) return;
    const NodalVectors gradient = volume_gradient(motion, 0, change);
    const Real p = pressure(motion.time, volume(motion));
    add_gradient_change(motion, change, p, force);
    const Real dp = pressure_change(gradient, change);
    for (Index A = 0; A < surface_.body().size(); ++A)
      at(force, surface_.body().first + A) += dp * at(gradient, A);
  }

  bool has_stiffness() const override { return !vented(); }
  void announce(StiffnessMatrix& K) override {
    surface_.announce(K);
    if (!has_content()) return;
    pressure_node_ = K.add_nodes(1);
    K.announce_column(pressure_node_, surface_.particles());
  }
  /// The pressure of a content is an unknown of its own: [-p d2V, dV; dV, -V0/penalty].
  void add_stiffness(const Motion& motion, std::span<const Lanes> off,
                     StiffnessMatrix& K) override {
    const auto placed = surface_.placed(motion);
    const Real p = pressure(motion.time, placed.size.volume) + (off.empty() ? 0 : off[0][0]);
    surface_.add_volume_stiffness(placed, -p, K);
    if (!has_content()) return;
    const NodalVectors gradient = volume_gradient(motion, 0, motion);
    if (!K.is_here()) return;
    NodalVectors column(motion.u.size(), Lanes::zero());
    std::copy(gradient.begin(), gradient.end(), column.begin() + surface_.body().first);
    K.add_column(pressure_node_, column);
    K.add_to_diagonal(pressure_node_, -reference_volume_ / filling_.penalty);
  }
  std::vector<Dual<Lanes>> pressures(const Motion& motion, const Motion& change) override {
    if (!has_content()) return {};
    return {{Lanes(pressure(motion.time, volume(motion)), 0, 0, 0),
             Lanes(pressure_change(volume_gradient(motion, 0, change), change), 0, 0, 0)}};
  }
  void add_pressure_tangent(const Motion& motion, const Motion& change, std::span<const Lanes> off,
                            Forces force) override {
    if (has_content()) add_gradient_change(motion, change, off[0][0], force);
  }
  void subtract_pressure_force(const Motion& motion, const Motion& change,
                               std::span<const Lanes> off, Forces force) override {
    if (!has_content()) return;
    const NodalVectors here = volume_gradient(motion, 0, change),
                       there = volume_gradient(motion, 1, change);
    for (Index A = 0; A < surface_.body().size(); ++A)
      at(force, surface_.body().first + A) -= off[0][0] * (at(there, A) - at(here, A));
  }

  std::optional<Real> stored_energy(const Motion& motion) const override {
    if (vented()) return std::nullopt;
    const Real V = volume(motion);
    if (filling_.pressure)
      return -*filling_.pressure * filling_.ramp.fraction(motion.time) * (V - reference_volume_);
    return 0.5 * filling_.penalty * reference_volume_ * std::pow(excess(motion.time, V), 2);
  }
  std::optional<Real> potential(const Motion& motion) override {
    return vented() ? 0 : stored_energy(motion);
  }
  bool reads(StepReads& reads) override {
    surface_.list_reads(reads);
    return true;
  }
  Real steady_after() const override { return vented() ? 0 : filling_.ramp.end; }
  /// Scale of the force, before opposite sides cancel: pressure times area.
  Real uncancelled_force(const Motion& motion) const override {
    const auto size = surface_.size(motion);
    return std::abs(pressure(motion.time, size.volume)) * size.area;
  }

  std::vector<MeasureSource> measures() const override {
    std::vector<MeasureSource> measures{
        {"cavity_fraction", dimension::none, "enclosed volume / that of the reference",
         [this](const Motion& motion) { return volume(motion) / reference_volume_; }},
        {"cavity_pressure", dimension::pressure, "pressure inside above that outside",
         [this](const Motion& motion) { return pressure(motion.time, volume(motion)); }}};
    if (gap_)
      measures.push_back(
          {"cavity_gap", dimension::length, "smallest distance of opposite inner faces",
           [this](const Motion& motion) { return gap_->smallest(surface_.placed(motion)).width; }});
    return measures;
  }
  std::size_t bytes() const override { return surface_.bytes() + now_.bytes(); }
  Offset pairs() const override { return surface_.pairs(); }

 private:
  bool vented() const { return !filling_.pressure && !filling_.volume_target; }
  Real volume(const Motion& motion) const { return surface_.size(motion).volume; }
  bool has_content() const { return filling_.volume_target.has_value(); }
  /// force += factor times the change of dV/dd. The volume is a cubic polynomial of the positions,
  /// so central differences of its gradient are exact.
  void add_gradient_change(const Motion& motion, const Motion& change, Real factor, Forces force) {
    const NodalVectors ahead = volume_gradient(motion, 1, change),
                       behind = volume_gradient(motion, -1, change);
    for (Index A = 0; A < surface_.body().size(); ++A)
      at(force, surface_.body().first + A) += factor / 2 * (at(ahead, A) - at(behind, A));
  }
  /// The derivative of the pressure, at constant time.
  Real pressure_change(const NodalVectors& gradient, const Motion& change) const {
    const Body<D>& body = surface_.body();
    const Real dV = parallel_sum(body.size(), 0.0, [&](Index A) {
      return sum(at(gradient, A) * at(change.u, body.first + A));
    });
    return has_content() ? -filling_.penalty / reference_volume_ * dV : 0;
  }
  /// Gradient dV/dd_A for the particles of the body, at the displacements u + s du.
  NodalVectors volume_gradient(const Motion& motion, Real s, const Motion& change) {
    NodalVectors u(motion.u.begin(), motion.u.end());
    for (std::size_t A = 0; A < u.size(); ++A) u[A] += s * change.u[A];
    NodalVectors gradient(static_cast<std::size_t>(surface_.body().size()), Lanes::zero());
    surface_.add_volume_gradient(surface_.placed({motion.time, u, u}), 1, gradient);
    return gradient;
  }
  /// Relative excess volume V/V0 - target.
  Real excess(Real time, Real volume) const {
    const Real target = 1 + (*filling_.volume_target - 1) * filling_.ramp.fraction(time);
    return volume / reference_volume_ - target;
  }
  Real pressure(Real time, Real volume) const {
    if (filling_.pressure) return *filling_.pressure * filling_.ramp.fraction(time);
    return filling_.volume_target ? -filling_.penalty * excess(time, volume) : 0;
  }

  /// Power dE/dt of the ramp at constant volume.
  Real ramp_power(Real time, Real volume) const {
    const Real rate = filling_.ramp.rate(time);
    if (rate == 0) return 0;
    if (filling_.pressure) return -*filling_.pressure * rate * (volume - reference_volume_);
    return filling_.penalty * reference_volume_ * excess(time, volume) *
           (1 - *filling_.volume_target) * rate;
  }
  /// A failure if opposite inner faces touch at the positions of now_.
  std::optional<Failure> crossing() const {
    if (!gap_) return std::nullopt;
    const auto gap = gap_->smallest(now_);
    if (gap.width > 0) return std::nullopt;
    return Failure{
        surface_.body().first + surface_.owner(gap.point),
        fmt::format("opposite inner faces of the cavity touch: their distance is {:.4g}. "
                    "Deflate the cavity less or more slowly (ramp), or make it higher",
                    gap.width)};
  }

  mutable ClosedSurface<D> surface_;       // sums of chunks
  typename ClosedSurface<D>::Placed now_;  // surface at the motion of the last force
  CavityFilling filling_;
  Real reference_volume_ = 0;
  Index pressure_node_ = -1;
  std::optional<CavityGap<D>> gap_;
};

}  // namespace

template <int D>
std::unique_ptr<ForceTerm> cavity(const Body<D>& body, SurfacePart part,
                                  const CavityFilling& filling, int points) {
  return std::make_unique<Cavity<D>>(body, part, filling, points);
}
template std::unique_ptr<ForceTerm> cavity(const Body<2>&, SurfacePart, const CavityFilling&, int);
template std::unique_ptr<ForceTerm> cavity(const Body<3>&, SurfacePart, const CavityFilling&, int);

}  // namespace meniscus
