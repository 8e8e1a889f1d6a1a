// SPDX-License-Identifier: BSD-3-Clause
// Quadrature points of the parts of cells at their corners, and of the facets of these parts. The
// parts are the octants (2D: quadrants) of hexahedra, or the quarters (thirds) of simplices. Points
// are tabulated once in reference coordinates, with the functions of the map.
#pragma once
#include "body/grid/gauss.hpp"
#include "body/grid/simplex.hpp"
#include "numbers/dense.hpp"
#include "numbers/simd.hpp"
#include "numbers/unroll.hpp"

#include <cmath>
#include <tuple>
#include <utility>

namespace meniscus {

/// Points per direction: X X^T det J has degree 4, and 2 D + 3 where the cell is curved. With the
/// circle of a body of revolution, which bit D of `curved` says, the degrees are 5 and 2 D + 5.
template <int D>
int points_along(int k, unsigned curved) {
  return (curved >> k) & 1 ? D + 2 + static_cast<int>((curved >> D) & 1) : 3;
}

/// Multilinear shape functions of the corners at one reference point.
template <int D>
struct TabulatedPoint {
  Eigen::Matrix<Real, 1 << D, 1> N;
  Eigen::Matrix<Real, 1 << D, D> dN;
  BulgeFunctions<D> bulge;
  Real w;
};

template <int D>
TabulatedPoint<D> tabulate(const Vec<D>& xi, Real w) {
  TabulatedPoint<D> point{{}, {}, BulgeFunctions<D>(xi), w};
  const auto slopes = corner_slopes<D>(xi);
  for (int a = 0; a < (1 << D); ++a) {
    point.N[a] = 1;
    for (int k = 0; k < D; ++k) point.N[a] *= 0.5 * (1 + corner_sign(a, k) * xi[k]);
    point.dN.row(a) = at(slopes, a);
  }
  return point;
}

/// Four tabulated points, one per lane.
template <int D>
struct FourTabulatedPoints {
  struct Function {
    Lanes N;
    std::array<Lanes, D> dN;
  };
  std::array<Function, 1 << D> corner;
  std::array<Function, Bulge<D>::mode_count> bulge;
  Lanes w;
  int count;  ///< number of points; further lanes repeat the last one with w = 0
};

/// The points in groups of four.
template <int D>
std::vector<FourTabulatedPoints<D>> in_fours(const std::vector<TabulatedPoint<D>>& points) {
  const auto n = static_cast<int>(points.size());
  std::vector<FourTabulatedPoints<D>> fours;
  for (int begin = 0; begin < n; begin += Lanes::width) {
    auto& four = fours.emplace_back();
    four.count = std::min(n - begin, Lanes::width);
    for (int lane = 0; lane < Lanes::width; ++lane) {
      const TabulatedPoint<D>& p = at(points, begin + std::min(lane, four.count - 1));
      const auto set = [lane](auto& functions, const auto& N, const auto& dN) {
        for (std::size_t a = 0; a < functions.size(); ++a) {
          functions[a].N.set(lane, N[static_cast<int>(a)]);
          for (int k = 0; k < D; ++k) at(functions[a].dN, k).set(lane, dN(static_cast<int>(a), k));
        }
      };
      set(four.corner, p.N, p.dN);
      set(four.bulge, p.bulge.N, p.bulge.dN);
      four.w.set(lane, lane < four.count ? p.w : 0);
    }
  }
  return fours;
}

template <int D>
class OctantTable {
 public:
  using Points = std::vector<FourTabulatedPoints<D>>;

  /// The table of cells that are curved in the directions k for which bit k of `curved` is set. In
  /// 2D, bit D is set for bodies of revolution.
  static const OctantTable& instance(unsigned curved) {
    static constexpr auto tables = []<unsigned... c>(std::integer_sequence<unsigned, c...>) {
      return std::array{&made<c>...};
    }
    (std::make_integer_sequence<unsigned, 1u << (D == 2 ? D + 1 : D)>());
    return at(tables, curved)();
  }
  const Points& volume(int corner) const { return at(volume_, corner); }
  /// The facet xi_k = 0 of the octant; the same object for the two octants that share it.
  const Points& inner(int corner, int k) const { return at(inner_, (corner & ~(1 << k)) * D + k); }
  /// The facet xi_k = +-1 of the octant.
  const Points& outer(int corner, int k) const { return at(outer_, corner * D + k); }

