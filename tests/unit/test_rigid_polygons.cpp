// SPDX-License-Identifier: BSD-3-Clause
// Segments, polygons and frames against reference values, quadrature and limits.
#include "body/grid/gauss.hpp"
#include "contact_reference.hpp"
#include "meniscus/error.hpp"
#include "physics/contact/rigid/rigid_partner.hpp"
#include "physics/contact/rigid/segment_field.hpp"
#include "thrown.hpp"

namespace meniscus::test_rigid_polygons {
namespace {

using test::contact_references;
using test::expect_relative;

const ContactLaw unit_integrated{PairKernel::integrated, 1, 1};
const ContactLaw unit_planar{PairKernel::planar, 1, 1};

/// Gauss points on panels not longer than their distance from the point.
SegmentField by_quadrature(const ContactLaw& law, Real begin, Real end, Real h) {
  const GaussRule rule = gauss_rule(20);
  SegmentField sum{0, Vec<2>::Zero()};
  while (begin < end) {
    const Real beside = std::max({begin, 0.0}), reach = std::hypot(beside, h) / 2;
    const Real stop =
        std::min(begin < 0 ? std::min(0.0, begin + std::abs(h) - begin / 2) : begin + reach, end);
    for (int q = 0; q < 20; ++q) {
      const Real half = (stop - begin) / 2, X = begin + half * (1 + at(rule.x, q));
      const auto f = pair_functions(law, std::hypot(X, h));
      sum.u += half * at(rule.w, q) * f.u;
      sum.psi_r += half * at(rule.w, q) * f.psi * Vec<2>(-X, h);
    }
    begin = stop;
  }
  return sum;
}

TEST(SegmentField, HasTheReferenceValues) {
  for (const auto& reference : contact_references("planestrain_segment_int_psi2_r12")) {
    const auto& in = reference.inputs;
    const SegmentField f = segment_field(unit_integrated, in["x1"], in["x2"], in["h"]);
    EXPECT_NEAR(f.psi_r[0], reference.value[0], 1e-13 * std::abs(reference.value[0]) + 1e-17);
    expect_relative(f.psi_r[1], reference.value[1], 1e-13, "across");
  }
  const auto reference = contact_references("planestrain_segment_int_u2")[0];
  const auto& in = reference.inputs;
  const SegmentField f = segment_field(unit_integrated, in["x1"], in["x2"], in["h"]);
  expect_relative(f.u, reference.value[0], 1e-13, "u");
}

/// Segments long and short, beside and above the point, through the point, near and far.
TEST(SegmentField, IsExactToRoundingEverywhere) {
  for (const PairKernel kernel : {PairKernel::integrated, PairKernel::planar}) {
    const ContactLaw law{kernel, 1.4, 0.5};
    for (const Real h : {-3.0, -0.4, 0.0, 1e-9, 1e-3, 0.3, 0.7, 2.0, 40.0})
      for (const auto& [begin, end] : std::vector<std::pair<Real, Real>>{{-0.1, 0.2},
                                                                         {-1, 1},
                                                                         {-5, 0.01},
                                                                         {-30, 70},
                                                                         {0, 0.5},
                                                                         {0, 9},
                                                                         {0.375, 0.5},
                                                                         {0.4, 1.0},
                                                                         {0.5, 60},
                                                                         {2, 2.125},
                                                                         {3, 5},
                                                                         {3, 1e4},
                                                                         {-8, -0.4},
                                                                         {-60, -20}}) {
        if (h * h < 1e-5 && begin <= 0 && end >= 0) continue;  // the point is on the segment
        if (std::abs(h) < 1e-8 && begin < 0.4 && end > -0.4) continue;
        const SegmentField f = segment_field(law, begin, end, h);
        // The quadrature is mirrored, so that it begins at its near end.
        const bool left = end <= 0;
        const SegmentField g = by_quadrature(law, left ? -end : begin, left ? -begin : end, h);
        const std::string what = "h " + std::to_string(h) + " from " + std::to_string(begin) +
                                 " to " + std::to_string(end);
        // u and psi change their sign: errors are relative to the size of their two terms.
        const Real r = std::hypot(std::max({begin, -end, 0.0}), h);
        const Real x = std::pow(law.sigma0 / r, 6), size = std::min(end - begin, r) * (x + x * x);
        EXPECT_NEAR(f.u, g.u, 1e-14 * size * r * r * std::max(r, 1.0)) << what;
        EXPECT_NEAR(f.psi_r[0], left ? -g.psi_r[0] : g.psi_r[0],
                    2e-14 * (x + x * x) * r * r * std::max(r, 1.0))
            << what;
        EXPECT_NEAR(f.psi_r[1], g.psi_r[1], 1e-14 * size * std::abs(h) * std::max(r, 1.0)) << what;
      }
  }
}

/// U = INT phi dA over a rectangle, with panels.
Real rectangle_by_quadrature(const ContactLaw& law, const Vec<2>& low, const Vec<2>& high,
                             const Vec<2>& x, int panels) {
  const auto rule = tensor_rule<2>(20);
  Real sum = 0;
  for (int i = 0; i < panels; ++i)
    for (int j = 0; j < panels; ++j) {
      const Vec<2> size = (high - low) / panels;
      const Vec<2> centre = low + Vec<2>((i + 0.5) * size.x(), (j + 0.5) * size.y());
      for (std::size_t q = 0; q < rule.x.size(); ++q) {
        const Vec<2> y = centre + 0.5 * size.cwiseProduct(rule.x[q]);
        sum += rule.w[q] * size.prod() / 4 * pair_functions(law, (x - y).norm()).phi;
      }
    }
  return sum;
}

TEST(RigidPolygons, AreTheIntegralOverTheirArea) {
  const Vec<2> low(-0.5, 0.2), high(1.3, 1.1);
  for (const ContactLaw& law : {unit_integrated, unit_planar}) {
    const auto box =
        rigid_polygons(law, 1.3, {{low, {high.x(), low.y()}, high, {low.x(), high.y()}}});
    for (const Vec<2>& x : {Vec<2>(0.3, 1.9), Vec<2>(2.0, 1.7), Vec<2>(-0.5, -0.8), Vec<2>(9, -4)})
      expect_relative(box->field(x).U, 1.3 * rectangle_by_quadrature(law, low, high, x, 8), 2e-13,
                      "U of a box");
  }
}

TEST(RigidPolygons, FrameIsAHoleInItsOuterBox) {
  const Vec<2> low(-2, -1), high(3, 2), x(-1.1, 0.4), out = Vec<2>::Constant(1.5);
  const auto thick = rigid_frame(unit_integrated, 1, low, high, 1.5);
  const Vec<2> a = low - out, b = high + out;
  // The left and right walls have the whole height, the lower and upper ones lie between them.
  const Real walls =
      rectangle_by_quadrature(unit_integrated, a, {low.x(), b.y()}, x, 12) +
      rectangle_by_quadrature(unit_integrated, {high.x(), a.y()}, b, x, 12) +
      rectangle_by_quadrature(unit_integrated, {low.x(), a.y()}, {high.x(), low.y()}, x, 12) +
      rectangle_by_quadrature(unit_integrated, {low.x(), high.y()}, {high.x(), b.y()}, x, 12);
  expect_relative(thick->field(x).U, walls, 1e-12, "U of a frame");
  const auto infinite = rigid_frame(unit_integrated, 1, low, high);
  const auto very_thick = rigid_frame(unit_integrated, 1, low, high, 1e4);
  expect_relative(very_thick->field(x).U, infinite->field(x).U, 1e-10, "thick frame");
  EXPECT_EQ(infinite->distance(x), x.x() - low.x());
  EXPECT_NEAR(infinite->distance({-2.5, -1.5}), -std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(thick->distance({-4.5, 0}), 1, 1e-15);
}

TEST(RigidPolygons, LongWallIsAHalfPlane) {
  for (const ContactLaw& law : {unit_integrated, unit_planar}) {
    const auto half = rigid_half_space<2>(law, 1, Vec<2>(0, -1e3), Vec<2>::UnitY());
    const auto frame = rigid_frame(law, 1, {-1e3, -1e3}, {1e3, 1e3});
    for (const Real a : {0.31, 0.5, 0.7, 1.5}) {
      const auto f = frame->field({3, -1e3 + a}), g = half->field({3, -1e3 + a});
      EXPECT_NEAR(f.U, g.U, 3e-8 + 1e-12 * std::abs(g.U));
      EXPECT_NEAR((f.S - g.S).norm(), 0, 1e-5);
    }
  }
}

TEST(RigidPolygons, RefuseNonsense) {
  const Vec<2> low(0, 0), high(1, 1);
  EXPECT_THROW_WITH(rigid_frame({PairKernel::space}, 1, low, high), InputError,
                    "cannot have the kernel 'space'");
  EXPECT_THROW_WITH(rigid_frame(unit_planar, 1, high, low), InputError,
                    "the inner width of a rigid frame must be > 0");
  EXPECT_THROW_WITH(rigid_frame(unit_planar, 1, low, high, 0), InputError,
                    "the thickness of a rigid frame must be > 0");
  EXPECT_THROW_WITH(rigid_polygons(unit_planar, 1, {{low, high}}), InputError,
                    "needs at least 3 vertices");
  EXPECT_THROW_WITH(rigid_polygons(unit_planar, 1, {{low, high, high}}), InputError,
                    "are the same");
  EXPECT_THROW_WITH(rigid_polygons(unit_planar, 1, {}), InputError, "needs at least one of them");
}

}  // namespace
}  // namespace meniscus::test_rigid_polygons
