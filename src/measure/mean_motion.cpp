// SPDX-License-Identifier: BSD-3-Clause
// Position, velocity, rotation and length of a body as a whole.
#include "meniscus/measure/measure_registry.hpp"
#include "numbers/dense.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>

namespace meniscus {
namespace {

/// Measures of a whole body. All are sums over coefficients, like the momenta and the energy of the
/// audit.
template <int D>
class Whole {
 public:
  explicit Whole(const Body<D>& body) : body_(body) {}

  Real sum(auto&& number) const {
    return parallel_sum(body_.size(), 0.0, [&](Index A) { return at(body_.mass, A) * number(A); });
  }
  Real mean(auto&& number) const {
    return sum(number) / std::accumulate(body_.mass.begin(), body_.mass.end(), Real{0});
  }
  Real place(const Motion& motion, Index A, int i) const {
    return at(body_.particles.X(), A)[i] + at(motion.u, body_.first + A)[i];
  }
  Real velocity(const Motion& motion, Index A, int i) const {
    return at(motion.v, body_.first + A)[i];
  }
  Real centre(const Motion& motion, int i) const {
    return mean([&](Index A) { return place(motion, A, i); });
  }
  Real velocity_of_centre(const Motion& motion, int i) const {
    return mean([&](Index A) { return velocity(motion, A, i); });
  }
  /// Component x_i v_j - x_j v_i of the angular momentum about the centre of mass.
  Real spin(const Motion& motion, int i, int j) const {
    const Real xi = centre(motion, i), xj = centre(motion, j);
    return sum([&](Index A) {
      return (place(motion, A, i) - xi) * velocity(motion, A, j) -
             (place(motion, A, j) - xj) * velocity(motion, A, i);
    });
  }
  Real kinetic_energy(const Motion& motion) const {
    return sum([&](Index A) {
      Real squares = 0;
      for (int i = 0; i < D; ++i) squares += std::pow(velocity(motion, A, i), 2);
      return squares / 2;
    });
  }
  /// The k-th longest axis of the ellipsoid with the same second moments over mass. An axis of
  /// length 2 a has the second moment a^2/5 (ellipse: a^2/4).
  Real axis(const Motion& motion, int k) const {
    if (revolved()) return revolved_axis(motion, k);
    std::array<Real, D> x{};
    for (int i = 0; i < D; ++i) at(x, i) = centre(motion, i);
    Mat<D> moments;
    for (int i = 0; i < D; ++i)
      for (int j = 0; j <= i; ++j)
        moments(i, j) = moments(j, i) = mean([&](Index A) {
          return (place(motion, A, i) - at(x, i)) * (place(motion, A, j) - at(x, j));
        });
    return 2 * std::sqrt((D + 2) * std::max(0.0, symmetric_eigenvalues<D>(moments)[D - 1 - k]));
  }

  bool revolved() const { return body_.geometry.grid.revolved; }

 private:
  /// The squares of distances from the axis are those of two directions.
  Real revolved_axis(const Motion& motion, int k) const {
    const Real y = centre(motion, 1);
    const Real across = mean([&](Index A) { return std::pow(place(motion, A, 0), 2) / 2; }),
               along = mean([&](Index A) { return std::pow(place(motion, A, 1) - y, 2); });
    std::array<Real, 3> moments{along, across, across};
    std::sort(moments.begin(), moments.end(), std::greater());
    return 2 * std::sqrt(5 * at(moments, k));
  }

  const Body<D>& body_;
};

template <int D>
std::vector<MeasureSource> mean_motion(const Body<D>& body, const UnitSystem&) {
  const Whole<D> whole(body);
  std::vector<MeasureSource> measures;
  const auto along = [](const char* name, int i) { return std::string(name) + "_" + "xyz"[i]; };
  const int first = whole.revolved() ? 1 : 0;
  for (int i = first; i < D; ++i)
    measures.push_back({along("centre", i), dimension::length, "of mass",
                        [whole, i](const Motion& m) { return whole.centre(m, i); }});
  for (int i = first; i < D; ++i)
    measures.push_back({along("velocity", i), dimension::velocity, "of the centre of mass",
                        [whole, i](const Motion& m) { return whole.velocity_of_centre(m, i); }});
  for (int i = first; i < D; ++i)
    measures.push_back({along("momentum", i), of_sum(dimension::momentum, D), "mass by velocity",
                        [whole, i](const Motion& m) {
                          return whole.sum([&](Index A) { return whole.velocity(m, A, i); });
                        }});
  for (int i = D == 3 ? 0 : 2; i < 3 && !whole.revolved(); ++i)
    measures.push_back({along("spin", i), of_sum(dimension::angular_momentum, D),
                        "angular momentum about the centre of mass", [whole, i](const Motion& m) {
                          return whole.spin(m, (i + 1) % 3, (i + 2) % 3);
                        }});
  measures.push_back({"kinetic_energy", of_sum(dimension::energy, D),
                      "of the whole motion, deformation included",
                      [whole](const Motion& m) { return whole.kinetic_energy(m); }});
  for (int k = 0; k < body.space(); ++k)
    measures.push_back({"principal_extent_" + std::to_string(k + 1), dimension::length,
                        "axis of the ellipsoid that has the same second moments of mass, the "
                        "longest first; of an ellipsoid its own, however it is turned",
                        [whole, k](const Motion& m) { return whole.axis(m, k); }});
  return measures;
}

const bool mean_motion_registered =
    register_measures("mean_motion", mean_motion<2>, mean_motion<3>);

}  // namespace
}  // namespace meniscus
