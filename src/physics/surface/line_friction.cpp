// SPDX-License-Identifier: BSD-3-Clause
// Forces on the points of a contact line.
#include "physics/surface/line_friction.hpp"

#include "body/surface/wetted_points.hpp"
#include "kernel/row_sums.hpp"
#include "numbers/dense.hpp"

namespace meniscus {
namespace {

/// Has a row for each point of each part of the line. Parts repeat the points that they share, so
/// that the force on a row follows from the motion of its part alone.
template <int D>
class LineFriction final : public ForceTerm {
  static constexpr int nodes = LinePart<D>::nodes;

 public:
  LineFriction(const Body<D>& body, const WettedFace<D>& face, Real friction)
      : body_(body), face_(face), friction_(friction) {
    const WettedPoints<D> points(body.geometry, face.face);
    for (const LinePart<D>& part : points.line)
      for (const Index q : part.point) X_.push_back(at(points.X, q));
    rows_ = build_point_rows<D>(body.particles, X_, {.value = true}, body.name);
    chunk_sums_ = body.chunk_sums(rows_.start, rows_.particle);
    results_ = chunk_sums_.template tally<Result>();
    drag_.resize(X_.size());
    if constexpr (D == 3) gauss_ = patch_functions<2>(3);
  }

  std::string name() const override {
    return "line friction of '" + body_.name + "' at '" + face_.face + "'";
  }

  Report add_force(const Motion& motion, Forces force) override {
    find_drag(motion);
    const Vec<D> wall = face_.velocity_at(motion.time);
    chunk_sums_.accumulate(
        body_.part(force), [&](int chunk, Index begin, Index end, NodalVector* f) {
          Result sum{};
          for (Index r = begin; r < end; ++r) {
            const Drag& drag = at(drag_, r);
            const Vec<D> pull = drag_on(r, motion.v, wall);
            scatter_value(rows_, r, lanes(pull), f);
            sum.outside += Resultant(spatial<D>(pull), cross(spatial<D>(drag.y), spatial<D>(pull)));
            sum.heat -= pull.dot(velocity(r, motion.v) - wall);
            sum.power += pull.dot(wall);
          }
          results_[chunk] = sum;
        });
    return force.gather({results_.gathered()}, motion, [this](const Motion&, const Forces&) {
      const Result all = results_.sum(Result{});
      Report report;
      report.heat = all.heat;
      report.external_power = all.power;
      report.outside = all.outside;
      return report;
    });
  }
  bool reads(StepReads& reads) override {
    reads.rows(chunk_sums_, body_.first);
    const ItemRange own = chunk_sums_.own_rows(rows_.size());
    if (own.begin < own.end)
      reads.particles(rows_.of_rows(first_of_part(own.begin), first_of_part(own.end - 1) + nodes),
                      body_.first);
    return true;
  }
  bool viscous() const override { return true; }
  void add_viscous(const Motion& motion, Forces force) override {
    chunk_sums_.accumulate(body_.part(force), [&](int, Index begin, Index end, NodalVector* f) {
      for (Index r = begin; r < end; ++r)
        scatter_value(rows_, r, lanes(drag_on(r, motion.v, Vec<D>::Zero())), f);
    });
  }
  /// Takes the points of a part for one.
  void add_viscous_diagonal(Forces diagonal) override {
    chunk_sums_.accumulate(
        body_.part(diagonal), [&](int, Index begin, Index end, NodalVector* sums) {
          for (Index r = begin; r < end; ++r) {
            Vec<D> all = Vec<D>::Zero();
            for (const Mat<D>& C : at(drag_, r).by_point) all += C.diagonal();
            for (Offset e = at(rows_.start, r); e < at(rows_.start, r + 1); ++e) {
              const Lanes N = shape_at(rows_, e);
              sums[at(rows_.particle, e)] += N * N * lanes(all);
            }
          }
        });
  }
  std::size_t bytes() const override { return rows_.bytes() + chunk_sums_.bytes(); }
  Offset pairs() const override { return rows_.entries(); }

 private:
  struct Result {
    Real heat = 0, power = 0;  // power on the velocity of the wall
    Resultant outside = {};
    friend Result operator+(Result a, const Result& b) {
      a.heat += b.heat;
      a.power += b.power;
      a.outside += b.outside;
      return a;
    }
  };
  /// The force on a row is - sum_b by_point[b] v_b, with the velocities of the points of its part.
  struct Drag {
    Vec<D> y;
    std::array<Mat<D>, nodes> by_point;
  };

