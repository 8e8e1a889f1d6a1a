// SPDX-License-Identifier: BSD-3-Clause
// Assembly: a scene while it is being built. Loads add their force terms, fields and measures to
// it.
#pragma once
#include "physics/loads/traction.hpp"
#include "scene/scene.hpp"

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>

namespace meniscus {

template <int D>
class Assembly {
 public:
  /// `scene` has its bodies and its initial state. `begins` is false if the scene is built again
  /// and continues from another state.
  Assembly(Scene<D>& scene, bool begins) : scene_(scene), begins_(begins) {}

  /// The body with this name. Throws InputError if there is none.
  const Body<D>& body(const std::string& name) const;
  /// Facts about this body that loads set and read. The reference stays valid.
  SceneBody& of(const std::string& body) { return scene_.bodies[number_of(body)]; }
  const SceneBody& of(const std::string& body) const { return scene_.bodies[number_of(body)]; }

  /// Adds a force term. Its measures get names `prefix`.NAME. Its fields belong to the body called
  /// `prefix`.
  void add(std::unique_ptr<ForceTerm> term, const std::string& prefix);
  /// Adds prescribed displacements.
  void add(std::unique_ptr<Constraint> constraint) {
    constraints_.push_back(std::move(constraint));
  }
  /// Says, or asks, in which directions face cells of a body stay at their reference places.
  void set_held(const std::string& body, Index node, const Eigen::Vector3d& direction) {
    held_[body][node].push_back(direction);
  }
  HeldDirections held(const std::string& body) const {
    const auto found = held_.find(body);
    return found == held_.end() ? HeldDirections() : found->second;
  }
  /// Returns all constraints that were added, for System::hold.
  std::vector<std::unique_ptr<Constraint>> take_constraints() { return std::move(constraints_); }
  /// Adds a field of a body. Fields of a body with the same name are summed.
  void field(const std::string& body, FieldSource source);
  /// Adds a measure called `prefix`.NAME. Throws std::logic_error if the name exists.
  void measure(const std::string& prefix, MeasureSource source);
  /// Like measure(), and the history always contains this measure.
  void record(const std::string& prefix, MeasureSource source);
  bool has_measure(const std::string& name) const;
  /// Adds a measure that treats a body as a spherical cap on one wall, and the one of this name
  /// for a body with more than one contact. `place` is the place of the contact in the scene.
  void measure_of_cap(const std::string& body, const std::string& prefix, MeasureSource source,
                      const std::string& place, std::optional<MeasureSource> otherwise = {});
  /// Replaces the cap measures of bodies with more than one contact or wall, since the free surface
  /// between two walls is no part of a sphere, or removes them. Call this when all contacts are
  /// built. Throws InputError if an output or expectation of the scene uses a removed measure.
  void withhold_caps();
  /// Adds a line of points, whose values are written to a file of its own.
  void line(ProbedLine line) { scene_.lines.push_back(std::move(line)); }
  /// The fields that were added for this body so far.
  std::vector<FieldSource> fields_of(const std::string& body) const;
  /// The function of the measure with this full name, which must have been added.
  std::function<Real(const Motion&)> measure_named(const std::string& name) const;
  /// Registers the times or the condition at which a body is remapped.
  void remap(PlannedRemap planned) { scene_.remaps.push_back(std::move(planned)); }
  /// The distances from the walls that a body touches. Contacts and wetted faces add theirs; the
  /// list is complete when all loads are built.
  using Walls = std::vector<std::function<Real(const Vec<D>& x, Real time)>>;
  std::shared_ptr<Walls> walls_of(const std::string& body) {
    std::shared_ptr<Walls>& walls = walls_[body];
    if (!walls) walls = std::make_shared<Walls>();
    return walls;
  }
  /// Registers the contact line of a body on a rigid partner.
  void wets(Wetting<D> wetting) { scene_.wetting.push_back(std::move(wetting)); }
  /// Registers a rigid partner for output.
  void draw(DrawnPartner<D> partner) { scene_.partners.push_back(std::move(partner)); }
  /// Registers why a body cannot be remapped: a law depends on its reference by more than J.
  void keep_reference(const std::string& body, std::string why) {
    of(body).kept_reference = std::move(why);
  }
  /// Registers the bodies of a contact.
  void contact(ContactBetween contact) { scene_.contacts.push_back(std::move(contact)); }
  /// Registers a check for impossible states.
  void check(StateCheck check) { scene_.checks.push_back(std::move(check)); }
  /// Mean stiffness of a body against a small simple shear (x over y) at its reference state; 0 for
  /// a fluid.
  Real shear_modulus(const std::string& body) const;
  /// The acceleration of the whole body at the start, by the loads that were added so far.
  Vec<D> acceleration(const std::string& body) const;
  /// The weight of a body at a time, by its body forces that are uniform.
  std::function<Vec<D>(Real time)> weight(const std::string& body) const;
  /// Sentences for the log: decisions, and doubtful choices.
  void note(std::string sentence) { scene_.notes.push_back(std::move(sentence)); }
  void warn(std::string sentence) { scene_.warnings.push_back(std::move(sentence)); }

  /// Registers a length of physics that follows the size of the cells, by the key that would set
  /// it.
  void length_by_cells(std::string key, Real value) {
    scene_.lengths_by_cells.emplace_back(std::move(key), value);
  }

  const UnitSystem& units() const { return scene_.units; }
  Real end_time() const { return scene_.time.end; }
  /// True if bodies have inertia, false if the solver looks for equilibria.
  bool is_dynamic() const { return scene_.time.solver == "dynamics"; }
  /// True if the solver goes to rest by a motion whose time has no meaning.
  bool is_relaxing() const { return scene_.time.solver == "relax"; }
  /// The initial state; null if the run continues from a checkpoint or a remap.
  const State* initial() const { return begins_ ? &scene_.initial : nullptr; }
  /// Describes a failure of the initial state with the body and position of its particle.
  StepFailure located(const Failure& failure) const {
    return scene_.system.located(failure, scene_.initial.motion());
  }

 private:
  std::size_t number_of(const std::string& body) const;
  Real find_shear_modulus(const std::string& body) const;

  Scene<D>& scene_;
  bool begins_;
  std::vector<std::unique_ptr<Constraint>> constraints_;
  std::map<std::string, HeldDirections> held_;  // by body
  mutable std::map<std::string, Real> shear_modulus_;
  mutable NodalVectors rest_, sheared_;
  struct CapMeasure {
    std::string name, place;
    std::optional<MeasureSource> otherwise;
  };
  std::map<std::string, std::vector<CapMeasure>> caps_;  // by body
  std::map<std::string, std::shared_ptr<Walls>> walls_;  // by body
};

}  // namespace meniscus
