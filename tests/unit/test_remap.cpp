// SPDX-License-Identifier: BSD-3-Clause
// Remaps of bodies: quantities that stay exactly the same, that stay to round-off, and the order of
// the other errors.
#include "cases.hpp"
#include "meniscus/error.hpp"
#include "nematic_scenes.hpp"
#include "parallel/nodal_algebra.hpp"
#include "remap/nodal_values.hpp"
#include "remap/present_surface.hpp"
#include "run/epochs.hpp"
#include "thrown.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace meniscus {
namespace {

/// A drop of fluid under balanced tension in motion, with `n` cells along the edges of its core.
template <int D>
std::string drop(int n, const std::string& displacement, const std::string& velocity,
                 const std::string& more = "") {
  return fmt::format(R"toml(
dimension = {}
[time]
end = 1e3
check_every = 20
[[body]]
name = "drop"
shape = "{}"
radius = 1
core = {}
{} = {}
initial_displacement = [{}]
initial_velocity = [{}]
material = {{ type = "newtonian", density = 1, bulk_modulus = 20, viscosity = 0.3 }}
[[surface_tension]]
body = "drop"
gamma = 1
{})toml",
                     D, D == 3 ? "ball" : "disk", n, D == 3 ? "layers" : "rings", n / 2,
                     displacement, velocity, more);
}

template <int D>
Epochs<D> begun(const std::string& text) {
  const SceneInput input = SceneInput::from_text(text);
  scene_dimension(input);
  Epochs<D> epochs(read_plan<D>(input));
  epochs.simulation().begin();
  return epochs;
}

const char* no_displacement(int D) {
  return D == 3 ? "'0', '0', '0'" : "'0', '0'";
}
const char* shear_and_stretch(int D) {
  return D == 3 ? "'0.3*x - y + 0.1*y*z', 'x*y - 0.2*y', 'sin(2*z)'" : "'0.3*x - y', 'x*y - 0.2*y'";
}
/// A displacement that is not affine, with J between 0.8 and 1.2.
const char* bend(int D) {
  return D == 3 ? "'0.1*sin(2*y)', '0.08*cos(2*x)*y', '0.07*x*z'"
                : "'0.1*sin(2*y)', '0.08*cos(2*x)*y'";
}

template <int D>
std::vector<Vec<D>> nodes_of(const Epochs<D>& epochs) {
  const Body<D>& body = epochs.scene().system.bodies.front();
  return places(body, epochs.simulation().state().u.data() + body.first);
}

Real largest_change(const NodalVectors& a, const NodalVectors& b) {
  Real largest = 0;
  for (std::size_t A = 0; A < a.size(); ++A)
    largest = std::max(largest, std::sqrt(sum((a[A] - b[A]) * (a[A] - b[A]))));
  return largest;
}

template <int D>
Ledger ledger_of(const Epochs<D>& epochs) {
  return take_ledger(epochs.scene().system, epochs.simulation().state());
}

void expect_equal_energies(const Ledger& a, const Ledger& b, Real tolerance) {
  EXPECT_NEAR(a.kinetic, b.kinetic, tolerance * a.kinetic);
  for (const auto& [kind, energy] : a.stored)
    EXPECT_NEAR(energy, b.stored.at(kind), tolerance * std::max(std::abs(energy), a.kinetic))
        << kind;
}

/// A remap of a moving body at u = 0 changes nothing.
template <int D>
void expect_identity() {
  Epochs<D> epochs = begun<D>(drop<D>(4, no_displacement(D), shear_and_stretch(D)));
  const State before = epochs.simulation().state();
  const Ledger ledger = ledger_of(epochs);
  epochs.new_epoch({{"drop", nodes_of(epochs)}});
  const State& after = epochs.simulation().state();
  EXPECT_EQ(after.epoch, 1);
  EXPECT_LT(largest_change(after.u, before.u), 1e-14);
  EXPECT_LT(largest_change(after.v, before.v), 1e-13 * largest(before.v));
  EXPECT_LT(largest_change(after.force, before.force), 1e-12 * largest(before.force));
  EXPECT_LT(std::abs(after.books.remapped), 1e-13 * ledger.kinetic);
  expect_equal_energies(ledger, ledger_of(epochs), 1e-13);
}

TEST(Remap, OntoTheOwnReferenceIsTheIdentity) {
  expect_identity<2>();
  expect_identity<3>();
}

