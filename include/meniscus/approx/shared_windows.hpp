// SPDX-License-Identifier: BSD-3-Clause
// The chunks of a set of rows divided between the ranks of a run, and what they exchange: a rank
// does the rows of some chunks and adds up the windows over some particles (scaling note 2).
#pragma once
#include "meniscus/core/aligned.hpp"
#include "meniscus/core/halo.hpp"
#include "meniscus/core/parallel.hpp"
#include "meniscus/core/ranks.hpp"

#include <cstring>
#include <span>
#include <vector>

namespace meniscus {

/// A chunk of rows and its sums, of the particles that they touch in ascending order.
struct WindowChunk {
  int number;
  Index begin, end;    ///< rows
  Index sum, sum_end;  ///< among the sums of this rank
};

/// A sum of a window and the particle it is part of the force on.
struct WindowSum {
  Index particle, sum;
};

class SharedWindows {
 public:
  /// `chunks`: all that have rows, in ascending order, of compressed rows; of the rows, and of
  /// `touched`, the particles of their sums, only those of own chunks are looked at.
  SharedWindows(std::vector<WindowChunk> chunks, std::span<const Index> touched,
                std::span<const Offset> start, Index particles);

  /// Those whose rows this rank does.
  const std::vector<WindowChunk>& own() const { return own_; }
  /// Sums of the forces on this rank's particles, in ascending order of chunks.
  const std::vector<WindowSum>& summed() const { return summed_; }
  ItemRange summed_particles() const {
    return {at(border_, ranks().rank()), at(border_, ranks().rank() + 1)};
  }
  /// Of the sums of all windows here.
  Index size() const { return size_; }
  /// Pairs of all rows and particles.
  Offset pairs() const { return pairs_; }

  /// Windows of the rows of other ranks.
  void bring_windows(NodalVectors& sums) const {
    windows_->bring(sums.data(), sums.data(), sizeof(NodalVector));
  }
  /// Forces on all particles that the rows touch; while a halo is entered, nothing.
  void spread_forces(std::span<NodalVector> force) const {
    if (!is_entered(halo_)) particles_->bring(force.data(), force.data(), sizeof(NodalVector));
  }
  /// Marks the particles that the rows of this rank touch.
  void mark_touched(std::span<std::uint8_t> particles) const;
  /// Marks those over which it adds up windows.
  void mark_summed(std::span<std::uint8_t> particles) const;
  /// From now on forces are spread by the halo, when it is entered, and not by these windows.
  void keep_to(std::shared_ptr<const Halo> halo) { halo_ = std::move(halo); }
  template <class... T>
  void spread_results(PerChunk<T>&... results);

 private:
  /// The particles that the rows of each chunk touch, [chunk].
  using Touched = std::vector<std::vector<Index>>;
  /// Bits of `touched_`.
  static constexpr std::uint8_t by_a_rank = 1, by_this_rank = 2;

  Touched touched_by_chunks(const std::vector<WindowChunk>& chunks, std::span<const Index> touched,
                            std::span<const Offset> start);
  void share_windows(const std::vector<WindowChunk>& chunks, const Touched& touched);
  void remember_touched(const Touched& touched);
  /// Forces of particles that rows touch and other ranks add up.
  std::unique_ptr<Exchange> exchange_of_forces() const;
  void share_results(const std::vector<WindowChunk>& chunks);

  template <class T>
  static constexpr std::size_t in_record = (sizeof(T) + 7) / 8 * 8;

  std::vector<int> rank_;      // that does a chunk, [chunk]
  std::vector<Index> border_;  // particle at which those of a rank begin, [rank], and their number
  std::vector<WindowChunk> own_;
  std::vector<WindowSum> summed_;
  Index size_ = 0;
  Offset pairs_ = 0;
  int numbers_ = 0;                    // of chunks are below this
  std::vector<int> foreign_;           // numbers of the chunks of others
  std::vector<std::uint8_t> touched_;  // by rows of which ranks, [particle]
  std::unique_ptr<Exchange> windows_, particles_, chunks_;
  std::shared_ptr<const Halo> halo_;
  std::vector<std::byte> records_;  // results, [chunk number]
};

template <class... T>
void SharedWindows::spread_results(PerChunk<T>&... results) {
  constexpr std::size_t size = (in_record<T> + ...);
  const auto for_each = [&](int number, auto&& copy) {
    std::byte* record = records_.data() + size * static_cast<std::size_t>(number);
    const auto next = [&](auto& values) {
      using Value = std::remove_cvref_t<decltype(at(values, number))>;
      if (values.begin() != values.end()) copy(record, &at(values, number), sizeof(Value));
      record += in_record<Value>;
    };
    (next(results), ...);
  };
  records_.resize(size * static_cast<std::size_t>(numbers_));
  for (const WindowChunk& chunk : own_)
    for_each(chunk.number, [](std::byte* record, const void* value, std::size_t bytes) {
      std::memcpy(record, value, bytes);
    });
  chunks_->bring(records_.data(), records_.data(), size);
  for (const int number : foreign_)
    for_each(number, [](const std::byte* record, void* value, std::size_t bytes) {
      std::memcpy(value, record, bytes);
    });
}

}  // namespace meniscus
