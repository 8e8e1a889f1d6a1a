// SPDX-License-Identifier: BSD-3-Clause
// Contact points on the patches of a closed surface. The balanced surface tension takes the area of
// the same surface (static-drop note 2): tension, enclosed volume and contact use one surface.
#pragma once
#include "body/surface/surface_patches.hpp"
#include "kernel/row_sums.hpp"

#include <cstdint>

namespace meniscus {

template <int D>
class PatchPoints {
 public:
  /// `points`: Gauss points per direction and patch; points are numbered patch by patch.
  PatchPoints(const Body<D>& body, int points);

  Index size() const { return surface_.patch_count() * per_patch(); }
  Index node_count() const { return surface_.point_count(); }
  /// Positions of the nodes in the reference.
  const NodalVectors& reference_nodes() const { return reference_; }

  /// The value of a field at a node, and its position.
  NodalVector value(Index node, const NodalVector* field) const {
    return value_at(surface_.rows(), node, field);
  }
  NodalVector place_of_node(Index node, const NodalVector* u) const {
    return at(reference_, node) + value(node, u);
  }
  /// is_wanted[node] = 1 for the nodes of the patch of a point.
  void want(Index point, std::span<std::uint8_t> is_wanted) const;

  /// The value at a point of a field with these nodal values, e.g. its position.
  Vec<D> place(Index point, const NodalVectors& nodes) const;
  /// The outward area vector m dA; in a body of revolution that of the whole circle, 2 pi x_0 m ds.
  Vec<D> area_vector(Index point, const NodalVectors& nodes) const;
  /// The node nearest to the point.
  Index node_nearby(Index point) const;
  /// Calls f(A, value) with the derivative of the position of a point with respect to the
  /// displacement of particle A. A particle may occur several times, once for each node of the
  /// patch; the values add up.
  template <class F>
  void for_shape_functions(Index point, F&& f) const {
    const PointRows<D>& rows = surface_.rows();
    for (int a = 0; a < nodes; ++a) {
      const Index node = at(surface_.points_of(patch(point)), a);
      for (Offset e = at(rows.start, node); e < at(rows.start, node + 1); ++e)
        f(at(rows.particle, e), at(functions(point).L, a) * at(rows.value, e));
    }
  }

  /// Patches are in groups of four.
  Index group_count() const { return surface_.group_count(); }
  Index group(Index point) const { return patch(point) / Lanes::width; }
  /// Collects the derivatives of an energy for the points of a group: T with respect to the
  /// position, S with respect to the area vector m dA.
  void begin_force(Index group);
  void add(Index point, const Vec<D>& T, const Vec<D>& S, const NodalVectors& nodes);
  /// force_A -= the collected derivatives.
  void end_force(const ForceVector& force) { surface_.add_to_particles(-1, gradient_, force); }

  /// The shape functions at the nodes.
  const PointRows<D>& rows() const { return surface_.rows(); }
  void list_sums(StepReads& reads, Index first) const { surface_.list_sums(reads, first); }
  /// Registers the reads of the nodes whose rows this process has.
  void list_reads(StepReads& reads, Index first) const { surface_.list_reads(reads, first); }

  std::size_t bytes() const {
    return surface_.bytes() + (reference_.size() + gradient_.size()) * sizeof(Lanes);
  }
  Offset pairs() const { return surface_.pairs(); }

 private:
  static constexpr int nodes = PatchFunctions<D>::nodes;

  Index per_patch() const { return static_cast<Index>(functions_.size()); }
  Index patch(Index point) const { return point / per_patch(); }
  const PatchFunctions<D>& functions(Index point) const {
    return at(functions_, point % per_patch());
  }
  /// Tangents dx/dxi_k.
  std::array<Vec<D>, D - 1> tangents(Index point, const NodalVectors& nodes) const;
  /// The weight of a point with the length of its circle.
  Real weight(Index point, const NodalVectors& nodes) const;

  bool revolved_;
  SurfacePatches<D> surface_;
  std::vector<PatchFunctions<D>> functions_;
  NodalVectors reference_;
  AlignedVector<Lanes> gradient_;  // derivatives, [group of patches][a][i], a lane per patch
};

}  // namespace meniscus
