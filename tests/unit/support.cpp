// SPDX-License-Identifier: BSD-3-Clause
// Small bodies, materials and fields of the tests, compiled once.
#include "support.hpp"

#include <cmath>
#include <random>

namespace meniscus::test {

template <int D>
Geometry<D> brick(std::vector<Real> cells, Real jitter) {
  Brick<D> shape;
  shape.size = cells;
  shape.cells = std::move(cells);
  Geometry<D> geometry = shape.geometry();
  if (jitter > 0) jitter_interior(geometry.grid, jitter, 11);
  return geometry;
}

Geometry<3> ball(int core, int layers) {
  Ball shape;
  shape.core = core;
  shape.layers = layers;
  return shape.geometry();
}

Geometry<2> disk(int core, int rings) {
  Disk shape;
  shape.core = core;
  shape.rings = rings;
  return shape.geometry();
}

template <int D>
Geometry<D> potato() {
  const auto map = smooth_map<D>([](const std::array<Jet<D>, D>& X) {
    std::array<Jet<D>, D> x = X;
    x[0] = 1.3 * X[0] + 0.2 * X[1] * X[1] + 0.1 * X[0] * X[1];
    x[1] = X[1] + 0.25 * sin(X[0]);
    if constexpr (D == 3) x[2] = 0.8 * X[2] + 0.15 * X[0] * X[2] + 0.1 * X[1];
    return x;
  });
  if constexpr (D == 3)
    return apply_map<3>(map, ball(4, 2));
  else
    return apply_map<2>(map, disk(6, 3));
}

template <int D>
std::unique_ptr<Body<D>> body_of(Geometry<D> geometry, Support<D> support,
                                 KernelFunction kernel_function) {
  order_spatially(geometry);
  ParticleSet<D> particles(geometry.grid.X, support, kernel_function);
  std::vector<Vec<D>> probes = geometry.grid.X;
  const auto centres = cell_gauss_points(geometry.grid, 1).X;
  probes.insert(probes.end(), centres.begin(), centres.end());
  particles.ensure_quality(probes, "body");
  return std::make_unique<Body<D>>("body", std::move(geometry), std::move(particles));
}

const std::map<std::string, std::string>& law_texts() {
  static const auto texts = [] {
    std::map<std::string, std::string> all;
    for (const auto& [name, law] : laws()) all.emplace(name, law.example);
    return all;
  }();
  return texts;
}

std::string stiff_text(const std::string& law) {
  std::string text = law_texts().at(law);
  if (laws().at(law).viscous) return text;
  for (const std::string number : {"lambda = ", "bulk_modulus = "})
    if (const std::size_t place = text.find(number); place != std::string::npos)
      text.insert(place + number.size(), "1");  // 1.5 becomes 11.5
  return text;
}

template <int D>
std::unique_ptr<ForceTerm> internal_force(Body<D>& body, const std::string& law,
                                          const std::string& text, const Integration& integration) {
  const std::string direction = text.find("reference_director") != std::string::npos ? ""
                                : D == 2 ? "reference_director = [0.6, 0.8]\n"
                                         : "reference_director = [0.6, 0, -0.8]\n";
  const SceneInput scene = SceneInput::from_text(text + "\n" + direction);
  const auto material = laws().at(law).template material<D>(scene.root());
  scene.check();
  return material->build(body, integration).force;
}

const std::vector<Integration>& integrations() {
  static const std::vector<Integration> all{
      {"q_scni", 0, "full"}, {"q_scni", 0, "cell_average"}, {"gauss", 2}, {"nodal", 0}};
  return all;
}

template <int D>
NodalVectors random_field(Index n, Real size, unsigned seed) {
  std::mt19937_64 generator(seed);
  std::uniform_real_distribution<Real> uniform(-size, size);
  NodalVectors values(static_cast<std::size_t>(n));
  for (Index A = 0; A < n; ++A) {
    Vec<D> x;
    for (int i = 0; i < D; ++i) x[i] = uniform(generator);
    set_vector<D>(values, A, x);
  }
  return values;
}

template <int D>
Balance balance_of(const Body<D>& body, const NodalVectors& u, const NodalVectors& force) {
  Eigen::Vector3d net = Eigen::Vector3d::Zero(), moment = net;
  Real force_scale = 0, torque_scale = 0;
  for (Index A = 0; A < body.size(); ++A) {
    Eigen::Vector3d x = Eigen::Vector3d::Zero(), f = x;
    x.head<D>() = at(body.particles.X(), A) + vector_at<D>(u, A);
    f.head<D>() = vector_at<D>(force, A);
    const Eigen::Vector3d arm(x[1] * f[2] - x[2] * f[1], x[2] * f[0] - x[0] * f[2],
                              x[0] * f[1] - x[1] * f[0]);
    net += f;
    moment += arm;
    force_scale += f.norm();
    torque_scale += x.norm() * f.norm();
  }
  return {net.norm() / force_scale, moment.norm() / torque_scale};
}

Real gradient_error(ForceTerm& term, const NodalVectors& u, const NodalVectors& direction,
                    Real step) {
  const auto slope = [&](Real h) {
    return (energy_of(term, sum_of(u, h, direction)) - energy_of(term, sum_of(u, -h, direction))) /
           (2 * h);
  };
  const Real exact = (4 * slope(step / 2) - slope(step)) / 3;
  return std::abs(dot(force_of(term, u), direction) + exact) / std::abs(exact);
}

#define INSTANTIATE(D)                                                                        \
  template Geometry<D> brick(std::vector<Real>, Real);                                        \
  template Geometry<D> potato();                                                              \
  template std::unique_ptr<Body<D>> body_of(Geometry<D>, Support<D>, KernelFunction);         \
  template std::unique_ptr<ForceTerm> internal_force(Body<D>&, const std::string&,            \
                                                     const std::string&, const Integration&); \
  template NodalVectors random_field<D>(Index, Real, unsigned);                               \
  template Balance balance_of(const Body<D>&, const NodalVectors&, const NodalVectors&)
INSTANTIATE(2);
INSTANTIATE(3);
#undef INSTANTIATE

}  // namespace meniscus::test
