// SPDX-License-Identifier: BSD-3-Clause
// Numbers of reports in one exchange; words, which are rare, after them.
#include "physics/rank_reports.hpp"

#include "meniscus/error.hpp"

namespace meniscus {
namespace {

/// Of a rank that has one.
Failure failure_of(int rank, const std::optional<Failure>& mine) {
  Failure failure = mine.value_or(Failure{});
  failure.cause = ranks().of_rank(rank, failure.cause);
  ranks().hand_out(rank, &failure.particle, sizeof failure.particle);
  ranks().hand_out(rank, &failure.of_step, sizeof failure.of_step);
  return failure;
}

}  // namespace

RankReports::Words RankReports::words_of(const Report& report) {
  if (!report.error.empty()) return Words::of_error;
  return report.failure ? Words::of_failure : Words::none;
}

void RankReports::complete(std::span<Report> reports) {
  items_.clear();
  numbers_.clear();
  for (const Report& report : reports) {
    if (!report.known_by) continue;
    items_.add(*report.known_by);
    numbers_.push_back({report.heat, report.external_power, report.external_work, report.outside,
                        report.demand, words_of(report)});
  }
  if (numbers_.empty()) return;
  items_.complete(numbers_.data(), sizeof numbers_[0]);
  auto next = numbers_.cbegin();
  for (Report& report : reports) {
    if (!report.known_by) continue;
    const Numbers& numbers = *next++;
    const int rank = *report.known_by;
    if (numbers.words == Words::of_error) throw SolveError(ranks().of_rank(rank, report.error));
    const std::optional<Failure> mine = std::move(report.failure);
    report = {numbers.heat, numbers.external_power, numbers.external_work, numbers.outside,
              numbers.demand};
    if (numbers.words == Words::of_failure) report.failure = failure_of(rank, mine);
  }
}

}  // namespace meniscus
