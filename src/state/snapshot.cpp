// SPDX-License-Identifier: BSD-3-Clause
// Named arrays of the state of a run.
#include "state/snapshot.hpp"

#include "input/text.hpp"
#include "meniscus/error.hpp"

#include <fmt/core.h>

#include <cmath>

namespace meniscus {
namespace {

template <class T>
std::string_view bytes_of(const T* first, std::size_t count) {
  return {reinterpret_cast<const char*>(first), count * sizeof(T)};
}

/// The bytes of a text or of an array of numbers.
constexpr auto bytes_of_values = [](const auto& values) {
  return bytes_of(values.data(), values.size());
};

[[noreturn]] void wrong_count(std::string_view name, std::size_t found, std::size_t expected) {
  throw FileError(
      fmt::format("the saved state '{}' holds {} numbers where {} are expected: it was written by "
                  "another scene",
                  name, found, expected));
}

}  // namespace

void Fnv1a::add(std::string_view bytes) {
  constexpr std::uint64_t prime = 0x100000001b3u;
  std::uint64_t h = value_;
  for (const char c : bytes) h = (h ^ static_cast<unsigned char>(c)) * prime;
  value_ = h;
}

void Snapshot::add_reals(std::string name, std::span<const Real> values, std::string unit) {
  add(std::move(name), {std::vector<Real>(values.begin(), values.end()), std::move(unit)});
}

void Snapshot::add_integers(std::string name, std::span<const std::int64_t> values,
                            std::string unit) {
  add(std::move(name), {std::vector<std::int64_t>(values.begin(), values.end()), std::move(unit)});
}

void Snapshot::add_text(std::string name, std::string text) {
  add(std::move(name), {std::move(text), "1"});
}

template <class T>
const T& Snapshot::find(std::string_view name, std::string_view type) const {
  const auto found = arrays_.find(name);
  const T* values = found == arrays_.end() ? nullptr : std::get_if<T>(&found->second.values);
  if (values) return *values;
  std::vector<std::string> names;
  for (const auto& entry : arrays_) names.emplace_back(entry.first);
  throw FileError(
      fmt::format("the saved state has no {} named '{}': it was written by another scene or "
                  "another version; it has: {}",
                  type, name, joined(names, ", ")));
}

const std::vector<Real>& Snapshot::reals(std::string_view name) const {
  return find<std::vector<Real>>(name, "array of numbers");
}

const std::vector<std::int64_t>& Snapshot::integers(std::string_view name) const {
  return find<std::vector<std::int64_t>>(name, "array of integers");
}

const std::string& Snapshot::text(std::string_view name) const {
  return find<std::string>(name, "text");
}

Real Snapshot::real(std::string_view name) const {
  const auto& values = reals(name);
  if (values.size() != 1) wrong_count(name, values.size(), 1);
  return values[0];
}

std::int64_t Snapshot::integer(std::string_view name) const {
  const auto& values = integers(name);
  if (values.size() != 1) wrong_count(name, values.size(), 1);
  return values[0];
}

void Snapshot::copy_to(std::string_view name, std::span<Real> target) const {
  const auto& values = reals(name);
  if (values.size() != target.size()) wrong_count(name, values.size(), target.size());
  std::copy(values.begin(), values.end(), target.begin());
}

std::uint64_t Snapshot::hash() const {
  Fnv1a hash;
  for (const auto& [name, array] : arrays_) {
    const std::string_view bytes = std::visit(bytes_of_values, array.values);
    const std::uint64_t heading[] = {name.size(), array.values.index(), bytes.size()};
    hash.add(bytes_of(heading, 3));
    hash.add(name);
    hash.add(bytes);
  }
  return hash.value();
}

void Snapshot::require_finite() const {
  for (const auto& [name, array] : arrays_) {
    const auto* values = std::get_if<std::vector<Real>>(&array.values);
    if (!values) continue;
    for (std::size_t i = 0; i < values->size(); ++i)
      if (!std::isfinite((*values)[i]))
        throw SolveError(
            fmt::format("the state '{}' is {} at entry {} and was not saved; the last saved state "
                        "is still good",
                        name, (*values)[i], i));
  }
}

}  // namespace meniscus
