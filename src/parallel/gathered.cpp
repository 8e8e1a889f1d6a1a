// SPDX-License-Identifier: BSD-3-Clause
// Packs the shares of a rank, exchanges all shares, and unpacks the shares of the other ranks.
#include "parallel/gathered.hpp"

#include <cstring>

namespace meniscus {

void GatherTogether::operator()(std::span<const Gathered> arrays,
                                const std::exception_ptr& failure) {
  if (ranks().alone()) {
    if (failure) std::rethrow_exception(failure);
    return;
  }
  constexpr std::size_t flag = 1;  // byte that tells of a failure
  begin_.assign(1, 0);
  for (int rank = 0; rank < ranks().size(); ++rank) {
    std::size_t bytes = flag;
    for (const Gathered& array : arrays) bytes += array.shares.sent_by(rank) * array.bytes_per_item;
    begin_.push_back(begin_.back() + bytes);
  }
  bytes_.resize(begin_.back());
  // Calls copy(place in bytes_, place in the array, number of bytes) for the shares of a rank.
  const auto for_shares = [&](int rank, auto&& copy) {
    std::byte* next = bytes_.data() + at(begin_, rank) + flag;
    for (const Gathered& array : arrays) {
      const std::size_t bytes = array.shares.sent_by(rank) * array.bytes_per_item,
                        before = static_cast<std::size_t>(array.shares.first(rank)) *
                                 array.bytes_per_item;
      if (bytes > 0) copy(next, static_cast<std::byte*>(array.values) + before, bytes);
      next += bytes;
    }
  };
  at(bytes_, at(begin_, ranks().rank())) = static_cast<std::byte>(failure ? 1 : 0);
  for_shares(ranks().rank(), [](std::byte* packed, const std::byte* values, std::size_t bytes) {
    std::memcpy(packed, values, bytes);
  });
  ranks().gather(bytes_.data(), begin_);
  bool failed = false;
  for (int rank = 0; rank < ranks().size(); ++rank) {
    failed |= at(bytes_, at(begin_, rank)) != std::byte{0};
    if (rank != ranks().rank())
      for_shares(rank, [](const std::byte* packed, std::byte* values, std::size_t bytes) {
        std::memcpy(values, packed, bytes);
      });
  }
  if (failed)
    on_each_rank([&] {
      if (failure) std::rethrow_exception(failure);
    });
}

}  // namespace meniscus
