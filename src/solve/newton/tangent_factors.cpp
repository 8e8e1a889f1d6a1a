// SPDX-License-Identifier: BSD-3-Clause
// Assembly and factors of the tangent, with held places as stiff springs.
#include "solve/newton/tangent_factors.hpp"

#include "parallel/nodal_algebra.hpp"
#include "solve/least_spacing.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace meniscus {
namespace {

/// A place of a constraint: its particles in ascending order, with weights.
struct HeldPlace {
  std::vector<std::pair<Index, Real>> entries;
  std::vector<Eigen::Vector3d> directions;
};

std::vector<HeldPlace> held_places(const Constraints& constraints) {
  std::vector<HeldPlace> places;
  for (const auto& one : constraints.all()) {
    const std::size_t first = places.size();
    for (Index k = 0; k < one->rows.places(); ++k) {
      HeldPlace place;
      for (Offset e = at(one->rows.start, k); e < at(one->rows.start, k + 1); ++e)
        place.entries.emplace_back(at(one->rows.particle, e), at(one->rows.weight, e));
      std::sort(place.entries.begin(), place.entries.end());
      places.push_back(std::move(place));
    }
    for (const ConstraintRows::Row& row : one->rows.rows)
      at(places, first + static_cast<std::size_t>(row.place)).directions.push_back(row.direction);
  }
  return places;
}

/// Stiffness of the springs of held places, in diagonal entries of K.
constexpr Real stiffness_of_places = 1e6;

bool assembled(const ForceTerm& term) {
  const auto* force = dynamic_cast<const AssembledForce*>(&term);
  return force && force->has_stiffness();
}

}  // namespace

template <int D>
bool TangentFactors<D>::suit(const System<D>& system) {
  std::size_t found = 0;
  for (const auto& term : system.terms) found += is_internal(*term) && assembled(*term);
  return found == system.bodies.size() && fits(system.size());
}

template <int D>
bool TangentFactors<D>::others_resist(System<D>& system, const Motion& motion) {
  const Real small = 1e-3 * least_spacing(system.bodies);
  NodalVectors change(static_cast<std::size_t>(system.size()), Lanes::zero()), force = change;
  for (Index A = 0; A < system.size(); ++A)  // without symmetry
    for (int i = 0; i < D; ++i)
      at(change, A).set(i, small * std::sin(static_cast<Real>(A) * (12.9898 + i * 7.31) + i));
  system.add_tangent(motion, {motion.time, change, motion.v}, force,
                     [](const ForceTerm& term) { return !assembled(term); });
  return largest(force) > 0;
}

template <int D>
TangentFactors<D>::TangentFactors(System<D>& system) : system_(system), K_(system.size(), D) {
  for (auto& term : system.terms) {
    if (!assembled(*term)) continue;
    forces_.push_back(dynamic_cast<AssembledForce*>(term.get()));
    if (is_internal(*term)) internal_.push_back(forces_.back());
  }
  if (system.constraints) lambda_.resize(static_cast<std::size_t>(system.constraints->rows()));
  for (const Body<D>& body : system.bodies)
    for (Index A = 0; A < body.size(); ++A) volume_.push_back(body.cells.volume(A));
  // All rigid motions that the constraints leave. Only some of them are free at a state.
  const NodalVectors still(static_cast<std::size_t>(system.size()), Lanes::zero());
  const FreeMotions<D> left(system, {0, still, still}, least_spacing(system.bodies),
                            [](const ForceTerm&) { return false; });
  if (!is_here()) return;
  for (AssembledForce* force : forces_) force->announce(K_);
  if (system.constraints) {
    std::vector<Index> nodes;
    for (const HeldPlace& place : held_places(*system.constraints)) {
      nodes.clear();
      for (const auto& [A, weight] : place.entries) nodes.push_back(A);
      const Index element = K_.announce(nodes);
      if (held_element_ < 0) held_element_ = element;
    }
  }
  std::vector<Index> particles(still.size());
  std::iota(particles.begin(), particles.end(), 0);
  first_free_ = K_.add_nodes(static_cast<Index>(left.modes().size()));
  for (std::size_t k = 0; k < left.modes().size(); ++k)
    K_.announce_column(first_free_ + static_cast<Index>(k), particles);
  K_.close();
  factors_ = std::make_unique<SparseCholesky>(K_.start(), K_.row(), K_.order());
  b_.resize(static_cast<std::size_t>(K_.unknowns()));
}

template <int D>
void TangentFactors<D>::assemble(Real time, const NodalVectors& u, const OfGroups& off,
                                 const FreeMotions<D>& free) {
  const NodalVectors still(u.size(), Lanes::zero());
  K_.clear();
  for (std::size_t k = 0; k < forces_.size(); ++k)
    forces_[k]->add_stiffness({time, u, still}, off.empty() ? std::span<const Lanes>() : off[k],
                              K_);
  end(free);
}

