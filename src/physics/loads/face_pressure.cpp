// SPDX-License-Identifier: BSD-3-Clause
// Pressure on a face that follows its deformation, on quadratic patches through its positions.
#include "body/grid/gauss.hpp"
#include "body/surface/quadratic_patches.hpp"
#include "body/surface/surface_points.hpp"
#include "kernel/row_sums.hpp"
#include "numbers/dense.hpp"
#include "physics/loads/face_measures.hpp"
#include "physics/loads/traction.hpp"

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
               const Ramp& ramp)
      : body_(body),
        label_(std::move(label)),
        cells_(std::move(cells)),
        pressure_(std::move(pressure)),
        ramp_(ramp) {
    for (int quarter = -1; quarter < corners; ++quarter)
      functions_.push_back(exact_functions<D>(quarter));
    list_pieces();
    chunk_sums_ = {rows_.start, rows_.particle, body.size(), body.division};
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
    if (!has_potential()) report.outside = resultant();
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
  bool tell_reads(StepReads& reads) override {
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
  /// Sides of pieces as pairs of points, the smaller number first. The value counts the pieces that
  /// have the side in this direction minus the pieces that have it in the opposite direction.
  using Sides = std::map<std::pair<Index, Index>, int>;

  Index points() const { return static_cast<Index>(X_.size()); }
  Index piece_count() const { return static_cast<Index>(pieces_.size()); }
  const NodalVector* own(std::span<const NodalVector> field) const {
    return field.data() + body_.first;
  }
  /// A uniform pressure on a closed surface has a potential: the force is the gradient of p V, V
  /// the enclosed volume.
  bool has_potential() const { return closed_ && !pressure_.depends_on_place(); }
  Real uniform_pressure(Real time) const {
    return ramp_.fraction(time) * pressure_({0, 0, 0}, time);
  }

  void list_pieces() {
    const Grid<D>& grid = body_.geometry.grid;
    const PatchNodes<D> patches(grid);
    std::map<Index, int> chosen;  // chosen corners of a facet, one bit each
    for (const auto& part : cells_.parts)
      for (int corner = 0; corner < corners; ++corner)
        if (at(at(grid.facets, part.facet).nodes, corner) == part.node)
          chosen[part.facet] |= 1 << corner;
    std::map<Index, Index> number;
    std::vector<Vec<D>> X;
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
    X_.resize(X.size());
    for (Index q = 0; q < points(); ++q) set_vector<D>(X_, q, at(X, q));
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
        sum += f.weight / D * at_point.X.dot(area_normal<D>(at_point));
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
                                         Expression pressure, const Ramp& ramp) {
  return std::make_unique<FacePressure<D>>(body, std::move(label), std::move(cells),
                                           std::move(pressure), ramp);
}
template std::unique_ptr<ForceTerm> face_pressure(const Body<2>&, std::string, FaceCells<2>,
                                                  Expression, const Ramp&);
template std::unique_ptr<ForceTerm> face_pressure(const Body<3>&, std::string, FaceCells<3>,
                                                  Expression, const Ramp&);

}  // namespace meniscus
