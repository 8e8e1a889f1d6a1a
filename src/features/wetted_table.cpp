// SPDX-License-Identifier: BSD-3-Clause
// A face of a drop that lies on a wall, with a sharp contact line.
#include "body/surface/quadratic_patches.hpp"
#include "body/surface/surface_points.hpp"
#include "input/optional_rows.hpp"
#include "measure/wetted_measures.hpp"
#include "meniscus/error.hpp"
#include "meniscus/scene/assembly.hpp"
#include "physics/surface/line_friction.hpp"
#include "physics/surface/line_pinning.hpp"
#include "physics/surface/wall_hold.hpp"
#include "scene/face_keys.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace meniscus::wetted_table {
namespace {

template <int D>
struct Wetted final : Load<D> {
  static constexpr std::string_view example =
      "body = \"drop\"\nface = \"flat\"\ncontact_angle = 70\nline_friction = 0.2\n";
  std::string name, body, face;
  std::optional<Real> contact_angle, tension, advancing_angle, receding_angle;
  Real line_friction = 0;
  std::vector<Real> axis;
  std::vector<Expression> displacement;

  static Rows<Wetted> rows() {
    return {
        text_row(
            "name", &Wetted::name,
            "name of the table in messages and measures; empty: name of the body, then of the face",
            ""),
        text_row("body", &Wetted::body, "name of the drop"),
        text_row("face", &Wetted::face,
                 "name of the face that lies on the wall, as `meniscus check` lists them; the wall "
                 "is the plane, ball or cylinder on which this face lies at the start"),
        optional_row("contact_angle", &Wetted::contact_angle, dimension::none, range::any, "none",
                     "Young's contact angle in degrees, between 0 and 180; either this or "
                     "tension"),
        optional_row("tension", &Wetted::tension, dimension::tension, range::any, "none",
                     "tension of the wetted face: that of solid and liquid minus that of solid and "
                     "vapour"),
        real_row("line_friction", &Wetted::line_friction, dimension::viscosity, range::non_negative,
                 "force per length of the contact line and per speed of the line", 0),
        optional_row("advancing_angle", &Wetted::advancing_angle, dimension::none, range::any,
                     "none",
                     "in degrees: the line is pinned while its angle is between receding_angle and "
                     "this; contact_angle is then the one without pinning, by default that of the "
                     "mean of both cosines"),
        optional_row("receding_angle", &Wetted::receding_angle, dimension::none, range::any, "none",
                     "in degrees, at most advancing_angle"),
        reals_row("axis", &Wetted::axis, D, dimension::none, range::any,
                  "direction of the axis if the wall is a cylinder", std::vector<Real>{}),
        optional_expressions_row("displacement", &Wetted::displacement, D, dimension::length,
                                 Variables::time,
                                 "displacement of the wall, a formula of t for "
                                 "each component")};
  }
  std::string label() const { return name.empty() ? body + "-" + face : name; }
  std::optional<typename Load<D>::Identity> identity() const override {
    return {{"name", label()}};
  }
  std::string claim() const override { return "the face '" + face + "' of '" + body + "'"; }

