// SPDX-License-Identifier: BSD-3-Clause
// A force on a face, or a pressure.
#include "input/optional_rows.hpp"
#include "meniscus/scene/assembly.hpp"
#include "physics/loads/traction.hpp"
#include "scene/face_keys.hpp"

#include <fmt/core.h>

namespace meniscus::traction_table {
namespace {

template <int D>
struct Traction final : Load<D> {
  static constexpr std::string_view example =
      "body = \"drop\"\nwhere = \"y < -0.5\"\npressure = \"0.1*(1 + x)*cos(t)\"\n";
  std::string name;
  FaceKeys face;
  std::vector<Expression> force, total;
  std::optional<Expression> pressure;
  Ramp ramp;

  static Rows<Traction> rows() {
    Rows<Traction> rows = face_rows<Traction>(&Traction::face);
    rows.insert(
        rows.begin(),
        text_row(
            "name", &Traction::name,
            "name of the table in messages and measures; empty: name of the body, then of the face",
            ""));
    const std::vector<Row<Traction>> own = {
        optional_expressions_row(
            "force", &Traction::force, D, dimension::pressure, Variables::place_and_time,
            "force per area of the reference; it does not change with the area; a formula of "
            "reference position and time t for each component"),
        optional_expressions_row("total", &Traction::total, D, of_sum(dimension::force, D),
                                 Variables::time,
                                 "total force, spread evenly over the face of the reference; a "
                                 "formula of time t for each component"),
        optional_expression_row(
            "pressure", &Traction::pressure, dimension::pressure, range::any, "none",
            "pressure per present area, against the surface, which it follows; a formula of "
            "reference position and time; give one of force, total and pressure"),
        ramp_row("ramp", &Traction::ramp, "force, total or pressure from 0")};
    rows.insert(rows.end(), own.begin(), own.end());
    return rows;
  }
  std::string label() const { return name.empty() ? face.label() + "-traction" : name; }
  std::optional<typename Load<D>::Identity> identity() const override {
    return {{"name", label()}};
  }

  void check(const Block& block, const BodyPlans<D>& bodies) const override {
    require_plain_name(block, name);
    face.check(block, bodies);
    if (!force.empty() + !total.empty() + pressure.has_value() != 1)
      block.problem("force", "allowed is one of force, total and pressure");
    const bool revolved = !bodies.empty() && bodies.front().geometry.grid.revolved;
    if (revolved && !total.empty() && !(total[0].constant() && total[0]({0, 0, 0}) == 0))
      block.problem("total", "acts across the axis of revolution; allowed is 0 for x");
  }
  void prepare(BodyPlans<D>& bodies) const override { face.prepare(bodies); }
  void build(Assembly<D>& assembly) const override {
    const Body<D>& body = assembly.body(face.body);
    FaceCells<D> cells = face.cells(this->place, body);
    const Real factor = total.empty() ? 1 : 1 / cells.total_area();
    assembly.note(fmt::format("traction '{}': on {:.4g} {} of body '{}'", label(),
                              cells.total_area(),
                              assembly.units().symbol(of_sum(dimension::area, D)), body.name));
    assembly.keep_reference(face.body, "its [[traction]] knows the faces of its shape only");
    assembly.add(pressure ? face_pressure(body, label(), std::move(cells), *pressure, ramp,
                                          assembly.held(face.body))
                          : traction(body, label(), std::move(cells), total.empty() ? force : total,
                                     ramp, factor),
                 label());
  }
};

const bool registered =
    register_load<Traction>("traction", Stage::surface, "a force, or a pressure, on a face");

}  // namespace
}  // namespace meniscus::traction_table
