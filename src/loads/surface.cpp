// SPDX-License-Identifier: BSD-3-Clause
// A surface law on the whole surface of a body.
#include "meniscus/physics/surface_registry.hpp"
#include "meniscus/scene/assembly.hpp"

namespace meniscus::surface_load {
namespace {

struct Keys {
  std::string body;
  int points = 3;
  std::unique_ptr<const SurfaceMaterial> law;

  static Rows<Keys> rows() {
    return {text_row("body", &Keys::body, "name of the body whose surface it is"),
            integer_row("points", &Keys::points, {1, 8},
                        "Gauss points per direction and surface facet", 3)};
  }
  /// [surface.law]
  void read_inner(const Block& block) {
    const auto table = block.table("law", true);
    if (!table) return;
    const auto type = table->kind("type", surface_laws().names());
    if (type) law = surface_laws().at(*type).read(*table);
    table->done();
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
  std::optional<typename Load<D>::Identity> identity() const override { return {{"body", body}}; }
  std::string claim() const override { return "the surface of '" + body + "'"; }
  void check(const Block& block, const BodyPlans<D>& bodies) const override {
    require_body(block, bodies, body);
  }
  void build(Assembly<D>& assembly) const override {
    assembly.add(law->build(assembly.body(body), points), body);
    assembly.set_surface_energy(body, law->energy_at_rest());
    assembly.keep_reference(body, "its [[surface]] has an energy per area of the reference");
  }
};

const bool registered = register_load<Surface>("surface", Stage::surface,
                                               "the whole surface of a body by a law of its own");

}  // namespace
}  // namespace meniscus::surface_load
