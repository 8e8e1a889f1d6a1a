// SPDX-License-Identifier: BSD-3-Clause
// Assembly: the scene while it is built, to which loads add what they are made of.
#pragma once
#include "scene/scene.hpp"

#include <map>
#include <memory>
#include <optional>
#include <string>

namespace meniscus {

template <int D>
class Assembly {
 public:
  /// `scene` has its bodies and its initial state; a scene that is built again goes on at another.
  Assembly(Scene<D>& scene, bool begins) : scene_(scene), begins_(begins) {}

  /// Throws InputError if there is none of that name.
  const Body<D>& body(const std::string& name) const;
  /// What loads say and ask of that body; it stays where it is.
  SceneBody& of(const std::string& body) { return scene_.bodies[number_of(body)]; }
  const SceneBody& of(const std::string& body) const { return scene_.bodies[number_of(body)]; }

  /// Adds a term; its measures are called `prefix`.NAME. Its fields, if it has any, are of the body
  /// of that name.
  void add(std::unique_ptr<ForceTerm> term, const std::string& prefix);
  /// Prescribes displacements.
  void add(std::unique_ptr<Constraint> constraint) {
    constraints_.push_back(std::move(constraint));
  }
  /// All that were added, for System::hold.
  std::vector<std::unique_ptr<Constraint>> take_constraints() { return std::move(constraints_); }
  /// Adds a field of a body; fields of one name are summed.
  void field(const std::string& body, FieldSource source);
  /// Adds a measure called `prefix`.NAME. Throws std::logic_error if there is one.
  void measure(const std::string& prefix, MeasureSource source);
  /// The same, and it is in the history whether the scene asks for it or not.
  void record(const std::string& prefix, MeasureSource source);
  bool has_measure(const std::string& name) const;
  /// Adds a measure that takes a body for the cap of a sphere on one wall; `place`: of the contact
  /// in the scene.
  void measure_of_cap(const std::string& body, const std::string& prefix, MeasureSource source,
                      const std::string& place);
  /// Takes back the measures of caps whose bodies have more than one contact, once all contacts are
  /// built: the free surface between two walls is no part of a sphere. Throws InputError if the
  /// scene asks for one of them.
  void withhold_caps();
  /// Adds a line of points, for a file of its own.
  void line(ProbedLine line) { scene_.lines.push_back(std::move(line)); }
  /// What was added of that body so far.
  std::vector<FieldSource> fields_of(const std::string& body) const;
  /// The measure of that full name; it has been added.
  std::function<Real(const Motion&)> measure_named(const std::string& name) const;
  /// Says when a body is to be referred anew.
  void remap(PlannedRemap planned) { scene_.remaps.push_back(std::move(planned)); }
  /// Says where a body touches a rigid partner.
  void wets(Wetting<D> wetting) { scene_.wetting.push_back(std::move(wetting)); }
  /// Has a rigid partner drawn.
  void draw(DrawnPartner<D> partner) { scene_.partners.push_back(std::move(partner)); }
  /// Says why a body cannot be referred anew: something depends on its reference by more than J.
  void keep_reference(const std::string& body, std::string why) {
    of(body).kept_reference = std::move(why);
  }
  /// Says which bodies a contact is between.
  void contact(ContactBetween contact) { scene_.contacts.push_back(std::move(contact)); }
  /// Watches for what cannot be.
  void check(StateCheck check) { scene_.checks.push_back(std::move(check)); }
  /// Stiffness of a body against a small simple shear, x over y, at its reference state, in the
  /// mean over it; 0 of a fluid.
  Real shear_modulus(const std::string& body) const;
  /// The acceleration of a body as a whole by the loads that were added so far, at the start.
  Vec<D> acceleration(const std::string& body) const;
  /// For the log: what was decided, and what is doubtful.
  void note(std::string sentence) { scene_.notes.push_back(std::move(sentence)); }
  void warn(std::string sentence) { scene_.warnings.push_back(std::move(sentence)); }

  const UnitSystem& units() const { return scene_.units; }
  Real end_time() const { return scene_.time.end; }
  /// Bodies have inertia: the solver is not one that looks for equilibria.
  bool is_dynamic() const { return scene_.time.solver == "dynamics"; }
  /// Null if the scene does not begin there.
  const State* initial() const { return begins_ ? &scene_.initial : nullptr; }
  /// A failure of the initial state, with body and place of its particle.
  StepFailure located(const Failure& failure) const {
    return scene_.system.located(failure, scene_.initial.motion());
  }

 private:
  std::size_t number_of(const std::string& body) const;
  Real find_shear_modulus(const std::string& body) const;

  Scene<D>& scene_;
  bool begins_;
  std::vector<std::unique_ptr<Constraint>> constraints_;
  mutable std::map<std::string, Real> shear_modulus_;
  mutable NodalVectors rest_, sheared_;
  struct CapMeasure {
    std::string name, place;
  };
  std::map<std::string, std::vector<CapMeasure>> caps_;  // by body
};

}  // namespace meniscus
