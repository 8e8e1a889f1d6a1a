// SPDX-License-Identifier: BSD-3-Clause
// Checks all surfaces for crossings and for negative enclosed volumes.
#include "physics/surface/surface_check.hpp"

#include "body/particle_values.hpp"
#include "numbers/dense.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <numeric>

namespace meniscus {
namespace {

/// [simplex] number of its closed face. Simplices that share corners belong to one face.
template <int D>
std::vector<Index> closed_faces(const std::vector<std::array<Index, D>>& simplices, Index places) {
  std::vector<Index> joined(static_cast<std::size_t>(places));
  std::iota(joined.begin(), joined.end(), 0);
  const auto face_of = [&](Index place) {
    while (at(joined, place) != place) place = at(joined, place) = at(joined, at(joined, place));
    return place;
  };
  for (const auto& simplex : simplices)
    for (const Index corner : simplex) {
      const Index a = face_of(simplex[0]), b = face_of(corner);
      at(joined, std::max(a, b)) = std::min(a, b);
    }
  std::vector<Index> face;
  for (const auto& simplex : simplices) face.push_back(face_of(simplex[0]));
  return face;
}

/// D (3D: 6) times the volume between a simplex and the origin.
Real cone(const std::array<Vec<2>, 2>& x) {
  return x[0].x() * x[1].y() - x[0].y() * x[1].x();
}
Real cone(const std::array<Vec<3>, 3>& x) {
  return x[0].dot(cross(x[1], x[2]));
}

/// Volume enclosed by the simplices [begin, end) of a closed face; positive if they face outwards.
/// In the half plane of a body of revolution, the axis closes it.
template <int D>
Real enclosed_volume(const std::vector<std::array<Index, D>>& simplices, Index begin, Index end,
                     const std::vector<Vec<D>>& x, bool revolved) {
  Vec<D> origin = at(x, at(simplices, begin)[0]);
  if (revolved) origin[0] = 0;
  Real sum = 0;
  for (Index k = begin; k < end; ++k) {
    std::array<Vec<D>, D> corner;
    for (std::size_t a = 0; a < D; ++a) corner[a] = at(x, at(simplices, k)[a]) - origin;
    sum += cone(corner);
  }
  return sum / (D == 3 ? 6 : 2);
}

template <int D>
std::string text_of(const Vec<D>& x) {
  std::string text;
  for (int i = 0; i < D; ++i) text += fmt::format("{}{:.6g}", i ? ", " : "", x[i]);
  return "(" + text + ")";
}

}  // namespace

template <int D>
SurfaceCheck<D>::SurfaceCheck(std::vector<const Body<D>*> bodies,
                              std::function<std::string(std::size_t, std::size_t)> remedy)
    : bodies_(std::move(bodies)), remedy_(std::move(remedy)) {
  std::vector<std::array<Index, D>> all;
  std::vector<Vec<D>> X;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    const Body<D>& body = *bodies_[b];
    std::vector<Index> number(static_cast<std::size_t>(body.size()), -1);
    boundary_.push_back(boundary_nodes(body.geometry.grid));
    for (const Index A : boundary_.back()) {
      at(number, A) = static_cast<Index>(X.size());
      X.push_back(at(body.particles.X(), A));
      place_.push_back({b, A});
    }
    for (auto simplex : triangulate_boundary(body.geometry.grid)) {
      for (Index& corner : simplex) corner = at(number, corner);
      all.push_back(simplex);
    }
  }
  const std::vector<Index> face = closed_faces<D>(all, static_cast<Index>(X.size()));
  std::vector<Index> order(all.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](Index a, Index b) { return at(face, a) < at(face, b); });
  std::vector<std::array<Index, D>> simplices;
  std::vector<Index> group;
  for (const Index k : order) {
    if (group.empty() || group.back() != at(face, k))
      face_begin_.push_back(static_cast<Index>(group.size()));
    simplices.push_back(at(all, k));
    group.push_back(at(face, k));
  }
  face_begin_.push_back(static_cast<Index>(group.size()));
  for (std::size_t f = 0; f + 1 < face_begin_.size(); ++f)
    volume_.push_back(
        enclosed_volume<D>(simplices, face_begin_[f], face_begin_[f + 1], X, revolved()));
  search_.emplace(std::move(simplices), group, X);
}

