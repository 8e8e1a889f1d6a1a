// SPDX-License-Identifier: BSD-3-Clause
// Nematic liquid crystal: a Newtonian fluid with a director (Fan 2014, (4.18)-(4.27), corrected in
// cells note 5). The law "newtonian" gives the stress of the fluid; the director is a separate
// field.
#include "body/particle_values.hpp"
#include "meniscus/physics/law_registry.hpp"

#include <cmath>

namespace meniscus {
namespace {

constexpr const char* fluid_law = "newtonian";
constexpr const char* director_key = "initial_director";
/// Largest accepted length of an initial director. Directors are about unit vectors; a longer one
/// was given without being normalised.
constexpr Real longest_director = 2;

struct NematicKeys : NematicNumbers {
  static Rows<NematicKeys> rows() {
    using N = NematicKeys;
    return {
        real_row<N>("frank_constant", &N::frank_constant, dimension::force, range::positive,
                    "K of the energy K/2 |grad h|^2 per volume of the director h"),
        real_row<N>("core_length", &N::core_length, dimension::length, range::non_negative,
                    "eps of the energy K/(4 eps^2) (|h|^2 - 1)^2 that keeps its length, about the "
                    "size of the core of a defect; 0: two mean spacings",
                    0.0),
        real_row<N>("rotational_viscosity", &N::rotational_viscosity, dimension::viscosity,
                    range::positive, "gamma_1: the director relaxes at the rate -(dE/dh)/gamma_1"),
        real_row<N>("flow_alignment", &N::flow_alignment, dimension::none, range::any,
                    "lambda of its rate (w + lambda d) h in a flow of spin w and rate of "
                    "deformation d: 1 of material lines, -1 of normals of material planes; between "
                    "them it tumbles in a shear flow",
                    1.0),
        real_row<N>("dilatation_coupling", &N::dilatation_coupling, dimension::none, range::any,
                    "nu2 of its rate -nu2 tr(d) h", 0.0)};
  }
};

/// The unit vector along the last axis.
std::vector<Expression> upright(int dimension) {
  std::vector<Expression> axis(static_cast<std::size_t>(dimension), 0.0);
  axis.back() = 1.0;
  return axis;
}

template <int D>
class Nematic final : public Material<D> {
 public:
  explicit Nematic(const Block& block)
      : fluid_(laws().at(fluid_law).template material<D>(block)),
        numbers_(read<NematicKeys>(block)),
        director_(
            block.expressions(director_key, D, dimension::none, upright(D), Variables::place)),
        place_(block.place(director_key)) {}

  [[gnu::cold]] typename Material<D>::Built build(Body<D>& body,
                                                  const Integration& integration) const override {
    auto nematic = std::make_unique<NematicBody<D>>();
    nematic->numbers = numbers_;
    nematic->core_by_cells = !(numbers_.core_length > 0);
    if (nematic->core_by_cells) nematic->numbers.core_length = 2 * first_spacing(body);
    nematic->rule = build_cell_rule(body).rule;
    nematic->volume = volumes(body);
    for (Index A = 0; A < body.size(); ++A) nematic->director.push_back(director(body.origin(A)));
    typename Material<D>::Built built = fluid_->build(body, integration);
    built.nematic = std::move(nematic);
    return built;
  }
  bool fluid() const override { return true; }
  bool carries_director() const override { return true; }

 private:
  /// Volumes sum_P V_P N_A(X_P) of the particles. With these volumes uniform states relax
  /// uniformly. A particle has at least 0.3 of the volume of its cell, like lumped masses.
  static std::vector<Real> volumes(const Body<D>& body) {
    constexpr Real floor = 0.3;
    std::vector<Real> volume(static_cast<std::size_t>(body.size()), 0.0);
    const auto all_rows = rows_of_all_particles(body);
    const PointRows<D>& rows = *all_rows;
    for (Index P = 0; P < body.size(); ++P)
      for (Offset e = at(rows.start, P); e < at(rows.start, P + 1); ++e)
        at(volume, at(rows.particle, e)) += first_volume(body, P) * at(rows.value, e);
    for (Index A = 0; A < body.size(); ++A)
      at(volume, A) = std::max(at(volume, A), floor * first_volume(body, A));
    return volume;
  }
  /// Volume of a nodal cell in the reference of the scene; first_spacing() is the mean spacing
  /// there.
  static Real first_volume(const Body<D>& body, Index A) {
    return body.cells.volume(A) / body.volume_ratio(A);
  }
  static Real first_spacing(const Body<D>& body) {
    Real now = 0, first = 0;
    for (Index A = 0; A < body.size(); ++A) {
      now += body.cells.volume(A);
      first += first_volume(body, A);
    }
    return mean_spacing(body.geometry.grid) * std::pow(first / now, 1.0 / D);
  }
  Vec<D> director(const Vec<D>& X) const {
    Vec<D> h;
    for (int i = 0; i < D; ++i) h[i] = at(director_, i).unchecked(spatial<D>(X));
    if (const Real length = h.norm(); !(length <= longest_director)) {
      const Eigen::Vector3d place = spatial<D>(X);
      throw InputError(fmt::format(
          "{}: has the length {:.6g} at X = ({:.6g}, {:.6g}, {:.6g}); expected is about 1 where "
          "the "
          "director is undisturbed, and at most {:.6g}: divide the formulas by their length",
          place_, length, place[0], place[1], place[2], longest_director));
    }
    return h;
  }

  std::unique_ptr<Material<D>> fluid_;
  NematicNumbers numbers_;
  std::vector<Expression> director_;
  std::string place_;
};

template <int D>
std::unique_ptr<Material<D>> make(const Block& block) {
  return std::make_unique<Nematic<D>>(block);
}

std::vector<KeyText> nematic_keys() {
  std::vector<KeyText> keys = laws().at(fluid_law).keys();
  for (KeyText& key : key_texts(NematicKeys::rows())) keys.push_back(std::move(key));
  keys.push_back(
      {director_key, "numbers or formulas", "1", "", "along the last axis",
       "director h at the start at each particle, one number or formula of the reference "
       "position per dimension; of length 1, but 0 in the core of a defect"});
  return keys;
}

const bool registered = register_entry(LawEntry{
    "nematic", true,
    "a newtonian liquid with a director h; K/2 |grad h|^2 + K/(4 eps^2) (|h|^2 - 1)^2 per volume",
    nematic_keys,
    "density = 1.25\nbulk_modulus = 2.5\nviscosity = 0.5\nfrank_constant = 0.2\n"
    "core_length = 0.6\nrotational_viscosity = 0.5\n",
    [] { return laws().at(fluid_law).typical(); },
    [](const Block& block) { return laws().at(fluid_law).read(block); }, make<2>, make<3>});

}  // namespace
}  // namespace meniscus
