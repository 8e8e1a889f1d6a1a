// SPDX-License-Identifier: BSD-3-Clause
// Supports of particles, and the check of the quality of shape functions.
#include "kernel/particle_set.hpp"

#include "meniscus/error.hpp"
#include "numbers/dense.hpp"
#include "parallel/divided.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace meniscus {
namespace {

/// Predicate: true if a support around X reaches into the ball.
template <int D>
struct Ball {
  Vec<D> centre;
  Real radius;
  bool operator()(const Vec<D>& X, Real support) const {
    const Real within = radius + support;
    return (X - centre).squaredNorm() < within * within;
  }
};

/// Predicate: true if a support around X reaches one of four points, up to rounding of the
/// distance.
template <int D>
class FourPoints {
 public:
  explicit FourPoints(const std::array<Vec<D>, 4>& x) {
    for (int i = 0; i < D; ++i) at(x_, i) = {x[0][i], x[1][i], x[2][i], x[3][i]};
  }
  bool operator()(const Vec<D>& X, Real support) const {
    Lanes squared = Lanes::zero();
    for (int i = 0; i < D; ++i) squared += (X[i] - at(x_, i)) * (X[i] - at(x_, i));
    return any(squared.v <= support * support * (1 + 1e-12));
  }

 private:
  std::array<Lanes, D> x_;
};

}  // namespace

template <int D>
auto ParticleSet<D>::press(const Mat<D>& stretch, std::span<const Vec<D>> X)
    -> std::optional<Pressed> {
  if (stretch == Mat<D>::Identity()) return {};
  const Mat<D> inverse_stretch = inverse<D>(stretch);
  std::vector<Vec<D>> places;
  for (const Vec<D>& x : X) places.push_back(inverse_stretch * x);
  auto search = NeighborSearch<D>::in_order(places);
  return Pressed{inverse_stretch, symmetric_eigenvalues<D>(inverse_stretch)[D - 1],
                 std::move(places), std::move(search)};
}

template <int D>
ParticleCloud<D>::ParticleCloud(std::vector<Vec<D>> particles, bool is_mirrored)
    : X(std::move(particles)), count(static_cast<Index>(X.size())), mirrored(is_mirrored) {
  if (!mirrored) return;
  for (Index A = 0; A < count; ++A)
    if (at(X, A)[0] != 0) source.push_back(A);
  for (const Index A : source) {
    Vec<D> image = at(X, A);
    image[0] = -image[0];
    X.push_back(image);
  }
}

template <int D>
ParticleSet<D>::ParticleSet(ParticleCloud<D> cloud, const AdaptiveSupport& rule,
                            KernelFunction kernel_function, const Mat<D>& stretch)
    : cloud_(std::move(cloud)),
      support_(cloud_.X.size()),
      kernel_function_(kernel_function),
      search_(NeighborSearch<D>::in_order(cloud_.X)),
      pressed_(press(stretch, cloud_.X)) {
  const OwnItems own = evenly.own_rows(size());
  parallel_for(own, [&](Index A) {
    // The nearest point to a particle is the particle itself, hence rank + 1.
    at(support_, A) =
        rule.factor * kernel_search().distance_of_nearest(at(kernel_X(), A), rule.rank + 1);
  });
  evenly.complete_rows(size(), support_.data(), sizeof(Real));
  settle_supports();
}

template <int D>
ParticleSet<D>::ParticleSet(ParticleCloud<D> cloud, Real support, KernelFunction kernel_function,
                            const Mat<D>& stretch)
    : cloud_(std::move(cloud)),
      support_(cloud_.X.size(), support),
      largest_support_(support),
      kernel_function_(kernel_function),
      search_(NeighborSearch<D>::in_order(cloud_.X)),
      pressed_(press(stretch, cloud_.X)) {}

template <int D>
ParticleSet<D>::ParticleSet(ParticleCloud<D> cloud, std::span<const Real> support,
                            KernelFunction kernel_function, const Mat<D>& stretch)
    : cloud_(std::move(cloud)),
      support_(support.begin(), support.end()),
      kernel_function_(kernel_function),
      search_(NeighborSearch<D>::in_order(cloud_.X)),
      pressed_(press(stretch, cloud_.X)) {
  support_.resize(cloud_.X.size());
  settle_supports();
}

template <int D>
void ParticleSet<D>::settle_supports() {
  for (Index A = size(); A < static_cast<Index>(support_.size()); ++A)
    at(support_, A) = at(support_, source(A));
  largest_support_ = *std::max_element(support_.begin(), support_.end());
}

