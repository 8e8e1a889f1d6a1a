// SPDX-License-Identifier: BSD-3-Clause
// Contact points of a body, on its closed surface or in its volume.
#pragma once
#include "body/body.hpp"
#include "meniscus/physics/force_term.hpp"
#include "numbers/dual.hpp"
#include "parallel/shared_work.hpp"
#include "physics/point_elements.hpp"

#include <memory>

namespace meniscus {

/// The density of interaction sites stays b per current volume (constant), or b per reference
/// volume, which is b/J per current volume (referential) (CGCM note 2).
enum class SiteDensity { constant, referential };

/// How points of a surface are grouped into clusters.
enum class Clusters {
  of_neighbours,  ///< any four near points
  of_facets       ///< points of one facet; all facets have the same number of clusters
};

/// Positions and weights of contact points at a motion.
template <int D>
struct ContactPlaces {
  Index size = 0;                  ///< number of points
  int components = 0;              ///< number of components of a weight
  AlignedVector<Lanes> x, weight;  ///< [cluster][i], [cluster][component]
  std::vector<Tensor<Lanes>, CacheLineAllocator<Tensor<Lanes>>> inverse;  ///< [cluster] F^-1
  // Only for points on patches.
  NodalVectors nodes = {}, node_v = {};  ///< positions and velocities of the nodes of patches
  // Work space: the nodes that are needed, as a list and as flags, and values for other processes.
  std::vector<Index> wanted = {};
  std::vector<std::uint8_t> is_wanted = {};
  AlignedVector<Lanes> sent = {};

  const Lanes* x_of(Index cluster) const { return &at(x, cluster * D); }
  const Lanes* weight_of(Index cluster) const { return &at(weight, cluster * components); }
  Vec<D> place(Index point) const {
    Vec<D> y;
    for (int i = 0; i < D; ++i) y[i] = x_of(point / Lanes::width)[i][point % Lanes::width];
    return y;
  }
  std::size_t bytes() const {
    return (x.size() + weight.size() + nodes.size()) * sizeof(Lanes) +
           inverse.size() * sizeof(Tensor<Lanes>);
  }
};

/// Changes of positions and weights of contact points with the displacement, to first order.
template <int D>
struct ContactChanges {
  AlignedVector<Lanes> x, weight;  ///< as in ContactPlaces
  NodalVectors nodes = {};         ///< of the nodes of patches

  const Lanes* x_of(Index cluster) const { return &at(x, cluster * D); }
};

template <int D>
class PatchPoints;

/// Data that all contacts of a body share: reference positions and shape functions of its contact
/// points, and work space of a force.
template <int D>
struct SharedContactPoints {
  std::vector<Index> order;      ///< [lane] number of the point before it was sorted
  std::vector<Index> points_in;  ///< [cluster] number of points
  PointRule<D> rule;             ///< a group is a cluster; lanes without a point have empty rows
  ChunkSums chunk_sums;
  std::shared_ptr<PatchPoints<D>> patches;   ///< null for points by shape functions
  std::vector<std::vector<Index>> of_group;  ///< [group of patches] points
  std::vector<Index> particles, all;         ///< all: the numbers of all clusters
  Real spacing = 0, inertia = 0, gain = 0;
  AlignedVector<Lanes> X;  ///< [cluster][i]

  std::size_t bytes() const;
};

/// Material points in clusters of four near points, one per lane. The weight of a point is
///
/// - on the surface the outward area vector V = b cof(F) N dA (constant density) or b F^-T N dA
///   (referential), with D components;
/// - on patches (SurfacePatches) the outward area vector b m dA of the patches, with D components;
/// - in the volume b dV, one component.
///
/// Lanes without a point lie on the last point of the cluster and have weight 0.
template <int D>
class ContactPoints {
 public:
  /// `points` Gauss points per direction of every facet of the whole surface. The order of facets
  /// in Clusters::of_facets depends on the body only.
  static ContactPoints on_surface(const Body<D>& body, Real beta, SiteDensity density, int points,
                                  Clusters clusters = Clusters::of_neighbours);
  /// `points` Gauss points per direction of every patch, with constant density.
  static ContactPoints on_patches(const Body<D>& body, Real beta, int points,
                                  Clusters clusters = Clusters::of_neighbours);
  /// `points` Gauss points per direction of every cell.
  static ContactPoints in_volume(const Body<D>& body, Real beta, int points);

  const Body<D>& body() const { return *body_; }
  bool on_patches() const { return made_->patches != nullptr; }
  /// Number of lanes up to the last point.
  Index size() const { return static_cast<Index>(made_->rule.point_weight.size()); }
  Index clusters() const { return static_cast<Index>(made_->points_in.size()); }
  Index points_in(Index cluster) const { return at(made_->points_in, cluster); }
  /// Root mean square distance of neighbouring points: (area or volume per point)^(1/dimension).
  Real spacing() const { return made_->spacing; }
  /// Smallest mass per area (volume) that moves with a point. A stiffness k per area between the
  /// points and something at rest has frequencies up to sqrt(k / inertia).
  Real inertia() const { return made_->inertia; }

