// SPDX-License-Identifier: BSD-3-Clause
// Builds a list of clusters, and checks whether it is still valid.
#include "physics/contact/pair/contact_list.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace meniscus {
namespace {

Real largest(Lanes a) {
  return std::max(std::max(a[0], a[1]), std::max(a[2], a[3]));
}

template <int D>
Index clusters_of(std::span<const Lanes> x) {
  return static_cast<Index>(x.size()) / D;
}

/// Largest distance that a point has moved.
template <int D>
Real largest_move(std::span<const Lanes> from, std::span<const Lanes> to) {
  PerChunk<Lanes> most(chunk_count(clusters_of<D>(to)), Lanes::zero());
  for_chunks(clusters_of<D>(to), [&](Index chunk, Index begin, Index end) {
    Lanes largest_square = Lanes::zero();
    for (Index c = begin; c < end; ++c) {
      Lanes square = Lanes::zero();
      for (int i = 0; i < D; ++i) {
        const Lanes step = at(to, c * D + i) - at(from, c * D + i);
        square += step * step;
      }
      largest_square = max(square, largest_square);
    }
    at(most, chunk) = largest_square;
  });
  Lanes all = Lanes::zero();
  for (const Lanes& m : most) all = max(m, all);
  return std::sqrt(largest(all));
}

template <int D>
Vec<D> centre_of(const Lanes* x) {
  Vec<D> centre;
  for (int i = 0; i < D; ++i) centre[i] = 0.25 * sum(x[i]);
  return centre;
}

/// Largest distance of four points from `centre`.
template <int D>
Real radius_of(const Lanes* x, const Vec<D>& centre) {
  Lanes square = Lanes::zero();
  for (int i = 0; i < D; ++i) square += (x[i] - centre[i]) * (x[i] - centre[i]);
  return std::sqrt(largest(square));
}

/// Bounding box of four points.
template <int D>
Box<D> box_of(const Lanes* x) {
  Box<D> box;
  for (int lane = 0; lane < Lanes::width; ++lane) {
    Vec<D> point;
    for (int i = 0; i < D; ++i) point[i] = x[i][lane];
    box.include(point);
  }
  return box;
}

/// True if a point of one cluster lies within `distance` of a point of the other.
template <int D>
bool near(const Lanes* x, const Lanes* y, Real distance) {
  for (int lane = 0; lane < Lanes::width; ++lane) {
    Lanes square = Lanes::zero();
    for (int i = 0; i < D; ++i) square += (x[i] - y[i][lane]) * (x[i] - y[i][lane]);
    for (int k = 0; k < Lanes::width; ++k)
      if (!(square[k] > distance * distance)) return true;
  }
  return false;
}

/// Reserves at least half as much again, so that a growing contact seldom allocates.
void make_room(std::vector<Index>& rows, std::size_t count) {
  if (2 * rows.capacity() < 3 * count) rows.reserve(2 * count);
}

void find_active(const std::vector<Offset>& start, std::vector<Index>& active) {
  active.clear();
  for (std::size_t c = 0; c + 1 < start.size(); ++c)
    if (start[c + 1] > start[c]) active.push_back(static_cast<Index>(c));
}

}  // namespace

template <int D>
bool ContactList<D>::update(std::span<const Lanes> first, std::span<const Lanes> second) {
  if (valid(first, second)) return false;
  build(first, second);
  return true;
}

template <int D>
bool ContactList<D>::valid(std::span<const Lanes> first, std::span<const Lanes> second) const {
  if (builds_ == 0) return false;
  return largest_move<D>(built_first_, first) + largest_move<D>(built_second_, second) <=
         skin_ * (1 - 1e-12);
}

template <int D>
void ContactList<D>::build(std::span<const Lanes> first, std::span<const Lanes> second) {
  first_.active.reserve(first.size() / D);
  second_.active.reserve(second.size() / D);
  built_first_.assign(first.begin(), first.end());
  built_second_.assign(second.begin(), second.end());
  find_partners(first, second);
  transpose(clusters_of<D>(second));
  find_active(first_.start, first_.active);
  find_active(second_.start, second_.active);
  ++builds_;
}

template <int D>
void ContactList<D>::find_partners(std::span<const Lanes> first, std::span<const Lanes> second) {
  const Index clusters = clusters_of<D>(first);
  Box<D> box;
  for (Index c = 0; c < clusters; ++c) box.include(box_of<D>(&at(first, c * D)));
  box.grow((reach_ + skin_) * (1 + 1e-12));
  // The first search contains all clusters. Later searches contain fewer and fit into its memory.
  if (!search_) box.grow(unbounded);
  const Real radius = find_met(box, second);
  first_.start.assign(static_cast<std::size_t>(clusters) + 1, 0);
  find_partners_of(clusters, radius, first, second);
  take_rows();
}

