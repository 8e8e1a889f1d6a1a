// SPDX-License-Identifier: BSD-3-Clause
// Force of the stresses of a solid on nodal cells that share volume changes. This base class has
// all that does not depend on the type of the law; the law is evaluated in averaged_force.hpp.
#pragma once
#include "physics/internal/averaged_volumes.hpp"
#include "physics/internal/stress_point_force.hpp"

namespace meniscus {

/// Cells that share volume changes with neighbours ("coupled") are evaluated in three phases: the
/// volume changes of all cells; the stresses of their laws and the pulls on the shared volume
/// changes; the forces.
template <int D>
class AveragedStressForce : public StressPointForce<D, CellRule<D>> {
 public:
  void add_tangent(const Motion& motion, const Motion& change, Forces force) final;
  std::optional<Failure> failure_of(Index cell, const Motion& motion) const final;
  std::size_t bytes() const final {
    return StressPointForce<D, CellRule<D>>::bytes() +
           (H_.size() + stress_.size()) * sizeof(Tensor<Lanes>) +
           2 * dual_H_.size() * sizeof(dual_H_[0]) +
           coupled_.size() * 2 * (sizeof(Real) + sizeof(Dual<Real>));
  }

 protected:
  AveragedStressForce(const Body<D>& body, CellRule<D> rule, std::unique_ptr<PointLaws> laws,
                      std::unique_ptr<AveragedVolumes<D>> volumes);

  const AveragedVolumes<D>& volumes() const { return *this->averaged(); }
  /// The coupled cells with numbers in a range of cells.
  template <class F>
  void for_coupled(Index begin, Index end, F&& f) {
    const ItemRange range = volumes().numbers_in(begin, end);
    for (Index k = range.begin; k < range.end; ++k) f(k, at(coupled_, k));
  }
  /// The first phase: H and mean volume changes of the coupled cells of this process.
  void gather_coupled(const Motion& motion);
  const Tensor<Lanes>& H(Index number) const { return at(H_, number - own_.begin); }
  /// Keeps the stress of a coupled cell, without the shared pull, and its own pull.
  [[gnu::always_inline]] void keep(Index number, const Tensor<Lanes>& P, Real pull) {
    // By components: as a whole, g++ would copy it by memmove.
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) at(stress_, number - own_.begin)(i, j) = P(i, j);
    at(pulls_, number) = pull;
  }
  /// Volume changes and pulls of the coupled cells of all processes.
  std::vector<Real>& changes() { return changes_; }
  std::vector<Real>& pulls() { return pulls_; }
  /// The first cell in the range where J of a point or the shared J is not positive.
  Index first_failed(Index begin, Index end, const NodalVector* u) const;
  /// Projects the volume changes. Returns false if some are infinite or NaN.
  bool project_changes();
  /// Projects the pulls and adds the forces of the coupled cells.
  void add_coupled(Forces force);

 private:
  using Base = StressPointForce<D, CellRule<D>>;
  template <class T>
  using PerCell = std::vector<T, CacheLineAllocator<T>>;

  Report add_tangent_of_coupled(const Motion& motion, Forces force);

  std::span<const Index> coupled_;
  ItemRange own_;  // numbers of the coupled cells of this process
  PerCell<Tensor<Lanes>> H_, stress_;
  std::vector<Real> changes_, pulls_;
  // For tangents; empty before the first.
  PerCell<Tensor<Dual<Lanes>>> dual_H_, dual_stress_;
  std::vector<Dual<Real>> dual_changes_, dual_pulls_;
};

extern template class AveragedStressForce<2>;
extern template class AveragedStressForce<3>;

}  // namespace meniscus
