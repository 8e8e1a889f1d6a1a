// SPDX-License-Identifier: BSD-3-Clause
// A body: its particles, cells and surface in the reference configuration, and the integration
// rules that force terms use.
#pragma once
#include "body/grid/nodal_cells.hpp"
#include "body/grid/stress_rules.hpp"
#include "body/reference.hpp"
#include "body/shapes/geometry.hpp"
#include "body/shared_parts.hpp"
#include "body/sums_over_ranks.hpp"
#include "body/surface/wetted_wall.hpp"
#include "kernel/point_rows.hpp"
#include "kernel/row_sums.hpp"
#include "parallel/chunk_sums.hpp"
#include "parallel/divided.hpp"

#include <cmath>
#include <memory>
#include <numbers>
#include <string>

namespace meniscus {

template <int D>
struct CellRows;

/// Radius of the ball (2D: disk) with this volume (area), in a space of this dimension.
inline Real ball_radius(Real volume, int space_dimension) {
  return space_dimension == 3 ? std::cbrt(3 * volume / (4 * std::numbers::pi))
                              : std::sqrt(volume / std::numbers::pi);
}

/// A body with its grid, nodal cells and masses. In arrays over all particles of a scene, its
/// particles have the numbers first, ..., first + size() - 1.
template <int D>
struct Body {
  std::string name;
  Division division;  ///< divides its rows between the ranks
  Index first = 0;    ///< number of its first particle in the arrays of all bodies
  Geometry<D> geometry;
  ParticleSet<D> particles;
  NodalCells<D> cells;  ///< refers to `geometry`: a body does not move in memory
  /// True if loads may act on faces of the body (FaceCells). The boundary integrals of the
  /// nodal-cell rule are then computed at the points of the face cells, so that loads balance a
  /// uniform stress to round-off. If false, fewer points are used.
  bool loaded_faces = true;
  std::vector<WettedFace<D>> wetted = {};  ///< faces that lie on walls; see SurfacePatches
  std::vector<Real> mass;                  ///< lumped masses of the time step (lump_mass())
  std::vector<Real> mass_integral;  ///< INT rho N_A dV, on which loads per mass act; any sign
  bool uniform_density = true;      ///< in the reference configuration of the scene
  /// Values of the shape functions at the particles, which give positions x(X_A) = sum_B N_B(X_A)
  /// d_B. The coefficients d_A are not positions. Has the rows of this rank; all other rows are
  /// empty.
  PointRows<D> at_particles;
  /// Rows of the cells that were computed in advance for the internal force, which takes them. If
  /// null, the internal force computes them itself.
  std::unique_ptr<CellRows<D>> cell_rows;
  /// Data that several force terms share, such as contact points.
  mutable SharedParts shared;
  /// The updated reference configuration after a remap; null before the first remap.
  std::shared_ptr<const Reference<D>> reference;

  /// Position of particle A in the reference of the scene. Formulas are functions of this position.
  const Vec<D>& origin(Index A) const {
    return reference ? at(reference->origin, A) : at(particles.X(), A);
  }
  /// Position of the centroid of nodal cell A in the reference of the scene.
  const Vec<D>& cell_origin(Index A) const {
    return reference ? at(reference->cell_origin, A) : cells.centroid(A);
  }
  /// Volume of nodal cell A in the present reference, divided by its volume in the reference of the
  /// scene.
  Real volume_ratio(Index A) const { return reference ? at(reference->volume_ratio, A) : 1; }

  /// Volume of all cells in the reference (2D: area).
  Real volume() const {
    Real sum = 0;
    for (Index A = 0; A < size(); ++A) sum += cells.volume(A);
    return sum;
  }

