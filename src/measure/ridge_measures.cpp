// SPDX-License-Identifier: BSD-3-Clause
// Measures of a contact line: height of the ridge, and the angles at which the three surfaces meet.
#include "measure/ridge_measures.hpp"

#include "numbers/dense.hpp"
#include "physics/surface/closed_surface.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <numeric>
#include <optional>

namespace meniscus {
namespace {

constexpr int points_per_direction = 6;

/// A point in the half plane through the axis of the drop.
struct Place {
  Real r, z;
};

/// Least-squares coefficients of w = sum_k c_k f_k(s); empty for fewer than two points per
/// coefficient.
template <class Functions>
std::optional<Eigen::VectorXd> fit(const std::vector<Vec<2>>& points, Functions&& functions) {
  const Eigen::Index count = functions(1).size();
  if (static_cast<Eigen::Index>(points.size()) < 2 * count) return std::nullopt;
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(count, count);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(count);
  for (const Vec<2>& p : points) {
    const Eigen::VectorXd f = functions(p[0]);
    normal += f * f.transpose();
    right += p[1] * f;
  }
  return solve_symmetric(normal, right);
}

/// The functions 1, s, s^2 and s^2 log s: near a line force, the slope of an elastic surface under
/// tension changes as s log s.
Eigen::VectorXd beside_a_line(Real s) {
  return Eigen::Vector4d(1, s, s * s, s * s * std::log(s));
}
Eigen::VectorXd of_a_drop(Real s) {
  return Eigen::Vector3d(1, s, s * s);
}

template <int D>
class Ridge {
 public:
  Ridge(const Body<D>& drop, const Body<D>& ground, Real contact_gap)
      : drop_(drop), ground_(ground), contact_gap_(contact_gap) {
    Vec<D> way = middle(drop) - middle(ground);
    if (revolved()) way[0] = 0;
    way.cwiseAbs().maxCoeff(&axis_);
    up_ = way[axis_] < 0 ? -1 : 1;
  }

  Real height(const Motion& motion) {
    const std::vector<Place> face = profile(motion).face;
    return highest(face).z - level_;
  }
  Real radius(const Motion& motion) { return highest(profile(motion).face).r; }

  struct Angles {
    Real liquid = 0, solid = 0;  // angles in degrees
  };
  Angles angles(const Motion& motion) {
    const Profile p = profile(motion);
    const Place top = highest(p.face);
    const auto seen = [this](Real s) { return s > 0.75 * contact_gap_ && s < 6 * contact_gap_; };
    std::vector<Vec<2>> within, outside, free;
    for (const Place& x : p.face)
      if (seen(std::abs(x.r - top.r)))
        (x.r < top.r ? within : outside).emplace_back(std::abs(x.r - top.r), x.z - top.z);
    for (const Place& x : p.drop)
      if (seen(x.z - top.z) && x.r > top.r / 2) free.emplace_back(x.z - top.z, x.r - top.r);
    const auto wet = fit(within, beside_a_line), dry = fit(outside, beside_a_line),
               liquid = fit(free, of_a_drop);
    if (!wet || !dry || !liquid) return {};
    const auto tangent = [](Real r, Real z) { return Vec<2>(r, z).normalized(); };
    const Vec<2> inward = tangent(-1, (*wet)[1]), outward = tangent(1, (*dry)[1]),
                 upward = tangent((*liquid)[1], 1);
    const auto between = [](const Vec<2>& a, const Vec<2>& b) {
      return std::acos(std::clamp(a.dot(b), -1.0, 1.0)) * 180 / std::numbers::pi;
    };
    return {between(inward, upward), between(inward, outward)};
  }

 private:
  struct Profile {
    std::vector<Place> drop, face;
  };

  bool revolved() const { return drop_.geometry.grid.revolved; }
  static Vec<D> middle(const Body<D>& body) {
    const auto& X = body.particles.X();
    return std::accumulate(X.begin(), X.end(), Vec<D>(Vec<D>::Zero())) /
           static_cast<Real>(X.size());
  }
  static const Place& highest(const std::vector<Place>& face) {
    return *std::max_element(face.begin(), face.end(),
                             [](const Place& a, const Place& b) { return a.z < b.z; });
  }

  void build() {
    on_drop_.emplace(drop_, SurfacePart::outer, points_per_direction);
    on_ground_.emplace(ground_, SurfacePart::outer, points_per_direction);
    const auto& points = on_ground_->reference();
    level_ = -unbounded;
    for (std::size_t q = 0; q < points.area.size(); ++q) {
      if (up_ * at(points.N, q)[axis_] < 0.7) continue;
      face_.push_back(static_cast<Index>(q));
      level_ = std::max(level_, up_ * at(points.X, q)[axis_]);
    }
  }

  Profile profile(const Motion& motion) {
    if (!on_drop_) build();
    const auto drop = on_drop_->placed(motion), ground = on_ground_->placed(motion);
    const auto count = static_cast<Index>(on_drop_->reference().area.size());
    Vec<D> mean = Vec<D>::Zero();
    for (Index q = 0; q < count; ++q) mean += drop.place(q) / count;
    if (revolved()) mean[0] = 0;
    const auto in_half_plane = [&](const Vec<D>& x) {
      Vec<D> along = x - mean;
      along[axis_] = 0;
      return Place{along.norm(), up_ * x[axis_]};
    };
    Profile p;
    for (Index q = 0; q < count; ++q) p.drop.push_back(in_half_plane(drop.place(q)));
    for (const Index q : face_) p.face.push_back(in_half_plane(ground.place(q)));
    return p;
  }

  const Body<D>&drop_, &ground_;
  Real contact_gap_, up_ = 1, level_ = 0;
  Eigen::Index axis_ = 0;
  std::optional<ClosedSurface<D>> on_drop_, on_ground_;
  std::vector<Index> face_;  // points of the ground
};

}  // namespace

template <int D>
std::vector<MeasureSource> ridge_measures(const Body<D>& drop, const Body<D>& ground,
                                          Real contact_gap) {
  const auto ridge = std::make_shared<Ridge<D>>(drop, ground, contact_gap);
  return {{"ridge_height", dimension::length,
           "of the highest place of the face below the drop, over where it was",
           [ridge](const Motion& motion) { return ridge->height(motion); }},
          {"ridge_radius", dimension::length, "of that place, from the middle of the drop",
           [ridge](const Motion& motion) { return ridge->radius(motion); }},
          {"liquid_angle", dimension::degrees, "in degrees, of the drop at the ridge",
           [ridge](const Motion& motion) { return ridge->angles(motion).liquid; }},
          {"solid_angle", dimension::degrees, "in degrees, of the ridge",
           [ridge](const Motion& motion) { return ridge->angles(motion).solid; }}};
}

template std::vector<MeasureSource> ridge_measures(const Body<2>&, const Body<2>&, Real);
template std::vector<MeasureSource> ridge_measures(const Body<3>&, const Body<3>&, Real);

}  // namespace meniscus
