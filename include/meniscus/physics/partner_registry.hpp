// SPDX-License-Identifier: BSD-3-Clause
// The registry of rigid partners of a contact.
//
// A partner that scenes can name is a struct in its own file in src/partners, with rows() and
// make(law, beta), which ends with
//   const bool registered = register_partner<2, MyPartner<2>>("my_partner", "what it is") && ...;
#pragma once
#include "meniscus/core/key_table.hpp"
#include "meniscus/core/registry.hpp"
#include "meniscus/physics/rigid_partner.hpp"

#include <functional>
#include <memory>
#include <string_view>
#include <vector>

namespace meniscus {

/// Makes a partner with `beta` particles of the interaction per volume; throws InputError for
/// numbers that make none.
template <int D>
using PartnerMaker = std::function<std::unique_ptr<RigidPartner<D>>(const ContactLaw&, Real beta)>;

template <int D>
struct PartnerEntry {
  static constexpr const char* kind = "rigid partner";
  std::string_view name, meaning;
  std::vector<KeyText> (*keys)();
  PartnerMaker<D> (*read)(const Block&);  ///< notes problems in the block
};

template <int D>
const Registry<PartnerEntry<D>>& partners() {
  return Registry<PartnerEntry<D>>::all();
}

template <int D, class P>
bool register_partner(std::string_view name, std::string_view meaning) {
  return register_entry(PartnerEntry<D>{name, meaning, [] { return key_texts(P::rows()); },
                                        [](const Block& block) -> PartnerMaker<D> {
                                          return [partner = meniscus::read<P>(block)](
                                                     const ContactLaw& law, Real beta) {
                                            return partner.make(law, beta);
                                          };
                                        }});
}

}  // namespace meniscus
