// SPDX-License-Identifier: BSD-3-Clause
// Wetting as in the dissertation: surface triangles that touch a wall switch their tension, and a
// Lennard-Jones wall pulls along its normal. For replication only (wetting note 5).
#include "body/surface/boundary_simplices.hpp"
#include "input/optional_rows.hpp"
#include "kernel/row_sums.hpp"
#include "meniscus/error.hpp"
#include "meniscus/physics/interaction_registry.hpp"
#include "numbers/dense.hpp"
#include "physics/contact/contact_numbers.hpp"
#include "physics/surface/surface_tension.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace meniscus {
namespace {

/// Tensions that switch. A triangle (2D: segment) between boundary particles is wet if all its
/// corners are nearer to the wall than the switch gap. With gamma_L = gamma (1 - cos theta)/2 and
/// gamma_G = gamma (1 + cos theta)/2, a wet triangle has the tension gamma_L instead of gamma (case
/// d). An edge between a wet and a dry triangle is pulled along the wall, away from the wet side,
/// by gamma_G (case c). Together they are the gradient, with the wet triangles kept fixed, of
///   E = sum over wet triangles of (gamma_L - gamma) A - gamma_G A',
/// with the area A' along the wall. E jumps when a triangle switches.
template <int D>
class LegacySwitch final : public ForceTerm {
 public:
  struct Tensions {
    Real change, line;  // gamma_L - gamma, gamma_G
  };

  LegacySwitch(const Body<D>& body, const PartnerPlan<D>& plan, Tensions tensions, Real gap,
               std::unique_ptr<ForceTerm> traction)
      : body_(body),
        plan_(plan),
        tensions_(tensions),
        gap_(gap),
        traction_(std::move(traction)),
        boundary_(body) {
    load_.resize(boundary_.X.size());
    x_.resize(boundary_.X.size());
    committed_.assign(boundary_.corners.size(), unknown);
  }

  std::string name() const override { return traction_->name(); }
  std::string_view energy_kind() const override { return traction_->energy_kind(); }

  Report add_force(const Motion& motion, Forces force) override {
    Report report = traction_->add_force(motion, force);
    find_places(motion, x_);
    std::fill(load_.begin(), load_.end(), Lanes::zero());
    for (const auto& simplex : boundary_.corners) {
      if (!wet(simplex, x_, motion.time)) continue;
      const auto pull = pull_of(corners(simplex, x_));
      for (std::size_t k = 0; k < D; ++k)
        for (int i = 0; i < D; ++i)
          at(load_, simplex[k]).set(i, at(load_, simplex[k])[i] + pull.force[k][i]);
    }
    boundary_.scatter(load_, body_.part(force));
    return report;
  }

  /// Counts the triangles that became wet or dry in this step, and adds the stored energy that
  /// disappears with these switches. This energy becomes neither heat nor work.
  void commit(const Motion& motion) override {
    traction_->commit(motion);
    find_places(motion, x_);
    for (std::size_t s = 0; s < boundary_.corners.size(); ++s) {
      const Real now = wet(boundary_.corners[s], x_, motion.time) ? 1 : 0;
      if (committed_[s] != unknown && committed_[s] != now) {
        ++switches_;
        lost_ += (committed_[s] - now) * pull_of(corners(boundary_.corners[s], x_)).energy;
      }
      committed_[s] = now;
    }
  }
  void archive(const Archive& a) override {
    traction_->archive(a);
    a("wet", committed_);
    a("switches", switches_);
    a("lost", lost_, of_sum(dimension::energy, D));
  }

  std::optional<Real> stored_energy(const Motion& motion) const override {
    std::vector<Vec<D>> x(boundary_.X.size());
    find_places(motion, x);
    Real energy = *traction_->stored_energy(motion);
    for (const auto& simplex : boundary_.corners)
      if (wet(simplex, x, motion.time)) energy += pull_of(corners(simplex, x)).energy;
    return energy;
  }
  Real steady_after() const override { return traction_->steady_after(); }
  bool viscous() const override { return traction_->viscous(); }
  bool may_reject_steps() const override { return true; }
  bool stops_drift() const override { return true; }
  std::optional<std::string> warning(const Motion&) const override {
    if (switches_ == 0) return std::nullopt;
    return fmt::format(
        "{}: triangles have switched {} times so far, by which {:.4g} of the energy was lost "
        "(measures switches and switch_loss)",
        name(), switches_, lost_);
  }