template <int D>
Index ParticleSet<D>::limit_supports(std::vector<Real> limit) {
  limit_ = std::move(limit);
  Index shortened = 0;
  for (Index A = 0; A < size(); ++A) {
    shortened += at(limit_, A) < at(support_, A);
    at(support_, A) = std::min(at(support_, A), at(limit_, A));
  }
  settle_supports();
  return shortened;
}

template <int D>
template <class Keep>
void ParticleSet<D>::find(const Vec<D>& centre, Real radius, Keep&& keep,
                          std::vector<Candidate<D>>& found) const {
  thread_local std::vector<Index> near;
  // The search finds many more particles than are kept, because supports differ; so it does not
  // sort.
  kernel_search().within_unsorted(centre, radius + largest_support_, near);
  const auto X = kernel_X();
  std::erase_if(near, [&](Index A) { return !keep(at(X, A), at(support_, A)); });
  std::sort(near.begin(), near.end());
  found.clear();
  for (const Index A : near) found.push_back({A, at(support_, A), at(X, A)});
}

template <int D>
void ParticleSet<D>::candidates(const Vec<D>& centre, Real radius,
                                std::vector<Candidate<D>>& found) const {
  const Ball<D> ball{kernel_place(centre), pressed_ ? pressed_->growth * radius : radius};
  find(ball.centre, ball.radius, ball, found);
}

template <int D>
void ParticleSet<D>::candidates(const Vec<D>& centre, Real radius,
                                std::span<const Candidate<D>> around,
                                std::vector<Candidate<D>>& found) const {
  const Ball<D> ball{kernel_place(centre), pressed_ ? pressed_->growth * radius : radius};
  thread_local std::vector<Index> numbers;
  numbers.resize(std::max(numbers.size(), around.size()));
  std::size_t kept = 0;
  for (std::size_t k = 0; k < around.size(); ++k) {  // without a branch to mispredict
    numbers[kept] = static_cast<Index>(k);
    kept += ball(around[k].X, around[k].support);
  }
  found.clear();
  found.reserve(kept);
  for (std::size_t k = 0; k < kept; ++k) found.push_back(at(around, numbers[k]));
}

template <int D>
void ParticleSet<D>::candidates(const std::array<Vec<D>, 4>& x,
                                std::vector<Candidate<D>>& found) const {
  const std::array<Vec<D>, 4> points = kernel_places(x);
  const Vec<D> centre = 0.25 * ((points[0] + points[1]) + (points[2] + points[3]));
  Real radius = 0;
  for (const Vec<D>& point : points) radius = std::max(radius, (point - centre).norm());
  find(centre, radius * (1 + 1e-12), FourPoints<D>(points), found);
}

/// Computes quality[q] for the points with these numbers. Consecutive points are often near each
/// other; four such points are computed together.
template <int D>
void ParticleSet<D>::find_quality(std::span<const Vec<D>> points, std::span<const Index> numbers,
                                  std::vector<Real>& quality) const {
  constexpr Index together = 4;
  const auto count = static_cast<Index>(numbers.size());
  using Qualities = std::array<Real, together>;
  std::vector<Qualities> found(static_cast<std::size_t>((count + together - 1) / together));
  const OwnItems own = evenly.own_rows(static_cast<Index>(found.size()));
  parallel_for(own, [&](Index batch) {
    thread_local std::vector<Candidate<D>> reaching;
    thread_local ReproducingKernel<D> kernel(kernel_function_);
    kernel.use(kernel_function_);
    const Index end = std::min(count, (batch + 1) * together);
    for (Index first = batch * together, next = first; first < end; first = next) {
      std::array<Vec<D>, together> x;
      x.fill(at(points, at(numbers, first)));
      for (next = first; next < end; ++next) {
        const Vec<D>& another = at(points, at(numbers, next));
        if ((another - x[0]).squaredNorm() > largest_support_ * largest_support_) break;
        at(x, next - first) = another;
      }
      candidates(x, reaching);
      const bool enough = static_cast<int>(reaching.size()) >= kernel.basis_size;
      if (enough) kernel.evaluate(kernel_places(x), reaching, Derivatives::none);
      for (Index k = first; k < next; ++k)
        at(at(found, batch), k % together) =
            enough ? std::max(0.0, kernel.quality()[k - first]) : 0.0;
    }
  });
  evenly.complete_rows(static_cast<Index>(found.size()), found.data(), sizeof(Qualities));
  for (Index k = 0; k < count; ++k)
    at(quality, at(numbers, k)) = at(at(found, k / together), k % together);
}

