// SPDX-License-Identifier: BSD-3-Clause
// Springs and dampers on a face or at a point of a body.
#include "body/surface/face_means.hpp"
#include "input/optional_rows.hpp"
#include "meniscus/scene/assembly.hpp"
#include "physics/loads/spring.hpp"
#include "scene/face_keys.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace meniscus::spring_table {
namespace {

template <int D>
struct Spring final : Load<D> {
  static constexpr std::string_view example =
      "body = \"drop\"\nwhere = \"y > 0.8\"\nstiffness = 3\ndamping = 0.2\n";
  std::string name;
  FaceKeys face;
  std::vector<Real> at_place;
  std::vector<std::string> components;
  Real stiffness = 0, damping = 0, constant = 0, resistance = 0;
  std::vector<Expression> displacement;
  Ramp ramp;

  static Rows<Spring> rows() {
    Rows<Spring> rows = face_rows<Spring>(&Spring::face);
    rows.insert(
        rows.begin(),
        text_row(
            "name", &Spring::name,
            "name of the table in messages and measures; empty: name of the body, then of the face",
            ""));
    const std::vector<Row<Spring>> own = {
        reals_row("at", &Spring::at_place, 0, dimension::length, range::any,
                  "reference place of one spring, instead of a face", std::vector<Real>{}),
        real_row("stiffness", &Spring::stiffness, {-2, -2, 1}, range::non_negative,
                 "on a face: force per displacement and reference area", 0.0),
        real_row("damping", &Spring::damping, {-2, -1, 1}, range::non_negative,
                 "on a face: force per speed and reference area", 0.0),
        real_row("constant", &Spring::constant, dimension::tension, range::non_negative,
                 "at a place: force per displacement", 0.0),
        real_row("resistance", &Spring::resistance, {0, -1, 1}, range::non_negative,
                 "at a place: force per speed", 0.0),
        texts_row("components", &Spring::components,
                  "of the displacement that have springs: of x, y, z (2D: x, y); empty: all",
                  std::vector<std::string>{}),
        optional_expressions_row("displacement", &Spring::displacement, D, dimension::length,
                                 Variables::place,
                                 "from the reference to where springs have no force, a formula of "
                                 "reference position for each component"),
        ramp_row("ramp", &Spring::ramp, "displacement from 0")};
    rows.insert(rows.end(), own.begin(), own.end());
    return rows;
  }
  std::string label() const { return name.empty() ? face.label() + "-spring" : name; }
  std::optional<typename Load<D>::Identity> identity() const override {
    return {{"name", label()}};
  }
  bool at_a_place() const { return !at_place.empty(); }

  void check(const Block& block, const BodyPlans<D>& bodies) const override {
    require_plain_name(block, name);
    if (at_a_place()) {
      const BodyPlan<D>* planned = require_body(block, bodies, face.body);
      const bool revolves = planned && planned->geometry.grid.revolved;
      if (at_place.size() != D)
        block.problem("at", fmt::format("has {} numbers; allowed are {}", at_place.size(), D));
      if (revolves && at_place.front() < 0)
        block.problem(
            "at", fmt::format("has x = {:g}, beyond the axis; allowed is >= 0", at_place.front()));
      if (!face.face.empty() || face.where) block.problem("at", "goes without face and where");
    } else {
      face.check(block, bodies);
    }
    const std::string wanted = at_a_place() ? "constant" : "stiffness";
    if ((at_a_place() ? constant + resistance : stiffness + damping) == 0)
      block.problem(wanted, fmt::format("is missing: {} or {} has to be > 0", wanted,
                                        at_a_place() ? "resistance" : "damping"));
    if ((at_a_place() ? stiffness + damping : constant + resistance) > 0)
      block.problem(at_a_place() ? "stiffness" : "constant",
                    at_a_place() ? "is per area, of a face; at a place give constant, resistance"
                                 : "is of a spring at a place; on a face give stiffness, damping");
    for (const std::string& c : components)
      if (c.size() != 1 || std::string(D == 3 ? "xyz" : "xy").find(c) == std::string::npos)
        block.problem("components", fmt::format("'{}' is no component; allowed are {}", c,
                                                D == 3 ? "x, y, z" : "x, y"));
  }
  void prepare(BodyPlans<D>& bodies) const override {
    if (!at_a_place()) face.prepare(bodies);
  }
  void build(Assembly<D>& assembly) const override {
    const Body<D>& body = assembly.body(face.body);
    assembly.keep_reference(face.body, "its [[spring]] knows places of its first reference only");
    assembly.add(spring(body, label(), at_a_place() ? at_one_place(body) : on_face(body)), label());
  }

 private:
  Springs<D> empty() const {
    Springs<D> springs;
    springs.ramp = ramp;
    if (!components.empty())
      for (int i = 0; i < D; ++i)
        springs.components[i] = static_cast<Real>(
            std::count(components.begin(), components.end(), std::string(1, "xyz"[i])) > 0);
    return springs;
  }
  Springs<D> on_face(const Body<D>& body) const {
    const FaceCells<D> cells = face.cells(this->place, body);
    FaceMeans<D> moved(cells, displacement);
    Springs<D> springs = empty();
    springs.mean = cells.mean;
    for (Index k = 0; k < cells.size(); ++k) {
      springs.stiffness.push_back(stiffness * at(cells.area, k));
      springs.damping.push_back(damping * at(cells.area, k));
      Vec<D> g = Vec<D>::Zero();
      if (!displacement.empty())
        g = Vec<D>::Map(moved.at(0).data() + static_cast<std::size_t>(k) * D);
      springs.displacement.push_back(g);
    }
    return springs;
  }
  Springs<D> at_one_place(const Body<D>& body) const {
    const std::vector<Vec<D>> X{Vec<D>::Map(at_place.data())};
    Springs<D> springs = empty();
    springs.mean = build_point_rows<D>(body.particles, X, {.value = true}, body.name);
    springs.stiffness = {constant};
    springs.damping = {resistance};
    Vec<D> g = Vec<D>::Zero();
    for (int i = 0; i < static_cast<int>(displacement.size()); ++i)
      g[i] = at(displacement, i)(spatial<D>(X.front()));
    springs.displacement = {g};
    return springs;
  }
};

const bool registered =
    register_load<Spring>("spring", Stage::surface, "springs and dampers on a face or at a place");

}  // namespace
}  // namespace meniscus::spring_table
