// SPDX-License-Identifier: BSD-3-Clause
// Neighbour search by nanoflann, which no other file sees.
#include "meniscus/approx/neighbor_search.hpp"

#include <nanoflann.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace meniscus {

template <int D>
requires SpaceDim<D>
struct NeighborSearch<D>::Tree {
  struct Cloud {
    std::vector<Vec<D>> points;
    std::size_t kdtree_get_point_count() const { return points.size(); }
    Real kdtree_get_pt(std::size_t i, std::size_t d) const {
      return points[i][static_cast<Eigen::Index>(d)];
    }
    template <class Box>
    bool kdtree_get_bbox(Box&) const {
      return false;
    }
  };
  using Metric = nanoflann::L2_Simple_Adaptor<Real, Cloud>;
  using KdTree = nanoflann::KDTreeSingleIndexAdaptor<Metric, Cloud, D, Index>;

  Cloud cloud;
  KdTree index;

  explicit Tree(std::span<const Vec<D>> points)
      : cloud{{points.begin(), points.end()}},
        index(D, cloud, nanoflann::KDTreeSingleIndexAdaptorParams(24)) {
    index.buildIndex();
  }
};

template <int D>
requires SpaceDim<D> NeighborSearch<D>::NeighborSearch(std::span<const Vec<D>> points)
    : tree_(std::make_unique<Tree>(points)) {}
template <int D>
requires SpaceDim<D> NeighborSearch<D>::~NeighborSearch() = default;
template <int D>
requires SpaceDim<D> NeighborSearch<D>::NeighborSearch(NeighborSearch&&)
noexcept = default;
template <int D>
requires SpaceDim<D> NeighborSearch<D>
&NeighborSearch<D>::operator=(NeighborSearch&&) noexcept = default;

template <int D>
requires SpaceDim<D>
void NeighborSearch<D>::within(const Vec<D>& x, Real radius, std::vector<Index>& found) const {
  within_unsorted(x, radius, found);
  std::sort(found.begin(), found.end());
}

template <int D>
requires SpaceDim<D>
void NeighborSearch<D>::within_unsorted(const Vec<D>& x, Real radius,
                                        std::vector<Index>& found) const {
  found.clear();
  if (radius < 0) return;
  // nanoflann wants squared radii and leaves out points exactly on the sphere; a few units in the
  // last place more bring in those whose distance was rounded.
  const Real squared = radius * radius * (1 + 2e-15) + std::numeric_limits<Real>::min();
  // nanoflann 1.5 renamed the parameters and changed the type of a hit.
#if NANOFLANN_VERSION >= 0x150
  thread_local std::vector<nanoflann::ResultItem<Index, Real>> hits;
  tree_->index.radiusSearch(x.data(), squared, hits, nanoflann::SearchParameters(0, false));
#else
  thread_local std::vector<std::pair<Index, Real>> hits;
  tree_->index.radiusSearch(x.data(), squared, hits, nanoflann::SearchParams(32, 0, false));
#endif
  for (const auto& hit : hits) found.push_back(hit.first);
}

template <int D>
requires SpaceDim<D> Real NeighborSearch<D>::distance_of_nearest(const Vec<D>& x, int k)
const {
  thread_local std::vector<Index> index;
  thread_local std::vector<Real> squared;
  index.resize(static_cast<std::size_t>(k));
  squared.resize(static_cast<std::size_t>(k));
  const auto count =
      tree_->index.knnSearch(x.data(), static_cast<std::size_t>(k), index.data(), squared.data());
  return std::sqrt(squared[count - 1]);
}

template <int D>
requires SpaceDim<D>
void NeighborSearch<D>::rebuild(std::span<const Vec<D>> points) {
  tree_->cloud.points.assign(points.begin(), points.end());
  tree_->index.buildIndex();
}

template class NeighborSearch<2>;
template class NeighborSearch<3>;

}  // namespace meniscus
