// SPDX-License-Identifier: BSD-3-Clause
// Materials: make the internal force of a body from a table of the scene. The template that
// combines a law with an integration rule is instantiated once per law, at its registration.
#pragma once
#include "body/grid/nodal_cells.hpp"
#include "body/mesh/mesh_regions.hpp"
#include "meniscus/error.hpp"
#include "physics/director/nematic_numbers.hpp"
#include "physics/director/reference_director.hpp"
#include "physics/internal/averaged_force.hpp"
#include "physics/internal/fluid_points.hpp"
#include "physics/internal/internal_force.hpp"
#include "physics/internal/referred_fluid.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <memory>
#include <string>

namespace meniscus {

/// How the internal force is integrated.
struct Integration {
  std::string rule = "q_scni";  ///< "q_scni", "gauss" or "nodal"
  int gauss_points = 3;         ///< per direction and cell, for "gauss"
  /// "full", "cell_average" (with "q_scni" only) or "automatic". Automatic is cell_average for
  /// solids with "q_scni", and for fluids with "q_scni" that are `enclosed`; else full.
  std::string volumetric = "automatic";
  /// True if the pressure of a fluid works on the volume that its surface encloses, to balance a
  /// `balanced` surface tension.
  bool enclosed = false;
};

/// A material read from a scene, ready to be applied to a body.
template <int D>
class Material {
 public:
  virtual ~Material() = default;
  struct Built {
    std::unique_ptr<ForceTerm> force;
    MassReport mass;
    bool cell_average;                   ///< a fluid with one volume change per nodal cell
    std::optional<std::string> note;     ///< for the log
    std::optional<std::string> warning;  ///< for the log: doubtful choices
    std::vector<Real> viscosity;  ///< shear viscosity of a fluid, per particle; empty: a solid
    Real bulk_modulus;            ///< smallest value in the body
    Real bulk_over_shear = 0;     ///< largest value in a solid; 0: not known
    std::unique_ptr<NematicBody<D>> nematic = {};  ///< null: no director
  };
  /// Sets body.mass and builds the internal force. Throws SolveError where shape functions cannot
  /// be determined, and InputError where a formula leaves its range.
  virtual Built build(Body<D>& body, const Integration& integration) const = 0;
  /// True if the material has no stress at rest except pressure.
  virtual bool fluid() const = 0;
  /// True for a nematic, which has a director as a second unknown.
  virtual bool carries_director() const { return false; }
  /// Makes `next` the material of the next region of the body; the first call gives that of the
  /// second region. Returns false if the two laws cannot stand in one body.
  virtual bool add_region(const Material&) { return false; }
};

/// The numbers of a law that its rows read.
template <Law L>
const std::vector<Real L::*>& numbers_of_law() {
  static const std::vector<Real L::*> numbers = [] {
    std::vector<Real L::*> all;
    for (const Row<L>& row : L::rows())
      if (row.member) all.push_back(row.member);
    return all;
  }();
  return numbers;
}

/// A material with the law L. Functions that run once are marked cold, since they are compiled for
/// every law.
template <int D, Law L>
class MaterialOf final : public Material<D> {
 public:
  /// `director` is needed for a DirectedLaw.
  MaterialOf(Varying<L> law, std::optional<ReferenceDirector> director)
      : director_(std::move(director)) {
    laws_.push_back(std::move(law));
  }

  /// The energies of solids without a director are linear in their numbers: where regions meet, the
  /// mean numbers have the mean energy.
  [[gnu::cold]] bool add_region([[maybe_unused]] const Material<D>& next) override {
    if constexpr (!FluidLaw<L> && !DirectedLaw<L>)
      if (const auto* same = dynamic_cast<const MaterialOf*>(&next)) {
        laws_.push_back(same->laws_.front());
        return true;
      }
    return false;
  }

  [[gnu::cold]] typename Material<D>::Built build(Body<D>& body,
                                                  const Integration& integration) const override {
    if (integration.rule == "q_scni") {
      CellOperator<D> op =
          body.cell_rows ? cell_rule_of(body, std::move(*body.cell_rows)) : build_cell_rule(body);
      body.cell_rows.reset();
      std::vector<Vec<D>> places;
      for (Index A = 0; A < body.size(); ++A) places.push_back(body.cell_origin(A));
      return integrated(body, std::move(op.rule),
                        laws_at(places, shares_of_nodes(body), body.geometry), op.shape_integral,
                        integration);
    }
    const bool gauss = integration.rule == "gauss";
    const auto X = body.particles.X();
    const std::vector<Vec<D>> places =
        gauss ? cell_gauss_points(body.geometry.grid, integration.gauss_points).X
              : std::vector<Vec<D>>(X.begin(), X.end());
    const Index per_group = uniform() ? PointRule<D>::most_per_group : 1;
    PointRule<D> rule = gauss ? build_gauss_rule(body, integration.gauss_points, per_group)
                              : build_nodal_rule(body, per_group);
    return integrated(body, std::move(rule), laws_at(places, shares_of_nodes(body), body.geometry),
                      shape_integrals(body), integration);
  }
  bool fluid() const override { return FluidLaw<L>; }