template <int D>
std::vector<Vec<D>> SurfaceCheck<D>::places(const Motion& motion) const {
  std::vector<Vec<D>> x;
  x.reserve(place_.size());
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    const Body<D>& body = *bodies_[b];
    const NodalVectors u = values_at_particles<D>(body, motion.u.data() + body.first, boundary_[b]);
    for (std::size_t k = 0; k < u.size(); ++k) {
      x.push_back(at(body.particles.X(), boundary_[b][k]));
      for (int i = 0; i < D; ++i) x.back()[i] += u[k][i];
    }
  }
  return x;
}

template <int D>
std::optional<Failure> SurfaceCheck<D>::find(const Motion& motion) const {
  const std::vector<Vec<D>> x = places(motion);
  const auto failure = crossing_at(x);
  return failure ? failure : turned_face(x);
}

template <int D>
std::optional<Failure> SurfaceCheck<D>::crossing_at(const std::vector<Vec<D>>& x) const {
  if (revolved())
    if (auto failure = beyond_axis(x)) return failure;
  const auto crossing = search_->deepest(x);
  return crossing ? std::optional(describe(*crossing, x)) : std::nullopt;
}

template <int D>
std::optional<Failure> SurfaceCheck<D>::beyond_axis(const std::vector<Vec<D>>& x) const {
  const auto farthest = std::min_element(
      x.begin(), x.end(), [](const Vec<D>& a, const Vec<D>& b) { return a[0] < b[0]; });
  if (!((*farthest)[0] < 0)) return std::nullopt;
  const Place& place = place_[static_cast<std::size_t>(farthest - x.begin())];
  return Failure{at(bodies_, place.body)->first + place.particle,
                 "is beyond the axis x = 0: the body pinches off or closes over its axis, which is "
                 "not modelled; end before, or let a partner on the axis keep it away"};
}

template <int D>
std::optional<Failure> SurfaceCheck<D>::turned_face(const std::vector<Vec<D>>& x) const {
  for (std::size_t f = 0; f < volume_.size(); ++f) {
    const Real now =
        enclosed_volume<D>(search_->simplices(), face_begin_[f], face_begin_[f + 1], x, revolved());
    if (now * volume_[f] > 0) continue;
    const Place& place = at(place_, at(search_->simplices(), face_begin_[f])[0]);
    return Failure{
        at(bodies_, place.body)->first + place.particle,
        fmt::format("is on a closed face that is turned inside out: the {} it encloses was {:.4g} "
                    "in the reference and is {:.4g}; load the body less, or make it thicker or "
                    "stiffer",
                    D == 3 ? "volume" : "area", std::abs(volume_[f]), volume_[f] > 0 ? now : -now)};
  }
  return std::nullopt;
}

template <int D>
std::string SurfaceCheck<D>::particles_of(Index simplex) const {
  std::string text;
  for (const Index corner : at(search_->simplices(), simplex)) {
    const Place& place = at(place_, corner);
    text += fmt::format("{}{}", text.empty() ? "" : ", ",
                        at(bodies_, place.body)->first + place.particle);
  }
  return text;
}

template <int D>
Failure SurfaceCheck<D>::describe(const Crossing<D>& crossing, const std::vector<Vec<D>>& x) const {
  const auto& corners = at(search_->simplices(), crossing.first);
  const Index nearest = *std::min_element(corners.begin(), corners.end(), [&](Index a, Index b) {
    return (at(x, a) - crossing.place).squaredNorm() < (at(x, b) - crossing.place).squaredNorm();
  });
  const Place& place = at(place_, nearest);
  const std::size_t other = at(place_, at(search_->simplices(), crossing.second)[0]).body;
  const std::string through =
      other == place.body ? "itself" : fmt::format("body '{}'", at(bodies_, other)->name);
  return {at(bodies_, place.body)->first + place.particle,
          fmt::format("the surface goes through {}: its facet at the particles {} and the facet at "
                      "the particles {} cross at {}, by {:.3g}; {}",
                      through, particles_of(crossing.first), particles_of(crossing.second),
                      text_of<D>(crossing.place), crossing.depth, remedy_(place.body, other))};
}

template class SurfaceCheck<2>;
template class SurfaceCheck<3>;

}  // namespace meniscus
