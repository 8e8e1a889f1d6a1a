// SPDX-License-Identifier: BSD-3-Clause
// Memory of a body from the number of its cells.
#include "meniscus/body/cell_count.hpp"

#include "meniscus/core/error.hpp"
#include "meniscus/core/memory.hpp"

#include <fmt/core.h>

namespace meniscus {

template <int D>
void require_affordable(Real cells, const std::string& what) {
  constexpr Real most = 2e8;
  if (cells > most)
    throw InputError(
        fmt::format("{} would have {:.4g} cells; at most {:.4g} are possible", what, cells, most));
  // Less than what the default supports and any integration take while they are set up (50 to 80 kB
  // in 3D, 8 kB in 2D).
  constexpr Real bytes_per_cell = D == 3 ? 40e3 : 6e3;
  const Real needed = cells * bytes_per_cell, there = available_memory();
  if (needed > there)
    throw InputError(
        fmt::format("{} would have {:.4g} cells and take about {:.3g} GB of memory, {:.3g} GB "
                    "are there; use fewer cells",
                    what, cells, 1e-9 * needed, 1e-9 * there));
}

template void require_affordable<2>(Real, const std::string&);
template void require_affordable<3>(Real, const std::string&);

}  // namespace meniscus
