// SPDX-License-Identifier: BSD-3-Clause
// Where a body is, and how fast it moves, as a whole.
#include "meniscus/core/parallel.hpp"
#include "meniscus/measure/measure_registry.hpp"

#include <numeric>

namespace meniscus {
namespace {

/// Centre of mass and its velocity: of the coefficients, whose momentum is that of the audit.
template <int D>
std::vector<MeasureSource> mean_motion(const Body<D>& body, const UnitSystem&) {
  const auto mean = [&body](auto&& number) {
    return [&body, number](const Motion& motion) {
      const Real mass = std::accumulate(body.mass.begin(), body.mass.end(), Real{0});
      return parallel_sum(body.size(), 0.0,
                          [&](Index A) { return at(body.mass, A) * number(motion, A); }) /
             mass;
    };
  };
  std::vector<MeasureSource> measures;
  for (int i = 0; i < D; ++i)
    measures.push_back({std::string("centre_") + "xyz"[i], dimension::length, "of mass",
                        mean([&body, i](const Motion& motion, Index A) {
                          return body.origin(A)[i] + at(motion.u, body.first + A)[i];
                        })});
  for (int i = 0; i < D; ++i)
    measures.push_back({std::string("velocity_") + "xyz"[i], dimension::velocity,
                        "of the centre of mass", mean([&body, i](const Motion& motion, Index A) {
                          return at(motion.v, body.first + A)[i];
                        })});
  return measures;
}

const bool mean_motion_registered =
    register_measures("mean_motion", mean_motion<2>, mean_motion<3>);

}  // namespace
}  // namespace meniscus
