// SPDX-License-Identifier: BSD-3-Clause
// Finds edges that pierce simplices, by a tree of bounding boxes.
#include "body/surface/crossings.hpp"

#include "numbers/dense.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <cmath>

namespace meniscus {

/// A simplex and the normal of its plane.
template <int D>
struct CrossingSearch<D>::Plane {
  std::array<Vec<D>, D> corner;
  Vec<D> normal;  // unit vector
  Real size;      // length; triangle: leg of a right isosceles one of its area

  Plane() = default;
  explicit Plane(const std::array<Vec<D>, D>& corners) : corner(corners) {
    if constexpr (D == 3) {
      normal = cross(Vec<3>(corner[1] - corner[0]), Vec<3>(corner[2] - corner[0]));
      size = std::sqrt(normal.norm());
      normal /= size * size;
    } else {
      const Vec<2> along = corner[1] - corner[0];
      normal = {along.y(), -along.x()};
      size = along.norm();
      normal /= size;
    }
  }
  /// Distance of a point of the plane from the boundary of the simplex; zero or negative outside.
  Real from_rim(const Vec<D>& x) const {
    if constexpr (D == 2) {
      const Real t = (corner[1] - corner[0]).dot(x - corner[0]) / size;
      return std::min(t, size - t);
    } else {
      Real least = unbounded;
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec<3> along = corner[(k + 1) % 3] - corner[k], way = x - corner[k];
        least = std::min(least, normal.dot(cross(along, way)) / along.norm());
      }
      return least;
    }
  }
};

template <int D>
struct CrossingSearch<D>::Places {
  const std::vector<Vec<D>>& x;
  std::vector<Box<D>> simplex, node;  // boxes around simplices and nodes
  std::vector<Plane> plane;           // [simplex]

  std::array<Vec<D>, D> corners(const Simplex& of) const {
    std::array<Vec<D>, D> corner;
    for (std::size_t k = 0; k < D; ++k) corner[k] = at(x, of[k]);
    return corner;
  }
};

template <int D>
CrossingSearch<D>::CrossingSearch(std::vector<Simplex> simplices, const std::vector<Index>& group,
                                  const std::vector<Vec<D>>& X)
    : simplices_(std::move(simplices)) {
  std::vector<Item> items;
  for (std::size_t k = 0; k < simplices_.size(); ++k) {
    items.push_back({simplices_[k], group[k], Vec<D>::Zero()});
    for (const Index corner : simplices_[k]) items.back().centre += at(X, corner) / D;
  }
  if constexpr (D == 2) {
    beside_.assign(X.size(), {-1, -1});
    for (const Simplex& segment : simplices_) {
      at(beside_, segment[0])[1] = segment[1];
      at(beside_, segment[1])[0] = segment[0];
    }
  }
  if (!items.empty()) divide(items, 0, static_cast<Index>(items.size()));
  for (std::size_t k = 0; k < items.size(); ++k) simplices_[k] = items[k].simplex;
}

/// Divides the simplices into a tree of boxes. Different surfaces are separated first, since they
/// may move apart; each surface is then halved along its longest side.
template <int D>
void CrossingSearch<D>::divide(std::vector<Item>& items, Index begin, Index end) {
  constexpr Index few = 4;
  const auto number = static_cast<Index>(nodes_.size());
  nodes_.push_back({begin, end});
  const auto first = items.begin() + begin, last = items.begin() + end;
  auto middle = first;
  if (first->group != (last - 1)->group) {
    middle = std::find_if(first, last, [&](const Item& i) { return i.group != first->group; });
  } else if (end - begin > few) {
    Box<D> box;
    for (auto i = first; i != last; ++i) box.include(i->centre);
    Eigen::Index longest = 0;
    box.extent().maxCoeff(&longest);
    middle = first + (end - begin) / 2;
    std::nth_element(first, middle, last, [&](const Item& a, const Item& b) {
      const Real x = a.centre[longest], y = b.centre[longest];
      return x < y || (x == y && a.simplex < b.simplex);
    });
  } else {
    leaves_.push_back(number);
    return;
  }
  const auto cut = static_cast<Index>(middle - items.begin());
  divide(items, begin, cut);
  at(nodes_, number).right = static_cast<Index>(nodes_.size());
  divide(items, cut, end);
}

