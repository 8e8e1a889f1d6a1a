// SPDX-License-Identifier: BSD-3-Clause
// Probes: fields at a point of a body, written to the history, or at a line of points, written to a
// file of their own.
#include "input/names.hpp"
#include "kernel/row_sums.hpp"
#include "meniscus/error.hpp"
#include "meniscus/scene/assembly.hpp"
#include "numbers/box.hpp"
#include "physics/contact/points/containment.hpp"
#include "remap/nodal_values.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace meniscus::probe_table {
namespace {

/// Positions in the present reference of the points that were at X in the reference of the scene.
/// They differ after a remap.
template <int D>
std::vector<Vec<D>> in_this_reference(const Body<D>& body, const std::vector<Vec<D>>& X) {
  if (!body.reference) return X;
  NodalVectors back(static_cast<std::size_t>(body.size()), Lanes::zero());
  for (Index A = 0; A < body.size(); ++A)
    for (int i = 0; i < D; ++i)
      at(back, A).set(i, body.origin(A)[i] - at(body.particles.X(), A)[i]);
  return pre_images<D>(body, coefficients_of(body, back, back).data(), X);
}

/// Points of a body and the shape functions there. Values given per particle are interpolated with
/// these functions, which reproduce linear and quadratic fields exactly.
template <int D>
class Points {
 public:
  /// `X`: positions in the reference of the scene.
  Points(const Body<D>& body, const std::vector<Vec<D>>& X)
      : body_(body), scene_X_(X), X_(in_this_reference(body, X)), rows_(rows(body, X_)) {}

  Index size() const { return rows_.size(); }
  /// Distance from the first point in the reference of the scene.
  Real distance(Index q) const { return (at(scene_X_, q) - scene_X_.front()).norm(); }

  /// Fields of the motion as [point][component], D components each.
  std::vector<Real> positions(const Motion& motion) const { return moved(motion, {}); }
  std::vector<Real> displacements(const Motion& motion) const { return moved(motion, scene_X_); }
  std::vector<Real> velocities(const Motion& motion) const {
    std::vector<Real> values;
    for (Index q = 0; q < size(); ++q) append(value_at(rows_, q, own(motion.v)), values);
    return values;
  }
  /// A field of a force term as [point][component].
  std::vector<Real> field(const FieldSource& source, const Motion& motion) const {
    const auto n = static_cast<Index>(source.components);
    std::vector<Real> given(static_cast<std::size_t>(body_.size() * n)), values;
    source.compute(motion, given);
    for (Index q = 0; q < size(); ++q)
      for (Index c = 0; c < n; ++c) {
        Real sum = 0;
        for (Offset e = at(rows_.start, q); e < at(rows_.start, q + 1); ++e)
          sum += at(rows_.value, e) * at(given, at(rows_.particle, e) * n + c);
        values.push_back(sum);
      }
    return values;
  }

 private:
  static PointRows<D> rows(const Body<D>& body, const std::vector<Vec<D>>& X) {
    return build_point_rows<D>(body.particles, X, {.value = true}, body.name);
  }
  const NodalVector* own(std::span<const NodalVector> field) const {
    return field.data() + body_.first;
  }
  static void append(const Lanes& vector, std::vector<Real>& values) {
    for (int i = 0; i < D; ++i) values.push_back(vector[i]);
  }
  /// Present positions, minus `origin` if it is given. X - origin is 0 before the first remap.
  std::vector<Real> moved(const Motion& motion, std::span<const Vec<D>> origin) const {
    std::vector<Real> values;
    for (Index q = 0; q < size(); ++q) {
      const Vec<D> from = origin.empty() ? Vec<D>(Vec<D>::Zero()) : at(origin, q);
      const Lanes u = value_at(rows_, q, own(motion.u));
      for (int i = 0; i < D; ++i) values.push_back((at(X_, q)[i] - from[i]) + u[i]);
    }
    return values;
  }

  const Body<D>& body_;
  std::vector<Vec<D>> scene_X_, X_;
  PointRows<D> rows_;
};

/// A field that a probe can read.
struct Readable {
  std::string name;
  Dimension dimension;
  int components;
  std::string meaning;
  std::function<std::vector<Real>(const Motion&)> values;  ///< [point][component]

