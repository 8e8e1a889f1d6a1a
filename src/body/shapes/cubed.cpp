// SPDX-License-Identifier: BSD-3-Clause
// Cubed disk and cubed sphere.
#include "body/shapes/cubed.hpp"

#include "body/shapes/cell_count.hpp"
#include "meniscus/error.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meniscus {

namespace {

template <int D>
Vec<D> direction(const Vec<D>& q) {
  Vec<D> t;
  for (int k = 0; k < D; ++k) t[k] = std::tan(q[k] * std::numbers::pi / 4);
  return t.normalized();
}

template <int D>
Vec<D> core_point(const CubedCore& shape, const Vec<D>& q) {
  const Real s = q.cwiseAbs().maxCoeff();
  if (s == 0) return q;
  return shape.a * ((1 - shape.w * s) * q + shape.b * shape.w * s * s * direction<D>(q / s));
}

/// Thickness of the first `shells` shells together, in units of the size of a core cell.
Real thickness(int shells, Real grading) {
  Real sum = 0, one = 1;
  for (int shell = 0; shell < shells; ++shell) sum += one *= grading;
  return sum;
}

/// Size and shape of the core. The core takes the share core / (core + 2 shells) of the diameter,
/// so that all cells have about equal size; the share is smaller if shells grow. It is at most 0.6,
/// because the corners of a larger core come too near to the surface. The numbers a, w, b were
/// found by a search in 2D: they give the largest ratio of the smallest scaled Jacobian (0.86) to
/// the edge ratio (1.93).
template <int D>
CubedCore core_shape(int core, Real shells) {
  const Real share = std::min(0.6, core / (core + 2.0 * shells));
  return D == 3 ? CubedCore{share, 0.7, 1.25} : CubedCore{0.95 * share, 0.4, 1.0};
}

/// Numbers the nodes: the lattice {0..n}^D first, then the surface of the lattice again for every
/// shell.
template <int D>
class NodeNumbers {
 public:
  using Lattice = std::array<int, D>;

  explicit NodeNumbers(int n) : n_(n) {
    Index count = 1;
    for (int k = 0; k < D; ++k) count *= n + 1;
    on_surface_.assign(static_cast<std::size_t>(count), -1);
    for (Index i = 0; i < count; ++i)
      if (is_surface(lattice(i))) {
        at(on_surface_, i) = static_cast<Index>(surface_.size());
        surface_.push_back(i);
      }
  }

  Index core_count() const { return static_cast<Index>(on_surface_.size()); }
  const std::vector<Index>& surface() const { return surface_; }
  /// Number of a lattice point of the surface among all lattice points of the surface.
  Index on_surface(const Lattice& p) const { return at(on_surface_, index(p)); }
  Lattice lattice(Index i) const {
    Lattice p;
    for (int k = D - 1; k >= 0; --k, i /= n_ + 1) at(p, k) = i % (n_ + 1);
    return p;
  }
  Index operator()(const Lattice& p, int shell) const {
    if (shell == 0) return index(p);
    return core_count() + (shell - 1) * static_cast<Index>(surface_.size()) + on_surface(p);
  }

 private:
  Index index(const Lattice& p) const {
    Index i = 0;
    for (const int c : p) i = i * (n_ + 1) + c;
    return i;
  }
  bool is_surface(const Lattice& p) const {
    return std::any_of(p.begin(), p.end(), [&](int c) { return c == 0 || c == n_; });
  }

