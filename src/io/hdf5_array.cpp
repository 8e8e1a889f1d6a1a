// SPDX-License-Identifier: BSD-3-Clause
// Arrays of an HDF5 group, series that grow by one row per frame, and views over frames.
#include "io/hdf5_file.hpp"
#include "io/hdf5_types.hpp"
#include "meniscus/error.hpp"

#include <fmt/core.h>
#include <hdf5.h>

#include <algorithm>

namespace meniscus::hdf5 {
namespace {

/// Number of rows that are compressed together, and number of rows by which a series grows.
constexpr hsize_t piece_rows = 65536, series_rows = 1024;

Handle dataspace(Shape shape, bool growing = false) {
  const hsize_t size[] = {static_cast<hsize_t>(shape.rows), static_cast<hsize_t>(shape.columns)};
  const hsize_t limit[] = {growing ? H5S_UNLIMITED : size[0], size[1]};
  const int rank = shape.columns == 1 ? 1 : 2;
  return {H5Screate_simple(rank, size, limit), "describe an array"};
}

Handle storage_properties(Shape shape, Storage storage) {
  Handle properties(H5Pcreate(H5P_DATASET_CREATE), "prepare HDF5");
  if (storage.compression > 0 && shape.rows > 0) {
    const hsize_t piece[] = {std::min(static_cast<hsize_t>(shape.rows), piece_rows),
                             static_cast<hsize_t>(shape.columns)};
    check(H5Pset_chunk(properties, shape.columns == 1 ? 1 : 2, piece), "prepare HDF5");
    // Put bytes of equal significance side by side: the leading bytes of neighbouring numbers are
    // alike, which helps compression.
    check(H5Pset_shuffle(properties), "prepare HDF5");
    check(H5Pset_deflate(properties, static_cast<unsigned>(storage.compression)), "prepare HDF5");
  }
  return properties;
}

Handle create_array(std::int64_t group, const std::string& name, std::int64_t type,
                    const Handle& space, const Handle& properties, const std::string& unit,
                    const std::string& doing) {
  const Handle link(H5Pcreate(H5P_LINK_CREATE), "prepare HDF5");
  check(H5Pset_create_intermediate_group(link, 1), "prepare HDF5");
  Handle array(H5Dcreate2(group, name.c_str(), type, space, link, properties, H5P_DEFAULT), doing);
  write_text_attribute(array, "units", unit);
  return array;
}

Handle open_array(std::int64_t group, const std::string& name, const std::string& doing) {
  return {H5Dopen2(group, name.c_str(), H5P_DEFAULT), doing};
}

/// Number of elements of `size` bytes in an array. Throws FileError unless the array is stored
/// contiguously in the file.
std::size_t stored_count(const Handle& array, std::size_t size, const std::string& doing) {
  const Handle space(H5Dget_space(array), doing), properties(H5Dget_create_plist(array), doing);
  const hssize_t count = H5Sget_simple_extent_npoints(space);
  check(count, doing);
  const hsize_t bytes = H5Dget_storage_size(array);
  const haddr_t begin = H5Dget_offset(array), end = file_size(array);
  const bool here = H5Pget_layout(properties) == H5D_CONTIGUOUS &&
                    H5Pget_external_count(properties) == 0 &&
                    bytes / size == static_cast<hsize_t>(count) && bytes % size == 0 &&
                    (bytes == 0 || (begin <= end && bytes <= end - begin));
  if (!here) throw FileError(fmt::format("cannot {}: it is not stored as a whole", doing));
  return static_cast<std::size_t>(count);
}

template <class T>
std::vector<T> read_numbers(const Handle& array, const std::string& doing) {
  const Handle type(H5Dget_type(array), doing);
  const auto is = [&](Type stored) { return H5Tequal(type, file_type(stored)) > 0; };
  const bool real = std::is_same_v<T, double>;
  if (!(real ? is(Type::float64) : is(Type::int64) || is(Type::uint8)))
    throw FileError(
        fmt::format("cannot {}: it does not hold {}", doing, real ? "numbers" : "integers"));
  std::vector<T> values(stored_count(array, H5Tget_size(type), doing));
  check(H5Dread(array, memory_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), doing);
  return values;
}

Type type_of(std::int64_t array, const std::string& doing) {
  const Handle type(H5Dget_type(array), doing);
  if (H5Tget_class(type) == H5T_STRING) return Type::text;
  for (const Type known : {Type::float32, Type::float64, Type::uint8, Type::int32, Type::int64})
    if (H5Tequal(type, file_type(known)) > 0) return known;
  throw FileError(fmt::format("cannot {}: it is neither numbers nor text", doing));
}

}  // namespace

void Group::write(const std::string& name, std::span<const Real> values, Shape shape,
                  Storage storage, const std::string& unit) {
  const std::string what = doing("write", name);
  const Handle array = create_array(handle_, name, file_type(storage.type), dataspace(shape),
                                    storage_properties(shape, storage), unit, what);
  check(H5Dwrite(array, memory_type<Real>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), what);
}

void Group::write(const std::string& name, std::span<const std::int64_t> values, Shape shape,
                  Storage storage, const std::string& unit) {
  const std::string what = doing("write", name);
  const Handle array = create_array(handle_, name, file_type(storage.type), dataspace(shape),
                                    storage_properties(shape, storage), unit, what);
  check(H5Dwrite(array, memory_type<std::int64_t>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()),
        what);
}

void Group::write_text(const std::string& name, const std::string& text) {
  const std::string what = doing("write", name);
  const Handle type = text_type(text), space(H5Screate(H5S_SCALAR), what),
               properties(H5Pcreate(H5P_DATASET_CREATE), what);
  const Handle array = create_array(handle_, name, type, space, properties, "1", what);
  check(H5Dwrite(array, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.c_str()), what);
}

ArrayInfo Group::info(const std::string& name) const {
  const std::string what = doing("read", name);
  require_own(name, what);
  const Handle array = open_array(handle_, name, what), space(H5Dget_space(array), what);
  const int rank = H5Sget_simple_extent_ndims(space);
  check(rank, what);
  hsize_t size[] = {1, 1};
  if (rank <= 2) check(H5Sget_simple_extent_dims(space, size, nullptr), what);
  constexpr hsize_t most = 1'000'000'000'000;
  if (rank > 2 || size[0] > most || size[1] > 100)
    throw FileError(fmt::format("cannot {}: it is no table of a row per particle", what));
  ArrayInfo info;
  info.type = type_of(array, what);
  info.shape = {static_cast<std::int64_t>(size[0]), rank == 2 ? static_cast<int>(size[1]) : 1};
  if (H5Aexists(array, "units") > 0) info.unit = read_text_attribute(array, "units");
  return info;
}

std::vector<Real> Group::reals(const std::string& name) const {
  const std::string what = doing("read", name);
  require_own(name, what);
  return read_numbers<Real>(open_array(handle_, name, what), what);
}

std::vector<std::int64_t> Group::integers(const std::string& name) const {
  const std::string what = doing("read", name);
  require_own(name, what);
  return read_numbers<std::int64_t>(open_array(handle_, name, what), what);
}

std::string Group::text(const std::string& name) const {
  const std::string what = doing("read", name);
  require_own(name, what);
  const Handle array = open_array(handle_, name, what), type(H5Dget_type(array), what);
  const std::size_t size = H5Tget_size(type);
  if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) != 0 ||
      stored_count(array, size, what) != 1)
    throw FileError(fmt::format("cannot {}: it is not one text", what));
  std::string text(size, '\0');
  check(H5Dread(array, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()), what);
  text.resize(text.find_last_not_of('\0') + 1);
  return text;
}

