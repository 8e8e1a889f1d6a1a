// SPDX-License-Identifier: BSD-3-Clause
// A body: particles, cells and surface in the reference configuration, and the operators that terms
// build on them.
#pragma once
#include "body/grid/nodal_cells.hpp"
#include "body/grid/stress_rules.hpp"
#include "body/reference.hpp"
#include "body/shapes/geometry.hpp"
#include "body/shared_parts.hpp"
#include "body/sums_over_ranks.hpp"
#include "kernel/point_rows.hpp"
#include "parallel/divided.hpp"

#include <memory>
#include <string>

namespace meniscus {

template <int D>
struct CellRows;

/// The particles first ... first + size() - 1 of all, with their grid, nodal cells and masses.
template <int D>
struct Body {
  std::string name;
  Division division;  ///< of its rows, between the ranks
  Index first = 0;    ///< number of its first particle in the arrays of all bodies
  Geometry<D> geometry;
  ParticleSet<D> particles;
  NodalCells<D> cells;  ///< refers to `geometry`: a body does not move in memory
  /// Loads act on faces of it (FaceCells): what the rule of nodal cells has of the boundary is then
  /// computed at their points, so that they balance a uniform stress to the last digits; otherwise
  /// at few.
  bool loaded_faces = true;
  std::vector<Real> mass;           ///< of the particles in the time step (lump_mass())
  std::vector<Real> mass_integral;  ///< INT rho N_A dV: what loads per mass act on; any sign
  bool uniform_density = true;      ///< in the reference of the scene
  /// Values of the shape functions at the particles: places x(X_A) = sum_B N_B(X_A) d_B. Particle
  /// coefficients d_A are not places. The rows of this rank; those of others are empty.
  PointRows<D> at_particles;
  /// Rows of its cells that were made ahead, for the material to take; null: it makes them.
  std::unique_ptr<CellRows<D>> cell_rows;
  /// What several terms need of it alike, as contact points.
  mutable SharedParts shared;
  /// What it was referred to anew; null: it has the reference of its scene.
  std::shared_ptr<const Reference<D>> reference;

  /// Place of a particle in the reference of the scene, of which formulas are functions.
  const Vec<D>& origin(Index A) const {
    return reference ? at(reference->origin, A) : at(particles.X(), A);
  }
  /// The same of the centroid of a nodal cell.
  const Vec<D>& cell_origin(Index A) const {
    return reference ? at(reference->cell_origin, A) : cells.centroid(A);
  }
  /// Volume of a nodal cell in this reference / in that of the scene.
  Real volume_ratio(Index A) const { return reference ? at(reference->volume_ratio, A) : 1; }

  Index size() const { return particles.size(); }
  /// Its own part of an array over the particles of all bodies.
  template <class T>
  std::span<T> part(std::span<T> all) const {
    return all.subspan(static_cast<std::size_t>(first), static_cast<std::size_t>(size()));
  }
  Body(const Body&) = delete;
  Body(Body&&) = delete;
  /// All ranks make it, with its values at particles.
  Body(std::string body_name, Geometry<D> body_geometry, ParticleSet<D> body_particles)
      : Body(std::move(body_name), std::move(body_geometry), std::move(body_particles), evenly) {
    on_each_rank([this] { build_values(); });
  }
  /// Without values at its particles.
  Body(std::string body_name, Geometry<D> body_geometry, ParticleSet<D> body_particles,
       Division between_ranks)
      : name(std::move(body_name)),
        division(between_ranks),
        geometry(std::move(body_geometry)),
        particles(std::move(body_particles)),
        cells(geometry.grid) {}
  /// Those of this rank. Throws SolveError where shape functions cannot be determined.
  void build_values() {
    at_particles = build_point_rows<D>(particles, particles.X(), {.value = true}, name,
                                       division.own_rows(size()));
  }
};

/// How the coefficients of a cell rule are stored: in double, or in single precision but for a few
/// of each row that keep all sums over quadratic polynomials (performance note 2).
enum class RowPrecision : std::uint8_t { full, rounded };

/// q_scni: smoothed gradients with linear moments over nodal cells (RKPM note 5.3). Also returns
/// the integrals of the shape functions over the body, for row-sum masses.
template <int D>
struct CellOperator {
  CellRule<D> rule;
  std::vector<Real> shape_integral;  ///< [particle] integral of N_A over the body
};

/// The rows of the rule of some cells, which a rank makes by itself; those of all others are empty.
template <int D>
struct CellRows {
  /// Throws SolveError where shape functions cannot be determined.
  CellRows(const Body<D>& body, RowPrecision precision, OwnItems cells);

  CellRule<D> rule;
  SumsOverRanks shape_integral;
};
/// The rule that all ranks have made the rows of. All ranks call this.
template <int D>
CellOperator<D> cell_rule_of(const Body<D>& body, CellRows<D> rows);

/// The rows of this rank, and the integrals over all cells. All ranks call this. Throws SolveError
/// where shape functions cannot be determined.
template <int D>
CellOperator<D> build_cell_rule(const Body<D>& body, RowPrecision precision = RowPrecision::full);
/// Likewise the rows of some cells, which the ranks share out; those of all others are empty.
template <int D>
CellOperator<D> build_cell_rule(const Body<D>& body, RowPrecision precision, OwnItems cells);

/// `points_per_direction` Gauss points in every cell of the grid. The rows of this rank.
template <int D>
PointRule<D> build_gauss_rule(const Body<D>& body, int points_per_direction,
                              Index per_group = PointRule<D>::most_per_group);

/// One point per particle with the volume of its nodal cell: unstable, for comparison only. The
/// rows of this rank.
template <int D>
PointRule<D> build_nodal_rule(const Body<D>& body, Index per_group = PointRule<D>::most_per_group);

/// Integrals of the shape functions over the body, without building a rule.
template <int D>
std::vector<Real> shape_integrals(const Body<D>& body);

struct MassReport {
  Index raised = 0;     ///< particles that were below the floor
  int kept_degree = 2;  ///< moments of the masses up to this degree are those of the row sums
  Real added = 0;       ///< relative change of the total mass, where not even that is kept
};

/// m_A = integral of density N_A, with the floor m_A >= 0.3 density V_A (tiny and negative row sums
/// at corners are unstable at any step; performance note 3). What the floor adds is taken from
/// other particles, neighbours first, so that mass, first and second moments of the body stay those
/// of the row sums, which are those of its volume. The row sums themselves become the mass
/// integrals of the body. `density` per particle.
template <int D>
MassReport lump_mass(Body<D>& body, const std::vector<Real>& density,
                     const std::vector<Real>& shape_integral);

}  // namespace meniscus
