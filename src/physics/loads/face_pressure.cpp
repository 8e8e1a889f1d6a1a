// SPDX-License-Identifier: BSD-3-Clause
// Pressure on a face that follows its deformation, on quadratic patches through its positions.
#include "body/grid/gauss.hpp"
#include "body/surface/quadratic_patches.hpp"
#include "body/surface/surface_points.hpp"
#include "kernel/row_sums.hpp"
#include "numbers/dense.hpp"
#include "physics/loads/face_measures.hpp"
#include "physics/loads/traction.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

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

template <int D>
class FacePressure final : public ForceTerm {
  static constexpr int nodes = PatchFunctions<D>::nodes, corners = 1 << (D - 1);

 public:
  FacePressure(const Body<D>& body, std::string label, FaceCells<D> cells, Expression pressure,
               const Ramp& ramp, const HeldDirections& held)
      : body_(body),
        label_(std::move(label)),
        cells_(std::move(cells)),
        pressure_(std::move(pressure)),
        ramp_(ramp) {
    for (int quarter = -1; quarter < corners; ++quarter)
      functions_.push_back(exact_functions<D>(quarter));
    list_pieces(held);
    chunk_sums_ = body.chunk_sums(rows_.start, rows_.particle);
    x_ = point_force_ = X_;
    piece_force_.resize(pieces_.size() * nodes);
    values_.resize(pieces_.size() * functions_.front().size());
    reference_volume_ = volume(X_);
  }

  std::string name() const override { return "traction '" + label_ + "'"; }

  Report add_force(const Motion& motion, Forces force) override {
    find_places(motion, x_);
    find_forces(motion.time, x_, point_force_);
    scatter(force);
    Report report;
    if (!closed_ || pressure_.depends_on_place()) report.outside = resultant();
    return report;
  }
  /// Adds the exact tangent: the force is quadratic in the positions (2D: linear), so a difference
  /// of two forces is exact.
  void add_tangent(const Motion& motion, const Motion& change, Forces force) override {
    NodalVectors ahead(X_.size()), behind = ahead, more = ahead;
    find_places(motion, x_);
    for (Index q = 0; q < points(); ++q) {
      const NodalVector dx = value_at(rows_, q, own(change.u));
      at(ahead, q) = at(x_, q) + dx;
      at(behind, q) = at(x_, q) - dx;
    }
    place_held_rim(ahead);
    place_held_rim(behind);
    find_forces(motion.time, ahead, more);
    find_forces(motion.time, behind, point_force_);
    for (Index q = 0; q < points(); ++q)
      at(point_force_, q) = 0.5 * (at(more, q) - at(point_force_, q));
    scatter(force);
  }
  std::optional<Real> potential(const Motion& motion) override {
    if (!has_potential()) return std::nullopt;
    find_places(motion, x_);
    return uniform_pressure(motion.time) * (volume(x_) - reference_volume_);
  }
  Real load_power(const Motion& motion) override {
    find_places(motion, x_);
    find_forces(motion.time, x_, point_force_);
    return parallel_sum(points(), 0.0, [&](Index q) {
      return sum(at(point_force_, q) * value_at(rows_, q, own(motion.v)));
    });
  }
  bool reads(StepReads& reads) override {
    reads.particles(rows_.particle, body_.first);
    reads.rows(chunk_sums_, body_.first);
    return true;
  }
  Real steady_after() const override {
    return pressure_.depends_on_time() ? std::numeric_limits<Real>::infinity() : ramp_.end;
  }
  Real uncancelled_force(const Motion& motion) const override {
    Real sum = 0;
    for (const Lanes& f : forces_at(motion)) sum += std::sqrt(meniscus::sum(f * f));
    return sum;
  }
  std::vector<MeasureSource> measures() const override {
    return face_measures(body_, cells_, [this](const Motion& motion) {
      Vec<D> sum = Vec<D>::Zero();
      const NodalVectors forces = forces_at(motion);
      for (Index q = 0; q < points(); ++q) sum += vector_at<D>(forces, q);
      return sum;
    });
  }
  std::size_t bytes() const override {
    return rows_.bytes() + chunk_sums_.bytes() + pieces_.size() * sizeof(Piece) +
           piece_force_.size() * sizeof(Vec<D>) + 3 * X_.size() * sizeof(NodalVector);
  }
  Offset pairs() const override { return rows_.entries(); }

 private:
  /// A facet or a quarter of a facet.
  struct Piece {
    std::array<Index, nodes> point;
    std::size_t functions;  ///< index in functions_
  };
  /// A point on the rim of the face: its position x, the position y that its held directions allow,
  /// and the middle of both. `allowed` and `middle` have no rows; their numbers follow those of all
  /// points.
  struct RimPoint {
    Index point, allowed, middle;
    Mat<D> free;  ///< y = X + free (x - X)
  };
  /// Sides of pieces as pairs of points, the smaller number first. The value counts the pieces that
  /// have the side in this direction minus the pieces that have it in the opposite direction.
  using Sides = std::map<std::pair<Index, Index>, int>;

