// SPDX-License-Identifier: BSD-3-Clause
// Archives return the values written to them, for every object that keeps values. A run continued
// in the middle has the same bits.
#include "meniscus/error.hpp"
#include "one_body.hpp"
#include "run/simulation.hpp"
#include "solve/step/central_difference.hpp"
#include "state/archive.hpp"
#include "unit/io_helpers.hpp"

#include <gtest/gtest.h>

#include <cstring>

namespace meniscus::test_archive {
namespace {

/// One value of every type.
struct Everything {
  Real number = 0;
  std::int64_t count = 0;
  bool flag = false;
  std::string text;
  std::optional<Real> some, none = 3;
  Eigen::Vector3d vector = Eigen::Vector3d::Zero();
  std::map<std::string, Real> energies{{"strain", 0}, {"surface", 0}};
  std::vector<Real> list = std::vector<Real>(3);
  NodalVectors field = NodalVectors(2, Lanes::zero());

  void archive(const Archive& a) {
    a("number", number, dimension::length);
    a("count", count);
    a("flag", flag);
    a("text", text);
    a("some", some);
    a("none", none);
    const Archive part = a.in("part");
    part("vector", vector);
    part("energies", energies);
    part("list", list);
    part("field", field, 2, dimension::velocity);
  }
};

Everything filled() {
  return {0.1,          -7,
          true,         "drop",
          2.5,          std::nullopt,
          {1, -0.0, 3}, {{"strain", 4}, {"surface", 5}},
          {6, 7, 8},    {Lanes(1, 2, 0, 0), Lanes(3, 4, 0, 0)}};
}

Snapshot snapshot_of(Everything object) {
  Snapshot s;
  object.archive(Archive::writing(s, [](Dimension d) { return UnitSystem("SI").symbol(d); }));
  return s;
}

TEST(Archive, KeepsEveryTypeOfValue) {
  const Snapshot s = snapshot_of(filled());
  Everything read;
  read.archive(Archive::reading(s));
  EXPECT_EQ(read.number, 0.1);
  EXPECT_EQ(read.count, -7);
  EXPECT_TRUE(read.flag);
  EXPECT_EQ(read.text, "drop");
  EXPECT_EQ(read.some, 2.5);
  EXPECT_EQ(read.none, std::nullopt);
  EXPECT_EQ(read.vector[2], 3);
  EXPECT_EQ(read.energies.at("surface"), 5);
  EXPECT_EQ(read.list, (std::vector<Real>{6, 7, 8}));
  EXPECT_EQ(read.field[1][1], 4);
  EXPECT_EQ(snapshot_of(read).hash(), s.hash());
  EXPECT_EQ(s.arrays().at("number").unit, "m");
  EXPECT_EQ(s.arrays().at("part/field").unit, "m/s");
}

TEST(Archive, NamesWhatIsAbsentOrOfAnotherSize) {
  Snapshot s = snapshot_of(filled());
  Everything other;
  other.energies["contact"] = 0;
  EXPECT_THROW_WITH(other.archive(Archive::reading(s)), FileError, "part/energies/contact");
  Everything longer;
  longer.field.resize(3);
  EXPECT_THROW_WITH(longer.archive(Archive::reading(s)), FileError, "part/field");
  EXPECT_THROW_WITH(Everything().archive(Archive::reading(Snapshot())), FileError, "number");
  EXPECT_THROW_WITH(filled().archive(Archive::writing(s)), std::logic_error, "number");
  EXPECT_TRUE(Archive::reading(s).has("part"));
  EXPECT_FALSE(Archive::reading(s).has("par"));
}

/// A load with a history: a force -k (x - centre) on the coefficients along x. The centre stays
/// within 0.05 of the farthest position so far.
class Ratchet final : public ForceTerm {
 public:
  explicit Ratchet(Index size) : centre_(static_cast<std::size_t>(size), 0.0) {}
  std::string name() const override { return "ratchet"; }
  Report add_force(const Motion& motion, Forces force) override {
    for (std::size_t A = 0; A < centre_.size(); ++A)
      force[A] += Lanes(0.2 * (centre_[A] - motion.u[A][0]), 0, 0, 0);
    return {};
  }
  void commit(const Motion& motion) override {
    for (std::size_t A = 0; A < centre_.size(); ++A)
      centre_[A] = std::max(centre_[A], motion.u[A][0] - 0.05);
  }
  void archive(const Archive& a) override { a("centre", centre_, dimension::length); }

 private:
  std::vector<Real> centre_;
};

template <int D>
struct Trial {
  Scene<D> scene;
  Simulation<D> simulation;

