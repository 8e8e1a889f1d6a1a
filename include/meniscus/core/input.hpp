// SPDX-License-Identifier: BSD-3-Clause
// Strict reading of scenes. A struct that can be read from a scene lists its keys as rows; the same
// rows read, check, supply defaults, echo the complete input, and print the reference of `meniscus
// keys`. All problems of a scene are collected and reported in one go. toml++ is seen only by the
// .cpp.
#pragma once
#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "meniscus/core/expression.hpp"
#include "meniscus/core/types.hpp"
#include "meniscus/core/units.hpp"

namespace meniscus {

struct Range {
  Real low = -1e300, high = 1e300;
  bool low_open = false, high_open = false;
};
namespace range {
inline constexpr Range any{}, positive{0, 1e300, true}, non_negative{0, 1e300};
}

/// One table of a scene. Reading never throws: a problem is noted in the scene's list and a harmless
/// value returned; Scene::check() throws the whole list. Every key asked for is ticked off, and
/// done() notes those nobody asked for, with the nearest valid name.
class Block {
 public:
  bool has(std::string_view key) const;
  /// Name of the table as in the file, e.g. "body[0].material".
  const std::string& path() const;
  const UnitSystem& units() const;

  std::optional<Real> real(std::string_view key, Dimension, Range, std::optional<Real> fallback) const;
  std::int64_t integer(std::string_view key, Range, std::optional<std::int64_t> fallback) const;
  bool flag(std::string_view key, std::optional<bool> fallback) const;
  std::string text(std::string_view key, std::optional<std::string> fallback) const;
  /// One of `allowed`.
  std::string choice(std::string_view key, const std::vector<std::string>& allowed,
                     std::optional<std::string> fallback) const;
  std::vector<std::string> texts(std::string_view key, std::optional<std::vector<std::string>>) const;
  /// Exactly `count` numbers (count 0: any number of them).
  std::vector<Real> reals(std::string_view key, std::size_t count, Dimension, Range,
                          std::optional<std::vector<Real>> fallback) const;
  /// A number, a quantity with unit, or a formula in x, y, z, t (its value in scene units).
  Expression expression(std::string_view key, Dimension, std::optional<Expression> fallback) const;
  std::vector<Expression> expressions(std::string_view key, std::size_t count, Dimension,
                                      std::optional<std::vector<Expression>> fallback) const;

  /// The table `key`; nothing (and a note, if `required`) when it is absent.
  std::optional<Block> table(std::string_view key, bool required = false) const;
  /// The array of tables `[[key]]`; empty when absent.
  std::vector<Block> tables(std::string_view key) const;
  /// Sub-tables of this table in file order with their names (for [expect]); ticks them off.
  std::vector<std::pair<std::string, Block>> named_tables() const;

  /// Notes a problem at `key` (at the table itself when `key` is empty): "what is wrong; allowed".
  void problem(std::string_view key, const std::string& what) const;
  /// Notes every key that nobody asked for. Call when everything of this table was read.
  void done() const;

 private:
  friend class SceneInput;
  struct Node;
  std::shared_ptr<const Node> node_;
};

/// A scene file, parsed, with `--set` overrides applied.
class SceneInput {
 public:
  /// `overrides` are "key.path=value" with TOML values, e.g. "body[0].material.viscosity='1 mPa s'";
  /// a bare word that is not TOML is taken as a text. Throws FileError (cannot read), InputError
  /// (syntax, unknown override path).
  static SceneInput from_file(const std::string& path, const std::vector<std::string>& overrides = {});
  static SceneInput from_text(std::string_view toml, std::string name = "scene",
                              const std::vector<std::string>& overrides = {});

  const Block& root() const { return root_; }
  /// Throws InputError with every problem noted so far, sorted by line; nothing if there is none.
  void check() const;
  /// Text of the file as given (for the provenance of results).
  const std::string& text() const;
  /// The complete input as TOML: every key that was read with the value used, defaults included.
  std::string complete() const;

 private:
  Block root_;
};

/// One key of the struct M.
template <class M>
struct Row {
  std::string key, type, unit, range, fallback, meaning;  ///< as `meniscus keys` prints them
  std::function<void(M&, const Block&)> read;
  // For numbers that may be given as a formula (material parameters), and for tests of laws:
  Real M::*member = nullptr;
  Dimension dimension{};
  Range allowed{};
  Real typical = 0;
};
template <class M>
using Rows = std::vector<Row<M>>;

// Makers of rows. `fallback` absent: the key is required. Defined at the end of this header.
template <class M>
Row<M> real_row(std::string key, Real M::*member, Dimension, Range, std::string meaning,
                std::optional<Real> fallback = {});
/// A number of a material: `typical` is used by the generic tests of laws.
template <class M>
Row<M> parameter_row(std::string key, Real M::*member, Dimension, Range, std::string meaning,
                     Real typical, std::optional<Real> fallback = {});
template <class M>
Row<M> integer_row(std::string key, int M::*member, Range, std::string meaning,
                   std::optional<int> fallback = {});
template <class M>
Row<M> flag_row(std::string key, bool M::*member, std::string meaning, std::optional<bool> fallback = {});
template <class M>
Row<M> text_row(std::string key, std::string M::*member, std::string meaning,
                std::optional<std::string> fallback = {});
template <class M>
Row<M> choice_row(std::string key, std::string M::*member, std::vector<std::string> allowed,
                  std::string meaning, std::optional<std::string> fallback = {});
template <class M>
Row<M> texts_row(std::string key, std::vector<std::string> M::*member, std::string meaning,
                 std::optional<std::vector<std::string>> fallback = {});
template <class M>
Row<M> reals_row(std::string key, std::vector<Real> M::*member, std::size_t count, Dimension, Range,
                 std::string meaning, std::optional<std::vector<Real>> fallback = {});
template <class M>
Row<M> expressions_row(std::string key, std::vector<Expression> M::*member, std::size_t count,
                       Dimension, std::string meaning,
                       std::optional<std::vector<Expression>> fallback = {});

/// Reads M by its rows M::rows(); `also` are further keys of the same table that someone else reads
/// (they are not reported as unknown and the caller calls block.done() itself).
template <class M>
M read(const Block& block) {
  M m{};
  for (const Row<M>& row : M::rows()) row.read(m, block);
  return m;
}

/// A struct whose parameters may vary with the reference position.
template <class M>
struct Varying {
  M base;
  std::vector<std::pair<Real M::*, Expression>> formulas;  ///< empty: uniform
  std::vector<Row<M>> rows;                                ///< to check ranges point by point

  bool uniform() const { return formulas.empty(); }
  /// Throws InputError naming key, position and value if a formula leaves its range there.
  M at(const Eigen::Vector3d& X) const;
};

/// Like read(), but numbers may be given as formulas of x, y, z.
template <class M>
Varying<M> read_varying(const Block& block);

}  // namespace meniscus

#include "meniscus/core/input_rows.hpp"
