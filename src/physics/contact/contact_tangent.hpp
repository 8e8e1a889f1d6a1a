// SPDX-License-Identifier: BSD-3-Clause
// The tangent of contact with a rigid partner.
#pragma once
#include "meniscus/physics/contact.hpp"

namespace meniscus {

/// Points of a body in the field of a partner.
template <int D>
struct PartnerContact {
  Vec<D> shift;  ///< of the partner
  std::span<const Index> clusters;
  const ContactPlaces<D>& places;
  std::span<const Lanes> S;          ///< [cluster][i] dE/dV
  std::span<const Lanes> distances;  ///< [cluster] from the partner
  Real least_gap;
};

/// force += the change of the forces of the partner on the points.
template <int D>
void add_tangent_of_partner(ContactPoints<D>& points, const RigidPartner<D>& partner,
                            ContactForm form, const PartnerContact<D>& now, const Motion& motion,
                            const Motion& change, std::span<NodalVector> force);

}  // namespace meniscus
