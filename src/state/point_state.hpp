// SPDX-License-Identifier: BSD-3-Clause
// Values that a law with a memory keeps at its points between steps.
#pragma once
#include "numbers/tensor.hpp"
#include "parallel/gathered.hpp"
#include "state/archive.hpp"

#include <array>

namespace meniscus {

/// A symmetric tensor at each point of the groups of an integration rule, zero at first. Only
/// accepted steps change it: a force computes trial values from the values kept here. Groups are
/// divided between processes as rows are.
class PointTensors {
 public:
  PointTensors(Index groups, const Division& division)
      : groups_(groups),
        division_(division),
        values_(per_group * static_cast<std::size_t>(groups), Lanes::zero()) {}

  Tensor<Lanes> operator[](Index group) const {
    return Tensor<Lanes>::map([&](int i, int j) { return values_[number(group, i, j)]; });
  }
  /// Keeps the upper half of x.
  void set(Index group, const Tensor<Lanes>& x) {
    for (int i = 0; i < 3; ++i)
      for (int j = i; j < 3; ++j) values_[number(group, i, j)] = x(i, j);
  }

  /// Saves or restores the tensors of all processes: 11, 12, 13, 22, 23, 33 of each group, four
  /// points each.
  void archive(const Archive& a, std::string_view name) {
    const Gathered all{values_.data(), division_.rows(groups_), per_group};
    if (!a.is_reading()) GatherTogether()({&all, 1});
    constexpr int points = 4;
    a(name, values_, points);
  }
  std::size_t bytes() const { return values_.size() * sizeof(Lanes); }

 private:
  static constexpr std::size_t per_group = 6;
  static std::size_t number(Index group, int i, int j) {
    constexpr std::array<std::size_t, 9> of{0, 1, 2, 1, 3, 4, 2, 4, 5};
    return per_group * static_cast<std::size_t>(group) + of[static_cast<std::size_t>(3 * i + j)];
  }

  Index groups_;
  Division division_;
  NodalVectors values_;
};

}  // namespace meniscus
