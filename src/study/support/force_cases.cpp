// SPDX-License-Identifier: BSD-3-Clause
// Bodies with exactly known forces of surface tension.
#include "study/support/force_cases.hpp"

#include "body/surface/surface_points.hpp"
#include "kernel/row_sums.hpp"
#include "numbers/dense.hpp"
#include "numbers/surface_geometry.hpp"
#include "study/support/bodies.hpp"

namespace meniscus::study {
namespace {

constexpr int fine_points = 8;  // per facet direction

std::unique_ptr<Body<3>> make_body(Geometry<3> geometry, Real factor) {
  ParticleSet<3> particles(geometry.grid.X, {factor, 20}, KernelFunction::cubic_spline);
  return std::make_unique<Body<3>>("body", std::move(geometry), std::move(particles));
}

/// int N_A 2 kappa n da, for some points at a time: rows of all fine points would take gigabytes.
void add_exact_forces(ForceCase& c, const SmoothMap<3>& map) {
  const SurfacePoints<3> reference = surface_points(c.body->geometry, fine_points);
  SurfacePoints<3> current = reference;
  deform(current, map);
  c.exact.assign(c.u.size(), Lanes::zero());
  c.dilation = c.stretching = 0;
  constexpr Index some = 8192;
  for (Index first = 0; first < current.size(); first += some) {
    const Index count = std::min(some, current.size() - first);
    const auto rows = build_point_rows<3>(
        c.body->particles, {reference.X.data() + first, static_cast<std::size_t>(count)},
        {.value = true}, "body");
    for (Index q = 0; q < count; ++q) {
      const Index p = first + q;
      const Vec<3> t = -at(current.grad_N, p).trace() * at(current.area, p) * at(current.N, p);
      const Vec<3>& x = at(current.X, p);
      c.dilation += t.dot(x);
      c.stretching += t.dot(Vec<3>(-0.5 * x[0], x[1], -0.5 * x[2]));
      scatter_value(rows, q, Lanes(t[0], t[1], t[2], 0.0), c.exact.data());
    }
  }
}

}  // namespace

ForceCase mapped_ball(int n, const SmoothMap<3>& map, Real factor) {
  ForceCase c;
  c.body = make_body(reference_body<3>("ball", n), factor);
  c.u.resize(static_cast<std::size_t>(c.body->size()));
  for (Index A = 0; A < c.body->size(); ++A) {
    const Vec<3>& X = at(c.body->particles.X(), A);
    set_vector<3>(c.u, A, Vec<3>(map(X).x - X));
  }
  add_exact_forces(c, map);
  return c;
}

ForceCase rounded_ellipsoid(int n, Real factor) {
  ForceCase c;
  Geometry<3> sphere = reference_body<3>("ball", n);
  const std::vector<Vec<3>> places = sphere.grid.X;
  c.body = make_body(apply_map<3>(twist_ellipsoid(), std::move(sphere)), factor);
  c.u.resize(places.size());
  for (Index A = 0; A < c.body->size(); ++A)
    set_vector<3>(c.u, A, Vec<3>(at(places, A) - at(c.body->particles.X(), A)));
  return c;
}

NodalVectors force_of(ForceTerm& term, const NodalVectors& u) {
  const NodalVectors v(u.size(), Lanes::zero());
  NodalVectors force(u.size(), Lanes::zero());
  term.add_force({0, u, v}, force);
  return force;
}

Real dot(const NodalVectors& a, const NodalVectors& b) {
  Real total = 0;
  for (std::size_t A = 0; A < a.size(); ++A) total += sum(a[A] * b[A]);
  return total;
}

NodalVectors sum_of(NodalVectors a, Real s, const NodalVectors& b) {
  for (std::size_t A = 0; A < a.size(); ++A) a[A] += s * b[A];
  return a;
}

NodalVectors positions(const ForceCase& c) {
  NodalVectors d = c.u;
  for (Index A = 0; A < c.body->size(); ++A)
    set_vector<3>(d, A, Vec<3>(vector_at<3>(c.u, A) + at(c.body->particles.X(), A)));
  return d;
}

NodalVectors linear_motion(const ForceCase& c, const Mat<3>& V) {
  NodalVectors v = positions(c);
  for (Index A = 0; A < c.body->size(); ++A) set_vector<3>(v, A, Vec<3>(V * vector_at<3>(v, A)));
  return v;
}

Balance balance_of(const ForceCase& c, const NodalVectors& force) {
  const NodalVectors d = positions(c);
  Vec<3> net = Vec<3>::Zero(), moment = net;
  Real force_scale = 0, torque_scale = 0;
  for (Index A = 0; A < c.body->size(); ++A) {
    const Vec<3> x = vector_at<3>(d, A), f = vector_at<3>(force, A);
    net += f;
    moment += cross(x, f);
    force_scale += f.norm();
    torque_scale += x.norm() * f.norm();
  }
  return {net.norm() / force_scale, moment.norm() / torque_scale};
}

NodalVectors unit_pressure(const ForceCase& c, int k) {
  const SurfacePoints<3> surface = surface_points(c.body->geometry, k);
  const auto rows =
      build_point_rows<3>(c.body->particles, surface.X, {.value = true, .gradient = true}, "body");
  NodalVectors force(c.u.size(), Lanes::zero());
  for (Index q = 0; q < rows.size(); ++q) {
    const auto column = gradient_at(rows, q, c.u.data());
    const Tensor<Real> F =
        deformation_gradient(Tensor<Real>::map([&](int i, int K) { return at(column, K)[i]; }));
    const auto frame = surface_frame(F, embed<3>(at(surface.N, q)));
    const Real da = at(surface.area, q) * frame.area_ratio;
    scatter_value(rows, q, Lanes(da * frame.n[0], da * frame.n[1], da * frame.n[2], 0.0),
                  force.data());
  }
  return force;
}

}  // namespace meniscus::study
