// SPDX-License-Identifier: BSD-3-Clause
// The share of each term in the stiffness of a mode.
#include "solve/stiffest_term.hpp"

#include "parallel/nodal_algebra.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace meniscus {
namespace {

std::string_view remedy(std::string_view energy_kind) {
  if (energy_kind == "contact")
    return "surfaces are pressed together there: slower or softer bodies press less, a longer "
           "range "
           "or sigma0 is softer";
  if (energy_kind == "surface" || energy_kind == "anchoring")
    return "the surface is stretched or folded there: refer a drop anew in time (the condition of "
           "[[remap]]), or use finer cells";
  if (energy_kind == "strain")
    return "cells are stretched or pressed flat there: refer a drop anew in time (the condition of "
           "[[remap]]), use finer cells, a softer material, or slower loads";
  return "lower its numbers, or let it act more slowly";
}

}  // namespace

template <int D>
std::string describe_stiffest_term(System<D>& system, const State& state,
                                   std::span<const NodalVector> mode, Real size) {
  NodalVectors moved(mode.size(), Lanes::zero()), before(mode.size()), after(mode.size());
  system.for_particles([&](Index begin, Index end) {
    for (Index A = begin; A < end; ++A) at(moved, A) = at(state.u, A) + size * at(mode, A);
  });
  std::vector<Unknown> fields = state.fields;
  const auto force_of = [&](ForceTerm& term, const NodalVectors& u, NodalVectors& force) {
    std::fill(force.begin(), force.end(), Lanes::zero());
    for (Unknown& field : fields) clear(field.f);
    system.add_force(term, {state.time, u, state.v, state.fields}, {force, fields});
  };
  Real all = 0, most = 0;
  const ForceTerm* stiffest = nullptr;
  for (const auto& term : system.terms) {
    force_of(*term, state.u, before);
    force_of(*term, moved, after);
    const Real stiffness = system.sum_over_particles(
        Real{0}, [&](Index A) { return sum(at(mode, A) * (at(before, A) - at(after, A))) / size; });
    all += stiffness;
    if (!(stiffness > most)) continue;
    most = stiffness;
    stiffest = term.get();
  }
  if (!stiffest || !std::isfinite(most) || !(all > 0)) return {};
  return fmt::format("; {:.0f} % of the stiffness is that of the {}: {}",
                     100 * std::min(1.0, most / all), stiffest->name(),
                     remedy(stiffest->energy_kind()));
}

template std::string describe_stiffest_term(System<2>&, const State&, std::span<const NodalVector>,
                                            Real);
template std::string describe_stiffest_term(System<3>&, const State&, std::span<const NodalVector>,
                                            Real);

}  // namespace meniscus
