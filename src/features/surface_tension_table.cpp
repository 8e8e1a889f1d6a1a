// SPDX-License-Identifier: BSD-3-Clause
// Tension of the whole surface of a body, or of one of its faces.
#include "measure/drop_measures.hpp"
#include "meniscus/scene/assembly.hpp"
#include "physics/internal/coefficient_damping.hpp"
#include "physics/surface/surface_tension.hpp"
#include "scene/face_keys.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace meniscus::surface_tension_table {
namespace {

struct Keys {
  std::string body, face, form;
  Real gamma = 0;
  int points = 3;
  Real coefficient_damping = 0;  // unit: kinematic viscosity / spacing^2
  static Rows<Keys> rows();
};

Rows<Keys> Keys::rows() {
  return {
      text_row("body", &Keys::body, "name of the body whose surface is under tension"),
      text_row(
          "face", &Keys::face,
          "name of a face of its shape, as `meniscus check` lists them; empty: the whole surface",
          ""),
      real_row("gamma", &Keys::gamma, dimension::tension, range::positive, "surface tension"),
      choice_row(
          "form", &Keys::form, {tension_form_names.begin(), tension_form_names.end()},
          "gradient of the area of patches through places, with the volume that they enclose for "
          "the pressure of a fluid; gradient of the area at Gauss points; curvature from second "
          "derivatives (smooth surfaces only); flat triangles",
          "balanced"),
      integer_row("points", &Keys::points, {1, 8},
                  "Gauss points per direction and surface facet, for weak and curvature", 3),
      real_row("coefficient_damping", &Keys::coefficient_damping, dimension::none,
               range::non_negative,
               "balanced: damping of combinations of velocity coefficients of a fluid that leave "
               "every material point at rest, in units of kinematic viscosity / spacing^2; 0: "
               "none. Of several tables of a body the first counts",
               0.5),
  };
}

template <int D>
struct SurfaceTension final : Load<D>, Keys {
  static constexpr std::string_view example = "body = \"drop\"\ngamma = 1\n";
  std::optional<typename Load<D>::Identity> identity() const override {
    return {{face.empty() ? "body" : "face", label()}};
  }
  std::string claim() const override {
    return (face.empty() ? "the surface of '" : "the face '" + face + "' of '") + body + "'";
  }
  std::string label() const { return face.empty() ? body : body + "-" + face; }

  void check(const Block& block, const BodyPlans<D>& bodies) const override {
    const BodyPlan<D>* planned = require_body(block, bodies, body);
    if (planned && !face.empty()) FaceKeys{body, face, std::nullopt}.check(block, bodies);
    if (!face.empty() && form != "balanced")
      block.problem("form", fmt::format("is {}, with a face; allowed is balanced", form));
    if (planned && planned->geometry.grid.revolved && form == "triangles")
      block.problem(
          "form", "is triangles, for a body of revolution; allowed are balanced, weak, curvature");
    if (planned && form == "curvature" && !planned->geometry.surface->smooth())
      block.problem("form", fmt::format("the surface of '{}' has edges, where the curvature is "
                                        "undefined; allowed are balanced, weak, triangles",
                                        body));
  }

  /// A balanced surface needs the volume that it encloses: the pressure of a fluid does work on
  /// this volume.
  void prepare(BodyPlans<D>& bodies) const override {
    for (BodyPlan<D>& planned : bodies) {
      if (planned.settings.name != body) continue;
      planned.enclosed |= form == "balanced";
      planned.curvature |= form == "curvature";
    }
  }

  void build(Assembly<D>& assembly) const override {
    const Body<D>& on = assembly.body(body);
    const std::vector<Real>& viscosity = assembly.of(body).viscosity;
    require_one_tension(assembly.of(body));
    assembly.add(term(on), label());
    if (!face.empty()) {
      if (!assembly.of(body).has_face_tension) add_damping(assembly);
      assembly.of(body).has_face_tension = true;
      return;
    }
    for (MeasureSource& source : drop_measures(on, viscosity, gamma))
      assembly.measure(body, std::move(source));
    assembly.of(body).surface_energy = gamma;
    assembly.of(body).tension = BodyTension{kind(), gamma, assembly.measure_named(body + ".area"),
                                            assembly.measure_named(body + ".volume")};
    if (form == "balanced") add_damping(assembly);
    require_stiffness(assembly);
  }

 private:
  void add_damping(Assembly<D>& assembly) const {
    const std::vector<Real>& viscosity = assembly.of(body).viscosity;
    if (this->coefficient_damping > 0 &&
        std::any_of(viscosity.begin(), viscosity.end(), [](Real mu) { return mu > 0; }))
      assembly.add(
          meniscus::coefficient_damping(assembly.body(body), viscosity, this->coefficient_damping),
          body);
  }
  /// Throws InputError if the body is too soft. Surface tension alone compresses a body with the
  /// mean pressure (d - 1) gamma area / (d volume) in d dimensions (virial theorem); a body much
  /// softer than this collapses.
  void require_stiffness(const Assembly<D>& assembly) const {
    constexpr Real most = 2;
    if (!assembly.initial()) return;
    const Motion motion = assembly.initial()->motion();
    const BodyTension& tension = *assembly.of(body).tension;
    const int space = assembly.body(body).space();
    const Real area = tension.area(motion), volume = tension.volume(motion),
               pressure = (space - 1) * gamma * area / (space * volume),
               K = assembly.of(body).bulk_modulus;
    const auto text = [&](Real value, Dimension d) {
      return fmt::format("{:.4g} {}", value, assembly.units().symbol(d));
    };
    if (pressure > most * K)
      throw InputError(fmt::format(
          "{}: gamma compresses '{}' by a pressure of {}, which is more than twice its bulk "
          "modulus of {}; "
          "expected is gamma below {}, or a stiffer body",
          this->place, body, text(pressure, dimension::pressure), text(K, dimension::pressure),
          text(gamma * most * K / pressure, dimension::tension)));
  }

  /// Tables of faces and of the whole surface would act twice on a face.
  void require_one_tension(const SceneBody& of_body) const {
    if (face.empty() ? of_body.has_face_tension : of_body.tension.has_value())
      throw InputError(fmt::format(
          "{}: the surface of '{}' has a tension already, of {}; allowed are tables of faces only, "
          "or one of the whole surface",
          this->place, body, face.empty() ? "a face" : "the whole surface"));
  }
  TensionForm kind() const {
    const auto* found = std::find(tension_form_names.begin(), tension_form_names.end(), form);
    return static_cast<TensionForm>(found - tension_form_names.begin());
  }
  std::unique_ptr<ForceTerm> term(const Body<D>& on) const {
    switch (kind()) {
      case TensionForm::balanced:
        return balanced_surface_tension(on, gamma, face);
      case TensionForm::weak:
        return weak_surface_tension(on, gamma, points);
      case TensionForm::curvature:
        return curvature_surface_tension(on, gamma, points);
      case TensionForm::triangles:
        break;
    }
    return triangle_surface_tension(on, gamma);
  }
};

const bool registered = register_load<SurfaceTension>("surface_tension", Stage::surface,
                                                      "tension of the surface of a body");

}  // namespace
}  // namespace meniscus::surface_tension_table
