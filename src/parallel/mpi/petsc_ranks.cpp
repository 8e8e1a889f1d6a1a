// SPDX-License-Identifier: BSD-3-Clause
// Ranks by MPI, and exchanges by PETSc's star forests. This is the only file that includes these
// libraries.
#include "meniscus/error.hpp"
#include "parallel/ranks.hpp"

#include <fmt/core.h>
#include <petscsf.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <map>
#include <stdexcept>
#include <thread>

namespace meniscus {
namespace {

/// Throws if a function of PETSc has failed. PETSc itself has printed its message by then.
void require(PetscErrorCode error) {
  if (error != 0) throw std::runtime_error(fmt::format("PETSc error {}", int{error}));
}

/// MPI's type for a value of so many bytes, made of doubles if possible.
MPI_Datatype type_of(std::size_t bytes) {
  static std::map<std::size_t, MPI_Datatype> known;
  const auto [entry, is_new] = known.try_emplace(bytes, MPI_DATATYPE_NULL);
  if (is_new) {
    const bool words = bytes % sizeof(double) == 0;
    MPI_Type_contiguous(static_cast<int>(words ? bytes / sizeof(double) : bytes),
                        words ? MPI_DOUBLE : MPI_BYTE, &entry->second);
    MPI_Type_commit(&entry->second);
  }
  return entry->second;
}

class StarForest final : public Exchange {
 public:
  StarForest(Index roots, const std::vector<Leaf>& leaves, Traffic& traffic) : traffic_(traffic) {
    std::vector<PetscInt> places;
    std::vector<PetscSFNode> of_root;
    for (const Leaf& leaf : leaves) {
      places.push_back(leaf.place);
      of_root.push_back({leaf.rank, leaf.root});
    }
    require(PetscSFCreate(PETSC_COMM_WORLD, &forest_));
    require(PetscSFSetGraph(forest_, roots, static_cast<PetscInt>(leaves.size()), places.data(),
                            PETSC_COPY_VALUES, of_root.data(), PETSC_COPY_VALUES));
    require(PetscSFSetUp(forest_));
    count();
  }
  StarForest(const StarForest&) = delete;
  StarForest& operator=(const StarForest&) = delete;
  ~StarForest() override {
    PetscBool too_late = PETSC_FALSE;  // PETSc is already finalised at the end of the program
    PetscFinalized(&too_late);
    if (!too_late) PetscSFDestroy(&forest_);
  }

  void bring(const void* roots, void* leaves, std::size_t bytes_per_value) const override {
    const MPI_Datatype type = type_of(bytes_per_value);
    require(PetscSFBcastBegin(forest_, type, roots, leaves, MPI_REPLACE));
    require(PetscSFBcastEnd(forest_, type, roots, leaves, MPI_REPLACE));
    traffic_.messages += messages_;
    traffic_.bytes += values_ * static_cast<std::int64_t>(bytes_per_value);
  }

 private:
  /// Counts the messages and values that this rank sends in one exchange.
  void count() {
    PetscMPIInt ranks = 0;
    const PetscMPIInt* rank = nullptr;
    const PetscInt *begin = nullptr, *root = nullptr;
    require(PetscSFGetLeafRanks(forest_, &ranks, &rank, &begin, &root));
    messages_ = ranks;
    values_ = ranks > 0 ? begin[ranks] - begin[0] : 0;
  }

  PetscSF forest_ = nullptr;
  Traffic& traffic_;
  std::int64_t messages_ = 0, values_ = 0;
};

class PetscRanks final : public Ranks {
 public:
  PetscRanks() {
    // Die with the launcher; otherwise ranks would be orphaned.
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    require(PetscOptionsSetValue(nullptr, "-no_signal_handler", "true"));
    require(PetscInitializeNoArguments());
    MPI_Comm_rank(PETSC_COMM_WORLD, &rank_);
    MPI_Comm_size(PETSC_COMM_WORLD, &size_);
    // A mismatch means separate runs that all write into one directory.
    if (size_ != launch().size)
      throw FileError(fmt::format(
          "rank {} of {} as it was started, but MPI knows of {} in all; expected is the mpirun of "
          "the MPI that meniscus-mpi is built with, or srun --mpi=pmix",
          launch().rank, launch().size, size_));
    // Communicators of their own: if a rank fails alone, the others may still wait in a call on the
    // first communicator.
    MPI_Comm_dup(PETSC_COMM_WORLD, &at_the_end_);
    MPI_Comm_dup(PETSC_COMM_WORLD, &apart_);
  }

  int rank() const override { return rank_; }
  int size() const override { return size_; }

