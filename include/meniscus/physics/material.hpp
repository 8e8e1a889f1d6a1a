// SPDX-License-Identifier: BSD-3-Clause
// Materials: from the table of a scene to the internal force of a body. The template that joins law
// and integration rule is instantiated once per law, at its registration.
#pragma once
#include "meniscus/body/nodal_cells.hpp"
#include "meniscus/core/error.hpp"
#include "meniscus/physics/cell_average.hpp"
#include "meniscus/physics/internal_force.hpp"
#include "meniscus/physics/reference_director.hpp"

#include <algorithm>
#include <memory>
#include <string>

namespace meniscus {

/// How the internal force is integrated.
struct Integration {
  std::string rule = "q_scni";  ///< "q_scni", "gauss" or "nodal"
  int gauss_points = 3;         ///< per direction and cell, for "gauss"
  /// "full", "cell_average" (with "q_scni" only) or "automatic": cell_average for "q_scni" where
  /// the bulk modulus is at least 1000 shear moduli.
  std::string volumetric = "automatic";
};

/// A material read from a scene, ready to be put on a body.
template <int D>
class Material {
 public:
  virtual ~Material() = default;
  struct Built {
    std::unique_ptr<ForceTerm> force;
    MassReport mass;
    bool cell_average;                ///< one volume change per nodal cell
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
      const std::vector<L> laws = laws_at(places, body.geometry);
      if (averages(integration, laws))
        return put<CellAverage<D, L>>(body, std::move(op.rule), laws, op.shape_integral);
      return put<L>(body, std::move(op.rule), laws, op.shape_integral);
    }
    const bool gauss = integration.rule == "gauss";
    const auto X = body.particles.X();
    const std::vector<Vec<D>> places =
        gauss ? cell_gauss_points(body.geometry.grid, integration.gauss_points).X
              : std::vector<Vec<D>>(X.begin(), X.end());
    PointRule<D> rule =
        gauss ? build_gauss_rule(body, integration.gauss_points) : build_nodal_rule(body);
    if (!uniform()) rule.per_group = 1;
    return put<L>(body, std::move(rule), laws_at(places, body.geometry), shape_integrals(body));
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

  /// One law for all groups of stress points, or one at the place of each if the material varies.
  std::vector<L> laws_at(const std::vector<Vec<D>>& places, const Geometry<D>& geometry) const {
    std::vector<L> laws;
    for (const Vec<D>& X : places) {
      laws.push_back(law_at(X, geometry));
      if (uniform()) break;
    }
    return laws;
  }

  static bool averages(const Integration& integration, const std::vector<L>& laws) {
    if (integration.volumetric != "automatic") return integration.volumetric == "cell_average";
    return std::any_of(laws.begin(), laws.end(),
                       [](const L& law) { return bulk_over_shear(law) >= 1e3; });
  }

  /// `Points`: the law of a group of stress points, L itself or what is made of it.
  template <class Points, class Rule>
  typename Material<D>::Built put(Body<D>& body, Rule rule, const std::vector<L>& laws,
                                  const std::vector<Real>& shape_integral) const {
    std::vector<Real> density(static_cast<std::size_t>(body.size()), law_.base.density);
    if (!law_.uniform())
      for (Index A = 0; A < body.size(); ++A)
        at(density, A) = law_at(at(body.particles.X(), A), body.geometry).density;
    const MassReport mass = lump_mass(body, density, shape_integral);
    std::optional<std::string> note;
    if constexpr (NotingLaw<L>) note = laws.front().note(mean_spacing(body.geometry.grid));
    return {force<Points>(body, std::move(rule), laws), mass, !std::is_same_v<Points, L>,
            std::move(note)};
  }

  template <class Points, class Rule>
  static std::unique_ptr<ForceTerm> force(const Body<D>& body, Rule rule,
                                          const std::vector<L>& laws) {
    if constexpr (Points::viscous)
      if (std::all_of(laws.begin(), laws.end(), [](const L& law) { return law.inviscid(); }))
        return force<WithoutViscosity<Points>>(body, std::move(rule), laws);
    return std::make_unique<InternalForce<D, Points, Rule>>(
        body, std::move(rule), std::vector<Points>(laws.begin(), laws.end()));
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
