// SPDX-License-Identifier: BSD-3-Clause
// Shape measures of red blood cells.
#include "measure/cell_measures.hpp"

#include "body/wall_supports.hpp"
#include "measure/meridian_shape.hpp"
#include "meniscus/measure/measure_registry.hpp"
#include "physics/surface/closed_surface.hpp"

#include <cmath>
#include <memory>
#include <numbers>
#include <optional>

namespace meniscus {

namespace {

/// Builds an optional part when it is first used.
template <class T, class... Arguments>
T& built(std::optional<T>& part, Arguments&&... arguments) {
  if (!part) part.emplace(std::forward<Arguments>(arguments)...);
  return *part;
}

/// `micrometre`: one um in units of the scene.
template <int D>
class CellShape {
 public:
  CellShape(const Body<D>& body, Real micrometre) : body_(body), micrometre_(micrometre) {}

  MeanMeridian meridian(const Motion& m) { return built(meridians_, body_).mean(m); }
  typename ClosedSurface<D>::Size outer(const Motion& m) {
    return built(outer_, body_, SurfacePart::outer, 2).size(m);
  }
  typename ClosedSurface<D>::Size inner(const Motion& m) {
    return built(inner_, body_, SurfacePart::inner, 2).size(m);
  }
  struct Thickest {
    Real thickness, x;
  };
  /// The largest of many thicknesses, at the top of the parabola through it and its neighbours.
  static Thickest thickest(const MeanMeridian& meridian) {
    constexpr Real dx = 1.0 / (compared_places - 1);
    Thickest found{0, 0};
    for (int k = 0; k < compared_places; ++k) {
      const Real x = k * dx, t = meridian.thickness(x);
      // The margin prevents round-off from choosing a position on flat faces.
      if (t > found.thickness * (1 + 1e-9)) found = {t, x};
    }
    if (!(found.x > dx / 2) || !(found.x < 1 - dx / 2)) return found;
    const Real inward = meridian.thickness(found.x - dx) - found.thickness,
               outward = meridian.thickness(found.x + dx) - found.thickness;
    if (inward + outward < 0) found.x += 0.5 * dx * (inward - outward) / (inward + outward);
    return found;
  }
  /// Range of heights of the middle surface relative to the largest thickness. The rim, beyond 0.95
  /// of the radius, is left out, since its middle is ill-defined.
  static Real asymmetry(const MeanMeridian& meridian) {
    Real low = unbounded, high = -unbounded;
    for (int k = 0; k <= 95; ++k) {
      const Real middle = 0.5 * (meridian.upper(0.01 * k) + meridian.lower(0.01 * k));
      low = std::min(low, middle);
      high = std::max(high, middle);
    }
    return (high - low) / thickest(meridian).thickness;
  }
  static Real rim_spread(const MeanMeridian& meridian) {
    Real mean = 0, square = 0;
    const auto n = static_cast<Real>(meridian.rim_radius.size());
    for (const Real r : meridian.rim_radius) mean += r / n;
    for (const Real r : meridian.rim_radius) square += (r - mean) * (r - mean) / n;
    return std::sqrt(square) / mean;
  }
  Real evans_fung_rms(const MeanMeridian& meridian) const {
    const Real scale = 7.82 / (2 * meridian.radius());  // to the diameter of Evans and Fung
    Real sum = 0;
    for (int k = 0; k < compared_places; ++k) {
      const Real x = Real(k) / (compared_places - 1);
      sum += std::pow(scale * meridian.thickness(x) - evans_fung_thickness(x), 2);
    }
    return std::sqrt(sum / compared_places) * micrometre_;
  }

