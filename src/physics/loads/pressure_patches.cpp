// SPDX-License-Identifier: BSD-3-Clause
// Pieces of a face as quadratic patches, its rim, and the forces of a pressure on them.
#include "physics/loads/pressure_patches.hpp"

#include "body/grid/gauss.hpp"
#include "body/surface/surface_points.hpp"
#include "numbers/dense.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meniscus {
namespace {

template <int D>
Vec<D> area_normal(const CellPoint<D, D - 1>& place) {
  if constexpr (D == 3)
    return cross(place.J.col(0), place.J.col(1));
  else
    return {place.J(1, 0), -place.J(0, 0)};
}

/// Patch functions at three Gauss points per direction, on a facet (`quarter` negative) or on its
/// quarter at a corner. Exact for products of L_a and the area normal m.
template <int D>
std::vector<PatchFunctions<D>> exact_functions(int quarter) {
  if (quarter < 0) return patch_functions<D>(3);
  const TensorRule<D - 1> rule = tensor_rule<D - 1>(3);
  std::vector<PatchFunctions<D>> all;
  for (std::size_t q = 0; q < rule.x.size(); ++q) {
    Vec<D - 1> xi = rule.x[q];
    for (int k = 0; k < D - 1; ++k) xi[k] = (xi[k] + corner_sign(quarter, k)) / 2;
    all.emplace_back(xi);
    all.back().weight = rule.w[q] / (1 << (D - 1));
  }
  return all;
}

/// Where a corner of a facet is among the nodes of its patch.
int lattice_corner(int corner) {
  return 2 * (corner & 1) + 6 * (corner >> 1);
}

/// Projection on the span of directions.
template <int D>
Mat<D> span_of(const std::vector<Eigen::Vector3d>& directions) {
  Mat<D> span = Mat<D>::Zero();
  for (const Eigen::Vector3d& direction : directions) {
    Vec<D> left = direction.template head<D>();
    left -= span * left;
    if (constexpr Real parallel = 1e-6; left.norm() > parallel) {
      left.normalize();
      span += left * left.transpose();
    }
  }
  return span;
}
template <int D>
bool is_held(const Mat<D>& span, const Vec<D>& direction) {
  return (span * direction - direction).norm() < 1e-6;
}

}  // namespace

template <int D>
PressurePatches<D>::PressurePatches(const Body<D>& body, const FaceCells<D>& cells,
                                    const HeldDirections& held, bool even)
    : revolved_(body.geometry.grid.revolved) {
  for (int quarter = -1; quarter < corners; ++quarter)
    functions_.push_back(exact_functions<D>(quarter));
  list_pieces(body, cells, held, even);
  piece_force_.resize(pieces_.size() * nodes);
}

/// Counts the sides of a piece in the direction of the facet. In 2D the sides are its two ends,
/// with opposite signs.
template <int D>
void PressurePatches<D>::go_around(const std::array<Index, nodes>& point, int corner,
                                   Sides& sides) {
  const auto count = [&](Index from, Index to) {
    if (from < to) ++sides[{from, to}];
    if (to < from) --sides[{to, from}];
  };
  const int i = corner & 1;
  if constexpr (D == 3) {
    const int j = corner >> 1;
    const auto at_lattice = [&](int k, int l) { return at(point, k + 3 * l); };
    const std::array<Index, 4> loop{at_lattice(i, j), at_lattice(i + 1, j),
                                    at_lattice(i + 1, j + 1), at_lattice(i, j + 1)};
    for (std::size_t k = 0; k < 4; ++k) count(loop[k], loop[(k + 1) % 4]);
  } else {
    --sides[{at(point, i), -1}];
    ++sides[{at(point, i + 1), -1}];
  }
}

