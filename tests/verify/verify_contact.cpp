// SPDX-License-Identifier: BSD-3-Clause
// Total force between two balls in all forms of contact: convergence to the exact values with finer
// points (CGCM notes 3.2 and 7).
#include "../unit/contact_reference.hpp"
#include "../unit/contact_support.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>

namespace meniscus::verify_contact {
namespace {

/// Two balls of radii R1 and R2 whose centres are D apart. The points of the second ball are
/// rotated, so that no lattice faces its mirror image.
struct Balls {
  test::Pair<3> pair;
  NodalVectors u;

  Balls(Real R1, Real R2, Real D, int core) {
    pair.first = ball(R1, core, 0);
    pair.second = ball(R2, core, pair.first->size());
    const Mat<3> turn = Eigen::AngleAxisd(0.8, Vec<3>(1, 2, 3).normalized()).toRotationMatrix();
    u = test::field_on<3>(*pair.first, [](const Vec<3>&) { return Vec<3>(Vec<3>::Zero()); });
    const NodalVectors other = test::field_on<3>(
        *pair.second, [&](const Vec<3>& X) { return Vec<3>(turn * X + Vec<3>(0, 0, D) - X); });
    u.insert(u.end(), other.begin(), other.end());
  }

  static std::unique_ptr<Body<3>> ball(Real radius, int core, Index first) {
    Ball shape;
    shape.radius = radius;
    shape.core = core;
    shape.layers = core / 2;
    return test::with_mass<3>(shape.geometry(), first);
  }

  /// The repulsion of the second ball.
  Real force(ContactForm form, int points) const {
    ContactLaw law;
    law.cutoff = 40;
    ContactChoice choice;
    choice.form = form;
    choice.points = points;
    const auto term = contact_pair<3>({*pair.first, 1}, {*pair.second, 1}, law, choice);
    const NodalVectors force = test::force_of(*term, u);
    Real net = 0;
    for (Index A = 0; A < pair.second->size(); ++A)
      net += vector_at<3>(force, pair.first->size() + A)[2];
    return net;
  }
};

TEST(ContactSpheres, ForcesConvergeToTheExactValues) {
  for (const auto& reference : test::contact_references("two_spheres_[F_repulsive,E]")) {
    const Real R1 = reference.inputs.at("R1"), R2 = reference.inputs.at("R2");
    const Real D = reference.inputs.at("D"), gap = D - R1 - R2, exact = reference.value.front();
    SCOPED_TRACE(fmt::format("radii {} and {}, gap {:.2f}", R1, R2, gap));
    const Balls balls(R1, R2, D, 8);
    // The error is relative to the force, or to the attraction where attraction and repulsion
    // nearly cancel.
    const Real scale = std::max(std::abs(exact), 10 * R1 * R2 / (R1 + R2));
    const auto errors_of = [&](ContactForm form, const std::vector<int>& all_points) {
      std::vector<Real> errors;
      for (const int points : all_points)
        errors.push_back(std::abs(balls.force(form, points) - exact) / scale);
      fmt::print("radii {} and {}, gap {:.2f}, {}:", R1, R2, gap,
                 at(contact_form_names, static_cast<int>(form)));
      for (const Real error : errors) fmt::print(" {:.2g}", error);
      fmt::print("\n");
      return errors;
    };
    Real finest = 0;
    for (const ContactForm form :
         {ContactForm::energy, ContactForm::pressure, ContactForm::dissertation}) {
      const std::vector<Real> errors = errors_of(form, {1, 2, 4});
      constexpr Real of_facets = 1e-5;  // from the quadratic shape of the facets
      for (std::size_t k = 1; k < errors.size(); ++k)
        EXPECT_LT(errors[k], std::max(errors[k - 1] / 4, of_facets));
      EXPECT_LT(errors.back(), 2e-3);
      finest = std::max(finest, errors.back());
    }
    // Cells with one point are too coarse at all these gaps; finer points would be too many for
    // large balls.
    const bool small = R1 + R2 <= 2;
    const std::vector<Real> errors =
        errors_of(ContactForm::volume, small ? std::vector{1, 2} : std::vector{1});
    EXPECT_GT(errors.front(), 10 * finest);
    if (small) {
      EXPECT_LT(errors.back(), 0.1 * errors.front());
    }
  }
}

}  // namespace
}  // namespace meniscus::verify_contact