  std::vector<MeasureSource> measures() const override {
    std::vector<MeasureSource> all = traction_->measures();
    all.push_back({"switches", dimension::none, "how often triangles became wet or dry",
                   [this](const Motion&) { return static_cast<Real>(switches_); }});
    all.push_back({"switch_loss", dimension::energy, "energy lost by that",
                   [this](const Motion&) { return lost_; }});
    all.push_back({"wet_triangles", dimension::none, "number (2D: of segments)",
                   [this](const Motion& motion) {
                     std::vector<Vec<D>> x(boundary_.X.size());
                     find_places(motion, x);
                     return static_cast<Real>(
                         std::count_if(boundary_.corners.begin(), boundary_.corners.end(),
                                       [&](const auto& s) { return wet(s, x, motion.time); }));
                   }});
    return all;
  }

  std::size_t bytes() const override {
    return traction_->bytes() + boundary_.bytes() +
           boundary_.X.size() * (sizeof(Vec<D>) + sizeof(Lanes)) + committed_.size() * sizeof(Real);
  }
  Offset pairs() const override { return traction_->pairs() + boundary_.rows.entries(); }

 private:
  using Corners = std::array<Vec<D>, D>;
  struct Pull {
    Real energy;
    Corners force;
  };

  void find_places(const Motion& motion, std::vector<Vec<D>>& x) const {
    boundary_.find_places(motion.u.data() + body_.first, x);
  }
  static Corners corners(const std::array<Index, D>& simplex, const std::vector<Vec<D>>& x) {
    return BoundarySimplices<D>::places_of(simplex, x);
  }
  bool wet(const std::array<Index, D>& simplex, const std::vector<Vec<D>>& x, Real time) const {
    const Vec<D> shift = plan_.motion.displacement(time);
    return std::all_of(simplex.begin(), simplex.end(), [&](Index B) {
      return plan_.shape->foot(at(x, B) - shift).distance < gap_;
    });
  }
  /// Energy and forces of a wet triangle.
  Pull pull_of(const Corners& x) const {
    const FlatPull<D> own = flat_pull<D>(x);
    const Vec<D> n = plan_.shape->foot(x[0]).normal;  // the normal of a plane is uniform
    Pull pull{tensions_.change * own.area, own.force};
    for (auto& force : pull.force) force *= tensions_.change;
    // A' = - n . area vector, and its gradient.
    if constexpr (D == 3) {
      pull.energy += tensions_.line * 0.5 * n.dot(cross(x[1] - x[0], x[2] - x[0]));
      for (std::size_t k = 0; k < 3; ++k)
        pull.force[k] += tensions_.line * 0.5 * cross(x[(k + 2) % 3] - x[(k + 1) % 3], n);
    } else {
      const Vec<2> edge = x[1] - x[0], along(-n[1], n[0]);
      pull.energy += tensions_.line * along.dot(edge);
      pull.force[0] += tensions_.line * along;
      pull.force[1] -= tensions_.line * along;
    }
    return pull;
  }

  static constexpr Real unknown = -1;
  const Body<D>& body_;
  PartnerPlan<D> plan_;
  Tensions tensions_;
  Real gap_;
  std::unique_ptr<ForceTerm> traction_;
  BoundarySimplices<D> boundary_;
  std::vector<Real> committed_;  // [simplex] 1: wet, 0: dry, at the last accepted step
  std::int64_t switches_ = 0;
  Real lost_ = 0;
  // Work space of a force.
  std::vector<Vec<D>> x_;
  NodalVectors load_;
};

struct Keys {
  Real angle = 0, adhesion = 0, sigma0 = 0;
  std::optional<Real> gap;

