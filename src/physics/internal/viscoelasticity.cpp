// SPDX-License-Identifier: BSD-3-Clause
// Stress of branches of Maxwell in the nodal cells of a body.
#include "physics/internal/viscoelasticity.hpp"

#include "physics/continued_term.hpp"
#include "physics/internal/stress_point_force.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace meniscus {
namespace {

template <int D>
class Viscoelasticity final : public StressPointForce<D, CellRule<D>>, public ContinuedTerm {
  using Base = StressPointForce<D, CellRule<D>>;

 public:
  Viscoelasticity(const Body<D>& body, CellRule<D> rule, std::unique_ptr<MaxwellPoints> points)
      : Base(body, std::move(rule), std::move(points), nullptr),
        points_(static_cast<MaxwellPoints&>(this->laws())),
        heat_before_(static_cast<std::size_t>(this->chunks()), 0.0) {}

  std::string name() const override { return "viscoelasticity of '" + this->body().name + "'"; }

  std::string_view energy_kind() const override { return "branches"; }

  Report add_force(const Motion& motion, Forces force) override {
    const NodalVector* u = motion.u.data() + this->body().first;
    const auto weights = points_.weights(motion.time);
    const Real third = (motion.time - points_.time()) / 3;
    this->accumulate(force, [&](int chunk, Index begin, Index end, NodalVector* f) {
      Lanes heat = Lanes::zero(), stored = Lanes::zero();
      Lanes::Mask folded{};
      for (Index g = begin; g < end; ++g) {
        const Lanes w = this->rule().weight(g);
        Tensor<Lanes> H;
        this->rule().gather(g, u, H);
        folded |= ~((1.0 + volume_change(H)).v > 0.0);  // also true for NaN
        this->rule().scatter(g, -w * points_.stress(g, weights, H), f);
        heat += w * points_.heat_density(g, weights, H);
        if (force.energies) stored += w * points_.energy_density(g, weights, H);
      }
      // The power is a square of the strain that has not relaxed yet, which is about linear in
      // time.
      const Real before = at(heat_before_, chunk), after = sum(heat);
      const Real lost = third * (before + std::sqrt(std::max(before * after, 0.0)) + after);
      this->of_chunks()[chunk] = {lost, 0, sum(stored)};
      if (folded[0] | folded[1] | folded[2] | folded[3])
        this->of_chunks()[chunk].failed = this->first_folded(begin, end, u);
    });
    return force.gather({this->of_chunks().gathered()}, motion,
                        [this](const Motion& at_motion, const Forces& all) {
                          Report report = this->sum_of(this->of_chunks(), at_motion, all);
                          report.lost = std::exchange(report.heat, 0);
                          return report;
                        });
  }

  std::optional<Real> potential(const Motion& motion) override {
    const NodalVector* u = motion.u.data() + this->body().first;
    const auto weights = points_.weights(motion.time);
    return this->body().sum_over_rows(this->rule().groups(), 0.0, [&](Index g) {
      return sum(this->rule().weight(g) *
                 points_.potential_density(g, weights, this->gradients(g, u)));
    });
  }
  /// Time by itself supplies no work: the energy that the branches lose is heat.
  Real work_between(const Motion&, const Motion&) const override { return 0; }

  void commit(const Motion& motion) override {
    const NodalVector* u = motion.u.data() + this->body().first;
    const auto weights = points_.weights(motion.time);
    this->for_own_chunks([&](int chunk, Index begin, Index end) {
      Lanes heat = Lanes::zero();
      for (Index g = begin; g < end; ++g) {
        Tensor<Lanes> H;
        this->rule().gather(g, u, H);
        heat += this->rule().weight(g) * points_.heat_density(g, weights, H);
        points_.accept(g, weights, H);
      }
      at(heat_before_, chunk) = sum(heat);
    });
    points_.accept_time(motion.time);
  }
  void archive(const Archive& a) override {
    points_.archive(a);
    const Gathered all{heat_before_.data(),
                       this->body().division.items(static_cast<Index>(heat_before_.size()))};
    if (!a.is_reading()) GatherTogether()({&all, 1});
    a("heat", heat_before_, of_sum(dimension::power, D));
  }
  void continue_from(const Archive& a) override {
    archive(a);
    points_.accept_time(0);
  }

  std::vector<FieldSource> fields() const override { return {}; }
  std::vector<MeasureSource> measures() const override { return {}; }
  /// This is the sum of the internal force already.
  Real squared_gradients(const Motion&) override { return 0; }
  std::size_t bytes() const override { return Base::bytes() + heat_before_.size() * sizeof(Real); }

 private:
  MaxwellPoints& points_;
  std::vector<Real> heat_before_;  // [chunk] power at the last accepted step
};

}  // namespace

template <int D>
std::unique_ptr<ForceTerm> viscoelasticity(const Body<D>& body,
                                           std::vector<MaxwellBranch> branches) {
  CellRule<D> rule = build_cell_rule(body).rule;
  auto points = std::make_unique<MaxwellPoints>(std::move(branches), rule.groups(), body.division);
  return std::make_unique<Viscoelasticity<D>>(body, std::move(rule), std::move(points));
}
template std::unique_ptr<ForceTerm> viscoelasticity(const Body<2>&, std::vector<MaxwellBranch>);
template std::unique_ptr<ForceTerm> viscoelasticity(const Body<3>&, std::vector<MaxwellBranch>);

}  // namespace meniscus
