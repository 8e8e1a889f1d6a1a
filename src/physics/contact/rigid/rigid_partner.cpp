// SPDX-License-Identifier: BSD-3-Clause
// Fields of rigid partners at four points, one after the other.
#include "physics/contact/rigid/rigid_partner.hpp"

namespace meniscus {
namespace {

template <int D>
Vec<D> point_of(const LanePlace<D>& x, int lane) {
  Vec<D> point;
  for (int i = 0; i < D; ++i) point[i] = at(x, i)[lane];
  return point;
}

}  // namespace

template <int D>
LaneField<D> RigidPartner<D>::fields(const LanePlace<D>& x, int points) const {
  LaneField<D> all{};
  for (int lane = 0; lane < points; ++lane) {
    const RigidField<D> f = field(point_of<D>(x, lane));
    all.U.set(lane, f.U);
    for (int i = 0; i < D; ++i) {
      at(all.S, i).set(lane, f.S[i]);
      for (int j = 0; j < D; ++j) at(at(all.grad_S, i), j).set(lane, f.grad_S(i, j));
    }
  }
  all.distance = distances(x);
  return all;
}

template <int D>
Lanes RigidPartner<D>::distances(const LanePlace<D>& x) const {
  Lanes all = Lanes::zero();
  for (int lane = 0; lane < Lanes::width; ++lane) all.set(lane, distance(point_of<D>(x, lane)));
  return all;
}

template class RigidPartner<2>;
template class RigidPartner<3>;

}  // namespace meniscus
