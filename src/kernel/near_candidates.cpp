// SPDX-License-Identifier: BSD-3-Clause
// Distances between four points and candidates, four candidates at a time.
#include "kernel/near_candidates.hpp"

#include <algorithm>
#include <bit>

namespace meniscus {
namespace {

/// lanes_of_bits[mask]: the lanes that are set in the mask in ascending order, then zeros.
constexpr auto lanes_of_bits = [] {
  std::array<std::array<Index, Lanes::width>, 1 << Lanes::width> lanes{};
  for (std::size_t bits = 0; bits < lanes.size(); ++bits)
    for (std::size_t lane = 0, count = 0; lane < Lanes::width; ++lane)
      if ((bits >> lane & 1) != 0) lanes[bits][count++] = static_cast<Index>(lane);
  return lanes;
}();

}  // namespace

template <int D>
void NearCandidates<D>::begin(std::span<const Candidate<D>> candidates) {
  constexpr Real nowhere = -1;  // no squared distance is below this
  all_ = candidates;
  const std::size_t fours = (all_.size() + Lanes::width - 1) / Lanes::width;
  if (near_.size() < fours * Lanes::width) {
    near_.resize(fours * Lanes::width);
    numbers_.resize(near_.size());
    place_.resize(fours * D);
    square_.resize(fours);
  }
  for (std::size_t k = 0; k < fours * Lanes::width; ++k) {
    const Candidate<D>& candidate = all_[std::min(k, all_.size() - 1)];
    const std::size_t four = k / Lanes::width;
    const int lane = static_cast<int>(k % Lanes::width);
    for (int i = 0; i < D; ++i)
      place_[four * D + static_cast<std::size_t>(i)].set(lane, candidate.X[i]);
    square_[four].set(
        lane, k < all_.size() ? candidate.support * candidate.support * (1 + 1e-12) : nowhere);
  }
}

template <int D>
void NearCandidates<D>::select(const std::array<Vec<D>, 4>& points) {
  const std::size_t fours = (all_.size() + Lanes::width - 1) / Lanes::width;
  std::size_t count = 0;
  const std::array<Vec<D>, 4> all = points;  // a copy, which no store below can change
  for (std::size_t four = 0; four < fours; ++four) {
    Lanes::Mask reaches{};
    for (const Vec<D>& x : all) {
      Lanes square = Lanes::zero();
      for (int i = 0; i < D; ++i) {
        const Lanes away = place_[four * D + static_cast<std::size_t>(i)] - x[i];
        square += away * away;
      }
      reaches |= square.v <= square_[four].v;
    }
    const unsigned bits = lane_bits(reaches);  // without a branch, which could not be predicted
    std::array<Index, Lanes::width> numbers = lanes_of_bits[bits];
    for (Index& number : numbers) number += static_cast<Index>(four) * Lanes::width;
    std::copy(numbers.begin(), numbers.end(), numbers_.data() + count);
    count += static_cast<std::size_t>(std::popcount(bits));
  }
  count_ = count;
  for (std::size_t k = 0; k < count; ++k) near_[k] = all_[static_cast<std::size_t>(numbers_[k])];
}

template class NearCandidates<2>;
template class NearCandidates<3>;

}  // namespace meniscus
