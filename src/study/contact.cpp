// SPDX-License-Identifier: BSD-3-Clause
// Total force between two balls of radius 3 sigma0 for all forms of contact, against the exact
// value: error over time and pairs at gaps of 0.5, 0.64 and 1 sigma0 (CGCM note 7). The law is cut
// off at 4 sigma0 by a switch that keeps the forms equivalent, so one exact value holds for all.
#include "body/grid/gauss.hpp"
#include "physics/contact/contact_terms.hpp"
#include "study/study.hpp"
#include "study/support/bodies.hpp"
#include "study/support/contact_costs.hpp"

#include <fmt/core.h>

#include <Eigen/Geometry>

namespace meniscus::contact_study {
namespace {

constexpr Real radius = 3, cutoff = 4;  // in units of sigma0

ContactLaw cut_law() {
  ContactLaw law;
  law.cutoff = cutoff;
  return law;
}

/// Composite Gauss quadrature of f over [a, b], refined towards a.
template <class F>
Real integral(Real a, Real b, F&& f) {
  const GaussRule& rule = gauss_rule(16);
  constexpr int pieces = 24;
  Real sum = 0, left = a;
  for (int k = 1; k <= pieces; ++k) {
    const Real t = Real(k) / pieces, right = a + (b - a) * t * t;
    for (std::size_t q = 0; q < rule.x.size(); ++q)
      sum += rule.w[q] * (right - left) / 2 * f((left + right + (right - left) * rule.x[q]) / 2);
    left = right;
  }
  return sum;
}

/// U at the distance a from the centre of a ball: oint (r.n) psi dA as an integral over the
/// distance s of points of the sphere, with dA = 2 pi R s ds / a.
Real field_of_ball(const PairLaw<PairKernel::space>& law, Real a) {
  const Real nearest = a - radius, farthest = std::min(a + radius, cutoff);
  if (nearest >= farthest) return 0;
  return integral(nearest, farthest, [&](Real s) {
    const Real r_n = (a * a - s * s - radius * radius) / (2 * radius);
    return r_n * law.surface(s * s).psi * 2 * std::numbers::pi * radius * s / a;
  });
}

/// Repulsion of two equal balls at a gap: - oint U n da over the second ball.
Real exact_force(Real gap) {
  const PairLaw<PairKernel::space> law(cut_law());
  const Real D = 2 * radius + gap, end = std::min(D + radius, radius + cutoff);
  return integral(D - radius, end, [&](Real a) {
    // da = 2 pi R a / D over the distance a; n points at the first ball with the cosine m.
    const Real m = (D * D + radius * radius - a * a) / (2 * D * radius);
    return field_of_ball(law, a) * m * 2 * std::numbers::pi * radius * a / D;
  });
}

struct Method {
  std::string name;
  ContactForm form;
  int points;
};

std::vector<Method> methods(bool brief) {
  std::vector<Method> all{{"energy", ContactForm::energy, 2},
                          {"pressure", ContactForm::pressure, 2},
                          {"dissertation", ContactForm::dissertation, 2},
                          {"volume, 1 point", ContactForm::volume, 1}};
  if (!brief) all.push_back({"volume, 2^3 points", ContactForm::volume, 2});
  return all;
}

/// Two balls with the same points: both are rotated, the second one is moved.
struct Balls {
  std::unique_ptr<Body<3>> first, second;

  explicit Balls(int n) {
    for (auto* body : {&first, &second}) {
      Geometry<3> geometry = study::reference_body<3>("ball", n);
      geometry = apply_map<3>(affine_map<3>(radius * Mat<3>::Identity(), Vec<3>::Zero()),
                              std::move(geometry));
      ParticleSet<3> particles(geometry.grid.X, {1.8, 20}, KernelFunction::cubic_spline);
      *body = std::make_unique<Body<3>>(body == &first ? "first" : "second", std::move(geometry),
                                        std::move(particles));
      (*body)->mass.assign(static_cast<std::size_t>((*body)->size()), 1.0);
    }
    second->first = first->size();
  }

