// SPDX-License-Identifier: BSD-3-Clause
// Resistance of a whole surface against a change of its area.
#include "physics/surface/global_area.hpp"

#include "physics/surface/surface_rule.hpp"

namespace meniscus {
namespace {

template <int D>
class GlobalArea final : public ForceTerm {
 public:
  GlobalArea(const Body<D>& body, const GlobalAreaKeys& keys, int points)
      : body_(body),
        keys_(keys),
        surface_(body, points),
        chunk_sums_(surface_.points.chunk_sums(body)),
        areas_(static_cast<std::size_t>(surface_.groups())) {
    reference_ = parallel_sum(surface_.groups(), 0.0,
                              [&](Index g) { return sum(surface_.points.weight(g)); });
  }

  std::string name() const override { return "area of the surface of '" + body_.name + "'"; }
  std::string_view energy_kind() const override { return "area"; }

  /// The first phase computes the areas of this rank's groups, the second one the forces of the
  /// tension.
  Report add_force(const Motion& motion, Forces force) override {
    const NodalVector* u = displacements(motion);
    chunk_sums_.for_own_chunks([&](int, Index begin, Index end) {
      for (Index g = begin; g < end; ++g) at(areas_, g) = area_of(g, u);
    });
    return force.gather(
        {chunk_sums_.gathered(surface_.groups(), areas_.data())}, motion,
        [this](const Motion& at_motion, const Forces& all) { return pull(at_motion, all); });
  }
  void add_tangent(const Motion& motion, const Motion& change, Forces force) override {
    const NodalVector *u = displacements(motion), *du = displacements(change);
    const auto stretched = [&](Index g) {
      return surface_.state(g, dual(surface_.gradients(g, u), surface_.gradients(g, du)));
    };
    Dual<Real> area = 0.0;
    for (Index g = 0; g < surface_.groups(); ++g) {
      const Dual<Lanes> of_group = Dual<Lanes>(surface_.points.weight(g)) * stretched(g).stretch;
      area += Dual<Real>(sum(of_group.v), sum(of_group.d));
    }
    const Dual<Real> tension = tension_at(motion.time, area);
    chunk_sums_.accumulate(body_.part(force), [&](int, Index begin, Index end, NodalVector* f) {
      for (Index g = begin; g < end; ++g) {
        const auto s = stretched(g);
        const Dual<Lanes> factor =
            Dual<Lanes>(-1.0 * surface_.points.weight(g)) * Dual<Lanes>(tension) * s.stretch;
        surface_.points.scatter(g, derivative(factor * dual_tangents(s)), f);
      }
    });
  }

  std::optional<Real> stored_energy(const Motion& motion) const override {
    const Real excess = excess_at(motion.time, area(motion));
    return keys_.modulus * reference_ / 2 * excess * excess;
  }
  Real steady_after() const override { return keys_.ramp.end; }
  /// The law reads the motion in the loop over rows only.
  bool reads(StepReads& reads) override {
    reads.rows(chunk_sums_, body_.first);
    return true;
  }

  std::vector<MeasureSource> measures() const override {
    return {{"area_fraction", dimension::none, "area of the surface / that of the reference",
             [this](const Motion& motion) { return area(motion) / reference_; }},
            {"area_tension", dimension::tension, "tension that keeps the area of the surface",
             [this](const Motion& motion) { return tension_at(motion.time, area(motion)); }}};
  }
  std::size_t bytes() const override {
    return surface_.bytes() + chunk_sums_.bytes() + areas_.size() * sizeof(Real);
  }
  Offset pairs() const override { return surface_.points.pairs(); }

 private:
  const NodalVector* displacements(const Motion& motion) const {
    return motion.u.data() + body_.first;
  }
  Real area_of(Index g, const NodalVector* u) const {
    return sum(surface_.points.weight(g) * surface_.state(g, surface_.gradients(g, u)).stretch);
  }
  Real area(const Motion& motion) const {
    const NodalVector* u = displacements(motion);
    return parallel_sum(surface_.groups(), 0.0, [&](Index g) { return area_of(g, u); });
  }
  template <class T>
  T excess_at(Real time, const T& area) const {
    return area / reference_ - (1 + (keys_.target - 1) * keys_.ramp.fraction(time));
  }
  template <class T>
  T tension_at(Real time, const T& area) const {
    return keys_.modulus * excess_at(time, area);
  }
  Report pull(const Motion& motion, const Forces& force) {
    const NodalVector* u = displacements(motion);
    const Real excess = excess_at(
        motion.time, parallel_sum(surface_.groups(), 0.0, [&](Index g) { return at(areas_, g); }));
    const Real tension = keys_.modulus * excess;
    chunk_sums_.accumulate(body_.part(force), [&](int, Index begin, Index end, NodalVector* f) {
      for (Index g = begin; g < end; ++g) {
        const auto s = surface_.state(g, surface_.gradients(g, u));
        surface_.points.scatter(
            g, -tension * surface_.points.weight(g) * s.stretch * dual_tangents(s), f);
      }
    });
    Report report;
    report.external_power =
        -tension * reference_ * (keys_.target - 1) * keys_.ramp.rate(motion.time);
    return report;
  }

  const Body<D>& body_;
  GlobalAreaKeys keys_;
  SurfaceRule<D> surface_;
  ChunkSums chunk_sums_;
  std::vector<Real> areas_;  // [group] of the last force
  Real reference_ = 0;       // area of the reference
};

}  // namespace

template <int D>
std::unique_ptr<ForceTerm> global_area(const Body<D>& body, const GlobalAreaKeys& keys,
                                       int points) {
  return std::make_unique<GlobalArea<D>>(body, keys, points);
}
template std::unique_ptr<ForceTerm> global_area(const Body<2>&, const GlobalAreaKeys&, int);
template std::unique_ptr<ForceTerm> global_area(const Body<3>&, const GlobalAreaKeys&, int);

}  // namespace meniscus
