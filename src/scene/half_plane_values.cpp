// SPDX-License-Identifier: BSD-3-Clause
// Values of a 3D scene, in the half plane through an axis.
#include "scene/half_plane_values.hpp"

#include "meniscus/error.hpp"

#include <fmt/core.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <set>

namespace meniscus {

using scene_tree::Array;
using scene_tree::Entry;
using scene_tree::Value;

bool is_zero(const Value& value) {
  if (const auto* number = std::get_if<Real>(&value.data)) return *number == 0;
  if (const auto* number = std::get_if<std::int64_t>(&value.data)) return *number == 0;
  const auto* text = std::get_if<std::string>(&value.data);
  return text && *text == "0";
}

void HalfPlaneValues::refuse(const Value& at, const std::string& what) const {
  throw InputError(fmt::format("{}: {}", document_.place_text(at.place), what));
}

Real HalfPlaneValues::length(const Value& value) const {
  if (const auto* real = std::get_if<Real>(&value.data)) return *real;
  if (const auto* integer = std::get_if<std::int64_t>(&value.data))
    return static_cast<Real>(*integer);
  const auto* text = std::get_if<std::string>(&value.data);
  if (!text) refuse(value, "is no number");
  if (is_formula(*text))
    return document_.constants.value(document_.constants.functions.expanded(*text),
                                     dimension::length);
  return document_.units.quantity(*text, dimension::length);
}

std::optional<Real> HalfPlaneValues::angle(const Array& given) const {
  const Eigen::Vector3d place(length(given[0]), length(given[1]), length(given[2]));
  const Real reach = place.cwiseAbs().maxCoeff() + axis().through.cwiseAbs().maxCoeff();
  if (axis().in_half_plane(place)[0] <= 1e-9 * reach) return std::nullopt;
  const Eigen::Vector3d from_axis = place - axis().through;
  return std::atan2(from_axis[axis().normal()], from_axis[axis().across()]);
}

Array HalfPlaneValues::position(const Entry& entry, const Array& given,
                                bool has_to_be_on_axis) const {
  const Real distance =
      axis().in_half_plane({length(given[0]), length(given[1]), length(given[2])})[0];
  const bool on_axis = !angle(given);
  if (has_to_be_on_axis && !on_axis)
    refuse(entry.value,
           fmt::format("{} is {:.4g} beside the axis {} through ({:.4g}, {:.4g}, {:.4g})",
                       entry.key, distance, axis().name(), axis().through[0], axis().through[1],
                       axis().through[2]));
  Value across = given.front();
  across.data = entry.key == "point" || on_axis ? 0.0 : distance;
  return {across, at(given, axis().along)};
}

Array HalfPlaneValues::direction(const Entry& entry, const Array& given) const {
  if (!is_zero(at(given, axis().across())) || !is_zero(at(given, axis().normal())))
    refuse(entry.value, fmt::format("{} is not along the axis {}", entry.key, axis().name()));
  return {at(given, axis().across()), at(given, axis().along)};
}

bool HalfPlaneValues::is_formula(const std::string& text) const {
  try {
    Expression(document_.constants.functions.expanded(text), document_.constants.numbers());
    return true;
  } catch (const InputError&) {
    return false;  // a quantity with its unit, or another text
  }
}

Array HalfPlaneValues::vector(const Entry& entry, const Array& given) const {
  std::array<std::string, 3> formula;
  for (int k = 0; k < 3; ++k) {
    const auto* text = std::get_if<std::string>(&at(given, k).data);
    if (!text)
      at(formula, k) = toml_text(at(given, k));
    else if (is_formula(*text))
      at(formula, k) = *text;
    else  // a quantity: its number has the same direction
      at(formula, k) = fmt::format("{:.17g}", std::strtod(text->c_str(), nullptr));
  }
  if (const auto why = formulas_.uneven(formula, entry.key == "map"))
    refuse(entry.value, fmt::format("{} {}", entry.key, *why));
  Array made;
  for (const int k : {axis().across(), axis().along}) {
    Value component = at(given, k);
    const Real shift = entry.key == "map" && k != axis().along ? axis().through[k] : 0;
    if (auto* text = std::get_if<std::string>(&component.data)) *text = formulas_.rewritten(*text);
    if (shift != 0)
      component.data = fmt::format("{} - ({})", formulas_.rewritten(at(formula, k)), shift);
    made.push_back(component);
  }
  return made;
}

std::string HalfPlaneValues::scalar(const Entry& entry, const std::string& given) const {
  if (!is_formula(given)) return given;
  if (const auto why = formulas_.uneven(given))
    refuse(entry.value, fmt::format("{} {}", entry.key, *why));
  return formulas_.rewritten(given);
}

Array HalfPlaneValues::components(const Entry& entry, const Array& given) const {
  std::set<std::string> names;
  for (const Value& value : given)
    if (const auto* name = std::get_if<std::string>(&value.data)) names.insert(*name);
  const auto has = [&](int k) { return names.contains(std::string(1, "xyz"[k])); };
  if (has(axis().across()) != has(axis().normal()))
    refuse(entry.value, "components holds one direction across the axis, not both");
  Array made;
  if (has(axis().across())) made.push_back({std::string("x"), entry.value.place});
  if (has(axis().along)) made.push_back({std::string("y"), entry.value.place});
  return made;
}

scene_tree::Table HalfPlaneValues::functions(const scene_tree::Table& given) const {
  scene_tree::Table made = given;
  for (Entry& entry : made.entries)
    if (auto* formula = std::get_if<std::string>(&entry.value.data))
      *formula = formulas_.rewritten(*formula, Functions::signature(entry.key).arguments);
  return made;
}

}  // namespace meniscus