  static Rows<Keys> rows() {
    return {real_row("contact_angle", &Keys::angle, dimension::degrees, {1, 179},
                     "in degrees, of the tensions of wet triangles and of their edge"),
            real_row("adhesion", &Keys::adhesion, dimension::tension, range::positive,
                     "energy per area of the Lennard-Jones wall that pulls along its normal; it "
                     "has no part in the angle"),
            real_row("sigma0", &Keys::sigma0, dimension::length, range::positive,
                     "of that Lennard-Jones wall: distance of the minimum of phi"),
            optional_row("switch_gap", &Keys::gap, dimension::length, range::positive,
                         "1.5 equilibrium gaps",
                         "below which a particle of the surface is in contact")};
  }
};

/// The Lennard-Jones wall below the switched tensions.
class SwitchedWall final : public LennardJones {
 public:
  SwitchedWall(const ContactLaw& law, Real switch_gap, Real degrees)
      : LennardJones(law, 1), switch_gap_(switch_gap), degrees_(degrees) {}
  std::string described(const UnitSystem& units) const override {
    return fmt::format("wet below the gap {:.4g} {} at {:.4g} degrees by switched tensions",
                       switch_gap_, units.symbol(dimension::length), degrees_);
  }
  std::optional<std::string> doubt(Real) const override {
    return "legacy_switch loses energy whenever a triangle becomes wet or dry, and its traction is "
           "not the gradient of an energy: it is for comparison with the dissertation";
  }

 private:
  Real switch_gap_, degrees_;
};

template <int D>
class Model final : public ContactModel<D> {
 public:
  explicit Model(Keys keys) : k_(std::move(keys)) {
    law_.kernel = D == 3 ? PairKernel::space : PairKernel::integrated;
    law_.sigma0 = k_.sigma0;
    law_.cutoff = std::numeric_limits<Real>::infinity();
    law_.epsilon = 1;
    law_.epsilon = k_.adhesion / plane_contact(law_, 1).adhesion;
  }

  std::string usual_form() const override { return "dissertation"; }
  void check(const Block& block, bool rigid) const override {
    if (!rigid)
      block.problem("interaction",
                    "legacy_switch is for a body and a half space; allowed between two bodies are "
                    "the others");
    if (block.text("form", usual_form()) != usual_form())
      block.problem("form",
                    "with legacy_switch the angle comes from the tensions, and forces that are the "
                    "gradient of an energy would add theirs; allowed is dissertation");
  }
  std::unique_ptr<ForceTerm> between(const Body<D>&, const Body<D>&, const ContactChoice&,
                                     const ContactSurfaces& surfaces) const override {
    throw InputError(surfaces.place + ": legacy_switch is for a body and a half space");
  }
  std::unique_ptr<ForceTerm> with_partner(const Body<D>& body, const PartnerPlan<D>& plan,
                                          const ContactChoice& choice,
                                          const ContactSurfaces& surfaces) const override {
    if (!plan.shape->flat())
      throw InputError(surfaces.place +
                       ": legacy_switch is for planes; allowed partners are half_space");
    if (plan.motion.press())
      throw InputError(surfaces.place +
                       ": legacy_switch has forces of its own, which do not act on a partner; it "
                       "goes without a direction of the partner");
    if (surfaces.tension_form != TensionForm::triangles)
      throw InputError(fmt::format(
          "{}: legacy_switch changes the tension of flat triangles, and '{}' has none{}; allowed "
          "is a [[surface_tension]] of it with form = \"triangles\"",
          surfaces.place, body.name,
          surfaces.tension_form ? fmt::format(" (its form is {})", name_of(*surfaces.tension_form))
                                : ""));
    MovingPartner<D> partner{plan.shape->lennard_jones(law_, 1), plan.motion, 1, plan.velocity_step,
                             plan.shape};
    const Real gamma = surfaces.tension(), line = adhesion_of_angle(k_.angle, gamma) / 2;
    return std::make_unique<LegacySwitch<D>>(
        body, plan, typename LegacySwitch<D>::Tensions{-line, line}, switch_gap(),
        rigid_contact<D>({body, 1}, std::move(partner), law_, choice));
  }
  std::shared_ptr<const Interaction> law(const ContactSurfaces&) const override {
    return std::make_shared<SwitchedWall>(law_, switch_gap(), k_.angle);
  }

 private:
  Real switch_gap() const { return k_.gap.value_or(1.5 * plane_contact(law_, 1).equilibrium_gap); }

  Keys k_;
  ContactLaw law_;
};

template <int D>
bool enter() {
  return register_entry(InteractionEntry<D>{
      "legacy_switch", "wetting of the dissertation: tensions that switch, for replication only",
      "contact_angle = 90\nadhesion = 1\nsigma0 = 0.3\n", [] { return key_texts(Keys::rows()); },
      [](const Block& block) -> std::unique_ptr<ContactModel<D>> {
        return std::make_unique<Model<D>>(read<Keys>(block));
      }});
}

const bool registered = enter<2>() && enter<3>();

}  // namespace
}  // namespace meniscus
