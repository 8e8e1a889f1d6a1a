// SPDX-License-Identifier: BSD-3-Clause
// Anchoring of a director h to the normal n of the surface (cells note 5.3). The energy per
// reference area, with m = cof(F) N, is
//   polar:   w = W/2 |h - n|^2 Js       = W/2 [(|h|^2 + 1) Js - 2 h.m];
//   apolar:  w = W/2 (|h|^2 - (h.n)^2) Js = W/2 [|h|^2 Js - (h.m)^2/Js].
// The stress is P = dw/dF = [(y.m) cof F - m (cof F)^T y]/J, y = dw/dm. The apolar energy contains
// |h|^2 instead of 1; with 1, the energy would fall with the length of the director.
#include "kernel/row_sums.hpp"
#include "meniscus/physics/surface_registry.hpp"

namespace meniscus {
namespace {

struct AnchoringKeys {
  static constexpr std::string_view example = "strength = 0.4\n";
  Real strength = 0;
  std::string sense;

  static Rows<AnchoringKeys> rows() {
    return {real_row("strength", &AnchoringKeys::strength, dimension::tension, range::positive,
                     "W of the energy W/2 |h - n|^2 per present area"),
            choice_row("sense", &AnchoringKeys::sense, {"apolar", "polar"},
                       "whether h and -h are the same for the surface: apolar has the energy W/2 "
                       "(|h|^2 - (h.n)^2)",
                       "apolar")};
  }
};

/// A vector at four points, one point per lane.
using Vectors = std::array<Lanes, 3>;

Lanes dot(const Vectors& a, const Vectors& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

template <int D>
class Anchoring final : public ForceTerm, public FieldEnergy, public AnchoredTerm {
 public:
  Anchoring(const Body<D>& body, Real strength, bool polar, const SurfaceSites& sites)
      : body_(body),
        strength_(strength),
        polar_(polar),
        surface_(body, sites, true),
        chunk_sums_(surface_.points.chunk_sums(body)),
        held_(static_cast<std::size_t>(surface_.groups())) {}

  std::string name() const override { return "anchoring to the surface of '" + body_.name + "'"; }
  std::string_view energy_kind() const override { return "anchoring"; }

  void anchor(CarriedField& director) override {
    field_ = director.number();
    director.add(*this);
  }

  Report add_force(const Motion& motion, Forces force) override {
    const NodalVector *u = motion.u.data() + body_.first, *x = director(motion);
    chunk_sums_.accumulate(body_.part(force), [&](int, Index begin, Index end, NodalVector* f) {
      for (Index g = begin; g < end; ++g) {
        const SurfaceState<Lanes> s = surface_.state(g, surface_.gradients(g, u));
        const Vectors y = slope(s.m, s.stretch, values(g, x));
        const Lanes factor = (-1.0 * surface_.points.weight(g)) / (1.0 + volume_change(s.H)),
                    along = dot(y, s.m);
        Vectors y_cof;
        for (int K = 0; K < 3; ++K)
          at(y_cof, K) =
              y[0] * s.cofactor(0, K) + y[1] * s.cofactor(1, K) + y[2] * s.cofactor(2, K);
        surface_.points.scatter(g, factor * Tensor<Lanes>::map([&](int i, int K) {
                                     return along * s.cofactor(i, K) - at(s.m, i) * at(y_cof, K);
                                   }),
                                f);
        at(held_, g) = {s.m, s.stretch};
      }
    });
    if (!force.fields.empty()) add_held_force(x, body_.part(force.of_field(field_)));
    return {};
  }

  std::optional<Real> stored_energy(const Motion& motion) const override {
    const NodalVector *u = motion.u.data() + body_.first, *x = director(motion);
    return body_.sum_over_rows(surface_.groups(), 0.0, [&](Index g) {
      const SurfaceState<Lanes> s = surface_.state(g, surface_.gradients(g, u));
      return energy(g, {s.m, s.stretch}, x);
    });
  }

  void hold_places(const NodalVector* u) override {
    parallel_for(chunk_sums_.own_rows(surface_.groups()), [&](Index g) {
      const SurfaceState<Lanes> s = surface_.state(g, surface_.gradients(g, u));
      at(held_, g) = {s.m, s.stretch};
    });
  }
  Real held_energy(const NodalVector* x) const override {
    return body_.sum_over_rows(surface_.groups(), 0.0,
                               [&](Index g) { return energy(g, at(held_, g), x); });
  }
  /// Adds the force of the director at fixed positions, from dw/dh = W (Js h - m) (polar) or W (Js
  /// h - (h.n) m) (apolar).
  void add_held_force(const NodalVector* x, const ForceVector& f) override {
    const PointRows<D>& rows = surface_.points.rows;
    chunk_sums_.accumulate(f, [&](int, Index begin, Index end, NodalVector* sum) {
      for (Index g = begin; g < end; ++g) {
        const Held& at_points = at(held_, g);
        const Vectors h = values(g, x);
        const Lanes W = strength_ * surface_.points.weight(g),
                    along = polar_ ? Lanes(1.0) : dot(h, at_points.m) / at_points.stretch;
        Vectors pull;
        for (int i = 0; i < 3; ++i)
          at(pull, i) = W * (along * at(at_points.m, i) - at_points.stretch * at(h, i));
        const auto by_point = by_lane(pull[0], pull[1], pull[2]);
        for (Index q = 4 * g; q < std::min(4 * g + 4, rows.size()); ++q)
          scatter_value(rows, q, at(by_point, q - 4 * g), sum);
      }
    });
  }

  std::vector<MeasureSource> measures() const override {
    return {{"energy", of_sum(dimension::energy, D), "energy of the anchoring of the director",
             [this](const Motion& motion) { return *stored_energy(motion); }}};
  }
  std::size_t bytes() const override {
    return surface_.bytes() + chunk_sums_.bytes() + held_.size() * sizeof(Held);
  }
  Offset pairs() const override { return 2 * surface_.points.pairs(); }

 private:
  /// Area vectors and stretches of a group of four points.
  struct Held {
    Vectors m;
    Lanes stretch;
  };

  const NodalVector* director(const Motion& motion) const {
    return at(motion.fields, field_).x.data() + body_.first;
  }
  Vectors values(Index g, const NodalVector* x) const {
    const PointRows<D>& rows = surface_.points.rows;
    Vectors h{Lanes::zero(), Lanes::zero(), Lanes::zero()};
    for (Index q = 4 * g; q < std::min(4 * g + 4, rows.size()); ++q) {
      const Lanes value = value_at(rows, q, x);
      for (int i = 0; i < D; ++i) at(h, i).set(q - 4 * g, value[i]);
    }
    return h;
  }
  Real energy(Index g, const Held& at_points, const NodalVector* x) const {
    const Vectors h = values(g, x);
    const Lanes along = dot(h, at_points.m), Js = at_points.stretch, square = dot(h, h);
    return strength_ / 2 *
           sum(surface_.points.weight(g) *
               (polar_ ? (square + 1.0) * Js - 2.0 * along : square * Js - along * along / Js));
  }
  /// y = dw/dm: W/2 [(|h|^2 + 1) n - 2 h] (polar) or W/2 [(|h|^2 + (h.n)^2) n - 2 (h.n) h]
  /// (apolar).
  Vectors slope(const Vectors& m, const Lanes& stretch, const Vectors& h) const {
    const Lanes along = dot(h, m) / stretch, square = dot(h, h),
                of_n = strength_ / 2 * (polar_ ? square + 1.0 : square + along * along) / stretch,
                of_h = strength_ * (polar_ ? Lanes(1.0) : along);
    Vectors y;
    for (int i = 0; i < 3; ++i) at(y, i) = of_n * at(m, i) - of_h * at(h, i);
    return y;
  }

  const Body<D>& body_;
  Real strength_;
  bool polar_;
  SurfaceRule<D> surface_;
  ChunkSums chunk_sums_;
  AlignedVector<Held> held_;  // [group] at the held positions
  std::size_t field_ = 0;
};

class AnchoringMaterial final : public SurfaceMaterial {
 public:
  explicit AnchoringMaterial(AnchoringKeys keys) : keys_(std::move(keys)) {}

  std::unique_ptr<ForceTerm> build(const Body<2>& body, const SurfaceSites& sites) const override {
    return std::make_unique<Anchoring<2>>(body, keys_.strength, keys_.sense == "polar", sites);
  }
  std::unique_ptr<ForceTerm> build(const Body<3>& body, const SurfaceSites& sites) const override {
    return std::make_unique<Anchoring<3>>(body, keys_.strength, keys_.sense == "polar", sites);
  }
  /// The energy is per present area, so a remap does not change it.
  bool keeps_reference() const override { return false; }

 private:
  AnchoringKeys keys_;
};

const bool registered = register_entry(SurfaceLawEntry{
    "anchoring", "an energy of the angle between the director of a nematic and the normal",
    example_of<AnchoringKeys>(), key_texts(AnchoringKeys::rows()),
    [](const Block& block) -> std::unique_ptr<SurfaceMaterial> {
      return std::make_unique<AnchoringMaterial>(meniscus::read<AnchoringKeys>(block));
    }});

}  // namespace
}  // namespace meniscus
