// SPDX-License-Identifier: BSD-3-Clause
// Building a list of clusters, and the test whether it still holds.
#include "meniscus/physics/contact_list.hpp"

#include <algorithm>
#include <cmath>

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

/// Distance of the farthest of four points.
template <int D>
Real radius_of(const Lanes* x, const Vec<D>& centre) {
  Lanes square = Lanes::zero();
  for (int i = 0; i < D; ++i) square += (x[i] - centre[i]) * (x[i] - centre[i]);
  return std::sqrt(largest(square));
}

/// Whether a point of one cluster lies within `distance` of a point of the other.
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

/// Room for half as many more at least, so that a growing contact seldom takes memory.
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
  const Real distance = reach_ + skin_;
  centre_.resize(second.size() / D);
  Real radius = 0;  // of the largest cluster
  for (std::size_t c = 0; c < centre_.size(); ++c) {
    centre_[c] = centre_of<D>(&at(second, c * D));
    radius = std::max(radius, radius_of<D>(&at(second, c * D), centre_[c]));
  }
  if (search_)
    search_->rebuild(centre_);
  else
    search_ = std::make_unique<NeighborSearch<D>>(centre_);

  const Index clusters = clusters_of<D>(first);
  found_.resize(static_cast<std::size_t>(chunk_count(clusters)));
  for_chunks(clusters, [&](Index chunk, Index begin, Index end) {
    Found& found = at(found_, chunk);
    found.partner.clear();
    found.count.clear();
    for (Index c = begin; c < end; ++c) {
      const Lanes* x = &at(first, c * D);
      const Vec<D> centre = centre_of<D>(x);
      search_->within(centre, distance + radius + radius_of<D>(x, centre), found.candidates);
      const std::size_t before = found.partner.size();
      for (const Index other : found.candidates)
        if (near<D>(x, &at(second, other * D), distance)) found.partner.push_back(other);
      found.count.push_back(static_cast<Index>(found.partner.size() - before));
    }
  });
  first_.start.assign(1, 0);
  first_.partner.clear();
  // A contact that moves on over the surface needs in other chunks what it needs in these.
  std::size_t pairs = 0, most_pairs = 0, most_candidates = 0;
  for (const Found& found : found_) {
    pairs += found.partner.size();
    most_pairs = std::max(most_pairs, found.partner.size());
    most_candidates = std::max(most_candidates, found.candidates.capacity());
  }
  for (Found& found : found_) {
    make_room(found.partner, most_pairs);
    found.candidates.reserve(most_candidates);
  }
  make_room(first_.partner, pairs);
  make_room(second_.partner, pairs);
  for (const Found& found : found_) {
    first_.partner.insert(first_.partner.end(), found.partner.begin(), found.partner.end());
    for (const Index count : found.count) first_.start.push_back(first_.start.back() + count);
  }
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
