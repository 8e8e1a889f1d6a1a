// SPDX-License-Identifier: BSD-3-Clause
// Shape imperfections: random smooth displacements.
#include "body/imperfection.hpp"

#include "numbers/box.hpp"
#include "numbers/dense.hpp"
#include "numbers/random.hpp"

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace meniscus {

namespace {

/// A wave: displacement = amplitude cos(k . X + phase).
template <int D>
struct Wave {
  Vec<D> k, amplitude;
  Real phase;
};

/// A random direction: points of a cube are drawn until one lies inside the ball.
template <int D>
Vec<D> random_direction(std::mt19937_64& bits) {
  while (true) {
    Vec<D> x;
    for (int k = 0; k < D; ++k) x[k] = symmetric_uniform(bits);
    const Real r = x.norm();
    if (r > 0.1 && r < 1) return x / r;
  }
}

template <int D>
std::vector<Wave<D>> random_waves(Real length, std::uint64_t seed) {
  std::mt19937_64 bits(seed);
  std::vector<Wave<D>> waves;
  for (int m = 0; m < 24; ++m) {
    const Vec<D> direction = random_direction<D>(bits), amplitude = random_direction<D>(bits);
    const Real number = 2 * std::numbers::pi / (length * (0.5 + 0.5 * uniform(bits)));
    waves.push_back({number * direction, amplitude, 2 * std::numbers::pi * uniform(bits)});
  }
  return waves;
}

template <int D>
Vec<D> displacement(const std::vector<Wave<D>>& waves, const Vec<D>& X) {
  Vec<D> sum = Vec<D>::Zero();
  for (const Wave<D>& wave : waves) sum += std::cos(wave.k.dot(X) + wave.phase) * wave.amplitude;
  return sum;
}

/// The map X + displacement(X).
template <int D>
SmoothMap<D> map_of(std::vector<Wave<D>> waves) {
  return [waves = std::move(waves)](const Vec<D>& X) {
    MapPoint<D> point{X + displacement(waves, X), Mat<D>::Identity(), {}};
    point.G.fill(Mat<D>::Zero());
    for (const Wave<D>& wave : waves) {
      const Real angle = wave.k.dot(X) + wave.phase;
      point.F -= std::sin(angle) * wave.amplitude * wave.k.transpose();
      for (int i = 0; i < D; ++i)
        at(point.G, i) -= std::cos(angle) * wave.amplitude[i] * wave.k * wave.k.transpose();
    }
    return point;
  };
}

}  // namespace

template <int D>
Geometry<D> with_imperfection(Geometry<D> geometry, Real rms, std::uint64_t seed) {
  std::vector<Wave<D>> waves =
      random_waves<D>(box_around<D>(geometry.grid.X).extent().maxCoeff(), seed);
  Real square = 0;
  for (const Vec<D>& X : geometry.grid.X) square += displacement(waves, X).squaredNorm();
  const Real factor = rms / std::sqrt(square / static_cast<Real>(geometry.grid.X.size()));
  for (Wave<D>& wave : waves) wave.amplitude *= factor;

  const SmoothMap<D> map = map_of(waves);
  const auto perfect = geometry.director;
  Geometry<D> result = apply_map(map, std::move(geometry));
  if (perfect)
    result.director = [=](const Vec<D>& X) -> Vec<D> {
      Vec<D> X0 = X;  // X = X0 + displacement(X0); the iteration contracts
      for (int k = 0; k < 60; ++k) X0 = X - displacement(waves, X0);
      return (inverse<D>(map(X0).F).transpose() * perfect(X0)).normalized();
    };
  return result;
}

template Geometry<2> with_imperfection(Geometry<2>, Real, std::uint64_t);
template Geometry<3> with_imperfection(Geometry<3>, Real, std::uint64_t);

}  // namespace meniscus
