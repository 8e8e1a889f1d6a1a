// SPDX-License-Identifier: BSD-3-Clause
// A face that is held or moved: the mean displacement over each of its face cells is prescribed, or
// the face moves as one by a force.
#include "input/optional_rows.hpp"
#include "meniscus/error.hpp"
#include "meniscus/scene/assembly.hpp"
#include "physics/loads/held_face.hpp"
#include "physics/loads/traction.hpp"
#include "scene/face_keys.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace meniscus::held_table {
namespace {

template <int D>
struct Held final : Load<D> {
  static constexpr std::string_view example =
      D == 3 ? "body = \"drop\"\nwhere = \"z < -0.9\"\ndisplacement = [0, 0, \"0.01*sin(t)\"]\n"
             : "body = \"drop\"\nwhere = \"y < -0.9\"\ndisplacement = [0, \"0.01*sin(t)\"]\n";
  std::string name;
  FaceKeys face;
  std::vector<std::string> components;
  std::string from;
  std::vector<Expression> displacement, force;
  std::vector<Real> axis, centre;
  std::optional<Expression> angle;
  Ramp ramp;

  static Rows<Held> rows() {
    Rows<Held> rows = face_rows<Held>(&Held::face, "the facets that `where` chooses");
    rows.insert(
        rows.begin(),
        text_row(
            "name", &Held::name,
            "name of the table in messages and measures; empty: name of the body, then of the face",
            ""));
    const std::vector<Row<Held>> own = {
        texts_row("components", &Held::components,
                  "components of the displacement that are prescribed: some of x, y, z (2D: x, y), "
                  "or normal alone; empty: all",
                  std::vector<std::string>{}),
        optional_expressions_row("displacement", &Held::displacement, D, dimension::length,
                                 Variables::place_and_time,
                                 "a formula of reference position and time t for each component"),
        choice_row("from", &Held::from, {"reference", "start"},
                   "where displacement and angle are zero: in the reference, or where the face is "
                   "when the run or stage begins",
                   "reference"),
        optional_expressions_row("force", &Held::force, D, of_sum(dimension::force, D),
                                 Variables::time,
                                 "total force on the face, instead of displacement and angle: the "
                                 "face is a grip that keeps its form along the components and "
                                 "moves by itself; a formula of t for each component"),
        optional_expression_row("angle", &Held::angle, dimension::none, range::any, "0",
                                "by which the face is turned about the axis, in radians, before "
                                "it is displaced; a formula of t"),
        reals_row("axis", &Held::axis, 3, dimension::none, range::any,
                  "direction of the axis; in 2D it is across the plane",
                  std::vector<Real>{0, 0, 1}),
        reals_row("centre", &Held::centre, D, dimension::length, range::any,
                  "a place of the axis; torques are about it", std::vector<Real>(D, 0)),
        ramp_row("ramp", &Held::ramp, "displacement, angle and force from 0")};
    rows.insert(rows.end(), own.begin(), own.end());
    return rows;
  }
  std::string label() const { return name.empty() ? face.label() : name; }
  std::optional<typename Load<D>::Identity> identity() const override {
    return {{"name", label()}};
  }

  void check(const Block& block, const BodyPlans<D>& bodies) const override {
    require_plain_name(block, name);
    face.check(block, bodies);
    face.require_named(block, bodies, "the face that is held is named");
    const std::vector<std::string> known =
        D == 3 ? std::vector<std::string>{"x", "y", "z"} : std::vector<std::string>{"x", "y"};
    const bool normal = std::count(components.begin(), components.end(), "normal") > 0;
    for (const std::string& c : components)
      if (c != "normal" && std::count(known.begin(), known.end(), c) == 0)
        block.problem("components", fmt::format("'{}' is no component; allowed are {}, normal", c,
                                                joined(known, ", ")));
      else if (std::count(components.begin(), components.end(), c) > 1)
        block.problem("components", fmt::format("'{}' is given twice", c));
    if (normal && components.size() > 1) block.problem("components", "normal goes alone");
    if (!force.empty()) check_force(block, normal);
    if (angle && angle->depends_on_place())
      block.problem("angle", "depends on the place; allowed is a formula of t");
    if (D == 2 && (axis[0] != 0 || axis[1] != 0))
      block.problem("axis", "is across the plane in 2D; allowed is [0, 0, 1]");
    if (are_revolved(bodies)) check_revolved(block);
    if (Eigen::Vector3d::Map(axis.data()).norm() == 0)
      block.problem("axis", "has no direction; allowed is any but zero");
  }

