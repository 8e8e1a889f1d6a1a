// SPDX-License-Identifier: BSD-3-Clause
// Surface laws on the whole surface of a body or on one face, one table per law.
#include "meniscus/physics/law_registry.hpp"
#include "meniscus/physics/surface_registry.hpp"
#include "meniscus/scene/assembly.hpp"
#include "scene/face_keys.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace meniscus::surface_table {
namespace {

struct Keys {
  std::string body, face, type;
  int points = 0;
  std::unique_ptr<const SurfaceMaterial> law;

  static Rows<Keys> rows() {
    Row<Keys> points = integer_row("points", &Keys::points, {1, 20},
                                   "Gauss points per direction and surface facet; helfrich needs "
                                   "at least 10, in 2D 12; 5 on a solid",
                                   3);
    points.fallback = "3; helfrich 12, in 2D 16";
    points.read = [](Keys&, const Block&) {};  // by read_inner(), which knows the law
    return {text_row("body", &Keys::body, "name of the body whose surface it is"),
            text_row("face", &Keys::face,
                     "name of a face of its shape, as `meniscus check` lists them; empty: the "
                     "whole surface",
                     ""),
            points};
  }
  static std::vector<KeyTable> inner_tables() {
    std::vector<KeyTable> tables;
    for (const auto& [name, law] : surface_laws())
      tables.push_back({"[surface.law] type = \"" + name + "\": " + std::string(law.meaning),
                        law.keys,
                        "[surface.law]\ntype = \"" + name + "\"\n" + std::string(law.example)});
    return tables;
  }
};

template <int D>
struct Surface final : Load<D>, Keys {
  static constexpr std::string_view example =
      "body = \"drop\"\n[surface.law]\ntype = \"tension\"\ngamma = 1\n";
  /// Reads [surface.law], then the points, whose default depends on the law.
  void read_inner(const Block& block) {
    if (const auto table = block.table("law", true)) {
      if (const auto kind = table->kind("type", surface_laws().names())) {
        type = *kind;
        law = surface_laws().at(type).read(*table);
      }
      table->done();
    }
    const int usual = !curved() ? 3 : D == 3 ? 12 : 16;
    points = static_cast<int>(block.integer("points", {1, 20}, usual));
  }
  /// The resource that a table claims: a body can have one tension, and at most one law of every
  /// other type.
  std::string claim() const override {
    const std::string surface =
        (face.empty() ? "the surface of '" : "the face '" + face + "' of '") + body + "'";
    return type == "tension" ? surface : "the " + type + " of " + surface;
  }
  void check(const Block& block, const BodyPlans<D>& bodies) const override {
    const BodyPlan<D>* planned = require_body(block, bodies, body);
    if (planned && curved()) require_points(block, *planned);
    if (face.empty()) return;
    if (planned) FaceKeys{body, face, std::nullopt}.check(block, bodies);
    if (type == "tension")
      block.problem("face", "goes with [[surface_tension]]; allowed is the whole surface");
  }
  void prepare(BodyPlans<D>& bodies) const override {
    for (BodyPlan<D>& planned : bodies) {
      if (planned.settings.name != body) continue;
      planned.pulled_along |= type == "varying_tension";
      planned.curvature |= curved();
    }
  }
  /// Adds the term with its measures. Measures of a tension are named after the body alone,
  /// measures of other laws after the body and the type.
  void build(Assembly<D>& assembly) const override {
    require_stable(assembly);
    std::unique_ptr<ForceTerm> term = law->build(assembly.body(body), {points, face});
    if (auto* anchored = dynamic_cast<AnchoredTerm*>(term.get()))
      anchored->anchor(required_director(assembly));
    const auto* varied = dynamic_cast<const VariedTension*>(term.get());
    if (varied && assembly.of(body).is_fluid()) assembly.check(negative_tension(*varied, assembly));
    const std::string of_face = face.empty() ? "" : "." + face;
    assembly.add(std::move(term), type == "tension" ? body : body + "." + type + of_face);
    if (const Real energy = law->energy_at_rest(); energy > 0)
      assembly.of(body).surface_energy = energy;
    if (!face.empty())
      assembly.keep_reference(body, "its [[surface]] knows the faces of its shape only");
    else if (law->keeps_reference())
      assembly.keep_reference(body, "its [[surface]] has an energy per area of the reference");
  }

