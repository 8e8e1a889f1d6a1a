// SPDX-License-Identifier: BSD-3-Clause
// Bending of a surface: Helfrich's energy kappa/2 (2H - c0)^2 per present area, 2H = 2/R on a
// sphere (membranes note 2). The energy is the sum over Gauss points of the facets, of the surface
// that the shape functions make; forces are its exact gradient. Sums over the particles alone are
// not offered: fewer points than unknowns have an energy without a lower bound.
#include "meniscus/physics/surface_registry.hpp"
#include "physics/surface/bending_rows.hpp"

namespace meniscus {
namespace {

/// Dimension of curvature, 1/m.
constexpr Dimension curvature_dimension{-1, 0, 0};

struct HelfrichKeys {
  static constexpr std::string_view example =
      "bending_modulus = 0.2\nspontaneous_curvature = 0.4\n";
  Real bending_modulus = 0, spontaneous_curvature = 0;
  std::string natural;

  static Rows<HelfrichKeys> rows() {
    return {real_row("bending_modulus", &HelfrichKeys::bending_modulus, dimension::energy,
                     range::positive, "kappa of the energy kappa/2 (2H - c0)^2 per present area"),
            real_row("spontaneous_curvature", &HelfrichKeys::spontaneous_curvature,
                     curvature_dimension, range::any,
                     "c0, sum of both principal curvatures without moment; 2/R for a sphere", 0.0),
            choice_row("natural", &HelfrichKeys::natural, {"flat", "reference"},
                       "the shape without moment: a plane, or the reference, whose 2H is added to "
                       "c0 at each point",
                       "flat")};
  }
};

/// value and change as dual numbers.
SurfaceDerivatives<Dual<Real>> dual_of(const SurfaceDerivatives<Real>& value,
                                       const SurfaceDerivatives<Real>& change) {
  SurfaceDerivatives<Dual<Real>> d;
  for (std::size_t k = 0; k < d.size(); ++k)
    for (std::size_t i = 0; i < 3; ++i) d[k][i] = {value[k][i], change[k][i]};
  return d;
}

template <int D>
class Helfrich final : public ForceTerm {
 public:
  Helfrich(const Body<D>& body, const HelfrichKeys& keys, const SurfaceSites& sites)
      : body_(body),
        modulus_(keys.bending_modulus),
        face_(sites.face),
        rows_(body, sites),
        chunk_sums_(rows_.chunk_sums(body)),
        curvature_(static_cast<std::size_t>(rows_.size()), keys.spontaneous_curvature) {
    if (keys.natural == "reference")
      for (Index q = 0; q < rows_.size(); ++q) at(curvature_, q) += rows_.twice_mean_curvature(q);
  }

  std::string name() const override {
    return (face_.empty() ? "bending of the surface of '"
                          : "bending of the face '" + face_ + "' of '") +
           body_.name + "'";
  }
  std::string_view energy_kind() const override { return "bending"; }

  Report add_force(const Motion& motion, Forces force) override {
    const NodalVector* u = displacements(motion);
    chunk_sums_.accumulate(body_.part(force), [&](int, Index begin, Index end, NodalVector* f) {
      for (Index q = begin; q < end; ++q)
        rows_.scatter(q, -rows_.area(q), at_point(q, rows_.derivatives(q, u)).slope, f);
    });
    return {};
  }
  void add_tangent(const Motion& motion, const Motion& change, Forces force) override {
    const NodalVector *u = displacements(motion), *du = displacements(change);
    chunk_sums_.accumulate(body_.part(force), [&](int, Index begin, Index end, NodalVector* f) {
      for (Index q = begin; q < end; ++q) {
        const auto slope =
            at_point(q, dual_of(rows_.derivatives(q, u), rows_.changes(q, du))).slope;
        SurfaceDerivatives<Real> change_of_slope;
        for (std::size_t k = 0; k < slope.size(); ++k)
          for (std::size_t i = 0; i < 3; ++i) change_of_slope[k][i] = slope[k][i].d;
        rows_.scatter(q, -rows_.area(q), change_of_slope, f);
      }
    });
  }

  std::optional<Real> stored_energy(const Motion& motion) const override {
    const NodalVector* u = displacements(motion);
    return parallel_sum(rows_.size(), 0.0, [&](Index q) {
      return rows_.area(q) * at_point(q, rows_.derivatives(q, u)).energy;
    });
  }
  /// The law reads the motion in the loop over rows only.
  bool reads(StepReads& reads) override {
    reads.rows(chunk_sums_, body_.first);
    return true;
  }

  std::vector<MeasureSource> measures() const override {
    return {{"area", of_sum(dimension::area, D), "current area of the surface (2D: length)",
             [this](const Motion& motion) {
               const NodalVector* u = displacements(motion);
               return parallel_sum(rows_.size(), 0.0, [&](Index q) {
                 return rows_.area(q) * CurvedPoint<Real>(rows_.derivatives(q, u)).J;
               });
             }},
            {"energy", of_sum(dimension::energy, D),
             "bending energy of the surface; 8 pi times the modulus on a sphere without "
             "spontaneous curvature",
             [this](const Motion& motion) { return *stored_energy(motion); }}};
  }
  std::size_t bytes() const override {
    return rows_.bytes() + chunk_sums_.bytes() + curvature_.size() * sizeof(Real);
  }
  Offset pairs() const override { return rows_.pairs(); }

 private:
  const NodalVector* displacements(const Motion& motion) const {
    return motion.u.data() + body_.first;
  }
  template <class T>
  BendingEnergy<T> at_point(Index q, const SurfaceDerivatives<T>& d) const {
    return bending_energy(d, modulus_, at(curvature_, q));
  }

  const Body<D>& body_;
  Real modulus_;
  std::string face_;  // empty: the whole surface
  BendingRows<D> rows_;
  ChunkSums chunk_sums_;
  std::vector<Real> curvature_;  // [point] c0
};

class HelfrichMaterial final : public SurfaceMaterial {
 public:
  explicit HelfrichMaterial(HelfrichKeys keys) : keys_(std::move(keys)) {}

  std::unique_ptr<ForceTerm> build(const Body<2>& body, const SurfaceSites& sites) const override {
    return std::make_unique<Helfrich<2>>(body, keys_, sites);
  }
  std::unique_ptr<ForceTerm> build(const Body<3>& body, const SurfaceSites& sites) const override {
    return std::make_unique<Helfrich<3>>(body, keys_, sites);
  }
  /// The energy is per present area, so a remap changes it only if the reference is the natural
  /// shape.
  bool keeps_reference() const override { return keys_.natural == "reference"; }
  bool needs_curvature() const override { return true; }

 private:
  HelfrichKeys keys_;
};

const bool registered = register_entry(SurfaceLawEntry{
    "helfrich", "bending energy of a membrane, of the square of its mean curvature",
    example_of<HelfrichKeys>(), key_texts(HelfrichKeys::rows()),
    [](const Block& block) -> std::unique_ptr<SurfaceMaterial> {
      return std::make_unique<HelfrichMaterial>(meniscus::read<HelfrichKeys>(block));
    }});

}  // namespace
}  // namespace meniscus
