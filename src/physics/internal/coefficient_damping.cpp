// SPDX-License-Identifier: BSD-3-Clause
// Damps combinations of nodal velocities that leave every material point at rest.
#include "physics/internal/coefficient_damping.hpp"

#include "kernel/row_sums.hpp"
#include "numbers/dense.hpp"

#include <cmath>

namespace meniscus {
namespace {

template <int D>
class CoefficientDamping final : public ForceTerm {
 public:
  CoefficientDamping(const Body<D>& body, std::span<const Real> viscosity, Real strength)
      : body_(body),
        chunk_sums_(body.chunk_sums(body.at_particles.start, body.at_particles.particle)),
        of_chunks_(chunk_sums_.tally<ChunkReport>()),
        rotations_(chunk_sums_.tally<Rotation>()),
        slip_(static_cast<std::size_t>(body.size())),
        offset_(slip_) {
    const Real h = mean_spacing(body.geometry.grid);
    for (Index A = 0; A < body.size(); ++A)
      rate_.push_back(strength * at(viscosity, A) * body.cells.volume(A) / (h * h));
  }

  std::string name() const override { return "coefficient damping of '" + body_.name + "'"; }
  bool viscous() const override { return true; }
  std::optional<Real> potential(const Motion&) override { return 0; }

  /// Uses the offsets of the last add_force().
  void add_viscous(const Motion& motion, Forces force) override {
    const Lanes* v = motion.v.data() + body_.first;
    sum_slips([&](Index A) { at(slip_, A) = v[A] - value_at(body_.at_particles, A, v); });
    force.gather({rotations_.gathered_where_rows_are()}, motion,
                 [this](const Motion&, const Forces& all) {
                   add_damping(all);
                   return Report();
                 });
  }
  void add_viscous_diagonal(Forces diagonal) override {
    chunk_sums_.accumulate(body_.part(diagonal),
                           [&](int, Index begin, Index end, NodalVector* sum) {
                             const PointRows<D>& rows = body_.at_particles;
                             for (Index A = begin; A < end; ++A)
                               for (Offset k = at(rows.start, A); k < at(rows.start, A + 1); ++k) {
                                 const Index B = at(rows.particle, k);
                                 const Lanes e = Lanes(A == B ? 1.0 : 0.0) - shape_at(rows, k);
                                 sum[B] += at(rate_, A) * (e * e);
                               }
                           });
  }

  /// Positions are reproduced, so (I - N) x = (I - N) u.
  Report add_force(const Motion& motion, Forces force) override {
    const Lanes *u = motion.u.data() + body_.first, *v = motion.v.data() + body_.first;
    sum_slips([&](Index A) {
      const auto [at_u, at_v] = values_at(body_.at_particles, A, u, v);
      at(slip_, A) = v[A] - at_v;
      at(offset_, A) = u[A] - at_u;
    });
    return force.gather({rotations_.gathered_where_rows_are()}, motion,
                        [this](const Motion& at_motion, const Forces& all) {
                          add_damping(all);
                          return report_of(of_chunks_, at_motion, all);
                        });
  }

  bool reads(StepReads& reads) override {
    reads.rows(chunk_sums_, body_.first);
    return true;
  }

  std::size_t bytes() const override {
    return chunk_sums_.bytes() + rate_.size() * sizeof(Real) +
           (slip_.size() + offset_.size()) * sizeof(Lanes);
  }
  Offset pairs() const override { return chunk_sums_.pairs(); }

 private:
  /// Sums of c (|e|^2 I - e e) and c e x d with d = (I - N) v and e = (I - N) x.
  struct Rotation {
    Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
    Eigen::Vector3d momentum = Eigen::Vector3d::Zero();
    friend Rotation operator+(const Rotation& a, const Rotation& b) {
      return {a.inertia + b.inertia, a.momentum + b.momentum};
    }
    /// The rotation w that solves sum c e x (d - w x e) = 0.
    Eigen::Vector3d rate() const {
      constexpr Real round_off = 1e-15;
      const Real size = inertia.trace();
      if (!(size > 0)) return Eigen::Vector3d::Zero();
      return inverse<3>(inertia + round_off * size * Eigen::Matrix3d::Identity()) * momentum;
    }
  };

  /// Sums slips d and offsets e, after `set(A)` has set slip_ and offset_ of a particle.
  template <class Set>
  void sum_slips(const Set& set) {
    chunk_sums_.for_own_chunks([&](int chunk, Index begin, Index end) {
      Rotation sum;
      for (Index A = begin; A < end; ++A) {
        set(A);
        const Eigen::Vector3d x = spatial(at(offset_, A));
        const Real c = at(rate_, A);
        sum =
            sum + Rotation{c * (x.squaredNorm() * Eigen::Matrix3d::Identity() - x * x.transpose()),
                           c * cross(x, spatial(at(slip_, A)))};
      }
      rotations_[chunk] = sum;
    });
  }

  /// Adds the forces -c s at the particles and +c s at the coefficients, with the slip s = d - w x
  /// e.
  void add_damping(Forces force) {
    const Eigen::Vector3d w =
        body_.geometry.grid.revolved ? Eigen::Vector3d(0, 0, 0) : rotations_.sum(Rotation{}).rate();
    chunk_sums_.accumulate(
        body_.part(force), [&](int chunk, Index begin, Index end, NodalVector* f) {
          Real heat = 0;
          for (Index A = begin; A < end; ++A) {
            const Eigen::Vector3d turned = cross(w, spatial(at(offset_, A)));
            const Lanes s = at(slip_, A) - Lanes(turned[0], turned[1], turned[2], 0.0),
                        pull = at(rate_, A) * s;
            heat += at(rate_, A) * sum(s * s);
            scatter_value(body_.at_particles, A, pull, f);
            f[A] -= pull;
          }
          of_chunks_[chunk].heat = heat;
        });
  }

  const Body<D>& body_;
  ChunkSums chunk_sums_;
  ChunkReports of_chunks_;
  ChunkTally<Rotation> rotations_;
  std::vector<Real> rate_;  // c, [particle]
  NodalVectors slip_, offset_;
};

}  // namespace

template <int D>
std::unique_ptr<ForceTerm> coefficient_damping(const Body<D>& body, std::span<const Real> viscosity,
                                               Real strength) {
  return std::make_unique<CoefficientDamping<D>>(body, viscosity, strength);
}
template std::unique_ptr<ForceTerm> coefficient_damping(const Body<2>&, std::span<const Real>,
                                                        Real);
template std::unique_ptr<ForceTerm> coefficient_damping(const Body<3>&, std::span<const Real>,
                                                        Real);

}  // namespace meniscus