template <int D>
void PressurePatches<D>::list_pieces(const Body<D>& body, const FaceCells<D>& cells,
                                     const HeldDirections& held, bool even) {
  const Grid<D>& grid = body.geometry.grid;
  const PatchNodes<D> patches(grid);
  std::map<Index, int> chosen;  // chosen corners of a facet, one bit each
  for (const auto& part : cells.parts)
    for (int corner = 0; corner < corners; ++corner)
      if (at(at(grid.facets, part.facet).nodes, corner) == part.node)
        chosen[part.facet] |= 1 << corner;
  std::map<Index, Index> number;
  std::vector<Vec<D>> X;
  std::map<Index, Index> node_of;  // of the grid, of points at corners
  Sides sides;
  for (const auto& [facet, quarters] : chosen) {
    std::array<Index, nodes> point;
    for (int a = 0; a < nodes; ++a) {
      const auto [known, is_new] =
          number.try_emplace(at(at(patches.facet, facet), a), static_cast<Index>(X.size()));
      at(point, a) = known->second;
      if (is_new)
        X.push_back(surface_point<D>(body.geometry, at(grid.facets, facet), patch_node<D>(a)));
    }
    for (int corner = 0; corner < corners; ++corner)
      node_of[at(point, lattice_corner(corner))] = at(at(grid.facets, facet).nodes, corner);
    if (quarters == (1 << corners) - 1) pieces_.push_back({point, 0});
    for (int corner = 0; corner < corners; ++corner) {
      if (!((quarters >> corner) & 1)) continue;
      if (quarters != (1 << corners) - 1)
        pieces_.push_back({point, static_cast<std::size_t>(corner) + 1});
      go_around(point, corner, sides);
    }
  }
  // A curve that ends on the axis of a body of revolution is closed by its turn.
  for (auto& [ends, count] : sides)
    if (grid.revolved && at(X, ends.first)[0] == 0) count = 0;
  closed_ = std::all_of(sides.begin(), sides.end(), [](const auto& s) { return s.second == 0; });
  rows_ = build_point_rows<D>(body.particles, X, {.value = true}, body.name);
  if (!closed_ && even && !grid.revolved) close_by_held_rim(sides, node_of, held, X);
  X_.resize(X.size());
  for (std::size_t q = 0; q < X.size(); ++q) set_vector<D>(X_, static_cast<Index>(q), X[q]);
}

template <int D>
std::vector<typename PressurePatches<D>::RimEdge> PressurePatches<D>::rim_edges(
    const Sides& sides) const {
  std::vector<RimEdge> edges;
  if constexpr (D == 2) {
    for (const auto& [ends, count] : sides)
      if (count != 0) edges.push_back({ends.first});
  } else {
    const auto on_rim = [&](Index from, Index to) {
      const auto side = sides.find({std::min(from, to), std::max(from, to)});
      return side != sides.end() && side->second == (from < to ? 1 : -1);
    };
    for (const Piece& piece : pieces_)
      for (const auto& [a, m, b] : {RimEdge{0, 1, 2}, {2, 5, 8}, {8, 7, 6}, {6, 3, 0}}) {
        const RimEdge edge{at(piece.point, a), at(piece.point, m), at(piece.point, b)};
        if (piece.functions == 0 && on_rim(edge[0], edge[1]) && on_rim(edge[1], edge[2]))
          edges.push_back(edge);
      }
  }
  return edges;
}

/// Closes the face by strips from its rim to where the rim would be if its held directions did
/// not move at all, since only the mean of each face cell is held. The volume within is then
/// defined for all motions. Does nothing unless all of the rim is held, or slides in planes normal
/// to an axis.
template <int D>
void PressurePatches<D>::close_by_held_rim(const Sides& sides,
                                           const std::map<Index, Index>& node_of,
                                           const HeldDirections& held, std::vector<Vec<D>>& X) {
  const std::vector<RimEdge> edges = rim_edges(sides);
  const auto halves =
      std::count_if(sides.begin(), sides.end(), [](const auto& side) { return side.second != 0; });
  if (halves != std::ssize(edges) * (D - 1)) return;  // the rim cuts facets
  std::map<Index, Mat<D>> span;                       // of the held directions of a point
  std::array<std::vector<Real>, D> planes;
  Real size = 0;
  for (const Vec<D>& place : X) size = std::max(size, (place - X.front()).norm());
  for (const RimEdge& edge : edges) {
    Mat<D> common = Mat<D>::Identity();  // of the directions that both ends are held in
    for (const Index end : {edge.front(), edge.back()}) {
      const auto node = node_of.find(end);
      if (node == node_of.end()) return;
      const auto directions = held.find(node->second);
      if (directions == held.end()) return;
      span[end] = span_of<D>(directions->second);
      if (!span[end].isIdentity(1e-6)) common.setZero();
    }
    if (common.isZero(0)) {
      for (int i = 0; i < D; ++i) {
        bool in_plane = is_held<D>(span[edge.front()], Vec<D>::Unit(i)) &&
                        is_held<D>(span[edge.back()], Vec<D>::Unit(i));
        const Real level = at(X, edge.front())[i];
        for (const Index q : edge)
          in_plane = in_plane && std::abs(at(X, q)[i] - level) < 1e-9 * size;
        if (!in_plane) continue;
        common(i, i) = 1;
        at(planes, i).push_back(level);
      }
      if (common.isZero(0)) return;
    }
    if (D == 3) span[edge[edge.size() / 2]] = common;
  }
  if (!weigh_volume(planes, 1e-9 * size)) return;
  std::map<Index, RimPoint> rim;
  const auto added = [&](Index point) {
    X.push_back(at(X, point));
    return static_cast<Index>(X.size()) - 1;
  };
  for (const auto& [point, directions] : span) {
    const Index allowed = added(point), middle = added(point);
    rim_.push_back({point, allowed, middle, Mat<D>::Identity() - directions});
    rim.emplace(point, rim_.back());
  }
  for (const RimEdge& edge : edges) {
    std::array<Index, nodes> strip{};
    if constexpr (D == 3) {
      for (std::size_t k = 0; k < 3; ++k) {  // the face goes round the edge in the other sense
        const RimPoint& point = rim.at(edge[2 - k]);
        strip[k] = point.point;
        strip[k + 3] = point.middle;
        strip[k + 6] = point.allowed;
      }
    } else {
      const RimPoint& point = rim.at(edge[0]);
      strip = {point.point, point.middle, point.allowed};
      if (sides.at({edge[0], -1}) < 0) std::reverse(strip.begin(), strip.end());
    }
    pieces_.push_back({strip, 0});
  }
}

