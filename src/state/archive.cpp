// SPDX-License-Identifier: BSD-3-Clause
// Writing values to a snapshot and reading them back.
#include "state/archive.hpp"

#include <stdexcept>

namespace meniscus {

Archive Archive::writing(Snapshot& snapshot, Symbol symbol) {
  Archive a;
  a.to_ = &snapshot;
  a.symbol_ = symbol ? std::move(symbol) : [](Dimension) { return std::string("1"); };
  return a;
}

Archive Archive::reading(const Snapshot& snapshot) {
  Archive a;
  a.from_ = &snapshot;
  return a;
}

Archive Archive::in(std::string_view group) const {
  Archive part = *this;
  part.prefix_ = full(group) + "/";
  return part;
}

bool Archive::has(std::string_view group) const {
  if (!from_) return false;
  const std::string prefix = full(group) + "/";
  const auto found = from_->arrays().lower_bound(prefix);
  return found != from_->arrays().end() && found->first.starts_with(prefix);
}

std::string Archive::unused(std::string_view name) const {
  if (to_->has(full(name))) throw std::logic_error("'" + full(name) + "' is kept twice");
  return full(name);
}

void Archive::numbers(std::string_view name, std::span<Real> x, Dimension dimension) const {
  if (from_)
    from_->copy_to(full(name), x);
  else if (to_)
    to_->add_reals(unused(name), x, symbol_(dimension));
}

void Archive::operator()(std::string_view name, Real& x, Dimension dimension) const {
  numbers(name, {&x, 1}, dimension);
}

void Archive::operator()(std::string_view name, Eigen::Vector3d& x, Dimension dimension) const {
  numbers(name, {x.data(), 3}, dimension);
}

void Archive::operator()(std::string_view name, std::vector<Real>& x, Dimension dimension) const {
  numbers(name, x, dimension);
}

void Archive::operator()(std::string_view name, std::int64_t& x) const {
  if (from_)
    x = from_->integer(full(name));
  else if (to_)
    to_->add_integers(unused(name), {&x, 1});
}

void Archive::operator()(std::string_view name, bool& x) const {
  std::int64_t number = x;
  (*this)(name, number);
  x = number != 0;
}

void Archive::operator()(std::string_view name, std::string& x) const {
  if (from_)
    x = from_->text(full(name));
  else if (to_)
    to_->add_text(unused(name), x);
}

void Archive::operator()(std::string_view name, std::optional<Real>& x, Dimension dimension) const {
  if (from_) {
    x.reset();
    if (from_->has(full(name))) x = from_->real(full(name));
  } else if (x) {
    (*this)(name, *x, dimension);
  }
}

void Archive::operator()(std::string_view name, std::map<std::string, Real>& x,
                         Dimension dimension) const {
  const Archive part = in(name);
  for (auto& [key, value] : x) part(key, value, dimension);
}

void Archive::operator()(std::string_view name, NodalVectors& x, int components,
                         Dimension dimension) const {
  if (is_nowhere()) return;
  std::vector<Real> packed;
  packed.reserve(x.size() * static_cast<std::size_t>(components));
  for (const Lanes& vector : x)
    for (int i = 0; i < components; ++i) packed.push_back(vector[i]);
  numbers(name, packed, dimension);
  if (!from_) return;
  auto value = packed.begin();
  for (Lanes& vector : x) {
    vector = Lanes::zero();
    for (int i = 0; i < components; ++i) vector.set(i, *value++);
  }
}

}  // namespace meniscus
