// SPDX-License-Identifier: BSD-3-Clause
// Ranks as threads: each posts the address of its values, and the others copy from there.
#include "parallel/thread_ranks.hpp"

#include "parallel/ranks.hpp"

#include <omp.h>

#include <algorithm>
#include <condition_variable>
#include <cstring>
#include <exception>
#include <mutex>
#include <thread>

namespace meniscus {
namespace {

/// Thrown on ranks that wait for a rank that has failed.
struct OtherRankFailed {};

/// The place where ranks meet.
class Meeting {
 public:
  explicit Meeting(int size) : values_(static_cast<std::size_t>(size)) {}

  int size() const { return static_cast<int>(values_.size()); }
  /// Posts the address of values and returns when all ranks have posted theirs. The values must not
  /// change before part().
  void post(int rank, const void* values) {
    values_[static_cast<std::size_t>(rank)] = values;
    part();
  }
  const std::byte* of(int rank) const {
    return static_cast<const std::byte*>(values_[static_cast<std::size_t>(rank)]);
  }
  /// Returns when all ranks have called it.
  void part() {
    std::unique_lock lock(mutex_);
    if (failed_) throw OtherRankFailed();
    const std::int64_t meeting = meetings_;
    if (++here_ == size()) {
      here_ = 0;
      ++meetings_;
      all_here_.notify_all();
    }
    all_here_.wait(lock, [&] { return failed_ || meetings_ != meeting; });
    if (meetings_ == meeting) throw OtherRankFailed();
  }
  void fail() {
    const std::lock_guard lock(mutex_);
    failed_ = true;
    all_here_.notify_all();
  }

 private:
  std::vector<const void*> values_;  // [rank]
  std::mutex mutex_;
  std::condition_variable all_here_;
  int here_ = 0;
  std::int64_t meetings_ = 0;
  bool failed_ = false;
};

class ThreadExchange final : public Exchange {
 public:
  ThreadExchange(Meeting& meeting, int rank, std::vector<Leaf> leaves)
      : meeting_(meeting), rank_(rank), leaves_(std::move(leaves)) {}

  void bring(const void* roots, void* leaves, std::size_t bytes) const override {
    meeting_.post(rank_, roots);
    for (const Leaf& leaf : leaves_)
      std::memcpy(static_cast<std::byte*>(leaves) + static_cast<std::size_t>(leaf.place) * bytes,
                  meeting_.of(leaf.rank) + static_cast<std::size_t>(leaf.root) * bytes, bytes);
    meeting_.part();
  }

 private:
  Meeting& meeting_;
  int rank_;
  std::vector<Leaf> leaves_;
};

class ThreadRank final : public Ranks {
 public:
  ThreadRank(Meeting& meeting, int rank) : meeting_(meeting), rank_(rank) {}

  int rank() const override { return rank_; }
  int size() const override { return meeting_.size(); }

  std::int64_t largest(std::int64_t mine) override {
    std::int64_t of_all = mine;
    meeting_.post(rank_, &mine);
    for (int r = 0; r < size(); ++r) {
      std::int64_t of_rank = 0;
      std::memcpy(&of_rank, meeting_.of(r), sizeof of_rank);
      of_all = std::max(of_all, of_rank);
    }
    meeting_.part();
    return of_all;
  }
  void hand_out(int from, void* values, std::size_t bytes) override {
    meeting_.post(rank_, values);
    if (from != rank_ && bytes > 0) std::memcpy(values, meeting_.of(from), bytes);
    meeting_.part();
  }
  void gather(void* values, std::span<const std::size_t> begin) override {
    meeting_.post(rank_, values);
    for (int r = 0; r < size(); ++r) {
      const auto k = static_cast<std::size_t>(r);
      if (r != rank_ && begin[k + 1] > begin[k])
        std::memcpy(static_cast<std::byte*>(values) + begin[k], meeting_.of(r) + begin[k],
                    begin[k + 1] - begin[k]);
    }
    meeting_.part();
  }
  std::unique_ptr<Exchange> exchange(Index, const std::vector<Leaf>& leaves) override {
    return std::make_unique<ThreadExchange>(meeting_, rank_, leaves);
  }

 private:
  Meeting& meeting_;
  int rank_;
};

}  // namespace

void as_ranks(int size, const std::function<void()>& work) {
  Meeting meeting(size);
  std::vector<std::exception_ptr> failures(static_cast<std::size_t>(size));
  std::vector<std::thread> threads;
  for (int rank = 0; rank < size; ++rank)
    threads.emplace_back([&, rank] {
      ThreadRank own(meeting, rank);
      const RanksOfThread joined(own);
      omp_set_num_threads(1);
      try {
        work();
      } catch (const OtherRankFailed&) {  // which has an exception of its own
      } catch (...) {
        failures[static_cast<std::size_t>(rank)] = std::current_exception();
        meeting.fail();
      }
    });
  for (std::thread& thread : threads) thread.join();
  for (const std::exception_ptr& failure : failures)
    if (failure) std::rethrow_exception(failure);
}

}  // namespace meniscus
