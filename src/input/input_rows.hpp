// SPDX-License-Identifier: BSD-3-Clause
// Rows: each describes one key of a struct for reading, checking, defaults and documentation.
// Included at the end of input.hpp, whose names it uses.
#pragma once
#include "input/text.hpp"

#include <algorithm>
#include <functional>
#include <limits>

namespace meniscus {

/// One key of the struct M. The range, fallback and typical value of a row are in SI and converted
/// to the units of the scene; read() stores numbers in the units of the scene.
template <class M>
struct Row {
  std::string key, type, unit, range, fallback, meaning;  ///< as `meniscus keys` prints them
  std::function<void(M&, const Block&)> read;
  /// The members below are set for material parameters only, which may be formulas, and are used by
  /// tests of laws.
  Real M::*member = nullptr;
  Dimension dimension{};
  Range allowed{};
  Real typical = 0;
  std::optional<Real> number{};  ///< default of a parameter
};
template <class M>
using Rows = std::vector<Row<M>>;

// Functions that make rows. Without `fallback` the key is required.
template <class M>
Row<M> real_row(std::string key, Real M::*member, Dimension, Range, std::string meaning,
                std::optional<Real> fallback = {});
/// A material parameter: `typical` is its value in the generic tests of laws.
template <class M>
Row<M> parameter_row(std::string key, Real M::*member, Dimension, Range, std::string meaning,
                     Real typical, std::optional<Real> fallback = {});
template <class M>
Row<M> integer_row(std::string key, int M::*member, Range, std::string meaning,
                   std::optional<int> fallback = {});
template <class M>
Row<M> flag_row(std::string key, bool M::*member, std::string meaning,
                std::optional<bool> fallback = {});
template <class M>
Row<M> text_row(std::string key, std::string M::*member, std::string meaning,
                std::optional<std::string> fallback = {});
template <class M>
Row<M> choice_row(std::string key, std::string M::*member, std::vector<std::string> allowed,
                  std::string meaning, std::optional<std::string> fallback = {});
template <class M>
Row<M> texts_row(std::string key, std::vector<std::string> M::*member, std::string meaning,
                 std::optional<std::vector<std::string>> fallback = {});
/// `count` numbers, or any number of them if count = 0.
template <class M>
Row<M> reals_row(std::string key, std::vector<Real> M::*member, std::size_t count, Dimension, Range,
                 std::string meaning, std::optional<std::vector<Real>> fallback = {});
/// `count` numbers or formulas, or any number of them if count = 0. Fallbacks that are formulas
/// must not depend on the units.
template <class M>
Row<M> expressions_row(std::string key, std::vector<Expression> M::*member, std::size_t count,
                       Dimension, std::string meaning,
                       std::optional<std::vector<Expression>> fallback = {});

/// Reads M by its rows M::rows(). The caller then reads further keys of the same table, if there
/// are any, and calls block.done().
template <class M>
M read(const Block& block) {
  M m{};
  for (const Row<M>& row : M::rows()) row.read(m, block);
  return m;
}

/// A struct whose parameters may vary with the reference position.
template <class M>
struct Varying {
  struct Formula {
    std::string place;  ///< "file:line:column: key", to begin messages with
    Real M::*member;
    Expression value;
    Range allowed;  ///< in units of the scene
  };
  M base;                         ///< parameters with a formula hold their value at the origin
  std::vector<Formula> formulas;  ///< empty: uniform