  std::int64_t largest(std::int64_t mine) override {
    std::int64_t of_all = 0;
    MPI_Allreduce(&mine, &of_all, 1, MPI_INT64_T, MPI_MAX, PETSC_COMM_WORLD);
    ++traffic_.messages;
    traffic_.bytes += static_cast<std::int64_t>(sizeof mine);
    return of_all;
  }

  void hand_out(int from, void* values, std::size_t bytes) override {
    constexpr std::size_t most = std::size_t{1} << 30;  // MPI counts with int
    auto* part = static_cast<std::byte*>(values);
    for (std::size_t left = bytes; left > 0;) {
      const std::size_t now = std::min(left, most);
      MPI_Bcast(part, static_cast<int>(now), MPI_BYTE, from, PETSC_COMM_WORLD);
      part += now;
      left -= now;
    }
    if (from != rank_) return;
    ++traffic_.messages;
    traffic_.bytes += static_cast<std::int64_t>(bytes);
  }

  /// Gathers in log2(P) rounds; in each round, a rank sends as much as it receives.
  void gather(void* values, std::span<const std::size_t> begin) override {
    constexpr std::size_t most = std::size_t{1} << 30;
    if (begin.back() > most) return hand_out_in_turn(static_cast<std::byte*>(values), begin);
    count_.clear();
    for (std::size_t r = 0; r + 1 < begin.size(); ++r)
      count_.push_back(static_cast<int>(begin[r + 1] - begin[r]));
    begin_.assign(begin.begin(), begin.end());
    MPI_Allgatherv(MPI_IN_PLACE, 0, MPI_BYTE, values, count_.data(), begin_.data(), MPI_BYTE,
                   PETSC_COMM_WORLD);
    traffic_.messages += rounds();
    traffic_.bytes += begin_.back() - begin_.front() - count_[static_cast<std::size_t>(rank_)];
  }

  std::unique_ptr<Exchange> exchange(Index roots, const std::vector<Leaf>& leaves) override {
    return std::make_unique<StarForest>(roots, leaves, traffic_);
  }

  int leave(int exit_code, const std::string& complaint) override {
    int of_all = exit_code;
    MPI_Request all_here = MPI_REQUEST_NULL;
    if (!fails_alone_)
      MPI_Iallreduce(&exit_code, &of_all, 1, MPI_INT, MPI_MAX, at_the_end_, &all_here);
    if (fails_alone_ || !comes_true(all_here)) {
      std::fflush(stdout);
      if (rank_ > 0)
        std::fprintf(stderr, "rank %d (%s): %s\n", rank_, host().c_str(), complaint.c_str());
      MPI_Abort(PETSC_COMM_WORLD, exit_code);
    }
    PetscFinalize();
    return of_all;
  }

  Traffic traffic() const override { return traffic_; }

  bool all_come() override {
    if (fails_alone_) return false;
    MPI_Request all_here = MPI_REQUEST_NULL;
    MPI_Ibarrier(apart_, &all_here);
    fails_alone_ = !comes_true(all_here);
    return !fails_alone_;
  }

 private:
  void hand_out_in_turn(std::byte* values, std::span<const std::size_t> begin) {
    for (std::size_t r = 0; r + 1 < begin.size(); ++r)
      hand_out(static_cast<int>(r), values + begin[r], begin[r + 1] - begin[r]);
  }

  int rounds() const {
    int rounds = 0;
    while ((1 << rounds) < size_) ++rounds;
    return rounds;
  }

  /// True if the request completes within 20 s; other ranks may arrive late.
  static bool comes_true(MPI_Request& request) {
    using namespace std::chrono;
    constexpr milliseconds patience(20000), pause(1);
    const auto begin = steady_clock::now();
    for (int done = 0; !done; std::this_thread::sleep_for(pause)) {
      MPI_Test(&request, &done, MPI_STATUS_IGNORE);
      if (!done && steady_clock::now() - begin > patience) return false;
    }
    return true;
  }

  static std::string host() {
    std::array<char, 256> name{};
    gethostname(name.data(), name.size() - 1);
    return name.data();
  }

  int rank_ = 0, size_ = 1;
  bool fails_alone_ = false;
  MPI_Comm at_the_end_ = MPI_COMM_NULL, apart_ = MPI_COMM_NULL;
  std::vector<int> count_, begin_;  // work space of gather(), [rank]
  Traffic traffic_;
};

const bool petsc_ranks_registered =
    register_ranks([]() -> std::unique_ptr<Ranks> { return std::make_unique<PetscRanks>(); });

}  // namespace
}  // namespace meniscus