template <int D>
std::optional<Crossing<D>> CrossingSearch<D>::deepest(const std::vector<Vec<D>>& x) const {
  Places places{x, std::vector<Box<D>>(simplices_.size()), std::vector<Box<D>>(nodes_.size()),
                std::vector<Plane>(simplices_.size())};
  parallel_for(static_cast<Index>(simplices_.size()), [&](Index k) {
    const auto corners = places.corners(at(simplices_, k));
    at(places.simplex, k) = box_around<D>(corners);
    at(places.plane, k) = Plane(corners);
  });
  for (auto n = static_cast<Index>(nodes_.size()) - 1; n >= 0; --n) {
    const Node& node = at(nodes_, n);
    Box<D>& box = at(places.node, n);
    if (node.right >= 0) {
      box.include(at(places.node, n + 1));
      box.include(at(places.node, node.right));
    } else {
      for (Index k = node.begin; k < node.end; ++k) box.include(at(places.simplex, k));
    }
  }
  std::vector<Crossing<D>> found(leaves_.size());
  parallel_for(
      static_cast<Index>(leaves_.size()),
      [&](Index l) { find_in(at(nodes_, at(leaves_, l)), places, at(found, l)); }, 16);
  Crossing<D> deepest;
  for (const Crossing<D>& crossing : found)
    if (crossing.share > deepest.share) deepest = crossing;
  return deepest.share > bearable ? std::optional(deepest) : std::nullopt;
}

/// Finds the edge of simplex `first` that pierces simplex `second` most deeply, and stores it if it
/// is deeper than `deepest`. Depth is the least distance of the ends from the plane and of the
/// intersection from the boundary. In 2D curves may cross near their corners: an end that lies
/// almost on the line of `second` counts with the distance of the next point of the curve on the
/// same side.
template <int D>
void CrossingSearch<D>::pierce(Index first, Index second, const Places& places,
                               Crossing<D>& deepest) const {
  const Plane& plane = at(places.plane, second);
  const Simplex &corners = at(simplices_, first), &other = at(simplices_, second);
  const auto is_common = [&](Index place) {
    return std::find(other.begin(), other.end(), place) != other.end();
  };
  const auto height = [&](Index place) {
    return plane.normal.dot(at(places.x, place) - plane.corner[0]);
  };
  const auto reach = [&](Index place, Real h) {
    if constexpr (D == 2)
      for (const Index next : at(beside_, place))
        if (next >= 0 && height(next) * h > 0) h = std::max(std::abs(h), std::abs(height(next)));
    return std::abs(h);
  };
  constexpr std::size_t edges = D == 3 ? 3 : 1;
  for (std::size_t k = 0; k < edges; ++k) {
    const Index a = corners[k], b = corners[(k + 1) % D];
    if (is_common(a) || is_common(b)) continue;
    const Real above = height(a), below = height(b);
    if (!(above < 0 && below > 0) && !(above > 0 && below < 0)) continue;
    const Vec<D>&p = at(places.x, a), &q = at(places.x, b);
    const Vec<D> place = p + above / (above - below) * (q - p);
    const Real depth = std::min({reach(a, above), reach(b, below), plane.from_rim(place)});
    const Real share = depth / std::max((q - p).norm(), plane.size);
    if (share > deepest.share) deepest = {first, second, place, depth, share};
  }
}

/// Searches crossings of the simplices of a leaf with each other and with the simplices of later
/// leaves.
template <int D>
void CrossingSearch<D>::find_in(const Node& leaf, const Places& places,
                                Crossing<D>& deepest) const {
  const Box<D>& near = at(places.node, static_cast<Index>(&leaf - nodes_.data()));
  thread_local std::vector<Index> candidates, open;
  candidates.clear();
  open.assign(1, 0);
  while (!open.empty()) {
    const Index n = open.back();
    open.pop_back();
    const Node& node = at(nodes_, n);
    if (node.end <= leaf.begin || !near.meets(at(places.node, n))) continue;
    if (node.right < 0) {
      for (Index k = node.begin; k < node.end; ++k) candidates.push_back(k);
    } else {
      open.push_back(node.right);
      open.push_back(n + 1);
    }
  }
  for (Index first = leaf.begin; first < leaf.end; ++first)
    for (const Index second : candidates) {
      if (second <= first || !at(places.simplex, first).meets(at(places.simplex, second))) continue;
      int common = 0;
      for (const Index a : at(simplices_, first))
        for (const Index b : at(simplices_, second)) common += a == b;
      if (common >= D - 1) continue;  // neighbours: every edge of one meets the other
      pierce(first, second, places, deepest);
      pierce(second, first, places, deepest);
    }
}

template <int D>
std::size_t CrossingSearch<D>::bytes() const {
  return simplices_.size() * sizeof(Simplex) + nodes_.size() * sizeof(Node) +
         (leaves_.size() + 2 * beside_.size()) * sizeof(Index);
}

template class CrossingSearch<2>;
template class CrossingSearch<3>;

}  // namespace meniscus