 private:
  bool same_numbers() const { return laws_.size() == 1 && laws_.front().uniform(); }
  bool uniform() const { return same_numbers() && (!director_ || director_->uniform()); }
  using Share = std::span<const Real>;  // [region] of a place
  using Portions = std::vector<Share>;  // [place]; empty for a body of one material
  Portions shares_of_nodes(const Body<D>& body) const {
    Portions shares;
    for (Index A = 0; laws_.size() > 1 && A < body.size(); ++A)
      shares.push_back(mesh_regions(body.geometry)->at_node(A));
    return shares;
  }
  L law_in(std::size_t region, const Vec<D>& X) const {
    const Varying<L>& varying = laws_[region];
    L law = varying.at(spatial<D>(X));
    if (const auto wrong = check(law); wrong && !varying.uniform())
      throw InputError(varying.formulas.front().place + ": " + *wrong);
    return law;
  }
  /// The law whose numbers are the means over the regions.
  L mean_law(const Vec<D>& X, Share share) const {
    L mean = laws_.front().base;
    for (Real L::*number : numbers_of_law<L>()) mean.*number = 0;
    for (std::size_t r = 0; r < share.size(); ++r) {
      if (share[r] == 0) continue;
      const L law = law_in(r, X);
      for (Real L::*number : numbers_of_law<L>()) mean.*number += share[r] * law.*number;
    }
    return mean;
  }
  L law_at(const Vec<D>& X, Share share, const Geometry<D>& geometry) const {
    L law = laws_.size() == 1 ? law_in(0, X) : mean_law(X, share);
    if constexpr (DirectedLaw<L>) {
      const Eigen::Vector3d h = director_->at(X, geometry);
      law.director = {h[0], h[1], h[2]};
    }
    return law;
  }

  /// One law for all groups of stress points if the material is uniform, else one law for each.
  std::vector<L> laws_at(const std::vector<Vec<D>>& places, const Portions& shares,
                         const Geometry<D>& geometry) const {
    std::vector<L> laws;
    for (std::size_t k = 0; k < places.size(); ++k) {
      laws.push_back(law_at(places[k], shares.empty() ? Share{} : shares[k], geometry));
      if (uniform()) break;
    }
    return laws;
  }

  /// True if a fluid has one volume change per nodal cell.
  static bool averages(const Integration& integration) {
    if (!FluidLaw<L> || integration.rule != "q_scni") return false;
    if (integration.volumetric != "automatic") return integration.volumetric == "cell_average";
    return integration.enclosed;
  }
  /// The share of the volume change of a point that its law sees, [law]. In a nearly incompressible
  /// solid it has the stiffness of one shear modulus. Up to a bulk modulus of three shear moduli,
  /// where nothing locks, and for laws without bulk_over_shear(), it is the whole change
  /// (locking note 2).
  static std::vector<Real> own_shares(const std::vector<L>& laws, const Integration& integration) {
    std::vector<Real> own;
    for (const L& law : laws) {
      constexpr Real whole_to = 3;
      const Real ratio = bulk_over_shear(law).value_or(0);
      const bool whole = integration.volumetric == "full" || !(ratio > whole_to);
      const Real q = whole_to / ratio;
      own.push_back(whole ? 1 : std::sqrt((1 + (whole_to - 1) * q * q) / ratio));
    }
    return own;
  }

  static Real largest_bulk_over_shear(const std::vector<L>& laws) {
    Real largest = 0;
    for (const L& law : laws) largest = std::max(largest, bulk_over_shear(law).value_or(0));
    return largest;
  }

  static Real least_bulk_modulus(const std::vector<L>& laws) {
    Real least = unbounded;
    for (const L& law : laws) least = std::min(least, meniscus::bulk_modulus(law));
    return least;
  }

