// SPDX-License-Identifier: BSD-3-Clause
// Carried fields: unknowns that the material of a body takes along as it deforms, and that relax
// towards their least energy where it is, such as the director of a nematic (cells note 5).
#pragma once
#include "meniscus/physics/force_term.hpp"

#include <vector>

namespace meniscus {

/// An energy of a carried field, while places stand still. All arrays are those of one body.
class FieldEnergy {
 public:
  virtual ~FieldEnergy() = default;

  /// From now on at the displacements `u`.
  virtual void hold_places(const NodalVector* u) = 0;
  /// E of the values x of the field.
  virtual Real held_energy(const NodalVector* x) const = 0;
  /// f -= dE/dx.
  virtual void add_held_force(const NodalVector* x, std::span<NodalVector> f) = 0;
};

/// A field of one body with c x' = f while places stand still. Within a step of dt the field is
/// carried to half-way between the places of its beginning and of its end, relaxes there over dt,
/// and is carried on: second order, with one force per step (cells note 5.4).
class CarriedField {
 public:
  /// `number` is that of System::add_field. The body has the particles from `first` on, with the
  /// capacities c. `name` and `slower`, keys that make the field slower, are for messages.
  CarriedField(std::size_t number, Index first, std::vector<Real> capacity, std::string name,
               std::string slower);
  virtual ~CarriedField() = default;

  std::size_t number() const { return number_; }
  /// The part of an array over all particles that belongs to the body.
  template <class T>
  std::span<T> part(std::span<T> all) const {
    return all.subspan(static_cast<std::size_t>(first_), capacity_.size());
  }

  /// x, carried from the displacements `from` of the body to `to`.
  virtual void carry(const NodalVector* from, const NodalVector* to,
                     std::span<NodalVector> x) const = 0;
  /// What the forces on the field, which are all in `force` already, do to the places that carry
  /// it. Nothing if `force` has no fields.
  virtual void add_reaction(const Motion& motion, Forces force) = 0;

  /// All energies of the field; a term that is one outlives this.
  void add(FieldEnergy& energy) { energies_.push_back(&energy); }
  void hold_places(const NodalVector* u);
  /// Of all energies at the places held.
  Real held_energy(const NodalVector* x) const;
  void held_force(const NodalVector* x, std::span<NodalVector> f) const;

  /// A step begins at the displacements `u` of all particles.
  void depart(std::span<const NodalVector> u);
  /// It ends at `u`, after dt: takes `x` of all particles there and returns the heat.
  Real arrive(std::span<const NodalVector> u, Real dt, std::span<NodalVector> x);

  /// The longest step of explicit Euler, dx' = f/c, from which the number of stages follows.
  void set_limit(Real limit) { limit_ = limit; }
  /// Number of stages in which the field relaxes over dt, by super time steps of second order
  /// (RKL2). Throws SolveError if they are more than 10,000.
  int stages(Real dt) const;
  virtual void archive(const Archive& a);

  virtual std::size_t bytes() const;

 private:
  /// At the places held.
  void relax(Real dt, std::span<NodalVector> x);

  std::size_t number_;
  Index first_;
  std::vector<Real> capacity_;
  std::string name_, slower_;
  std::vector<FieldEnergy*> energies_;
  Real limit_ = 0;
  NodalVectors from_, middle_;                        // places
  NodalVectors start_, first_rate_, before_, force_;  // of the stages
};

}  // namespace meniscus
