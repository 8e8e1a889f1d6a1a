// SPDX-License-Identifier: BSD-3-Clause
// Assembly: collects what loads add to a scene.
#include "meniscus/scene/assembly.hpp"

#include "meniscus/error.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>

namespace meniscus {

template <int D>
std::size_t Assembly<D>::number_of(const std::string& body) const {
  const auto& bodies = scene_.system.bodies;
  for (std::size_t b = 0; b < bodies.size(); ++b)
    if (bodies[b].name == body) return b;
  throw InputError("there is no body '" + body + "'");
}

template <int D>
const Body<D>& Assembly<D>::body(const std::string& name) const {
  return scene_.system.bodies[number_of(name)];
}

template <int D>
void Assembly<D>::add(std::unique_ptr<ForceTerm> term, const std::string& prefix) {
  for (MeasureSource& source : term->measures()) measure(prefix, std::move(source));
  for (FieldSource& source : term->fields()) field(prefix, std::move(source));
  scene_.system.terms.push_back(std::move(term));
}

template <int D>
void Assembly<D>::field(const std::string& body, FieldSource source) {
  scene_.fields.push_back({number_of(body), std::move(source)});
}

template <int D>
void Assembly<D>::measure(const std::string& prefix, MeasureSource source) {
  source.name = prefix + "." + source.name;
  if (has_measure(source.name))
    throw std::logic_error("there are two measures called '" + source.name + "'");
  scene_.measures.push_back(std::move(source));
}

template <int D>
void Assembly<D>::record(const std::string& prefix, MeasureSource source) {
  scene_.output.measures.push_back(prefix + "." + source.name);
  measure(prefix, std::move(source));
}

template <int D>
void Assembly<D>::measure_of_cap(const std::string& body, const std::string& prefix,
                                 MeasureSource source, const std::string& place,
                                 std::optional<MeasureSource> otherwise) {
  const std::string named = prefix + "." + source.name;
  if (otherwise) otherwise->name = named;
  caps_[body].push_back({named, place, std::move(otherwise)});
  measure(prefix, std::move(source));
}

template <int D>
void Assembly<D>::withhold_caps() {
  const auto is_asked_for = [&](const std::string& name) {
    const auto& measures = scene_.output.measures;
    return std::find(measures.begin(), measures.end(), name) != measures.end() ||
           std::any_of(scene_.expectations.begin(), scene_.expectations.end(),
                       [&](const auto& expectation) { return expectation.second.of == name; });
  };
  for (const auto& of_body : caps_) {
    const std::string& body = of_body.first;
    const auto bodies = std::count_if(
        scene_.contacts.begin(), scene_.contacts.end(), [&](const ContactBetween& contact) {
          return contact.bodies.size() > 1 &&
                 std::count(contact.bodies.begin(), contact.bodies.end(), body) > 0;
        });
    const auto contacts = static_cast<std::size_t>(bodies) + walls_of(body)->size();
    if (contacts < 2) continue;
    const std::string why = fmt::format(
        "body '{}' has {} contacts, and the free surface of a drop between walls is no part of a "
        "sphere",
        body, contacts);
    std::string all;
    for (const CapMeasure& cap : of_body.second) {
      if (cap.otherwise) {
        for (MeasureSource& m : scene_.measures)
          if (m.name == cap.name) m = *cap.otherwise;
        continue;
      }
      if (is_asked_for(cap.name))
        throw InputError(fmt::format(
            "{}: '{}' is not measured: {}; leave it out of output.measures and of [expect]",
            cap.place, cap.name, why));
      all += (all.empty() ? "" : ", ") + cap.name;
      std::erase_if(scene_.measures, [&](const MeasureSource& m) { return m.name == cap.name; });
    }
    note(fmt::format("not measured: {}: {}", all, why));
  }
}

template <int D>
bool Assembly<D>::has_measure(const std::string& name) const {
  return std::any_of(scene_.measures.begin(), scene_.measures.end(),
                     [&](const MeasureSource& other) { return other.name == name; });
}

template <int D>
std::vector<FieldSource> Assembly<D>::fields_of(const std::string& body) const {
  std::vector<FieldSource> sources;
  for (const BodyField& field : scene_.fields)
    if (field.body == number_of(body)) sources.push_back(field.source);
  return sources;
}

template <int D>
std::function<Real(const Motion&)> Assembly<D>::measure_named(const std::string& name) const {
  for (const MeasureSource& source : scene_.measures)
    if (source.name == name) return source.compute;
  throw std::logic_error("there is no measure '" + name + "'");
}

/// Shear modulus of a body, computed once because many contacts may use it.
template <int D>
Real Assembly<D>::shear_modulus(const std::string& name) const {
  const auto [known, is_new] = shear_modulus_.try_emplace(name);
  if (is_new) known->second = find_shear_modulus(name);
  return known->second;
}

template <int D>
Real Assembly<D>::find_shear_modulus(const std::string& name) const {
  constexpr Real small = 1e-4;
  const Body<D>& sheared = body(name);
  const ForceTerm& force = *of(name).internal_force;
  // Kept between calls because these arrays have the length of all bodies together; all other
  // entries are zero.
  rest_.resize(scene_.system.mass.size(), Lanes::zero());
  sheared_.resize(rest_.size(), Lanes::zero());
  const std::span<NodalVector> u = sheared.part(std::span(sheared_));
  // Along y by x, since along x by y stretches the circles around the axis of a body of revolution.
  const auto strain_energy = [&](Real shear) {
    for (Index A = 0; A < sheared.size(); ++A) at(u, A).set(1, shear * sheared.origin(A)[0]);
    return force.stored_energy({0, sheared_, rest_}).value_or(0);
  };
  // The even part of the energy: a stressed reference adds a part that is linear in the shear.
  const Real energy = (strain_energy(small) + strain_energy(-small)) / 2;
  return 2 * (energy - strain_energy(0)) / (small * small * sheared.volume());
}

/// Acceleration of a body by its loads: their power on a uniform unit velocity along an axis is the
/// force along it.
template <int D>
Vec<D> Assembly<D>::acceleration(const std::string& name) const {
  const Body<D>& moved = body(name);
  const State& begin = scene_.initial;
  Real mass = 0;
  for (const Real m : moved.mass) mass += m;
  Vec<D> force = Vec<D>::Zero();
  for (int i = 0; i < D; ++i) {
    NodalVectors v(begin.v.size(), Lanes::zero());
    for (NodalVector& own : moved.part(std::span(v))) own.set(i, 1);
    for (const auto& term : scene_.system.terms)
      force[i] += term->load_power({begin.time, begin.u, v, begin.fields});
  }
  return force / mass;
}

template <int D>
std::function<Vec<D>(Real)> Assembly<D>::weight(const std::string& name) const {
  const Body<D>& on = body(name);
  const Real mass = std::accumulate(on.mass_integral.begin(), on.mass_integral.end(), 0.0);
  return [accelerations = of(name).accelerations, mass](Real time) {
    Vec<D> sum = Vec<D>::Zero();
    for (const std::vector<Expression>& acceleration : accelerations)
      for (int i = 0; i < D; ++i) sum[i] += mass * at(acceleration, i)({0, 0, 0}, time);
    return sum;
  };
}

template class Assembly<2>;
template class Assembly<3>;

}  // namespace meniscus
