// SPDX-License-Identifier: BSD-3-Clause
// Rigid half space.
#include "meniscus/physics/partner_registry.hpp"
#include "numbers/dense.hpp"

#include <cmath>

namespace meniscus {
namespace {

template <int D>
struct HalfSpace final : PartnerShape<D> {
  static constexpr std::string_view example = D == 3 ? "point = [0, 0, -1.3]\nnormal = [0, 0, 1]\n"
                                                     : "point = [0, -1.3]\nnormal = [0, 1]\n";
  std::vector<Real> point, normal;

  static Rows<HalfSpace> rows() {
    return {reals_row("point", &HalfSpace::point, D, dimension::length, range::any,
                      "a point of the plane"),
            reals_row("normal", &HalfSpace::normal, D, dimension::none, range::any,
                      "out of the solid, of any length")};
  }
  void check(const Block& block) const {
    const Real length = Vec<D>::Map(normal.data()).norm();
    if (!(length > 0 && std::isfinite(length)))
      block.problem("normal", "has no direction; allowed is any vector of a finite length > 0");
  }
  typename PartnerShape<D>::Foot foot(const Vec<D>& x) const override {
    const Vec<D> n = Vec<D>::Map(normal.data()).normalized();
    return {n.dot(x - Vec<D>::Map(point.data())), n, Mat<D>::Zero()};
  }
  bool flat() const override { return true; }
  /// Draws the plane as a square (2D: a line) twice as wide as the box.
  typename PartnerShape<D>::Drawing drawing(const Box<D>& box) const override {
    const auto foot = this->foot(box.centre());
    const Vec<D> middle = box.centre() - foot.distance * foot.normal;
    const auto tangents = tangents_to<D>(foot.normal);
    const Vec<D> t = box.extent().norm() * tangents.col(0);
    if constexpr (D == 2) {
      return {{middle - t, middle + t}, {{0, 1}}};
    } else {
      const Vec<3> s = box.extent().norm() * tangents.col(1);
      return {{middle - t - s, middle + t - s, middle + t + s, middle - t + s}, {{0, 1, 2, 3}}};
    }
  }
  std::unique_ptr<RigidPartner<D>> lennard_jones(const ContactLaw& law, Real beta) const override {
    return rigid_half_space<D>(law, beta, Vec<D>::Map(point.data()), Vec<D>::Map(normal.data()));
  }
};

constexpr const char* half_space_meaning = "all that is behind a plane";
const bool half_space_registered =
    register_partner<2, HalfSpace<2>>("half_space", half_space_meaning) &&
    register_partner<3, HalfSpace<3>>("half_space", half_space_meaning);

}  // namespace
}  // namespace meniscus
