// SPDX-License-Identifier: BSD-3-Clause
// Finds where a pressed partner is in balance.
#include "physics/contact/rigid/partner_press.hpp"

#include <algorithm>
#include <cmath>

namespace meniscus {
namespace {

/// A way and the force g = R.n + k (s - b) - F that is left there; a minimum has g = 0 and rises.
struct Place {
  Real s, g;
};

constexpr Real round_off = 1e-13;

}  // namespace

template <int D>
Real PartnerPress<D>::energy(Real time) const {
  const Real stretch = way_ - base(time);
  return stiffness() / 2 * stretch * stretch - force(time) * way_;
}

template <int D>
Real PartnerPress<D>::work(const Moment& before, const Moment& after) const {
  const Real way = (before.way + after.way) / 2, base = (before.base + after.base) / 2;
  return -way * (after.force - before.force) -
         stiffness() * (way - base) * (after.base - before.base);
}

template <int D>
void PartnerPress<D>::archive(const Archive& a) {
  const Dimension of_force = of_sum(dimension::force, D);
  a("press_begun", begun_);
  a("way", last_.way, dimension::length);
  a("press_force", last_.force, of_force);
  a("base", last_.base, dimension::length);
  if (a.is_reading()) way_ = last_.way;
}

template <int D>
bool PartnerPress<D>::settle(Real time, Neighbour& body, Real length, Real longest) {
  const Real F = force(time), b = base(time), k = stiffness(), start = last_.way;
  Real bearable = 0;
  const auto at_way = [&](Real s) -> Place {
    way_ = s;
    const Real pull = body.pull();
    bearable = round_off * (std::abs(pull) + std::abs(F) + k * std::abs(s - b));
    return {s, pull + k * (s - b) - F};
  };
  const auto done = [&](const Place& place) { return std::abs(place.g) <= bearable; };

  // Secants, as long as they lead uphill in g and not far away.
  const Place first = at_way(start);
  if (done(first)) return true;
  const Real downhill = first.g > 0 ? -1 : 1;
  constexpr Real part_of_length = 1e-3, far = 0.2;
  Place before = first, here = at_way(start + downhill * part_of_length * length);
  for (int trial = 0; trial < 20; ++trial) {
    if (done(here)) return true;
    const Real slope = (here.g - before.g) / (here.s - before.s), step = -here.g / slope;
    if (!(slope > 0) || !(std::abs(here.s + step - start) <= far * length)) break;
    before = here;
    if (here.s + step == here.s) return true;
    here = at_way(here.s + step);
  }

  // Otherwise downhill until g changes its sign, with steps that do not go through the body.
  before = here = first;
  for (Real step = length / 10;; step = std::min(1.3 * step, length / 4)) {
    way_ = before.s;
    const Real gap = body.gap();
    here = at_way(before.s + downhill * std::max(step, gap > 10 * length ? gap / 2 : 0));
    if (done(here)) return true;
    if (!(here.g * before.g > 0)) break;
    if (!(std::abs(here.s - start) < longest)) return false;
    before = here;
  }

  // Between both: regula falsi (Illinois), whose bracket always shrinks.
  for (int trial = 0; trial < 200; ++trial) {
    const Real s = here.s - here.g * (here.s - before.s) / (here.g - before.g);
    if (s == here.s || s == before.s) break;
    const Place next = at_way(s);
    if (done(next)) return true;
    if (next.g * here.g < 0)
      before = here;
    else
      before.g /= 2;
    here = next;
  }
  at_way(here.s);
  return true;
}

template class PartnerPress<2>;
template class PartnerPress<3>;

}  // namespace meniscus
