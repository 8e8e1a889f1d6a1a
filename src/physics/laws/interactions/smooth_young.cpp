// SPDX-License-Identifier: BSD-3-Clause
// Wetting by Young's law: the energy of a surface falls by the adhesion W over a smooth range where
// the surface touches the wall.
#include "input/optional_rows.hpp"
#include "meniscus/error.hpp"
#include "meniscus/physics/interaction_registry.hpp"
#include "physics/contact/adhesion.hpp"
#include "physics/contact/bent_line.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meniscus {
namespace {

/// Energy per area e as a function of the gap g, with t = (g - offset) / range (wetting note 1):
///   e = - W (1 - 10 t^3 + 15 t^4 - 6 t^5) for 0 < t < 1, zero beyond;
///   e = - W + C k |t|^3 / 3 for t < 0 (the core, a penalty that limits the penetration under
///   load).
/// C is the larger of W and gamma + min(gamma, gamma_2) - W, the tension that is left of both
/// surfaces; so the core also resists where adhesion is weak. If W varies, C is the largest W
/// without complete wetting, 2 gamma. k = 100, or more for a short offset, so that a surface pulled
/// into the well cannot pass through the wall. On a rigid partner an offset by default, or not
/// above 0, lets the film rest anywhere: the gap then counts from a surface inside the partner,
/// over which the film rests at half of the range or more.
struct SmoothYoung final : Interaction {
  static constexpr std::string_view example = "adhesion = 0.2\noffset = 0.2\nrange = 0.3\n";
  std::optional<Expression> angle, work, actin;  // input values
  std::optional<Real> depth, film;
  Real tau = 0;                                    // line tension
  Real W = 0, ell = 0, g0 = 0;                     // adhesion, range, gap of the film
  Real below = 0;                                  // recess of the surface from which gaps count
  Real core = 0;                                   // C k
  std::optional<Real> offset_by_facet;             // the offset, if it follows the facets
  Real W_below = 0;                                // W below the centre of the body, at the start
  std::shared_ptr<const AdhesionPattern> varying;  // if W varies; the member W is then 1

  static Rows<SmoothYoung> rows() {
    return {
        optional_expression_row(
            "contact_angle", &SmoothYoung::angle, dimension::degrees, {1, 179}, "by adhesion",
            "Young's angle in degrees; adhesion = gamma (1 + cos theta) with the surface tension "
            "gamma of the body. contact_angle, adhesion and actin are numbers or formulas of the "
            "time t, with a rigid partner or with `up` also of the place x, y, z on it, which "
            "moves and deforms with it. Formulas have to be smooth over a hundredth of the range"),
        optional_expression_row("adhesion", &SmoothYoung::work, dimension::tension,
                                range::non_negative, "by contact_angle",
                                "energy per area that contact releases"),
        optional_expression_row("actin", &SmoothYoung::actin, dimension::tension, range::any, "0",
                                "tension by which the front of a cell pulls itself outward, added "
                                "to the adhesion; what its change with time supplies is external "
                                "work"),
        optional_row("range", &SmoothYoung::depth, dimension::length, range::positive,
                     "half the size of a facet",
                     "length over which the interaction acts, beyond the offset"),
        optional_row("offset", &SmoothYoung::film, dimension::length, range::any, "by the angle",
                     "gap at which the surface rests; > 0 between two bodies. The default lets a "
                     "drop have its angle at the surface of a rigid partner: -1.3 to 0.3 ranges "
                     "from 15 to 165 degrees, in 2D 0. Without surface tension and "
                     "between two bodies it is a quarter of the size of a facet"),
        real_row("line_tension", &SmoothYoung::tau, dimension::force, range::any,
                 "energy per length of the contact line of a drop on a rigid partner in 3D; "
                 "not beside offset",
                 0.0)};
  }
  void check(const Block& block) const {
    if (angle.has_value() == work.has_value())
      block.problem("adhesion", angle ? "is given beside contact_angle; allowed is one of them"
                                      : "and contact_angle are missing; one of them is needed");
    if (film && tau != 0)
      block.problem("line_tension", "acts by the offset; allowed is one of them");
  }

