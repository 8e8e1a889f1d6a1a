// SPDX-License-Identifier: BSD-3-Clause
// Neighbour search by nanoflann, which no other file sees.
#include "kernel/neighbor_search.hpp"

#include "numbers/box.hpp"

#include <nanoflann.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>

namespace meniscus {
namespace {

// nanoflann 1.5 renamed the parameters and changed the type of a hit.
#if NANOFLANN_VERSION >= 0x150
using Hit = nanoflann::ResultItem<Index, Real>;
const nanoflann::SearchParameters unsorted(0, false);
#else
using Hit = std::pair<Index, Real>;
const nanoflann::SearchParams unsorted(32, 0, false);
#endif

template <int D>
struct Cloud {
  std::span<const Vec<D>> points;
  std::size_t kdtree_get_point_count() const { return points.size(); }
  Real kdtree_get_pt(std::size_t i, std::size_t d) const {
    return points[i][static_cast<Eigen::Index>(d)];
  }
  template <class Bounds>
  bool kdtree_get_bbox(Bounds&) const {
    return false;
  }
};

/// Consecutive points, numbered from `first` on, with their tree.
template <int D>
struct Part {
  using Metric = nanoflann::L2_Simple_Adaptor<Real, Cloud<D>>;
  using KdTree = nanoflann::KDTreeSingleIndexAdaptor<Metric, Cloud<D>, D, Index>;

  Index first = 0;
  Cloud<D> cloud;
  std::once_flag is_made;
  std::unique_ptr<KdTree> made;

  KdTree& tree() {
    std::call_once(is_made, [this] {
      made = std::make_unique<KdTree>(D, cloud, nanoflann::KDTreeSingleIndexAdaptorParams(24));
      made->buildIndex();
    });
    return *made;
  }
};

/// Tolerance: distances from boxes and from points are rounded differently.
constexpr Real box_rounding = 1e-14;

template <int D>
Real square_of_distance(const Box<D>& box, const Vec<D>& x) {
  return (x - x.cwiseMax(box.low).cwiseMin(box.high)).squaredNorm();
}

}  // namespace

/// The parts of a cloud. If there are several, also a tree of boxes around halves of the parts,
/// quarters, and so on.
template <int D>
requires SpaceDim<D>
class NeighborSearch<D>::Trees {
 public:
  Trees(std::span<const Vec<D>> points, Index per_part) {
    const auto n = static_cast<Index>(points.size());
    parts_ = std::vector<Part<D>>(static_cast<std::size_t>((n + per_part - 1) / per_part));
    for (Index p = 0; p < count(); ++p) {
      Part<D>& part = at(parts_, p);
      part.first = p * per_part;
      part.cloud.points =
          points.subspan(static_cast<std::size_t>(part.first),
                         static_cast<std::size_t>(std::min(per_part, n - part.first)));
    }
    boxes_.resize(static_cast<std::size_t>(2 * count() - 1));
    enclose(0, 0, count());
  }
  explicit Trees(std::vector<Vec<D>> points) : parts_(1), points_(std::move(points)) {
    parts_.front().cloud.points = points_;
    parts_.front().tree();
  }

  Index made() const {
    return static_cast<Index>(std::count_if(
        parts_.begin(), parts_.end(), [](const Part<D>& part) { return part.made != nullptr; }));
  }
  void rebuild(std::span<const Vec<D>> points) {
    points_.assign(points.begin(), points.end());
    parts_.front().cloud.points = points_;
    parts_.front().tree().buildIndex();
  }

  /// Calls f(part) for each part near x, nearer parts first. A part is near if is_near(d^2) is true
  /// for the distance d of x from its box.
  template <class Near, class F>
  void for_near(const Vec<D>& x, Near&& is_near, F&& f) {
    if (count() == 1) return f(parts_.front());
    visit(0, 0, count(), square_of_distance(boxes_.front(), x), x, is_near, f);
  }

 private:
  Index count() const { return static_cast<Index>(parts_.size()); }