  /// Points with rows.
  Index points() const { return static_cast<Index>(rows_.start.size()) - 1; }
  Index piece_count() const { return static_cast<Index>(pieces_.size()); }
  const NodalVector* own(std::span<const NodalVector> field) const {
    return field.data() + body_.first;
  }
  /// A uniform pressure has a potential if the face encloses a volume V, alone or with the planes
  /// on which its rim is held: the force is the gradient of p V.
  bool has_potential() const { return (closed_ || !rim_.empty()) && !pressure_.depends_on_place(); }
  Real uniform_pressure(Real time) const {
    return ramp_.fraction(time) * pressure_({0, 0, 0}, time);
  }

  void list_pieces(const HeldDirections& held) {
    const Grid<D>& grid = body_.geometry.grid;
    const PatchNodes<D> patches(grid);
    std::map<Index, int> chosen;  // chosen corners of a facet, one bit each
    for (const auto& part : cells_.parts)
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
          X.push_back(surface_point<D>(body_.geometry, at(grid.facets, facet), patch_node<D>(a)));
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
    closed_ = std::all_of(sides.begin(), sides.end(), [](const auto& s) { return s.second == 0; });
    rows_ = build_point_rows<D>(body_.particles, X, {.value = true}, body_.name);
    if (!closed_ && !pressure_.depends_on_place()) close_by_held_rim(sides, node_of, held, X);
    X_.resize(X.size());
    for (std::size_t q = 0; q < X.size(); ++q) set_vector<D>(X_, static_cast<Index>(q), X[q]);
  }
  /// Where a corner of a facet is among the nodes of its patch.
  static int lattice_corner(int corner) { return 2 * (corner & 1) + 6 * (corner >> 1); }

