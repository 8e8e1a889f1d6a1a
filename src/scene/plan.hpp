// SPDX-License-Identifier: BSD-3-Clause
// Plan of a scene: its input, read and checked before anything large is built.
#pragma once
#include "meniscus/body/geometry.hpp"
#include "meniscus/core/error.hpp"
#include "meniscus/physics/material.hpp"
#include "meniscus/scene/contact_settings.hpp"
#include "meniscus/scene/scene.hpp"

#include <memory>
#include <string>
#include <vector>

namespace meniscus {

template <int D>
struct PlannedContact {
  ContactSettings settings;
  std::optional<PartnerPlan<D>> partner;  ///< none: between two bodies
  std::string place;                      ///< of its table, to begin messages with
};

template <int D>
struct Plan {
  struct PlannedBody {
    BodySettings settings;
    Geometry<D> geometry;
    std::unique_ptr<Material<D>> material;
    bool enclosed = false;  ///< Integration::enclosed
  };
  std::vector<PlannedBody> bodies;
  std::vector<TensionSettings> tensions;
  std::vector<BodyForceSettings> body_forces;
  std::vector<CavitySettings> cavities;
  std::vector<ProfileSettings> profiles;
  std::vector<ExactSettings> exact;
  std::vector<PlannedContact<D>> contacts;

  /// Notes a problem at `key` if there is no body of that name.
  const PlannedBody* require(const Block& block, const std::string& name,
                             const char* key = "body") const;
};

/// A body of a system. Throws InputError if there is none of that name.
template <int D>
const Body<D>& body_named(const System<D>& system, const std::string& name) {
  for (const Body<D>& body : system.bodies)
    if (body.name == name) return body;
  throw InputError("there is no body '" + name + "'");
}

/// Reads title, units, [time], [output] and [expect] into `scene`, and bodies and loads into the
/// plan. Throws InputError with all problems at once.
template <int D>
Plan<D> read_plan(const SceneInput& input, Scene<D>& scene);

/// Reads all [[contact]]; the bodies are planned already.
template <int D>
void plan_contacts(const Block& root, Plan<D>& plan);

/// Adds the contacts to a scene that has its bodies and initial state. Throws InputError if two
/// surfaces start closer than least_gap.
template <int D>
void build_contacts(const Plan<D>& plan, Scene<D>& scene);

}  // namespace meniscus
