// SPDX-License-Identifier: BSD-3-Clause
// Strict reading of scenes. A struct that can be read from a scene lists its keys as rows
// (input_rows.hpp); the same rows read, check, supply defaults, echo the complete input, and print
// the reference of `meniscus keys`. All problems of a scene are collected and reported in one go.
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

/// An interval of numbers. A bound of 1e300 (`unbounded`) or more means none; NaN and infinity
/// never pass.
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

/// What a formula of a key may depend on: the reference position x, y, z, the time t, or both.
enum class Variables { place, time, place_and_time };

/// One table of a scene. Reading never throws: a problem is noted in the scene's list and a
/// harmless value (the fallback if there is one) is returned; SceneInput::check() throws the whole
/// list. Every key asked for is ticked off, and done() notes those nobody asked for.
///
/// Numbers, ranges and fallbacks are in the units of the scene. A key without a fallback is
/// required; ask has() first for one that may be absent without a default.
class Block {
 public:
  /// Whether the key is there. It counts as unknown to done() until it is read.
  bool has(std::string_view key) const;
  /// Name of the table, e.g. "body[0].material"; empty at the root.
  const std::string& path() const;
  /// Where `key` stands, "file:line:column: body[0].density", to begin the message of an error
  /// found after check(). The place of the table if the key is absent or empty.
  std::string place(std::string_view key = {}) const;
  const UnitSystem& units() const;

  Real real(std::string_view key, Dimension, Range, std::optional<Real> fallback) const;
  /// The dimension of a number that is given with a unit, as a text or by constants; nothing for a
  /// plain number or what is no number. For keys whose dimension only the scene can tell.
  std::optional<Dimension> own_dimension(std::string_view key) const;
  std::int64_t integer(std::string_view key, Range, std::optional<std::int64_t> fallback) const;
  bool flag(std::string_view key, std::optional<bool> fallback) const;
  std::string text(std::string_view key, std::optional<std::string> fallback) const;
  /// One of `allowed`, which must not be empty.
  std::string choice(std::string_view key, const std::vector<std::string>& allowed,
                     std::optional<std::string> fallback) const;
  /// The choice on which the other keys of this table depend. Nothing after a problem; then neither
  /// missing nor unknown keys of the table are noted, as nobody can know them.
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

  /// From now on the absent `key` is read as if its value were `formula`, in units of the scene,
  /// and stood where `source` does, of which it follows. Not in the complete input: `source` is.
  void supply(std::string_view key, const std::string& formula, std::string_view source) const;

  /// The table `key`; nothing (and a note, if `required`) when it is absent.
  std::optional<Block> table(std::string_view key, bool required = false) const;
  /// The table `key`, or an empty one in which every key has its default, when it is absent.
  Block table_or_defaults(std::string_view key) const;
  /// The array of tables `[[key]]`; empty when absent.
  std::vector<Block> tables(std::string_view key) const;
  /// All entries of this table in file order with their names, which are free (for [expect]). What
  /// is not a table is noted.
  std::vector<std::pair<std::string, Block>> named_tables() const;
  /// Nothing of this table was found wrong so far.
  bool in_order() const;

  /// Notes a problem at `key` (at the table itself when `key` is empty): "what is wrong; allowed".
  void problem(std::string_view key, const std::string& what) const;
  /// Notes every key that nobody has read. Call when everything of this table was read.
  void done() const;

 private:
  friend class SceneInput;
  struct Node;
  Block() = default;
  explicit Block(std::shared_ptr<Node> node) : node_(std::move(node)) {}
  std::shared_ptr<Node> node_;
};

/// A scene file, parsed, with `--set` overrides applied. Copies share their list of problems.
class SceneInput {
 public:
  /// `overrides` are "key.path=value" with TOML values, e.g. "body[0].material.viscosity='1 mPa s'"
  /// or, by the key `name` of the body, "body.drop.material.viscosity=1e-3"; a value that is not
  /// TOML is taken as a text. Tables on the path must exist, its last key need not.
  /// Throws FileError (cannot read), InputError (syntax, or every override that cannot be applied).
  static SceneInput from_file(const std::string& path,
                              const std::vector<std::string>& overrides = {});
  static SceneInput from_text(std::string_view toml, std::string name = "scene",
                              const std::vector<std::string>& overrides = {});

  const Block& root() const { return root_; }
  /// Throws InputError with every problem noted so far, sorted by line and then by `--set`; nothing
  /// if there is none.
  void check() const;
  /// Text of the file as given (for the provenance of results).
  const std::string& text() const;
  /// The complete input as TOML: every key that was read with the value used in the scene's units,
  /// defaults included. Reading it again gives the same values.
  std::string complete() const;

 private:
  SceneInput() = default;
  Block root_;
};

/// The keys, "body[0].radius", that two scenes given as TOML do not have in common: absent in one,
/// or with another value. The order of keys and how numbers are written do not matter. Throws
/// InputError on syntax errors.
std::vector<std::string> differing_keys(const std::string& toml, const std::string& other);

}  // namespace meniscus

#include "input/input_rows.hpp"
