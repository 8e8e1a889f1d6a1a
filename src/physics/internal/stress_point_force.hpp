// SPDX-License-Identifier: BSD-3-Clause
// Force of the stresses at the points of an integration rule. This base class of the internal force
// contains all that does not depend on the type of the law: energy, failures, warnings, fields and
// measures. The loop of the time step is in internal_force.hpp.
#pragma once
#include "body/grid/stress_rules.hpp"
#include "body/surface/surface_patches.hpp"
#include "meniscus/physics/force_term.hpp"
#include "physics/assembled_force.hpp"
#include "physics/internal/averaged_volumes.hpp"
#include "physics/internal/point_laws.hpp"
#include "physics/internal/stress_output.hpp"
#include "physics/surface/wall_report.hpp"

namespace meniscus {

/// Stores H = F - I of each group of stress points in the array `all`. If `all` is null, stores
/// nothing.
class KeptDeformations {
 public:
  explicit KeptDeformations(Tensor<Lanes>* all)
      : first_(all ? all : &last_), stride_(all ? 1 : 0) {}
  KeptDeformations(const KeptDeformations&) = delete;
  KeptDeformations& operator=(const KeptDeformations&) = delete;
  [[gnu::always_inline]] void take(Index group, const Tensor<Lanes>& H) {
    first_[group * stride_] = H;
  }

 private:
  Tensor<Lanes> last_;
  Tensor<Lanes>* first_;
  std::ptrdiff_t stride_;
};

/// The common part of internal forces. `Rule` is CellRule<D> or PointRule<D>.
template <int D, class Rule>
class StressPointForce : public ForceTerm, public AssembledForce {
 public:
  std::string name() const override { return "internal force of '" + body_.name + "'"; }
  std::string_view energy_kind() const override { return "strain"; }
  Real steady_after() const final { return laws_->steady_after(); }
  void add_tangent(const Motion& motion, const Motion& change, Forces force) override;
  std::optional<Real> stored_energy(const Motion& motion) const final;
  Real uncancelled_force(const Motion& motion) const final;
  std::optional<std::string> warning(const Motion& motion) const final;
  std::vector<FieldSource> fields() const override;
  std::vector<MeasureSource> measures() const override;
  std::size_t bytes() const override {
    return rule_.bytes() + chunk_sums_.bytes() + laws_->bytes() +
           (surface_ ? surface_->bytes() : 0) + (volumes_ ? volumes_->bytes() : 0) +
           kept_.size() * sizeof(Tensor<Lanes>);
  }
  void add_viscous_diagonal(Forces diagonal) final;
  bool reads(StepReads& reads) final {
    reads.rows(chunk_sums_, body_.first);
    if (surface_) surface_->list_reads(reads, body_.first);
    return true;
  }
  std::optional<Failure> failure_of(Index group, const Motion& motion) const override;
  Offset pairs() const final { return chunk_sums_.pairs() + (surface_ ? surface_->pairs() : 0); }

  bool has_stiffness() const final { return !surface_; }
  std::vector<Dual<Lanes>> pressures(const Motion& motion, const Motion& change) final;
  void add_pressure_tangent(const Motion& motion, const Motion& change, std::span<const Lanes> off,
                            Forces force) final;
  void subtract_pressure_force(const Motion& motion, const Motion& change,
                               std::span<const Lanes> off, Forces force) final;
  Real squared_gradients(const Motion& motion) override;
  void announce(StiffnessMatrix& K) final;
  void add_stiffness(const Motion& motion, std::span<const Lanes> off, StiffnessMatrix& K) final;

 protected:
  StressPointForce(const Body<D>& body, Rule rule, std::unique_ptr<PointLaws> laws,
                   std::unique_ptr<SurfacePatches<D>> surface,
                   std::unique_ptr<AveragedVolumes<D>> volumes = nullptr)
      : body_(body),
        rule_(std::move(rule)),
        chunk_sums_(rule_.chunk_sums(body)),
        of_chunks_(chunk_sums_.tally<ChunkReport>()),
        own_(chunk_sums_.own_rows(rule_.groups())),
        laws_(std::move(laws)),
        surface_(std::move(surface)),
        volumes_(std::move(volumes)),
        spacing_(mean_spacing(body.geometry.grid)) {
    if (!surface_) return;
    pulls_ = chunk_sums_.tally<Real>();
    pull_changes_ = chunk_sums_.tally<Dual<Real>>();
  }

  const Body<D>& body() const { return body_; }
  const Rule& rule() const { return rule_; }
  PointLaws& laws() { return *laws_; }
  int chunks() const { return chunk_sums_.chunks(); }
  ChunkReports& of_chunks() { return of_chunks_; }
  /// Adds the forces on the particles of this body to `all`; see ChunkSums::accumulate().
  template <class F>
  void accumulate(const ForceVector& all, F&& work) {
    chunk_sums_.accumulate(body_.part(all), work);
  }
  /// The pulls of chunks on the enclosed volume.
  ChunkTally<Real>& pulls() { return pulls_; }
  bool has_surface() const { return surface_ != nullptr; }
  const AveragedVolumes<D>* averaged() const { return volumes_.get(); }
  /// Moves the points of the surface that belong to this process; the result is to be gathered.
  Gathered place_surface(const Motion& motion) {
    surface_->at_time(motion.time);
    surface_->place(motion.u.data() + body_.first);
    return surface_->places();
  }
  /// J_e - 1 of the placed surface; stores its gradient for pull_on_surface().
  Real follow_enclosed() {
    return surface_->follow(Size::volume) / surface_->reference(Size::volume) - 1;
  }
  /// Adds the forces -slope dJ_e/du of an energy E(J_e) to the particles of the body. J_e is the
  /// volume inside the surface patches divided by its reference value, and `slope` is dE/dJ_e. Uses
  /// the gradient of the last follow_enclosed().
  void pull_on_surface(Real slope, const ForceVector& all) {
    surface_->add_gradient(-slope / surface_->reference(Size::volume), body_.part(all));
  }