  /// The positions and weights in the reference state.
  ContactPlaces<D> at_rest() const;
  Vec<D> reference_place(Index point) const {
    Vec<D> X;
    for (int i = 0; i < D; ++i)
      X[i] = at(made_->X, point / Lanes::width * D + i)[point % Lanes::width];
    return X;
  }
  /// Moves all points, or the points of these clusters, with the body.
  void move(const Motion& motion, ContactPlaces<D>& places) const;
  void move(std::span<const Index> clusters, const Motion& motion, ContactPlaces<D>& places) const;
  /// Moves the points of a range of clusters; not for patches.
  void move(const ItemRange& clusters, const Motion& motion, ContactPlaces<D>& places) const;
  /// Updates the weights of these clusters, whose points have been moved.
  void update_weights(std::span<const Index> clusters, const Motion& motion,
                      ContactPlaces<D>& places) const;
  /// The numbers of all clusters.
  std::span<const Index> all() const { return made_->all; }

  /// The values that place() computes besides positions.
  enum class Placed { positions, weights, velocities };
  /// Computes the positions of the clusters in the list (ascending), and more, each process for its
  /// rows. The result is to be gathered; take_placed() with the same arguments then makes it
  /// complete, but for F^-1, which a process has for its rows.
  Gathered place(std::span<const Index> clusters, const SharedWork& work, Placed what,
                 const Motion& motion, ContactPlaces<D>& places) const;
  void take_placed(std::span<const Index> clusters, const SharedWork& work, Placed what,
                   ContactPlaces<D>& places) const;
  /// The part of a list of clusters whose rows each process has.
  Portions rows_of(std::span<const Index> clusters, const SharedWork& work) const {
    return work.rows(body_->division).listed(this->clusters(), clusters);
  }
  /// No point moves farther than this factor times the largest change of a displacement
  /// coefficient.
  Real gain() const { return made_->gain; }

  /// The particle nearest to a point, numbered over all bodies.
  Index particle_at(Index point) const { return body_->first + at(made_->rule.point_owner, point); }

  /// Prepares velocity() for these clusters. Call it before velocity(), or Placed::velocities.
  void prepare_velocities(std::span<const Index> clusters, const Motion& motion,
                          ContactPlaces<D>& places) const;
  /// The velocities of the points of a cluster.
  void velocity(Index cluster, const Motion& motion, const ContactPlaces<D>& places,
                Lanes* v) const;
  /// Like velocity(), without preparation; on patches it takes velocities of nearby nodes.
  void velocity_nearby(Index cluster, const Motion& motion, Lanes* v) const;
  /// Like velocity_nearby(), with `otherwise` at points whose nearby node has no row in this
  /// process.
  void velocity_nearby(Index cluster, const SharedWork& work, const Vec<D>& otherwise,
                       const Motion& motion, Lanes* v) const;

  /// Adds the forces -dE/du of these clusters, given dE/dx = T ([cluster][i]) and, on the surface,
  /// dE/dV = S: f_A = - sum_s { N_A T + (S.V) g_A [constant density only] - (S.g_A) V } with g_A =
  /// F^-T grad N_A (CGCM note 4). If S is empty, only the first term is added. `clusters` has at
  /// least those whose rows the process has.
  void add_force(const ContactPlaces<D>& places, std::span<const Index> clusters,
                 std::span<const Lanes> T, std::span<const Lanes> S, const Forces& force);

  /// The changes of these clusters, whose places and weights are up to date. Allocates memory.
  ContactChanges<D> changes(std::span<const Index> clusters, const ContactPlaces<D>& places,
                            const Motion& motion, const Motion& change) const;
  /// Adds the change of add_force() for a change of the displacement, with changes dT of T and dS
  /// of S.
  void add_force_change(const ContactPlaces<D>& places, const ContactChanges<D>& changes,
                        const Motion& motion, const Motion& change, std::span<const Index> clusters,
                        std::span<const Lanes> dT, std::span<const Lanes> S,
                        std::span<const Lanes> dS, const Forces& force);

