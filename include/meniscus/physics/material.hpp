// SPDX-License-Identifier: BSD-3-Clause
// From the material of a scene to the internal force of a body. The template that joins law and
// integration rule is instantiated once per law, at its registration.
#pragma once
#include "meniscus/body/nodal_cells.hpp"
#include "meniscus/core/error.hpp"
#include "meniscus/physics/internal_force.hpp"
#include "meniscus/physics/reference_director.hpp"

#include <memory>
#include <string>

namespace meniscus {

/// How the internal force is integrated.
struct Integration {
  std::string rule = "q_scni";  ///< "q_scni", "gauss" or "nodal"
  int gauss_points = 3;         ///< per direction and cell, for "gauss"
};

/// A material read from a scene, ready to be put on a body.
template <int D>
class Material {
 public:
  virtual ~Material() = default;
  struct Built {
    std::unique_ptr<ForceTerm> force;
    MassReport mass;
    std::optional<std::string> note;  ///< for the log
  };
  /// Sets body.mass and builds the internal force. Throws SolveError (shape functions) and
  /// InputError (a formula leaves its range somewhere in the body).
  virtual Built build(Body<D>& body, const Integration& integration) const = 0;
};

template <int D, Law L>
class MaterialOf final : public Material<D> {
 public:
  /// `director` for a DirectedLaw.
  MaterialOf(Varying<L> law, std::optional<ReferenceDirector> director)
      : law_(std::move(law)), director_(std::move(director)) {}

  typename Material<D>::Built build(Body<D>& body, const Integration& integration) const override {
    if (integration.rule == "q_scni") {
      CellOperator<D> op = build_cell_rule(body);
      std::vector<Vec<D>> places;
      for (Index A = 0; A < body.size(); ++A) places.push_back(body.cells.centroid(A));
      return put(body, std::move(op.rule), places, op.shape_integral);
    }
    const bool gauss = integration.rule == "gauss";
    const auto X = body.particles.X();
    const std::vector<Vec<D>> places =
        gauss ? cell_gauss_points(body.geometry.grid, integration.gauss_points).X
              : std::vector<Vec<D>>(X.begin(), X.end());
    PointRule<D> rule =
        gauss ? build_gauss_rule(body, integration.gauss_points) : build_nodal_rule(body);
    if (!uniform()) rule.per_group = 1;
    return put(body, std::move(rule), places, shape_integrals(body));
  }

 private:
  bool uniform() const { return law_.uniform() && (!director_ || director_->uniform()); }

  L law_at(const Vec<D>& X, const Geometry<D>& geometry) const {
    Eigen::Vector3d place = Eigen::Vector3d::Zero();
    place.template head<D>() = X;
    L law = law_.at(place);
    if (const auto wrong = check(law); wrong && !law_.uniform())
      throw InputError(law_.formulas.front().place + ": " + *wrong);
    if constexpr (DirectedLaw<L>) {
      const Eigen::Vector3d h = director_->at(X, geometry);
      law.director = {h[0], h[1], h[2]};
    }
    return law;
  }

  /// `places` of the groups of stress points, for materials that vary.
  template <class Rule>
  typename Material<D>::Built put(Body<D>& body, Rule rule, const std::vector<Vec<D>>& places,
                                  const std::vector<Real>& shape_integral) const {
    std::vector<L> laws;
    for (const Vec<D>& X : places) {
      laws.push_back(law_at(X, body.geometry));
      if (uniform()) break;
    }
    std::vector<Real> density(static_cast<std::size_t>(body.size()), law_.base.density);
    if (!law_.uniform())
      for (Index A = 0; A < body.size(); ++A)
        at(density, A) = law_at(at(body.particles.X(), A), body.geometry).density;
    const MassReport mass = lump_mass(body, density, shape_integral);
    std::optional<std::string> note;
    if constexpr (NotingLaw<L>) note = laws.front().note(mean_spacing(body.geometry.grid));
    return {std::make_unique<InternalForce<D, L, Rule>>(body, std::move(rule), std::move(laws)),
            mass, std::move(note)};
  }

  Varying<L> law_;
  std::optional<ReferenceDirector> director_;
};

/// Reads the numbers of the law L from a scene; problems are noted in the block.
template <int D, Law L>
std::unique_ptr<Material<D>> read_material(const Block& block) {
  Varying<L> law = read_varying<L>(block);
  if (const auto wrong = check(law.base); wrong && law.uniform()) block.problem("", *wrong);
  std::optional<ReferenceDirector> director;
  if constexpr (DirectedLaw<L>) director.emplace(block, D);
  return std::make_unique<MaterialOf<D, L>>(std::move(law), std::move(director));
}

}  // namespace meniscus
