// SPDX-License-Identifier: BSD-3-Clause
// Ranges of followed particles, and the exchange of the others at the end of steps in a halo.
#include "parallel/halo.hpp"

#include <limits>

namespace meniscus {

Halo::Halo(std::vector<std::uint8_t> read, ParticleOwners owners)
    : read_(std::move(read)), owners_(std::move(owners)) {
  const Index n = owners_.particles();
  Index own = 0;
  for (const OwnItems part : owners_.own()) {
    std::fill(read_.begin() + part.begin, read_.begin() + part.end, std::uint8_t{1});
    own += part.end - part.begin;
  }
  constexpr Index longest = 2048;
  for (Index A = 0; A < n; ++A) {
    if (!follows(A)) continue;
    ++size_;
    if (!parts_.empty() && parts_.back().end == A && A - parts_.back().begin < longest)
      ++parts_.back().end;
    else
      parts_.push_back({A, A + 1});
  }
  ghosts_ = size_ - own;
  partial_ = ranks().largest(n - size_) > 0;
  std::vector<Leaf> leaves;
  for (Index A = 0; A < n; ++A)
    if (const int rank = follows(A) ? owners_.adds_up(A) : ranks().rank(); rank != ranks().rank())
      leaves.push_back({A, rank, A});
  sums_ = ranks().exchange(n, leaves);
}

void Halo::spread(std::span<NodalVector> sums) const {
  sums_->bring(sums.data(), sums.data(), sizeof(NodalVector));
}

void Halo::gather(std::span<const NodalVector> followed, NodalVectors& all) const {
  all.assign(followed.begin(), followed.end());
  owners_.complete(all.data(), sizeof(NodalVector));
}

void Halo::enter(std::initializer_list<NodalVectors*> motion) {
  if (entered_) return;
  entered_ = true;
  const Lanes unknown(std::numeric_limits<Real>::quiet_NaN());
  const auto forget = [&](NodalVectors& x) {
    for (std::size_t A = 0; A < x.size(); ++A)
      if (read_[A] == 0) x[A] = unknown;
  };
  for (NodalVectors* x : motion) forget(*x);
  for (NodalVectors* x : kept_) forget(*x);
}

void Halo::leave(std::initializer_list<NodalVectors*> motion) {
  if (!entered_) return;
  entered_ = false;
  const auto complete = [&](NodalVectors& x) { owners_.complete(x.data(), sizeof(NodalVector)); };
  for (NodalVectors* x : motion) complete(*x);
  for (NodalVectors* x : kept_) complete(*x);
}

}  // namespace meniscus
