// SPDX-License-Identifier: BSD-3-Clause
// Demonstration: a load in one file, without a change elsewhere. Springs hold the particles at
// their initial places; the tests of everything registered find it.
#include "meniscus/scene/assembly.hpp"

namespace meniscus::demo_load {
namespace {

/// f_A = -k m_A u_A, the gradient of E = sum k m_A u_A^2 / 2.
template <int D>
class Springs final : public ForceTerm {
 public:
  Springs(const Body<D>& body, Real stiffness) : body_(body), stiffness_(stiffness) {}

  std::string name() const override { return "springs of '" + body_.name + "'"; }
  std::string_view energy_kind() const override { return "springs"; }
  Report add_force(const Motion& motion, Forces force) override {
    for (Index A = 0; A < body_.size(); ++A)
      at(force, body_.first + A) -= stiffness_ * at(body_.mass, A) * at(motion.u, body_.first + A);
    return {};
  }
  std::optional<Real> stored_energy(const Motion& motion) const override {
    return parallel_sum(body_.size(), 0.0, [&](Index A) {
      const Lanes u = at(motion.u, body_.first + A);
      return 0.5 * stiffness_ * at(body_.mass, A) * sum(u * u);
    });
  }
  std::vector<FieldSource> fields() const override {
    return {{"demo_stretch", 1, dimension::length, "displacement coefficient along x",
             [this](const Motion& motion, std::span<Real> out) {
               for (Index A = 0; A < body_.size(); ++A)
                 at(out, A) = at(motion.u, body_.first + A)[0];
             }}};
  }

 private:
  const Body<D>& body_;
  Real stiffness_;
};

template <int D>
struct DemoSprings final : Load<D> {
  static constexpr std::string_view example = "body = \"drop\"\nstiffness = 2\n";
  std::string body;
  Real stiffness = 0;

  static Rows<DemoSprings> rows() {
    return {text_row("body", &DemoSprings::body, "name of the body"),
            real_row("stiffness", &DemoSprings::stiffness, {0, -2, 0}, range::positive,
                     "force per displacement and mass")};
  }
  void check(const Block& block, const BodyPlans<D>& bodies) const override {
    require_body(block, bodies, body);
  }
  void build(Assembly<D>& assembly) const override {
    assembly.add(std::make_unique<Springs<D>>(assembly.body(body), stiffness), body);
  }
};

const bool registered =
    register_load<DemoSprings>("demo_springs", Stage::volume, "demonstration: springs");

}  // namespace
}  // namespace meniscus::demo_load
