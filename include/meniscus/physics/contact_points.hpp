// SPDX-License-Identifier: BSD-3-Clause
// Contact points of a body: on its closed surface, or in its volume.
#pragma once
#include "meniscus/body/body.hpp"
#include "meniscus/physics/force_term.hpp"

namespace meniscus {

/// Whether the density of interaction sites stays b per current volume, or b per reference volume
/// (b/J per current volume) (CGCM note 2).
enum class SiteDensity { constant, referential };

/// Places and weights of contact points at a motion.
template <int D>
struct ContactPlaces {
  Index size = 0;                  ///< points
  int components = 0;              ///< of a weight
  AlignedVector<Lanes> x, weight;  ///< [cluster][i], [cluster][component]
  std::vector<Tensor<Lanes>, CacheLineAllocator<Tensor<Lanes>>> inverse;  ///< [cluster] F^-1

  const Lanes* x_of(Index cluster) const { return &at(x, cluster * D); }
  const Lanes* weight_of(Index cluster) const { return &at(weight, cluster * components); }
  Vec<D> place(Index point) const {
    Vec<D> y;
    for (int i = 0; i < D; ++i) y[i] = x_of(point / Lanes::width)[i][point % Lanes::width];
    return y;
  }
  std::size_t bytes() const {
    return (x.size() + weight.size()) * sizeof(Lanes) + inverse.size() * sizeof(Tensor<Lanes>);
  }
};

/// Material points in clusters of four that are neighbours in space, a lane per point. The weight
/// of a point is
/// - on the surface the area vector V = b cof(F) N dA (constant density) or b F^-T N dA
///   (referential), outward, D numbers;
/// - in the volume b dV, one number.
/// Lanes without a point lie on the last point and have the weight 0.
template <int D>
class ContactPoints {
 public:
  /// `points` Gauss points per direction of every facet of the surface, all sides included.
  static ContactPoints on_surface(const Body<D>& body, Real beta, SiteDensity density, int points);
  /// `points` Gauss points per direction of every cell.
  static ContactPoints in_volume(const Body<D>& body, Real beta, int points);

  const Body<D>& body() const { return *body_; }
  Index size() const { return rule_.rows.size(); }
  Index clusters() const { return rule_.groups(); }
  Index points_in(Index cluster) const {
    return std::min<Index>(Lanes::width, size() - cluster * Lanes::width);
  }
  /// Root mean square distance of neighbouring points: (area or volume per point)^(1/dimension).
  Real spacing() const { return spacing_; }
  /// Smallest mass per area (volume) that moves with a point: a stiffness k per area between the
  /// points and something at rest has frequencies up to sqrt(k / inertia).
  Real inertia() const { return inertia_; }

  /// All points in the reference state.
  ContactPlaces<D> at_rest() const;
  /// Moves all points along with the body.
  void move(const Motion& motion, ContactPlaces<D>& places) const;
  /// Brings the weights of these clusters up to date.
  void update_weights(std::span<const Index> clusters, const Motion& motion,
                      ContactPlaces<D>& places) const;

  /// The particle nearest to a point, counted over all bodies.
  Index particle_at(Index point) const { return body_->first + at(rule_.point_owner, point); }

  /// Velocities of the points of a cluster.
  void velocity(Index cluster, const Motion& motion, Lanes* v) const;

  /// Adds the forces -dE/du of these clusters, given dE/dx = T ([cluster][i]) and, on the surface,
  /// dE/dV = S: f_A = - sum_s { N_A T + (S.V) g_A [constant density only] - (S.g_A) V } with
  /// g_A = F^-T grad N_A (CGCM note 4). Without S only the first.
  void add_force(const ContactPlaces<D>& places, std::span<const Index> clusters,
                 std::span<const Lanes> T, std::span<const Lanes> S, std::span<NodalVector> force);

  std::size_t bytes() const;
  Offset pairs() const { return rule_.rows.entries(); }

 private:
  ContactPoints(const Body<D>& body, int components) : body_(&body), components_(components) {}
  void place_points(const std::vector<Vec<D>>& X, const std::vector<Index>& order,
                    const std::vector<Real>& measure, RowContent content);
  static std::size_t offset(Index cluster, int count) {
    return static_cast<std::size_t>(cluster) * static_cast<std::size_t>(count);
  }
  Tensor<Lanes> stress(const ContactPlaces<D>& places, Index cluster, const Lanes* S) const;

  const Body<D>* body_;
  int components_;  // of a weight: D on the surface, 1 in the volume
  SiteDensity density_ = SiteDensity::referential;
  PointRule<D> rule_;  // a group is a cluster
  ForceWindows windows_;
  Real spacing_ = 0, inertia_ = 0;
  AlignedVector<Lanes> X_, reference_;  // [cluster][i]: places, weights in the reference state
  std::vector<std::uint8_t> pushed_;    // [cluster] 1 while its force is added
};

}  // namespace meniscus
