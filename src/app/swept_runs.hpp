// SPDX-License-Identifier: BSD-3-Clause
// The keys that differ between the runs of a sweep, and their values in each.
#pragma once
#include <string>
#include <vector>

namespace meniscus {

/// One key and its values, as texts.
struct SweptKey {
  std::string key;
  std::vector<std::string> values;
};

/// Splits "key=a,b,c" into the key and its values. A comma within brackets or quotes does not
/// separate values. Throws InputError.
SweptKey swept_key(const std::string& setting);

/// The runs of a sweep: the value of each key in each run.
struct SweptRuns {
  using Values = std::vector<std::string>;
  std::vector<std::string> keys;
  std::vector<Values> values;  ///< [run][key]
};

/// All combinations of the values of "key=a,b,c", ...; the last key varies fastest. Throws
/// InputError.
SweptRuns combinations_of(const std::vector<std::string>& settings);

/// A Latin hypercube of `count` runs between the bounds of "key=low,high", ...: each key has one
/// value in each `count`-th part of its interval, at a random place, and their order is random. The
/// same request gives the same runs. Bounds are numbers, or quantities of the same unit. Throws
/// InputError.
SweptRuns sample_of(const std::vector<std::string>& settings, int count);

/// A directory for each run, whose name contains its values, such as "gamma=72.8mN_m". Throws
/// InputError if a name would be too long, or two runs would have the same.
std::vector<std::string> directories_of(const SweptRuns& runs);

}  // namespace meniscus
