// SPDX-License-Identifier: BSD-3-Clause
// Maps of the unit ball and disk onto exact surfaces, the solutions of curvature studies. None is
// affine or quadratic, since a quadratic basis reproduces such maps.
#pragma once
#include "body/shapes/smooth_map.hpp"

#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace meniscus::study {

/// A map, and a path of stages to its surface. The final surface is the surface of `map`, but the
/// path of its points may depend on the number of stages.
template <int D>
struct NamedMap {
  /// The map from the reference to the state after `stage` of `stages` stages.
  using Path = std::function<SmoothMap<D>(int stage, int stages)>;

  std::string name;
  Path path;
  SmoothMap<D> map;

  NamedMap(std::string map_name, Path way)
      : name(std::move(map_name)), path(std::move(way)), map(path(1, 1)) {}
};

/// 3D: twist_ellipsoid, biconcave, twist (the unit sphere onto itself), bent, wavy. 2D:
/// swirl_ellipse, biconcave_2d, swirl (the unit circle onto itself), bent_2d, wavy_2d. Stages of
/// twists are twists by a part of the angle, one after the other; other maps have straight paths.
template <int D>
const std::vector<NamedMap<D>>& named_maps();

/// The straight path X + s (x(X) - X), s = stage / stages.
template <int D>
typename NamedMap<D>::Path straight_path(SmoothMap<D> map);

/// The maps of a study, in 2D and 3D.
struct Maps {
  std::vector<NamedMap<2>> plane;
  std::vector<NamedMap<3>> space;
};

/// The map of a TOML file: formulas x, y of (x, y) for the disk, or x, y, z of (x, y, z) for the
/// ball, in reference coordinates. Derivatives are central differences of eighth order
/// (formula_map.cpp). Throws FileError, and InputError for wrong formulas and formulas that are not
/// twice differentiable on the unit ball.
Maps map_from_file(const std::string& path);

/// Throws InputError, naming map, place and determinant, if det F <= 0 or NaN at one of `places`:
/// the map folds the body, turns it inside out or has a pole.
template <int D>
void require_no_fold(const NamedMap<D>& map, std::span<const Vec<D>> places);

}  // namespace meniscus::study
