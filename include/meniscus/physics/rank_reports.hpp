// SPDX-License-Identifier: BSD-3-Clause
// Reports of terms that one rank alone knows, brought to all at once.
#pragma once
#include "meniscus/core/shared_items.hpp"
#include "meniscus/physics/force_term.hpp"

#include <span>
#include <vector>

namespace meniscus {

class RankReports {
 public:
  /// Completes those of these reports that have Report::known_by. All ranks call this with reports
  /// of the same terms.
  void complete(std::span<Report> reports);

 private:
  struct Numbers {
    Real heat, external_power, external_work;
    StepDemand demand;
    bool failed;
  };

  SharedItems items_;
  std::vector<Numbers> numbers_;  // of the reports that ranks know alone
};

}  // namespace meniscus
