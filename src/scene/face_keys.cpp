// SPDX-License-Identifier: BSD-3-Clause
// Keys that name faces, for loads.
#include "scene/face_keys.hpp"

#include "input/names.hpp"
#include "meniscus/error.hpp"

#include <fmt/core.h>

namespace meniscus {
template <int D>
void FaceKeys::check(const Block& block, const BodyPlans<D>& bodies) const {
  const BodyPlan<D>* planned = require_body(block, bodies, body);
  if (where && where->depends_on_time())
    block.problem("where", "depends on t; allowed are x, y, z");
  if (!planned || face.empty()) return;
  std::vector<std::string> known;
  for (const auto& [name, facets] : face_names(planned->geometry)) {
    if (name == face) return;
    known.push_back(name);
  }
  block.problem("face", fmt::format("body '{}' has no face '{}'; {}", body, face,
                                    allowed_names(face, known)));
}

template <int D>
void FaceKeys::require_named(const Block& block, const BodyPlans<D>& bodies,
                             std::string_view what) const {
  if (!face.empty() || where) return;
  std::string faces;
  for (const BodyPlan<D>& planned : bodies)
    if (planned.settings.name == body && planned.in_order)
      for (const auto& [name, facets] : face_names(planned.geometry))
        faces += (faces.empty() ? ", of " : ", ") + name;
  block.problem("face", fmt::format("missing; {}: give face{}, or where", what, faces));
}

template <int D>
FaceCells<D> FaceKeys::cells(const std::string& place, const Body<D>& on) const {
  try {
    return face_cells(on, {face, where});
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}; allowed is a formula that is not zero somewhere on it",
                                 place, error.what()));
  }
}

#define MENISCUS_INSTANTIATE(D)                                                              \
  template void FaceKeys::check(const Block&, const BodyPlans<D>&) const;                    \
  template void FaceKeys::require_named(const Block&, const BodyPlans<D>&, std::string_view) \
      const;                                                                                 \
  template FaceCells<D> FaceKeys::cells(const std::string&, const Body<D>&) const;
MENISCUS_INSTANTIATE(2)
MENISCUS_INSTANTIATE(3)
#undef MENISCUS_INSTANTIATE

}  // namespace meniscus
