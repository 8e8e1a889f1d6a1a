// SPDX-License-Identifier: BSD-3-Clause
// Values at particles: each rank computes its own rows, then all values are gathered.
#include "body/particle_values.hpp"

#include "kernel/row_sums.hpp"
#include "parallel/divided.hpp"

#include <algorithm>
#include <numeric>

namespace meniscus {

template <int D>
NodalVectors values_at_particles(const Body<D>& body, const NodalVector* c) {
  std::vector<Index> all(static_cast<std::size_t>(body.size()));
  std::iota(all.begin(), all.end(), 0);
  return values_at_particles(body, c, all);
}

template <int D>
NodalVectors values_at_particles(const Body<D>& body, const NodalVector* c,
                                 std::span<const Index> which) {
  NodalVectors values(which.size());
  // The position in `which` at which the particles of a rank begin.
  const auto begin_of = [&](int rank) {
    return static_cast<Index>(
        std::lower_bound(which.begin(), which.end(), body.division.first_row(body.size(), rank)) -
        which.begin());
  };
  const Index begin = begin_of(ranks().rank());
  parallel_for(begin_of(ranks().rank() + 1) - begin, [&](Index k) {
    at(values, begin + k) = value_at(body.at_particles, at(which, begin + k), c);
  });
  for (int rank = 0; rank < ranks().size(); ++rank) {
    const auto first = static_cast<std::size_t>(begin_of(rank)),
               last = static_cast<std::size_t>(begin_of(rank + 1));
    ranks().hand_out(rank, values.data() + first, (last - first) * sizeof(NodalVector));
  }
  return values;
}

template <int D>
std::shared_ptr<const PointRows<D>> rows_of_all_particles(const Body<D>& body) {
  const PointRows<D>& own = body.at_particles;
  if (ranks().alone()) return {std::shared_ptr<void>(), &own};
  auto rows = std::make_shared<PointRows<D>>();
  PointRows<D>& all = *rows;
  std::vector<Index> length(static_cast<std::size_t>(body.size()));
  for (Index A = 0; A < body.size(); ++A)
    at(length, A) = static_cast<Index>(at(own.start, A + 1) - at(own.start, A));
  body.division.complete_rows(body.size(), length.data(), sizeof(Index));
  for (const Index count : length) all.start.push_back(all.start.back() + count);
  all.particle.resize(static_cast<std::size_t>(all.entries()));
  all.value.resize(all.particle.size());
  all.folded = own.folded;
  if (own.folded) all.odd_value.resize(all.particle.size());
  for (int rank = 0; rank < ranks().size(); ++rank) {
    const Offset first = at(all.start, body.division.first_row(body.size(), rank)),
                 count = at(all.start, body.division.first_row(body.size(), rank + 1)) - first;
    if (rank == ranks().rank())
      std::copy_n(own.particle.begin(), count, all.particle.begin() + first);
    ranks().hand_out(rank, all.particle.data() + first,
                     static_cast<std::size_t>(count) * sizeof(Index));
    for (auto array : {&PointRows<D>::value, &PointRows<D>::odd_value}) {
      if ((all.*array).empty()) continue;
      if (rank == ranks().rank())
        std::copy_n((own.*array).begin(), count, (all.*array).begin() + first);
      ranks().hand_out(rank, (all.*array).data() + first,
                       static_cast<std::size_t>(count) * sizeof(Real));
    }
  }
  return rows;
}

#define MENISCUS_INSTANTIATE(D)                                                  \
  template NodalVectors values_at_particles(const Body<D>&, const NodalVector*); \
  template NodalVectors values_at_particles(const Body<D>&, const NodalVector*,  \
                                            std::span<const Index>);             \
  template std::shared_ptr<const PointRows<D>> rows_of_all_particles(const Body<D>&);
MENISCUS_INSTANTIATE(2)
MENISCUS_INSTANTIATE(3)
#undef MENISCUS_INSTANTIATE

}  // namespace meniscus
