// SPDX-License-Identifier: BSD-3-Clause
// The director of a nematic: how the body carries it, its reaction forces on the body, and its
// output (cells note 5.2).
#pragma once
#include "body/body.hpp"
#include "physics/director/carried_field.hpp"
#include "physics/director/nematic_numbers.hpp"

namespace meniscus {

/// With the deformation gradient F_A at particle A and l = F_A' F_A^-1 = d + w (symmetric and skew
/// parts), the field is carried by h' = T h, T = w + lambda d - nu2 tr(d) I. A force -S on the
/// field does the power -S . T h. Its reaction on the body is the stress Y = lambda/2 (h S + S h) -
/// 1/2 (h S - S h) - nu2 (S . h) I at the particle, which gives
///
///   f_B = - sum_A Y_A F_A^-T dF_A/du_B.
template <int D>
class Director final : public CarriedField {
 public:
  Director(const Body<D>& body, std::size_t number, const NematicBody<D>& nematic);

  void carry(const NodalVector* from, const NodalVector* to,
             std::span<NodalVector> x) const override;
  void gather(std::span<NodalVector> x) const override;
  void add_reaction(const Motion& motion, Forces force) override;
  std::size_t bytes() const override;

  std::vector<FieldSource> fields();
  std::vector<MeasureSource> measures();

 private:
  NodalVectors values(const Motion& motion) const;
  template <class F>
  Real mean(F&& of_particle) const;
  Real order(const Motion& motion) const;
  Real tilt(const Lanes& director, Index A) const;
  void couples(const Motion& motion, std::span<Real> values);

  const Body<D>& body_;
  NematicNumbers numbers_;
  PointRows<D> gradients_;  // dF_A/du_B, a row per particle
  ChunkSums chunk_sums_;
  std::vector<Real> volume_;              // [particle]
  std::vector<Eigen::Vector3d> initial_;  // initial directors, [particle]
};

}  // namespace meniscus
