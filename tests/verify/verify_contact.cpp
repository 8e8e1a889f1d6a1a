// SPDX-License-Identifier: BSD-3-Clause
// Total force between two balls in all forms of contact: convergence to the exact values with finer
// points (CGCM notes 3.2 and 7).
#include "meniscus/body/smooth_map.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "../unit/contact_reference.hpp"
#include "../unit/contact_support.hpp"

namespace meniscus {
namespace {

/// Two balls of radii R1 and R2 whose centres are D apart; the points of the second are turned, so
/// that no lattice meets its mirror image.
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

  /// Repulsion on the second ball.
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
    const Balls balls(R1, R2, D, 8);
    // Attractive at the largest gap, so small between strong attraction and repulsion at others.
    const Real scale = std::max(std::abs(exact), 10 * R1 * R2 / (R1 + R2));
    for (const ContactForm form :
         {ContactForm::energy, ContactForm::pressure, ContactForm::dissertation}) {
      std::vector<Real> errors;
      for (const int points : {1, 2, 4})
        errors.push_back(std::abs(balls.force(form, points) - exact) / scale);
      fmt::print("R {} {} gap {:.2f} {}: {:.2g}\n", R1, R2, gap,
                 contact_form_names[static_cast<std::size_t>(form)], fmt::join(errors, " "));
    }
    std::vector<Real> errors;
    for (const int points : {1, 2})
      errors.push_back(std::abs(balls.force(ContactForm::volume, points) - exact) / scale);
    fmt::print("R {} {} gap {:.2f} volume: {:.2g}\n", R1, R2, gap, fmt::join(errors, " "));
  }
}

}  // namespace
}  // namespace meniscus
