// SPDX-License-Identifier: BSD-3-Clause
// Surface tension that varies with the material point or the position, and with time (cells note
// 3): f_A = - sum_q gamma da e grad N_A. If it depends on material points only, the force is the
// gradient of the energy sum gamma da. If it depends on positions, it is not, and the external work
// sum da Dgamma/Dt is booked.
#include "input/expression.hpp"
#include "meniscus/physics/surface_registry.hpp"

#include <algorithm>

namespace meniscus {
namespace {

struct VaryingTensionKeys {
  static constexpr std::string_view example = "gamma = \"1 + 0.1*x + 0.2*y*sin(3*t)\"\n";
  std::vector<Expression> gamma;
  std::string of;

  static Rows<VaryingTensionKeys> rows() {
    Row<VaryingTensionKeys> value = expressions_row<VaryingTensionKeys>(
        "gamma", &VaryingTensionKeys::gamma, 1, dimension::tension,
        "tension, a formula of x, y, z and t; may be negative as part of the tension of other "
        "tables");
    value.type = "number or formula";
    value.read = [](VaryingTensionKeys& keys, const Block& block) {
      keys.gamma = {block.expression("gamma", dimension::tension, std::nullopt)};
    };
    return {value, choice_row("of", &VaryingTensionKeys::of, {"material", "place"},
                              "what x, y, z are: the reference position of the point of the "
                              "surface, or where it is now",
                              "material")};
  }
};

template <int D>
class VaryingTension final : public ForceTerm, public VariedTension {
 public:
  VaryingTension(const Body<D>& body, const Expression& gamma, bool of_place,
                 const SurfaceSites& sites)
      : body_(body),
        formula_(gamma),
        of_place_(of_place),
        changes_(of_place || gamma.depends_on_time()),
        surface_(body, sites, of_place),
        chunk_sums_(surface_.points.chunk_sums(body)) {
    now_.resize(surface_.reference.size());
    if (changes_) {
      last_ = now_;
    } else {
      evaluate({0, {}, {}}, now_.gamma);
    }
  }

  std::string name() const override {
    return "varying tension of the surface of '" + body_.name + "'";
  }
  std::string_view energy_kind() const override { return "surface"; }

  Report add_force(const Motion& motion, Forces force) override {
    if (changes_) evaluate(motion, now_.gamma);
    const NodalVector* u = motion.u.data() + body_.first;
    chunk_sums_.accumulate(body_.part(force), [&](int, Index begin, Index end, NodalVector* f) {
      for (Index g = begin; g < end; ++g) {
        const auto s = surface_.state(g, surface_.gradients(g, u));
        const Lanes da = surface_.points.weight(g) * s.stretch;
        now_.set_area(g, da);
        surface_.points.scatter(g, -now_.tension(g) * da * dual_tangents(s), f);
      }
    });
    if (!changes_) return {};
    return force.gather({chunk_sums_.gathered(surface_.groups(), now_.area.data(), Lanes::width)},
                        motion, [this](const Motion&, const Forces&) {
                          Report report;
                          report.external_work = supplied();
                          return report;
                        });
  }
  void add_tangent(const Motion& motion, const Motion& change, Forces force) override {
    if (of_place_) return ForceTerm::add_tangent(motion, change, force);
    if (changes_) evaluate(motion, now_.gamma);
    const NodalVector *u = motion.u.data() + body_.first, *du = change.u.data() + body_.first;
    chunk_sums_.accumulate(body_.part(force), [&](int, Index begin, Index end, NodalVector* f) {
      for (Index g = begin; g < end; ++g) {
        const auto s = surface_.state(g, dual(surface_.gradients(g, u), surface_.gradients(g, du)));
        const Dual<Lanes> w(-surface_.points.weight(g) * now_.tension(g));
        surface_.points.scatter(g, derivative(w * s.stretch * dual_tangents(s)), f);
      }
    });
  }

  /// Accepts the step. The last computed force must belong to this motion.
  void commit(const Motion&) override {
    if (changes_) last_ = now_;
  }
  void archive(const Archive& a) override {
    if (!changes_) return;
    a("begun", begun_);
    a("gamma", last_.gamma, dimension::tension);
    a("area", last_.area, of_sum(dimension::area, D));
  }

  std::optional<Real> stored_energy(const Motion& motion) const override {
    Points at_motion = now_;
    if (changes_) evaluate(motion, at_motion.gamma);
    const NodalVector* u = motion.u.data() + body_.first;
    return parallel_sum(surface_.groups(), 0.0, [&](Index g) {
      return sum(surface_.points.weight(g) * at_motion.tension(g) *
                 surface_.state(g, surface_.gradients(g, u)).stretch);
    });
  }
  std::optional<Real> potential(const Motion& motion) override {
    if (of_place_) return std::nullopt;
    return stored_energy(motion);
  }
  Real steady_after() const override { return formula_.steady_after(); }

