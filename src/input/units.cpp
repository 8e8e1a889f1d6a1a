// SPDX-License-Identifier: BSD-3-Clause
// Physical dimensions and the unit system of a scene.
#include "input/units.hpp"

#include "input/quantity.hpp"
#include "meniscus/error.hpp"

#include <fmt/core.h>

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace meniscus {
namespace {

constexpr std::pair<Dimension, std::string_view> dimension_names[] = {
    {dimension::none, "a plain number"}, {dimension::length, "a length"},
    {dimension::area, "an area"},        {dimension::volume, "a volume"},
    {dimension::time, "a time"},         {dimension::rate, "a rate"},
    {dimension::velocity, "a velocity"}, {dimension::acceleration, "an acceleration"},
    {dimension::mass, "a mass"},         {dimension::density, "a density"},
    {dimension::pressure, "a pressure"}, {dimension::viscosity, "a viscosity"},
    {dimension::tension, "a tension"},   {dimension::force, "a force"},
    {dimension::energy, "an energy"},    {dimension::power, "a power"},
    {dimension::momentum, "a momentum"}, {dimension::angular_momentum, "an angular momentum"},
};

/// A product of base units as text: mass, length, time; negative powers follow the slash.
std::string composed(Dimension d, std::string_view length, std::string_view time,
                     std::string_view mass) {
  std::string above, below;
  int divisors = 0;
  const auto append = [&](std::string_view symbol, int power) {
    if (power == 0) return;
    if (power < 0) ++divisors;
    std::string& side = power > 0 ? above : below;
    if (!side.empty()) side += ' ';
    side += symbol;
    if (std::abs(power) != 1) side += fmt::format("^{}", std::abs(power));
  };
  append(mass, d.mass);
  append(length, d.length);
  append(time, d.time);
  if (above.empty()) above = "1";
  if (below.empty()) return above;
  return above + (divisors > 1 ? "/(" + below + ")" : "/" + below);
}

/// digits * 10^tens, correctly rounded.
Real decimal(std::string_view digits, int tens) {
  const std::string text = fmt::format("{}e{}", digits, tens);
  Real value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value))
    throw InputError(fmt::format("the number {} is too large or too small", text));
  return value;
}

}  // namespace

std::string name_of(Dimension d) {
  if (d == dimension::degrees) return "an angle (deg)";
  for (const auto& [known, name] : dimension_names)
    if (known == d)
      return d == dimension::none ? std::string(name)
                                  : fmt::format("{} ({})", name, composed(d, "m", "s", "kg"));
  return fmt::format("a quantity in {}", composed(d, "m", "s", "kg"));
}

UnitSystem::UnitSystem(std::string_view name) : name_(name), length_{"m"}, time_{"s"}, mass_{"kg"} {
  if (name == "SI") return;
  const auto refuse = [&](const std::string& reason) {
    throw InputError(fmt::format(
        "unknown unit system '{}': {}; allowed are \"SI\" and a length-time-mass triple such as "
        "\"nm-ps-ag\"",
        name, reason));
  };
  std::string_view rest = name;
  const auto next = [&](Dimension expected, bool last) {
    const std::size_t dash = rest.find('-');
    if (last != (dash == std::string_view::npos)) refuse("three units joined by '-' are needed");
    const std::string_view symbol = rest.substr(0, dash);
    rest.remove_prefix(last ? rest.size() : dash + 1);
    Unit unit;
    try {
      unit = unit_called(symbol);
    } catch (const InputError& error) {
      refuse(error.what());
    }
    if (unit.dimension != expected)
      refuse(fmt::format("'{}' is {}, expected {}", symbol, name_of(unit.dimension),
                         name_of(expected)));
    return Base{std::string(symbol), unit.tens, unit.factor};
  };
  length_ = next(dimension::length, false);
  time_ = next(dimension::time, false);
  mass_ = next(dimension::mass, true);
}

int UnitSystem::tens(Dimension d) const {
  return d.length * length_.tens + d.time * time_.tens + d.mass * mass_.tens;
}

Real UnitSystem::factor(Dimension d) const {
  return std::pow(length_.factor, d.length) * std::pow(time_.factor, d.time) *
         std::pow(mass_.factor, d.mass);
}

Real UnitSystem::quantity(std::string_view text, Dimension expected) const {
  expected = settled(expected);
  const auto [digits, exponent, unit] = read_quantity(text);
  if (expected == dimension::degrees && unit.dimension == dimension::none)
    return decimal(digits, exponent + unit.tens) * (unit.factor / std::pow(degree, unit.angle));
  if (unit.dimension != expected) {
    if (unit.dimension == dimension::none)
      throw InputError(
          fmt::format("'{}' has no unit, expected {}; a number in {} is written without quotes",
                      text, name_of(expected), symbol(expected)));
    throw InputError(
        fmt::format("'{}' is {}, expected {}", text, name_of(unit.dimension), name_of(expected)));
  }
  return decimal(digits, exponent + unit.tens - tens(expected)) * (unit.factor / factor(expected));
}

std::string UnitSystem::symbol(Dimension d) const {
  d = settled(d);
  static constexpr std::pair<Dimension, std::string_view> derived[] = {
      {dimension::pressure, "Pa"}, {dimension::viscosity, "Pa s"}, {dimension::tension, "N/m"},
      {dimension::force, "N"},     {dimension::energy, "J"},       {dimension::power, "W"}};
  if (d == dimension::degrees) return "deg";
  if (name_ == "SI")
    for (const auto& [known, symbol] : derived)
      if (known == d) return std::string(symbol);
  return composed(d, length_.symbol, time_.symbol, mass_.symbol);
}

Real UnitSystem::in_si(Dimension d) const {
  d = settled(d);
  return decimal("1", tens(d)) * factor(d);
}

}  // namespace meniscus