  /// Displacements of both balls. Each number of `turns` brings other facets to face each other.
  NodalVectors displacement(Real gap, int turns) const;
};

/// The k-th of a sequence of irregular rotations.
Mat<3> rotation(int k) {
  const Real golden = 2.399963229728653;
  return (Eigen::AngleAxisd(golden * (k + 1), Vec<3>(1, 2, 3).normalized()) *
          Eigen::AngleAxisd(1.7 * golden * (k + 0.3), Vec<3>(-2, 1, 0.5).normalized()))
      .toRotationMatrix();
}

NodalVectors Balls::displacement(Real gap, int turns) const {
  NodalVectors u(static_cast<std::size_t>(first->size() + second->size()), Lanes::zero());
  const Mat<3> one = rotation(2 * turns), other = rotation(2 * turns + 1);
  const Vec<3> away(0, 0, 2 * radius + gap);
  for (Index A = 0; A < first->size(); ++A) {
    const Vec<3>& X = at(first->particles.X(), A);
    set_vector<3>(u, A, Vec<3>(one * X - X));
    set_vector<3>(u, first->size() + A, Vec<3>(other * X + away - X));
  }
  return u;
}

Real net_force(const Balls& balls, const NodalVectors& force) {
  Real net = 0;
  for (Index A = 0; A < balls.second->size(); ++A) net += at(force, balls.first->size() + A)[2];
  return net;
}

/// Number of rotations over which the error is averaged. The error of surface forms depends on
/// which points face each other and varies by multiples. The error of the volume form hardly
/// varies.
int turns_of(const Method& method, bool brief) {
  if (method.form == ContactForm::volume) return brief ? 1 : 2;
  return brief ? 12 : 32;
}

Measurement measure(const Balls& balls, const Method& method, Real gap, int level, bool brief) {
  Measurement result{.method = fmt::format("{}, gap {} sigma0", method.name, gap),
                     .level = level,
                     .particles = balls.first->size()};
  const Stopwatch set_up;
  ContactChoice choice;
  choice.form = method.form;
  choice.points = method.points;
  const auto term = contact_pair<3>({*balls.first, 1}, {*balls.second, 1}, cut_law(), choice);
  result.set_up = set_up.seconds();
  result.bytes = term->bytes();

  const Real exact = exact_force(gap);
  const Real scale = std::max(std::abs(exact), std::abs(exact_force(0.64)));  // the largest pull
  const int turns = turns_of(method, brief);
  Real squares = 0, largest = 0;
  for (int k = 0; k < turns; ++k) {
    const NodalVectors u = balls.displacement(gap, k), v(u.size(), Lanes::zero());
    NodalVectors force = v;
    term->add_force({0, u, v}, force);  // the first call builds the list
    force = v;
    const Stopwatch one;
    term->add_force({0, u, v}, force);
    result.time = k == 0 ? one.seconds() : std::min(result.time, one.seconds());
    const Real error = (net_force(balls, force) - exact) / scale;
    squares += error * error;
    largest = std::max(largest, std::abs(error));
  }
  const auto [pairs, spacing] =
      study::contact_cost(*balls.first, *balls.second, method.form, method.points, cut_law(), 0.4,
                          balls.displacement(gap, 0));
  result.h = spacing;
  result.errors = {{"force", std::sqrt(squares / turns)}};
  result.values = {{"pairs", pairs},
                   {"h / gap", spacing / gap},
                   {"largest error", largest},
                   {"ns per pair", 1e9 * result.time / pairs}};
  return result;
}

/// Pairs and time at an error of 1 %, interpolated between measurements by powers.
std::optional<std::pair<Real, Real>> cost_of_one_per_cent(const StudyRun& study,
                                                          const std::string& method) {
  const Measurement* before = nullptr;
  for (const Measurement& m : study.measurements()) {
    if (m.method != method) continue;
    if (m.error("force") <= 0.01) {
      const Real pairs = m.values.front().second;
      if (!before) return std::pair(pairs, m.time);
      const Real s = std::log(0.01 / before->error("force")) /
                     std::log(m.error("force") / before->error("force"));
      const auto between = [s](Real a, Real b) { return a * std::pow(b / a, s); };
      return std::pair(between(before->values.front().second, pairs),
                       between(before->time, m.time));
    }
    before = &m;
  }
  return std::nullopt;
}

void compare_at_equal_accuracy(StudyRun& study, Real gap) {
  for (const Method& method : methods(study.brief())) {
    const std::string name = fmt::format("{}, gap {} sigma0", method.name, gap);
    if (const auto cost = cost_of_one_per_cent(study, name))
      study.note(
          fmt::format("{}: 1 % with {:.2g} pairs in {:.2g} s", name, cost->first, cost->second));
    else
      study.note(fmt::format("{}: 1 % not reached", name));
  }
}

void run(StudyRun& study) {
  study.finish_settings();
  const std::vector<Real> gaps{0.5, 0.64, 1};
  for (const int level : study.levels()) {
    const Balls balls(level);
    for (const Method& method : methods(study.brief()))
      for (const Real gap : gaps) study.record(measure(balls, method, gap, level, study.brief()));
  }
  for (const Real gap : gaps) compare_at_equal_accuracy(study, gap);
  if (study.levels().size() > 1)
    for (const char* form : {"energy", "pressure", "dissertation"})
      study.require(fmt::format("order, {}, gap 0.64 sigma0", form),
                    study.overall_order(fmt::format("{}, gap 0.64 sigma0", form), "force"), {3, 8});
  // The rule of the note is an error of 1 % at h = gap / 2 for near-uniform points. Gauss points
  // are less even.
  for (const Measurement& m : study.measurements())
    if (m.method.rfind("volume", 0) != 0 && m.values[1].second < 0.45)
      study.require(fmt::format("error at h/gap = {:.2f}, {}", m.values[1].second, m.method),
                    m.error("force"), {0, 0.01});
}

const bool registered =
    register_entry(StudyEntry{"contact",
                              "forms of contact: total force of two balls of radius "
                              "3 sigma0, cost at equal accuracy",
                              "cells per edge of the core of a ball",
                              {4, 6, 8, 12, 16, 20},
                              {4, 8},
                              run});

}  // namespace
}  // namespace meniscus::contact_study