  void prepare(BodyPlans<D>& bodies) const override { face.prepare(bodies); }
  void build(Assembly<D>& assembly) const override {
    const Body<D>& body = assembly.body(face.body);
    const FaceCells<D> cells = face.cells(this->place, body);
    if (!force.empty()) return pull(assembly, body, cells);
    constexpr Real short_time = 1e-4;
    FaceRows rows = rows_of(cells, body);
    const std::vector<Index> cell = rows.cell;
    auto held = std::make_unique<HeldFace<D>>("held face '" + label() + "'", this->place,
                                              std::move(rows), cells, grip(), from == "start",
                                              short_time * assembly.end_time());
    note(assembly, *held, cells, body.name);
    if (displacement.empty() && !angle && from == "reference")
      for (const auto& row : held->rows.rows)
        assembly.set_held(face.body, at(cells.cell, at(cell, row.place)), row.direction);
    measure(assembly, *held, cells, cell);
    assembly.keep_reference(face.body, "its [[held]] knows the faces of its shape only");
    assembly.add(std::move(held));
  }

 private:
  bool has_component(int i) const {
    return components.empty() ||
           std::count(components.begin(), components.end(), std::string(1, "xyz"[i])) > 0;
  }
  static bool are_revolved(const BodyPlans<D>& bodies) {
    return !bodies.empty() && bodies.front().geometry.grid.revolved;
  }
  void check_revolved(const Block& block) const {
    if (angle)
      block.problem("angle", "turns the face out of a body of revolution; allowed is displacement");
    if (!force.empty() && components != std::vector<std::string>{"y"})
      block.problem("components",
                    "a face of a body of revolution is pulled along its axis; allowed is [\"y\"]");
  }
  void check_force(const Block& block, bool normal) const {
    for (const char* key : {"displacement", "angle", "from"})
      if (block.has(key)) block.problem(key, "goes without force, which moves the face by itself");
    if (normal) block.problem("components", "normal goes without force; allowed are axes");
    for (int i = 0; i < D; ++i)
      if (!has_component(i) && !(at(force, i).constant() && at(force, i)({0, 0, 0}) == 0))
        block.problem("force", fmt::format("acts along {0}, which is not in components; allowed is "
                                           "0, or a [[traction]] for {0}",
                                           "xyz"[i]));
  }
  /// Adds the constraint of a face that moves as one, and the force as an even dead traction.
  void pull(Assembly<D>& assembly, const Body<D>& body, const FaceCells<D>& cells) const {
    auto held = std::make_unique<FaceAsOne>("held face '" + label() + "'", this->place,
                                            rows_of(cells, body).rows);
    note(assembly, *held, cells, body.name);
    assembly.keep_reference(face.body, "its [[held]] knows the faces of its shape only");
    if (held->rows.size() > 0) assembly.add(std::move(held));
    assembly.add(traction(body, label(), cells, force, ramp, 1 / cells.total_area()), label());
  }
  static void note(Assembly<D>& assembly, const Constraint& held, const FaceCells<D>& cells,
                   const std::string& body) {
    assembly.note(fmt::format(
        "{}: {} nodal cells of body '{}', {:.4g} {}, {} multipliers", held.name, cells.size(), body,
        cells.total_area(), assembly.units().symbol(of_sum(dimension::area, D)), held.rows.size()));
  }
  Grip<D> grip() const {
    Grip<D> grip{displacement, angle.value_or(Expression(0)),
                 Eigen::Vector3d::Map(axis.data()).normalized(),
                 spatial<D>(Vec<D>::Map(centre.data())), ramp};
    return grip;
  }
  FaceRows rows_of(const FaceCells<D>& cells, const Body<D>& body) const {
    if constexpr (D == 2)
      if (body.geometry.grid.revolved) return folded_rows_of(cells, body);
    FaceRows of_face;
    ConstraintRows& rows = of_face.rows;
    rows.start = cells.mean.start;
    rows.weight.assign(cells.mean.value.begin(), cells.mean.value.end());
    for (const Index A : cells.mean.particle) rows.particle.push_back(body.first + A);
    for (Index k = 0; k < cells.size(); ++k) {
      of_face.cell.push_back(k);
      rows.X.push_back(spatial<D>(at(cells.centre, k)));
      if (!components.empty() && components.front() == "normal") {
        rows.rows.push_back({k, spatial<D>(at(cells.normal, k)).normalized()});
        continue;
      }
      for (int i = 0; i < D; ++i)
        if (has_component(i)) rows.rows.push_back({k, Eigen::Vector3d::Unit(i)});
    }
    return of_face;
  }
  /// The rows of a body of revolution. The components of a face cell have weights of their own, and
  /// so each is a place. On the axis, there is no component across it.
  FaceRows folded_rows_of(const FaceCells<D>& cells, const Body<D>& body) const {
    const bool normal = !components.empty() && components.front() == "normal";
    const PointRows<D>& mean = cells.mean;
    FaceRows of_face;
    ConstraintRows& rows = of_face.rows;
    const auto add = [&](Index k, const UnsetVector<Real>& weight,
                         const Eigen::Vector3d& direction) {
      for (Offset e = at(mean.start, k); e < at(mean.start, k + 1); ++e) {
        rows.particle.push_back(body.first + at(mean.particle, e));
        rows.weight.push_back(at(weight, e));
      }
      rows.start.push_back(static_cast<Offset>(rows.weight.size()));
      rows.rows.push_back({static_cast<Index>(rows.X.size()), direction});
      rows.X.push_back(spatial<D>(at(cells.centre, k)));
      of_face.cell.push_back(k);
    };
    for (Index k = 0; k < cells.size(); ++k) {
      const Vec<D> n = at(cells.normal, k).normalized();
      constexpr Real round_off = 1e-9;
      const bool along = std::abs(n[0]) < round_off, across = std::abs(n[1]) < round_off;
      if (normal && !along && !across)
        throw InputError(
            fmt::format("{}: the normal is ({:.4g}, {:.4g}) at ({:.4g}, {:.4g}); in a body of "
                        "revolution normals can be held where they are along x or y; allowed are "
                        "components of these",
                        this->place, n[0], n[1], at(cells.centre, k)[0], at(cells.centre, k)[1]));
      if ((normal ? across : has_component(0)) && !body.on_axis(at(cells.cell, k)))
        add(k, mean.odd_value, {1, 0, 0});
      if (normal ? along : has_component(1)) add(k, mean.value, {0, 1, 0});
    }
    return of_face;
  }
  /// `cell` has the number of the face cell of each place.
  void measure(Assembly<D>& assembly, const Constraint& held, const FaceCells<D>& cells,
               const std::vector<Index>& cell) const {
    const bool revolved = assembly.body(face.body).geometry.grid.revolved;
    const ReactionSums sums{&held, spatial<D>(Vec<D>::Map(centre.data()))};
    const Dimension of_force = of_sum(dimension::force, D), torque = of_sum(dimension::energy, D);
    for (int i = revolved ? 1 : 0; i < D; ++i)
      assembly.measure(label(), {fmt::format("force_{}", "xyz"[i]), of_force,
                                 "force by which the face is held, on the body",
                                 [=](const Motion& motion) { return sums.force(motion)[i]; }});
    for (int i = D == 3 ? 0 : 2; i < 3 && !revolved; ++i)
      assembly.measure(label(), {fmt::format("torque_{}", "xyz"[i]), torque,
                                 "torque of these forces about the centre",
                                 [=](const Motion& motion) { return sums.torque(motion)[i]; }});
    for (int i = 0; i < D; ++i) {
      // In a body of revolution, a place has the weights of one component.
      std::vector<Real> area;
      for (Index k = 0; k < held.rows.places(); ++k)
        area.push_back(
            !revolved || at(held.rows.rows, k).direction[i] != 0 ? at(cells.area, at(cell, k)) : 0);
      if (std::all_of(area.begin(), area.end(), [](Real a) { return a == 0; })) continue;
      assembly.measure(label(), {fmt::format("displacement_{}", "xyz"[i]), dimension::length,
                                 "mean over the face", [of = &held, area, i](const Motion& motion) {
                                   return mean_displacement(of->rows, area, motion.u)[i];
                                 }});
    }
    assembly.measure(label(), {"work", of_sum(dimension::energy, D), "work of these forces so far",
                               [=](const Motion& motion) { return sums.work(motion); }});
  }
};

const bool registered =
    register_load<Held>("held", Stage::surface, "a face that is held, or moved");

}  // namespace
}  // namespace meniscus::held_table