/// A position that is NaN or infinite is refused by every search of neighbours.
template <int D>
void expect_finite_places() {
  Epochs<D> epochs = begun<D>(drop<D>(4, bend(D), no_displacement(D)));
  const Body<D>& body = epochs.scene().system.bodies.front();
  const NodalVector* u = epochs.simulation().state().u.data();
  Vec<D> nowhere = Vec<D>::Zero();
  nowhere[D - 1] = std::nan("");
  const PresentSurface<D> surface(body, u);
  for (const Real x : {std::nan(""), std::numeric_limits<Real>::infinity()}) {
    nowhere[D - 1] = x;
    EXPECT_THROW(surface.nearest(nowhere, 0), SolveError);
  }
  nowhere[D - 1] = std::nan("");
  EXPECT_THROW(pre_images<D>(body, u, std::vector<Vec<D>>{nowhere}), SolveError);
  std::vector<Vec<D>> nodes = nodes_of(epochs);
  nodes[3] = nowhere;
  EXPECT_THROW(epochs.new_epoch({{"drop", nodes}}), SolveError);
  EXPECT_EQ(epochs.simulation().state().epoch, 0);
}

TEST(Remap, RefusesPlacesThatAreNotNumbers) {
  expect_finite_places<2>();
  expect_finite_places<3>();
}

/// Two remaps of a body that is rotated and dilated. In the second remap J_0 differs from 1, and
/// the surface is recovered from facets.
TEST(Remap, OntoThePresentConfigurationOfABodyThatIsOnlyTurnedAndLarger) {
  const char* turned = "'1.1*(0.8*x - 0.6*y) - x', '1.1*(0.6*x + 0.8*y) - y'";
  Epochs<2> epochs = begun<2>(drop<2>(6, turned, shear_and_stretch(2)));
  epochs.new_epoch({{"drop", nodes_of(epochs)}});
  for (const Real J : epochs.scene().system.bodies.front().reference->volume_ratio)
    EXPECT_NEAR(J, 1.21, 1e-3);
  const State before = epochs.simulation().state();
  const Ledger ledger = ledger_of(epochs);
  epochs.new_epoch({{"drop", nodes_of(epochs)}});
  const State& after = epochs.simulation().state();
  EXPECT_EQ(after.epoch, 2);
  EXPECT_LT(largest_change(after.v, before.v), 1e-12 * largest(before.v));
  EXPECT_LT(largest_change(after.force, before.force), 1e-10 * largest(before.force));
  EXPECT_LT(std::abs(after.books.remapped - before.books.remapped), 1e-12 * ledger.kinetic);
}

/// Relative errors of a remap of a bent drop: energies, and velocities at material points.
struct Errors {
  Real stored, surface, kinetic, velocity;
};

template <int D>
Errors errors(int n) {
  Epochs<D> epochs = begun<D>(drop<D>(n, bend(D), shear_and_stretch(D)));
  const System<D>& old = epochs.scene().system;
  const State before = epochs.simulation().state();
  const Ledger ledger = ledger_of(epochs);
  // Interior nodes are shifted by a third of a spacing, smoothly.
  std::vector<Vec<D>> x = nodes_of(epochs);
  const std::vector<Index> boundary = boundary_nodes(old.bodies.front().geometry.grid);
  const Real spacing = mean_spacing(old.bodies.front().geometry.grid);
  for (Index A = 0; A < old.size(); ++A) {
    if (std::binary_search(boundary.begin(), boundary.end(), A)) continue;
    const Vec<D> place = at(x, A);
    at(x, A)[0] += 0.3 * spacing * std::cos(3 * place[1]);
    at(x, A)[1] += 0.3 * spacing * std::sin(3 * place[0]);
  }
  const std::vector<Vec<D>> X = pre_images<D>(old.bodies.front(), before.u.data(), x);
  const NodalVectors v_before =
      values_at(build_point_rows<D>(old.bodies.front().particles, X, {.value = true}, "drop"),
                before.v.data());
  epochs.new_epoch({{"drop", x}});
  const Ledger now = ledger_of(epochs);
  const State& after = epochs.simulation().state();
  // Momenta are exact whatever the grid.
  EXPECT_LT((now.momentum - ledger.momentum).norm(), 1e-13 * std::sqrt(ledger.kinetic));
  EXPECT_LT((now.angular_momentum - ledger.angular_momentum).norm(),
            1e-13 * std::sqrt(ledger.kinetic));
  EXPECT_NEAR(now.balance(), ledger.balance(), 1e-12 * ledger.kinetic);
  const NodalVectors v =
      values_at(epochs.scene().system.bodies.front().at_particles, after.v.data());
  Errors e;
  e.velocity = largest_change(v, v_before) / largest(v_before);
  e.kinetic = std::abs(now.kinetic / ledger.kinetic - 1);
  e.surface = std::abs(now.stored.at("surface") / ledger.stored.at("surface") - 1);
  e.stored = std::abs(now.stored.at("strain") / ledger.stored.at("strain") - 1);
  return e;
}

