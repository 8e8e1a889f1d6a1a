// SPDX-License-Identifier: BSD-3-Clause
// Units: exact decimals, dimension checks, systems other than SI, and the words of the messages.
#include "input/names.hpp"
#include "input/units.hpp"
#include "meniscus/error.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace meniscus::test_units {
namespace {

std::string message(const UnitSystem& units, std::string_view text, Dimension expected) {
  try {
    units.quantity(text, expected);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

std::string system_message(std::string_view name) {
  try {
    UnitSystem{name};
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Units, QuantitiesInSiAreTheNearestDoubles) {
  const UnitSystem si;
  using namespace dimension;
  EXPECT_EQ(si.quantity("72.8 mN/m", tension), 0.0728);
  EXPECT_EQ(si.quantity("2.2 GPa", pressure), 2.2e9);
  EXPECT_EQ(si.quantity("0.6 mPa s", viscosity), 6e-4);
  EXPECT_EQ(si.quantity("0.6 mPa*s", viscosity), 6e-4);
  EXPECT_EQ(si.quantity("1e3 kg/m^3", density), 1000);
  EXPECT_EQ(si.quantity("1 g/cm^3", density), 1000);
  EXPECT_EQ(si.quantity("0.4 ns", time), 4e-10);
  EXPECT_EQ(si.quantity("5 nm", length), 5e-9);
  EXPECT_EQ(si.quantity("  +5nm", length), 5e-9);
  EXPECT_EQ(si.quantity("10 um", length), 1e-5);
  EXPECT_EQ(si.quantity("10 \u00b5m", length), 1e-5);
  EXPECT_EQ(si.quantity("10 \u03bcm", length), 1e-5);
  EXPECT_EQ(si.quantity("3 angstrom", length), 3e-10);
  EXPECT_EQ(si.quantity("4.11 zJ", energy), 4.11e-21);
  EXPECT_EQ(si.quantity("1 nL", dimension::volume), 1e-12);
  EXPECT_EQ(si.quantity("2 min", time), 120);
  EXPECT_EQ(si.quantity("1.5 h", time), 5400);
  EXPECT_EQ(si.quantity("3 kHz", rate), 3000);
  EXPECT_EQ(si.quantity("3 /s", rate), 3);
  EXPECT_EQ(si.quantity("3/s", rate), 3);
  EXPECT_EQ(si.quantity("-9.81 m/s^2", acceleration), -9.81);
  EXPECT_EQ(si.quantity("-9.81 m s^-2", acceleration), -9.81);
  EXPECT_EQ(si.quantity("7 TW", power), 7e12);
  EXPECT_EQ(si.quantity("1 fN", force), 1e-15);
  EXPECT_EQ(si.quantity("1 kg m/s", momentum), 1);
  EXPECT_EQ(si.quantity("2.5e-3 kg/(m s^2)", pressure), 2.5e-3);
  EXPECT_EQ(si.quantity("8 (mm/s)^2 kg", energy), 8e-6);
  EXPECT_EQ(si.quantity("100 dyn", force), 1e-3);
  EXPECT_EQ(si.quantity("72.8 dyn/cm", tension), 0.0728);
  EXPECT_EQ(si.quantity("72.8 erg/cm^2", tension), 0.0728);
  EXPECT_EQ(si.quantity("1 atm", pressure), 101325);
  EXPECT_DOUBLE_EQ(si.quantity("760 mmHg", pressure), 760 * 133.322387415);
  EXPECT_DOUBLE_EQ(si.quantity("1 psi", pressure), 0.45359237 * 9.80665 / (0.0254 * 0.0254));
  EXPECT_EQ(si.quantity("0.89 cP", viscosity), 0.89e-3);
  EXPECT_EQ(si.quantity("10 P", viscosity), 1);
  EXPECT_EQ(si.quantity("5 mbar", pressure), 500);
  EXPECT_DOUBLE_EQ(si.quantity("1 eV", energy), 1.602176634e-19);
  EXPECT_DOUBLE_EQ(si.quantity("2 meV/nm^2", tension), 2 * 1.602176634e-4);
  EXPECT_DOUBLE_EQ(si.quantity("1 kT", energy), 1.380649e-23 * 298.15);
  EXPECT_NEAR(si.quantity("20 kT", energy) / si.quantity("20 pN nm", energy), 4.116, 5e-4);
  EXPECT_DOUBLE_EQ(si.quantity("180 deg", none), std::numbers::pi);
  EXPECT_EQ(si.quantity("2 rad", none), 2);
  EXPECT_EQ(si.quantity("0.5", none), 0.5);
}

/// Angles are in radians, except where degrees are expected; "2 rad/s" is a rate.
TEST(Units, Angles) {
  const UnitSystem si, nano("nm-ps-ag");
  for (const UnitSystem* units : {&si, &nano}) {
    EXPECT_EQ(units->quantity("120 deg", dimension::degrees), 120);
    EXPECT_EQ(units->quantity("120", dimension::degrees), 120);
    EXPECT_DOUBLE_EQ(units->quantity("2 rad", dimension::degrees), 2 * 180 / std::numbers::pi);
    EXPECT_DOUBLE_EQ(units->quantity("120 deg", dimension::none), 2 * std::numbers::pi / 3);
    EXPECT_EQ(units->symbol(dimension::degrees), "deg");
  }
  EXPECT_DOUBLE_EQ(si.quantity("90 deg/s", dimension::rate), std::numbers::pi / 2);
  EXPECT_EQ(message(si, "2 m", dimension::degrees),
            "'2 m' is a length (m), expected an angle (deg)");
}

TEST(Units, PowersAndProductsAsTheyArePasted) {
  const UnitSystem si;
  using namespace dimension;
  EXPECT_EQ(si.quantity("1000 kg/m3", density), 1000);
  EXPECT_EQ(si.quantity("1 g/cm3", density), 1000);
  EXPECT_EQ(si.quantity("1 g cm-3", density), 1000);
  EXPECT_EQ(si.quantity("-9.81 m s-2", acceleration), -9.81);
  EXPECT_EQ(si.quantity("2 um3", dimension::volume), 2e-18);
  EXPECT_EQ(si.quantity("3 s-1", rate), 3);
  EXPECT_EQ(si.quantity("0.6 mPa\u00b7s", viscosity), 6e-4);
  EXPECT_EQ(si.quantity("4 pN\u22c5nm", energy), 4e-21);
  EXPECT_EQ(si.quantity("2 m\u00b2", area), 2);
  EXPECT_EQ(si.quantity("5 kg/m\u00b3", density), 5);
  EXPECT_EQ(si.quantity("5 kg m\u207b\u00b3", density), 5);
  EXPECT_EQ(si.quantity("9 (\u00b5m)\u00b2\u00b7s\u207b\u00b9/m", velocity), 9e-12);
  EXPECT_EQ(message(si, "5 m\u207b", area), "'5 m\u207b' lacks a power behind '5 m\u207b'");
  EXPECT_EQ(message(si, "5 m22", area), "'5 m22' has a power that is not in -9...9");
  EXPECT_EQ(message(si, "5 kg/m3 s2", pressure),
            "'5 kg/m3 s2' is ambiguous; expected the units of the divisor in brackets, e.g. "
            "kg/(m s^2)");
}

/// The end of the message about an unknown unit.
std::string suggestion(const std::string& unit) {
  const std::string text = message(UnitSystem("SI"), "1 " + unit, dimension::length);
  const std::size_t begin = text.find("; did you mean ");
  return begin == std::string::npos ? "" : text.substr(begin + 15);
}

TEST(Units, UnitsThatSomebodyMayHaveMeant) {
  EXPECT_EQ(suggestion("micron"), "'um'?");
  EXPECT_EQ(suggestion("Newton"), "'N'?");
  EXPECT_EQ(suggestion("\u00c5"), "'angstrom'?");
  EXPECT_EQ(suggestion("mpa"), "'mPa' or 'MPa'?");
  EXPECT_EQ(suggestion("KG"), "'kg'?");
  EXPECT_EQ(suggestion("kBT"), "'kT'?");
  EXPECT_EQ(suggestion("Nm"), "'N m' or 'nm'?");
  EXPECT_EQ(suggestion("mPas"), "'mPa s'?");
  EXPECT_EQ(suggestion("angstrm"), "'angstrom'?");
  EXPECT_EQ(suggestion("ergs"), "'erg'?");
  EXPECT_EQ(suggestion("kmin"), "'min'?");
  EXPECT_EQ(suggestion("q"), "");
  EXPECT_EQ(suggestion("furlong"), "");
  EXPECT_EQ(suggestion(std::string(5000, 'm')), "");
}

TEST(Units, QuantitiesInATripleAreExactToo) {
  const UnitSystem units("nm-ps-ag");
  using namespace dimension;
  EXPECT_EQ(units.quantity("5 nm", length), 5);
  EXPECT_EQ(units.quantity("0.4 ns", time), 400);
  EXPECT_EQ(units.quantity("72.8 mN/m", tension), 7.28e-5);  // ag/ps^2 = 1e3 N/m
  EXPECT_EQ(units.quantity("2.2 GPa", pressure), 2.2e-3);    // ag/(nm ps^2) = 1e12 Pa
  EXPECT_EQ(units.quantity("0.6 mPa s", viscosity), 6e-4);
  EXPECT_EQ(units.quantity("1e3 kg/m^3", density), 1e-3);
  EXPECT_EQ(units.in_si(length), 1e-9);
  EXPECT_EQ(units.in_si(pressure), 1e12);
  EXPECT_EQ(units.in_si(none), 1);
  EXPECT_EQ(UnitSystem("um-min-ng").in_si(velocity), 1e-6 / 60);
  EXPECT_EQ(UnitSystem("um-min-ng").quantity("1 um/s", velocity), 60);
}

TEST(Units, Symbols) {
  const UnitSystem si, units("nm-ps-ag");
  using namespace dimension;
  EXPECT_EQ(si.symbol(none), "1");
  EXPECT_EQ(si.symbol(pressure), "Pa");
  EXPECT_EQ(si.symbol(viscosity), "Pa s");
  EXPECT_EQ(si.symbol(tension), "N/m");
  EXPECT_EQ(si.symbol(density), "kg/m^3");
  EXPECT_EQ(si.symbol(energy), "J");
  EXPECT_EQ(si.symbol(force), "N");
  EXPECT_EQ(si.symbol(power), "W");
  EXPECT_EQ(si.symbol(velocity), "m/s");
  EXPECT_EQ(si.symbol(rate), "1/s");
  EXPECT_EQ(si.symbol(angular_momentum), "kg m^2/s");
  EXPECT_EQ(units.symbol(pressure), "ag/(nm ps^2)");
  EXPECT_EQ(units.symbol(length), "nm");
  EXPECT_EQ(units.symbol(none), "1");
  EXPECT_EQ(units.symbol(energy), "ag nm^2/ps^2");
}

TEST(Units, ASymbolReadsBackAsOne) {
  using namespace dimension;
  for (const char* name : {"SI", "nm-ps-ag", "um-us-ng", "mm-min-g"})
    for (const Dimension d :
         {length, area, dimension::volume, time, rate, velocity, acceleration, mass, density,
          pressure, viscosity, tension, force, energy, power, momentum, angular_momentum})
      EXPECT_DOUBLE_EQ(UnitSystem(name).quantity("1 " + UnitSystem(name).symbol(d), d), 1);
}

TEST(Units, MessagesAboutQuantities) {
  const UnitSystem si, units("nm-ps-ag");
  const std::string list =
      "allowed are m, s, g, N, dyn, Pa, bar, P, J, eV, W, Hz, L (prefixes z a f p n u m c k M G "
      "T), "
      "atm, psi, mmHg, erg, kT, min, h, angstrom, rad, deg";
  using namespace dimension;
  EXPECT_EQ(message(si, "2.2 GPa", tension),
            "'2.2 GPa' is a pressure (kg/(m s^2)), expected a tension (kg/s^2)");
  EXPECT_EQ(message(si, "2 m^5", length), "'2 m^5' is a quantity in m^5, expected a length (m)");
  EXPECT_EQ(message(si, "2 m", none), "'2 m' is a length (m), expected a plain number");
  EXPECT_EQ(message(si, "5", length),
            "'5' has no unit, expected a length (m); a number in m is written without quotes");
  EXPECT_EQ(message(units, "5", pressure),
            "'5' has no unit, expected a pressure (kg/(m s^2)); a number in ag/(nm ps^2) is "
            "written without quotes");
  EXPECT_EQ(message(si, "5 furlong", length), "unknown unit 'furlong'; " + list);
  EXPECT_EQ(message(si, "5 kmin", time), "unknown unit 'kmin'; " + list + "; did you mean 'min'?");
  EXPECT_EQ(
      message(si, "5 kg/m s^2", pressure),
      "'5 kg/m s^2' is ambiguous; expected the units of the divisor in brackets, e.g. kg/(m s^2)");
  EXPECT_EQ(message(si, "m", length), "'m' does not begin with a number");
  EXPECT_EQ(message(si, "nan m", length), "'nan m' does not begin with a number");
  EXPECT_EQ(message(si, "", length), "'' does not begin with a number");
  EXPECT_EQ(message(si, "0,5 m", length),
            "'0,5 m' has a decimal comma; decimals take a point, as in 0.5");
  EXPECT_EQ(message(si, "5 m/", length), "'5 m/' lacks a unit behind '5 m/'");
  EXPECT_EQ(message(si, "5 m)", length), "'5 m)' has a closing bracket too many");
  EXPECT_EQ(message(si, "5 (m", length), "'5 (m' lacks a closing bracket");
  EXPECT_EQ(message(si, "5 m^", length), "'5 m^' has a power that is not in -9...9");
  EXPECT_EQ(message(si, "5 m^22", length), "'5 m^22' has a power that is not in -9...9");
  EXPECT_EQ(message(si, "5 ((((((((((m", length), "'5 ((((((((((m' has too many brackets");
  EXPECT_EQ(message(si, "5e99999999999 m", length),
            "'5e99999999999 m' has an exponent that is too large");
  EXPECT_EQ(message(si, "5e308 Gm", length), "the number 5e317 is too large or too small");
  EXPECT_EQ(message(si, "1 ((((m^9)^9)^9)^9)", length),
            "'1 ((((m^9)^9)^9)^9)' has units of an absurd power");
}

TEST(Units, MessagesAboutSystems) {
  const std::string end = "; allowed are \"SI\" and a length-time-mass triple such as \"nm-ps-ag\"";
  EXPECT_EQ(system_message("nm-ps"),
            "unknown unit system 'nm-ps': three units joined by '-' are needed" + end);
  EXPECT_EQ(system_message("nm-ps-ag-K"),
            "unknown unit system 'nm-ps-ag-K': three units joined by '-' are needed" + end);
  EXPECT_EQ(system_message("ps-nm-ag"),
            "unknown unit system 'ps-nm-ag': 'ps' is a time (s), expected a length (m)" + end);
  EXPECT_EQ(system_message("cgs"),
            "unknown unit system 'cgs': three units joined by '-' are needed" + end);
  EXPECT_NE(system_message("nm--ag").find("unknown unit ''"), std::string::npos);
}

TEST(Names, EditDistance) {
  EXPECT_EQ(edit_distance("", ""), 0u);
  EXPECT_EQ(edit_distance("", "abc"), 3u);
  EXPECT_EQ(edit_distance("density", "densty"), 1u);
  EXPECT_EQ(edit_distance("density", "dnesity"), 1u);  // a swap
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);
}

TEST(Names, TheNearestIsOffered) {
  EXPECT_EQ(allowed_names("viscosty", {"density", "viscosity"}),
            "allowed are density, viscosity; did you mean 'viscosity'?");
  EXPECT_EQ(allowed_names("gamma", {"density", "viscosity"}), "allowed are density, viscosity");
  EXPECT_EQ(allowed_names("x", {"y"}), "allowed is y");
  EXPECT_EQ(allowed_names("x", {}), "none is allowed");
}

}  // namespace
}  // namespace meniscus::test_units