  /// Projection on the span of directions.
  static Mat<D> span_of(const std::vector<Eigen::Vector3d>& directions) {
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
  static bool is_held(const Mat<D>& span, const Vec<D>& direction) {
    return (span * direction - direction).norm() < 1e-6;
  }

  /// An edge of the rim, in the sense of the face, with its middle (2D: one point).
  using RimEdge = std::array<Index, D == 3 ? 3 : 1>;
  std::vector<RimEdge> rim_edges(const Sides& sides) const {
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
  /// not move at all: face cells are held in the mean only. The volume within is then defined for
  /// all motions. Does nothing unless all of the rim is held, or slides in planes normal to an
  /// axis.
  void close_by_held_rim(const Sides& sides, const std::map<Index, Index>& node_of,
                         const HeldDirections& held, std::vector<Vec<D>>& X) {
    const std::vector<RimEdge> edges = rim_edges(sides);
    const auto halves = std::count_if(sides.begin(), sides.end(),
                                      [](const auto& side) { return side.second != 0; });
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
        span[end] = span_of(directions->second);
        if (!span[end].isIdentity(1e-6)) common.setZero();
      }
      if (common.isZero(0)) {
        for (int i = 0; i < D; ++i) {
          bool in_plane = is_held(span[edge.front()], Vec<D>::Unit(i)) &&
                          is_held(span[edge.back()], Vec<D>::Unit(i));
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
  bool weigh_volume(const std::array<std::vector<Real>, D>& planes, Real tolerance) {
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
  /// Counts the sides of a piece in the direction of the facet. In 2D the sides are its two ends,
  /// with opposite signs.
  static void go_around(const std::array<Index, nodes>& point, int corner, Sides& sides) {
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

  void find_places(const Motion& motion, NodalVectors& x) const {
    parallel_for(points(),
                 [&](Index q) { at(x, q) = at(X_, q) + value_at(rows_, q, own(motion.u)); });
    place_held_rim(x);
  }
  void place_held_rim(NodalVectors& x) const {
    for (const RimPoint& p : rim_) {
      const Vec<D> place = vector_at<D>(x, p.point), X = vector_at<D>(X_, p.point),
                   allowed = X + p.free * (place - X);
      set_vector<D>(x, p.allowed, allowed);
      set_vector<D>(x, p.middle, Vec<D>(0.5 * (place + allowed)));
    }
  }
  static CellPoint<D, D - 1> place(const PatchFunctions<D>& f, const Piece& piece,
                                   const NodalVectors& x) {
    CellPoint<D, D - 1> at_point{Vec<D>::Zero(), Eigen::Matrix<Real, D, D - 1>::Zero()};
    for (int a = 0; a < nodes; ++a) {
      const Vec<D> node = vector_at<D>(x, at(piece.point, a));
      at_point.X += at(f.L, a) * node;
      for (int k = 0; k < D - 1; ++k) at_point.J.col(k) += at(at(f.dL, k), a) * node;
    }
    return at_point;
  }
  /// Computes the pressures at the Gauss points of all pieces. Formulas are evaluated at reference
  /// positions.
  void find_pressures(Real time) {
    const std::size_t per_piece = functions_.front().size();
    if (!pressure_.depends_on_place()) {
      std::fill(values_.begin(), values_.end(), uniform_pressure(time));
      return;
    }
    const Real ramp = ramp_.fraction(time);
    for (std::size_t k = 0; k < pieces_.size(); ++k)
      for (std::size_t g = 0; g < per_piece; ++g)
        values_[k * per_piece + g] =
            ramp *
            pressure_(spatial<D>(place(at(functions_, pieces_[k].functions)[g], pieces_[k], X_).X),
                      time);
  }
  /// Computes the forces f_a = - INT p L_a m on the points of all pieces at the positions x; m is
  /// the area normal.
  void find_forces(Real time, const NodalVectors& x, NodalVectors& forces) {
    find_pressures(time);
    const auto per_piece = static_cast<Index>(functions_.front().size());
    parallel_for(piece_count(), [&](Index k) {
      const Piece& piece = at(pieces_, k);
      for (int a = 0; a < nodes; ++a) at(piece_force_, k * nodes + a).setZero();
      for (Index g = 0; g < per_piece; ++g) {
        const PatchFunctions<D>& f = at(at(functions_, piece.functions), g);
        const Vec<D> thrust =
            -f.weight * at(values_, k * per_piece + g) * area_normal<D>(place(f, piece, x));
        for (int a = 0; a < nodes; ++a) at(piece_force_, k * nodes + a) += at(f.L, a) * thrust;
      }
    });
    std::fill(forces.begin(), forces.end(), Lanes::zero());
    for (Index k = 0; k < piece_count(); ++k)
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
  NodalVectors forces_at(const Motion& motion) const {
    FacePressure copy(*this);
    copy.find_places(motion, copy.x_);
    copy.find_forces(motion.time, copy.x_, copy.point_force_);
    return copy.point_force_;
  }
  Real volume(const NodalVectors& x) const {
    Real sum = 0;
    for (const Piece& piece : pieces_)
      for (const PatchFunctions<D>& f : at(functions_, piece.functions)) {
        const auto at_point = place(f, piece, x);
        const Vec<D> arm = volume_weight_.cwiseProduct(at_point.X - volume_origin_);
        sum += f.weight * arm.dot(area_normal<D>(at_point));
      }
    return sum;
  }
  void scatter(std::span<NodalVector> force) {
    chunk_sums_.accumulate(body_.part(force), [&](int, Index begin, Index end, NodalVector* f) {
      for (Index q = begin; q < end; ++q) scatter_value(rows_, q, at(point_force_, q), f);
    });
  }
  Resultant resultant() const {
    Resultant all;
    for (Index q = 0; q < points(); ++q) {
      const Eigen::Vector3d f = spatial(at(point_force_, q));
      all += {f, cross(spatial(at(x_, q)), f)};
    }
    return {all.force, all.moment};
  }

  const Body<D>& body_;
  std::string label_;
  FaceCells<D> cells_;
  Expression pressure_;
  Ramp ramp_;
  std::vector<std::vector<PatchFunctions<D>>> functions_;  // of whole facets, then of quarters
  std::vector<Piece> pieces_;
  bool closed_ = false;
  std::vector<RimPoint> rim_;  // of an open face with a potential
  Vec<D> volume_weight_ = Vec<D>::Constant(1.0 / D), volume_origin_ = Vec<D>::Zero();
  NodalVectors X_;  // [point] reference position
  PointRows<D> rows_;
  ChunkSums chunk_sums_;
  Real reference_volume_ = 0;
  // Work space of a force.
  NodalVectors x_, point_force_;
  std::vector<Vec<D>> piece_force_;  // [piece][a] force on point a
  std::vector<Real> values_;         // pressures, [piece][Gauss point]
};

}  // namespace

template <int D>
std::unique_ptr<ForceTerm> face_pressure(const Body<D>& body, std::string label, FaceCells<D> cells,
                                         Expression pressure, const Ramp& ramp,
                                         const HeldDirections& held) {
  return std::make_unique<FacePressure<D>>(body, std::move(label), std::move(cells),
                                           std::move(pressure), ramp, held);
}
template std::unique_ptr<ForceTerm> face_pressure(const Body<2>&, std::string, FaceCells<2>,
                                                  Expression, const Ramp&, const HeldDirections&);
template std::unique_ptr<ForceTerm> face_pressure(const Body<3>&, std::string, FaceCells<3>,
                                                  Expression, const Ramp&, const HeldDirections&);

}  // namespace meniscus
