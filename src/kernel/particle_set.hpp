// SPDX-License-Identifier: BSD-3-Clause
// The particles of one body in the reference configuration, and their kernel supports.
#pragma once
#include "kernel/neighbor_search.hpp"
#include "kernel/reproducing_kernel.hpp"

#include <optional>
#include <span>
#include <vector>

namespace meniscus {

/// The places of particles. In the half plane of a body of revolution (axisymmetry note 2), each
/// particle off the axis x = 0 also has an image at (-x, y): a "mirrored" cloud.
template <int D>
struct ParticleCloud {
  ParticleCloud(std::vector<Vec<D>> particles, bool is_mirrored = false);

  std::vector<Vec<D>> X;  ///< of the particles, then of the images
  Index count;            ///< number of particles
  bool mirrored;
  std::vector<Index> source;  ///< [image] its particle, ascending
};

/// Reference positions and supports of particles, with the search tree over them. The set must not
/// change once rows are built on it.
///
/// With a stretch U, supports are ellipsoids. Shape functions are evaluated at kernel places U^-1
/// X: N_A(x) = M_A(U^-1 x). In kernel places, supports are balls, and their radii are measured
/// there. The shape functions of a stretched ball are then as good as the shape functions of the
/// unstretched ball.
///
/// In a mirrored cloud, searches and candidates contain images, whose numbers follow those of the
/// particles. Rows do not: they are folded (point_rows.hpp).
template <int D>
class ParticleSet {
 public:
  /// Support of particle A = factor x distance to its rank-th nearest neighbour.
  struct AdaptiveSupport {
    Real factor = 1.8;
    int rank = D == 3 ? 20 : 8;
  };

  /// Sets the supports by `rule`. The stretch U is symmetric with det U = 1.
  ParticleSet(ParticleCloud<D> cloud, const AdaptiveSupport& rule, KernelFunction kernel_function,
              const Mat<D>& stretch = Mat<D>::Identity());
  /// Gives all particles the same support.
  ParticleSet(ParticleCloud<D> cloud, Real support, KernelFunction kernel_function,
              const Mat<D>& stretch = Mat<D>::Identity());

  /// Sets the supports to support[particle].
  ParticleSet(ParticleCloud<D> cloud, std::span<const Real> support, KernelFunction kernel_function,
              const Mat<D>& stretch = Mat<D>::Identity());

  Index size() const { return cloud_.count; }
  std::span<const Vec<D>> X() const { return of_particles<Vec<D>>(cloud_.X); }
  std::span<const Real> support() const { return of_particles<Real>(support_); }
  bool mirrored() const { return cloud_.mirrored; }
  /// The particle of a candidate: itself, or that whose image it is.
  Index source(Index candidate) const {
    return candidate < size() ? candidate : at(cloud_.source, candidate - size());
  }
  KernelFunction kernel_function() const { return kernel_function_; }
  const NeighborSearch<D>& search() const { return search_; }

  /// U^-1, or null without a stretch.
  const Mat<D>* pressed() const { return pressed_ ? &pressed_->inverse_stretch : nullptr; }
  /// U^-1 x, the place at which kernels are evaluated.
  Vec<D> kernel_place(const Vec<D>& x) const {
    return pressed_ ? Vec<D>(pressed_->inverse_stretch * x) : x;
  }
  template <std::size_t n>
  std::array<Vec<D>, n> kernel_places(std::array<Vec<D>, n> x) const {
    if (pressed_)
      for (Vec<D>& place : x) place = kernel_place(place);
    return x;
  }

  /// Limits the supports to limit[particle] from now on, e.g. the distance to the other side of a
  /// cavity. Returns how many supports were shortened.
  Index limit_supports(std::vector<Real> limit);

  /// Finds all particles whose support reaches into the ball around `centre`, in ascending order.
  /// With a stretch some more are found. The X of candidates are kernel places.
  void candidates(const Vec<D>& centre, Real radius, std::vector<Candidate<D>>& found) const;
  /// Like the function above; `around` has the candidates of a larger ball that contains this ball.
  void candidates(const Vec<D>& centre, Real radius, std::span<const Candidate<D>> around,
                  std::vector<Candidate<D>>& found) const;
  /// Finds all particles whose support reaches one of the points, in ascending order.
  void candidates(const std::array<Vec<D>, 4>& points, std::vector<Candidate<D>>& found) const;

  /// Deficiency monitor (RKPM note 2.4) at `points`. Where the moment matrix is poor, the supports
  /// of the particles around are enlarged in steps of 10 %, up to 2.6 times the original support
  /// and up to the limit. Returns how many supports were enlarged. Throws SolveError naming `body`,
  /// the point and its neighbour count if the matrix stays unusable.
  Index ensure_quality(std::span<const Vec<D>> points, const std::string& body);

  /// Throws SolveError naming `body`, the point x and its neighbour count if `quality` (of the
  /// moment matrix at x) is below `least` or NaN.
  void require_quality(Real quality, const Vec<D>& x, const std::string& body,
                       Real least = unusable_quality) const {
    if (!(quality >= least)) refuse(quality, x, body);
  }

  static constexpr Real unusable_quality = 1e-3;
  static constexpr Real poor_quality = 1e-2;

 private:
  /// Particles at the kernel places U^-1 X.
  struct Pressed {
    Mat<D> inverse_stretch;
    Real growth;  ///< largest factor by which U^-1 changes a length
    std::vector<Vec<D>> X;
    NeighborSearch<D> search;
  };
  static std::optional<Pressed> press(const Mat<D>& stretch, std::span<const Vec<D>> X);
  template <class T>
  std::span<const T> of_particles(const std::vector<T>& all) const {
    return std::span(all).first(static_cast<std::size_t>(size()));
  }
  /// Gives images the supports of their particles, and finds the largest.
  void settle_supports();
  std::span<const Vec<D>> kernel_X() const { return pressed_ ? pressed_->X : cloud_.X; }
  const NeighborSearch<D>& kernel_search() const { return pressed_ ? pressed_->search : search_; }

  template <class Keep>
  void find(const Vec<D>& centre, Real radius, Keep&& keep, std::vector<Candidate<D>>& found) const;
  void find_quality(std::span<const Vec<D>> points, std::span<const Index> numbers,
                    std::vector<Real>& quality) const;
  [[noreturn]] void refuse(Real quality, const Vec<D>& x, const std::string& body) const;

  ParticleCloud<D> cloud_;
  std::vector<Real> support_;  // of particles, then of images
  std::vector<Real> limit_;    // [particle]; empty without limits
  Real largest_support_ = 0;
  KernelFunction kernel_function_;
  NeighborSearch<D> search_;
  std::optional<Pressed> pressed_;
};

extern template class ParticleSet<2>;
extern template class ParticleSet<3>;

}  // namespace meniscus
