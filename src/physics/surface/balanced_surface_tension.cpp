// SPDX-License-Identifier: BSD-3-Clause
// Surface tension on closed patches through positions: area and enclosed volume belong to one
// surface (static-drop note 2).
#include "body/surface/surface_patches.hpp"
#include "body/surface/surface_points.hpp"
#include "physics/surface/surface_tension.hpp"
#include "physics/surface/tension_term.hpp"

namespace meniscus {
namespace {

template <int D>
class BalancedSurfaceTension final : public TensionTerm<D> {
  using Size = typename SurfacePatches<D>::Size;

 public:
  BalancedSurfaceTension(const Body<D>& body, Real gamma)
      : TensionTerm<D>(body, gamma), patches_(body) {
    constexpr int fine = 8;
    Real exact = 0;
    for (const Real area : surface_points(body.geometry, fine).area) exact += area;
    correction_ = exact / patches_.reference(Size::area);
  }

  Report add_force(const Motion& motion, Forces force) override {
    patches_.place(this->displacements(motion));
    return force.gather({patches_.places()}, motion, [this](const Motion&, const Forces& all) {
      patches_.follow(Size::area);
      patches_.add_gradient(-this->gamma_ * correction_, this->own_part(all));
      return Report();
    });
  }
  void add_tangent(const Motion& motion, const Motion& change, Forces force) override {
    patches_.add_gradient_change(Size::area, this->displacements(motion),
                                 this->displacements(change), -this->gamma_ * correction_,
                                 this->own_part(force));
  }
  bool reads(StepReads& reads) override {
    patches_.list_reads(reads, this->body_.first);
    return true;
  }
  std::size_t bytes() const override { return patches_.bytes(); }
  Offset pairs() const override { return patches_.pairs(); }

 private:
  Real area(const Motion& motion) const override {
    return correction_ * patches_.measure(Size::area, this->displacements(motion));
  }

  SurfacePatches<D> patches_;
  Real correction_;  // area of the exact surface over area of the patches, in the reference
};

}  // namespace

template <int D>
std::unique_ptr<ForceTerm> balanced_surface_tension(const Body<D>& body, Real gamma) {
  return std::make_unique<BalancedSurfaceTension<D>>(body, gamma);
}
template std::unique_ptr<ForceTerm> balanced_surface_tension(const Body<2>&, Real);
template std::unique_ptr<ForceTerm> balanced_surface_tension(const Body<3>&, Real);

}  // namespace meniscus
