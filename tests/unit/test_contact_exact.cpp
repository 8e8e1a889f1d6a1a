// SPDX-License-Identifier: BSD-3-Clause
// Contact between ellipsoids and spheres against the reference values of the CGCM note: total
// force, energy, and the work of all linear motions, which differs between the forms.
#include "contact_reference.hpp"
#include "contact_support.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>

namespace meniscus::test_contact_exact {
namespace {

Mat<3> matrix(const nlohmann::json& rows) {
  Mat<3> m;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) m(i, j) = rows.at(i).at(j).get<Real>();
  return m;
}
Mat<3> matrix_of_nine(const std::vector<Real>& values) {
  Mat<3> m;
  for (int k = 0; k < 9; ++k) m(k / 3, k % 3) = at(values, k);
  return m;
}

/// Two unit balls in the states x = M1 X and c2 + M2 X: the displacement is linear in X, and shape
/// functions reproduce it.
struct Ellipsoids {
  test::Pair<3> pair;
  NodalVectors u;
  Mat<3> M1, M2;

  explicit Ellipsoids(const nlohmann::json& inputs)
      : M1(matrix(inputs.at("M1"))), M2(matrix(inputs.at("M2"))) {
    pair.first = test::with_mass<3>(test::ball(4, 2));
    pair.second = test::with_mass<3>(test::ball(4, 2), pair.first->size());
    Vec<3> c2;
    for (int i = 0; i < 3; ++i) c2[i] = inputs.at("c2").at(i).get<Real>();
    u = test::field_on<3>(*pair.first, [&](const Vec<3>& X) { return Vec<3>(M1 * X - X); });
    const NodalVectors other =
        test::field_on<3>(*pair.second, [&](const Vec<3>& X) { return Vec<3>(c2 + M2 * X - X); });
    u.insert(u.end(), other.begin(), other.end());
  }

  struct Result {
    Vec<3> force;
    Mat<3> virial;
    Real energy;
  };
  /// beta = 1 per current volume, so b0 = J b for the referential density.
  Result result(ContactForm form, SiteDensity density, int points) const {
    ContactLaw law;
    law.cutoff = 40;
    ContactChoice choice;
    choice.form = form;
    choice.density = density;
    choice.points = points;
    const bool referential = form == ContactForm::volume || density == SiteDensity::referential;
    const Real beta1 = referential ? M1.determinant() : 1;
    const Real beta2 = referential ? M2.determinant() : 1;
    const auto term = contact_pair<3>({*pair.first, beta1}, {*pair.second, beta2}, law, choice);
    const NodalVectors force = test::force_of(*term, u);
    Result r{Vec<3>::Zero(), Mat<3>::Zero(), test::energy_of(*term, u)};
    for (Index A = 0; A < pair.first->size(); ++A) {
      const Vec<3> f = vector_at<3>(force, A);
      r.force += f;
      r.virial += f * (at(pair.first->particles.X(), A) + vector_at<3>(u, A)).transpose();
    }
    return r;
  }
};

TEST(ContactEllipsoids, FormsHaveTheSameForceAndTheirOwnWork) {
  const test::ContactReference reference = test::contact_references("ellipsoids_force").front();
  const Ellipsoids bodies(reference.inputs);
  const Vec<3> force = Vec<3>::Map(reference.value.data());
  const auto value_of = [](const std::string& name) {
    return test::contact_references(name).front().value;
  };
  const Real total = value_of("ellipsoids_energy").front();
  const Mat<3> exact = matrix_of_nine(value_of("ellipsoids_virial V_mn"));
  const Mat<3> of_dissertation = matrix_of_nine(value_of("ellipsoids_virial form A"));
  using enum SiteDensity;
  const struct {
    ContactForm form;
    SiteDensity density;
    int points;
    Mat<3> virial;
    Real tolerance;
  } cases[] = {{ContactForm::energy, referential, 3, exact, 1e-4},
               {ContactForm::energy, constant, 3, exact - total * Mat<3>::Identity(), 1e-4},
               {ContactForm::pressure, constant, 3, exact - total * Mat<3>::Identity(), 1e-4},
               {ContactForm::dissertation, constant, 3, of_dissertation, 1e-4},
               {ContactForm::volume, referential, 2, exact, 1e-3}};
  for (const auto& c : cases) {
    SCOPED_TRACE(at(contact_form_names, static_cast<int>(c.form)));
    const auto r = bodies.result(c.form, c.density, c.points);
    EXPECT_LT((r.force - force).norm(), c.tolerance * force.norm());
    EXPECT_NEAR(r.energy, total, c.tolerance * std::abs(total));
    EXPECT_LT((r.virial - c.virial).norm(), c.tolerance * c.virial.norm());
  }
}

}  // namespace
}  // namespace meniscus::test_contact_exact