  template <class Rule>
  [[gnu::cold]] typename Material<D>::Built integrated(Body<D>& body, Rule rule,
                                                       const std::vector<L>& laws,
                                                       const std::vector<Real>& shape_integral,
                                                       const Integration& integration) const {
    std::vector<Real> density, viscosity;
    Real least = unbounded, most = 0;
    const Portions shares = shares_of_nodes(body);
    for (Index A = 0; A < body.size(); ++A) {
      const L law =
          same_numbers()
              ? laws_.front().base
              : law_at(body.origin(A), shares.empty() ? Share{} : at(shares, A), body.geometry);
      density.push_back(law.density / body.volume_ratio(A));
      least = std::min(least, law.density);
      most = std::max(most, law.density);
      if constexpr (FluidLaw<L>) viscosity.push_back(law.viscosity);
    }
    body.uniform_density = least == most;
    const MassReport mass = lump_mass(body, density, shape_integral);
    std::optional<std::string> note;
    if constexpr (NotingLaw<L>) note = laws.front().note(mean_spacing(body.geometry.grid));
    std::optional<std::string> warning;
    if constexpr (DirectedLaw<L> && std::is_same_v<Rule, CellRule<D>>)
      if (!director_->uniform()) warning = doubt_of_turns(body, laws);
    return {force(body, std::move(rule), laws, integration),
            mass,
            averages(integration),
            std::move(note),
            std::move(warning),
            std::move(viscosity),
            least_bulk_modulus(laws),
            largest_bulk_over_shear(laws)};
  }

  /// A nodal cell has one law, with the director at its centre.
  static std::optional<std::string> doubt_of_turns(const Body<D>& body,
                                                   const std::vector<L>& laws) {
    std::vector<Eigen::Vector3d> directors;
    for (const L& law : laws) directors.push_back(Eigen::Vector3d::Map(law.director.data()));
    return doubt_of_director(largest_turn(body.geometry.grid, directors));
  }

  /// Makes the internal force. A group of stress points uses the law L itself, or a class that
  /// wraps L.
  template <class Rule>
  static std::unique_ptr<ForceTerm> force(const Body<D>& body, Rule rule,
                                          const std::vector<L>& laws,
                                          const Integration& integration) {
    if constexpr (FluidLaw<L>) {
      std::vector<FluidPoints<D, L>> points;
      for (const L& law : laws) points.emplace_back(law, averages(integration));
      auto surface = integration.enclosed ? std::make_unique<SurfacePatches<D>>(body) : nullptr;
      if (body.reference && !body.reference->undeformed()) {
        if constexpr (std::is_same_v<Rule, CellRule<D>>)
          return std::make_unique<InternalForce<D, ReferredFluid<D, L>, Rule>>(
              body, std::move(rule), referred(body, points), std::move(surface));
        throw InputError(
            fmt::format("body '{}': only integration = \"q_scni\" can be remapped", body.name));
      }
      return force_of(body, std::move(rule), std::move(points), std::move(surface));
    } else {
      if (body.reference && !body.reference->undeformed())
        throw InputError(fmt::format(
            "body '{}': a solid cannot be remapped, its stress depends on more than J", body.name));
      if constexpr (std::is_same_v<Rule, CellRule<D>>) {
        std::vector<Real> own = own_shares(laws, integration);
        if (std::any_of(own.begin(), own.end(), [](Real share) { return share < 1; }))
          return std::make_unique<AveragedForce<D, L>>(
              body, std::move(rule), laws,
              std::make_unique<AveragedVolumes<D>>(body, std::move(own)));
      }
      return force_of(body, std::move(rule), laws, nullptr);
    }
  }

  template <class Points, class Rule>
  static std::unique_ptr<ForceTerm> force_of(const Body<D>& body, Rule rule,
                                             std::vector<Points> points,
                                             std::unique_ptr<SurfacePatches<D>> surface) {
    if constexpr (Points::viscous)
      if (std::all_of(points.begin(), points.end(), [](const auto& law) { return law.inviscid(); }))
        return force_of(body, std::move(rule),
                        std::vector<WithoutViscosity<Points>>(points.begin(), points.end()),
                        std::move(surface));
    return std::make_unique<InternalForce<D, Points, Rule>>(body, std::move(rule),
                                                            std::move(points), std::move(surface));
  }

  std::vector<Varying<L>> laws_;  // [region]; one if the body has one material
  std::optional<ReferenceDirector> director_;
};

/// Reads the parameters of the law L from a scene. Problems are noted in the block.
template <int D, Law L>
std::unique_ptr<Material<D>> read_material(const Block& block) {
  Varying<L> law = read_varying<L>(block);
  if (const auto wrong = check(law.base); wrong && law.uniform()) block.problem("", *wrong);
  std::optional<ReferenceDirector> director;
  if constexpr (DirectedLaw<L>) director.emplace(block, D);
  return std::make_unique<MaterialOf<D, L>>(std::move(law), std::move(director));
}

}  // namespace meniscus
