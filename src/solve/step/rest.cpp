// SPDX-License-Identifier: BSD-3-Clause
// Rigid drift, and the flow in a fluid: criteria of rest for dynamic relaxation.
#include "solve/step/rest.hpp"

#include "body/particle_values.hpp"
#include "numbers/box.hpp"
#include "numbers/dense.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace meniscus {
namespace {

constexpr Real round_off_of_sums = 1e-8;  // relative to the terms that cancel

template <int D>
Eigen::Vector3d place_of(const Body<D>& body, const State& state, Index A) {
  return spatial<D>(at(body.particles.X(), A)) + spatial(at(state.u, body.first + A));
}

/// A rigid velocity field about a centre.
struct RigidField {
  Eigen::Vector3d centre, translation, rotation;

  Eigen::Vector3d at(const Eigen::Vector3d& x) const {
    return translation + cross(rotation, x - centre);
  }
};

/// The rigid velocity field with the momenta of du.
template <int D>
RigidField rigid_part(const System<D>& system, const Body<D>& body, const State& state,
                      const NodalVectors& du) {
  Real mass = 0;
  RigidField field{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  for (Index A = 0; A < body.size(); ++A) {
    const Real m = meniscus::at(system.mass, body.first + A);
    mass += m;
    field.centre += m * place_of(body, state, A);
    field.translation += m * spatial(meniscus::at(du, body.first + A));
  }
  field.centre /= mass;
  field.translation /= mass;
  if (system.revolved()) {
    field.translation[0] = 0;
    return field;
  }
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  for (Index A = 0; A < body.size(); ++A) {
    const Real m = meniscus::at(system.mass, body.first + A);
    const Eigen::Vector3d r = place_of(body, state, A) - field.centre;
    inertia += m * (r.squaredNorm() * Eigen::Matrix3d::Identity() - r * r.transpose());
    moment += m * cross(r, spatial(meniscus::at(du, body.first + A)));
  }
  field.rotation = D == 3 ? Eigen::Vector3d(inverse<3>(inertia) * moment)
                          : Eigen::Vector3d(0, 0, moment.z() / inertia(2, 2));
  return field;
}

}  // namespace

template <int D>
void remove_free_drift(const System<D>& system, const State& state, const NodalVectors& df,
                       NodalVectors& du) {
  for (const Body<D>& body : system.bodies) {
    const RigidField drift = rigid_part(system, body, state, du);
    Real work = 0, uncancelled = 0;
    for (Index A = 0; A < body.size(); ++A) {
      const Eigen::Vector3d f = spatial(at(df, body.first + A)),
                            w = drift.at(place_of(body, state, A));
      work += f.dot(w);
      uncancelled += (f.norm() + spatial(at(state.force, body.first + A)).norm()) * w.norm();
    }
    if (std::abs(work) > round_off_of_sums * uncancelled) continue;
    Real left = 0, removed = 0;
    for (Index A = 0; A < body.size(); ++A) {
      const Eigen::Vector3d w = drift.at(place_of(body, state, A));
      Lanes& change = at(du, body.first + A);
      change -= Lanes(w.x(), w.y(), w.z(), 0);
      left += sum(change * change);
      removed += w.squaredNorm();
    }
    if (left > round_off_of_sums * round_off_of_sums * removed) continue;
    for (NodalVector& change : body.part(std::span(du))) change = Lanes::zero();
  }
}

template <int D>
FluidRest<D>::FluidRest(const System<D>& system, const std::vector<bool>& fluid) {
  for (std::size_t b = 0; b < fluid.size(); ++b) {
    if (!fluid[b]) continue;
    const Body<D>& body = system.bodies[b];
    bodies_.push_back(&body);
    for (const Real m : body.mass) mass_ += m;
    extent_ = std::max(extent_, box_around<D>(body.particles.X()).extent().maxCoeff());
  }
}

template <int D>
bool FluidRest<D>::holds(Index particle) const {
  return std::any_of(bodies_.begin(), bodies_.end(), [&](const Body<D>* body) {
    return particle >= body->first && particle < body->first + body->size();
  });
}

template <int D>
Vec<D> FluidRest<D>::axes(const Body<D>& body, const NodalVectors& u) const {
  Real mass = 0;
  Vec<D> first = Vec<D>::Zero();
  Mat<D> second = Mat<D>::Zero();
  const NodalVectors moved = values_at_particles(body, u.data() + body.first);
  for (Index A = 0; A < body.size(); ++A) {
    Vec<D> x = at(body.particles.X(), A);
    for (int i = 0; i < D; ++i) x[i] += at(moved, A)[i];
    const Real m = at(body.mass, A);
    mass += m;
    first += m * x;
    second += m * x * x.transpose();
  }
  const Mat<D> about_centre = second / mass - first * first.transpose() / (mass * mass);
  return symmetric_eigenvalues<D>(about_centre).cwiseMax(0).cwiseSqrt();
}

template <int D>
Real FluidRest<D>::change(const NodalVectors& before, const NodalVectors& after) const {
  Real largest = 0;
  for (const Body<D>* body : bodies_)
    largest = std::max(largest, (axes(*body, after) - axes(*body, before)).cwiseAbs().maxCoeff());
  return largest / extent_;
}

template <int D>
Real FluidRest<D>::clock(Real uncancelled) const {
  return uncancelled > 0 ? std::sqrt(mass_ * extent_ / uncancelled) : 0;
}

template <int D>
Real FluidRest<D>::clock_of(Real energy) const {
  return energy > 0 ? extent_ * std::sqrt(mass_ / energy) : unbounded;
}

template <int D>
Real FluidRest<D>::force_of_power(const State& state, Real time) const {
  Real power = std::abs(state.books.heat);
  for (const Body<D>* body : bodies_)
    for (Index A = body->first; A < body->first + body->size(); ++A)
      power += std::abs(sum(at(state.force, A) * at(state.v, A)));
  return power * time / extent_;
}

template <int D>
Real FluidRest<D>::unbalanced_force(const State& state) const {
  Real largest = 0;
  for (const Body<D>* body : bodies_) {
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    for (Index A = 0; A < body->size(); ++A) centre += place_of(*body, state, A) / body->size();
    const bool revolved = body->geometry.grid.revolved;
    if (revolved) centre[0] = 0;
    Mat<D> moment = Mat<D>::Zero();
    Vec<D> sum = Vec<D>::Zero();
    for (Index A = 0; A < body->size(); ++A) {
      const Vec<D> x = (place_of(*body, state, A) - centre).template head<D>(),
                   f = spatial(at(state.force, body->first + A)).template head<D>();
      sum += f;
      moment += f * x.transpose();
    }
    if (revolved) sum[0] = 0;
    largest = std::max({largest, sum.norm(), moment.norm() / extent_});
  }
  return largest;
}

template <int D>
std::string net_forces(const System<D>& system, const State& state) {
  constexpr Real most = 0.1;
  std::string text;
  for (const Body<D>& body : system.bodies) {
    Eigen::Vector3d net = Eigen::Vector3d::Zero();
    Real sizes = 0;
    for (Index A = body.first; A < body.first + body.size(); ++A) {
      net += spatial(at(state.force, A));
      sizes += spatial(at(state.force, A)).norm();
    }
    if (system.revolved()) net[0] = 0;
    if (!(net.norm() > most * sizes)) continue;
    text += text.empty() ? "net force (" : ", (";
    for (int i = 0; i < D; ++i)
      text += fmt::format("{}{:.4g}", i ? ", " : "",
                          std::abs(net[i]) > round_off_of_sums * net.norm() ? net[i] : 0.0);
    text += fmt::format(") on body '{}'", body.name);
  }
  return text;
}

template <int D>
std::string unbalanced(System<D>& system, State& state, Real time) {
  const NodalVectors still(state.u.size(), Lanes::zero());
  system.add_up({time, state.u, still, state.fields}, state.forces());
  const std::string net = net_forces(system, state);
  return net.empty() ? "" : "; " + net + ", which nothing balances";
}

template <int D>
void stop_motion(const System<D>& system, State& state) {
  state.books.dissipated += parallel_sum(system.size(), 0.0, [&](Index A) {
    return 0.5 * at(system.mass, A) * sum(at(state.v, A) * at(state.v, A));
  });
  std::fill(state.v.begin(), state.v.end(), Lanes::zero());
  state.books.scale_momenta(0);
  state.books.heat = state.books.external_power = state.books.load_power = 0;
}

#define MENISCUS_INSTANTIATE(D)                                                        \
  template void remove_free_drift(const System<D>&, const State&, const NodalVectors&, \
                                  NodalVectors&);                                      \
  template class FluidRest<D>;                                                         \
  template std::string net_forces(const System<D>&, const State&);                     \
  template std::string unbalanced(System<D>&, State&, Real);                           \
  template void stop_motion(const System<D>&, State&);
MENISCUS_INSTANTIATE(2)
MENISCUS_INSTANTIATE(3)
#undef MENISCUS_INSTANTIATE

}  // namespace meniscus
