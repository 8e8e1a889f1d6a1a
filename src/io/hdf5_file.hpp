// SPDX-License-Identifier: BSD-3-Clause
// The part of HDF5 that results need: groups, arrays, texts, attributes, and views that join one
// array of all frames. Only hdf5_file.cpp, hdf5_array.cpp, hdf5_attribute.cpp and hdf5_driver.cpp
// include HDF5 headers.
#pragma once
#include "numbers/types.hpp"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace meniscus::hdf5 {

/// An open HDF5 object, which the destructor closes.
class Handle {
 public:
  /// Throws FileError "cannot <doing>: <reason of HDF5>" if `id` is negative.
  Handle(std::int64_t id, std::string_view doing);
  Handle(Handle&& other) noexcept : id_(other.id_) { other.id_ = -1; }
  Handle& operator=(Handle&& other) noexcept;
  ~Handle();
  operator std::int64_t() const { return id_; }
  /// Gives up ownership: the caller has to close the object.
  std::int64_t release() { return std::exchange(id_, -1); }

 private:
  std::int64_t id_;
};

/// Throws FileError like Handle if `status` is negative.
void check(std::int64_t status, std::string_view doing);

enum class Type { float32, float64, uint8, int32, int64, text };

/// Storage of an array in the file.
struct Storage {
  Type type = Type::float64;
  int compression = 0;  ///< deflate level 0 (none) to 9
};

struct Shape {
  std::int64_t rows = 0;
  int columns = 1;  ///< 1: a one-dimensional array
};

/// Type, shape and unit of a stored array.
struct ArrayInfo {
  Type type = Type::float64;
  Shape shape;
  std::string unit;
};

class Group {
 public:
  Group(Handle handle, std::string path) : handle_(std::move(handle)), path_(std::move(path)) {}

  // Members. All throw FileError with file and name on failure.
  bool has(const std::string& name) const;
  bool has_group(const std::string& name) const;
  /// Names of the members in HDF5's order (alphabetical).
  std::vector<std::string> names() const;
  /// Calls visit(name, info) for all arrays of this group and its sub-groups in the order of their
  /// names, whose parts are joined by '/'. Throws FileError if groups are nested deeper than four
  /// levels or have more than 100,000 members.
  void for_each_array(
      const std::function<void(const std::string& name, const ArrayInfo&)>& visit) const;
  Group create_group(const std::string& name);
  Group group(const std::string& name) const;
  void remove(const std::string& name);
  /// Adds a member that refers to the group or array `target` of another file in the same
  /// directory.
  void link(const std::string& name, const std::string& file, const std::string& target);
  /// Size of the file that contains the group, in bytes.
  std::uint64_t file_size() const;

  // Arrays. A '/' in a name makes the groups in between.
  void write(const std::string& name, std::span<const Real> values, Shape, Storage,
             const std::string& unit);
  void write(const std::string& name, std::span<const std::int64_t> values, Shape, Storage,
             const std::string& unit);
  void write_text(const std::string& name, const std::string& text);
  //
  // Reading does not trust the file. It refuses links into other files, arrays that are not stored
  // contiguously in this file, and types that this program does not write. So no array can need
  // more memory than the size of the file.
  ArrayInfo info(const std::string& name) const;
  std::vector<Real> reals(const std::string& name) const;
  std::vector<std::int64_t> integers(const std::string& name) const;
  std::string text(const std::string& name) const;

  // An array with one row per frame; rows never written read as `fill`.
  void create_series(const std::string& name, int columns, Type, std::int64_t fill,
                     const std::string& unit);
  void resize_series(const std::string& name, std::int64_t rows);
  void set_series(const std::string& name, std::int64_t row, Real value);
  /// Creates a view of the arrays pattern(0), pattern(1), ... of `shape`, one below the other, as
  /// many as exist. "%b" in the pattern stands for the number.
  void create_view(const std::string& name, const std::string& pattern, Shape shape, Type,
                   const std::string& unit);

  // Attributes of the group. Setting replaces.
  void set(const std::string& name, Real value);
  void set(const std::string& name, std::int64_t value);
  void set(const std::string& name, std::span<const std::int64_t> values);
  void set(const std::string& name, const std::string& text);
  bool has_attribute(const std::string& name) const;
  Real real(const std::string& name) const;
  std::int64_t integer(const std::string& name) const;
  std::string attribute_text(const std::string& name) const;

 private:
  std::string doing(std::string_view verb, const std::string& name) const;
  /// Throws FileError if `name`, or a group on the path to it, is a link by name: it could lead
  /// into another file or in a circle.
  void require_own(const std::string& name, const std::string& what) const;
  void require_few(std::size_t members) const;

  Handle handle_;
  std::string path_;  ///< for messages: file and place in it
};

class File {
 public:
  /// Creates a file and replaces an existing one of this name. The first `user_block` bytes (0, or
  /// a power of two from 512) are left to the caller.
  static File create(const std::filesystem::path& path, std::uint64_t user_block = 0);
  static File open(const std::filesystem::path& path);
  static File open_to_append(const std::filesystem::path& path);

  Group root() const;
  /// Makes all changes since the last flush permanent, in an order that survives a kill at any
  /// moment (hdf5_driver.hpp).
  void flush();
  /// Flushes and closes the file. Throws FileError on failure, which a destructor cannot do.
  void close();

 private:
  File(Handle handle, const std::filesystem::path& path);

  Handle handle_;
  std::filesystem::path path_;
};

/// "1.10.8"
std::string library_version();

}  // namespace meniscus::hdf5