 private:
  /// The table, made at the first call: usually only one kind of table is used.
  template <unsigned curved>
  static const OctantTable& made() {
    static const OctantTable table(curved);
    return table;
  }
  explicit OctantTable(unsigned curved) {
    std::array<int, D> count;
    for (int k = 0; k < D; ++k) at(count, k) = points_along<D>(k, curved);
    const TensorRule<D> cube = tensor_rule<D>(count);
    for (int corner = 0; corner < (1 << D); ++corner) {
      std::vector<TabulatedPoint<D>> octant;
      for (std::size_t q = 0; q < cube.x.size(); ++q) {
        Vec<D> xi;
        for (int k = 0; k < D; ++k) xi[k] = 0.5 * (corner_sign(corner, k) + cube.x[q][k]);
        octant.push_back(tabulate<D>(xi, cube.w[q] / (1 << D)));
      }
      volume_.push_back(in_fours<D>(octant));
      for (int k = 0; k < D; ++k) {
        inner_.push_back(facet(corner, k, 0, curved));
        outer_.push_back(facet(corner, k, corner_sign(corner, k), curved));
      }
    }
  }

  static Points facet(int corner, int k, Real level, unsigned curved) {
    std::array<int, D - 1> count;
    for (int l = 0, d = 0; l < D; ++l)
      if (l != k) at(count, d++) = points_along<D>(l, curved);
    const TensorRule<D - 1> square = tensor_rule<D - 1>(count);
    std::vector<TabulatedPoint<D>> points;
    for (std::size_t q = 0; q < square.x.size(); ++q) {
      Vec<D> xi;
      for (int l = 0, d = 0; l < D; ++l)
        xi[l] = l == k ? level : 0.5 * (corner_sign(corner, l) + square.x[q][d++]);
      points.push_back(tabulate<D>(xi, square.w[q] / (1 << (D - 1))));
    }
    return in_fours<D>(points);
  }

  std::vector<Points> volume_, inner_, outer_;
};

/// The point at xi in the part of a simplex at its corner i.
template <int D>
TabulatedPoint<D> tabulate_part(int i, const Vec<D>& xi, Real w) {
  const Shares<D> shares = part_shares<D>(i, xi);
  TabulatedPoint<D> point{{}, {}, edge_functions<D>(shares), w};
  point.N.setZero();
  point.dN.setZero();
  for (int j = 0; j <= D; ++j) {
    point.N[at(simplex_corners<D>(), j)] = shares.value[j];
    point.dN.row(at(simplex_corners<D>(), j)) = shares.slope.row(j);
  }
  return point;
}

/// The points of the parts of a simplex at its corners.
template <int D>
class SimplexTable {
 public:
  using Points = std::vector<FourTabulatedPoints<D>>;
  /// Points of a facet of a part, across its direction k.
  struct Side {
    Points points;
    int k = 0;
  };

  static const SimplexTable& instance(bool curved, bool revolved) {
    if (!curved) return made<3>();
    if constexpr (D == 2)
      if (revolved) return made<D + 3>();
    return made<D + 2>();
  }
  const Points& volume(int i) const { return at(volume_, i); }
  /// The facet between the parts at corners i and j, as a facet of the part at the lower corner.
  const Side& between(int i, int j) const {
    return at(end_, std::min(i, j) * (D + 1) + std::max(i, j));
  }
  /// The facet of the part at corner i on the side of the simplex opposite to corner o.
  const Side& on_side(int i, int o) const { return at(begin_, i * (D + 1) + o); }

 private:
  template <int points>
  static const SimplexTable& made() {
    static const SimplexTable table(points);
    return table;
  }
  explicit SimplexTable(int points) : begin_((D + 1) * (D + 1)), end_((D + 1) * (D + 1)) {
    const TensorRule<D> cube = tensor_rule<D>(points);
    const TensorRule<D - 1> square = tensor_rule<D - 1>(points);
    for (int i = 0; i <= D; ++i) {
      std::vector<TabulatedPoint<D>> part;
      for (std::size_t q = 0; q < cube.x.size(); ++q)
        part.push_back(tabulate_part<D>(i, cube.x[q], cube.w[q]));
      volume_.push_back(in_fours<D>(part));
      for (int k = 0; k < D; ++k) {
        const int other = at(directions_at<D>(i), k);
        for (const bool end : {false, true}) {
          Side& side = at(end ? end_ : begin_, i * (D + 1) + other);
          side.k = k;
          std::vector<TabulatedPoint<D>> of_side;
          for (std::size_t q = 0; q < square.x.size(); ++q) {
            Vec<D> xi;
            for (int l = 0, d = 0; l < D; ++l) xi[l] = l == k ? (end ? 1 : -1) : square.x[q][d++];
            of_side.push_back(tabulate_part<D>(i, xi, square.w[q]));
          }
          side.points = in_fours<D>(of_side);
        }
      }
    }
  }

