// SPDX-License-Identifier: BSD-3-Clause
// Bonds between a contact line and its wall.
#include "physics/surface/line_pinning.hpp"

#include "body/surface/wetted_points.hpp"
#include "kernel/row_sums.hpp"
#include "numbers/dense.hpp"
#include "physics/continued_term.hpp"

#include <algorithm>
#include <cmath>

namespace meniscus {
namespace {

/// Has a row for each point of each part of the line, as the friction of the line has. A bond keeps
/// its anchor on the wall. With the outward normal nu of the line along the wall and the way s =
/// nu.(x - anchor), its force per length is - k s nu between - receding and advancing. Beyond, the
/// force is constant, and the anchor follows at the end of the step.
template <int D>
class LinePinning final : public ForceTerm, public ContinuedTerm {
  static constexpr int nodes = LinePart<D>::nodes;
  template <class T>
  using Vector = std::array<T, D>;

 public:
  LinePinning(const Body<D>& body, const WettedFace<D>& face, const LineHold& hold,
              const Motion* start)
      : body_(body), face_(face), hold_(hold) {
    const WettedPoints<D> points(body.geometry, face.face);
    for (const LinePart<D>& part : points.line) {
      for (const Index q : part.point) X_.push_back(at(points.X, q));
      behind_.push_back(at(points.X, part.behind));
    }
    rows_ = build_point_rows<D>(body.particles, X_, {.value = true}, body.name);
    chunk_sums_ = body.chunk_sums(rows_.start, rows_.particle);
    results_ = chunk_sums_.template tally<Result>();
    if constexpr (D == 3) gauss_ = patch_functions<2>(3);
    const NodalVectors rest(static_cast<std::size_t>(body.size()), Lanes::zero());
    outward_.assign(behind_.size(), 1.0);
    for (Index part = 0; part < static_cast<Index>(behind_.size()); ++part) {
      constexpr Index middle = nodes / 2;
      const Line line = line_at(nodes * part + middle, rest.data(), face_.wall);
      if (line.nu.dot(line.x - at(behind_, part)) < 0) at(outward_, part) = -1;
    }
    anchor_.assign(static_cast<std::size_t>(rows_.size()) * D, 0.0);
    const NodalVector* u = start ? start->u.data() + body.first : rest.data();
    const Real time = start ? start->time : 0;
    for (Index r = 0; r < rows_.size(); ++r)
      keep(r, line_at(r, u, face_.wall_at(time)).x - face_.displacement_at(time));
  }

  std::string name() const override {
    return "line pinning of '" + body_.name + "' at '" + face_.face + "'";
  }
  std::string_view energy_kind() const override { return "surface"; }

