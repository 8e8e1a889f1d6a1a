// SPDX-License-Identifier: BSD-3-Clause
// The ranks of a run: processes that make the same steps on the same state and divide the rows
// between them. A run that mpirun did not start is the only rank.
#pragma once
#include "numbers/types.hpp"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <new>
#include <span>
#include <string>
#include <vector>

namespace meniscus {

/// What mpirun or srun says of this process in its environment.
struct Launch {
  int rank = 0, size = 1;
};
const Launch& launch();

/// Values that are made at one place, the root, and needed at others, the leaves.
class Exchange {
 public:
  virtual ~Exchange() = default;
  /// Brings each leaf of this rank the value of its root. `roots` and `leaves` are arrays of values
  /// of that many bytes; they may be the same array if no leaf of it is a root. All ranks call it.
  virtual void bring(const void* roots, void* leaves, std::size_t bytes_per_value) const = 0;
};

struct Leaf {
  Index place;  ///< among the leaves of this rank
  int rank;     ///< that has the root
  Index root;   ///< among the roots of that rank
};

/// Number of messages and bytes that a rank has sent.
struct Traffic {
  std::int64_t messages = 0, bytes = 0;
};

class Ranks {
 public:
  virtual ~Ranks() = default;
  virtual int rank() const { return 0; }
  virtual int size() const { return 1; }
  bool first() const { return rank() == 0; }
  bool alone() const { return size() == 1; }

  // All ranks call these together.

  /// Returns the largest of the values that the ranks pass.
  virtual std::int64_t largest(std::int64_t mine) { return mine; }
  /// Returns the largest of numbers, none of which is negative or NaN.
  Real largest_size(Real mine) {
    return std::bit_cast<Real>(largest(std::bit_cast<std::int64_t>(mine)));
  }
  /// Copies an array from one rank to all ranks.
  virtual void hand_out([[maybe_unused]] int from, [[maybe_unused]] void* values,
                        [[maybe_unused]] std::size_t bytes) {}
  /// Gathers an array on all ranks: rank r provides the bytes begin[r] to begin[r + 1] - 1.
  virtual void gather([[maybe_unused]] void* values,
                      [[maybe_unused]] std::span<const std::size_t> begin) {}
  /// Returns the text that one rank passes, on all ranks.
  std::string of_rank(int rank, std::string mine);
  /// The first rank that passes true; the last rank if there is none.
  int first_true(bool mine) {
    return size() - static_cast<int>(largest(mine ? size() - rank() : 1));
  }
  /// Returns the text of the first rank whose text is not empty; empty if there is none.
  std::string first_said(std::string mine);
  /// Makes an exchange for leaves whose roots are on other ranks. Not called if there is one rank.
  virtual std::unique_ptr<Exchange> exchange(Index roots, const std::vector<Leaf>& leaves);
  /// At the end of the program: returns the exit code of all. If the others do not come, this rank
  /// has failed alone: it says why and ends them.
  virtual int leave(int exit_code, const std::string& complaint);

  virtual Traffic traffic() const { return {}; }

  /// True once all ranks have called this; false if some do not within 20 s: then this rank has
  /// failed alone, and others wait for it elsewhere.
  virtual bool all_come() { return true; }
};

/// The ranks of this run. On a thread with a RanksOfThread, the ranks of that object.
Ranks& ranks();
/// While this object lives, ranks() returns `own` on the thread that made it.
class RanksOfThread {
 public:
  explicit RanksOfThread(Ranks& own);
  RanksOfThread(const RanksOfThread&) = delete;
  RanksOfThread& operator=(const RanksOfThread&) = delete;
  ~RanksOfThread();
};

/// Makes the ranks that mpirun has started those of this run. Not to be called by a program that
/// cannot.
void join_ranks();
/// Whether this program can: MPI is in a program of its own, so that others need not load it.
bool can_join_ranks();
/// Says how; returns true.
bool register_ranks(std::unique_ptr<Ranks> (*join)());

/// Calls what only one rank may do, as to write a file, on the first one. An exception there is
/// thrown on all ranks: as FileError, InputError, SolveError or Interrupted if it is one of these,
/// as OutOfMemory if memory is missing, else as std::runtime_error.
void on_first_rank(const std::function<void()>& work);

/// Calls what each rank does for a part of its own, as to build rows. An exception on one of them
/// is thrown on all, as by on_first_rank().
void on_each_rank(const std::function<void()>& work);

/// Throws FileError on all ranks if they do not give the same text. `name`: what it is, for the
/// message. Ranks read files by themselves, and directories of their machines may differ.
void require_alike(const std::string& text, const std::string& name);

/// Memory that is missing on one of the ranks.
struct OutOfMemory : std::bad_alloc {
  const char* what() const noexcept override { return "on one of the ranks"; }
};

}  // namespace meniscus
