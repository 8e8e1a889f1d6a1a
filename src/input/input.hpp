// SPDX-License-Identifier: BSD-3-Clause
// Strict reading of scenes. A struct that can be read from a scene lists its keys as rows
// (input_rows.hpp). The same rows read and check values, supply defaults, write the complete input,
// and print the reference of `meniscus keys`. All problems of a scene are collected and reported
// together.
#pragma once
#include "input/expression.hpp"
#include "input/units.hpp"
#include "numbers/types.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace meniscus {

/// An interval of numbers. A bound of 1e300 (`unbounded`) or more is no bound. NaN and infinity are
/// never contained.
struct Range {
  Real low = -unbounded, high = unbounded;
  bool low_open = false, high_open = false;

  bool contains(Real value) const;
  /// "> 0", ">= 0 and < 0.5", "any".
  std::string text() const;
  /// "-1 Pa is out of range; allowed is > 0".
  std::string refusal(Real value, const std::string& unit = "") const;
};
namespace range {
inline constexpr Range any{}, positive{0, unbounded, true}, non_negative{0, unbounded};
}

/// Allowed values of resolution.refine.
inline constexpr Range refinements{0.1, 100};

/// Variables that the formula of a key may use: the reference position x, y, z, the time t, or
/// both.
enum class Variables { place, time, place_and_time };

/// One table of a scene. Reading never throws. If there is a problem, it is noted in the list of
/// the scene, and a harmless value is returned (the fallback if there is one). SceneInput::check()
/// throws the whole list. Every key that is read is marked; done() notes the keys without a mark.
///
/// Numbers, ranges and fallbacks are in the units of the scene. A key without a fallback is
/// required. For an optional key without a default, call has() first.
class Block {
 public:
  /// True if the key exists. This does not mark the key as read.
  bool has(std::string_view key) const;
  /// Name of the table, e.g. "body[0].material"; empty at the root.
  const std::string& path() const;
  /// Place of `key` in the scene, "file:line:column: body[0].density", for messages about errors
  /// that are found after check(). Returns the place of the table if the key is absent or empty.
  std::string place(std::string_view key = {}) const;
  const UnitSystem& units() const;
  /// resolution.refine of the scene, by which the cells of bodies are finer.
  Real refinement() const;

  Real real(std::string_view key, Dimension, Range, std::optional<Real> fallback) const;
  /// Dimension of a value that is given with a unit, as a text or by constants. Empty for a plain
  /// number and for a value that is not a number. For keys that accept several dimensions.
  std::optional<Dimension> own_dimension(std::string_view key) const;
  std::int64_t integer(std::string_view key, Range, std::optional<std::int64_t> fallback) const;
  bool flag(std::string_view key, std::optional<bool> fallback) const;
  std::string text(std::string_view key, std::optional<std::string> fallback) const;
  /// One of `allowed`, which must not be empty.
  std::string choice(std::string_view key, const std::vector<std::string>& allowed,
                     std::optional<std::string> fallback) const;
  /// A choice that determines the other keys of this table. Empty if there is a problem; then
  /// neither missing nor unknown keys of the table are noted, since the keys cannot be known.
  std::optional<std::string> kind(std::string_view key,
                                  const std::vector<std::string>& allowed) const;
  std::vector<std::string> texts(std::string_view key,
                                 std::optional<std::vector<std::string>> fallback) const;
  /// Exactly `count` numbers (count 0: any number of them).
  std::vector<Real> reals(std::string_view key, std::size_t count, Dimension, Range,
                          std::optional<std::vector<Real>> fallback) const;
  /// A number, a quantity with unit, or a formula of the variables (both in units of the scene).
  /// The range is checked here for constants only.
  Expression expression(std::string_view key, Dimension, std::optional<Expression> fallback,
                        Range allowed = {}, Variables = Variables::place_and_time) const;
  std::vector<Expression> expressions(std::string_view key, std::size_t count, Dimension,
                                      std::optional<std::vector<Expression>> fallback,
                                      Variables = Variables::place_and_time) const;