  Report add_force(const Motion& motion, Forces force) override {
    const NodalVector* u = motion.u.data() + body_.first;
    const WettedWall<D> wall = face_.wall_at(motion.time);
    const Vec<D> velocity = face_.velocity_at(motion.time),
                 moved = face_.displacement_at(motion.time);
    chunk_sums_.accumulate(
        body_.part(force), [&](int chunk, Index begin, Index end, NodalVector* f) {
          Result sum{};
          for (Index r = begin; r < end; ++r) {
            const Line line = line_at(r, u, wall);
            const Real way = way_of(r, line, moved), given = way - slip(way);
            const Vec<D> traction = (-hold_.stiffness * line.length * given) * line.nu;
            std::array<Real, D> along;
            for (int i = 0; i < D; ++i) at(along, i) = traction[i];
            const auto pull = wall.template project<Real>(line.foot, along);
            scatter_value(rows_, r, lanes(pull), f);
            const Eigen::Vector3d by = spatial(lanes(pull));
            sum.outside += Resultant(by, cross(spatial<D>(line.y), by));
            for (int i = 0; i < D; ++i) sum.power += at(pull, i) * velocity[i];
            sum.lost += line.length * hold_.stiffness * std::abs(given * slip(way));
            sum.energy += line.length * hold_.stiffness / 2 * given * given;
          }
          results_[chunk] = sum;
        });
    return force.gather({results_.gathered()}, motion, [this](const Motion&, const Forces& all) {
      const Result sum = results_.sum(Result{});
      Report report;
      report.lost = sum.lost;
      report.external_power = sum.power;
      report.outside = sum.outside;
      if (all.energies) all.energies->push_back({this, sum.energy});
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

  std::optional<Real> stored_energy(const Motion& motion) const override {
    return sum_over_bonds(motion, [this](const Line& line, Real way) {
      const Real given = way - slip(way);
      return line.length * hold_.stiffness / 2 * given * given;
    });
  }
  /// Empty: what slipping loses is no energy of the place.
  std::optional<Real> potential(const Motion&) override { return std::nullopt; }
  Real steady_after() const override { return face_.steady_after(); }

  void commit(const Motion& motion) override {
    const NodalVector* u = motion.u.data() + body_.first;
    const WettedWall<D> wall = face_.wall_at(motion.time);
    const Vec<D> moved = face_.displacement_at(motion.time);
    parallel_for(chunk_sums_.own_rows(rows_.size()), [&](Index r) {
      const Line line = line_at(r, u, wall);
      const Real way = way_of(r, line, moved);
      if (slip(way) != 0) keep(r, line.x - moved - (way - slip(way)) * line.nu);
    });
  }
  void archive(const Archive& a) override {
    const Gathered all = chunk_sums_.gathered(rows_.size(), anchor_.data(), D);
    if (!a.is_reading()) GatherTogether()({&all, 1});
    a("anchors", anchor_, dimension::length);
  }
  void continue_from(const Archive& a) override { archive(a); }

  std::vector<MeasureSource> measures() const override {
    return {{"pinned", dimension::none, "part of the contact line that is pinned, by its length",
             [this](const Motion& motion) {
               const Real all =
                   sum_over_bonds(motion, [](const Line& line, Real) { return line.length; });
               // A bond that slips is at its limit, or nearly so if it vibrates.
               constexpr Real margin = 0.02;
               return sum_over_bonds(motion,
                                     [this](const Line& line, Real way) {
                                       return slip(way * (1 + margin)) == 0 ? line.length : 0;
                                     }) /
                      all;
             }}};
  }
  std::size_t bytes() const override {
    return rows_.bytes() + chunk_sums_.bytes() + anchor_.size() * sizeof(Real);
  }
  Offset pairs() const override { return rows_.entries(); }

 private:
  struct Result {
    Real lost = 0, power = 0, energy = 0;  // power on the velocity of the wall
    Resultant outside = {};
    friend Result operator+(Result a, const Result& b) {
      a.lost += b.lost;
      a.power += b.power;
      a.energy += b.energy;
      a.outside += b.outside;
      return a;
    }
  };
  /// The line at a row: its place before and after projection on the wall, its outward normal along
  /// the wall, and the share of the row in its length.
  struct Line {
    Vec<D> y, x, nu;
    Real length;
    typename WettedWall<D>::template Foot<Real> foot;
  };

  static Index first_of_part(Index row) { return row - row % nodes; }
  template <std::size_t N>
  static NodalVector lanes(const std::array<Real, N>& v) {
    NodalVector all = Lanes::zero();
    for (std::size_t i = 0; i < N; ++i) all.set(static_cast<int>(i), v[i]);
    return all;
  }
  void keep(Index row, const Vec<D>& anchor) {
    for (int i = 0; i < D; ++i) at(anchor_, row * D + i) = anchor[i];
  }
  Real way_of(Index row, const Line& line, const Vec<D>& moved) const {
    Real way = 0;
    for (int i = 0; i < D; ++i)
      way += line.nu[i] * (line.x[i] - moved[i] - at(anchor_, row * D + i));
    return way;
  }

  /// The way of a bond beyond its longest elastic way.
  Real slip(Real way) const {
    return way -
           std::clamp(way, -hold_.receding / hold_.stiffness, hold_.advancing / hold_.stiffness);
  }
  template <class F>
  Real sum_over_bonds(const Motion& motion, F&& f) const {
    const NodalVector* u = motion.u.data() + body_.first;
    const WettedWall<D> wall = face_.wall_at(motion.time);
    const Vec<D> moved = face_.displacement_at(motion.time);
    return body_.sum_over_rows(rows_.size(), 0.0, [&](Index r) {
      const Line line = line_at(r, u, wall);
      return f(line, way_of(r, line, moved));
    });
  }

  Line line_at(Index row, const NodalVector* u, const WettedWall<D>& wall) const {
    const Index a = row % nodes;
    Line line;
    std::array<Vec<D>, nodes> x;
    for (int b = 0; b < nodes; ++b) {
      const Lanes moved = value_at(rows_, first_of_part(row) + b, u);
      std::array<Real, D> y;
      for (int i = 0; i < D; ++i) at(y, i) = at(X_, first_of_part(row) + b)[i] + moved[i];
      const auto foot = wall.template foot<Real>(y);
      for (int i = 0; i < D; ++i) at(x, b)[i] = at(foot.x, i);
      if (b != a) continue;
      line.foot = foot;
      for (int i = 0; i < D; ++i) line.y[i] = at(y, i);
    }
    line.x = at(x, a);
    Vec<D> n;
    for (int i = 0; i < D; ++i) n[i] = at(line.foot.normal, i);
    const Real side = at(outward_, row / nodes);
    if constexpr (D == 3) {
      line.length = 0;
      for (const PatchFunctions<2>& f : gauss_) {
        Vec<3> t = Vec<3>::Zero();
        for (int b = 0; b < nodes; ++b) t += at(f.dL[0], b) * at(x, b);
        line.length += f.weight * t.norm() * at(f.L, a);
      }
      // The slope of the parabola through the three points.
      const Vec<3> t = a == 0   ? Vec<3>(-3 * x[0] + 4 * x[1] - x[2])
                       : a == 1 ? Vec<3>(x[2] - x[0])
                                : Vec<3>(x[0] - 4 * x[1] + 3 * x[2]);
      line.nu = side * cross(t, n).normalized();
    } else {
      line.length = circle(body_.geometry.grid, line.x);
      line.nu = side * Vec<2>(n[1], -n[0]);
    }
    return line;
  }

  const Body<D>& body_;
  WettedFace<D> face_;
  LineHold hold_;
  std::vector<Vec<D>> X_, behind_;  // [row], [part]
  std::vector<Real> outward_;       // [part] sign of the normal
  PointRows<D> rows_;
  ChunkSums chunk_sums_;
  ChunkTally<Result> results_;
  std::vector<Real> anchor_;  // [row] on the wall at rest, D numbers each
  std::vector<PatchFunctions<2>> gauss_;
};

}  // namespace

template <int D>
std::unique_ptr<ForceTerm> line_pinning(const Body<D>& body, const WettedFace<D>& face,
                                        const LineHold& hold, const Motion* start) {
  return std::make_unique<LinePinning<D>>(body, face, hold, start);
}
template std::unique_ptr<ForceTerm> line_pinning(const Body<2>&, const WettedFace<2>&,
                                                 const LineHold&, const Motion*);
template std::unique_ptr<ForceTerm> line_pinning(const Body<3>&, const WettedFace<3>&,
                                                 const LineHold&, const Motion*);

}  // namespace meniscus