void Group::create_series(const std::string& name, int columns, Type type, std::int64_t fill,
                          const std::string& unit) {
  const Handle properties(H5Pcreate(H5P_DATASET_CREATE), "prepare HDF5");
  const hsize_t piece[] = {series_rows, static_cast<hsize_t>(columns)};
  check(H5Pset_chunk(properties, columns == 1 ? 1 : 2, piece), "prepare HDF5");
  check(H5Pset_fill_value(properties, memory_type<std::int64_t>(), &fill), "prepare HDF5");
  create_array(handle_, name, file_type(type), dataspace({0, columns}, true), properties, unit,
               doing("create", name));
}

void Group::resize_series(const std::string& name, std::int64_t rows) {
  const std::string what = doing("extend", name);
  const Handle array = open_array(handle_, name, what), space(H5Dget_space(array), what);
  hsize_t size[H5S_MAX_RANK] = {};
  check(H5Sget_simple_extent_dims(space, size, nullptr), what);
  size[0] = static_cast<hsize_t>(rows);
  check(H5Dset_extent(array, size), what);
}

void Group::set_series(const std::string& name, std::int64_t row, Real value) {
  const std::string what = doing("write", name);
  const Handle array = open_array(handle_, name, what), space(H5Dget_space(array), what);
  const hsize_t start[] = {static_cast<hsize_t>(row)}, count[] = {1};
  check(H5Sselect_hyperslab(space, H5S_SELECT_SET, start, nullptr, count, nullptr), what);
  const Handle one = dataspace({1, 1});
  check(H5Dwrite(array, memory_type<Real>(), one, space, H5P_DEFAULT, &value), what);
}

void Group::create_view(const std::string& name, const std::string& pattern, Shape shape, Type type,
                        const std::string& unit) {
  const std::string what = doing("create", name);
  const Handle source = dataspace(shape), view = dataspace(shape, true),
               properties(H5Pcreate(H5P_DATASET_CREATE), what);
  const hsize_t rows = static_cast<hsize_t>(shape.rows),
                columns = static_cast<hsize_t>(shape.columns);
  const hsize_t start[] = {0, 0}, stride[] = {rows, columns}, count[] = {H5S_UNLIMITED, 1},
                block[] = {rows, columns};
  check(H5Sselect_hyperslab(view, H5S_SELECT_SET, start, stride, count, block), what);
  check(H5Pset_virtual(properties, view, ".", pattern.c_str(), source), what);
  create_array(handle_, name, file_type(type), view, properties, unit, what);
}

}  // namespace meniscus::hdf5
