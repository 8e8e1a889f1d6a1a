// SPDX-License-Identifier: BSD-3-Clause
// The registry of material laws.
#pragma once
#include "input/key_table.hpp"
#include "input/registry.hpp"
#include "physics/internal/elastic_moduli.hpp"
#include "physics/internal/law.hpp"
#include "physics/internal/material.hpp"

#include <fmt/core.h>

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace meniscus {

/// A law with its parameters, without its type as a template argument. For tests, wave speeds and
/// other code outside the time loop. H = F - I; the functions are explained in law.hpp.
class AnyLaw {
 public:
  virtual ~AnyLaw() = default;

  virtual Real density() const = 0;
  virtual Real p_wave_modulus() const = 0;
  virtual Real energy_density(const Tensor<Real>& H) const = 0;
  virtual Lanes energy_density(const Tensor<Lanes>& H) const = 0;
  virtual Complex energy_density(const Tensor<Complex>& H) const = 0;
  virtual Tensor<Real> stress(const Tensor<Real>& H) const = 0;
  virtual Tensor<Lanes> stress(const Tensor<Lanes>& H) const = 0;
  virtual Tensor<Complex> stress(const Tensor<Complex>& H) const = 0;
  /// Zero for laws without viscosity.
  virtual Tensor<Real> viscous_stress(const Tensor<Real>& H, const Tensor<Real>& F_rate) const = 0;
  virtual Tensor<Lanes> viscous_stress(const Tensor<Lanes>& H,
                                       const Tensor<Lanes>& F_rate) const = 0;
  /// dW/dt at fixed deformation; zero for laws that are constant in time.
  virtual Lanes energy_rate(const Tensor<Lanes>& H) const = 0;
  /// The law with its parameters at a time.
  virtual std::unique_ptr<AnyLaw> at_time(Real time) const = 0;
  virtual std::optional<std::string> check() const = 0;
  virtual std::optional<std::string> warning(const Tensor<Real>& H) const = 0;
};

/// The entry of a law in the registry.
struct LawEntry {
  static constexpr const char* kind = "material law";
  std::string_view name;
  bool viscous;
  std::string_view meaning;  ///< its energy W per reference volume, in words and formula
  std::vector<KeyText> (*keys)();
  std::string example;                            ///< keys and typical numbers, lines of a scene
  std::unique_ptr<AnyLaw> (*typical)();           ///< with the typical numbers of its rows
  std::unique_ptr<AnyLaw> (*read)(const Block&);  ///< uniform numbers from a scene; notes problems
  std::unique_ptr<Material<2>> (*material_2d)(const Block&);  ///< for a body; notes problems
  std::unique_ptr<Material<3>> (*material_3d)(const Block&);

  template <int D>
  std::unique_ptr<Material<D>> material(const Block& block) const {
    if constexpr (D == 2)
      return material_2d(block);
    else
      return material_3d(block);
  }
};

inline const Registry<LawEntry>& laws() {
  return Registry<LawEntry>::all();
}

template <Law L>
class AnyLawOf final : public AnyLaw {
 public:
  explicit AnyLawOf(const L& law) : law_(law) {}

  Real density() const override { return law_.density; }
  Real p_wave_modulus() const override { return law_.p_wave_modulus(); }
  Real energy_density(const Tensor<Real>& H) const override { return law_.energy_density(H); }
  Lanes energy_density(const Tensor<Lanes>& H) const override { return law_.energy_density(H); }
  [[gnu::cold]] Complex energy_density(const Tensor<Complex>& H) const override {
    return law_.energy_density(H);
  }
  Tensor<Real> stress(const Tensor<Real>& H) const override { return law_.stress(H); }
  Tensor<Lanes> stress(const Tensor<Lanes>& H) const override { return law_.stress(H); }
  [[gnu::cold]] Tensor<Complex> stress(const Tensor<Complex>& H) const override {
    return law_.stress(H);
  }
  Tensor<Real> viscous_stress(const Tensor<Real>& H, const Tensor<Real>& F_rate) const override {
    return viscous(H, F_rate);
  }
  Tensor<Lanes> viscous_stress(const Tensor<Lanes>& H, const Tensor<Lanes>& F_rate) const override {
    return viscous(H, F_rate);
  }
  Lanes energy_rate([[maybe_unused]] const Tensor<Lanes>& H) const override {
    if constexpr (RampedLaw<L>)
      return law_.energy_rate(H);
    else
      return Lanes::zero();
  }
  std::unique_ptr<AnyLaw> at_time([[maybe_unused]] Real time) const override {
    if constexpr (RampedLaw<L>)
      return std::make_unique<AnyLawOf>(law_.at_time(time));
    else
      return std::make_unique<AnyLawOf>(law_);
  }
  std::optional<std::string> check() const override { return meniscus::check(law_); }
  std::optional<std::string> warning(const Tensor<Real>& H) const override {
    if constexpr (WarningLaw<L>)
      return law_.warning(H);
    else
      return {};
  }

 private:
  template <class T>
  Tensor<T> viscous(const Tensor<T>& H, const Tensor<T>& F_rate) const {
    if constexpr (ViscousLaw<L>)
      return law_.viscous_stress(H, F_rate);
    else
      return Tensor<T>::zero();
  }

  L law_;
};

/// The numbers of typical_law() as lines of a scene.
template <Law L>
std::string typical_text() {
  std::string text;
  for (const Row<L>& row : L::rows())
    if (row.member && row.number != row.typical)
      text += fmt::format("{} = {}\n", row.key, row.typical);
  return text;
}

/// Supplies keys that follow from other keys of the scene.
template <Law L>
void supply_numbers([[maybe_unused]] const Block& block) {
  if constexpr (LawOfModuli<L>) supply_moduli(block, L::of_moduli);
}

template <int D, Law L>
std::unique_ptr<Material<D>> read_with_supply(const Block& block) {
  supply_numbers<L>(block);
  return read_material<D, L>(block);
}

template <Law L>
std::vector<KeyText> key_texts_of() {
  std::vector<KeyText> keys = key_texts(L::rows());
  if constexpr (LawOfModuli<L>) add_moduli(keys, L::of_moduli);
  if constexpr (DirectedLaw<L>)
    keys.push_back({ReferenceDirector::key, "numbers or formulas", "1", "", "normal of the walls",
                    "reference director h0, one number or formula per dimension, of any length; "
                    "required for shapes without walls"});
  return keys;
}

template <Law L>
LawEntry make_entry() {
  LawEntry entry{L::type_name,          L::viscous, L::meaning, key_texts_of<L>,
                 typical_text<L>(),     nullptr,    nullptr,    read_with_supply<2, L>,
                 read_with_supply<3, L>};
  entry.typical = []() -> std::unique_ptr<AnyLaw> {
    return std::make_unique<AnyLawOf<L>>(typical_law<L>());
  };
  entry.read = [](const Block& block) -> std::unique_ptr<AnyLaw> {
    supply_numbers<L>(block);
    L law = meniscus::read<L>(block);
    if constexpr (DirectedLaw<L>)
      if (block.has(ReferenceDirector::key)) {
        const auto h = ReferenceDirector(block, 3).template at<3>(Vec<3>::Zero(), {});
        law.director = {h[0], h[1], h[2]};
      }
    if (const auto wrong = check(law)) block.problem("", *wrong);
    return std::make_unique<AnyLawOf<L>>(law);
  };
  return entry;
}

/// Registers a law. This is the last line of every file in src/physics/laws/materials.
template <Law L>
bool register_law() {
  return register_entry(make_entry<L>());
}

}  // namespace meniscus