/// Finds the clusters of the second cloud that intersect `box`, and builds the neighbour search on
/// their centres. Returns the largest radius of the clusters found.
template <int D>
Real ContactList<D>::find_met(const Box<D>& box, std::span<const Lanes> second) {
  Real radius = 0;
  met_.clear();
  centre_.clear();
  for (Index c = 0; c < clusters_of<D>(second); ++c) {
    const Lanes* x = &at(second, c * D);
    if (!box.meets(box_of<D>(x))) continue;
    met_.push_back(c);
    centre_.push_back(centre_of<D>(x));
    radius = std::max(radius, radius_of<D>(x, centre_.back()));
  }
  if (search_)
    search_->rebuild(centre_);
  else
    search_ = std::make_unique<NeighborSearch<D>>(centre_);
  return radius;
}

/// Searches the clusters found by find_met(), chunk by chunk. first_.start[c + 1] becomes the
/// number of partners of cluster c.
template <int D>
void ContactList<D>::find_partners_of(Index clusters, Real radius, std::span<const Lanes> first,
                                      std::span<const Lanes> second) {
  const Real distance = reach_ + skin_;
  found_.resize(static_cast<std::size_t>(chunk_count(clusters)));
  for_chunks(clusters, [&](Index chunk, Index begin, Index end) {
    Found& found = at(found_, chunk);
    found.partner.clear();
    for (Index c = begin; c < end; ++c) {
      const Lanes* x = &at(first, c * D);
      const Vec<D> centre = centre_of<D>(x);
      search_->within(centre, distance + radius + radius_of<D>(x, centre), found.candidates);
      const std::size_t before = found.partner.size();
      for (const Index candidate : found.candidates)
        if (const Index other = at(met_, candidate); near<D>(x, &at(second, other * D), distance))
          found.partner.push_back(other);
      at(first_.start, c + 1) = static_cast<Offset>(found.partner.size() - before);
    }
  });
}

/// Takes the rows from the results of chunks and the numbers of partners.
template <int D>
void ContactList<D>::take_rows() {
  std::vector<Offset>& start = first_.start;
  std::partial_sum(start.begin(), start.end(), start.begin());
  // Other chunks get as much memory as the largest, for contacts that move along the surface.
  std::size_t most_partners = 0, most_candidates = 0;
  for (const Found& found : found_) {
    most_partners = std::max(most_partners, found.partner.size());
    most_candidates = std::max(most_candidates, found.candidates.capacity());
  }
  for (Found& found : found_) {
    make_room(found.partner, most_partners);
    found.candidates.reserve(most_candidates);
  }
  const auto pairs = static_cast<std::size_t>(start.back());
  make_room(first_.partner, pairs);
  make_room(second_.partner, pairs);
  first_.partner.resize(pairs);
  auto next = first_.partner.begin();
  for (const Found& found : found_)
    next = std::copy(found.partner.begin(), found.partner.end(), next);
}

/// The rows of the second cloud; partners ascend because the rows of the first are read in order.
template <int D>
void ContactList<D>::transpose(Index second_clusters) {
  second_.start.assign(static_cast<std::size_t>(second_clusters) + 1, 0);
  for (const Index c : first_.partner) ++at(second_.start, c + 1);
  for (Index c = 0; c < second_clusters; ++c) at(second_.start, c + 1) += at(second_.start, c);
  second_.partner.resize(first_.partner.size());
  for (Index c = 0; c + 1 < static_cast<Index>(first_.start.size()); ++c)
    for (const Index other : first_.of(c)) at(second_.partner, at(second_.start, other)++) = c;
  for (Index c = second_clusters; c > 0; --c) at(second_.start, c) = at(second_.start, c - 1);
  second_.start[0] = 0;
}

template <int D>
std::size_t ContactList<D>::bytes() const {
  std::size_t n = (built_first_.size() + built_second_.size()) * sizeof(Lanes);
  for (const Rows* rows : {&first_, &second_})
    n += rows->start.size() * sizeof(Offset) +
         (rows->partner.size() + rows->active.size()) * sizeof(Index);
  return n;
}

template class ContactList<2>;
template class ContactList<3>;

}  // namespace meniscus
