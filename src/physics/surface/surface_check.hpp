// SPDX-License-Identifier: BSD-3-Clause
// Detects impossible surfaces: bodies that pass through themselves or through each other.
#pragma once
#include "body/body.hpp"
#include "body/surface/crossings.hpp"
#include "meniscus/physics/force_term.hpp"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace meniscus {

/// Checks the surfaces of all bodies, as flat simplices between the positions of their boundary
/// particles. A motion is impossible if a simplex crosses another one (CrossingSearch), or if a
/// closed face is turned inside out. The enclosed volume of such a face has another sign than in
/// the reference; it is negative for the face around a cavity.
template <int D>
class SurfaceCheck {
 public:
  /// `bodies` must outlive the check. remedy(i, j) returns the end of the message about a crossing
  /// of bodies i and j, which may be the same body.
  SurfaceCheck(std::vector<const Body<D>*> bodies,
               std::function<std::string(std::size_t, std::size_t)> remedy);

  /// A place beyond the axis of a body of revolution; else the deepest crossing; else a face that
  /// is turned inside out. All processes call this and get the same result.
  std::optional<Failure> find(const Motion& motion) const;
  /// Like find(), but does not look for faces that are turned inside out.
  std::optional<Failure> crossing(const Motion& motion) const {
    return crossing_at(places(motion));
  }

 private:
  struct Place {
    std::size_t body;
    Index particle;  // of the body
  };
  bool revolved() const { return bodies_.front()->geometry.grid.revolved; }
  std::vector<Vec<D>> places(const Motion& motion) const;
  std::optional<Failure> crossing_at(const std::vector<Vec<D>>& x) const;
  std::optional<Failure> beyond_axis(const std::vector<Vec<D>>& x) const;
  std::optional<Failure> turned_face(const std::vector<Vec<D>>& x) const;
  Failure describe(const Crossing<D>& crossing, const std::vector<Vec<D>>& x) const;
  std::string particles_of(Index simplex) const;

  std::vector<const Body<D>*> bodies_;
  std::function<std::string(std::size_t, std::size_t)> remedy_;
  std::vector<std::vector<Index>> boundary_;  // [body] particles
  std::vector<Place> place_;                  // [place]
  std::vector<Index> face_begin_;             // [closed face + 1] number of its first simplex
  std::vector<Real> volume_;                  // [closed face] enclosed in the reference
  std::optional<CrossingSearch<D>> search_;
};

}  // namespace meniscus