 private:
  bool curved() const { return law && law->needs_curvature(); }
  /// With too few points, the energy of a liquid falls without bound: nothing else resists motions
  /// that only the quadrature sees (membranes note 3).
  void require_points(const Block& block, const BodyPlan<D>& planned) const {
    const int least = !planned.material || !planned.material->fluid() ? 5 : D == 3 ? 10 : 12;
    if (points < least)
      block.problem("points", fmt::format("{} points per direction are too few for \"{}\", whose "
                                          "energy could fall without bound; expected are at least "
                                          "{}",
                                          points, type, least));
  }
  CarriedField& required_director(const Assembly<D>& assembly) const {
    if (CarriedField* director = assembly.of(body).director) return *director;
    throw InputError(fmt::format(
        "{}: \"{}\" acts on a director, which body '{}' has none of; expected is a body whose "
        "material is \"nematic\"",
        this->place, type, body));
  }
  /// Check of the state: the surface of a fluid would grow without bound if its mean tension were
  /// negative.
  StateCheck negative_tension(const VariedTension& varied, const Assembly<D>& assembly) const {
    return [&varied, &own = assembly.of(body), first = assembly.body(body).first,
            symbol = assembly.units().symbol(dimension::tension)](
               const Motion& motion) -> std::optional<Failure> {
      const auto [gamma, particle] = varied.least(motion);
      const Real all = gamma + own.surface_energy.value_or(0);
      if (all >= 0) return std::nullopt;
      return Failure{first + particle,
                     fmt::format("the tension of the surface is {:.4g} {} here, all tables of it "
                                 "together; expected is one that is nowhere negative, or a fluid "
                                 "makes more and more surface",
                                 all, symbol)};
    };
  }
  /// Warns or throws InputError if the surface is unstable. On a body with the shear modulus mu, a
  /// skin with the negative modulus m is unstable for wavelengths below 2 pi |m|/mu; the shortest
  /// wavelength on a grid is twice the spacing.
  void require_stable(Assembly<D>& assembly) const {
    const std::optional<Real> modulus = law->unstable_modulus();
    if (!modulus) return;
    const bool fluid = assembly.of(body).is_fluid();
    const Real shear = fluid ? 0 : assembly.shear_modulus(body),
               spacing = mean_spacing(assembly.body(body).geometry.grid),
               least = shear > 0 ? std::numbers::pi * std::abs(std::min(0.0, *modulus)) / shear
                                 : std::numeric_limits<Real>::infinity();
    const std::string moduli = fmt::format(
        "the energy of the skin of '{}' is not positive (least modulus in the surface {:.4g} {})",
        body, *modulus, assembly.units().symbol(dimension::tension));
    if (spacing > least)
      assembly.warn(
          fmt::format("{}: only the body holds it, on spacings above {:.4g} {}; here it "
                      "is {:.4g}",
                      moduli, least, assembly.units().symbol(dimension::length), spacing));
    else
      throw InputError(fmt::format(
          "{}: {}; expected are mu >= 0 and lambda + mu >= 0{}", this->place, moduli,
          shear > 0 ? fmt::format(", or a spacing above pi |modulus|/shear modulus = {:.4g} {}, "
                                  "which is {:.4g}",
                                  least, assembly.units().symbol(dimension::length), spacing)
                    : ""));
  }
};

const bool registered = register_load<Surface>(
    "surface", Stage::surface, "the surface of a body, or a face, by a law; several laws add up");

}  // namespace
}  // namespace meniscus::surface_table
