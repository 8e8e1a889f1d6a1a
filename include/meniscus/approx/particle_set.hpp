// SPDX-License-Identifier: BSD-3-Clause
// The particles of one body in the reference configuration, and their kernel supports.
#pragma once
#include "meniscus/approx/neighbor_search.hpp"
#include "meniscus/approx/reproducing_kernel.hpp"

#include <optional>
#include <span>
#include <vector>

namespace meniscus {

/// Reference positions and supports, with the search tree over them. Never changes once rows are
/// built on it.
///
/// Supports are balls after the body has been pressed back by a stretch U: shape functions are
/// those of the places U^-1 X, N_A(x) = M_A(U^-1 x), and lengths of supports are measured there.
/// Those of a stretched ball are then as good as those of the ball.
template <int D>
class ParticleSet {
 public:
  /// Support of particle A = factor x distance to its rank-th nearest neighbour.
  struct AdaptiveSupport {
    Real factor = 1.8;
    int rank = D == 3 ? 20 : 8;
  };

  /// `stretch` U: symmetric, det U = 1.
  ParticleSet(std::vector<Vec<D>> X, const AdaptiveSupport& rule, Window window,
              const Mat<D>& stretch = Mat<D>::Identity());
  /// The same support for all particles.
  ParticleSet(std::vector<Vec<D>> X, Real support, Window window,
              const Mat<D>& stretch = Mat<D>::Identity());

  /// A support for each particle.
  ParticleSet(std::vector<Vec<D>> X, std::span<const Real> support, Window window,
              const Mat<D>& stretch = Mat<D>::Identity());

  Index size() const { return static_cast<Index>(X_.size()); }
  std::span<const Vec<D>> X() const { return X_; }
  std::span<const Real> support() const { return support_; }
  Window window() const { return window_; }
  const NeighborSearch<D>& search() const { return search_; }

  /// U^-1; null where supports are balls in space.
  const Mat<D>* pressed() const { return pressed_ ? &pressed_->inverse_stretch : nullptr; }
  /// U^-1 x: where kernels are evaluated.
  Vec<D> kernel_place(const Vec<D>& x) const {
    return pressed_ ? Vec<D>(pressed_->inverse_stretch * x) : x;
  }
  template <std::size_t n>
  std::array<Vec<D>, n> kernel_places(std::array<Vec<D>, n> x) const {
    if (pressed_)
      for (Vec<D>& place : x) place = kernel_place(place);
    return x;
  }

  /// From now on no support exceeds `limit`, one number per particle, e.g. the distance to the
  /// other side of a cavity. Returns how many supports were shortened.
  Index limit_supports(std::vector<Real> limit);

  /// All particles whose support reaches into the ball around `centre`, by ascending number; with
  /// stretched supports also some that do not. Places of candidates are kernel places.
  void candidates(const Vec<D>& centre, Real radius, std::vector<Candidate<D>>& found) const;
  /// The same from those of a ball that this one lies in.
  void candidates(const Vec<D>& centre, Real radius, std::span<const Candidate<D>> around,
                  std::vector<Candidate<D>>& found) const;
  /// All particles whose support reaches one of the points, by ascending number.
  void candidates(const std::array<Vec<D>, 4>& points, std::vector<Candidate<D>>& found) const;

  /// Deficiency monitor (RKPM note 2.4) at `points`: where the moment matrix is poor, the supports
  /// of the particles around are enlarged in steps of 10 % until it is not, at most to 2.6 times
  /// the support asked for and to the limit. Returns how many particles were enlarged. Throws
  /// SolveError naming `body`, the point and its neighbour count when a point stays unusable.
  Index ensure_quality(std::span<const Vec<D>> points, const std::string& body);

  /// Throws SolveError naming `body`, the point x and its neighbour count if `quality` (of the
  /// moment matrix at x) is below unusable_quality or not a number.
  void require_quality(Real quality, const Vec<D>& x, const std::string& body,
                       Real least = unusable_quality) const {
    if (!(quality >= least)) refuse(quality, x, body);
  }

  static constexpr Real unusable_quality = 1e-3;
  static constexpr Real poor_quality = 1e-2;

 private:
  /// The places U^-1 X of stretched supports.
  struct Pressed {
    Mat<D> inverse_stretch;
    Real growth;  ///< of a length at most
    std::vector<Vec<D>> X;
    NeighborSearch<D> search;
  };
  static std::optional<Pressed> press(const Mat<D>& stretch, std::span<const Vec<D>> X);
  std::span<const Vec<D>> kernel_X() const { return pressed_ ? pressed_->X : X_; }
  const NeighborSearch<D>& kernel_search() const { return pressed_ ? pressed_->search : search_; }

  template <class Keep>
  void find(const Vec<D>& centre, Real radius, Keep&& keep, std::vector<Candidate<D>>& found) const;
  void find_quality(std::span<const Vec<D>> points, std::span<const Index> numbers,
                    std::vector<Real>& quality) const;
  [[noreturn]] void refuse(Real quality, const Vec<D>& x, const std::string& body) const;

  std::vector<Vec<D>> X_;
  std::vector<Real> support_;
  std::vector<Real> limit_;  // empty: none
  Real largest_support_ = 0;
  Window window_;
  NeighborSearch<D> search_;
  std::optional<Pressed> pressed_;
};

extern template class ParticleSet<2>;
extern template class ParticleSet<3>;

}  // namespace meniscus