/// Prints and returns the order of an error between two grids with this ratio of spacings.
Real order(const std::string& of, Real ratio, Real coarse, Real fine) {
  const Real p = std::log(coarse / fine) / std::log(ratio);
  fmt::print("remap of a bent drop, {}: {:.2e}, {:.2e}, order {:.2f}\n", of, coarse, fine, p);
  return p;
}

template <int D>
void expect_convergence(int n, int finer) {
  const Errors coarse = errors<D>(n), fine = errors<D>(finer);
  const Real ratio = static_cast<Real>(finer) / n;
  const auto of = [](const char* what) { return fmt::format("{}D, {}", D, what); };
  EXPECT_GT(order(of("strain energy"), ratio, coarse.stored, fine.stored), 2.5);
  EXPECT_GT(order(of("surface energy"), ratio, coarse.surface, fine.surface), 2.5);
  EXPECT_GT(order(of("kinetic energy"), ratio, coarse.kinetic, fine.kinetic), 1.2);
  EXPECT_GT(order(of("velocity"), ratio, coarse.velocity, fine.velocity), 2.5);
}

TEST(Remap, OntoAShiftedGridConverges) {
  expect_convergence<2>(8, 16);
  expect_convergence<3>(4, 6);
}

/// Stored energy of all terms at u + s w.
template <int D>
Real energy_along(Epochs<D>& epochs, const NodalVectors& w, Real s) {
  State state = epochs.simulation().state();
  for (std::size_t A = 0; A < w.size(); ++A) state.u[A] += s * w[A];
  Real energy = 0;
  for (const auto& [kind, part] : take_ledger(epochs.scene().system, state).stored) energy += part;
  return energy;
}

/// The reference has a different J_0 in each cell, and the pressure works on the enclosed volume.
TEST(Remap, LeavesForcesThatAreTheGradientOfTheEnergyAndTheStableStep) {
  Epochs<3> epochs = begun<3>(drop<3>(4, bend(3), no_displacement(3)));
  const Real step = epochs.simulation().controller().stable().dt;
  epochs.new_epoch({{"drop", nodes_of(epochs)}});
  const State& state = epochs.simulation().state();
  NodalVectors w;
  for (std::size_t A = 0; A < state.u.size(); ++A) {
    const Real a = static_cast<Real>(A);
    w.push_back({std::sin(3 * a), std::cos(5 * a), std::sin(7 * a + 1), 0});
  }
  constexpr Real h = 1e-5;
  const Real slope = (energy_along(epochs, w, h) - energy_along(epochs, w, -h)) / (2 * h);
  Real work = 0, size = 0;
  for (std::size_t A = 0; A < w.size(); ++A) {
    work += sum(state.force[A] * w[A]);
    size += std::sqrt(sum(state.force[A] * state.force[A]));
  }
  EXPECT_NEAR(slope, -work, 1e-7 * size);
  EXPECT_NEAR(epochs.simulation().controller().stable().dt / step, 1, 0.2);
}

TEST(Remap, ThatFoldsIsRefusedAndTheOldEpochGoesOn) {
  Epochs<3> epochs = begun<3>(drop<3>(4, bend(3), shear_and_stretch(3)));
  const std::uint64_t before = epochs.simulation().snapshot().hash();
  std::vector<Vec<3>> x = nodes_of(epochs);
  std::swap(x[0], x[x.size() / 2]);
  EXPECT_THROW_WITH(epochs.new_epoch({{"drop", x}}), InputError, "has an edge or corner at node 0");
  x = nodes_of(epochs);
  for (Vec<3>& place : x) place *= 3;  // where there is no material
  EXPECT_THROW(epochs.new_epoch({{"drop", x}}), SolveError);
  EXPECT_EQ(epochs.simulation().snapshot().hash(), before);
  EXPECT_EQ(epochs.simulation().state().epoch, 0);
  epochs.advance();
}

