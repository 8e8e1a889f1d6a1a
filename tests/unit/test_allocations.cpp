// SPDX-License-Identifier: BSD-3-Clause
// No step of a run allocates memory after a warm-up. Every operator new of this program is counted.
#include "cases.hpp"
#include "run/simulation.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

namespace {

std::atomic<long> allocations{0};

[[gnu::noinline]] void* counted(std::size_t size, std::size_t alignment) {
  allocations.fetch_add(1, std::memory_order_relaxed);
  const std::size_t rounded = (size + alignment - 1) / alignment * alignment;
  void* p = std::aligned_alloc(alignment, rounded > 0 ? rounded : alignment);
  if (!p) throw std::bad_alloc();
  return p;
}
// Not inlined, since g++ would report inlined new and delete as mismatched.
[[gnu::noinline]] void release(void* p) {
  std::free(p);
}
constexpr std::size_t plain = alignof(std::max_align_t);

}  // namespace

// Array and nothrow forms call these.
void* operator new(std::size_t size) {
  return counted(size, plain);
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  return counted(size, static_cast<std::size_t>(alignment));
}
void operator delete(void* p) noexcept {
  release(p);
}
void operator delete(void* p, std::size_t) noexcept {
  release(p);
}
void operator delete(void* p, std::align_val_t) noexcept {
  release(p);
}
void operator delete(void* p, std::size_t, std::align_val_t) noexcept {
  release(p);
}

namespace meniscus::test_allocations {
namespace {

/// Number of allocations in 50 steps after `warm_up` steps, including new estimates of the stable
/// step. A rejected step, which is possible at the start of a drop, allocates its message;
/// `warm_up` is chosen longer.
template <int D>
long allocations_of(const std::string& text, int warm_up = 20) {
  const SceneInput input = SceneInput::from_text(text);
  EXPECT_EQ(scene_dimension(input), D);
  Scene<D> scene = build_scene<D>(input);
  Simulation<D> simulation(scene);
  simulation.begin();
  for (int step = 0; step < warm_up; ++step) simulation.advance();
  const long before = allocations;
  for (int step = 0; step < 50; ++step) simulation.advance();
  return allocations - before;
}

std::string drop(int dimension, const std::string& body, const std::string& more) {
  return "dimension = " + std::to_string(dimension) +
         "\n[time]\nend = 1e3\ncheck_every = 20\n[[body]]\nname = \"drop\"\nshape = \"" +
         (dimension == 3 ? "ball\"\nradius = 1\ncore = 2\nlayers = 2\n"
                         : "disk\"\nradius = 1\ncore = 4\nrings = 2\n") +
         body +
         "material = { type = \"newtonian\", density = 1, bulk_modulus = 20, viscosity = 0.3 }\n" +
         more;
}

const std::string tension = "[[surface_tension]]\nbody = \"drop\"\ngamma = 1\nform = ";

TEST(Allocations, AreCounted) {
  const long before = allocations;
  ::operator delete(::operator new(8));
  EXPECT_GT(allocations, before);
}

template <int D>
void expect_none_with_anything() {
  constexpr int bodies_have_met = 400;
  for (const test::Case& c : test::cases<D>()) {
    if (c.name.ends_with("solver newton")) continue;  // one step makes hundreds of forces
    try {
      if (allocations_of<D>(c.scene) == 0) continue;
      // Contact lists stop growing by then.
      EXPECT_EQ(allocations_of<D>(c.scene, bodies_have_met), 0) << c.name << " in " << D << "D";
    } catch (const SolveError& error) {
      ADD_FAILURE() << c.name << " in " << D << "D: " << error.what();
    }
  }
}

TEST(Allocations, NoneInAStepWithAnythingRegistered) {
  expect_none_with_anything<2>();
  expect_none_with_anything<3>();
}

TEST(Allocations, NoneInAStep) {
  for (const std::string form :
       {"\"balanced\"\n", "\"weak\"\n", "\"curvature\"\n", "\"triangles\"\n"}) {
    EXPECT_EQ(allocations_of<3>(drop(3, "", tension + form)), 0) << form;
    EXPECT_EQ(allocations_of<2>(drop(2, "", tension + form)), 0) << form;
  }
  EXPECT_EQ(allocations_of<3>("dimension = 3\ntime.end = 1\n[[body]]\nname = \"b\"\nshape = "
                              "\"box\"\nsize = [1, 1, 1]\ncells = [4, 4, 4]\ninitial_velocity "
                              "= [\"0.1*x\", 0, 0]\nmaterial = { type = \"neo_hookean\", density "
                              "= 1, mu = 1, lambda = 100 }\n"),
            0)
      << "volume changes that cells share";
  for (const std::string rule : {"gauss", "nodal"})
    EXPECT_EQ(allocations_of<3>(drop(3, "integration = \"" + rule + "\"\n", "")), 0) << rule;
  EXPECT_EQ(allocations_of<2>(drop(2, "",
                                   "[[body_force]]\nbody = \"drop\"\n"
                                   "acceleration = [\"0.01*x*cos(t)\", 0]\n")),
            0);
}

/// Contact lists are rebuilt as the bodies move against each other.
template <int D>
void expect_none_in_contact() {
  constexpr int warm_up = 400;  // the bodies have met
  const std::string far = D == 3 ? "[2.2, 0, 0]" : "[2.2, 0]", up = D == 3 ? "[0, 0, 1]" : "[0, 1]",
                    below = D == 3 ? "[0, 0, -1.3]" : "[0, -1.3]";
  std::string other = drop(D,
                           "centre = " + far + "\ninitial_velocity = " +
                               (D == 3 ? "[\"-0.3\", 0, 0]" : "[\"-0.3\", 0]") + "\n",
                           "");
  other = other.substr(other.find("[[body]]"));
  other.replace(other.find("drop"), 4, "other");
  const std::string numbers = "epsilon = 1\nsigma0 = 0.3\nbeta = 1\nskin = 0.02\n";
  for (const std::string form : {"energy", "pressure", "dissertation", "volume"})
    EXPECT_EQ(
        allocations_of<D>(drop(D, "",
                               other + "[[contact]]\nbodies = [\"drop\", \"other\"]\nform = \"" +
                                   form + "\"\n" + numbers),
                          warm_up),
        0)
        << form;
  EXPECT_EQ(allocations_of<D>(drop(D, "",
                                   "[[contact]]\nbodies = [\"drop\"]\n" + numbers +
                                       "partner = { type = \"half_space\", point = " + below +
                                       ", normal = " + up + " }\n")),
            0);
}

TEST(Allocations, NoneInAStepOfContact) {
  expect_none_in_contact<2>();
  expect_none_in_contact<3>();
}

}  // namespace
}  // namespace meniscus::test_allocations
