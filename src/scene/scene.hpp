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
#include <utility>
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

/// Facts about a body that loads, checks and measures need: properties of its material, and results
/// of loads that other loads use.
struct SceneBody {
  const ForceTerm* internal_force;
  std::vector<Real> viscosity;       ///< [particle] shear viscosity of a fluid; empty: a solid
  Real bulk_modulus;                 ///< the least of the body, in the reference
  CarriedField* director = nullptr;  ///< of a nematic
  std::optional<Real> surface_energy = {};  ///< energy per area of the free surface
  std::optional<BodyTension> tension = {};  ///< of the whole surface
  bool has_face_tension = false;            ///< of faces only
  /// Accelerations by body forces on the volume inside its patches, components by formulas of time.
  std::vector<std::vector<Expression>> accelerations = {};
  bool other_body_forces = false;
  std::string kept_reference = {};  ///< why the body cannot be remapped; empty: it can

  bool is_fluid() const { return !viscosity.empty(); }
  bool is_drop() const { return is_fluid() && tension; }
  bool has_balanced_tension() const { return tension && tension->form == TensionForm::balanced; }
};

/// A field of one body. The output shows 0 on other bodies without a field of this name. Fields of
/// one body with the same name are added.
struct BodyField {
  std::size_t body;  ///< its number
  FieldSource source;
};

/// Fields along a line of points of a body, which are written to a file of their own.
struct ProbedLine {
  struct Column {
    std::string name;
    Dimension dimension;
  };
  std::string name;
  std::vector<Column> columns;
  std::function<std::vector<std::vector<Real>>(const Motion&)> compute;  ///< [point][column]
};

/// Times and condition at which a body is remapped.
struct PlannedRemap {
  std::string body;
  std::vector<Real> times;
  bool even;       ///< true: nodes are spaced evenly; false: nodes are at the particles
  Real condition;  ///< condition of F since the last remap that triggers one; 0: none
  std::function<Real(const Motion&)> now;  ///< the present condition of F
};

/// A body that touches a rigid partner, and the contact line.
template <int D>
struct Wetting {
  std::string body;
  ContactLine<D> line;
};

/// The bodies of a [[contact]]: two, or one if the other side is a rigid partner.
struct ContactBetween {
  std::string name;
  std::vector<std::string> bodies;
  Real adhesion;  ///< energy per area
};

/// A rigid partner for output.
template <int D>
struct DrawnPartner {
  std::string contact;  ///< name of the contact
  std::shared_ptr<const PartnerShape<D>> shape;
  RigidMotion<D> motion;
};

/// Returns the failure of an impossible motion. Called at the start and at output times.
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
  /// Lengths of physics that the input leaves to the size of the cells: the keys that would set
  /// them, such as "contact[0].range", and their values.
  std::vector<std::pair<std::string, Real>> lengths_by_cells;
  std::vector<std::string> notes;     ///< decisions while building, for the log
  std::vector<std::string> warnings;  ///< doubtful choices
  std::vector<ContactBetween> contacts;
  StateCheck
      surfaces;  ///< check of all surfaces; it may take half a step, so it is called less often

  /// Numbers of the fluid bodies with surface tension.
  std::vector<std::size_t> drops() const {
    std::vector<std::size_t> found;
    for (std::size_t b = 0; b < bodies.size(); ++b)
      if (bodies[b].is_drop()) found.push_back(b);
    return found;
  }
  /// Unit symbol of a sum over bodies (2D: per depth).
  std::string symbol_of_sum(Dimension d) const { return units.symbol(of_sum(d, D)); }
};

/// A field of any body, by name. Throws std::logic_error if no body has it.
template <int D>
const FieldSource& field_named(const Scene<D>& scene, const std::string& name);

/// The values of a field at the particles of all bodies, [particle][component].
template <int D>
std::vector<Real> field_values(const Scene<D>& scene, const std::string& name,
                               const Motion& motion);

/// Throws InputError if a part of the scene depends on the reference of this body.
template <int D>
void require_remappable(const Scene<D>& scene, const std::string& body);

/// Builds a scene. Bodies in `references` are built on these references, and their initial state is
/// meaningless. Throws InputError for problems that only the built scene shows (a formula that
/// leaves its range, surfaces that start too close). Throws SolveError if shape functions cannot be
/// built.
template <int D>
Scene<D> build(const Plan<D>& plan, const References<D>& references = {});

/// Reads the whole scene, then builds it.
template <int D>
Scene<D> build_scene(const SceneInput& input);

}  // namespace meniscus