 private:
  const Body<D>& body_;
  Real micrometre_;
  std::optional<Meridians<D>> meridians_;
  std::optional<ClosedSurface<D>> outer_, inner_;
};

}  // namespace

template <int D>
std::vector<MeasureSource> cell_measures(const Body<D>& body, const UnitSystem& units) {
  if (!is_hollow(body.geometry) || body.space() == 2) return {};
  using Shape = CellShape<D>;
  const auto shape = std::make_shared<Shape>(body, 1e-6 / units.in_si(dimension::length));
  std::vector<MeasureSource> measures;
  const auto add = [&](const char* name, Dimension unit, const char* meaning, auto compute) {
    measures.push_back(
        {name, unit, meaning, [shape, compute](const Motion& m) { return compute(*shape, m); }});
  };
  add("diameter", dimension::length, "largest diameter of the mean meridian",
      [](Shape& s, const Motion& m) { return 2 * s.meridian(m).radius(); });
  add("pole_thickness", dimension::length, "outer thickness on the axis",
      [](Shape& s, const Motion& m) { return s.meridian(m).thickness(0); });
  add("largest_thickness", dimension::length, "largest outer thickness",
      [](Shape& s, const Motion& m) { return s.thickest(s.meridian(m)).thickness; });
  add("thickness_ratio", dimension::none, "pole_thickness / largest_thickness",
      [](Shape& s, const Motion& m) {
        const MeanMeridian meridian = s.meridian(m);
        return meridian.thickness(0) / s.thickest(meridian).thickness;
      });
  add("thickest_at", dimension::none, "radius of the largest thickness / outer radius",
      [](Shape& s, const Motion& m) { return s.thickest(s.meridian(m)).x; });
  add("asymmetry", dimension::none,
      "range of heights of the middle surface within 0.95 of the radius / largest_thickness",
      [](Shape& s, const Motion& m) { return s.asymmetry(s.meridian(m)); });
  if (D == 3)
    add("rim_spread", dimension::none, "standard deviation / mean of the radius around the rim",
        [](Shape& s, const Motion& m) { return s.rim_spread(s.meridian(m)); });
  add("evans_fung_rms", dimension::length,
      "rms difference of the thickness from Evans and Fung 1972 after scaling to 7.82 um",
      [](Shape& s, const Motion& m) { return s.evans_fung_rms(s.meridian(m)); });
  add("outer_volume", dimension::volume, "volume within the outer surface",
      [](Shape& s, const Motion& m) { return s.outer(m).volume; });
  add("outer_area", dimension::area, "area of the outer surface",
      [](Shape& s, const Motion& m) { return s.outer(m).area; });
  add("reduced_volume", dimension::none,
      "outer_volume / that of a sphere with the area of the outer surface",
      [](Shape& s, const Motion& m) {
        const auto outer = s.outer(m);
        return 6 * std::sqrt(std::numbers::pi) * outer.volume / std::pow(outer.area, 1.5);
      });
  add("cavity_volume", dimension::volume, "volume within the inner surface",
      [](Shape& s, const Motion& m) { return s.inner(m).volume; });
  add("cavity_area", dimension::area, "area of the inner surface",
      [](Shape& s, const Motion& m) { return s.inner(m).area; });
  return measures;
}

template std::vector<MeasureSource> cell_measures(const Body<2>&, const UnitSystem&);
template std::vector<MeasureSource> cell_measures(const Body<3>&, const UnitSystem&);

namespace {
const bool cell_measures_registered =
    register_measures("shell", cell_measures<2>, cell_measures<3>);
}

template <int D>
MeasureSource profile_rms(const Body<D>& body, std::vector<Real> r, std::vector<Real> z) {
  const auto meridians = std::make_shared<std::optional<Meridians<D>>>();
  return {
      "profile_rms", dimension::length, "rms distance of a given profile from the mean meridian",
      [&body, meridians, r = std::move(r), z = std::move(z)](const Motion& m) {
        const MeanMeridian mean = built(*meridians, body).mean(m);
        Real sum = 0;
        for (std::size_t k = 0; k < r.size(); ++k)
          sum += std::pow(mean.distance(r[k], z[k]), 2) + std::pow(mean.distance(r[k], -z[k]), 2);
        return std::sqrt(sum / (2 * static_cast<Real>(r.size())));
      }};
}

template MeasureSource profile_rms(const Body<2>&, std::vector<Real>, std::vector<Real>);
template MeasureSource profile_rms(const Body<3>&, std::vector<Real>, std::vector<Real>);

}  // namespace meniscus
