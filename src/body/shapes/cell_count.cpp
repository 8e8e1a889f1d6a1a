// SPDX-License-Identifier: BSD-3-Clause
// Memory of a body, estimated from the number of its cells.
#include "body/shapes/cell_count.hpp"

#include "meniscus/error.hpp"
#include "parallel/memory.hpp"
#include "parallel/ranks.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace meniscus {
namespace {

/// The least memory that any rank has available, so that all ranks take the same decision.
Real least_of_ranks(Real bytes) {
  constexpr Real most = 9e18;  // largest value that fits into an integer
  return -static_cast<Real>(ranks().largest(-static_cast<std::int64_t>(std::min(bytes, most))));
}

}  // namespace

Real cells_along(Real length, Real spacing) {
  return std::max(std::ceil(length / spacing - 1e-9), 1.0);
}

template <int D>
void require_affordable(Real cells, Real cells_per_particle) {
  constexpr Real most = 2e8;
  if (cells > most)
    throw InputError(
        fmt::format("the body would have {:.4g} cells; at most {:.4g} are possible", cells, most));
  constexpr Real bytes_per_particle = D == 3 ? 8e3 : 1.5e3;
  require_memory(cells / cells_per_particle * bytes_per_particle,
                 fmt::format("the body would have {:.4g} cells", cells));
}

template void require_affordable<2>(Real, Real);
template void require_affordable<3>(Real, Real);

void require_memory(Real bytes, const std::string& what) {
  const Real there = least_of_ranks(available_memory());
  if (bytes > there)
    throw InputError(
        fmt::format("{} and take about {:.3g} GB of memory, {:.3g} GB are there; use fewer cells",
                    what, 1e-9 * bytes, 1e-9 * there));
}

}  // namespace meniscus
