// SPDX-License-Identifier: BSD-3-Clause
// The archive: one list of the values that an object keeps, for saving and for restoring them.
#pragma once
#include "input/units.hpp"
#include "parallel/aligned.hpp"
#include "state/snapshot.hpp"

#include <functional>
#include <map>
#include <optional>

namespace meniscus {

/// A part of a snapshot. One function writes the values of an object to it and reads them from it,
/// so saving and restoring cannot differ:
///
///     void Clock::archive(const Archive& a) {
///       a("time", time_, dimension::time);
///       hand_.archive(a.in("hand"));
///     }
///
/// Reading throws FileError that names an array that is absent, has another type or another size
/// than the object. Writing throws std::logic_error if a name is taken.
class Archive {
 public:
  using Symbol = std::function<std::string(Dimension)>;

  /// `symbol` returns the unit that is written beside the values; without it the unit is "1".
  static Archive writing(Snapshot& snapshot, Symbol symbol = {});
  static Archive reading(const Snapshot& snapshot);
  /// Writes nothing. Ranks other than the first use it: they take part in the exchanges that saving
  /// needs, and the first rank writes.
  static Archive nowhere() { return {}; }

  bool is_reading() const { return from_ != nullptr; }
  /// The archive of a part; its names begin with "group/".
  Archive in(std::string_view group) const;
  /// True if the snapshot to read has an array in that group.
  bool has(std::string_view group) const;

  void operator()(std::string_view name, Real& x, Dimension dimension = {}) const;
  void operator()(std::string_view name, std::int64_t& x) const;
  void operator()(std::string_view name, bool& x) const;
  void operator()(std::string_view name, std::string& x) const;
  void operator()(std::string_view name, Eigen::Vector3d& x, Dimension dimension = {}) const;
  /// Writes nothing if x is empty; reads an absent value as empty.
  void operator()(std::string_view name, std::optional<Real>& x, Dimension dimension = {}) const;
  /// One number for each key of x.
  void operator()(std::string_view name, std::map<std::string, Real>& x,
                  Dimension dimension = {}) const;
  /// x.size() numbers.
  void operator()(std::string_view name, std::vector<Real>& x, Dimension dimension = {}) const;
  /// The first `components` of each of the x.size() vectors.
  void operator()(std::string_view name, NodalVectors& x, int components,
                  Dimension dimension = {}) const;

 private:
  Archive() = default;
  std::string full(std::string_view name) const { return prefix_ + std::string(name); }
  bool is_nowhere() const { return !to_ && !from_; }
  void numbers(std::string_view name, std::span<Real> x, Dimension dimension) const;
  /// The full name of a new array; throws std::logic_error if it is taken.
  std::string unused(std::string_view name) const;

  Snapshot* to_ = nullptr;
  const Snapshot* from_ = nullptr;
  std::string prefix_;
  Symbol symbol_;
};

}  // namespace meniscus
