// SPDX-License-Identifier: BSD-3-Clause
// Viscous stress of a solid in its nodal cells.
#include "physics/internal/solid_viscosity.hpp"

#include "numbers/tensor.hpp"
#include "physics/internal/stress_point_force.hpp"

namespace meniscus {
namespace {

template <int D>
class SolidViscosity final : public ForceTerm {
 public:
  SolidViscosity(const Body<D>& body, Real shear, Real volumetric)
      : body_(body),
        rule_(build_cell_rule(body).rule),
        chunk_sums_(rule_.chunk_sums(body)),
        of_chunks_(chunk_sums_.tally<ChunkReport>()),
        own_(chunk_sums_.own_rows(rule_.groups())),
        shear_(shear),
        volumetric_(volumetric) {}

  std::string name() const override { return "viscosity of '" + body_.name + "'"; }
  bool viscous() const override { return true; }
  bool reads(StepReads& reads) override {
    reads.rows(chunk_sums_, body_.first);
    return true;
  }

  Report add_force(const Motion& motion, Forces force) override {
    const NodalVector* u = motion.u.data() + body_.first;
    const NodalVector* v = motion.v.data() + body_.first;
    chunk_sums_.accumulate(body_.part(force),
                           [&](int chunk, Index begin, Index end, NodalVector* f) {
                             Lanes power = Lanes::zero();
                             KeptDeformations kept(this->kept());
                             for (Index g = begin; g < end; ++g) {
                               Tensor<Lanes> H, F_rate;
                               rule_.gather(g, u, H);
                               kept.take(g, H);
                               rule_.gather(g, v, F_rate);
                               const Tensor<Lanes> P = stress(H, F_rate);
                               const Lanes w = rule_.weight(g);
                               power += w * contract(P, F_rate);
                               rule_.scatter(g, -w * P, f);
                             }
                             of_chunks_[chunk].heat = sum(power);
                           });
    return report_of(of_chunks_, motion, force);
  }

  void expect_viscous_calls() override {
    kept_.resize(static_cast<std::size_t>(own_.end - own_.begin));
  }
  void add_viscous(const Motion& motion, Forces force) override {
    const NodalVector* v = motion.v.data() + body_.first;
    chunk_sums_.accumulate(body_.part(force), [&](int, Index begin, Index end, NodalVector* f) {
      for (Index g = begin; g < end; ++g) {
        Tensor<Lanes> F_rate;
        rule_.gather(g, v, F_rate);
        rule_.scatter(g, -rule_.weight(g) * stress(kept()[g], F_rate), f);
      }
    });
  }
  /// The diagonal for component i: mu |F_i|^2 delta_KL + (mu + lambda) F_iK F_iL with the rows F_i
  /// of F.
  void add_viscous_diagonal(Forces diagonal) override {
    chunk_sums_.accumulate(
        body_.part(diagonal), [&](int, Index begin, Index end, NodalVector* sum) {
          for (Index g = begin; g < end; ++g) {
            const Tensor<Lanes> F = add_diagonal(kept()[g], Lanes(1.0));
            const Lanes w = rule_.weight(g);
            std::array<Tensor<Lanes>, D> weighted;
            for (int i = 0; i < D; ++i) {
              const Lanes along = F(i, 0) * F(i, 0) + F(i, 1) * F(i, 1) + F(i, 2) * F(i, 2);
              at(weighted, i) = Tensor<Lanes>::map([&](int K, int L) {
                const Lanes across = (shear_ + volumetric_) * F(i, K) * F(i, L);
                return w * (K == L ? across + shear_ * along : across);
              });
            }
            rule_.add_diagonal(g, weighted, sum);
          }
        });
  }

  std::size_t bytes() const override {
    return rule_.bytes() + chunk_sums_.bytes() + kept_.size() * sizeof(Tensor<Lanes>);
  }
  Offset pairs() const override { return chunk_sums_.pairs(); }

 private:
  /// H of each group of this process, indexed by the group; null if not kept.
  Tensor<Lanes>* kept() { return kept_.empty() ? nullptr : kept_.data() - own_.begin; }
  Tensor<Lanes> stress(const Tensor<Lanes>& H, const Tensor<Lanes>& F_rate) const {
    const Tensor<Lanes> F = add_diagonal(H, Lanes(1.0));
    const Tensor<Lanes> half = transpose(F) * F_rate;
    // 2 E' = half + half^T
    return F * add_diagonal(shear_ * (half + transpose(half)), volumetric_ * trace(half));
  }

  const Body<D>& body_;
  CellRule<D> rule_;
  ChunkSums chunk_sums_;
  ChunkReports of_chunks_;
  ItemRange own_;  // groups whose rows this process has
  Lanes shear_, volumetric_;
  std::vector<Tensor<Lanes>, CacheLineAllocator<Tensor<Lanes>>> kept_;  // [own group] H
};

}  // namespace

template <int D>
std::unique_ptr<ForceTerm> solid_viscosity(const Body<D>& body, Real shear, Real volumetric) {
  return std::make_unique<SolidViscosity<D>>(body, shear, volumetric);
}
template std::unique_ptr<ForceTerm> solid_viscosity(const Body<2>&, Real, Real);
template std::unique_ptr<ForceTerm> solid_viscosity(const Body<3>&, Real, Real);

}  // namespace meniscus