  /// Column of component c: "velocity_x", "F_xy", "pressure".
  std::string column(int c) const {
    const auto axis = [](int i) { return "xyz"[i]; };
    if (components == 1) return name;
    if (components == 9) return name + "_" + axis(c / 3) + axis(c % 3);
    return name + "_" + axis(c);
  }
};

/// All fields of the frames except `force`, which has values at particles only.
template <int D>
std::vector<Readable> readable(std::shared_ptr<const Points<D>> points,
                               const std::vector<FieldSource>& sources) {
  std::vector<Readable> all{{"position", dimension::length, D, "place of the probe",
                             [points](const Motion& m) { return points->positions(m); }},
                            {"displacement", dimension::length, D, "of the probe since the start",
                             [points](const Motion& m) { return points->displacements(m); }},
                            {"velocity", dimension::velocity, D, "at the probe",
                             [points](const Motion& m) { return points->velocities(m); }}};
  for (const FieldSource& source : sources) {
    const auto values = [points, source](const Motion& m) { return points->field(source, m); };
    const auto same = std::find_if(all.begin(), all.end(),
                                   [&](const Readable& r) { return r.name == source.name; });
    if (same == all.end()) {
      all.push_back({source.name, source.dimension, source.components,
                     source.meaning + ", at the probe", values});
      continue;
    }
    same->values = [values, before = same->values](const Motion& m) {
      std::vector<Real> sum = before(m);
      const std::vector<Real> more = values(m);
      for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += more[k];
      return sum;
    };
  }
  return all;
}

/// Tests whether a position is inside the body. Positions outside by less than a quarter of the
/// spacing count as inside, because facets are flat where the surface is round.
template <int D>
class Inside {
 public:
  explicit Inside(const Body<D>& body)
      : body_(body),
        still_(static_cast<std::size_t>(body.first + body.size()), Lanes::zero()),
        placed_(body, {0, still_, still_}),
        polyhedron_(placed_) {}

  bool operator()(const Vec<D>& X) const {
    const Real spacing = mean_spacing(body_.geometry.grid);
    std::vector<Index> near;
    body_.particles.search().within(X, 2 * spacing, near);
    std::erase_if(near, [&](Index A) { return A >= body_.size(); });  // images beyond the axis
    if (near.empty()) return false;
    Vec<D> inwards = -X;
    for (const Index A : near)
      inwards += at(body_.particles.X(), A) / static_cast<Real>(near.size());
    const Real way = inwards.norm(), most = spacing / 4;
    const Vec<D> deeper = X + inwards * (way > most ? most / way : 1);
    constexpr Real half = 0.5;
    return polyhedron_.winding_number(X) > half || polyhedron_.winding_number(deeper) > half;
  }

 private:
  const Body<D>& body_;
  NodalVectors still_;
  PlacedBody<D> placed_;
  Polyhedron<D> polyhedron_;
};

template <int D>
struct Probe final : Load<D> {
  static constexpr std::string_view example =
      D == 3 ? "name = \"tip\"\nbody = \"drop\"\nat = [0.2, 0.3, 0]\n"
             : "name = \"tip\"\nbody = \"drop\"\nat = [0.2, 0.3]\n";
  std::string name, body;
  std::vector<Real> at_point, from, to;
  int points = 0;
  std::vector<std::string> fields;
  std::string place_of_points, place_of_fields, place_of_name;

  static Rows<Probe> rows() {
    return {
        text_row("name", &Probe::name,
                 "its columns of the history are NAME.velocity_x ..., its file of a line "
                 "probe-NAME.csv"),
        text_row("body", &Probe::body, "name of the body that it moves with"),
        reals_row("at", &Probe::at_point, 0, dimension::length, range::any,
                  "reference place of a point, whose fields are in the history",
                  std::vector<Real>{}),
        reals_row("from", &Probe::from, 0, dimension::length, range::any,
                  "instead: reference place where a line begins, whose fields are in its file",
                  std::vector<Real>{}),
        reals_row("to", &Probe::to, 0, dimension::length, range::any, "where it ends",
                  std::vector<Real>{}),
        integer_row("points", &Probe::points, {2, 100000}, "of the line, at equal distances", 50),
        texts_row("fields", &Probe::fields,
                  "position, displacement, velocity, and any other of the frames but force",
                  std::vector<std::string>{"displacement", "velocity"})};
  }
  std::optional<typename Load<D>::Identity> identity() const override { return {{"name", name}}; }
  void read_inner(const Block& block) {
    place_of_points = block.place(at_point.empty() ? "from" : "at");
    place_of_fields = block.place("fields");
    place_of_name = block.place("name");
  }

