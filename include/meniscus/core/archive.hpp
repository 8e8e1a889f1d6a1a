// SPDX-License-Identifier: BSD-3-Clause
// The archive: one description of what an object keeps, for saving it and for restoring it.
#pragma once
#include "meniscus/core/aligned.hpp"
#include "meniscus/core/snapshot.hpp"
#include "meniscus/core/units.hpp"

#include <functional>
#include <map>
#include <optional>

namespace meniscus {

/// A place in a snapshot that values are written to or read from by the same lines, so that nothing
/// can be saved in one way and restored in another:
///
///   void Clock::archive(const Archive& a) {
///     a("time", time_, dimension::time);
///     hand_.archive(a.in("hand"));
///   }
///
/// Reading throws FileError that names what is absent, of another type or of another size than the
/// object has; writing throws std::logic_error where a name is taken.
class Archive {
 public:
  using Symbol = std::function<std::string(Dimension)>;

  /// `symbol` writes the units beside the values; without it there are none.
  static Archive writing(Snapshot& snapshot, Symbol symbol = {});
  static Archive reading(const Snapshot& snapshot);
  /// Writes nowhere: of a rank whose part in writing is what the first rank asks of it.
  static Archive nowhere() { return {}; }

  bool is_reading() const { return from_ != nullptr; }
  /// The archive of a part; its names begin with "group/".
  Archive in(std::string_view group) const;
  /// Whether the snapshot that is read has anything of that part.
  bool has(std::string_view group) const;

  void operator()(std::string_view name, Real& x, Dimension dimension = {}) const;
  void operator()(std::string_view name, std::int64_t& x) const;
  void operator()(std::string_view name, bool& x) const;
  void operator()(std::string_view name, std::string& x) const;
  void operator()(std::string_view name, Eigen::Vector3d& x, Dimension dimension = {}) const;
  /// Nothing is kept of an empty one.
  void operator()(std::string_view name, std::optional<Real>& x, Dimension dimension = {}) const;
  /// A number for each key that the object has.
  void operator()(std::string_view name, std::map<std::string, Real>& x,
                  Dimension dimension = {}) const;
  /// As many numbers as the object has.
  void operator()(std::string_view name, std::vector<Real>& x, Dimension dimension = {}) const;
  /// The first `components` of as many vectors as the object has.
  void operator()(std::string_view name, NodalVectors& x, int components,
                  Dimension dimension = {}) const;

 private:
  Archive() = default;
  std::string full(std::string_view name) const { return prefix_ + std::string(name); }
  bool is_nowhere() const { return !to_ && !from_; }
  void numbers(std::string_view name, std::span<Real> x, Dimension dimension) const;
  /// The full name of something new.
  std::string unused(std::string_view name) const;

  Snapshot* to_ = nullptr;
  const Snapshot* from_ = nullptr;
  std::string prefix_;
  Symbol symbol_;
};

}  // namespace meniscus
