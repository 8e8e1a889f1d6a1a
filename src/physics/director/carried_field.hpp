// SPDX-License-Identifier: BSD-3-Clause
// Carried fields: unknowns that are transported with the material of a body and relax towards their
// lowest energy, such as the director of a nematic (cells note 5).
#pragma once
#include "meniscus/physics/force_term.hpp"

#include <vector>

namespace meniscus {

/// An energy of a carried field at fixed positions of the material. Arrays cover the particles of
/// one body.
class FieldEnergy {
 public:
  virtual ~FieldEnergy() = default;

  /// Fixes the positions at the displacements `u` for the calls below.
  virtual void hold_places(const NodalVector* u) = 0;
  /// The energy E of the values x of the field.
  virtual Real held_energy(const NodalVector* x) const = 0;
  /// f -= dE/dx, on the particles over which a process adds up the forces.
  virtual void add_held_force(const NodalVector* x, const ForceVector& f) = 0;
};

/// A field of one body with c x' = f at fixed positions. A step of dt has three parts. The field is
/// carried to half-way between the old and the new positions, relaxes there over dt, and is carried
/// to the new positions. This is of second order with one force per step (cells note 5.4).
class CarriedField {
 public:
  /// `number` is the return value of System::add_field. The particles of the body begin at `first`;
  /// `capacity` has their c. `name`, and `slower`, the keys that make the field slower, appear in
  /// messages.
  CarriedField(std::size_t number, Index first, std::vector<Real> capacity, std::string name,
               std::string slower);
  virtual ~CarriedField() = default;

  std::size_t number() const { return number_; }
  /// The part of an array over all particles that belongs to the body.
  template <class T>
  std::span<T> part(std::span<T> all) const {
    return all.subspan(static_cast<std::size_t>(first_), capacity_.size());
  }

  /// Transports x from the displacements `from` of the body to the displacements `to`.
  virtual void carry(const NodalVector* from, const NodalVector* to,
                     std::span<NodalVector> x) const = 0;
  /// Gives the values x that a process has at its particles to all processes.
  virtual void gather(std::span<NodalVector> x) const = 0;
  /// Adds the reaction of the field on the motion of the body, which follows from the forces on the
  /// field. `force` must contain all forces on the field. Does nothing if `force` has no fields.
  virtual void add_reaction(const Motion& motion, Forces force) = 0;

  /// Adds an energy of the field. `energy` must outlive this object.
  void add(FieldEnergy& energy) { energies_.push_back(&energy); }
  /// Sets the displacements `u` of the body at which held_energy() and held_force() are computed.
  void hold_places(const NodalVector* u);
  /// Sum of all energies added with add(), for the values x [particle of the body] of the field at
  /// the positions of the last hold_places().
  Real held_energy(const NodalVector* x) const;
  /// Sets f [particle of the body] to minus the gradient of held_energy() with respect to x.
  void held_force(const NodalVector* x, std::span<NodalVector> f) const;

  /// Begins a step at the displacements `u` of all particles.
  void depart(std::span<const NodalVector> u);
  /// Ends the step at the displacements `u` after dt: transports and relaxes `x` of all particles.
  /// Returns the heat.
  Real arrive(std::span<const NodalVector> u, Real dt, std::span<NodalVector> x);

  /// Sets the longest stable step of explicit Euler, dx' = f/c. It determines the number of stages.
  void set_limit(Real limit) { limit_ = limit; }
  /// Number of stages with which the field relaxes over dt, by super time steps of second order
  /// (RKL2). Throws SolveError if more than 10,000 are needed.
  int stages(Real dt) const;
  virtual void archive(const Archive& a);

  virtual std::size_t bytes() const;

 private:
  /// Relaxes x over dt at the fixed positions.
  void relax(Real dt, std::span<NodalVector> x);

  std::size_t number_;
  Index first_;
  std::vector<Real> capacity_;
  std::string name_, slower_;
  std::vector<FieldEnergy*> energies_;
  Real limit_ = 0;
  NodalVectors from_, middle_;                        // displacements
  NodalVectors start_, first_rate_, before_, force_;  // of the stages
};

}  // namespace meniscus