  std::vector<Points> volume_;
  std::vector<Side> begin_, end_;
};

/// A smaller quadrature of the parts (samples). Points are shared by parts, or each part has its
/// own.
///
/// Shared points of volumes: three Gauss points per direction. Where a cell continues the nodal
/// cell beyond the particle, the part has one of its own and the one at the particle, which is
/// shared. Where the body ends at the particle, the part has all three. Hexahedra that are
/// continued in all directions have the 14 points of Irons (1971), which are exact up to degree 5,
/// too. Shared points of facets: two Gauss points per direction in 3D, three in 2D. Where the body
/// ends at the particle, the part has three of its own. Own points: in 3D the corners and the
/// middle of the part, exact up to degree 3. The corners coincide with corners of other parts,
/// cells and facets. In 2D two Gauss points per direction.
template <int D>
class SampleTable {
 public:
  /// The place of a point in each direction: 0 at the particle, otherwise a number for its
  /// distance.
  using Places = std::array<int, D>;
  static constexpr int end = 4, on_axis = 5, distances = 6;
  /// The kind of parts with points of their own.
  static constexpr unsigned apart = 1 << D;
  struct Point {
    TabulatedPoint<D> at;
    Places places;
  };
  using Points = std::vector<Point>;
  struct Facet {
    Points points;
    Real sign = 1;  ///< sign of the outward normal relative to column k of cof J
  };

  static const SampleTable& of(bool simplex) { return simplex ? made<true>() : made<false>(); }
  /// Points of the volume of a part. Bit k of `kind` is set if the nodal cell ends at the particle
  /// in direction k, on the boundary of the body.
  const Points& volume(int corner, unsigned kind) const {
    return meniscus::at(volume_, number(corner, kind));
  }
  /// The facet at the end of direction k, between the particle and the next one.
  const Facet& facet(int corner, int k, unsigned kind) const {
    return meniscus::at(facet_, number(corner, kind) * D + k);
  }
  /// The facet at the beginning of direction k, on the boundary of the body at the particle.
  const Facet& outer_facet(int corner, int k, unsigned kind) const {
    return meniscus::at(outer_facet_, number(corner, kind) * D + k);
  }

 private:
  template <bool simplex>
  static const SampleTable& made() {
    static const SampleTable table(simplex);
    return table;
  }
  explicit SampleTable(bool simplex) {
    const int corners = simplex ? D + 1 : 1 << D;
    for (int corner = 0; corner < corners; ++corner)
      for (unsigned kind = 0; kind <= apart; ++kind) {
        volume_.push_back(points(simplex, corner, kind, {}));
        for (int k = 0; k < D; ++k) {
          const Real sign = simplex ? 1 : -corner_sign(corner, k);
          facet_.push_back({points(simplex, corner, kind, {k, {end, 1, 1}}), sign});
          outer_facet_.push_back({points(simplex, corner, kind, {k, {0, -1, 1}}), -sign});
        }
      }
  }
  static int number(int corner, unsigned kind) {
    return corner * static_cast<int>(apart + 1) + static_cast<int>(kind);
  }

  struct Abscissa {
    int place;
    Real t;  ///< -1 at the particle, 1 at the end
    Real w;
  };
  struct Product {
    Vec<D> t;
    Real w;
    Places places;
  };

  /// For a facet: the direction across it and its position. For a volume: no direction.
  struct Across {
    int direction = -1;
    Abscissa where{};
  };

