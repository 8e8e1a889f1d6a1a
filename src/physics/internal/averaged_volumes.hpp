// SPDX-License-Identifier: BSD-3-Clause
// The volume changes that the laws of a body of nodal cells see, so that nearly incompressible
// solids do not lock (locking note).
#pragma once
#include "parallel/aligned.hpp"
#include "physics/internal/averaged_cell.hpp"
#include "physics/internal/pressure_projection.hpp"

#include <span>
#include <vector>

namespace meniscus {

/// Numbers of the cells that share volume changes with their neighbours, which are "coupled": mean
/// volume changes, then pulls on them. Both are projected (PressureProjection). All other cells
/// share one volume change between their points only.
template <int D>
class AveragedVolumes {
 public:
  /// `own`: share of the volume change of a point that its law sees, one number for all cells or
  /// one for each; the cells share the rest.
  AveragedVolumes(const Body<D>& body, std::vector<Real> own);

  Real own(Index cell) const { return at(own_, own_.size() > 1 ? cell : 0); }
  /// Number of a coupled cell, or -1.
  Index number(Index cell) const { return projection_.number(cell); }
  /// The coupled cells, in ascending order.
  std::span<const Index> coupled() const { return projection_.cells(); }
  /// The numbers of the coupled cells in a range of cells.
  ItemRange numbers_in(Index begin, Index end) const;

  /// An array of one number per coupled cell, of which each process has computed its own.
  template <class T>
  Gathered gathered(std::vector<T>& values) const {
    return {values.data(), body_.division.listed(body_.size(), coupled())};
  }
  /// Projects a gathered array.
  template <class T>
  void project(std::vector<T>& values) const {
    projection_.apply(std::span<T>(values));
  }
  /// Computes value(cell) for all coupled cells, gathers and projects. All processes call this.
  template <class F>
  auto projected(F&& value) const {
    std::vector<decltype(value(Index()))> values(coupled().size());
    const Gathered all = gathered(values);
    parallel_for(all.shares.own(), [&](Index k) { at(values, k) = value(at(coupled(), k)); });
    GatherTogether()({&all, 1});
    project(values);
    return values;
  }
  /// The projection is Phi M^-1 Phi^T W, with this number of unknown pressures; calls f(unknown,
  /// value) for the entries of the row of Phi of a coupled cell.
  Index unknowns() const { return projection_.unknowns(); }
  template <class F>
  void for_extension(Index number, F&& f) const {
    projection_.for_extension(number, f);
  }
  std::size_t bytes() const { return own_.size() * sizeof(Real) + projection_.bytes(); }

 private:
  const Body<D>& body_;
  std::vector<Real> own_;
  PressureProjection<D> projection_;
};

}  // namespace meniscus