  /// From now on, reads the absent key `key` as if it had the value `formula`, in units of the
  /// scene. Messages give the place of the key `source`, from which the formula was derived. The
  /// complete input contains `source` instead of `key`.
  void supply(std::string_view key, const std::string& formula, std::string_view source) const;

  /// The table `key`; empty if it is absent. If it is absent and `required`, a problem is noted.
  std::optional<Block> table(std::string_view key, bool required = false) const;
  /// The table `key`. If it is absent, an empty table, in which every key has its default.
  Block table_or_defaults(std::string_view key) const;
  /// Whether the value of the key is a text that is no formula of constants.
  bool is_text(std::string_view key) const;
  /// Whether the value of the key is an array, such as tables `[[key]]`.
  bool is_array(std::string_view key) const;
  /// The array of tables `[[key]]`; empty if absent.
  std::vector<Block> tables(std::string_view key) const;
  /// All tables in this table with their names, in file order. For tables with arbitrary names,
  /// such as the entries of [expect]. An entry that is not a table is noted as a problem.
  std::vector<std::pair<std::string, Block>> named_tables() const;
  /// True if no problem of this table was noted so far.
  bool in_order() const;

  /// Notes a problem at `key`, or at the table if `key` is empty: "the problem; allowed values".
  void problem(std::string_view key, const std::string& what) const;
  /// Notes every key that was not read. Call this when all keys of the table were read.
  void done() const;

 private:
  friend class SceneInput;
  struct Node;
  Block() = default;
  explicit Block(std::shared_ptr<Node> node) : node_(std::move(node)) {}
  std::shared_ptr<Node> node_;
};

struct Document;

/// A stage of a scene: the scene with the tables of its table [[stage]].
struct StageChoice {
  std::string name;  ///< of the table
  std::string from;  ///< run whose last state is the first of the stage; empty for the first stage
};

/// A parsed scene file with the `--set` overrides applied. Copies share their list of problems.
class SceneInput {
 public:
  /// `overrides` are "key.path=value" with TOML values, e.g. "body[0].material.viscosity='1 mPa
  /// s'". A body may be given by its name: "body.drop.material.viscosity=1e-3". A value that is not
  /// TOML is taken as a text. The tables of the path must exist; its last key need not. Throws
  /// FileError if the file cannot be read. Throws InputError for a syntax error, or with all
  /// overrides that cannot be applied. With `stage`, which stages() must have, the result is the
  /// scene of this stage.
  static SceneInput from_file(const std::string& path,
                              const std::vector<std::string>& overrides = {},
                              const std::optional<StageChoice>& stage = {});
  static SceneInput from_text(std::string_view toml, std::string name = "scene",
                              const std::vector<std::string>& overrides = {},
                              const std::optional<StageChoice>& stage = {});

  /// Names of the stages, in their order; empty if the scene has none. Throws InputError like
  /// check(), after reading the names and the keys of the tables [[stage]].
  std::vector<std::string> stages() const;

  const Block& root() const { return root_; }
  /// Throws InputError with all problems noted so far, sorted by line and then by `--set`. Does
  /// nothing if there are none.
  void check() const;
  /// Text of the file as given, for the provenance of results.
  const std::string& text() const;
  /// The parsed file, for what reads it as a whole.
  const Document& document() const;
  /// The complete input as TOML: every key that was read with its value in units of the scene,
  /// including defaults. Reading it again gives the same values.
  std::string complete() const;

 private:
  SceneInput() = default;
  Block root_;
};

/// The keys ("body[0].radius") in which two scenes differ, given as TOML: keys that only one scene
/// has, and keys with different values. The order of keys and the notation of numbers do not
/// matter. Throws InputError on syntax errors.
std::vector<std::string> differing_keys(const std::string& toml, const std::string& other);

}  // namespace meniscus

#include "input/input_rows.hpp"