template <int D>
void TangentFactors<D>::assemble_reference(const FreeMotions<D>& free) {
  const NodalVectors still(static_cast<std::size_t>(system_.size()), Lanes::zero());
  K_.clear();
  for (AssembledForce* force : internal_) force->add_stiffness({0, still, still}, {}, K_);
  end(free);
}

template <int D>
void TangentFactors<D>::end(const FreeMotions<D>& free) {
  if (scale_ == 0) {
    // The first state sets the scales.
    constexpr Real small = 1e-8;
    Real volume = 0;
    for (const Real v : volume_) volume += v;
    if (is_here()) scale_ = K_.mean_diagonal();
    ranks().hand_out(rank, &scale_, sizeof scale_);
    small_shift_ = small * scale_ * static_cast<Real>(volume_.size()) / volume;
  }
  if (!is_here()) return;
  add_held_places();
  for (std::size_t k = 0; k < free.modes().size(); ++k) {
    const Index node = first_free_ + static_cast<Index>(k);
    K_.add_column(node, free.modes()[k]);
    K_.add_to_diagonal(node, -1 / scale_);
  }
  K_.complete();
}

template <int D>
void TangentFactors<D>::add_held_places() {
  if (!system_.constraints) return;
  const std::vector<HeldPlace> places = held_places(*system_.constraints);
  K_.add(held_element_, static_cast<Index>(places.size()),
         [&](Index k, StiffnessMatrix::Element& element) {
           const HeldPlace& place = at(places, k);
           Mat<D> springs = Mat<D>::Zero();
           for (const Eigen::Vector3d& n : place.directions)
             springs += stiffness_of_places * scale_ * n.head<D>() * n.head<D>().transpose();
           const auto m = static_cast<Eigen::Index>(place.entries.size());
           Eigen::VectorXd weights(m);
           for (Eigen::Index a = 0; a < m; ++a) weights[a] = at(place.entries, a).second;
           auto block = element.resize(m * D);
           for (int i = 0; i < D; ++i)
             for (int j = i; j < D; ++j)
               block.block(i * m, j * m, m, m) = springs(i, j) * weights * weights.transpose();
         });
}

template <int D>
Index TangentFactors<D>::factor(Real shift) {
  Index negative = 0;
  if (is_here()) {
    for (Index A = 0; A < system_.size(); ++A) K_.add_to_diagonal(A, shift * at(volume_, A));
    factors_->factor(K_.value());
    for (Index A = 0; A < system_.size(); ++A) K_.add_to_diagonal(A, -shift * at(volume_, A));
    negative = factors_->negative_eigenvalues() - K_.negative_if_stable();
  }
  ranks().hand_out(rank, &negative, sizeof negative);
  return negative;
}

template <int D>
void TangentFactors<D>::solve(const NodalVectors& r, NodalVectors& z) {
  if (is_here()) {
    std::fill(b_.begin(), b_.end(), 0.0);
    for (Index A = 0; A < system_.size(); ++A)
      for (int i = 0; i < D; ++i) at(b_, A * D + i) = at(r, A)[i];
    factors_->solve(b_);
    for (Index A = 0; A < system_.size(); ++A) {
      at(z, A) = Lanes::zero();
      for (int i = 0; i < D; ++i) at(z, A).set(i, at(b_, A * D + i));
    }
  }
  ranks().hand_out(rank, z.data(), z.size() * sizeof(NodalVector));
}

template <int D>
void TangentFactors<D>::apply(const NodalVectors& r, NodalVectors& z) {
  if (!system_.constraints) return solve(r, z);
  balanced_ = r;
  system_.constraints->balance(balanced_, lambda_);
  solve(balanced_, z);
  system_.constraints->project(z);
}

template <int D>
void TangentFactors<D>::meet(Real time, NodalVectors& u) {
  if (!system_.constraints) return;
  constexpr int passes = 3;
  const Constraints& constraints = *system_.constraints;
  std::vector<Real> g(lambda_.size()), Cu = g;
  NodalVectors force(u.size()), change(u.size());
  constraints.targets(time, g);
  for (int pass = 0; pass <= passes; ++pass) {
    constraints.apply(u, Cu);
    for (std::size_t r = 0; r < g.size(); ++r) lambda_[r] = g[r] - Cu[r];
    if (pass == passes) {  // the rest, with the smallest change in the norm of the masses
      constraints.solve(lambda_);
      constraints.add_over_mass(lambda_, 1, u);
      return;
    }
    clear(force);
    constraints.add_transposed(lambda_, stiffness_of_places * scale_, force);
    solve(force, change);
    add(u, 1, change);
  }
}

template class TangentFactors<2>;
template class TangentFactors<3>;

}  // namespace meniscus
