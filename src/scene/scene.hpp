// SPDX-License-Identifier: BSD-3-Clause
// A scene: bodies, force terms, measures and an initial state, built from a plan.
#pragma once
#include "meniscus/physics/partner_registry.hpp"
#include "physics/contact/rigid/rigid_motion.hpp"
#include "physics/surface/surface_tension.hpp"
#include "remap/reseed.hpp"
#include "scene/plan.hpp"
#include "solve/system.hpp"

#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace meniscus {

/// The [[surface_tension]] of a body.
struct BodyTension {
  TensionForm form;
  Real gamma;
  std::function<Real(const Motion&)> area, volume;  ///< those of the forces

  /// The area is that of a polyhedron inside, and smaller than what encloses the volume.
  bool inscribed() const { return form == TensionForm::triangles; }
};

/// What a scene knows of a body beside the body itself: of its material, and what its loads say to
/// other loads, to checks and to measures.
struct SceneBody {
  const ForceTerm* internal_force;
  std::vector<Real> viscosity;       ///< [particle] shear viscosity of a fluid; empty: a solid
  Real bulk_modulus;                 ///< the least of the body, in the reference
  CarriedField* director = nullptr;  ///< of a nematic
  std::optional<Real> surface_energy = {};  ///< energy per area of the free surface
  std::optional<BodyTension> tension = {};
  std::string kept_reference = {};  ///< why the body cannot be referred anew; empty: it can

  bool is_fluid() const { return !viscosity.empty(); }
  bool is_drop() const { return is_fluid() && tension; }
  bool has_balanced_tension() const { return tension && tension->form == TensionForm::balanced; }
};

/// A field of one of the bodies. Of another body it is 0, if that has no field of the same name;
/// those of the same name on the same body add up.
struct BodyField {
  std::size_t body;  ///< its number
  FieldSource source;
};

/// Fields along a line of points of a body, for a file of their own.
struct ProbedLine {
  struct Column {
    std::string name;
    Dimension dimension;
  };
  std::string name;
  std::vector<Column> columns;
  std::function<std::vector<std::vector<Real>>(const Motion&)> compute;  ///< [point][column]
};

/// When a body is to be referred anew to where it is.
struct PlannedRemap {
  std::string body;
  std::vector<Real> times;
  bool even;       ///< nodes are placed evenly, not where the particles are
  Real condition;  ///< of F since the last time, beyond which it is due; 0: at the times alone
  std::function<Real(const Motion&)> now;  ///< that condition
};

/// Where a body touches a rigid partner.
template <int D>
struct Wetting {
  std::string body;
  ContactLine<D> line;
};

/// The bodies that a [[contact]] is between: two, or one beside a rigid partner.
struct ContactBetween {
  std::string name;
  std::vector<std::string> bodies;
  Real adhesion;  ///< energy per area
};

/// A rigid partner, as viewers draw it.
template <int D>
struct DrawnPartner {
  std::string contact;  ///< name of the contact
  std::shared_ptr<const PartnerShape<D>> shape;
  RigidMotion<D> motion;
};

/// What is wrong with a motion that cannot be; looked for at the start and at output times.
using StateCheck = std::function<std::optional<Failure>(const Motion&)>;

template <int D>
struct Scene : RunSettings {
  System<D> system;
  State initial;
  std::deque<SceneBody> bodies;  ///< [body of the system]
  std::vector<StateCheck> checks;
  /// Measures by full name, e.g. "drop.aspect".
  std::vector<MeasureSource> measures;
  std::vector<BodyField> fields;
  std::vector<ProbedLine> lines;
  std::vector<PlannedRemap> remaps;
  std::vector<Wetting<D>> wetting;
  std::vector<DrawnPartner<D>> partners;
  std::vector<std::string> notes;     ///< what was decided while building, for the log
  std::vector<std::string> warnings;  ///< doubtful choices
  std::vector<ContactBetween> contacts;
  StateCheck surfaces;  ///< of all bodies: takes up to half a step, and is looked at more seldom

  /// The bodies of fluid under surface tension, by number.
  std::vector<std::size_t> drops() const {
    std::vector<std::size_t> found;
    for (std::size_t b = 0; b < bodies.size(); ++b)
      if (bodies[b].is_drop()) found.push_back(b);
    return found;
  }
  /// How a sum over bodies is written.
  std::string symbol_of_sum(Dimension d) const { return units.symbol(of_sum(d, D)); }
};

/// A field of any body by its name. Throws std::logic_error if no body has it.
template <int D>
const FieldSource& field_named(const Scene<D>& scene, const std::string& name);

/// The field of that name at the particles of all bodies, [particle][component].
template <int D>
std::vector<Real> field_values(const Scene<D>& scene, const std::string& name,
                               const Motion& motion);

/// Throws InputError if something in the scene depends on the reference of that body.
template <int D>
void require_remappable(const Scene<D>& scene, const std::string& body);

/// Throws InputError for what shows only here (a formula that leaves its range, surfaces that start
/// too close), SolveError if shape functions cannot be built. Bodies with a reference are built on
/// that, and their initial state means nothing.
template <int D>
Scene<D> build(const Plan<D>& plan, const References<D>& references = {});

/// Reads the whole scene, then builds it.
template <int D>
Scene<D> build_scene(const SceneInput& input);

}  // namespace meniscus