  explicit Trial(const std::string& text) : scene(read(text)), simulation(scene) {}
  static Scene<D> read(const std::string& text) {
    const SceneInput input = SceneInput::from_text(text);
    EXPECT_EQ(scene_dimension(input), D);
    Scene<D> scene = build_scene<D>(input);
    scene.system.terms.push_back(std::make_unique<Ratchet>(scene.system.size()));
    return scene;
  }
  void go(int steps) {
    for (int k = 0; k < steps; ++k) simulation.advance();
  }
};

/// A new program continues a run stopped in the middle. Its archive is identical to the original
/// one, both then and at the end.
template <int D>
void expect_continuation(const std::string& text) {
  constexpr int steps = 30;
  Trial<D> straight(text), continued(text);
  straight.simulation.begin();
  straight.go(steps);
  Snapshot middle = straight.simulation.snapshot();
  middle.require_finite();
  continued.simulation.restore(middle);
  EXPECT_EQ(continued.simulation.snapshot().hash(), middle.hash());
  straight.go(steps);
  continued.go(steps);
  EXPECT_EQ(continued.simulation.snapshot().hash(), straight.simulation.snapshot().hash());
  EXPECT_NE(straight.simulation.snapshot().hash(), middle.hash());
}

std::string body(int dimension, const std::string& name, Real x, const std::string& material) {
  const std::string shape =
      dimension == 3 ? "shape = \"ball\"\nradius = 1\ncore = 2\nlayers = 1\ncentre = [{}, 0, 0]\n"
                       "initial_velocity = [\"0.3 - 0.1*x\", \"0.2*x\", 0]\n"
                     : "shape = \"disk\"\nradius = 1\ncore = 2\nrings = 2\ncentre = [{}, 0]\n"
                       "initial_velocity = [\"0.3 - 0.1*x\", \"0.2*x\"]\n";
  return "[[body]]\nname = \"" + name + "\"\n" + fmt::format(fmt::runtime(shape), x) +
         "material = { " + material + " }\n";
}

const std::string liquid = "type = \"newtonian\", density = 1, bulk_modulus = 20, viscosity = 0.3";
const std::string solid = "type = \"neo_hookean\", density = 1, mu = 2, lambda = 3";

std::string heading(int dimension, const std::string& time = "") {
  return "dimension = " + std::to_string(dimension) + "\n[time]\nend = 100\ncheck_every = 8\n" +
         time;
}

TEST(Archive, EveryLoadGoesOnInTheMiddle) {
  for (const std::string form : {"weak", "curvature", "triangles"}) {
    const std::string tension =
        "[[surface_tension]]\nbody = \"one\"\ngamma = 1\nform = \"" + form + "\"\n";
    expect_continuation<2>(heading(2) + body(2, "one", 0, liquid) + tension);
    expect_continuation<3>(heading(3) + body(3, "one", 0, liquid) + tension);
  }
  expect_continuation<2>(heading(2) + body(2, "one", 0, solid) +
                         "[[body_force]]\nbody = \"one\"\nacceleration = [\"sin(t)*x\", -0.1]\n");
  expect_continuation<2>(heading(2) + body(2, "one", 0, solid) + body(2, "two", 2.4, liquid) +
                         "[[contact]]\nbodies = [\"one\", \"two\"]\nepsilon = 1\nsigma0 = 0.3\n"
                         "beta = 1\n[[contact]]\nbodies = [\"one\"]\nepsilon = 1\nsigma0 = 0.3\n"
                         "beta = 1\npartner = { type = \"half_space\", point = [0, -1.4], normal = "
                         "[0, 1], displacement = [0, \"0.01*t\"] }\n");
}

TEST(Archive, ARelaxationGoesOnInTheMiddle) {
  const std::string relax = heading(3, "solver = \"relax\"\n");
  expect_continuation<3>(relax + body(3, "one", 0, solid));
  expect_continuation<3>(
      relax +
      "[[body]]\nname = \"cell\"\nshape = \"sphere_shell\"\nradius = 1\nthickness = 0.25\n"
      "spacing = 0.5\nmaterial = { " +
      solid +
      " }\n[[cavity]]\nbody = \"cell\"\nvolume_target = 0.9\npenalty = 10\nramp = [0, 0.5]\n");
}

/// A state that dynamics has saved can be continued by relaxation.
TEST(Archive, AMotionMayGoOnAsARelaxation) {
  const std::string drop = body(2, "one", 0, liquid);
  Trial<2> motion(heading(2) + drop), relaxed(heading(2, "solver = \"relax\"\n") + drop);
  motion.simulation.begin();
  motion.go(10);
  relaxed.simulation.restore(motion.simulation.snapshot());
  EXPECT_EQ(relaxed.simulation.state().step, 10);
  relaxed.go(1);
  EXPECT_EQ(relaxed.simulation.state().step, 11);
}

TEST(Archive, ASnapshotOfAnotherSceneIsRefused) {
  Trial<2> one(heading(2) + body(2, "one", 0, liquid)),
      under_tension(heading(2) + body(2, "one", 0, liquid) +
                    "[[surface_tension]]\nbody = \"one\"\ngamma = 1\n"),
      two(heading(2) + body(2, "one", 0, liquid) + body(2, "two", 3, liquid));
  one.simulation.begin();
  const Snapshot snapshot = one.simulation.snapshot();
  EXPECT_THROW_WITH(two.simulation.restore(snapshot), FileError, "displacement");
  EXPECT_THROW_WITH(under_tension.simulation.restore(snapshot), FileError, "audit/initial_stored");
}

}  // namespace
}  // namespace meniscus::test_archive
