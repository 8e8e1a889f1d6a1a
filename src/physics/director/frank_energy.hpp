// SPDX-License-Identifier: BSD-3-Clause
// Frank energy of a director h with one constant, and the energy of its length (cells note 5.1):
//
//   E = sum_q w_q J_q [K/2 |g|^2 + K/(4 eps^2) (|h|^2 - 1)^2],   g = grad h F^-1.
//
// g is taken at the quadrature points of nodal cells. h is the value of the field at the particle
// of the cell, not its coefficient.
#pragma once
#include "body/body.hpp"
#include "physics/director/carried_field.hpp"
#include "physics/director/nematic_numbers.hpp"

namespace meniscus {

template <int D>
class FrankEnergy final : public ForceTerm, public FieldEnergy {
 public:
  /// `rule`: build_cell_rule(body).
  FrankEnergy(const Body<D>& body, std::size_t field, const NematicNumbers& numbers,
              CellRule<D> rule);

  std::string name() const override { return "Frank energy of '" + body_.name + "'"; }
  std::string_view energy_kind() const override { return "director"; }
  /// Adds the Ericksen stress (f I - K g^T g) cof F to the displacement, and the forces on the
  /// field.
  Report add_force(const Motion& motion, Forces force) override;
  std::optional<Real> stored_energy(const Motion& motion) const override;
  std::optional<std::string> warning(const Motion& motion) const override;
  std::vector<MeasureSource> measures() const override;
  std::size_t bytes() const override;
  Offset pairs() const override { return 3 * cell_sums_.pairs() + 2 * value_sums_.pairs(); }

  void hold_places(const NodalVector* u) override;
  Real held_energy(const NodalVector* x) const override;
  void add_held_force(const NodalVector* x, const ForceVector& f) override;

 private:
  /// w J F^-1 F^-T at four quadrature points, one per lane: the metric of |grad h|^2.
  using Metric = std::array<Lanes, static_cast<std::size_t>(hessian_count(D))>;

  /// Sets metric and volume of a cell.
  void hold(Index cell, const Tensor<Lanes>& cofactor, Lanes J);
  Tensor<Lanes> weighted(const Tensor<Lanes>& slope, Index cell) const;
  const NodalVector* director(const Motion& motion) const;
  /// |h|^2 - 1 at a particle.
  Real excess(Index A, const NodalVector* x) const;

  const Body<D>& body_;
  std::size_t field_;
  NematicNumbers numbers_;
  Real length_stiffness_;  // K/eps^2
  CellRule<D> rule_;
  ChunkSums cell_sums_, value_sums_;
  // For the positions set by hold_places() and the cells whose rows this process has:
  AlignedVector<Metric> metric_;        // [cell]
  AlignedVector<Lanes> circle_metric_;  // [cell] (2, 2) of the metric of a body of revolution
  std::vector<Real> volume_;            // [cell]
};

}  // namespace meniscus
