// SPDX-License-Identifier: BSD-3-Clause
// Small bodies, materials and fields for tests of the operators and force terms.
#pragma once
#include "body/body.hpp"
#include "body/grid/ordering.hpp"
#include "meniscus/body/shapes.hpp"
#include "meniscus/physics/law_registry.hpp"
#include "parallel/aligned.hpp"

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace meniscus::test {

/// A brick of unit cells whose inner nodes are moved by `jitter` times the edge.
template <int D>
Geometry<D> brick(std::vector<Real> cells, Real jitter = 0);

/// A ball of radius 1.
Geometry<3> ball(int core, int layers);

/// A disk of radius 1.
Geometry<2> disk(int core, int rings);

/// A closed smooth body without symmetry, for tests of net forces.
template <int D>
Geometry<D> potato();

template <int D>
using Support = typename ParticleSet<D>::AdaptiveSupport;

/// A body built as in a scene.
template <int D>
std::unique_ptr<Body<D>> body_of(Geometry<D> geometry, Support<D> support = {},
                                 KernelFunction kernel_function = KernelFunction::cubic_spline);

/// Parameters of order one for every registered law, as in a scene.
const std::map<std::string, std::string>& law_texts();

/// law_texts() with ten more units of the volumetric modulus of solids, so that nodal cells share
/// volume changes.
std::string stiff_text(const std::string& law);

/// Sets the masses of `body` and returns its internal force. `text`: the parameters of the law; a
/// direction is added if the law needs one and `text` has none.
template <int D>
std::unique_ptr<ForceTerm> internal_force(Body<D>& body, const std::string& law,
                                          const std::string& text,
                                          const Integration& integration = {});
template <int D>
std::unique_ptr<ForceTerm> internal_force(Body<D>& body, const std::string& law,
                                          const Integration& integration = {}) {
  return internal_force<D>(
      body, law, integration.volumetric == "cell_average" ? stiff_text(law) : law_texts().at(law),
      integration);
}

const std::vector<Integration>& integrations();

/// Nodal values f(X) of a vector field.
template <int D, class F>
NodalVectors field_on(const Body<D>& body, F&& f) {
  NodalVectors values(static_cast<std::size_t>(body.size()));
  for (Index A = 0; A < body.size(); ++A)
    set_vector<D>(values, A, Vec<D>(f(at(body.particles.X(), A))));
  return values;
}

/// Random fields whose components are independent and uniform in +-size.
template <int D>
NodalVectors random_field(Index n, Real size, unsigned seed);

inline NodalVectors sum_of(const NodalVectors& a, Real s, const NodalVectors& b) {
  NodalVectors c = a;
  for (std::size_t A = 0; A < c.size(); ++A) c[A] += s * b[A];
  return c;
}
inline Real dot(const NodalVectors& a, const NodalVectors& b) {
  Real total = 0;
  for (std::size_t A = 0; A < a.size(); ++A) total += sum(a[A] * b[A]);
  return total;
}
inline Real norm(const NodalVectors& a) {
  return std::sqrt(dot(a, a));
}

inline NodalVectors zeros(const NodalVectors& like) {
  return NodalVectors(like.size(), Lanes::zero());
}
/// The report of a force at time 0.
inline Report report_of(ForceTerm& term, const NodalVectors& u, const NodalVectors& v) {
  NodalVectors force = zeros(u);
  return term.add_force({0, u, v}, force);
}
inline Report report_of(ForceTerm& term, const NodalVectors& u) {
  return report_of(term, u, zeros(u));
}
inline NodalVectors force_of(ForceTerm& term, const NodalVectors& u, const NodalVectors& v,
                             std::span<const Unknown> fields = {}) {
  NodalVectors force = zeros(u);
  term.add_force({0, u, v, fields}, force);
  return force;
}
inline NodalVectors force_of(ForceTerm& term, const NodalVectors& u) {
  return force_of(term, u, zeros(u));
}
inline Real energy_of(const ForceTerm& term, const NodalVectors& u,
                      std::span<const Unknown> fields = {}) {
  const NodalVectors v = zeros(u);
  return term.stored_energy({0, u, v, fields}).value();
}

/// Net force and torque about the origin, relative to the sums of the norms of their parts.
struct Balance {
  Real force, torque;
};
template <int D>
Balance balance_of(const Body<D>& body, const NodalVectors& u, const NodalVectors& force);

/// Relative difference between force . direction and -dE/dt along u + t direction, by extrapolated
/// central differences of two widths.
Real gradient_error(ForceTerm& term, const NodalVectors& u, const NodalVectors& direction,
                    Real step);

}  // namespace meniscus::test
