// SPDX-License-Identifier: BSD-3-Clause
// Time of the pair functions and of the forms of contact per pair, and of rigid partners per point.
#include "measure.hpp"
#include "physics/contact/pair/contact_list.hpp"
#include "physics/contact/pair/contact_visits.hpp"
#include "physics/contact/points/contact_points.hpp"
#include "physics/contact/rigid/rigid_partner.hpp"
#include "scene/scene.hpp"
#include "solve/step/central_difference.hpp"

#include <fmt/core.h>

#include <memory>
#include <string>
#include <vector>

namespace meniscus::bench {
namespace {

constexpr int pairs = 4096;

template <class Scalar, class Law>
double shortest_of_pairs(benchmark::State& state, const Law& law, bool volume) {
  std::vector<Real> squares;
  for (int i = 0; i < pairs; ++i) squares.push_back(0.2 + 15 * ((i * 193) % pairs) / Real(pairs));
  constexpr int width = sizeof(Scalar) / sizeof(Real);
  return shortest(state, [&] {
    Scalar first(0.0), second(0.0);
    for (std::size_t i = 0; i < squares.size(); i += width) {
      Scalar square(0.0);
      __builtin_memcpy(&square, &squares[i], sizeof(Scalar));
      if (volume) {
        const auto f = law.volume(square);
        first += f.phi;
        second += f.dphi_by_r;
      } else {
        const auto f = law.surface(square);
        first += f.u;
        second += f.psi;
      }
    }
    benchmark::DoNotOptimize(first);
    benchmark::DoNotOptimize(second);
  });
}

void add_pair_case(PairKernel kernel, bool volume) {
  const std::string name =
      std::string(name_of(kernel)) + (volume ? ", phi and phi'/r" : ", u and psi");
  add_case("pair functions", name, 1, [kernel, volume](benchmark::State& state) {
    with_kernel(kernel, [&](auto K) {
      const PairLaw<K()> law(ContactLaw{kernel, 1, 1, 4});
      const double lanes = shortest_of_pairs<Lanes>(state, law, volume);
      set_columns(state, {{"ns/pair", 1e9 * lanes / pairs}});
    });
  });
}

/// Two balls of radius 3 sigma0 at the equilibrium gap of planes.
Scene<3> two_balls(const std::string& form) {
  const auto ball = [](const char* name, Real z) {
    return fmt::format(
        "[[body]]\nname = '{}'\nshape = 'ball'\nradius = 3\ncore = 8\nlayers = 4\n"
        "centre = [0, 0, {}]\nmaterial = {{ type = 'neo_hookean', density = 1, mu = 1, lambda = 1 "
        "}}\n",
        name, z);
  };
  const SceneInput input = SceneInput::from_text(
      "dimension = 3\ntime.end = 1\n" + ball("one", 0) + ball("two", 6.64) +
      fmt::format("[[contact]]\nbodies = ['one', 'two']\nepsilon = 1\nsigma0 = 1\nbeta = "
                  "1\npoints = 2\nform = '{}'\n",
                  form));
  scene_dimension(input);
  return build_scene<3>(input);
}

/// Pairs of points in the list; each pair acts on both points.
Real pairs_of(const Scene<3>& scene, bool volume) {
  const auto points = [&](std::size_t k) {
    const Body<3>& body = scene.system.bodies.at(k);
    return volume ? ContactPoints<3>::in_volume(body, 1, 2)
                  : ContactPoints<3>::on_surface(body, 1, SiteDensity::constant, 2);
  };
  ContactList<3> list(4, 0.4);
  list.update(points(0).at_rest().x, points(1).at_rest().x);
  return Lanes::width * Lanes::width * static_cast<Real>(list.pairs());
}

void add_form_case(const std::string& form) {
  add_case("forms of contact, both bodies, list and scatter included", form, 1,
           [form](benchmark::State& state) {
             const Scene<3> scene = two_balls(form);
             const Real count = pairs_of(scene, form == "volume");
             ForceTerm& term = *scene.system.terms.back();
             NodalVectors sum(scene.initial.u.size(), Lanes::zero());
             const double time =
                 shortest(state, [&] { term.add_force(scene.initial.motion(), sum); });
             set_columns(state, {{"ns/pair", 1e9 * time / count}, {"pairs", count}});
           });
}

template <int D>
void add_partner_case(const std::string& name, std::shared_ptr<const RigidPartner<D>> partner,
                      Vec<D> from, Vec<D> to) {
  add_case("rigid partners", name, 1, [=](benchmark::State& state) {
    const double time = shortest(state, [&] {
      for (int i = 0; i < 256; ++i) {
        const auto f = partner->field(Vec<D>(from + (to - from) * (i / 256.0)));
        benchmark::DoNotOptimize(f);
      }
    });
    set_columns(state, {{"ns/point", 1e9 * time / 256}});
  });
}

/// A step of the scene cylinder_impact. The left cylinder is `gap` sigma0 from a wall and from the
/// right cylinder, so that all contacts act.
void add_impact_case(const std::string& name, Real gap) {
  add_case("step of the impact of two cylinders, 1 thread", name, 1,
           [gap](benchmark::State& state) {
             const Real centre = -3 + 0.2 * gap;
             const SceneInput input = SceneInput::from_file(
                 MENISCUS_SOURCE_DIR "/inputs/contact/cylinder_impact.toml",
                 {fmt::format("body.left.centre=[{}, 0]", centre),
                  fmt::format("body.right.centre=[{}, 0]", centre + 2 + 0.2 * gap)});
             scene_dimension(input);
             Scene<2> scene = build_scene<2>(input);
             State moving = scene.initial;
             start(scene.system, moving);
             NodalVectors sum = moving.force;
             const Shares shares = shortest_step(
                 state, scene.system.terms.size(), [&] { advance(scene.system, moving, 1e-9); },
                 [&](std::size_t k) { scene.system.terms[k]->add_force(moving.motion(), sum); });
             // The terms are the internal forces of both bodies, their contact, and their contacts
             // with the frame.
             const Real internal = shares.part.at(0) + shares.part.at(1), pair = shares.part.at(2),
                        frame = shares.part.at(3) + shares.part.at(4);
             set_columns(state, {{"ns/particle-step", 1e9 * shares.step / scene.system.size()},
                                 {"% internal", internal},
                                 {"% contact of both", pair},
                                 {"% frame", frame},
                                 {"% rest", 100 - internal - pair - frame}});
           });
}

/// A step of a 3D scene whose last term is the contact to be measured: its time per visited pair of
/// points, and its share.
void add_contact_step(const std::string& name, const std::string& file,
                      const std::vector<std::string>& settings) {
  add_case("step of a scene in contact, 1 thread", name, 1,
           [file, settings](benchmark::State& state) {
             const SceneInput input =
                 SceneInput::from_file(MENISCUS_SOURCE_DIR "/inputs/" + file, settings);
             scene_dimension(input);
             Scene<3> scene = build_scene<3>(input);
             State moving = scene.initial;
             start(scene.system, moving);
             NodalVectors sum = moving.force;
             const auto& terms = scene.system.terms;
             const Shares shares = shortest_step(
                 state, terms.size(), [&] { advance(scene.system, moving, 1e-9); },
                 [&](std::size_t k) { terms[k]->add_force(moving.motion(), sum); });
             const auto* contact = dynamic_cast<const ContactVisits*>(terms.back().get());
             const Real share = shares.part.back(), visited = contact->pairs_per_force();
             Offset internal = 0;
             for (const auto& term : terms)
               if (!dynamic_cast<const ContactVisits*>(term.get())) internal += term->pairs();
             set_columns(state, {{"% contact", share},
                                 {"contact pairs", visited},
                                 {"ns/contact pair", 1e7 * share * shares.step / visited},
                                 {"internal pairs", static_cast<double>(internal)}});
           });
}

}  // namespace

void add_contact_cases() {
  for (const PairKernel kernel : {PairKernel::space, PairKernel::integrated, PairKernel::planar})
    for (const bool volume : {false, true}) add_pair_case(kernel, volume);
  for (const char* form : {"energy", "pressure", "dissertation", "volume"}) add_form_case(form);
  add_impact_case("touching", 0.64);
  add_impact_case("apart", 4.5);
  add_contact_step("spinning_collision, at the least gap", "contact/spinning_collision.toml",
                   {"body.one.centre=[-1.1, 0, 0]", "body.two.centre=[1.1, 0, 0]"});
  add_contact_step("pull_off, the plate 0.06 away", "contact/pull_off.toml",
                   {"contact.tip.partner.point=[0, 0, 1.06]"});
  const ContactLaw space;
  const Vec<3> o = Vec<3>::Zero(), x = Vec<3>::UnitX();
  add_partner_case<3>("half space", rigid_half_space<3>(space, 1, o, x), 0.4 * x, 4.0 * x);
  add_partner_case<3>("ball", rigid_ball<3>(space, 1, o, 5), 5.4 * x, 9.0 * x);
  for (const PairKernel kernel : {PairKernel::integrated, PairKernel::planar}) {
    const ContactLaw law{kernel};
    const std::string tail = ", " + std::string(name_of(kernel));
    const Vec<2> c = Vec<2>::Zero(), e = Vec<2>::UnitX();
    add_partner_case<2>("cylinder" + tail, rigid_ball<2>(law, 1, c, 5), 5.4 * e, 9.0 * e);
    add_partner_case<2>("frame" + tail, rigid_frame(law, 1, {0, 0}, {20, 20}), {0.4, 0.6}, {9, 8});
  }
}

}  // namespace meniscus::bench