  static std::vector<Product> tensor_points(unsigned kind, const Across& across) {
    const Real three = std::sqrt(0.6), two = std::sqrt(1. / 3);
    const std::vector<Abscissa> all_of_three{
        {1, -three, 5. / 9}, {2, 0, 8. / 9}, {3, three, 5. / 9}},
        half_of_three{{0, -1, 8. / 9}, {1, 2 * three - 1, 10. / 9}},
        own_two{{1, -two, 1}, {2, two, 1}}, half_of_two{{1, 2 * two - 1, 2}}, one{across.where};
    const auto along = [&](int k) -> const std::vector<Abscissa>& {
      if (k == across.direction) return one;
      if (kind == apart) return own_two;
      if ((kind >> k) & 1) return all_of_three;
      return D == 3 && across.direction >= 0 ? half_of_two : half_of_three;
    };
    std::vector<Product> products{{Vec<D>::Zero(), 1, {}}};
    for (int k = 0; k < D; ++k) {
      std::vector<Product> longer;
      for (const Abscissa& a : along(k))
        for (Product p : products) {
          p.t[k] = a.t;
          p.w *= a.w;
          meniscus::at(p.places, k) = a.place;
          longer.push_back(p);
        }
      products = longer;
    }
    return products;
  }

  /// The corners, which have a third of the weight, and the middle.
  static std::vector<Product> corners_and_middle(const Across& across) {
    std::vector<Product> products;
    const auto add = [&](const auto& abscissa, Real w) {
      Product p{Vec<D>::Zero(), w, {}};
      for (int k = 0; k < D; ++k)
        std::tie(p.t[k], meniscus::at(p.places, k)) =
            k == across.direction ? std::pair(across.where.t, across.where.place) : abscissa(k);
      products.push_back(p);
    };
    const bool volume = across.direction < 0;
    for (int c = 0; c < (1 << D); ++c)
      if (volume || ((c >> across.direction) & 1) == 0)
        add([c](int k) { return (c >> k) & 1 ? std::pair(1., end) : std::pair(-1., 0); }, 1. / 3);
    add([](int) { return std::pair(0., 2); }, 2. / 3 * static_cast<Real>(products.size()));
    return products;
  }

  /// The points in one octant: one towards the corner, and one on each axis, shared by four
  /// octants.
  static std::vector<Product> irons_points() {
    const Real corner = std::sqrt(19. / 33), axis = std::sqrt(19. / 30);
    Product towards_corner{Vec<D>::Constant(2 * corner - 1), 8 * 121. / 361, {}};
    towards_corner.places.fill(1);
    std::vector<Product> products{towards_corner};
    for (int k = 0; k < D; ++k) {
      Product p{Vec<D>::Constant(-1), 8 * 80. / 361, {}};
      p.t[k] = 2 * axis - 1;
      meniscus::at(p.places, k) = on_axis;
      products.push_back(p);
    }
    return products;
  }

  static Points points(bool simplex, int corner, unsigned kind, const Across& across) {
    const bool volume = across.direction < 0, irons = D == 3 && !simplex && kind == 0 && volume;
    const std::vector<Product> products = irons                     ? irons_points()
                                          : D == 3 && kind == apart ? corners_and_middle(across)
                                                                    : tensor_points(kind, across);
    Points points;
    for (const Product& p : products) {
      if (simplex) {
        points.push_back({tabulate_part<D>(corner, p.t, p.w), p.places});
      } else {
        Vec<D> xi;
        for (int k = 0; k < D; ++k) xi[k] = 0.5 * corner_sign(corner, k) * (1 - p.t[k]);
        points.push_back({tabulate<D>(xi, p.w / (1 << (volume ? D : D - 1))), p.places});
      }
    }
    return points;
  }

  std::vector<Points> volume_;
  std::vector<Facet> facet_, outer_facet_;
};

/// The map of a cell at four points, one per lane.
template <int D>
struct FourCellPoints {
  std::array<Lanes, D> X;
  std::array<std::array<Lanes, D>, D> J;  ///< [i][k]

