// SPDX-License-Identifier: BSD-3-Clause
// Cells that share volume changes with their neighbours.
#include "physics/internal/averaged_volumes.hpp"

#include <algorithm>

namespace meniscus {

template <int D>
AveragedVolumes<D>::AveragedVolumes(const Body<D>& body, std::vector<Real> own)
    : body_(body), own_(std::move(own)), projection_(body) {}

template <int D>
ItemRange AveragedVolumes<D>::numbers_in(Index begin, Index end) const {
  const auto number_of_next = [&](Index cell) {
    return static_cast<Index>(std::lower_bound(coupled().begin(), coupled().end(), cell) -
                              coupled().begin());
  };
  return {number_of_next(begin), number_of_next(end)};
}

template class AveragedVolumes<2>;
template class AveragedVolumes<3>;

}  // namespace meniscus