/// The volume is the mean of INT (x_i - o_i) m_i over axes i. The rim adds nothing to its change
/// where it slides in the plane x_i = o_i, or in a plane along the axis. Returns false if all
/// axes have two planes.
template <int D>
bool PressurePatches<D>::weigh_volume(const std::array<std::vector<Real>, D>& planes,
                                      Real tolerance) {
  Vec<D> weight = Vec<D>::Zero();
  for (int i = 0; i < D; ++i) {
    const std::vector<Real>& levels = at(planes, i);
    const bool one = std::all_of(levels.begin(), levels.end(), [&](Real level) {
      return std::abs(level - levels.front()) < tolerance;
    });
    if (!one) continue;
    weight[i] = 1;
    if (!levels.empty()) volume_origin_[i] = levels.front();
  }
  if (weight.isZero(0)) return false;
  volume_weight_ = weight / weight.sum();
  return true;
}

template <int D>
void PressurePatches<D>::place_held_rim(NodalVectors& x) const {
  for (const RimPoint& p : rim_) {
    const Vec<D> place = vector_at<D>(x, p.point), X = vector_at<D>(X_, p.point),
                 allowed = X + p.free * (place - X);
    set_vector<D>(x, p.allowed, allowed);
    set_vector<D>(x, p.middle, Vec<D>(0.5 * (place + allowed)));
  }
}

template <int D>
CellPoint<D, D - 1> PressurePatches<D>::place(const PatchFunctions<D>& f, const Piece& piece,
                                              const NodalVectors& x) const {
  CellPoint<D, D - 1> at_point{Vec<D>::Zero(), Eigen::Matrix<Real, D, D - 1>::Zero()};
  for (int a = 0; a < nodes; ++a) {
    const Vec<D> node = vector_at<D>(x, at(piece.point, a));
    at_point.X += at(f.L, a) * node;
    for (int k = 0; k < D - 1; ++k) at_point.J.col(k) += at(at(f.dL, k), a) * node;
  }
  return at_point;
}

template <int D>
Vec<D> PressurePatches<D>::place(Index piece, Index gauss_point) const {
  const Piece& of = at(pieces_, piece);
  return place(at(functions_of(of), gauss_point), of, X_).X;
}

template <int D>
Real PressurePatches<D>::volume(const NodalVectors& x) const {
  Real sum = 0;
  for (const Piece& piece : pieces_)
    for (const PatchFunctions<D>& f : functions_of(piece)) {
      const auto at_point = place(f, piece, x);
      if (revolved_) {
        sum += std::numbers::pi * f.weight * at_point.X[0] * at_point.X[0] *
               area_normal<D>(at_point)[0];
        continue;
      }
      const Vec<D> arm = volume_weight_.cwiseProduct(at_point.X - volume_origin_);
      sum += f.weight * arm.dot(area_normal<D>(at_point));
    }
  return sum;
}

