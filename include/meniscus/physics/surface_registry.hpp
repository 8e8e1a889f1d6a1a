// SPDX-License-Identifier: BSD-3-Clause
// The registry of surface laws.
#pragma once
#include "input/key_table.hpp"
#include "input/registry.hpp"
#include "physics/director/carried_field.hpp"
#include "physics/surface/surface_law_force.hpp"
#include "physics/surface/surface_viscosity.hpp"

#include <memory>
#include <optional>
#include <string_view>
#include <vector>

namespace meniscus {

/// A law with its parameters, ready to be applied to the surface of a body.
class SurfaceMaterial {
 public:
  virtual ~SurfaceMaterial() = default;
  virtual std::unique_ptr<ForceTerm> build(const Body<2>& body,
                                           const SurfaceSites& sites) const = 0;
  virtual std::unique_ptr<ForceTerm> build(const Body<3>& body,
                                           const SurfaceSites& sites) const = 0;
  /// Energy per area of the undeformed surface, if the law defines it.
  virtual Real energy_at_rest() const { return 0; }
  /// See ModuliSurfaceLaw.
  virtual std::optional<Real> unstable_modulus() const { return std::nullopt; }
  /// True if the law depends on the deformation of the surface since the reference.
  virtual bool keeps_reference() const { return true; }
  /// True if the law depends on the curvature of the surface. Its energy is then a sum over Gauss
  /// points that has a lower bound only if there are several for each unknown.
  virtual bool needs_curvature() const { return false; }
};

/// A term whose surface tension varies over the surface.
class VariedTension {
 public:
  struct Least {
    Real gamma;
    Index particle;  ///< the nearest one, numbered in the body
  };
  virtual ~VariedTension() = default;
  virtual Least least(const Motion& motion) const = 0;
};

/// A term whose energy also depends on the director of its body.
class AnchoredTerm {
 public:
  virtual ~AnchoredTerm() = default;
  /// Adds the energy of this term to the energies of `director`. Call this before any other
  /// function.
  virtual void anchor(CarriedField& director) = 0;
};

struct SurfaceLawEntry {
  static constexpr const char* kind = "surface law";
  std::string_view name, meaning, example;
  std::vector<KeyText> keys;
  std::unique_ptr<SurfaceMaterial> (*read)(const Block&);  ///< notes problems in the block
};

inline const Registry<SurfaceLawEntry>& surface_laws() {
  return Registry<SurfaceLawEntry>::all();
}

template <SurfaceLaw L>
class SurfaceMaterialOf final : public SurfaceMaterial {
 public:
  explicit SurfaceMaterialOf(const L& law) : law_(law) {}

  std::unique_ptr<ForceTerm> build(const Body<2>& body, const SurfaceSites& sites) const override {
    return std::make_unique<SurfaceForce<2, L>>(body, law_, sites);
  }
  std::unique_ptr<ForceTerm> build(const Body<3>& body, const SurfaceSites& sites) const override {
    return std::make_unique<SurfaceForce<3, L>>(body, law_, sites);
  }
  Real energy_at_rest() const override {
    SurfaceState<Lanes> rest{};
    rest.cofactor = Tensor<Lanes>::identity();
    rest.N = rest.m = {Lanes(1.0), Lanes::zero(), Lanes::zero()};
    rest.stretch = Lanes(1.0);
    return law_.energy_density(rest)[0];
  }
  std::optional<Real> unstable_modulus() const override {
    if constexpr (ModuliSurfaceLaw<L>) return law_.unstable_modulus();
    return std::nullopt;
  }

 private:
  L law_;
};

template <ViscousSurfaceLaw L>
class ViscousSurfaceOf final : public SurfaceMaterial {
 public:
  explicit ViscousSurfaceOf(const L& law) : law_(law) {}

  std::unique_ptr<ForceTerm> build(const Body<2>& body, const SurfaceSites& sites) const override {
    return std::make_unique<SurfaceViscosity<2, L>>(body, law_, sites);
  }
  std::unique_ptr<ForceTerm> build(const Body<3>& body, const SurfaceSites& sites) const override {
    return std::make_unique<SurfaceViscosity<3, L>>(body, law_, sites);
  }
  bool keeps_reference() const override { return false; }

 private:
  L law_;
};

template <class L, class Made>
bool register_surface_law_as(std::string_view meaning) {
  return register_entry(SurfaceLawEntry{L::type_name, meaning, example_of<L>(),
                                        key_texts(L::rows()),
                                        [](const Block& block) -> std::unique_ptr<SurfaceMaterial> {
                                          return std::make_unique<Made>(meniscus::read<L>(block));
                                        }});
}

/// Registers the law: the last line of every file in src/physics/laws/surfaces.
template <SurfaceLaw L>
bool register_surface_law(std::string_view meaning) {
  return register_surface_law_as<L, SurfaceMaterialOf<L>>(meaning);
}
template <ViscousSurfaceLaw L>
bool register_surface_viscosity(std::string_view meaning) {
  return register_surface_law_as<L, ViscousSurfaceOf<L>>(meaning);
}

}  // namespace meniscus
