// SPDX-License-Identifier: BSD-3-Clause
// Finds the rigid motions that no force resists.
#include "solve/free_motions.hpp"

#include "parallel/nodal_algebra.hpp"

#include <cmath>

namespace meniscus {
namespace {

template <int D>
Vec<D> place(const Body<D>& body, const NodalVectors& u, Index A) {
  Vec<D> x = at(body.particles.X(), A);
  for (int i = 0; i < D; ++i) x[i] += at(u, body.first + A)[i];
  return x;
}

/// The rigid motions of bodies: D translations, then the rotations about the common centre.
template <int D>
std::vector<NodalVectors> rigid_motions(const std::vector<const Body<D>*>& bodies,
                                        const NodalVectors& u) {
  Vec<D> middle = Vec<D>::Zero();
  Real count = 0;
  for (const Body<D>* body : bodies)
    for (Index A = 0; A < body->size(); ++A, ++count) middle += place(*body, u, A);
  middle /= count;
  std::vector<NodalVectors> modes(D * (D + 1) / 2, NodalVectors(u.size(), Lanes::zero()));
  for (const Body<D>* body : bodies)
    for (Index A = 0; A < body->size(); ++A) {
      const Vec<D> x = place(*body, u, A) - middle;
      std::size_t k = 0;
      for (int i = 0; i < D; ++i) at(modes[k++], body->first + A).set(i, 1);
      for (int i = 0; i < D; ++i)
        for (int j = i + 1; j < D; ++j, ++k) {
          at(modes[k], body->first + A).set(i, x[j]);
          at(modes[k], body->first + A).set(j, -x[i]);
        }
    }
  return modes;
}

}  // namespace

/// Finds the free motions. At a slightly disturbed state without symmetry, forces have no component
/// along a free motion, and nearly always have one along a motion that is not free. Forces of
/// different terms may balance each other along a translation, since constant forces do.
template <int D>
FreeMotions<D>::FreeMotions(System<D>& system, const Motion& motion, Real scale,
                            typename System<D>::Wanted wanted) {
  constexpr Real disturbance = 1e-3, round_off = 1e-9;
  NodalVectors u(motion.u.begin(), motion.u.end());
  const NodalVectors still(u.size(), Lanes::zero());
  for (std::size_t A = 0; A < u.size(); ++A)
    for (int i = 0; i < D; ++i)
      u[A].set(i, u[A][i] + disturbance * scale *
                                std::sin(static_cast<Real>(A) * (12.9898 + i * 7.31) + i));
  std::vector<NodalVectors> forces;
  for (auto& term : system.terms) {
    if (!wanted(*term)) continue;
    forces.push_back(still);
    system.add_force(*term, {motion.time, u, still, motion.fields}, forces.back());
  }
  std::vector<Real> held(system.constraints ? static_cast<std::size_t>(system.constraints->rows())
                                            : 0);
  const auto free = [&](const NodalVectors& mode, bool translation) {
    if (system.constraints) system.constraints->apply(mode, held);
    for (const Real x : held)
      if (std::abs(x) > round_off * scale) return false;
    Lanes all = Lanes::zero();
    for (const NodalVectors& f : forces) {
      const Lanes power = parallel_sum(system.size(), Lanes::zero(), [&](Index A) {
        const Lanes part = at(f, A) * at(mode, A);
        return Lanes(sum(part), sum(max(part, -1.0 * part)), 0, 0);
      });
      if (!translation && std::abs(power[0]) > round_off * power[1]) return false;
      all += power;
    }
    return std::abs(all[0]) <= round_off * all[1];
  };
  const NodalVectors here(motion.u.begin(), motion.u.end());
  const auto keep_free = [&](const std::vector<const Body<D>*>& bodies) {
    const std::vector<NodalVectors> nearby = rigid_motions<D>(bodies, u);
    std::vector<NodalVectors> modes = rigid_motions<D>(bodies, here);
    bool all = true;
    for (std::size_t k = 0; k < modes.size(); ++k) {
      if (free(nearby[k], k < D))
        add(std::move(modes[k]));
      else
        all = false;
    }
    return all;
  };
  std::vector<const Body<D>*> bound;
  for (const Body<D>& body : system.bodies)
    if (!keep_free({&body})) bound.push_back(&body);
  if (bound.size() > 1) keep_free(bound);
}

template <int D>
void FreeMotions<D>::add(NodalVectors mode) {
  constexpr Real independent = 1e-6;
  const Real before = std::sqrt(dot(mode, mode));
  for (int pass = 0; pass < 2; ++pass) remove_from(mode);
  const Real size = std::sqrt(dot(mode, mode));
  if (!(size > independent * before)) return;
  for (NodalVector& w : mode) w = w / size;
  modes_.push_back(std::move(mode));
}

template <int D>
void FreeMotions<D>::remove_from(NodalVectors& w) const {
  for (const NodalVectors& mode : modes_) meniscus::add(w, -dot(w, mode), mode);
}

template class FreeMotions<2>;
template class FreeMotions<3>;

}  // namespace meniscus