  void check(const Block& block, const BodyPlans<D>& bodies) const override {
    if (!name.empty()) require_plain_name(block, name);
    FaceKeys{body, face, std::nullopt}.check(block, bodies);
    if (face.empty())
      block.problem("face", "is empty; expected is a face, as `meniscus check` lists them");
    if (advancing_angle.has_value() != receding_angle.has_value())
      block.problem(advancing_angle ? "receding_angle" : "advancing_angle",
                    "is missing; a line that is pinned has both angles");
    const bool by_hysteresis = pinned() && !contact_angle && !tension;
    if (contact_angle.has_value() == tension.has_value() && !by_hysteresis)
      block.problem("contact_angle", contact_angle ? "tension is given, too; allowed is one of them"
                                                   : "missing; give this or tension");
    check_hysteresis(block);
    if (contact_angle && !(*contact_angle > 0 && *contact_angle < 180))
      block.problem("contact_angle",
                    fmt::format("is {:g}; allowed are angles between 0 and 180", *contact_angle));
    if (!axis.empty() && !(norm_of_axis() > 0))
      block.problem("axis", "has no direction; allowed is a vector other than zero");
    for (const BodyPlan<D>& planned : bodies) {
      if (planned.settings.name != body || !planned.in_order) continue;
      if (planned.geometry.grid.revolved && !displacement.empty() &&
          !(displacement.front().constant() && displacement.front()({0, 0, 0}) == 0))
        block.problem("displacement", "is across the axis of revolution; allowed is 0 for x");
      const std::vector<Vec<D>> X = points_of_face(planned.geometry);
      if (!X.empty() && !wall_through<D>(X, direction()))
        block.problem(
            "face",
            fmt::format("'{}' lies on no {}; allowed are faces on a {}", face,
                        axis.empty() ? "plane or ball" : "cylinder with this axis",
                        D == 3 ? "plane, a ball, or, with axis, a cylinder" : "line or a circle"));
    }
  }

  void prepare(BodyPlans<D>& bodies) const override {
    for (BodyPlan<D>& planned : bodies) {
      if (planned.settings.name != body || !planned.in_order) continue;
      const auto wall = wall_through<D>(points_of_face(planned.geometry), direction());
      if (!wall) continue;
      planned.wetted.push_back({face, *wall, tension ? 0.0 : -cosine_without_pinning(),
                                tension.value_or(0), displacement});
    }
  }

  void build(Assembly<D>& assembly) const override {
    const Body<D>& on = assembly.body(body);
    if (!assembly.of(body).is_fluid())
      throw InputError(fmt::format("{}: body '{}' is a solid; a wetted face belongs to a fluid",
                                   this->place, body));
    if (!assembly.of(body).has_balanced_tension())
      throw InputError(fmt::format(
          "{}: body '{}' has no [[surface_tension]] of its whole surface, of form \"balanced\"; a "
          "wetted face needs it",
          this->place, body));
    const Real gamma = assembly.of(body).tension->gamma;
    if (tension && !(std::abs(*tension) < gamma))
      throw InputError(fmt::format(
          "{}: tension is {:g} times the surface tension of '{}', so that no contact angle exists; "
          "allowed are absolute values below it",
          this->place, *tension / gamma, body));
    const WettedFace<D>& wetted = *std::find_if(
        on.wetted.begin(), on.wetted.end(), [&](const auto& known) { return known.face == face; });
    auto hold =
        std::make_unique<WallHold<D>>(on, wetted, stiffness_of_hold(on, wetted.wall, gamma));
    const WettingDrop<D> drop{
        gamma, assembly.weight(body), assembly.of(body).other_body_forces,
        assembly.measure_named(body + ".inner_pressure"),
        [&term = *hold](const Motion& motion) { return term.force_on_body(motion); }};
    assembly.add(std::move(hold), label());
    if (line_friction > 0)
      assembly.add(meniscus::line_friction(on, wetted, line_friction), label());
    if (pinned()) add_pinning(on, wetted, gamma, assembly);
    for (MeasureSource& source : wetted_measures(on, wetted, drop))
      assembly.measure(label(), std::move(source));
    assembly.walls_of(body)->push_back([wetted](const Vec<D>& x, Real t) {
      std::array<Real, D> y;
      for (int i = 0; i < D; ++i) meniscus::at(y, i) = x[i];
      return std::abs(wetted.wall_at(t).template foot<Real>(y).distance);
    });
    assembly.keep_reference(body, "a wetted face stays on its wall only by its first reference");
  }