/// Restarts from a state of each of three epochs give the same bits; so does a return to earlier
/// states.
void expect_same_bits(const std::string& text, Real end) {
  Epochs<2> epochs = begun<2>(text);
  std::vector<Snapshot> states;
  std::vector<std::int64_t> of_epoch;
  int remaps = 0;
  while (epochs.simulation().state().time < end) {
    remaps += epochs.advance().new_epoch;
    states.push_back(epochs.simulation().snapshot());
    of_epoch.push_back(epochs.simulation().state().epoch);
  }
  EXPECT_EQ(remaps, 2);
  EXPECT_EQ(of_epoch.back(), 2);
  const SceneInput input = SceneInput::from_text(text);
  scene_dimension(input);
  for (const std::size_t k : {std::size_t{0}, states.size() / 2, states.size() - 2}) {
    Epochs<2> restarted(read_plan<2>(input), &states[k]);
    EXPECT_EQ(restarted.simulation().snapshot().hash(), states[k].hash());
    for (std::size_t l = k + 1; l < states.size(); ++l) restarted.advance();
    EXPECT_EQ(restarted.simulation().snapshot().hash(), states.back().hash());
    epochs.restore(states[k]);
    EXPECT_EQ(epochs.simulation().snapshot().hash(), states[k].hash());
  }
}

TEST(Remap, GoesOnWithTheSameBitsFromAStateOfAnyEpoch) {
  expect_same_bits(
      drop<2>(6, bend(2), shear_and_stretch(2), "[[remap]]\nbody = \"drop\"\nat = [0.04, 0.1]\n"),
      0.2);
}

/// A moving nematic drop with polar anchoring, whose director is nowhere in equilibrium.
std::string nematic(int n, const std::string& displacement, const std::string& more = "") {
  test::NematicDrop drop;
  drop.tension = false;
  drop.anchoring = "strength = 0.8\nsense = \"polar\"\n";
  drop.director = "\"0.9 + 0.2*y\", \"0.4*sin(2*x)\"";
  drop.more = fmt::format("initial_displacement = [{}]\ninitial_velocity = [{}]\n", displacement,
                          shear_and_stretch(2));
  return drop.scene(2, n, n / 2, "end = 1e3") + "[[surface_tension]]\nbody = \"b\"\ngamma = 1\n" +
         more;
}

/// Relative errors of a remap of a bent nematic drop: the director at material points, and the
/// energies of the director.
struct DirectorErrors {
  Real value, energy;
};
DirectorErrors director_errors(int n, const std::string& displacement, Real shift) {
  Epochs<2> epochs = begun<2>(nematic(n, displacement));
  const Body<2>& old = epochs.scene().system.bodies.front();
  // Uses the formulas of the scene as coefficients. These are smoother than the coefficients with
  // which the field has the values of the formulas.
  std::vector<Real> formulas;
  for (const Vec<2>& X : old.particles.X()) {
    formulas.push_back(0.9 + 0.2 * X[1]);
    formulas.push_back(0.4 * std::sin(2 * X[0]));
  }
  Snapshot smooth = epochs.simulation().snapshot();
  EXPECT_EQ(smooth.reals("fields/director/value").size(), formulas.size());
  smooth.add_reals("fields/director/value", formulas);
  epochs.restore(smooth);
  const State before = epochs.simulation().state();
  const auto stored = [](const Ledger& ledger) {
    return ledger.stored.at("director") + ledger.stored.at("anchoring");
  };
  const Real energy = stored(ledger_of(epochs));
  std::vector<Vec<2>> x = nodes_of(epochs);
  const std::vector<Index> boundary = boundary_nodes(old.geometry.grid);
  for (Index A = 0; A < old.size(); ++A)
    if (!std::binary_search(boundary.begin(), boundary.end(), A))
      at(x, A)[0] += shift * mean_spacing(old.geometry.grid) * std::cos(3 * at(x, A)[1]);
  const NodalVectors expected =
      values_at(build_point_rows<2>(old.particles, pre_images<2>(old, before.u.data(), x),
                                    {.value = true}, "b"),
                before.fields.front().x.data());
  epochs.new_epoch({{"b", x}});
  const NodalVectors h = values_at(epochs.scene().system.bodies.front().at_particles,
                                   epochs.simulation().state().fields.front().x.data());
  return {largest_change(h, expected) / largest(expected),
          std::abs(stored(ledger_of(epochs)) / energy - 1)};
}

TEST(Remap, CarriesTheDirector) {
  const DirectorErrors same = director_errors(6, no_displacement(2), 0);
  EXPECT_LT(same.value, 1e-13);
  EXPECT_LT(same.energy, 1e-12);
  const DirectorErrors coarse = director_errors(6, bend(2), 0.3),
                       fine = director_errors(12, bend(2), 0.3);
  EXPECT_LT(fine.value, 1e-6);
  EXPECT_GT(order("director", 2, coarse.value, fine.value), 2.5);
  EXPECT_GT(order("energy of the director", 2, coarse.energy, fine.energy), 2);
}

