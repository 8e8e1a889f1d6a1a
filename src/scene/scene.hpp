// SPDX-License-Identifier: BSD-3-Clause
// A scene: bodies, force terms, measures and an initial state, built from a plan.
#pragma once
#include "meniscus/physics/partner_registry.hpp"
#include "physics/contact/rigid/rigid_motion.hpp"
#include "remap/reseed.hpp"
#include "scene/plan.hpp"
#include "solve/system.hpp"

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace meniscus {

/// A body of fluid under surface tension.
template <int D>
struct Drop {
  const Body<D>* body;
  Real gamma;
  std::function<Real(const Motion&)> area, volume;  ///< those of the forces
  bool inscribed;  ///< the area is of a polyhedron inside: smaller than what encloses the volume
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
  std::vector<std::vector<Real>> viscosity;        ///< [body][particle]; empty: a solid
  std::vector<Real> bulk_modulus;                  ///< [body], the least of each
  std::vector<const ForceTerm*> internal_forces;   ///< [body]
  std::map<std::string, CarriedField*> directors;  ///< [body], of nematics
  std::vector<Drop<D>> drops;
  std::vector<StateCheck> checks;
  /// Measures by full name, e.g. "drop.aspect".
  std::vector<MeasureSource> measures;
  std::vector<BodyField> fields;
  std::vector<ProbedLine> lines;
  std::vector<PlannedRemap> remaps;
  std::vector<Wetting<D>> wetting;
  std::vector<DrawnPartner<D>> partners;
  std::map<std::string, std::string> kept_references;  ///< [body] why it cannot be referred anew
  std::vector<std::string> notes;     ///< what was decided while building, for the log
  std::vector<std::string> warnings;  ///< doubtful choices
  std::vector<ContactBetween> contacts;
  StateCheck surfaces;  ///< of all bodies: takes up to half a step, and is looked at more seldom

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