 private:
  Real norm_of_axis() const {
    return std::sqrt(std::inner_product(axis.begin(), axis.end(), axis.begin(), 0.0));
  }
  std::optional<Vec<D>> direction() const {
    if (axis.empty() || !(norm_of_axis() > 0)) return std::nullopt;
    return Vec<D>::Map(axis.data()) / norm_of_axis();
  }
  std::vector<Vec<D>> points_of_face(const Geometry<D>& geometry) const {
    std::vector<Vec<D>> X;
    for (const Facet<D>& facet : geometry.grid.facets)
      if (geometry.surface->face_name(facet.patch) == face)
        for (int a = 0; a < PatchFunctions<D>::nodes; ++a)
          X.push_back(surface_point<D>(geometry, facet, patch_node<D>(a)));
    // Only a wall of revolution goes through the images beyond the axis, too.
    for (std::size_t q = 0, given = X.size(); geometry.grid.revolved && q < given; ++q) {
      X.push_back(X[q]);
      X.back()[0] = -X.back()[0];
    }
    return X;
  }
  bool pinned() const { return advancing_angle.has_value() && receding_angle.has_value(); }
  static Real cosine(Real degrees) { return std::cos(degrees * std::numbers::pi / 180); }
  /// The cosine of the angle of a line that nothing holds, if there is no tension.
  Real cosine_without_pinning() const {
    if (contact_angle) return cosine(*contact_angle);
    return pinned() ? (cosine(*advancing_angle) + cosine(*receding_angle)) / 2 : 0;
  }
  void check_hysteresis(const Block& block) const {
    if (!pinned()) return;
    const Real low = *receding_angle, high = *advancing_angle;
    if (!(0 < low && low <= high && high < 180))
      block.problem("receding_angle",
                    fmt::format("is {:g} with the advancing_angle {:g}; allowed are 0 < "
                                "receding_angle <= advancing_angle < 180",
                                low, high));
    else if (contact_angle && !(low <= *contact_angle && *contact_angle <= high))
      block.problem("contact_angle", fmt::format("is {:g}; allowed are angles from receding_angle, "
                                                 "{:g}, to advancing_angle, {:g}",
                                                 *contact_angle, low, high));
  }
  /// The bonds give way by about a thousandth of the size of the drop.
  void add_pinning(const Body<D>& on, const WettedFace<D>& wetted, Real gamma,
                   Assembly<D>& assembly) const {
    constexpr Real relative = 500;
    const Real free = -wetted.relative - wetted.absolute / gamma;
    const LineHold hold{gamma * (free - cosine(*advancing_angle)),
                        gamma * (cosine(*receding_angle) - free),
                        relative * gamma / ball_radius(on.volume(), on.space())};
    if (!(hold.advancing >= 0 && hold.receding >= 0))
      throw InputError(
          fmt::format("{}: tension gives the angle {:.4g}, which is not between receding_angle and "
                      "advancing_angle",
                      this->place, std::acos(free) * 180 / std::numbers::pi));
    const State* const initial = assembly.initial();
    const std::optional<Motion> start = initial ? std::optional(initial->motion()) : std::nullopt;
    assembly.add(line_pinning(on, wetted, hold, start ? &*start : nullptr), label());
  }
  /// Stiff beside the pressure of the drop over its size. A plane wall is stiff also beside the
  /// pressure of the shortest capillary waves, which would press fluid through it. On a curved wall
  /// so many points cannot all stay, and a stiff hold would take a part of the pressure at rest.
  static Real stiffness_of_hold(const Body<D>& on, const WettedWall<D>& wall, Real gamma) {
    constexpr Real of_size = 100, of_spacing = 20;
    const Real R = ball_radius(on.volume(), on.space()), h = mean_spacing(on.geometry.grid);
    const Real soft = of_size * gamma / (R * R);
    return wall.is_plane() ? std::max(soft, of_spacing * gamma / (h * h)) : soft;
  }
};

const bool registered = register_load<Wetted>(
    "wetted", Stage::contact, "a face of a drop that lies on a wall, with a sharp contact line");

}  // namespace
}  // namespace meniscus::wetted_table
