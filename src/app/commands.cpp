// SPDX-License-Identifier: BSD-3-Clause
// Conversion of command-line values.
#include "app/commands.hpp"

#include "meniscus/error.hpp"

#include <fmt/core.h>

#include <cmath>
#include <limits>

namespace meniscus {

Real time_to_stop(const RunRequest& request, const UnitSystem& units) {
  if (request.until.empty()) return std::numeric_limits<Real>::infinity();
  try {
    std::size_t used = 0;
    const Real number = std::stod(request.until, &used);
    const Real time =
        used == request.until.size() ? number : units.quantity(request.until, dimension::time);
    if (time > 0 && std::isfinite(time)) return time;
  } catch (const std::exception&) {
  }
  throw InputError(
      fmt::format("--until '{}': allowed is a time > 0 in {}, or with a unit, e.g. '1 ps'",
                  request.until, units.symbol(dimension::time)));
}

}  // namespace meniscus