template <int D>
Index ParticleSet<D>::ensure_quality(std::span<const Vec<D>> points, const std::string& body) {
  const std::vector<Real> asked_for = support_;
  std::vector<Real> quality(points.size());
  std::vector<Index> poor(points.size());
  std::iota(poor.begin(), poor.end(), 0);
  std::vector<Index> near;
  const Real largest_asked_for = largest_support_;
  constexpr int rounds = 10;  // 1.1^10 = 2.6
  Real growth = 1;
  for (int round = 0; round <= rounds; ++round) {
    find_quality(points, poor, quality);
    std::erase_if(poor, [&](Index q) { return at(quality, q) >= poor_quality; });
    if (poor.empty() || round == rounds) break;
    // Enlarge the supports of particles that reach the point with `growth` times their requested
    // support. This includes particles that do not reach it now, so that the point gets new
    // neighbours.
    growth *= 1.1;
    for (const Index q : poor) {
      const Vec<D> place = kernel_place(at(points, q));
      kernel_search().within(place, growth * largest_asked_for, near);
      for (const Index A : near) {
        const Index B = source(A);
        Real enlarged = growth * at(asked_for, B);
        if (!limit_.empty()) enlarged = std::min(enlarged, at(limit_, B));
        if ((at(kernel_X(), A) - place).norm() < enlarged)
          at(support_, B) = std::max(at(support_, B), enlarged);
      }
    }
    settle_supports();
  }
  for (const Index q : poor) require_quality(at(quality, q), at(points, q), body);
  Index enlarged = 0;
  for (Index A = 0; A < size(); ++A) enlarged += at(support_, A) != at(asked_for, A);
  return enlarged;
}

namespace {

/// Number of planes (2D: lines) across a direction that contain all points; 3 if more are needed.
template <int D>
int planes_across(const Vec<D>& direction, const std::vector<Vec<D>>& points, Real rounding) {
  std::vector<Real> heights;
  for (const Vec<D>& X : points) heights.push_back(direction.dot(X));
  std::sort(heights.begin(), heights.end());
  int planes = 1;
  for (std::size_t i = 1; i < heights.size(); ++i) planes += heights[i] > heights[i - 1] + rounding;
  return std::min(planes, 3);
}

/// True if all points lie in one plane or two parallel planes. Then x^2 and x are the same in a
/// quadratic basis across the planes, for any size of supports. At least three of the first points
/// (2D: two) lie in one of the planes, which limits the search.
template <int D>
bool lie_in_two_planes(const std::vector<Vec<D>>& points) {
  const std::size_t first = std::min<std::size_t>(points.size(), 12);
  const auto found = [&](const Vec<D>& normal, Real length) {
    return normal.norm() > 1e-3 * length &&
           planes_across<D>(normal.normalized(), points, 1e-6 * std::sqrt(length)) < 3;
  };
  for (std::size_t i = 0; i < first; ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const Vec<D> along = points[i] - points[j];
      if constexpr (D == 2) {
        if (found(Vec<2>(-along[1], along[0]) * along.norm(), along.squaredNorm())) return true;
      } else {
        for (std::size_t k = 0; k < j; ++k)
          if (found(cross(along, points[k] - points[j]), along.squaredNorm())) return true;
      }
    }
  return false;
}

}  // namespace

template <int D>
void ParticleSet<D>::refuse(Real quality, const Vec<D>& x, const std::string& body) const {
  std::vector<Candidate<D>> near;
  candidates(x, 0, near);
  std::string place;
  for (int i = 0; i < D; ++i) place += fmt::format("{}{:.6g}", i ? ", " : "", x[i]);
  std::vector<Vec<D>> neighbours;
  for (const Candidate<D>& candidate : near) neighbours.push_back(at(cloud_.X, candidate.particle));
  const char* remedy =
      !limit_.empty()
          ? "more particles through the wall and along it: supports must end before the "
            "other side of the cavity"
      : lie_in_two_planes<D>(neighbours)
          ? (D == 3 ? "two layers of cells or more: the particles around lie in two planes at most"
                    : "two rows of cells or more: the particles around lie on two lines at most")
          : "a larger support_factor of [[body]], or more even cells (core and layers of round "
            "shapes, "
            "cells of boxes, a mesh with fewer slivers, less jitter)";
  throw SolveError(fmt::format(
      "body '{}': the shape functions are not determined at point ({}): {} neighbours, quality of "
      "the moment matrix {:.2g}, at least {:.0e} is needed; use {}",
      body, place, near.size(), quality, unusable_quality, remedy));
}

template struct ParticleCloud<2>;
template struct ParticleCloud<3>;
template class ParticleSet<2>;
template class ParticleSet<3>;

}  // namespace meniscus
