// SPDX-License-Identifier: BSD-3-Clause
// Viscosity of a solid (Kelvin-Voigt).
#include "meniscus/scene/assembly.hpp"
#include "physics/internal/solid_viscosity.hpp"

namespace meniscus::solid_viscosity_table {
namespace {

template <int D>
struct SolidViscosity final : Load<D> {
  static constexpr std::string_view example = "body = \"other\"\nshear = 0.2\nvolumetric = 0.1\n";
  std::string body;
  Real shear = 0, volumetric = 0;

  static Rows<SolidViscosity> rows() {
    return {text_row("body", &SolidViscosity::body, "name of the solid"),
            real_row("shear", &SolidViscosity::shear, dimension::viscosity, range::non_negative,
                     "eta of the stress 2 eta E' + zeta tr(E') I, E' the rate of the Green strain"),
            real_row("volumetric", &SolidViscosity::volumetric, dimension::viscosity,
                     range::non_negative, "zeta of that stress", 0.0)};
  }
  std::optional<typename Load<D>::Identity> identity() const override { return {{"body", body}}; }
  void check(const Block& block, const BodyPlans<D>& bodies) const override {
    require_body(block, bodies, body);
    if (shear + volumetric == 0)
      block.problem("shear", "is 0 and so is volumetric; allowed is > 0");
  }
  void build(Assembly<D>& assembly) const override {
    assembly.keep_reference(body, "its [[solid_viscosity]] depends on the strain of the reference");
    assembly.add(solid_viscosity(assembly.body(body), shear, volumetric), body);
  }
};

const bool registered = register_load<SolidViscosity>(
    "solid_viscosity", Stage::volume, "viscous stress beside that of a material (Kelvin, Voigt)");

}  // namespace
}  // namespace meniscus::solid_viscosity_table