template <int D>
void PressurePatches<D>::find_forces(std::span<const Real> pressures, const NodalVectors& x,
                                     NodalVectors& forces) {
  parallel_for(pieces(), [&](Index k) {
    const Piece& piece = at(pieces_, k);
    for (int a = 0; a < nodes; ++a) at(piece_force_, k * nodes + a).setZero();
    for (Index g = 0; g < gauss_points(); ++g) {
      const PatchFunctions<D>& f = at(functions_of(piece), g);
      const auto at_point = place(f, piece, x);
      const Real circle = revolved_ ? 2 * std::numbers::pi * at_point.X[0] : 1;
      const Vec<D> thrust =
          -f.weight * circle * at(pressures, k * gauss_points() + g) * area_normal<D>(at_point);
      for (int a = 0; a < nodes; ++a) at(piece_force_, k * nodes + a) += at(f.L, a) * thrust;
    }
  });
  std::fill(forces.begin(), forces.end(), Lanes::zero());
  for (Index k = 0; k < pieces(); ++k)
    for (int a = 0; a < nodes; ++a) {
      Lanes& f = at(forces, at(at(pieces_, k).point, a));
      for (int i = 0; i < D; ++i) f.set(i, f[i] + at(piece_force_, k * nodes + a)[i]);
    }
  for (const RimPoint& p : rim_) {
    const Vec<D> middle = 0.5 * vector_at<D>(forces, p.middle);
    set_vector<D>(forces, p.point,
                  Vec<D>(vector_at<D>(forces, p.point) + middle +
                         p.free * (vector_at<D>(forces, p.allowed) + middle)));
    at(forces, p.middle) = at(forces, p.allowed) = Lanes::zero();
  }
}

template <int D>
typename PressurePatches<D>::Source PressurePatches<D>::source_of(Index point) const {
  for (const RimPoint& p : rim_) {
    if (point == p.allowed) return {p.point, p.free};
    if (point == p.middle) return {p.point, 0.5 * (Mat<D>::Identity() + p.free)};
  }
  return {point, Mat<D>::Identity()};
}

template <int D>
std::vector<std::vector<Index>> PressurePatches<D>::points_of_pieces() const {
  std::vector<std::vector<Index>> all;
  for (const Piece& piece : pieces_) {
    std::vector<Index> points;
    for (const Index node : piece.point) points.push_back(source_of(node).point);
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
    all.push_back(std::move(points));
  }
  return all;
}

/// The change of the area normal m with the node b is dm_i = A_ij dx_j with the antisymmetric
/// matrix A = L_b,1 [x J_2] - L_b,2 [x J_1] (2D: a rotation by a right angle).
template <int D>
void PressurePatches<D>::add_stiffness(Index piece, std::span<const Index> points,
                                       std::span<const Real> pressures, const NodalVectors& x,
                                       Eigen::MatrixXd& M) const {
  const Piece& of = at(pieces_, piece);
  const auto Q = static_cast<Eigen::Index>(points.size());
  std::array<Source, nodes> source;
  std::array<Eigen::Index, nodes> position;
  for (int a = 0; a < nodes; ++a) {
    at(source, a) = source_of(at(of.point, a));
    at(position, a) =
        std::lower_bound(points.begin(), points.end(), at(source, a).point) - points.begin();
  }
  for (Index g = 0; g < gauss_points(); ++g) {
    const PatchFunctions<D>& f = at(functions_of(of), g);
    const CellPoint<D, D - 1> here = place(f, of, x);
    const Real p = f.weight * at(pressures, piece * gauss_points() + g);
    for (int b = 0; b < nodes; ++b) {
      Mat<D> A;
      for (int j = 0; j < D; ++j) {
        CellPoint<D, D - 1> moved = here;
        if constexpr (D == 3) {
          const Vec<D> e = Vec<D>::Unit(j);
          A.col(j) =
              at(f.dL[0], b) * cross(e, here.J.col(1)) + at(f.dL[1], b) * cross(here.J.col(0), e);
        } else {
          moved.J.col(0) = at(f.dL[0], b) * Vec<D>::Unit(j);
          A.col(j) = area_normal<D>(moved);
        }
      }
      for (int a = 0; a < nodes; ++a) {
        Mat<D> block = p * at(f.L, a) * at(source, a).T.transpose() * A * at(source, b).T;
        if (revolved_) {  // the circle grows with x_0
          block *= 2 * std::numbers::pi * here.X[0];
          block.col(0) += 2 * std::numbers::pi * p * at(f.L, a) * at(f.L, b) * area_normal<D>(here);
        }
        for (int i = 0; i < D; ++i)
          for (int j = 0; j < D; ++j)
            M(i * Q + at(position, a), j * Q + at(position, b)) += block(i, j);
      }
    }
  }
}

template class PressurePatches<2>;
template class PressurePatches<3>;

}  // namespace meniscus
