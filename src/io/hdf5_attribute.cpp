// SPDX-License-Identifier: BSD-3-Clause
// Attributes of HDF5 groups and arrays.
#include "io/hdf5_file.hpp"
#include "io/hdf5_types.hpp"
#include "meniscus/error.hpp"

#include <fmt/core.h>
#include <hdf5.h>

#include <algorithm>

namespace meniscus::hdf5 {
namespace {

bool exists(std::int64_t object, const std::string& name) {
  return H5Aexists(object, name.c_str()) > 0;
}

Handle create(std::int64_t object, const std::string& name, std::int64_t type,
              const Handle& space) {
  return {H5Acreate2(object, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT),
          fmt::format("write the attribute '{}'", name)};
}

Handle open(std::int64_t object, const std::string& name) {
  return {H5Aopen(object, name.c_str(), H5P_DEFAULT), fmt::format("read the attribute '{}'", name)};
}

/// Replaces a number in place, so that only its eight bytes of the file change.
template <class T>
void write_number(std::int64_t object, const std::string& name, Type type, T value) {
  const Handle scalar(H5Screate(H5S_SCALAR), "describe an attribute");
  const Handle attribute =
      exists(object, name) ? open(object, name) : create(object, name, file_type(type), scalar);
  check(H5Awrite(attribute, memory_type<T>(), &value),
        fmt::format("write the attribute '{}'", name));
}

bool one_value(const Handle& attribute) {
  const Handle space(H5Aget_space(attribute), "read an attribute");
  return H5Sget_simple_extent_type(space) == H5S_SCALAR;
}

template <class T>
T read_number(std::int64_t object, const std::string& name) {
  const Handle attribute = open(object, name), type(H5Aget_type(attribute), "read an attribute");
  const hid_t written = file_type(std::is_same_v<T, double> ? Type::float64 : Type::int64);
  if (!one_value(attribute) || H5Tequal(type, written) <= 0)
    throw FileError(fmt::format("cannot read the attribute '{}': it is not one {}", name,
                                std::is_same_v<T, double> ? "number" : "integer"));
  T value{};
  check(H5Aread(attribute, memory_type<T>(), &value), fmt::format("read the attribute '{}'", name));
  return value;
}

}  // namespace

hid_t file_type(Type type) {
  switch (type) {
    case Type::float32:
      return H5T_IEEE_F32LE;
    case Type::float64:
      return H5T_IEEE_F64LE;
    case Type::uint8:
      return H5T_STD_U8LE;
    case Type::int32:
      return H5T_STD_I32LE;
    case Type::int64:
      return H5T_STD_I64LE;
    case Type::text:
      break;
  }
  throw std::logic_error("a text has a type of its own length");
}

// A type of fixed length, so that the text is stored in place. ASCII if possible, as VTK requires.
Handle text_type(const std::string& text) {
  Handle type(H5Tcopy(H5T_C_S1), "describe a text");
  check(H5Tset_size(type, std::max<std::size_t>(text.size(), 1)), "describe a text");
  check(H5Tset_strpad(type, H5T_STR_NULLPAD), "describe a text");
  const bool ascii = std::all_of(text.begin(), text.end(), [](unsigned char c) { return c < 128; });
  check(H5Tset_cset(type, ascii ? H5T_CSET_ASCII : H5T_CSET_UTF8), "describe a text");
  return type;
}

void write_text_attribute(std::int64_t object, const std::string& name, const std::string& text) {
  if (exists(object, name)) check(H5Adelete(object, name.c_str()), "replace an attribute");
  const Handle type = text_type(text), scalar(H5Screate(H5S_SCALAR), "describe an attribute");
  const Handle attribute = create(object, name, type, scalar);
  check(H5Awrite(attribute, type, text.c_str()), fmt::format("write the attribute '{}'", name));
}

std::string read_text_attribute(std::int64_t object, const std::string& name) {
  const Handle attribute = open(object, name), type(H5Aget_type(attribute), "read an attribute");
  if (!one_value(attribute) || H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) != 0)
    throw FileError(fmt::format("cannot read the attribute '{}': it is not a text", name));
  std::string text(H5Tget_size(type), '\0');
  check(H5Aread(attribute, type, text.data()), fmt::format("read the attribute '{}'", name));
  text.resize(text.find_last_not_of('\0') + 1);
  return text;
}

void Group::set(const std::string& name, Real value) {
  write_number(handle_, name, Type::float64, value);
}

void Group::set(const std::string& name, std::int64_t value) {
  write_number(handle_, name, Type::int64, value);
}

void Group::set(const std::string& name, std::span<const std::int64_t> values) {
  const hsize_t size = values.size();
  const Handle space(H5Screate_simple(1, &size, nullptr), "describe an attribute");
  const Handle attribute = create(handle_, name, file_type(Type::int64), space);
  check(H5Awrite(attribute, memory_type<std::int64_t>(), values.data()), doing("write", name));
}

void Group::set(const std::string& name, const std::string& text) {
  write_text_attribute(handle_, name, text);
}

bool Group::has_attribute(const std::string& name) const {
  return exists(handle_, name);
}

Real Group::real(const std::string& name) const {
  return read_number<Real>(handle_, name);
}

std::int64_t Group::integer(const std::string& name) const {
  return read_number<std::int64_t>(handle_, name);
}

std::string Group::attribute_text(const std::string& name) const {
  return read_text_attribute(handle_, name);
}

}  // namespace meniscus::hdf5
