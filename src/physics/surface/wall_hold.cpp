// SPDX-License-Identifier: BSD-3-Clause
// Forces on the points of a wetted face.
#include "physics/surface/wall_hold.hpp"

#include "kernel/row_sums.hpp"
#include "numbers/dense.hpp"

namespace meniscus {
namespace {

template <std::size_t D>
NodalVector lanes(const std::array<Real, D>& v) {
  NodalVector all = Lanes::zero();
  for (std::size_t i = 0; i < D; ++i) all.set(static_cast<int>(i), v[i]);
  return all;
}

}  // namespace

template <int D>
WallHold<D>::WallHold(const Body<D>& body, const WettedFace<D>& face, Real stiffness)
    : body_(body), face_(face), stiffness_(stiffness), points_(body.geometry, face.face) {
  rows_ = build_point_rows<D>(body.particles, points_.X, {.value = true}, body.name);
  chunk_sums_ = body.chunk_sums(rows_.start, rows_.particle);
  of_chunks_ = chunk_sums_.template tally<OfChunk>();
}

template <int D>
template <class T>
typename WallHold<D>::template Vector<T> WallHold<D>::place(Index q, const NodalVector* u,
                                                            const NodalVector* du) const {
  const Lanes moved = value_at(rows_, q, u);
  Vector<T> y;
  for (int i = 0; i < D; ++i) at(y, i) = T(at(points_.X, q)[i] + moved[i]);
  if constexpr (std::is_same_v<T, Dual<Real>>) {
    const Lanes change = value_at(rows_, q, du);
    for (int i = 0; i < D; ++i) at(y, i).d = change[i];
  }
  return y;
}

template <int D>
template <class T>
typename WallHold<D>::template Vector<T> WallHold<D>::pull_on(Index q, const Vector<T>& y,
                                                              const WettedWall<D>& wall) const {
  const auto foot = wall.template foot<T>(y);
  Vector<T> pull;
  for (int i = 0; i < D; ++i)
    at(pull, i) = -stiffness_ * at(points_.area, q) * foot.distance * at(foot.normal, i);
  return pull;
}

template <int D>
Report WallHold<D>::add_force(const Motion& motion, Forces force) {
  const NodalVector* u = motion.u.data() + body_.first;
  const WettedWall<D> wall = face_.wall_at(motion.time);
  const Vec<D> velocity = face_.velocity_at(motion.time);
  chunk_sums_.accumulate(body_.part(force), [&](int chunk, Index begin, Index end, NodalVector* f) {
    OfChunk all;
    for (Index q = begin; q < end; ++q) {
      const auto y = place<Real>(q, u, nullptr);
      const auto pull = pull_on<Real>(q, y, wall);
      scatter_value(rows_, q, lanes(pull), f);
      all.outside +=
          Resultant(spatial(lanes(pull)), cross(spatial(lanes(y)), spatial(lanes(pull))));
      for (int i = 0; i < D; ++i) all.power += at(pull, i) * velocity[i];
    }
    of_chunks_[chunk] = all;
  });
  return force.gather({of_chunks_.gathered()}, motion, [this](const Motion&, const Forces&) {
    const OfChunk all = of_chunks_.sum(OfChunk());
    Report report;
    report.outside = all.outside;
    report.external_power = all.power;
    return report;
  });
}

template <int D>
void WallHold<D>::add_tangent(const Motion& motion, const Motion& change, Forces force) {
  const NodalVector *u = motion.u.data() + body_.first, *du = change.u.data() + body_.first;
  const WettedWall<D> wall = face_.wall_at(motion.time);
  chunk_sums_.accumulate(body_.part(force), [&](int, Index begin, Index end, NodalVector* f) {
    for (Index q = begin; q < end; ++q) {
      const auto pull = pull_on<Dual<Real>>(q, place<Dual<Real>>(q, u, du), wall);
      std::array<Real, D> change_of_pull;
      for (int i = 0; i < D; ++i) at(change_of_pull, i) = at(pull, i).d;
      scatter_value(rows_, q, lanes(change_of_pull), f);
    }
  });
}

template <int D>
std::optional<Real> WallHold<D>::stored_energy(const Motion& motion) const {
  const NodalVector* u = motion.u.data() + body_.first;
  const WettedWall<D> wall = face_.wall_at(motion.time);
  return body_.sum_over_rows(rows_.size(), 0.0, [&](Index q) {
    const Real d = wall.template foot<Real>(place<Real>(q, u, nullptr)).distance;
    return stiffness_ / 2 * at(points_.area, q) * d * d;
  });
}

template <int D>
Eigen::Vector3d WallHold<D>::force_on_body(const Motion& motion) const {
  const NodalVector* u = motion.u.data() + body_.first;
  const WettedWall<D> wall = face_.wall_at(motion.time);
  return spatial(body_.sum_over_rows(rows_.size(), Lanes::zero(), [&](Index q) {
    return lanes(pull_on<Real>(q, place<Real>(q, u, nullptr), wall));
  }));
}

template class WallHold<2>;
template class WallHold<3>;

}  // namespace meniscus
