// SPDX-License-Identifier: BSD-3-Clause
// Values of a 3D scene, in the half plane through an axis.
#pragma once
#include "input/input_node.hpp"
#include "scene/half_plane_formulas.hpp"

#include <optional>
#include <string>
#include <vector>

namespace meniscus {

/// Rewrites places, directions, vectors and formulas. All members throw InputError with the place
/// of a value that is not of revolution.
class HalfPlaneValues {
 public:
  using Value = scene_tree::Value;
  using Array = scene_tree::Array;
  using Entry = scene_tree::Entry;

  HalfPlaneValues(const Document& document, const TwinAxis& axis,
                  const std::vector<Eigen::Vector3d>& places)
      : document_(document), formulas_(axis, document.constants, places) {}

  const TwinAxis& axis() const { return formulas_.axis(); }
  [[noreturn]] void refuse(const Value& at, const std::string& what) const;
  /// A length in units of the scene.
  Real length(const Value& value) const;
  /// Distance from the axis and coordinate along it. The `point` of a plane is moved to the axis.
  Array position(const Entry& entry, const Array& given, bool has_to_be_on_axis = false) const;
  /// The angle about the axis; empty on it.
  std::optional<Real> angle(const Array& given) const;
  Array direction(const Entry& entry, const Array& given) const;
  /// Three numbers or formulas.
  Array vector(const Entry& entry, const Array& given) const;
  /// A number, quantity or formula.
  std::string scalar(const Entry& entry, const std::string& given) const;
  /// Names of components that are held.
  Array components(const Entry& entry, const Array& given) const;
  /// The table [functions].
  scene_tree::Table functions(const scene_tree::Table& given) const;

 private:
  bool is_formula(const std::string& text) const;

  const Document& document_;
  HalfPlaneFormulas formulas_;
};

/// Whether a value is the number 0.
bool is_zero(const scene_tree::Value& value);

}  // namespace meniscus
