// SPDX-License-Identifier: BSD-3-Clause
// Contact points on several processes: the particles that a process reads, and the places that each
// process computes for all.
#include "physics/contact/points/contact_points.hpp"
#include "physics/contact/points/patch_points.hpp"

#include <algorithm>

namespace meniscus {

template <int D>
void ContactPoints<D>::list_reads(StepReads& reads) const {
  reads.particles(made_->particles, body_->first);
  list_sums(reads);
}

template <int D>
void ContactPoints<D>::list_reads(StepReads& reads, std::span<const Index> clusters) const {
  const auto list_row = [&](const PointRows<D>& rows, Index row) {
    const Offset begin = at(rows.start, row), count = at(rows.start, row + 1) - begin;
    reads.particles(std::span(rows.particle)
                        .subspan(static_cast<std::size_t>(begin), static_cast<std::size_t>(count)),
                    body_->first);
  };
  if (made_->patches) {
    std::vector<std::uint8_t> is_wanted(static_cast<std::size_t>(made_->patches->node_count()), 0);
    for (const Index c : clusters)
      for (Index lane = 0; lane < points_in(c); ++lane)
        made_->patches->want(at(made_->order, c * Lanes::width + lane), is_wanted);
    for (Index node = 0; node < made_->patches->node_count(); ++node)
      if (at(is_wanted, node)) list_row(made_->patches->rows(), node);
  } else {
    for (const Index c : clusters)
      for (Index lane = 0; lane < points_in(c); ++lane)
        list_row(made_->rule.rows, c * Lanes::width + lane);
  }
  list_sums(reads);
}

template <int D>
void ContactPoints<D>::list_sums(StepReads& reads) const {
  if (made_->patches)
    made_->patches->list_sums(reads, body_->first);
  else
    reads.sums(made_->chunk_sums, body_->first);
}

template <int D>
void ContactPoints<D>::list_own_nodes(StepReads& reads) const {
  made_->patches->list_reads(reads, body_->first);
}

template <int D>
std::span<const Index> ContactPoints<D>::own_particles(const SharedWork& work) const {
  const ItemRange part = work.rows(body_->division).listed(body_->size(), made_->particles).own();
  return std::span(made_->particles)
      .subspan(static_cast<std::size_t>(part.begin),
               static_cast<std::size_t>(part.end - part.begin));
}

template <int D>
Portions ContactPoints<D>::sent_rows(std::span<const Index> clusters, const SharedWork& work,
                                     const ContactPlaces<D>& places) const {
  return made_->patches
             ? work.rows(body_->division).listed(made_->patches->node_count(), places.wanted)
             : rows_of(clusters, work);
}

/// Number of lanes of a cluster, or of a node, that place() sends.
template <int D>
std::size_t ContactPoints<D>::values_sent(Placed what) const {
  if (made_->patches) return what == Placed::velocities ? 2 : 1;
  return what == Placed::weights && components_ == D ? 2 * D : D;
}

template <int D>
Gathered ContactPoints<D>::place(std::span<const Index> clusters, const SharedWork& work,
                                 Placed what, const Motion& motion,
                                 ContactPlaces<D>& places) const {
  const NodalVector *u = motion.u.data() + body_->first, *v = motion.v.data() + body_->first;
  if (made_->patches) want_nodes(clusters, places);
  const std::size_t values = values_sent(what);
  const Portions shares = sent_rows(clusters, work, places);
  const bool sends = shares.are_sent();
  if (sends) places.sent.resize((made_->patches ? places.wanted.size() : clusters.size()) * values);
  if (what == Placed::velocities) places.node_v.resize(places.nodes.size());
  parallel_for(
      shares.own(),
      [&](Index k) {
        Lanes* const sent =
            sends ? places.sent.data() + static_cast<std::size_t>(k) * values : nullptr;
        if (made_->patches) {
          const Index node = at(places.wanted, k);
          at(places.nodes, node) = made_->patches->place_of_node(node, u);
          if (sends) sent[0] = at(places.nodes, node);
          if (what != Placed::velocities) return;
          at(places.node_v, node) = made_->patches->value(node, v);
          if (sends) sent[1] = at(places.node_v, node);
          return;
        }
        const Index c = at(clusters, k);
        move(c, u, places);
        if (sends) std::copy_n(places.x_of(c), D, sent);
        if (what != Placed::weights || components_ == 1) return;
        update_weights(c, u, places);
        if (sends) std::copy_n(places.weight_of(c), D, sent + D);
      },
      16);
  return {places.sent.data(), shares, values};
}

template <int D>
void ContactPoints<D>::take_placed(std::span<const Index> clusters, const SharedWork& work,
                                   Placed what, ContactPlaces<D>& places) const {
  const std::size_t values = values_sent(what);
  const ItemRange own = sent_rows(clusters, work, places).own();
  const auto count = static_cast<Index>(made_->patches ? places.wanted.size() : clusters.size());
  for (Index k = 0; k < count; ++k) {
    if (k >= own.begin && k < own.end) continue;
    const Lanes* const sent = places.sent.data() + static_cast<std::size_t>(k) * values;
    if (made_->patches) {
      at(places.nodes, at(places.wanted, k)) = sent[0];
      if (what == Placed::velocities) at(places.node_v, at(places.wanted, k)) = sent[1];
      continue;
    }
    const Index c = at(clusters, k);
    std::copy_n(sent, D, &at(places.x, c * D));
    if (values == 2 * D) std::copy_n(sent + D, D, &at(places.weight, c * D));
  }
  if (!made_->patches) return;
  parallel_for(
      static_cast<Index>(clusters.size()),
      [&](Index k) {
        move_on_patches(at(clusters, k), places);
        if (what != Placed::positions) update_weights(at(clusters, k), nullptr, places);
      },
      16);
}

#define MENISCUS_INSTANTIATE(D)                                                                  \
  template void ContactPoints<D>::list_reads(StepReads&) const;                                  \
  template void ContactPoints<D>::list_reads(StepReads&, std::span<const Index>) const;          \
  template void ContactPoints<D>::list_sums(StepReads&) const;                                   \
  template void ContactPoints<D>::list_own_nodes(StepReads&) const;                              \
  template std::span<const Index> ContactPoints<D>::own_particles(const SharedWork&) const;      \
  template Gathered ContactPoints<D>::place(std::span<const Index>, const SharedWork&, Placed,   \
                                            const Motion&, ContactPlaces<D>&) const;             \
  template void ContactPoints<D>::take_placed(std::span<const Index>, const SharedWork&, Placed, \
                                              ContactPlaces<D>&) const;
MENISCUS_INSTANTIATE(2)
MENISCUS_INSTANTIATE(3)
#undef MENISCUS_INSTANTIATE

}  // namespace meniscus
