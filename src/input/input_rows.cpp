// SPDX-License-Identifier: BSD-3-Clause
// The parts of input rows that do not depend on the type of the struct: texts and units.
#include "input/input.hpp"
#include "meniscus/error.hpp"

#include <fmt/core.h>

#include <cmath>
#include <string_view>

namespace meniscus {

namespace {}

bool Range::contains(Real value) const {
  if (!std::isfinite(value)) return false;
  return (low_open ? value > low : value >= low) && (high_open ? value < high : value <= high);
}

std::string Range::text() const {
  const bool above = low > -unbounded, below = high < unbounded;
  const std::string lower = fmt::format("{} {:.10g}", low_open ? ">" : ">=", low);
  const std::string upper = fmt::format("{} {:.10g}", high_open ? "<" : "<=", high);
  if (above && below) return lower + " and " + upper;
  return above ? lower : below ? upper : "any";
}

std::string Range::refusal(Real value, const std::string& unit) const {
  const std::string number = std::isnan(value) ? "nan" : fmt::format("{}", value);  // never "-nan"
  const std::string allowed = text();
  return fmt::format("{}{}{} is out of range; allowed is {}", number, unit.empty() ? "" : " ", unit,
                     allowed == "any" ? "a finite number" : allowed);
}

namespace rows {

std::string fallback_text(Real value) {
  return fmt::format("{}", value);
}
std::string fallback_text(int value) {
  return fmt::format("{}", value);
}
std::string fallback_text(bool value) {
  return value ? "true" : "false";
}
std::string fallback_text(const std::string& value) {
  return '"' + value + '"';
}
std::string fallback_text(const Expression& value) {
  return value.constant() ? value.text() : fallback_text(value.text());
}

std::string counted(std::size_t count, const std::string& what) {
  return count == 0 ? what : fmt::format("{} {}", count, what);
}

std::string si_symbol(Dimension d) {
  return d == dimension::none ? "" : UnitSystem("SI").symbol(d);
}

Range in_scene_units(const Range& range, Dimension d, const Block& block) {
  Range scaled = range;
  if (range.low > -unbounded) scaled.low = in_scene_units(range.low, d, block);
  if (range.high < unbounded) scaled.high = in_scene_units(range.high, d, block);
  return scaled;
}

void throw_out_of_range(const std::string& place, Real value, const Range& allowed,
                        const Eigen::Vector3d& X) {
  throw InputError(fmt::format("{}: at x = {}, y = {}, z = {} the value {}", place, X[0], X[1],
                               X[2], allowed.refusal(value)));
}

}  // namespace rows
}  // namespace meniscus
