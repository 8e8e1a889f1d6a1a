// SPDX-License-Identifier: BSD-3-Clause
// The part of HDF5 that results need: groups, arrays, texts, attributes, and views that gather one
// array from all frames. No HDF5 header is seen outside hdf5_file.cpp, hdf5_array.cpp,
// hdf5_attribute.cpp, hdf5_driver.cpp.
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

/// An open HDF5 object, closed with its owner.
class Handle {
 public:
  /// Throws FileError "cannot <doing>: <reason HDF5 gives>" if `id` is negative.
  Handle(std::int64_t id, std::string_view doing);
  Handle(Handle&& other) noexcept : id_(other.id_) { other.id_ = -1; }
  Handle& operator=(Handle&& other) noexcept;
  ~Handle();
  operator std::int64_t() const { return id_; }
  /// The caller closes it from now on.
  std::int64_t release() { return std::exchange(id_, -1); }

 private:
  std::int64_t id_;
};

/// Throws FileError as Handle does if `status` is negative.
void check(std::int64_t status, std::string_view doing);

enum class Type { float32, float64, uint8, int32, int64, text };

/// How an array lies in the file.
struct Storage {
  Type type = Type::float64;
  int compression = 0;  ///< deflate level 0 (none) to 9
};

struct Shape {
  std::int64_t rows = 0;
  int columns = 1;  ///< 1: a one-dimensional array
};

/// What is stored under a name.
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
  /// Calls visit(name, info) for the arrays of this group and of those below it, in the order of
  /// their names, which are joined by '/'. Throws FileError where groups lie deeper than four
  /// levels or members are more than 100,000.
  void for_each_array(
      const std::function<void(const std::string& name, const ArrayInfo&)>& visit) const;
  Group create_group(const std::string& name);
  Group group(const std::string& name) const;
  void remove(const std::string& name);
  /// A member that stands for the group or array `target` of another file beside this one.
  void link(const std::string& name, const std::string& file, const std::string& target);
  /// Bytes of the file that the group lies in.
  std::uint64_t file_size() const;

  // Arrays. A '/' in a name makes the groups in between.
  void write(const std::string& name, std::span<const Real> values, Shape, Storage,
             const std::string& unit);
  void write(const std::string& name, std::span<const std::int64_t> values, Shape, Storage,
             const std::string& unit);
  void write_text(const std::string& name, const std::string& text);
  //
  // Reading trusts nothing: links into other files, arrays that are stored anywhere but in one
  // piece of this file, and types other than those written are refused, so that nothing larger than
  // the file is ever asked of the memory.
  ArrayInfo info(const std::string& name) const;
  std::vector<Real> reals(const std::string& name) const;
  std::vector<std::int64_t> integers(const std::string& name) const;
  std::string text(const std::string& name) const;

  // An array with one row per frame; rows never written read as `fill`.
  void create_series(const std::string& name, int columns, Type, std::int64_t fill,
                     const std::string& unit);
  void resize_series(const std::string& name, std::int64_t rows);
  void set_series(const std::string& name, std::int64_t row, Real value);
  /// The arrays pattern(0), pattern(1), ... of `shape` one below the other, as many as there are;
  /// "%b" in the pattern stands for the number.
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
  /// Throws FileError if one of the groups on the way to `name`, or that itself, is a link by name,
  /// which may lead into another file or in a circle.
  void require_own(const std::string& name, const std::string& what) const;
  void require_few(std::size_t members) const;

  Handle handle_;
  std::string path_;  ///< for messages: file and place in it
};

class File {
 public:
  /// A new file, replacing one of that name. `user_block` bytes (0, or a power of two from 512) at
  /// its beginning are left to the caller.
  static File create(const std::filesystem::path& path, std::uint64_t user_block = 0);
  static File open(const std::filesystem::path& path);
  static File open_to_append(const std::filesystem::path& path);

  Group root() const;
  /// Makes all changes since the last flush lasting, in an order that survives a kill at any moment
  /// (hdf5_driver.hpp).
  void flush();
  /// Flushes, closes, and reports what went wrong in doing so, as a destructor cannot.
  void close();

 private:
  File(Handle handle, const std::filesystem::path& path);

  Handle handle_;
  std::filesystem::path path_;
};

/// "1.10.8"
std::string library_version();

}  // namespace meniscus::hdf5
