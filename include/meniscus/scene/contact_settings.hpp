// SPDX-License-Identifier: BSD-3-Clause
// What a scene says about contact: [[contact]] and the rigid partner in it.
#pragma once
#include "meniscus/core/key_table.hpp"
#include "meniscus/physics/contact.hpp"

#include <functional>
#include <map>
#include <optional>

namespace meniscus {

/// [[contact]]
struct ContactSettings {
  std::string name, kernel, form, density;
  std::vector<std::string> bodies;
  Real epsilon = 0, sigma0 = 0, cutoff = 0, least_gap = 0, skin = 0;
  Real beta = 0, beta_other = 0;  ///< of the first body, and of the other side
  int points = 0;
  static Rows<ContactSettings> rows();
};

/// A rigid partner as a scene describes it, without the interaction.
template <int D>
struct PartnerPlan {
  std::function<std::unique_ptr<RigidPartner<D>>(const ContactLaw&, Real beta)> make;
  std::vector<Expression> displacement;  ///< of the time; empty: at rest
};

/// Reads [contact.partner]; problems are noted in the block, and `make` may then be empty.
template <int D>
PartnerPlan<D> read_partner(const Block& block);

/// The keys of [[contact]] and of all rigid partners.
std::vector<KeyTable> contact_key_tables();

}  // namespace meniscus