  void check(const Block& block, const BodyPlans<D>& bodies) const override {
    require_plain_name(block, name);
    if (name.empty()) block.problem("name", "is empty; it has to have one");
    require_body(block, bodies, body);
    for (const BodyPlan<D>& other : bodies)
      if (other.settings.name == name)
        block.problem("name", fmt::format("'{}' is the name of a body; choose another", name));
    const bool line = !from.empty() || !to.empty();
    if (at_point.empty() && !line)
      block.problem("at", "is missing: give at for a point, or from and to for a line");
    if (!at_point.empty() && line)
      block.problem("at", "is of a point, from and to are of a line; give one of both");
    const auto require_place = [&](const char* key, const std::vector<Real>& X) {
      if (X.size() != D)
        block.problem(key, fmt::format("has {} numbers; allowed are {}", X.size(), D));
    };
    if (!at_point.empty()) require_place("at", at_point);
    if (line) require_place("from", from), require_place("to", to);
    if (line && from == to) block.problem("to", "is where the line begins");
    if (!at_point.empty() && block.has("points"))
      block.problem("points", "has no meaning for a point; allowed are from and to with it");
    if (fields.empty()) block.problem("fields", "names none; leave it out for the usual ones");
  }

  void build(Assembly<D>& assembly) const override {
    const Body<D>& of = assembly.body(body);
    const std::vector<Vec<D>> X = places();
    if (assembly.initial()) require_inside(of, X);
    const auto at_points = std::make_shared<const Points<D>>(of, X);
    const std::vector<Readable> chosen = choose(readable<D>(at_points, assembly.fields_of(body)));
    if (at_point.empty())
      assembly.line(line(at_points, chosen));
    else
      add_columns(chosen, assembly);
  }

 private:
  std::vector<Vec<D>> places() const {
    if (!at_point.empty()) return {Vec<D>::Map(at_point.data())};
    const Vec<D> begin = Vec<D>::Map(from.data()), end = Vec<D>::Map(to.data());
    std::vector<Vec<D>> X;
    for (int k = 0; k < points; ++k)
      X.push_back(begin + (end - begin) * (static_cast<Real>(k) / (points - 1)));
    return X;
  }
  void require_inside(const Body<D>& of, const std::vector<Vec<D>>& X) const {
    const Inside<D> inside(of);
    for (const Vec<D>& p : X) {
      if (inside(p)) continue;
      const Box<D> box = box_around<D>(of.particles.X());
      std::string point, room;
      for (int i = 0; i < D; ++i) {
        point += fmt::format("{}{:.6g}", i ? ", " : "", p[i]);
        room += fmt::format("{}[{:.6g}, {:.6g}]", i ? " x " : "", box.low[i], box.high[i]);
      }
      throw InputError(
          fmt::format("{}: ({}) is outside of body '{}'; allowed are places in its reference, "
                      "which occupies {}",
                      place_of_points, point, of.name, room));
    }
  }
  std::vector<Readable> choose(const std::vector<Readable>& all) const {
    std::vector<std::string> known;
    for (const Readable& r : all) known.push_back(r.name);
    std::vector<Readable> chosen;
    for (const std::string& wanted : fields) {
      const auto found = std::find(known.begin(), known.end(), wanted);
      if (found == known.end())
        throw InputError(fmt::format("{}: '{}' is unknown; {}", place_of_fields, wanted,
                                     allowed_names(wanted, known)));
      if (std::count(fields.begin(), fields.end(), wanted) > 1)
        throw InputError(fmt::format("{}: '{}' is named twice", place_of_fields, wanted));
      chosen.push_back(all[static_cast<std::size_t>(found - known.begin())]);
    }
    return chosen;
  }
  void add_columns(const std::vector<Readable>& chosen, Assembly<D>& assembly) const {
    for (const Readable& field : chosen)
      for (int c = 0; c < field.components; ++c) {
        if (assembly.has_measure(name + "." + field.column(c)))
          throw InputError(
              fmt::format("{}: there is a measure '{}.{}' already; choose another name",
                          place_of_name, name, field.column(c)));
        assembly.record(name,
                        {field.column(c), field.dimension, field.meaning,
                         [values = field.values, c](const Motion& m) { return at(values(m), c); }});
      }
  }
  ProbedLine line(std::shared_ptr<const Points<D>> at_points, std::vector<Readable> chosen) const {
    ProbedLine line{name, {{"distance", dimension::length}}, nullptr};
    for (const Readable& field : chosen)
      for (int c = 0; c < field.components; ++c)
        line.columns.push_back({field.column(c), field.dimension});
    line.compute = [at_points, chosen = std::move(chosen)](const Motion& motion) {
      std::vector<std::vector<Real>> table(static_cast<std::size_t>(at_points->size()));
      for (Index q = 0; q < at_points->size(); ++q) at(table, q).push_back(at_points->distance(q));
      for (const Readable& field : chosen) {
        const std::vector<Real> values = field.values(motion);
        for (std::size_t k = 0; k < values.size(); ++k)
          table[k / static_cast<std::size_t>(field.components)].push_back(values[k]);
      }
      return table;
    };
    return line;
  }
};

const bool registered =
    register_load<Probe>("probe", Stage::measure, "fields at a point of a body, or along a line");

}  // namespace
}  // namespace meniscus::probe_table
