// SPDX-License-Identifier: BSD-3-Clause
// The complete state of a run as named arrays, for restarts and for comparing two runs.
#pragma once
#include "numbers/types.hpp"

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace meniscus {

/// 64-bit FNV-1a hash of a stream of bytes. Any change of a single byte changes it.
class Fnv1a {
 public:
  void add(std::string_view bytes);
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325u;
};

/// Named arrays of numbers, integers or text. Each owner of a part of the state (time loop, force
/// terms) adds arrays under names of its own and reads them back on a restart. A '/' in a name
/// groups names ("drop/contact/gap").
class Snapshot {
 public:
  using Values = std::variant<std::vector<Real>, std::vector<std::int64_t>, std::string>;
  struct Array {
    Values values;
    std::string unit;  ///< as written beside the data, "1" if there is none; not part of the hash
  };

  /// Adds or replaces an array. A text may not end in a zero byte.
  void add_reals(std::string name, std::span<const Real> values, std::string unit = "1");
  void add_integers(std::string name, std::span<const std::int64_t> values, std::string unit = "1");
  void add_text(std::string name, std::string text);
  void add(std::string name, Array array) { arrays_[std::move(name)] = std::move(array); }

  bool has(std::string_view name) const { return arrays_.find(name) != arrays_.end(); }
  /// Sorted by name.
  const std::map<std::string, Array, std::less<>>& arrays() const { return arrays_; }

  // The array called `name`. Throws FileError, listing the names there are, if it is absent or has
  // another type: such a snapshot was written by another scene or version.
  const std::vector<Real>& reals(std::string_view name) const;
  const std::vector<std::int64_t>& integers(std::string_view name) const;
  const std::string& text(std::string_view name) const;
  /// The only number of the array; also throws FileError if the array has another length.
  Real real(std::string_view name) const;
  std::int64_t integer(std::string_view name) const;
  /// Copies the array into `target`; also throws FileError if the sizes differ.
  void copy_to(std::string_view name, std::span<Real> target) const;

  /// Hash over names, types, lengths and bytes, in the order of the names. Equal states have equal
  /// hashes; -0 and 0 differ.
  std::uint64_t hash() const;

  /// Throws SolveError that names array and index of the first NaN or infinity.
  void require_finite() const;

 private:
  template <class T>
  const T& find(std::string_view name, std::string_view type) const;

  std::map<std::string, Array, std::less<>> arrays_;
};

}  // namespace meniscus
