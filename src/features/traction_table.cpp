// SPDX-License-Identifier: BSD-3-Clause
// A force per area on a face.
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
  std::vector<Expression> force;
  std::optional<Expression> pressure;
  Ramp ramp;

  static Rows<Traction> rows() {
    Rows<Traction> rows = face_rows<Traction>(&Traction::face);
    rows.insert(
        rows.begin(),
        text_row("name", &Traction::name,
                 "by which messages and measures call it; empty: the body and the face", ""));
    const std::vector<Row<Traction>> own = {
        optional_expressions_row("force", &Traction::force, D, dimension::pressure,
                                 Variables::place_and_time,
                                 "per reference area, whatever becomes of the surface; a formula "
                                 "of reference position and time t for each component"),
        optional_expression_row("pressure", &Traction::pressure, dimension::pressure, range::any,
                                "none",
                                "per present area, against the surface and following it; a formula "
                                "of reference position and time; either this or force"),
        ramp_row("ramp", &Traction::ramp, "force or pressure from 0")};
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
    if (force.empty() != pressure.has_value())
      block.problem("force", "allowed is either force or pressure, not both or neither");
  }
  void prepare(BodyPlans<D>& bodies) const override { face.prepare(bodies); }
  void build(Assembly<D>& assembly) const override {
    const Body<D>& body = assembly.body(face.body);
    FaceCells<D> cells = face.cells(this->place, body);
    assembly.note(fmt::format(
        "traction '{}': on {:.4g} {} of body '{}'", label(), cells.total_area(),
        assembly.units().symbol(D == 3 ? dimension::area : dimension::length), body.name));
    assembly.keep_reference(face.body, "its [[traction]] knows the faces of its shape only");
    assembly.add(pressure ? face_pressure(body, label(), std::move(cells), *pressure, ramp,
                                          assembly.held(face.body))
                          : traction(body, label(), std::move(cells), force, ramp),
                 label());
  }
};

const bool registered = register_load<Traction>("traction", Stage::surface,
                                                "a force per area, or a pressure, on a face");

}  // namespace
}  // namespace meniscus::traction_table