  /// This law with numbers for the given surfaces. Throws InputError if an angle is given without
  /// surface tension, or if there is no adhesion.
  std::shared_ptr<const Interaction> fitted(const ContactSurfaces& surfaces) const {
    auto law = std::make_shared<SmoothYoung>(*this);
    law->ell = depth.value_or(surfaces.facet / 2);
    const AdhesionFormulas formulas{angle, work, actin};
    const AdhesionPattern pattern(formulas, angle ? surfaces.tension() : 0, law->ell);
    try {
      law->W = law->W_below = pattern(surfaces.centre, 0);
    } catch (const SolveError& error) {
      throw InputError((formulas.constant() ? surfaces.place + ": " : "") + error.what());
    }
    if (!(law->W > 0))
      throw InputError(fmt::format("{}: adhesion and actin are {:.4g} together{}; allowed is > 0",
                                   surfaces.place, law->W,
                                   formulas.constant() ? "" : " below the centre of the body"));
    const Real gamma = surfaces.gamma.value_or(0);
    law->place_film(surfaces, gamma);
    // At least_gap() the energy of the core is 1.6 C.
    const Real depth_of_core = 0.75 * law->g0 / law->ell;
    const Real k = std::max(100.0, 4.8 / (depth_of_core * depth_of_core * depth_of_core));
    const Real left = gamma + std::min(gamma, surfaces.gamma_beyond.value_or(0)) - law->W;
    law->core = k * std::max(law->W, formulas.constant() ? left : 2 * gamma);
    if (formulas.constant()) return law;
    law->varying = std::make_shared<AdhesionPattern>(pattern);
    law->W = 1;
    return law;
  }

  /// Sets the gap of the film, and the recess. Throws InputError if the surfaces do not allow the
  /// offset or the line tension.
  void place_film(const ContactSurfaces& surfaces, Real gamma) {
    if (tau != 0 && !(surfaces.rigid && surfaces.dimension == 3 && gamma > 0))
      throw InputError(surfaces.place +
                       ": line_tension is for drops with a surface tension on rigid partners in "
                       "3D; allowed is to leave it out");
    const Real usual = surfaces.facet / 4;
    const bool by_angle = surfaces.rigid && !film && gamma > 0;
    if (!film && !by_angle) offset_by_facet = usual;
    if (!surfaces.rigid) {
      g0 = film.value_or(usual);
      if (!(g0 > 0))
        throw InputError(fmt::format("{}: offset is {:.4g} between two bodies; allowed is > 0",
                                     surfaces.place, g0));
      return;
    }
    g0 = ell / 2;
    const Real offset = by_angle
                            ? bent_line(*this, W, gamma, surfaces.volume, surfaces.dimension).depth
                            : film.value_or(usual);
    g0 = by_angle || offset <= 0 ? std::max(g0, offset) : offset;
    below = g0 - offset;
  }
  PlaneState at(Real gap) const override {
    const Real t = (gap - g0) / ell, s = 1 - t;
    if (t >= 1) return {0, 0, 0};
    if (t < 0) return {-W - core * t * t * t / 3, core * t * t / ell, -2 * core * t / (ell * ell)};
    return {-W * (1 - t * t * t * (10 - t * (15 - 6 * t))), -30 * W * t * t * s * s / ell,
            60 * W * t * s * (1 - 2 * t) / (ell * ell)};
  }
  Real range() const override { return g0 + ell; }
  Real least_gap() const override { return g0 / 4; }
  Real recess() const override { return below; }
  Real line_tension() const override { return tau; }
  bool hardens() const override { return false; }
  bool ends() const override { return true; }
  PlaneContact flat() const override {
    const Real softest = (3 + std::numbers::sqrt3_v<Real>) / 6;  // here -K is largest
    const Real softening = -at(g0 + softest * ell).stiffness * W_below / W;
    return {g0, W_below,   1.875 * W_below / ell, g0 + ell / 2,
            0,  softening, g0 + softest * ell,    W_below};
  }
  const AdhesionPattern* pattern() const override { return varying.get(); }
  std::string described(const UnitSystem& units) const override {
    const std::string unit = units.symbol(dimension::length);
    std::string text = fmt::format(
        "range {:.4g} {}{}, offset {:.4g} {}", ell, unit,
        depth ? "" : " (half a facet: name `range` to keep it in finer bodies)", g0 - below, unit);
    if (varying) text += "; W varies and is that below the centre of the body at t = 0";
    return text;
  }
  std::vector<std::pair<std::string, Real>> lengths_by_facets() const override {
    std::vector<std::pair<std::string, Real>> lengths;
    if (!depth) lengths.emplace_back("range", ell);
    if (offset_by_facet) lengths.emplace_back("offset", *offset_by_facet);
    return lengths;
  }
  std::optional<std::string> doubt(Real facet) const override {
    if (ell >= facet / 3) return std::nullopt;
    return fmt::format(
        "its range {:.3g} is below a third of the size {:.3g} of the facets, so that the contact "
        "line moves from facet to facet; allowed are longer ranges, or finer bodies",
        ell, facet);
  }
};

const bool registered = register_interaction<SmoothYoung>(
    "smooth_young", "wetting: energy of the area in contact, for a given contact angle");

}  // namespace
}  // namespace meniscus