  Least least(const Motion& motion) const override {
    Points at_motion = now_;
    if (changes_) evaluate(motion, at_motion.gamma);
    const auto begin = at_motion.gamma.begin(),
               found = std::min_element(begin, begin + surface_.points.rows.size());
    const auto q = static_cast<Index>(found - begin);
    const PointRows<D>& rows = surface_.points.rows;
    const auto from = rows.particle.begin() + at(rows.start, q),
               to = rows.particle.begin() + at(rows.start, q + 1);
    const auto distance = [&](Index A) {
      return (body_.origin(A) - at(surface_.reference, q)).squaredNorm();
    };
    return {*found, *std::min_element(from, to,
                                      [&](Index A, Index B) { return distance(A) < distance(B); })};
  }

  std::vector<MeasureSource> measures() const override { return {surface_.area_measure(body_)}; }
  std::size_t bytes() const override {
    return surface_.bytes() + chunk_sums_.bytes() +
           2 * (now_.gamma.size() + last_.gamma.size()) * sizeof(Real);
  }
  Offset pairs() const override { return surface_.points.pairs(); }

 private:
  /// Tension and present area of each point.
  struct Points {
    std::vector<Real> gamma, area;

    /// Sets the size, rounded up to whole groups of four.
    void resize(std::size_t points) {
      gamma.assign((points + 3) / 4 * 4, 0.0);
      area = gamma;
    }
    Lanes tension(Index group) const {
      const Real* g = gamma.data() + static_cast<std::size_t>(group) * 4;
      return {g[0], g[1], g[2], g[3]};
    }
    void set_area(Index group, Lanes da) {
      for (int lane = 0; lane < 4; ++lane) at(area, group * 4 + lane) = da[lane];
    }
  };

  /// Evaluates the tension at all points. One thread suffices, because a formula is evaluated by
  /// one thread at a time.
  void evaluate(const Motion& motion, std::vector<Real>& gamma) const {
    const NodalVector* u = motion.u.data() + body_.first;
    for (Index q = 0; q < surface_.points.rows.size(); ++q) {
      Eigen::Vector3d x = spatial<D>(at(surface_.reference, q));
      if (of_place_) {
        const NodalVector moved = value_at(surface_.points.rows, q, u);
        for (int i = 0; i < D; ++i) x[i] += moved[i];
      }
      at(gamma, q) = formula_(x, motion.time);
    }
  }

  /// External work: the sum of the mean area times the change of the tension since the last
  /// accepted step.
  Real supplied() {
    if (!begun_) {
      last_ = now_;
      begun_ = true;
    }
    return parallel_sum(static_cast<Index>(now_.gamma.size()), 0.0, [&](Index q) {
      return (at(now_.gamma, q) - at(last_.gamma, q)) * (at(now_.area, q) + at(last_.area, q)) / 2;
    });
  }

  const Body<D>& body_;
  Expression formula_;
  bool of_place_;
  bool changes_;  // true if gamma at a surface point changes in time
  bool begun_ = false;
  SurfaceRule<D> surface_;
  ChunkSums chunk_sums_;
  Points now_, last_;
};

class VaryingTensionMaterial final : public SurfaceMaterial {
 public:
  explicit VaryingTensionMaterial(VaryingTensionKeys keys) : keys_(std::move(keys)) {}

  std::unique_ptr<ForceTerm> build(const Body<2>& body, const SurfaceSites& sites) const override {
    return built(body, sites);
  }
  std::unique_ptr<ForceTerm> build(const Body<3>& body, const SurfaceSites& sites) const override {
    return built(body, sites);
  }

 private:
  template <int D>
  std::unique_ptr<ForceTerm> built(const Body<D>& body, const SurfaceSites& sites) const {
    return std::make_unique<VaryingTension<D>>(body, keys_.gamma.front(), keys_.of == "place",
                                               sites);
  }

  VaryingTensionKeys keys_;
};

const bool registered = register_entry(SurfaceLawEntry{
    "varying_tension", "an energy per current area by a formula", example_of<VaryingTensionKeys>(),
    key_texts(VaryingTensionKeys::rows()),
    [](const Block& block) -> std::unique_ptr<SurfaceMaterial> {
      return std::make_unique<VaryingTensionMaterial>(meniscus::read<VaryingTensionKeys>(block));
    }});

}  // namespace
}  // namespace meniscus