  /// Elements for assembled tangents; not for patches.
  void announce(StiffnessMatrix& K) { elements_.announce(made_->rule, body_->first, K); }
  /// Second derivatives of E with respect to places and weights of a point.
  struct Curvature {
    Mat<D> of_place;   ///< d2E/dx dx
    Mat<D> of_weight;  ///< d2E/dx dV
  };
  /// Adds the second derivatives of an energy E(x, V) that is linear in the weights V, with dE/dV =
  /// S, at the motion that the places belong to. curvature(c, lane): of a point.
  template <class Of>
  void add_stiffness(std::span<const Index> clusters, const Motion& motion,
                     std::span<const Lanes> S, StiffnessMatrix& K, Of&& curvature) const {
    elements_.add(made_->rule, clusters, K, [&](Index c, PointModuli<D>& moduli) {
      std::array<Curvature, Lanes::width> of;
      for (int lane = 0; lane < Lanes::width; ++lane)
        if (lane < points_in(c)) of[lane] = curvature(c, lane);
      set_moduli(c, motion, S, of, moduli);
    });
  }

  /// The particles of the body that move the points, in ascending order.
  std::span<const Index> particles() const { return made_->particles; }
  /// The part of particles() that belongs to this process.
  std::span<const Index> own_particles(const SharedWork& work) const;
  // Register the reads of a force: the motion of all points, of the points in these clusters, or of
  // none but for the forces on the particles.
  void list_reads(StepReads& reads) const;
  void list_reads(StepReads& reads, std::span<const Index> clusters) const;
  void list_sums(StepReads& reads) const;
  /// On patches: the motion of the nodes whose rows this process has.
  void list_own_nodes(StepReads& reads) const;

  /// Memory of these points. Data shared between contacts are counted where they were made.
  std::size_t bytes() const;
  Offset pairs() const;

 private:
  ContactPoints(const Body<D>& body, int components) : body_(&body), components_(components) {}
  template <class Make>
  void share(const std::string& name, Make&& make);
  /// Sorts the points X into clusters. X comes facet by facet; `measure` is the area or volume of
  /// each.
  void place_points(const std::vector<Vec<D>>& X, const std::vector<Real>& measure,
                    Clusters clusters);
  void place_points_of_patches(Clusters clusters);
  bool has_point(Index lane) const { return lane % Lanes::width < points_in(lane / Lanes::width); }
  void build_rows(RowContent content);
  void list_particles();
  template <class F>
  void take_weights(F&& weight_of);
  void take_inertia();
  /// Calls f(A, value) for the shape functions at a point; a particle may come several times, with
  /// parts of its value.
  template <class F>
  void for_shape_functions(Index point, F&& f) const;
  template <class F>
  void for_points(Index cluster, F&& f) const;
  /// Sets the nodes of the patches of these clusters as wanted.
  void want_nodes(std::span<const Index> clusters, ContactPlaces<D>& places) const;
  void move(Index cluster, const NodalVector* u, ContactPlaces<D>& places) const;
  void move_on_patches(Index cluster, ContactPlaces<D>& places) const;
  void update_weights(Index cluster, const NodalVector* u, ContactPlaces<D>& places) const;
  void add_force_on_patches(const ContactPlaces<D>& places, std::span<const Index> clusters,
                            std::span<const Lanes> T, std::span<const Lanes> S,
                            const Forces& force);
  /// The part of the list, or on patches of the wanted nodes, whose rows each process has.
  Portions sent_rows(std::span<const Index> clusters, const SharedWork& work,
                     const ContactPlaces<D>& places) const;
  std::size_t values_sent(Placed what) const;
  static std::size_t offset(Index cluster, int count) {
    return static_cast<std::size_t>(cluster) * static_cast<std::size_t>(count);
  }
  void add_change_on_patches(const ContactPlaces<D>& places, const ContactChanges<D>& changes,
                             std::span<const Index> clusters, std::span<const Lanes> dT,
                             std::span<const Lanes> S, std::span<const Lanes> dS,
                             const Forces& force);
  Tensor<Lanes> stress(const ContactPlaces<D>& places, Index cluster, const Lanes* S) const;
  /// F^-1 and the weights of a cluster, with their changes.
  struct Turned {
    Tensor<Dual<Lanes>> inverse;
    std::array<Dual<Lanes>, D> V;
  };
  Turned turned(Index cluster, const Motion& motion, const Motion& change) const;
  Turned turned(Index cluster, const Tensor<Dual<Lanes>>& H) const;
  void set_moduli(Index cluster, const Motion& motion, std::span<const Lanes> S,
                  const std::array<Curvature, Lanes::width>& of, PointModuli<D>& moduli) const;
  Tensor<Lanes> stress_change(const Turned& now, const std::array<Dual<Lanes>, D>& S) const;

  const Body<D>* body_;
  int components_;  // of a weight: D on the surface, 1 in the volume
  SiteDensity density_ = SiteDensity::referential;
  Real beta_ = 1;  // on patches: weight per area
  std::shared_ptr<SharedContactPoints<D>> made_;
  bool is_first_ = false;           // these points have made the shared data
  AlignedVector<Lanes> reference_;  // [cluster][i]: weights in the reference
  PointElements<D> elements_;
  std::vector<std::uint8_t> pushed_;  // [cluster] 1 while its force is added
};

}  // namespace meniscus
