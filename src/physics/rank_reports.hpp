// SPDX-License-Identifier: BSD-3-Clause
// Reports of terms that one rank alone knows, brought to all at once.
#pragma once
#include "meniscus/physics/force_term.hpp"
#include "parallel/shared_items.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace meniscus {

class RankReports {
 public:
  /// Completes those of these reports that have Report::known_by. All ranks call this with reports
  /// of the same terms. Throws SolveError on all of them where one has an error.
  void complete(std::span<Report> reports);

 private:
  enum class Words : std::uint8_t { none, of_failure, of_error };
  struct Numbers {
    Real heat, external_power, external_work;
    Resultant outside;
    StepDemand demand;
    Words words;
  };
  static Words words_of(const Report& report);

  SharedItems items_;
  std::vector<Numbers> numbers_;  // of the reports that ranks know alone
};

}  // namespace meniscus
