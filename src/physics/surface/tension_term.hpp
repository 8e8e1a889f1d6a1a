// SPDX-License-Identifier: BSD-3-Clause
// Common base of the discrete forms of surface tension, with the energy gamma x area.
#pragma once
#include "body/body.hpp"
#include "meniscus/physics/force_term.hpp"

namespace meniscus {

/// A form of surface tension implements area() and add_force().
template <int D>
class TensionTerm : public ForceTerm {
 public:
  TensionTerm(const Body<D>& body, Real gamma) : body_(body), gamma_(gamma) {}

  std::string name() const override { return "surface tension of '" + body_.name + "'"; }
  std::string_view energy_kind() const final { return "surface"; }
  std::optional<Real> stored_energy(const Motion& motion) const override {
    return gamma_ * area(motion);
  }
  std::vector<MeasureSource> measures() const override {
    return {{"area", of_sum(dimension::area, D), "current area of the surface (2D: length)",
             [this](const Motion& motion) { return area(motion); }}};
  }

 protected:
  virtual Real area(const Motion& motion) const = 0;

  /// The displacements and forces of the body.
  const Lanes* displacements(const Motion& motion) const { return motion.u.data() + body_.first; }
  ForceVector own_part(const ForceVector& force) const { return body_.part(force); }

  const Body<D>& body_;
  Real gamma_;
};

}  // namespace meniscus