  /// The forces by which the walls of wetted faces hold the surface against this pull. Ends a
  /// phase. Empty without wetted faces.
  Report hold_on_walls(Real slope, const Motion& motion, const Forces& all) {
    if (!surface_->on_walls()) return {};
    return report_of_walls(*surface_, slope / surface_->reference(Size::volume), motion, all);
  }

  /// From now on add_force() stores H of the groups of this process in kept()[group].
  void keep_deformations() {
    keeps_ = true;
    kept_.resize(static_cast<std::size_t>(own_.end - own_.begin));
  }
  Tensor<Lanes>* kept() { return kept_.empty() ? nullptr : kept_.data() - own_.begin; }

  /// The first group in the range with a point where J <= 0 or J is NaN. ChunkReport::nowhere if
  /// there is none. `u` has the displacement coefficients of the body.
  Index first_folded(Index begin, Index end, const NodalVector* u) const;

  /// H at the stress points of a group.
  [[gnu::noinline]] Tensor<Lanes> gradients(Index group, const NodalVector* u) const;
  Tensor<Dual<Lanes>> gradients(Index group, const NodalVector* u, const NodalVector* du) const {
    return dual(gradients(group, u), gradients(group, du));
  }
  /// The stress of the law of a solid and its change.
  Tensor<Dual<Lanes>> tangent(Index group, Real time, const Tensor<Dual<Lanes>>& H) const {
    return laws_->tangent(group, time, {H, Tensor<Dual<Lanes>>::zero(), Dual<Real>(0.0)}).P;
  }
  /// Calls f(chunk, begin, end) for the chunks of groups of this process, on all threads.
  template <class F>
  void for_own_chunks(F&& f) const {
    chunk_sums_.for_own_chunks(f);
  }

 private:
  using Size = typename SurfacePatches<D>::Size;

  /// Volume changes, and pulls on them, of coupled cells (AveragedVolumes); empty if there are
  /// none.
  struct Shared {
    std::vector<Real> changes, pulls;
  };

  Real energy(const PointLaws& laws, const Motion& motion) const;
  Real inner_pressure(const Motion& motion) const;
  /// The volume changes at a motion. All processes call this.
  Shared shared_changes(const Motion& motion) const;
  /// The volume changes and pulls at a motion. All processes call this.
  Shared shared_by_cells(const Motion& motion) const;
  AveragedCell<Lanes> averaged_cell(Index group, const Tensor<Lanes>& H,
                                    const Shared& shared) const;
  /// The deformation that the law of a group sees, at H.
  Tensor<Lanes> seen(Index group, const Tensor<Lanes>& H, const Shared& shared) const {
    return volumes_ ? averaged_cell(group, H, shared).seen : H;
  }
  Tensor<Lanes> stress(Index group, Real time, const Tensor<Lanes>& H, const Shared& shared) const;
  /// Share of the volume change of a point that its law sees; zero if laws see nothing else.
  Real share_of_points(Index group) const { return volumes_ ? volumes_->own(group) : 0; }
  void hold_on_axis(std::span<const Index> particles, Eigen::Map<Eigen::MatrixXd>& block) const;
  Dual<Real> stiffness_of_pressure(Index cell, Real time, const Tensor<Lanes>& H,
                                   const Shared& shared) const;
  Tensor<Dual<Lanes>> stress_change(Index group, Real time, const Tensor<Dual<Lanes>>& H,
                                    const Shared& shared) const;
  void visit(const Motion& motion, const std::function<void(const StressPoint&)>& f) const;
  VisitStressPoints visitor() const;

  const Body<D>& body_;
  Rule rule_;
  ChunkSums chunk_sums_;
  ChunkReports of_chunks_;
  ItemRange own_;  // groups whose rows this process has
  std::unique_ptr<PointLaws> laws_;
  std::unique_ptr<SurfacePatches<D>> surface_;   // null: no law depends on the enclosed volume
  std::unique_ptr<AveragedVolumes<D>> volumes_;  // null: laws see the volume changes of points
  Real spacing_;
  ChunkTally<Real> pulls_;  // empty without a surface
  ChunkTally<Dual<Real>> pull_changes_;
  bool keeps_ = false;
  std::vector<Tensor<Lanes>, CacheLineAllocator<Tensor<Lanes>>> kept_;  // [own group]
  Index first_element_ = 0, first_pressure_ = 0;                        // of the stiffness matrix
};

extern template class StressPointForce<2, CellRule<2>>;
extern template class StressPointForce<3, CellRule<3>>;
extern template class StressPointForce<2, PointRule<2>>;
extern template class StressPointForce<3, PointRule<3>>;

}  // namespace meniscus