  // Numbering of boxes: the box of parts [begin, end) comes before all boxes of its first half,
  // which come before all boxes of its second half.
  static Index middle(Index begin, Index end) { return begin + (end - begin) / 2; }
  static Index first_half(Index box) { return box + 1; }
  static Index second_half(Index box, Index begin, Index end) {
    return box + 2 * (middle(begin, end) - begin);
  }

  void enclose(Index box, Index begin, Index end) {
    if (end - begin == 1) {
      at(boxes_, box) = box_around<D>(at(parts_, begin).cloud.points);
      return;
    }
    const Index first = first_half(box), second = second_half(box, begin, end);
    enclose(first, begin, middle(begin, end));
    enclose(second, middle(begin, end), end);
    at(boxes_, box) = at(boxes_, first);
    at(boxes_, box).include(at(boxes_, second));
  }

  template <class Near, class F>
  void visit(Index box, Index begin, Index end, Real from_box, const Vec<D>& x, Near& is_near,
             F& f) {
    if (!is_near(from_box)) return;
    if (end - begin == 1) return f(at(parts_, begin));
    const Index first = first_half(box), second = second_half(box, begin, end),
                half = middle(begin, end);
    const Real from_first = square_of_distance(at(boxes_, first), x),
               from_second = square_of_distance(at(boxes_, second), x);
    const auto visit_first = [&] { visit(first, begin, half, from_first, x, is_near, f); };
    if (from_first <= from_second) visit_first();
    visit(second, half, end, from_second, x, is_near, f);
    if (from_first > from_second) visit_first();
  }

  std::vector<Part<D>> parts_;
  std::vector<Box<D>> boxes_;   // used if there are several parts
  std::vector<Vec<D>> points_;  // copy of the points; used if there is one part
};

template <int D>
requires SpaceDim<D> NeighborSearch<D>::NeighborSearch(std::unique_ptr<Trees> trees)
    : trees_(std::move(trees)) {}
template <int D>
requires SpaceDim<D> NeighborSearch<D>::NeighborSearch(std::span<const Vec<D>> points)
    : trees_(std::make_unique<Trees>(std::vector<Vec<D>>(points.begin(), points.end()))) {}
template <int D>
requires SpaceDim<D> NeighborSearch<D> NeighborSearch<D>::in_order(std::span<const Vec<D>> points,
                                                                   Index points_per_tree) {
  return NeighborSearch(std::make_unique<Trees>(points, points_per_tree));
}
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
  // nanoflann takes squared radii and leaves out points exactly on the sphere; a few units in the
  // last place more include points whose distance was rounded.
  const Real squared = radius * radius * (1 + 2e-15) + std::numeric_limits<Real>::min();
  thread_local std::vector<Hit> hits;
  trees_->for_near(
      x, [&](Real from_box) { return from_box <= squared * (1 + box_rounding); },
      [&](Part<D>& part) {
        part.tree().radiusSearch(x.data(), squared, hits, unsorted);
        for (const Hit& hit : hits) found.push_back(part.first + hit.first);
      });
}

template <int D>
requires SpaceDim<D> Real NeighborSearch<D>::distance_of_nearest(const Vec<D>& x, int k)
const {
  thread_local std::vector<Index> index;
  thread_local std::vector<Real> squared;
  index.resize(static_cast<std::size_t>(k));
  squared.resize(static_cast<std::size_t>(k));
  nanoflann::KNNResultSet<Real, Index> nearest(static_cast<std::size_t>(k));
  nearest.init(index.data(), squared.data());
  trees_->for_near(
      x, [&](Real from_box) { return from_box <= nearest.worstDist() * (1 + box_rounding); },
      [&](Part<D>& part) { part.tree().findNeighbors(nearest, x.data(), unsorted); });
  if (nearest.size() == 0) return unbounded;
  return std::sqrt(squared[nearest.size() - 1]);
}

template <int D>
requires SpaceDim<D>
void NeighborSearch<D>::rebuild(std::span<const Vec<D>> points) {
  trees_->rebuild(points);
}

template <int D>
requires SpaceDim<D> Index NeighborSearch<D>::trees()
const {
  return trees_->made();
}

template class NeighborSearch<2>;
template class NeighborSearch<3>;

}  // namespace meniscus
