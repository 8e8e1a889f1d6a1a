// SPDX-License-Identifier: BSD-3-Clause
// Surface tension on closed patches through positions: area and enclosed volume belong to one
// surface (static-drop note 2).
#include "body/surface/surface_patches.hpp"
#include "body/surface/surface_points.hpp"
#include "physics/surface/surface_tension.hpp"
#include "physics/surface/tension_term.hpp"
#include "physics/surface/wall_report.hpp"

#include <numeric>

namespace meniscus {
namespace {

template <int D>
class BalancedSurfaceTension final : public TensionTerm<D> {
  using Size = typename SurfacePatches<D>::Size;

 public:
  BalancedSurfaceTension(const Body<D>& body, Real gamma, const std::string& face)
      : TensionTerm<D>(body, gamma), patches_(body), face_(face) {
    if (!face.empty())
      patches_.share_area(shares_of(face));
    else if (patches_.on_walls())
      patches_.share_area(tension_shares(body, gamma));
    else
      correct();
  }

  std::string name() const override {
    return TensionTerm<D>::name() + (face_.empty() ? "" : " at '" + face_ + "'");
  }

  Report add_force(const Motion& motion, Forces force) override {
    patches_.at_time(motion.time);
    patches_.place(this->displacements(motion));
    return force.gather(
        {patches_.places()}, motion, [this](const Motion& at_motion, const Forces& all) {
          const Real pull = this->gamma_ * correction_;
          patches_.follow(Size::area);
          patches_.add_gradient(-pull, this->own_part(all));
          return patches_.on_walls() ? report_of_walls(patches_, pull, at_motion, all) : Report();
        });
  }
  void add_tangent(const Motion& motion, const Motion& change, Forces force) override {
    patches_.at_time(motion.time);
    patches_.add_gradient_change(Size::area, this->displacements(motion),
                                 this->displacements(change), -this->gamma_ * correction_,
                                 this->own_part(force));
  }
  bool reads(StepReads& reads) override {
    patches_.list_reads(reads, this->body_.first);
    return true;
  }
  std::optional<Real> stored_energy(const Motion& motion) const override {
    patches_.at_time(motion.time);
    return this->gamma_ * correction_ * patches_.measure(Size::area, this->displacements(motion));
  }
  std::size_t bytes() const override { return patches_.bytes(); }
  Offset pairs() const override { return patches_.pairs(); }

 private:
  /// Makes the energy exact in the reference.
  void correct() {
    constexpr int fine = 8;
    Real exact = 0;
    for (const Real area : surface_points(this->body_.geometry, fine).area) exact += area;
    correction_ = exact / patches_.reference(Size::area);
  }
  std::vector<Real> shares_of(const std::string& face) const {
    std::vector<Real> shares;
    for (const Facet<D>& facet : this->body_.geometry.grid.facets)
      shares.push_back(this->body_.geometry.surface->face_name(facet.patch) == face ? 1 : 0);
    return shares;
  }
  Real area(const Motion& motion) const override {
    patches_.at_time(motion.time);
    if (!face_.empty()) return patches_.measure(Size::area, this->displacements(motion));
    const std::vector<Real> areas = patches_.areas(this->displacements(motion));
    return correction_ * std::accumulate(areas.begin(), areas.end(), 0.0);
  }

  SurfacePatches<D> patches_;
  std::string face_;     // empty: the whole surface
  Real correction_ = 1;  // area of the exact surface over area of the patches, in the reference
};

}  // namespace

template <int D>
std::unique_ptr<ForceTerm> balanced_surface_tension(const Body<D>& body, Real gamma,
                                                    const std::string& face) {
  return std::make_unique<BalancedSurfaceTension<D>>(body, gamma, face);
}
template std::unique_ptr<ForceTerm> balanced_surface_tension(const Body<2>&, Real,
                                                             const std::string&);
template std::unique_ptr<ForceTerm> balanced_surface_tension(const Body<3>&, Real,
                                                             const std::string&);

}  // namespace meniscus
