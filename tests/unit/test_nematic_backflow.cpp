// SPDX-License-Identifier: BSD-3-Clause
// Plane modes of a uniform director with the flow that it drives, including the reaction of the
// flow.
#include "cases.hpp"
#include "cells_reference.hpp"
#include "kernel/row_sums.hpp"
#include "numbers/dense.hpp"
#include "run/simulation.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>

namespace meniscus::test_nematic_backflow {
namespace {

/// A film between the plates x = 0 and x = pi/k, from a row of "backflow". The plates hold the
/// liquid but leave its director free. The director is along x (bend) or y (splay), tilted by phi
/// cos(kx); the velocity is v sin(kx) along y. Both keep this form for any length of the film along
/// y. The ends of the film may move along y but not along x, so that they have no traction.
std::string film(const nlohmann::json& row, int cells, Real phi, Real v) {
  const Real k = row.at("k"), width = std::numbers::pi / k;
  const std::string tilt = fmt::format("\"{}*cos({}*x)\"", phi, k),
                    director = row.at("kind") == "bend" ? "1, " + tilt : tilt + ", 1";
  const auto held = [](const std::string& face, const std::string& components) {
    return fmt::format("[[held]]\nbody = \"film\"\nface = \"{}\"\ncomponents = [{}]\n", face,
                       components);
  };
  return fmt::format(
             "dimension = 2\n[time]\nend = 1\n[[body]]\nname = \"film\"\nshape = \"rectangle\"\n"
             "corner = [0, 0]\nsize = [{0}, {1}]\ncells = [{2}, {3}]\n"
             "initial_velocity = [\"0\", \"{4}*sin({5}*x)\"]\n"
             "[body.material]\ntype = \"nematic\"\ndensity = 1\nbulk_modulus = 200\nviscosity = "
             "{6}\nfrank_constant = {7}\ncore_length = 0.2\nrotational_viscosity = {8}\n"
             "flow_alignment = {9}\ninitial_director = [{10}]\n",
             width, width / 2, cells, cells / 2, v, k, row.at("mu").get<Real>(),
             row.at("K").get<Real>(), 1 / row.at("Gam").get<Real>(), row.at("lam").get<Real>(),
             director) +
         held("x_min", "\"x\", \"y\"") + held("x_max", "\"x\", \"y\"") + held("y_min", "\"x\"") +
         held("y_max", "\"x\"");
}

/// Amplitudes of tilt and velocity.
std::array<Real, 2> amplitudes(const Body<2>& body, const State& state, const nlohmann::json& row) {
  const int tilted = row.at("kind") == "bend" ? 1 : 0;
  const Real k = row.at("k");
  Real phi = 0, of_phi = 0, v = 0, of_v = 0;
  for (Index A = 0; A < body.size(); ++A) {
    const Real c = std::cos(k * at(body.particles.X(), A)[0]),
               s = std::sin(k * at(body.particles.X(), A)[0]);
    phi += c * value_at(body.at_particles, A, state.fields.front().x.data())[tilted];
    v += s * value_at(body.at_particles, A, state.v.data())[1];
    of_phi += c * c;
    of_v += s * s;
  }
  return {phi / of_phi, v / of_v};
}

/// The linear map of both amplitudes over a time of about `end`, and this time.
struct Map {
  Mat<2> M;
  Real time = 0;
};
Map map_over(const nlohmann::json& row, int cells, Real end) {
  Map map;
  constexpr Real small = 1e-3;
  for (int column = 0; column < 2; ++column) {
    Scene<2> scene =
        test::scene_of<2>(film(row, cells, column == 0 ? small : 0, column == 1 ? small : 0));
    scene.time.end = end;
    Simulation<2> simulation(scene);
    simulation.begin();
    const std::array<Real, 2> begin =
        amplitudes(scene.system.bodies.front(), simulation.state(), row);
    while (!simulation.finished()) simulation.advance();
    const std::array<Real, 2> now =
        amplitudes(scene.system.bodies.front(), simulation.state(), row);
    for (int i = 0; i < 2; ++i) map.M(i, column) = at(now, i) / at(begin, column);
    map.time = simulation.state().time;
  }
  return map;
}

/// Largest error of the rates of a row, relative to the largest rate.
Real error_of_rates(const nlohmann::json& row, int cells) {
  std::array<std::complex<Real>, 2> exact;
  for (int i = 0; i < 2; ++i)
    at(exact, i) = {row.at("roots")[i][0].get<Real>(), row.at("roots")[i][1].get<Real>()};
  const Real greatest = std::max(std::abs(exact[0]), std::abs(exact[1]));
  const Map map = map_over(row, cells, 1 / greatest);
  const Real half = map.M.trace() / 2;
  const std::complex<Real> root = std::sqrt(std::complex<Real>(half * half - map.M.determinant()));
  const auto error = [&](Real sign) {
    const std::complex<Real> first = std::log(half + sign * root) / map.time,
                             second = std::log(half - sign * root) / map.time;
    return std::max(std::abs(first - exact[0]), std::abs(second - exact[1])) / greatest;
  };
  return std::min(error(1), error(-1));
}

/// The rates satisfy s^2 + (K/gamma_1 + mu) k^2 s + (K mu/gamma_1 + a^2 K) k^4 = 0, with a = (1 +
/// lambda)/2 for bend and (lambda - 1)/2 for splay.
TEST(Nematic, DecaysAndSwingsAtTheRatesOfItsBackflow) {
  for (const auto& row : test::cells_reference().at("nematic").at("backflow").at("rows")) {
    const Real coarse = error_of_rates(row, 8), fine = error_of_rates(row, 16);
    fmt::print("backflow, {}, lambda {}, mu {}: error of the rates {:.2e}, {:.2e}\n",
               row.at("kind").get<std::string>(), row.at("lam").get<Real>(),
               row.at("mu").get<Real>(), coarse, fine);
    EXPECT_LT(fine, 0.007) << row.dump();
    EXPECT_LT(fine, coarse / 2) << row.dump();
  }
}

}  // namespace
}  // namespace meniscus::test_nematic_backflow
