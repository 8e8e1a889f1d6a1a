// SPDX-License-Identifier: BSD-3-Clause
// Surfaces that cannot be: bodies that go through themselves or through each other.
#pragma once
#include "body/body.hpp"
#include "body/surface/crossings.hpp"
#include "meniscus/physics/force_term.hpp"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace meniscus {

/// Watches the surfaces of all bodies, as flat simplices between the places of their boundary
/// particles. A motion is impossible where a simplex goes through another one (CrossingSearch), or
/// where a closed face is turned inside out: its enclosed volume, negative for the face around a
/// cavity, has another sign than in the reference.
template <int D>
class SurfaceCheck {
 public:
  /// `bodies` must outlive the check. `remedy` of the numbers of two bodies, which may be the same,
  /// ends the message about their crossing.
  SurfaceCheck(std::vector<const Body<D>*> bodies,
               std::function<std::string(std::size_t, std::size_t)> remedy);

  /// The deepest crossing; if there is none, a face that is turned inside out. All ranks call this
  /// and find the same.
  std::optional<Failure> find(const Motion& motion) const;
  /// The deepest crossing alone.
  std::optional<Failure> crossing(const Motion& motion) const {
    return crossing_at(places(motion));
  }

 private:
  struct Place {
    std::size_t body;
    Index particle;  // of the body
  };
  std::vector<Vec<D>> places(const Motion& motion) const;
  std::optional<Failure> crossing_at(const std::vector<Vec<D>>& x) const;
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