/// The core length and the resistance of the director still refer to the first reference.
TEST(Remap, LeavesTheNumbersOfANematic) {
  std::string text = nematic(6, "'0.1*x', '0.1*y'");
  text.replace(text.find("core_length = 0.2"), 17, "core_length = 0.0");
  Epochs<2> epochs = begun<2>(text);
  const auto resistance = [&] {
    const std::vector<Real>& c = epochs.simulation().state().fields.front().capacity;
    return std::accumulate(c.begin(), c.end(), 0.0);
  };
  const Real before = resistance();
  const Real energy = ledger_of(epochs).stored.at("director");
  epochs.new_epoch({{"b", nodes_of(epochs)}});
  EXPECT_NEAR(resistance() / before, 1, 1e-3);
  EXPECT_NEAR(ledger_of(epochs).stored.at("director") / energy, 1, 1e-3);
}

TEST(Remap, ANematicGoesOnWithTheSameBits) {
  expect_same_bits(nematic(6, bend(2), "[[remap]]\nbody = \"b\"\nat = [0.02, 0.04]\n"), 0.06);
}

/// The positions of a body far from the origin have the round-off of this distance, not of a
/// spacing.
TEST(Remap, ABodyFarFromTheOriginIsReferredAnew) {
  const std::string far = drop<2>(6, bend(2), shear_and_stretch(2), "");
  Epochs<2> epochs = begun<2>(far.substr(0, far.find("radius = 1\n")) + "centre = [3e3, 0]\n" +
                              far.substr(far.find("radius = 1\n")));
  epochs.new_epoch({{"drop", nodes_of(epochs)}});
  EXPECT_EQ(epochs.simulation().state().epoch, 1);
}

/// A remap in the middle of a motion that is large or small for the particles. `share` is the
/// change of the energy relative to the energy exchanged before; `warnings` are those of the run.
struct Remapping {
  Real share;
  std::vector<std::string> warnings;
};
Remapping remapping(int n, const std::string& displacement, const std::string& nodes) {
  Epochs<2> epochs =
      begun<2>(drop<2>(n, displacement, "'0.05*x', '-0.05*y'",
                       "[[remap]]\nbody = \"drop\"\nat = [0.1]\nnodes = \"" + nodes + "\"\n"));
  for (;;) {
    const auto remapped = epochs.advance();
    const Real changed = epochs.simulation().state().books.remapped;
    if (!remapped.notes.empty()) {
      epochs.simulation().audit_now();
      return {std::abs(changed) / epochs.simulation().audit().energy_scale, remapped.warnings};
    }
  }
}

TEST(Remap, WarnsWhereItChangesTheEnergy) {
  const Remapping coarse = remapping(4, "'0.5*x', '-0.33*y'", "particles"),
                  fine = remapping(8, "'0.1*x', '-0.09*y'", "even");
  EXPECT_GT(coarse.share, 0.05);
  ASSERT_EQ(coarse.warnings.size(), 1u);
  for (const char* word : {"body 'drop': the remap changes the energy by", " % of the ",
                           "exchanged so far (kinetic energy ", "condition of [[remap]]"})
    EXPECT_NE(coarse.warnings.front().find(word), std::string::npos) << coarse.warnings.front();
  EXPECT_LT(fine.share, 0.008);
  EXPECT_TRUE(fine.warnings.empty());
}

TEST(Remap, IsOnlyForDropsOfFluid) {
  for (const auto& [change, words] : std::vector<std::pair<std::string, std::string>>{
           {"shape = \"ball\"\nradius = 1\ncore = 4\nmaterial = { type = \"neo_hookean\", density "
            "= 1, mu = 1, lambda = 1 }",
            "solid"},
           {"shape = \"ball\"\nradius = 1\ncore = 4\nmaterial = { type = \"newtonian\", density = "
            "1, "
            "bulk_modulus = 1, viscosity = 1 }\n[[cavity]]\nbody = \"b\"\nsurface = \"outer\"\n"
            "pressure = 1",
            "[[cavity]]"}}) {
    const std::string text = "dimension = 3\n[time]\nend = 1\n[[body]]\nname = \"b\"\n" + change +
                             "\n[[remap]]\nbody = \"b\"\nat = [0.5]\n";
    try {
      const SceneInput input = SceneInput::from_text(text);
      scene_dimension(input);
      Epochs<3> epochs(read_plan<3>(input));
      ADD_FAILURE() << "was accepted: " << change;
    } catch (const InputError& e) {
      EXPECT_NE(std::string(e.what()).find(words), std::string::npos) << e.what();
    }
  }
}

}  // namespace
}  // namespace meniscus