  bool uniform() const { return formulas.empty(); }
  /// The parameters at reference position X. Throws InputError naming key, position and value if a
  /// formula leaves its range.
  M at(const Eigen::Vector3d& X) const;
};

/// Like read(), but parameters (parameter_row) may be given as formulas of x, y, z.
template <class M>
Varying<M> read_varying(const Block& block);

// ------------------------------------------------------------------------------------------------

namespace rows {

std::string fallback_text(Real);
std::string fallback_text(int);
std::string fallback_text(bool);
std::string fallback_text(const std::string&);
std::string fallback_text(const Expression&);
/// "3 numbers" or "numbers".
std::string counted(std::size_t count, const std::string& what);
std::string si_symbol(Dimension);
/// `range`, given in SI, converted to the units of `block`.
Range in_scene_units(const Range& range, Dimension, const Block& block);
[[noreturn]] void throw_out_of_range(const std::string& place, Real value, const Range& allowed,
                                     const Eigen::Vector3d& X);

template <class T>
std::string fallback_text(const std::vector<T>& values) {
  std::vector<std::string> items;
  for (const T& value : values) items.push_back(fallback_text(value));
  return "[" + joined(items, ", ") + "]";
}

template <class T>
std::string default_text(const std::optional<T>& fallback) {
  return fallback ? fallback_text(*fallback) : "required";
}

inline Real in_scene_units(Real si, Dimension d, const Block& block) {
  return si / block.units().in_si(d);
}
inline Expression in_scene_units(const Expression& si, Dimension d, const Block& block) {
  return si.constant() ? Expression(in_scene_units(si({0, 0, 0}), d, block)) : si;
}
template <class T>
std::vector<T> in_scene_units(std::vector<T> si, Dimension d, const Block& block) {
  for (T& value : si) value = in_scene_units(value, d, block);
  return si;
}
template <class T>
std::optional<T> in_scene_units(const std::optional<T>& si, Dimension d, const Block& block) {
  return si ? std::optional<T>(in_scene_units(*si, d, block)) : std::nullopt;
}

}  // namespace rows

template <class M>
Row<M> real_row(std::string key, Real M::*member, Dimension d, Range allowed, std::string meaning,
                std::optional<Real> fallback) {
  return {key,
          "number",
          rows::si_symbol(d),
          allowed.text(),
          rows::default_text(fallback),
          meaning,
          [=](M& m, const Block& block) {
            m.*member = block.real(key, d, rows::in_scene_units(allowed, d, block),
                                   rows::in_scene_units(fallback, d, block));
          }};
}

template <class M>
Row<M> parameter_row(std::string key, Real M::*member, Dimension d, Range allowed,
                     std::string meaning, Real typical, std::optional<Real> fallback) {
  Row<M> row = real_row(std::move(key), member, d, allowed, std::move(meaning), fallback);
  row.type = "number or formula";
  row.member = member;
  row.dimension = d;
  row.allowed = allowed;
  row.typical = typical;
  row.number = fallback;
  return row;
}

template <class M>
Row<M> integer_row(std::string key, int M::*member, Range allowed, std::string meaning,
                   std::optional<int> fallback) {
  Range fitting = allowed;
  fitting.low = std::max<Real>(allowed.low, std::numeric_limits<int>::min());
  fitting.high = std::min<Real>(allowed.high, std::numeric_limits<int>::max());
  return {key,
          "integer",
          "",
          allowed.text(),
          rows::default_text(fallback),
          std::move(meaning),
          [=](M& m, const Block& block) {
            m.*member = static_cast<int>(block.integer(key, fitting, fallback));
          }};
}

template <class M>
Row<M> flag_row(std::string key, bool M::*member, std::string meaning,
                std::optional<bool> fallback) {
  return {key,
          "true or false",
          "",
          "",
          rows::default_text(fallback),
          std::move(meaning),
          [=](M& m, const Block& block) { m.*member = block.flag(key, fallback); }};
}

template <class M>
Row<M> text_row(std::string key, std::string M::*member, std::string meaning,
                std::optional<std::string> fallback) {
  return {key,
          "text",
          "",
          "",
          rows::default_text(fallback),
          std::move(meaning),
          [=](M& m, const Block& block) { m.*member = block.text(key, fallback); }};
}

template <class M>
Row<M> choice_row(std::string key, std::string M::*member, std::vector<std::string> allowed,
                  std::string meaning, std::optional<std::string> fallback) {
  const std::string list = joined(allowed, " | ");
  return {key,
          "text",
          "",
          list,
          rows::default_text(fallback),
          std::move(meaning),
          [=](M& m, const Block& block) { m.*member = block.choice(key, allowed, fallback); }};
}

template <class M>
Row<M> texts_row(std::string key, std::vector<std::string> M::*member, std::string meaning,
                 std::optional<std::vector<std::string>> fallback) {
  return {key,
          "texts",
          "",
          "",
          rows::default_text(fallback),
          std::move(meaning),
          [=](M& m, const Block& block) { m.*member = block.texts(key, fallback); }};
}

template <class M>
Row<M> reals_row(std::string key, std::vector<Real> M::*member, std::size_t count, Dimension d,
                 Range allowed, std::string meaning, std::optional<std::vector<Real>> fallback) {
  return {key,
          rows::counted(count, "numbers"),
          rows::si_symbol(d),
          allowed.text(),
          rows::default_text(fallback),
          std::move(meaning),
          [=](M& m, const Block& block) {
            m.*member = block.reals(key, count, d, rows::in_scene_units(allowed, d, block),
                                    rows::in_scene_units(fallback, d, block));
          }};
}

template <class M>
Row<M> expressions_row(std::string key, std::vector<Expression> M::*member, std::size_t count,
                       Dimension d, std::string meaning,
                       std::optional<std::vector<Expression>> fallback) {
  return {key,
          rows::counted(count, "numbers or formulas"),
          rows::si_symbol(d),
          "",
          rows::default_text(fallback),
          std::move(meaning),
          [=](M& m, const Block& block) {
            m.*member = block.expressions(key, count, d, rows::in_scene_units(fallback, d, block));
          }};
}

template <class M>
M Varying<M>::at(const Eigen::Vector3d& X) const {
  M m = base;
  for (const Formula& formula : formulas) {
    const Real value = formula.value.unchecked(X);
    if (!formula.allowed.contains(value))
      rows::throw_out_of_range(formula.place, value, formula.allowed, X);
    m.*formula.member = value;
  }
  return m;
}

template <class M>
Varying<M> read_varying(const Block& block) {
  Varying<M> varying{};
  for (const Row<M>& row : M::rows()) {
    if (row.member == nullptr) {
      row.read(varying.base, block);
      continue;
    }
    const Range allowed = rows::in_scene_units(row.allowed, row.dimension, block);
    std::optional<Expression> fallback;
    if (row.number) fallback = rows::in_scene_units(*row.number, row.dimension, block);
    const Expression value =
        block.expression(row.key, row.dimension, fallback, allowed, Variables::place);
    varying.base.*row.member = value.unchecked({0, 0, 0});
    if (!value.constant())
      varying.formulas.push_back({block.place(row.key), row.member, value, allowed});
  }
  return varying;
}

}  // namespace meniscus
