// SPDX-License-Identifier: BSD-3-Clause
// The keys in which two scenes differ.
#include "input/input.hpp"
#include "input/scene_tree.hpp"

#include <fmt/core.h>

#include <set>

namespace meniscus {
namespace {

using scene_tree::Array;
using scene_tree::Entry;
using scene_tree::Table;
using scene_tree::Value;

std::optional<Real> number_of(const Value& value) {
  if (const auto* real = std::get_if<Real>(&value.data)) return *real;
  if (const auto* integer = std::get_if<std::int64_t>(&value.data))
    return static_cast<Real>(*integer);
  return {};
}

bool same_scalar(const Value& a, const Value& b) {
  if (const auto x = number_of(a), y = number_of(b); x || y) return x == y;
  if (a.data.index() != b.data.index()) return false;
  if (const bool* flag = std::get_if<bool>(&a.data)) return *flag == std::get<bool>(b.data);
  if (const auto* text = std::get_if<std::string>(&a.data))
    return *text == std::get<std::string>(b.data);
  return true;
}

/// Adds the names of differing values to `differing`. A null pointer is an absent value.
class Comparison {
 public:
  void compare(const std::string& name, const Value* a, const Value* b) {
    const Table *table = as<Table>(a), *other_table = as<Table>(b);
    const Array *array = as<Array>(a), *other_array = as<Array>(b);
    if (table && other_table)
      compare_tables(name, *table, *other_table);
    else if (array && other_array)
      compare_arrays(name, *array, *other_array);
    else if (!a || !b || table || other_table || array || other_array || !same_scalar(*a, *b))
      differing.push_back(name);
  }

  std::vector<std::string> differing;

 private:
  template <class T>
  static const T* as(const Value* value) {
    return value ? std::get_if<T>(&value->data) : nullptr;
  }
  void compare_tables(const std::string& name, const Table& a, const Table& b) {
    std::set<std::string> keys;
    for (const Table* table : {&a, &b})
      for (const Entry& entry : table->entries) keys.insert(entry.key);
    for (const std::string& key : keys) {
      const Entry *in_a = a.find(key), *in_b = b.find(key);
      compare(scene_tree::joined(name, key), in_a ? &in_a->value : nullptr,
              in_b ? &in_b->value : nullptr);
    }
  }
  void compare_arrays(const std::string& name, const Array& a, const Array& b) {
    for (std::size_t i = 0; i < std::max(a.size(), b.size()); ++i)
      compare(fmt::format("{}[{}]", name, i), i < a.size() ? &a[i] : nullptr,
              i < b.size() ? &b[i] : nullptr);
  }
};

}  // namespace

std::vector<std::string> differing_keys(const std::string& toml, const std::string& other) {
  Comparison comparison;
  const Value a = scene_tree::parse(toml, "scene"), b = scene_tree::parse(other, "scene");
  comparison.compare("", &a, &b);
  return comparison.differing;
}

}  // namespace meniscus