  /// Column k of cof J, see facet_normal() below.
  std::array<Lanes, D> facet_normal(int k) const {
    if constexpr (D == 2) {
      if (k == 0) return {J[1][1], -J[0][1]};
      return {-J[1][0], J[0][0]};
    } else {
      const int a = (k + 1) % 3, b = (k + 2) % 3;
      const auto component = [&](std::size_t i, std::size_t j) {
        // A statement of its own makes g++ round this product (and not the other one), as for a
        // single point.
        const Lanes product = at(J[i], a) * at(J[j], b);
        return product - at(J[j], a) * at(J[i], b);
      };
      return {component(1, 2), component(2, 0), component(0, 1)};
    }
  }
};

/// The map of one cell at tabulated points.
template <int D>
class CellMap {
 public:
  CellMap(const Grid<D>& grid, Index cell)
      : bulge_(grid.bulge(cell)),
        simplex_(is_simplex<D>(at(grid.cells, cell))),
        revolved_(grid.revolved) {
    for (int a = 0; a < corners; ++a)
      at(corner_, a) = lanes_of(at(grid.X, at(at(grid.cells, cell), a)));
    if (!bulge_) return;
    for (int m = 0; m < Bulge<D>::mode_count; ++m) {
      if (bulge_->deviation.col(m).isZero(0)) continue;
      at(mode_, modes_) = m;
      at(deviation_, modes_++) = lanes_of(bulge_->deviation.col(m));
    }
  }
  const OctantTable<D>& table() const {
    const unsigned revolved = revolved_ ? 1u << D : 0;
    return OctantTable<D>::instance((bulge_ ? bulge_->curved : 0) | revolved);
  }
  /// The table of a simplex; null for other cells.
  const SimplexTable<D>* simplex() const {
    return simplex_ ? &SimplexTable<D>::instance(bulge_ != nullptr, revolved_) : nullptr;
  }
  CellPoint<D, D> operator()(const TabulatedPoint<D>& p) const {
    Lanes X = Lanes::zero();
    std::array<Lanes, D> J;
    J.fill(Lanes::zero());
    const auto add = [&](const Lanes& x, Real N, const auto& dN) {
      X += N * x;
      for (int k = 0; k < D; ++k) at(J, k) += dN[k] * x;
    };
    for (int a = 0; a < corners; ++a) add(at(corner_, a), p.N[a], p.dN.row(a));
    for (int m = 0; m < modes_; ++m) {
      const int mode = at(mode_, m);
      add(at(deviation_, m), p.bulge.N[mode], p.bulge.dN.row(mode));
    }
    CellPoint<D, D> point;
    for (int i = 0; i < D; ++i) {
      point.X[i] = X[i];
      for (int k = 0; k < D; ++k) point.J(i, k) = at(J, k)[i];
    }
    return point;
  }
  FourCellPoints<D> operator()(const FourTabulatedPoints<D>& p) const {
    FourCellPoints<D> four;
    for (int i = 0; i < D; ++i) set_component(p, i, four);
    return four;
  }

 private:
  static constexpr int corners = 1 << D;
  // noinline: g++ 12 would copy all functions to the stack, to reuse them for the next component.
  [[gnu::noinline]] void set_component(const FourTabulatedPoints<D>& p, int i,
                                       FourCellPoints<D>& four) const {
    Lanes X = Lanes::zero();
    std::array<Lanes, D> J;
    J.fill(Lanes::zero());
    const auto add = [&](Real x, const auto& function) {
      X += function.N * x;
      for (int k = 0; k < D; ++k) at(J, k) += at(function.dN, k) * x;
    };
    for (int a = 0; a < corners; ++a) add(at(corner_, a)[i], at(p.corner, a));
    for (int m = 0; m < modes_; ++m) add(at(deviation_, m)[i], at(p.bulge, at(mode_, m)));
    at(four.X, i) = X;
    unroll<D>([&](auto k) { at(four.J, i)[k] = J[k]; });
  }
  static Lanes lanes_of(const Vec<D>& x) { return {x[0], x[1], D == 3 ? x[D - 1] : 0.0, 0.0}; }

  std::array<Lanes, corners> corner_;
  const Bulge<D>* bulge_;
  std::array<Lanes, Bulge<D>::mode_count> deviation_;  // deviations of the modes that are not zero
  std::array<int, Bulge<D>::mode_count> mode_;
  int modes_ = 0;
  bool simplex_, revolved_;
};

/// Column k of cof J: a normal of the surface xi_k = const, whose length is the area ratio.
template <int D>
Vec<D> facet_normal(const Mat<D>& J, int k) {
  if constexpr (D == 3)
    return cross(J.col((k + 1) % 3), J.col((k + 2) % 3));
  else
    return k == 0 ? Vec<2>(J(1, 1), -J(0, 1)) : Vec<2>(-J(1, 0), J(0, 0));
}

}  // namespace meniscus