  Index size() const { return particles.size(); }
  /// The dimension of the space in which the body is.
  int space() const { return space_dimension(geometry.grid); }
  /// True if the body is of revolution and particle A on its axis. The component 0 of its rows is
  /// zero, and so it stays there.
  bool on_axis(Index A) const { return geometry.grid.revolved && at(particles.X(), A)[0] == 0; }
  /// The values of this body in an array over the particles of all bodies.
  template <class T>
  std::span<T> part(std::span<T> all) const {
    return all.subspan(static_cast<std::size_t>(first), static_cast<std::size_t>(size()));
  }
  ForceVector part(const ForceVector& all) const { return all.part(first, size()); }
  /// The sums of chunks of compressed rows with the particles of this body.
  ChunkSums chunk_sums(std::span<const Offset> start, std::span<const Index> particle) const {
    return {start, particle, size(), division};
  }
  /// Sum of f(row) over n rows. The rows are divided between processes like the rows of this body,
  /// and sums are added in the order of chunks. All processes call this.
  template <class T, class F>
  T sum_over_rows(Index n, T zero, F&& f) const {
    return division.sum(n, zero, f);
  }
  /// The particles whose rows this process has.
  ItemRange own_particles() const { return division.own_rows(size()); }
  /// Room for a result of each chunk of particles.
  template <class T>
  ChunkTally<T> tally() const {
    return {chunk_count(size()), division};
  }
  /// Calls f(chunk, begin, end) for the chunks of own particles, on all threads.
  template <class F>
  void for_chunks(F&& f) const {
    parallel_for(
        division.own_items(chunk_count(size())),
        [&](Index c) {
          const ItemRange rows = ChunkSums::rows_of(c, size());
          f(c, rows.begin, rows.end);
        },
        1);
  }
  /// Gathers values, [particle of the body]. Each process provides the values at its own particles.
  /// All processes call this.
  void gather(std::span<NodalVector> values) const {
    division.complete_rows(size(), values.data(), sizeof values[0]);
  }
  /// The value at a particle of a field over all bodies. All processes call this.
  Lanes value_at_particle(Index A, std::span<const NodalVector> field) const {
    Lanes value = value_at(at_particles, A, field.data() + first);
    ranks().hand_out(division.rank_of_row(size(), A), &value, sizeof value);
    return value;
  }
  /// Calls use(row, make(row)) for n such rows in order. The process that has a row calls make().
  /// All processes call this.
  template <class Make, class Use>
  void for_rows_in_order(Index n, Make&& make, Use&& use) const {
    division.for_all_in_order(n, make, use);
  }
  Body(const Body&) = delete;
  Body(Body&&) = delete;
  /// Divides the rows evenly between ranks and computes at_particles. All ranks call this.
  Body(std::string body_name, Geometry<D> body_geometry, ParticleSet<D> body_particles)
      : Body(std::move(body_name), std::move(body_geometry), std::move(body_particles), evenly) {
    on_each_rank([this] { build_values(); });
  }
  /// Leaves at_particles empty; build_values() computes it.
  Body(std::string body_name, Geometry<D> body_geometry, ParticleSet<D> body_particles,
       Division between_ranks)
      : name(std::move(body_name)),
        division(between_ranks),
        geometry(std::move(body_geometry)),
        particles(std::move(body_particles)),
        cells(geometry.grid) {}
  /// Computes the rows of at_particles that belong to this rank. Throws SolveError where shape
  /// functions cannot be determined.
  void build_values() {
    at_particles = build_point_rows<D>(particles, particles.X(), {.value = true}, name,
                                       division.own_rows(size()));
  }
};

/// The integration rule q_scni: smoothed gradients with linear moments over nodal cells (RKPM note
/// 5.3), together with integrals of the shape functions for row-sum masses.
template <int D>
struct CellOperator {
  CellRule<D> rule;
  std::vector<Real> shape_integral;  ///< [particle] integral of N_A over the body
};

/// The rows of a cell rule for some cells, computed by one rank alone. The rows of all other cells
/// are empty.
template <int D>
struct CellRows {
  /// Throws SolveError where shape functions cannot be determined.
  CellRows(const Body<D>& body, OwnItems cells);

  CellRule<D> rule;
  SumsOverRanks shape_integral;
};
/// Makes a cell rule from the rows that all ranks have computed. All ranks call this.
template <int D>
CellOperator<D> cell_rule_of(const Body<D>& body, CellRows<D> rows);

/// Computes the rows of this rank, and the integrals over all cells. All ranks call this. Throws
/// SolveError where shape functions cannot be determined.
template <int D>
CellOperator<D> build_cell_rule(const Body<D>& body);
/// Computes the rows of the given cells only, divided between the ranks. The rows of all other
/// cells are empty.
template <int D>
CellOperator<D> build_cell_rule(const Body<D>& body, OwnItems cells);

/// A rule with `points_per_direction` Gauss points in every cell of the grid. Has the rows of this
/// rank.
template <int D>
PointRule<D> build_gauss_rule(const Body<D>& body, int points_per_direction,
                              Index per_group = PointRule<D>::most_per_group);

/// A rule with one point per particle, weighted by the volume of its nodal cell. It is unstable and
/// serves for comparison only. Has the rows of this rank.
template <int D>
PointRule<D> build_nodal_rule(const Body<D>& body, Index per_group = PointRule<D>::most_per_group);

/// Integrals of the shape functions over the body, without building a rule.
template <int D>
std::vector<Real> shape_integrals(const Body<D>& body);

struct MassReport {
  Index raised = 0;     ///< particles whose row sum was below the floor
  int kept_degree = 2;  ///< degree up to which the moments of the row sums are kept
  Real added = 0;       ///< relative change of the total mass, if even this is not kept
};

/// Sets the lumped masses: m_A = integral of density N_A, but at least 0.3 density V_A. The floor
/// is needed because tiny and negative row sums at corners are unstable at any step (performance
/// note 3). The added mass is taken from other particles, neighbours first. The total mass and the
/// first and second moments of the body thus keep their values, which are exact for its volume. The
/// unchanged row sums become the mass integrals of the body. `density` and `shape_integral` are per
/// particle.
template <int D>
MassReport lump_mass(Body<D>& body, const std::vector<Real>& density,
                     const std::vector<Real>& shape_integral);

}  // namespace meniscus
