// SPDX-License-Identifier: BSD-3-Clause
// Frank energy of a director, and its forces on positions and on the director.
#include "physics/director/frank_energy.hpp"

#include "kernel/monomials.hpp"
#include "kernel/row_sums.hpp"

#include <fmt/core.h>

namespace meniscus {

template <int D>
FrankEnergy<D>::FrankEnergy(const Body<D>& body, std::size_t field, const NematicNumbers& numbers,
                            CellRule<D> rule)
    : body_(body),
      field_(field),
      numbers_(numbers),
      length_stiffness_(numbers.frank_constant / (numbers.core_length * numbers.core_length)),
      rule_(std::move(rule)),
      cell_sums_(rule_.chunk_sums(body)),
      value_sums_(body.chunk_sums(body.at_particles.start, body.at_particles.particle)),
      metric_(static_cast<std::size_t>(rule_.groups())),
      circle_metric_(body.geometry.grid.revolved ? metric_.size() : 0),
      volume_(metric_.size()) {}

template <int D>
const NodalVector* FrankEnergy<D>::director(const Motion& motion) const {
  return at(motion.fields, field_).x.data() + body_.first;
}

template <int D>
Real FrankEnergy<D>::excess(Index A, const NodalVector* x) const {
  const Lanes h = value_at(body_.at_particles, A, x);
  return sum(h * h) - 1;
}

template <int D>
void FrankEnergy<D>::hold(Index cell, const Tensor<Lanes>& cofactor, Lanes J) {
  const Lanes w = rule_.weight(cell), factor = w / J;
  Metric& M = at(metric_, cell);
  for (int K = 0; K < D; ++K)
    for (int L = K; L < D; ++L) {
      Lanes square = cofactor(0, K) * cofactor(0, L);
      for (int i = 1; i < D; ++i) square += cofactor(i, K) * cofactor(i, L);
      at(M, hessian_index(D, K, L)) = factor * square;
    }
  if (!circle_metric_.empty()) at(circle_metric_, cell) = factor * cofactor(2, 2) * cofactor(2, 2);
  at(volume_, cell) = sum(w * J);
}

/// The product of the gradient of the director and the metric.
template <int D>
Tensor<Lanes> FrankEnergy<D>::weighted(const Tensor<Lanes>& slope, Index cell) const {
  const Metric& M = at(metric_, cell);
  Tensor<Lanes> y = Tensor<Lanes>::zero();
  for (int i = 0; i < D; ++i)
    for (int K = 0; K < D; ++K)
      for (int L = 0; L < D; ++L) y(i, K) += slope(i, L) * at(M, hessian_index(D, L, K));
  if (!circle_metric_.empty()) y(2, 2) = slope(2, 2) * at(circle_metric_, cell);
  return y;
}

template <int D>
Report FrankEnergy<D>::add_force(const Motion& motion, Forces force) {
  const NodalVector *u = motion.u.data() + body_.first, *h = director(motion);
  const Real K = numbers_.frank_constant;
  cell_sums_.accumulate(body_.part(force), [&](int, Index begin, Index end, NodalVector* f) {
    for (Index P = begin; P < end; ++P) {
      Tensor<Lanes> H, slope;
      rule_.gather(P, u, H);
      rule_.gather(P, h, slope);
      const Tensor<Lanes> cofactor = cofactor_of_deformation(H);
      const Lanes J = 1.0 + volume_change(H), w = rule_.weight(P);
      const Tensor<Lanes> Jg = slope * transpose(cofactor);
      const Real r = excess(P, h);
      const Lanes stretch = K / (J * J);
      const Lanes energy = 0.5 * stretch * contract(Jg, Jg) + Lanes(length_stiffness_ / 4 * r * r);
      const Tensor<Lanes> stress = add_diagonal((-stretch) * (transpose(Jg) * Jg), energy);
      rule_.scatter(P, (-w) * (stress * cofactor), f);
      hold(P, cofactor, J);
    }
  });
  if (!force.fields.empty()) add_held_force(h, body_.part(force.of_field(field_)));
  return {};
}

template <int D>
std::optional<Real> FrankEnergy<D>::stored_energy(const Motion& motion) const {
  const NodalVector *u = motion.u.data() + body_.first, *h = director(motion);
  return body_.sum_over_rows(rule_.groups(), 0.0, [&](Index P) {
    Tensor<Lanes> H, slope;
    rule_.gather(P, u, H);
    rule_.gather(P, h, slope);
    const Lanes J = 1.0 + volume_change(H), w = rule_.weight(P);
    const Tensor<Lanes> Jg = slope * transpose(cofactor_of_deformation(H));
    const Real r = excess(P, h);
    return sum(w * (0.5 * numbers_.frank_constant / J * contract(Jg, Jg) +
                    length_stiffness_ / 4 * r * r * J));
  });
}

template <int D>
void FrankEnergy<D>::hold_places(const NodalVector* u) {
  parallel_for(cell_sums_.own_rows(rule_.groups()), [&](Index P) {
    Tensor<Lanes> H;
    rule_.gather(P, u, H);
    hold(P, cofactor_of_deformation(H), 1.0 + volume_change(H));
  });
}

template <int D>
Real FrankEnergy<D>::held_energy(const NodalVector* x) const {
  return body_.sum_over_rows(rule_.groups(), 0.0, [&](Index P) {
    Tensor<Lanes> slope;
    rule_.gather(P, x, slope);
    const Real r = excess(P, x);
    return 0.5 * numbers_.frank_constant * sum(contract(slope, weighted(slope, P))) +
           length_stiffness_ / 4 * r * r * at(volume_, P);
  });
}

template <int D>
void FrankEnergy<D>::add_held_force(const NodalVector* x, const ForceVector& f) {
  const Lanes minus_K = -numbers_.frank_constant;
  cell_sums_.accumulate(f, [&](int, Index begin, Index end, NodalVector* sum) {
    for (Index P = begin; P < end; ++P) {
      Tensor<Lanes> slope;
      rule_.gather(P, x, slope);
      rule_.scatter(P, minus_K * weighted(slope, P), sum);
    }
  });
  value_sums_.accumulate(f, [&](int, Index begin, Index end, NodalVector* sum) {
    for (Index P = begin; P < end; ++P) {
      const Lanes h = value_at(body_.at_particles, P, x);
      const Real r = meniscus::sum(h * h) - 1;
      scatter_value(body_.at_particles, P, (-length_stiffness_ * at(volume_, P) * r) * h, sum);
    }
  });
}

/// Warns of a coarse spacing: a defect whose director turns within its core is accurate to 0.1 % up
/// to a spacing of 1.5 core lengths.
template <int D>
std::optional<std::string> FrankEnergy<D>::warning(const Motion&) const {
  constexpr Real bearable = 1.5;
  const Real spacing = mean_spacing(body_.geometry.grid);
  if (spacing <= bearable * numbers_.core_length) return std::nullopt;
  return fmt::format(
      "body '{}': its core_length is {:.3g} of the mean spacing, which does not resolve defects of "
      "the director; use finer cells, or at least {:.3g} of it",
      body_.name, numbers_.core_length / spacing, 1 / bearable);
}

template <int D>
std::vector<MeasureSource> FrankEnergy<D>::measures() const {
  return {{"director_energy", of_sum(dimension::energy, D),
           "energy of the gradient of the director (Frank) and of its length",
           [this](const Motion& motion) { return *stored_energy(motion); }}};
}

template <int D>
std::size_t FrankEnergy<D>::bytes() const {
  return rule_.bytes() + cell_sums_.bytes() + value_sums_.bytes() +
         metric_.size() * sizeof(Metric) + circle_metric_.size() * sizeof(Lanes) +
         volume_.size() * sizeof(Real);
}

template class FrankEnergy<2>;
template class FrankEnergy<3>;

}  // namespace meniscus