  static Index first_of_part(Index row) { return row - row % nodes; }
  static NodalVector lanes(const Vec<D>& v) {
    NodalVector all = Lanes::zero();
    for (int i = 0; i < D; ++i) all.set(i, v[i]);
    return all;
  }
  Vec<D> velocity(Index row, std::span<const NodalVector> v) const {
    const Lanes value = value_at(rows_, row, v.data() + body_.first);
    Vec<D> w;
    for (int i = 0; i < D; ++i) w[i] = value[i];
    return w;
  }
  Vec<D> drag_on(Index row, std::span<const NodalVector> v, const Vec<D>& wall) const {
    Vec<D> pull = Vec<D>::Zero();
    for (int b = 0; b < nodes; ++b)
      pull -= at(at(drag_, row).by_point, b) * (velocity(first_of_part(row) + b, v) - wall);
    return pull;
  }
  /// The foot of a row's point on the wall, and DP there as a matrix.
  struct OnWall {
    Vec<D> y, x, normal;
    Mat<D> DP;
  };
  OnWall on_wall(Index row, std::span<const NodalVector> u, const WettedWall<D>& wall) const {
    OnWall point;
    point.y = at(X_, row) + velocity(row, u);
    std::array<Real, D> y;
    for (int i = 0; i < D; ++i) at(y, i) = point.y[i];
    const auto foot = wall.template foot<Real>(y);
    for (int i = 0; i < D; ++i) {
      point.x[i] = at(foot.x, i);
      point.normal[i] = at(foot.normal, i);
      std::array<Real, D> unit{};
      at(unit, i) = 1;
      const auto column = wall.template project<Real>(foot, unit);
      for (int j = 0; j < D; ++j) point.DP(j, i) = at(column, j);
    }
    return point;
  }
  void find_drag(const Motion& motion) {
    const WettedWall<D> wall = face_.wall_at(motion.time);
    parallel_for(chunk_sums_.own_rows(rows_.size()),
                 [&](Index r) { at(drag_, r) = drag_at(r, motion.u, wall); });
  }
  /// The integral of friction L_a L_b nu nu^T over the part, between DP of both points.
  Drag drag_at(Index row, std::span<const NodalVector> u, const WettedWall<D>& wall) const {
    std::array<OnWall, nodes> points;
    for (int b = 0; b < nodes; ++b) at(points, b) = on_wall(first_of_part(row) + b, u, wall);
    const Index a = row % nodes;
    Drag drag;
    drag.y = at(points, a).y;
    if constexpr (D == 3) {
      for (Mat<3>& all : drag.by_point) all.setZero();
      for (const PatchFunctions<2>& f : gauss_) {
        Vec<3> t = Vec<3>::Zero(), n = Vec<3>::Zero();
        for (int b = 0; b < nodes; ++b) {
          t += at(f.dL[0], b) * at(points, b).x;
          n += at(f.L, b) * at(points, b).normal;
        }
        const Vec<3> nu = cross(t, n).normalized();
        const Mat<3> along = friction_ * f.weight * t.norm() * at(f.L, a) * nu * nu.transpose();
        for (int b = 0; b < nodes; ++b) at(drag.by_point, b) += at(f.L, b) * along;
      }
      for (int b = 0; b < nodes; ++b)
        at(drag.by_point, b) = at(points, a).DP * at(drag.by_point, b) * at(points, b).DP;
    } else {
      const Real length = circle(body_.geometry.grid, points[0].x);
      drag.by_point[0] = friction_ * length * points[0].DP * points[0].DP;
    }
    return drag;
  }

  const Body<D>& body_;
  WettedFace<D> face_;
  Real friction_;
  std::vector<Vec<D>> X_;  // [row]
  PointRows<D> rows_;
  ChunkSums chunk_sums_;
  ChunkTally<Result> results_;
  std::vector<Drag> drag_;  // [row] at the displacement of the last add_force()
  std::vector<PatchFunctions<2>> gauss_;
};

}  // namespace

template <int D>
std::unique_ptr<ForceTerm> line_friction(const Body<D>& body, const WettedFace<D>& face,
                                         Real friction) {
  return std::make_unique<LineFriction<D>>(body, face, friction);
}
template std::unique_ptr<ForceTerm> line_friction(const Body<2>&, const WettedFace<2>&, Real);
template std::unique_ptr<ForceTerm> line_friction(const Body<3>&, const WettedFace<3>&, Real);

}  // namespace meniscus
