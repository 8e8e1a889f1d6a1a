// SPDX-License-Identifier: BSD-3-Clause
// The meridian of a drop at rest on a plane, from its sphere down through the range to the film.
#include "physics/contact/bent_line.hpp"

#include "physics/contact/contact_numbers.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace meniscus {
namespace {

constexpr Real pi = std::numbers::pi;

/// The interaction as a function of the height h above the film, scaled to the adhesion W = w
/// gamma.
struct PullAtHeight {
  const Interaction& interaction;
  Real w;
  Real rest = interaction.flat().equilibrium_gap;
  Real deepest = -interaction.at(rest).energy;

  /// The part of the adhesion that a surface has at h, and its derivative.
  std::pair<Real, Real> at(Real h) const {
    if (!(h > 0)) return {1, 0};
    const PlaneState state = interaction.at(rest + h);
    return {-state.energy / deepest, state.pressure / deepest};
  }
};

/// A point of the meridian: distance r from the axis, height h above the film, slope phi (0 along
/// the film), and the area of full contact between the axis and this point.
struct MeridianPoint {
  Real r, h, phi, area;

  MeridianPoint moved(Real ds, const MeridianPoint& rate) const {
    return {r + ds * rate.r, h + ds * rate.h, phi + ds * rate.phi, area + ds * rate.area};
  }
};

/// A cap whose sphere meets the wall, at the depth `depth` below the film, at the angle theta.
class BentCap {
 public:
  BentCap(const PullAtHeight& pull, Real theta, Real radius, int dimension)
      : pull_(pull), theta_(theta), radius_(radius), dimension_(dimension) {
    const PlaneContact flat = pull.interaction.flat();
    unit_ = flat.peak_gap - flat.equilibrium_gap;
    begin_ = pull.interaction.range() - flat.equilibrium_gap;
  }

  Real range() const { return begin_; }
  /// The point at which the meridian is parallel to the film. Its height is range() if the sphere
  /// lies above the range, and - range() if it lies within or if the meridian falls below the film.
  MeridianPoint end(Real depth) const {
    constexpr int most_steps = 20000;
    const Real centre = -sphere() * std::cos(theta_) - depth, above = (begin_ - centre) / sphere();
    if (!(std::abs(above) < 1)) return {0, above > 0 ? -begin_ : begin_, 0, 0};
    MeridianPoint now{sphere() * std::sqrt(1 - above * above), begin_, std::acos(-above), 0};
    for (int step = 0; step < most_steps && now.r > 0 && now.h > -begin_; ++step) {
      const Real ds = -(unit_ + std::max(0.0, now.h)) / 64;
      const MeridianPoint a = rate(now), b = rate(now.moved(ds / 2, a)),
                          c = rate(now.moved(ds / 2, b)), d = rate(now.moved(ds, c));
      const MeridianPoint mean{(a.r + 2 * b.r + 2 * c.r + d.r) / 6,
                               (a.h + 2 * b.h + 2 * c.h + d.h) / 6,
                               (a.phi + 2 * b.phi + 2 * c.phi + d.phi) / 6,
                               (a.area + 2 * b.area + 2 * c.area + d.area) / 6};
      const MeridianPoint next = now.moved(ds, mean);
      if (next.phi <= 0) return now.moved(ds * now.phi / (now.phi - next.phi), mean);
      now = next;
    }
    return {0, -begin_, 0, 0};
  }
  /// Radius of a disk (2D: half of the length) of the area in full contact.
  Real disk(const MeridianPoint& film) const {
    if (dimension_ == 2) return film.r - film.area;
    return std::sqrt(std::max(0.0, film.r * film.r - film.area / pi));
  }

 private:
  Real sphere() const { return radius_ / std::sin(theta_); }
  /// Derivatives along the meridian, by the balance of curvature, pressure and interaction.
  MeridianPoint rate(const MeridianPoint& at) const {
    const auto [part, slope] = pull_.at(at.h);
    const Real round = dimension_ == 3 ? 1 : 0, c = std::cos(at.phi), s = std::sin(at.phi);
    return {c, s, (1 + round) / sphere() - round * s / at.r - pull_.w * slope,
            part * c * (dimension_ == 3 ? 2 * pi * at.r : 1)};
  }

  PullAtHeight pull_;
  Real theta_, radius_;
  int dimension_;
  Real unit_, begin_;
};

/// The depth at which the meridian ends on the film, by bisection: the deeper the wall, the lower
/// the end. `shift` is the largest effect of a line tension. Empty if there is none.
std::optional<Real> depth_of(const BentCap& cap, Real shift) {
  constexpr int halvings = 50;
  Real low = -3 * cap.range() - shift, high = 1.5 * cap.range() + shift;
  if (!(cap.end(low).h > 0 && cap.end(high).h < 0)) return std::nullopt;
  for (int halving = 0; halving < halvings; ++halving) {
    const Real middle = (low + high) / 2;
    (cap.end(middle).h > 0 ? low : high) = middle;
  }
  return (low + high) / 2;
}

}  // namespace

Real base_of_cap(Real theta, int dimension) {
  const Real c = std::cos(theta), s = std::sin(theta);
  if (dimension == 2) return s / std::sqrt(theta - s * c);
  return s / std::cbrt(pi / 3 * (2 - 3 * c + c * c * c));
}

BentLine bent_line(const Interaction& interaction, Real adhesion, Real gamma, Real volume,
                   int dimension) {
  constexpr Real least_angle = 15;  // degrees
  constexpr int rounds = 60;        // of radius and line tension
  const Real w = std::min(adhesion, adhesion_of_angle(least_angle, gamma)) / gamma;
  if (!(w > 0) || !interaction.ends()) return {};
  const Real tau = interaction.line_tension() / gamma;
  Real theta = std::acos(w - 1), radius = 0;
  for (int round = 0; round < (tau == 0 ? 1 : rounds); ++round) {
    radius =
        base_of_cap(theta, dimension) * (dimension == 3 ? std::cbrt(volume) : std::sqrt(volume));
    theta = std::acos(w - 1 - (tau == 0 ? 0 : tau / radius));
    if (!(theta > 0 && theta < pi)) return {};
  }
  const BentCap cap({interaction, w}, theta, radius, dimension);
  const std::optional<Real> depth = depth_of(cap, 2 * std::abs(tau) / std::sin(theta));
  if (!depth) return {};
  return {*depth, radius - cap.disk(cap.end(*depth)), radius};
}

}  // namespace meniscus