  int n_;
  std::vector<Index> on_surface_, surface_;
};

template <int D>
void add_nodes(Grid<D>& grid, const NodeNumbers<D>& number, int core, int shells, Real grading) {
  const Real all = thickness(shells, grading);
  const CubedCore shape = core_shape<D>(core, all);
  const auto parameter = [&](Index i) {
    Vec<D> q;
    const auto p = number.lattice(i);
    for (int k = 0; k < D; ++k) q[k] = (2.0 * at(p, k) - core) / core;
    return q;
  };
  for (Index i = 0; i < number.core_count(); ++i)
    grid.X.push_back(core_point<D>(shape, parameter(i)));
  for (int shell = 1; shell <= shells; ++shell) {
    const Real part = thickness(shell, grading) / all;
    for (const Index i : number.surface()) {
      const Vec<D> inner = at(grid.X, i), outer = direction<D>(parameter(i));
      grid.X.push_back(shell == shells ? outer : inner + (outer - inner) * part);
    }
  }
}

template <int D>
void add_core_cells(Grid<D>& grid, const NodeNumbers<D>& number, int core) {
  for (Index i = 0; i < number.core_count(); ++i) {
    const auto low = number.lattice(i);
    if (std::any_of(low.begin(), low.end(), [&](int c) { return c == core; })) continue;
    typename Grid<D>::Cell cell;
    for (int a = 0; a < Grid<D>::corners; ++a) {
      auto p = low;
      for (int k = 0; k < D; ++k) at(p, k) += (a >> k) & 1;
      at(cell, a) = number(p, 0);
    }
    grid.cells.push_back(cell);
  }
}

/// Adds the cells outside one side of the core; number(lattice point, shell) gives their nodes.
/// Directions 0 .. D-2 run along the side so that the last direction, from shell to shell, points
/// outwards.
template <int D, class Number>
void add_shell_cells(Grid<D>& grid, const Number& number, int core, int shells, int side) {
  const int k = side / 2, upper = side % 2;
  // The local system (tangents, outward direction) is right-handed at an upper side with the
  // tangents e_(k+1), e_(k+2). At a lower side the first tangent is reversed. In 2D the tangents
  // have the opposite direction.
  const bool reverse = (upper == 0) == (D == 3 || k == 1);
  const Index columns = D == 3 ? core * core : core;
  for (Index column = 0; column < columns; ++column)
    for (int shell = 0; shell < shells; ++shell) {
      typename Grid<D>::Cell cell;
      for (int a = 0; a < Grid<D>::corners; ++a) {
        std::array<int, D> p;
        at(p, k) = upper ? core : 0;
        for (int t = 0, rest = column; t < D - 1; ++t, rest /= core) {
          const int end = (a >> t) & 1, step = rest % core;
          at(p, (k + 1 + t) % D) = t == 0 && reverse ? core - step - end : step + end;
        }
        at(cell, a) = number(p, shell + (a >> (D - 1)));
      }
      grid.cells.push_back(cell);
    }
}

}  // namespace

template <int D>
Grid<D> cubed_ball(int core, int shells, Real grading) {
  if (core < 1 || shells < 1)
    throw InputError("a ball, disk or cylinder needs at least one core cell and one shell");
  require_affordable<D>(std::pow(core, D) + 2.0 * D * shells * std::pow(core, D - 1));
  const NodeNumbers<D> number(core);
  Grid<D> grid;
  add_nodes(grid, number, core, shells, grading);
  add_core_cells(grid, number, core);
  for (int side = 0; side < 2 * D; ++side) add_shell_cells<D>(grid, number, core, shells, side);
  return grid;
}

Grid<3> cubed_shell(int n, int layers, Real inner_radius) {
  const NodeNumbers<3> lattice(n);
  Grid<3> grid;
  for (int layer = 0; layer <= layers; ++layer)
    for (const Index i : lattice.surface()) {
      Vec<3> q;
      const auto p = lattice.lattice(i);
      for (int k = 0; k < 3; ++k) q[k] = (2.0 * at(p, k) - n) / n;
      const Real radius = inner_radius + (1 - inner_radius) * layer / layers;
      grid.X.push_back(radius * direction<3>(q));
    }
  const auto per_layer = static_cast<Index>(lattice.surface().size());
  const auto number = [&](const NodeNumbers<3>::Lattice& p, int layer) {
    return layer * per_layer + lattice.on_surface(p);
  };
  for (int side = 0; side < 6; ++side) add_shell_cells<3>(grid, number, n, layers, side);
  return grid;
}

template Grid<2> cubed_ball<2>(int, int, Real);
template Grid<3> cubed_ball<3>(int, int, Real);

template <int D>
Grid<D> upper_half(const Grid<D>& whole, int axis) {
  Grid<D> half;
  std::vector<Index> number(whole.X.size(), -1);
  for (const auto& cell : whole.cells) {
    if (std::any_of(cell.begin(), cell.end(), [&](Index a) { return at(whole.X, a)[axis] < 0; }))
      continue;
    auto& own = half.cells.emplace_back(cell);
    for (Index& node : own) {
      Index& known = at(number, node);
      if (known < 0) {
        known = half.node_count();
        half.X.push_back(at(whole.X, node));
      }
      node = known;
    }
  }
  return half;
}
template Grid<2> upper_half(const Grid<2>&, int);
template Grid<3> upper_half(const Grid<3>&, int);

/// The directions of a cell are around and outwards, ordered so that they are right-handed.
Grid<2> unit_ring(int around, int layers, Real inside) {
  Grid<2> grid;
  for (int layer = 0; layer <= layers; ++layer)
    for (int k = 0; k < around; ++k) {
      const Real angle = 2 * std::numbers::pi * k / around,
                 r = inside + (1 - inside) * layer / layers;
      grid.X.emplace_back(r * std::cos(angle), r * std::sin(angle));
    }
  for (int layer = 0; layer < layers; ++layer)
    for (int k = 0; k < around; ++k) {
      const Index low = layer * around, next = (k + 1) % around;
      grid.cells.push_back({low + k, low + around + k, low + next, low + around + next});
    }
  return grid;
}

}  // namespace meniscus
