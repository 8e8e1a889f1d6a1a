// SPDX-License-Identifier: BSD-3-Clause
// The number of pairs of contact points of a form of contact.
#pragma once
#include "physics/contact/contact_terms.hpp"
#include "physics/contact/pair/contact_list.hpp"

namespace meniscus::study {

struct ContactCost {
  Real pairs;    ///< pairs of points in the list
  Real spacing;  ///< spacing of the points of the first body
};

/// Cost at the displacement u of both bodies, for points of beta = 1 and constant density.
template <int D>
ContactCost contact_cost(const Body<D>& first, const Body<D>& second, ContactForm form, int points,
                         const ContactLaw& law, Real skin, const NodalVectors& u) {
  const auto points_of = [&](const Body<D>& body) {
    return form == ContactForm::volume
               ? ContactPoints<D>::in_volume(body, 1, points)
               : ContactPoints<D>::on_surface(body, 1, SiteDensity::constant, points);
  };
  const ContactPoints<D> a = points_of(first), b = points_of(second);
  ContactPlaces<D> x = a.at_rest(), y = b.at_rest();
  a.move({0, u, u}, x);
  b.move({0, u, u}, y);
  ContactList<D> list(law.reach(), skin);
  list.update(x.x, y.x);
  return {16 * static_cast<Real>(list.pairs()), a.spacing()};
}

}  // namespace meniscus::study
