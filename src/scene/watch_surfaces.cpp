// SPDX-License-Identifier: BSD-3-Clause
// Checks for crossing surfaces, and for bodies that touch without a contact.
#include "scene/watch_surfaces.hpp"

#include "input/text.hpp"
#include "meniscus/error.hpp"
#include "physics/contact/points/containment.hpp"
#include "physics/surface/surface_check.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <memory>
#include <set>
#include <utility>

namespace meniscus {
namespace {

template <int D>
std::vector<const Body<D>*> bodies_of(const Scene<D>& scene) {
  std::vector<const Body<D>*> bodies;
  for (const Body<D>& body : scene.system.bodies) bodies.push_back(&body);
  return bodies;
}

/// Pairs of bodies with a contact; the names of each pair are in both orders.
using Pairs = std::set<std::pair<std::string, std::string>>;

template <int D>
Pairs pairs_in_contact(const Scene<D>& scene) {
  Pairs pairs;
  for (const ContactBetween& contact : scene.contacts)
    if (contact.bodies.size() == 2) {
      pairs.emplace(contact.bodies[0], contact.bodies[1]);
      pairs.emplace(contact.bodies[1], contact.bodies[0]);
    }
  return pairs;
}

std::string missing_contact(const std::string& first, const std::string& second) {
  return fmt::format(
      "nothing keeps them apart: add a [[contact]] with bodies = [\"{}\", \"{}\"], or move them "
      "farther apart",
      first, second);
}

/// Ends the message about crossing surfaces of two bodies (or one body) with a remedy.
std::string remedy(const Pairs& contacts, const std::string& first, const std::string& second) {
  if (first == second)
    return "a body has no contact with itself: load it less, or make it thicker, stiffer or finer";
  if (contacts.contains({first, second}))
    return "their [[contact]] does not hold them: less speed, softer bodies, a stronger "
           "interaction or more points do";
  return missing_contact(first, second);
}

/// Check that no body enters another, for pairs without a contact. Contacts check their own pairs.
template <int D>
StateCheck containment_without_contact(const Scene<D>& scene) {
  const auto bodies = bodies_of(scene);
  const Pairs contacts = pairs_in_contact(scene);
  const auto n = bodies.size();
  std::vector<bool> watched(n * n, false);
  for (std::size_t a = 0; a < n; ++a)
    for (std::size_t b = 0; b < n; ++b)
      watched[a * n + b] = !contacts.contains({bodies[a]->name, bodies[b]->name});
  return [bodies, n, watched](const Motion& motion) -> std::optional<Failure> {
    auto found = any_body_inside<D>(
        bodies, motion, [&](std::size_t a, std::size_t b) { return watched[a * n + b]; });
    if (!found) return std::nullopt;
    found->failure.cause +=
        "; " + missing_contact(bodies[found->first]->name, bodies[found->second]->name);
    return found->failure;
  };
}

template <int D>
void note_missing_contacts(Scene<D>& scene) {
  constexpr std::size_t most = 10;
  std::vector<std::string> pairs;
  const auto bodies = bodies_of(scene);
  const Pairs contacts = pairs_in_contact(scene);
  for (std::size_t a = 0; a < bodies.size(); ++a)
    for (std::size_t b = a + 1; b < bodies.size(); ++b)
      if (!contacts.contains({bodies[a]->name, bodies[b]->name}))
        pairs.push_back(fmt::format("'{}' and '{}'", bodies[a]->name, bodies[b]->name));
  if (pairs.empty()) return;
  const std::size_t more = pairs.size() - std::min(most, pairs.size());
  pairs.resize(pairs.size() - more);
  scene.notes.push_back(
      fmt::format("no [[contact]] keeps apart {}{}: the run stops if their surfaces meet",
                  joined(pairs, "; "), more > 0 ? fmt::format("; and {} more pairs", more) : ""));
}

}  // namespace

template <int D>
void watch_surfaces(Scene<D>& scene, bool begins) {
  const auto bodies = bodies_of(scene);
  const auto surfaces = std::make_shared<const SurfaceCheck<D>>(
      bodies, [contacts = pairs_in_contact(scene), bodies](std::size_t a, std::size_t b) {
        return remedy(contacts, bodies[a]->name, bodies[b]->name);
      });
  if (bodies.size() > 1) scene.checks.push_back(containment_without_contact(scene));
  if (begins) {
    const Motion motion = scene.initial.motion();
    auto failure = bodies.size() > 1 ? scene.checks.back()(motion) : std::nullopt;
    // J detects bodies that start inside out better than crossing surfaces do.
    if (!failure) failure = surfaces->crossing(motion);
    if (failure) throw InputError(scene.system.located(*failure, motion).text());
    note_missing_contacts(scene);
  }
  scene.surfaces = [surfaces](const Motion& motion) { return surfaces->find(motion); };
}

template void watch_surfaces(Scene<2>&, bool);
template void watch_surfaces(Scene<3>&, bool);

}  // namespace meniscus
