// SPDX-License-Identifier: BSD-3-Clause
// Attributes of HDF5 groups and arrays.
#include "meniscus/core/error.hpp"

#include <fmt/format.h>
#include <hdf5.h>

#include <algorithm>

#include "hdf5_file.hpp"
#include "hdf5_types.hpp"

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

/// A number is replaced in place: the file changes by its eight bytes alone.
template <class T>
void write_number(std::int64_t object, const std::string& name, Type type, T value) {
  const Handle scalar(H5Screate(H5S_SCALAR), "describe an attribute");
  const Handle attribute =
      exists(object, name) ? open(object, name) : create(object, name, file_type(type), scalar);
  check(H5Awrite(attribute, memory_type<T>(), &value),
        fmt::format("write the attribute '{}'", name));
}

template <class T>
T read_number(std::int64_t object, const std::string& name) {
  const Handle attribute = open(object, name);
  const Handle space(H5Aget_space(attribute), "read an attribute");
  if (H5Sget_simple_extent_npoints(space) != 1)
    throw FileError(fmt::format("Cannot read the attribute '{}': it is not one number.", name));
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
    case Type::int32:
      return H5T_STD_I32LE;
    case Type::int64:
      return H5T_STD_I64LE;
    case Type::text:
      break;
  }
  throw std::logic_error("a text has a type of its own length");
}

// Fixed length, so that it is stored in place; plain ASCII where possible, which VTK asks for.
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
  if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) > 0)
    throw FileError(fmt::format("Cannot read the attribute '{}': it is not a text.", name));
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

std::vector<std::string> Group::attribute_names() const {
  std::vector<std::string> names;
  const auto add = [](hid_t, const char* name, const H5A_info_t*, void* list) -> herr_t {
    static_cast<std::vector<std::string>*>(list)->emplace_back(name);
    return 0;
  };
  check(H5Aiterate2(handle_, H5_INDEX_NAME, H5_ITER_INC, nullptr, add, &names),
        doing("list the attributes of", ""));
  return names;
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

std::string Group::attribute_as_text(const std::string& name) const {
  const Handle attribute = open(handle_, name), type(H5Aget_type(attribute), "read an attribute");
  switch (H5Tget_class(type)) {
    case H5T_STRING:
      return attribute_text(name);
    case H5T_INTEGER:
      return fmt::format("{}", integer(name));
    default:
      return fmt::format("{}", real(name));
  }
}

}  // namespace meniscus::hdf5
