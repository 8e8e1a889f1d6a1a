// SPDX-License-Identifier: BSD-3-Clause
// Pairs of small bodies a gap apart, for tests of contact.
#pragma once
#include "physics/contact/contact_terms.hpp"
#include "support.hpp"

namespace meniscus::test {

/// Two bodies, their particles numbered one body after the other, and masses.
template <int D>
struct Pair {
  std::unique_ptr<Body<D>> first, second;

  Index size() const { return first->size() + second->size(); }
  NodalVectors random(Real size, unsigned seed) const {
    return random_field<D>(this->size(), size, seed);
  }
  /// Values f(X) of a vector field on both bodies.
  template <class F>
  NodalVectors field(F&& f) const {
    NodalVectors values = field_on<D>(*first, f);
    const NodalVectors other = field_on<D>(*second, f);
    values.insert(values.end(), other.begin(), other.end());
    return values;
  }
};

template <int D>
std::unique_ptr<Body<D>> with_mass(Geometry<D> geometry, Index first = 0) {
  auto body = body_of<D>(std::move(geometry));
  body->first = first;
  body->mass.assign(static_cast<std::size_t>(body->size()), 0.01);
  return body;
}

/// A ball (2D: disk) of radius 1 about `centre`.
template <int D>
Geometry<D> round(const Vec<D>& centre, int core = 4) {
  if constexpr (D == 3) {
    Ball shape;
    shape.core = core;
    shape.layers = core / 2;
    shape.centre = {centre[0], centre[1], centre[2]};
    return shape.geometry();
  } else {
    Disk shape;
    shape.core = core;
    shape.rings = core / 2;
    shape.centre = {centre[0], centre[1]};
    return shape.geometry();
  }
}

/// Two bodies of radius 1 whose centres lie on an oblique line; their surfaces are `gap` apart.
template <int D>
Pair<D> round_pair(Real gap, int core = 4) {
  Vec<D> axis = Vec<D>::Constant(0.3);
  axis[0] = 1;
  axis.normalize();
  Pair<D> pair;
  pair.first = with_mass<D>(round<D>(Vec<D>::Zero(), core));
  pair.second = with_mass<D>(round<D>((2 + gap) * axis, core), pair.first->size());
  return pair;
}

template <int D>
ContactLaw law(PairKernel kernel = D == 3 ? PairKernel::space : PairKernel::integrated,
               Real sigma0 = 0.5) {
  ContactLaw l;
  l.kernel = kernel;
  l.epsilon = 1.3;
  l.sigma0 = sigma0;
  l.cutoff = 4;
  return l;
}

template <int D>
std::unique_ptr<ForceTerm> contact_of(const Pair<D>& pair, const ContactLaw& law, ContactForm form,
                                      SiteDensity density = SiteDensity::constant) {
  ContactChoice choice;
  choice.name = "pair";
  choice.form = form;
  choice.density = density;
  return contact_pair<D>({*pair.first, 1.2}, {*pair.second, 0.7}, law, choice);
}

}  // namespace meniscus::test
