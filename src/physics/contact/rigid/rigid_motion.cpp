// SPDX-License-Identifier: BSD-3-Clause
// Translation of a rigid partner from formulas of the time, or by its press.
#include "physics/contact/rigid/rigid_motion.hpp"

#include <algorithm>

namespace meniscus {

template <int D>
RigidMotion<D>::RigidMotion(std::vector<Expression> displacement)
    : displacement_(std::move(displacement)) {
  displacement_.resize(D);
}

template <int D>
bool RigidMotion<D>::moves() const {
  return std::any_of(displacement_.begin(), displacement_.end(),
                     [](const Expression& d) { return d.depends_on_time(); });
}

template <int D>
Real RigidMotion<D>::steady_after() const {
  if (press_) return press_->steady_after();
  Real last = 0;
  for (const Expression& d : displacement_) last = std::max(last, d.steady_after());
  return last;
}

template <int D>
Vec<D> RigidMotion<D>::displacement(Real t) const {
  if (press_) return press_->displacement();
  Vec<D> d = Vec<D>::Zero();
  if (!displacement_.empty())
    for (int i = 0; i < D; ++i) d[i] = at(displacement_, i)(Eigen::Vector3d::Zero(), t);
  return d;
}

template <int D>
Vec<D> RigidMotion<D>::velocity(Real t, Real step) const {
  if (!moves()) return Vec<D>::Zero();
  const Vec<D> near = displacement(t + step) - displacement(t - step);
  const Vec<D> far = displacement(t + 2 * step) - displacement(t - 2 * step);
  return (8 * near - far) / (12 * step);
}

template class RigidMotion<2>;
template class RigidMotion<3>;

}  // namespace meniscus
