// SPDX-License-Identifier: BSD-3-Clause
// Rewrites a 3D scene for the half plane, table by table.
#include "scene/half_plane_twin.hpp"

#include "input/input_node.hpp"
#include "meniscus/error.hpp"
#include "scene/half_plane_values.hpp"
#include "scene/key_reference.hpp"
#include "scene/scene.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

namespace meniscus {
namespace {

using scene_tree::Array;
using scene_tree::Entry;
using scene_tree::Table;
using scene_tree::Value;

bool is_one_of(std::string_view word, std::initializer_list<std::string_view> words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// The names of keys that may have formulas.
std::set<std::string> formula_keys() {
  std::set<std::string> keys;
  for (const KeyTable& table : key_tables())
    for (const KeyText& key : table.keys)
      if (key.type.find("formula") != std::string::npos) keys.insert(key.key);
  return keys;
}

/// The default of a number of cells of a 3D shape.
std::int64_t usual_count(std::string_view shape, std::string_view name) {
  for (const KeyTable& table : key_tables())
    if (heading_of(table).kind == shape && table.heading.find("(3D)") != std::string::npos)
      for (const KeyText& key : table.keys)
        if (key.key == name) return std::stoll(key.fallback);
  return 0;
}

/// A 3D shape in the half plane.
struct TwinShape {
  std::string name;
  bool any_axis = false;  ///< otherwise of revolution about z
};
const std::map<std::string, TwinShape, std::less<>> twin_shapes{
    {"ball", {"disk", true}},
    {"ellipsoid", {"ellipse", true}},
    {"half_sphere", {"half_disk"}},
    {"cap", {"cap"}},
    {"red_cell", {"red_cell"}},
    {"cylinder", {"rectangle"}},
    {"disk_shell", {"disk_shell"}},
    {"sphere_shell", {"sphere_shell", true}},
    {"cylinder_shell", {"cylinder_shell"}},
    {"spheroid_shell", {"spheroid_shell"}}};

/// Names of faces that differ.
const std::map<std::string, std::map<std::string, std::string, std::less<>>, std::less<>>
    twin_faces{{"cylinder", {{"side", "x_max"}, {"z_min", "y_min"}, {"z_max", "y_max"}}}};

class Twin {
 public:
  using Names = std::set<std::string, std::less<>>;

  Twin(const SceneInput& input, const TwinAxis& axis, const std::vector<Eigen::Vector3d>& places)
      : document_(input.document()), values_(document_, axis, places) {}

  /// `known`: the measures of the twin; empty: not known yet.
  HalfPlaneTwin made(Names known = {}) {
    known_ = std::move(known);
    notes_.clear();
    for (const Value& body : tables(root(), "body")) {
      const Table& table = std::get<Table>(body.data);
      shape_of_[text(table, "name")] = text(table, "shape");
    }
    Table scene = table(root(), "");
    for (Entry& entry : scene.entries)
      if (entry.key == "dimension") entry.value.data = std::string("axisymmetric");
    HalfPlaneTwin twin;
    twin.text = scene_tree::toml_text(scene);
    twin.notes = notes_;
    return twin;
  }

 private:
  template <class... Arguments>
  void note(fmt::format_string<Arguments...> text, Arguments&&... arguments) {
    notes_.push_back(fmt::format(text, std::forward<Arguments>(arguments)...));
  }
  const Table& root() const { return std::get<Table>(document_.root.data); }
  static Array tables(const Table& table, std::string_view key) {
    const Entry* entry = table.find(key);
    const Array* array = entry ? std::get_if<Array>(&entry->value.data) : nullptr;
    return array ? *array : Array{};
  }
  static std::string text(const Table& table, std::string_view key) {
    const Entry* entry = table.find(key);
    const auto* text = entry ? std::get_if<std::string>(&entry->value.data) : nullptr;
    return text ? *text : std::string();
  }

  /// A table of the twin: its values are rewritten by the name of the table and of the key.
  Table table(const Table& given, const std::string& name) {
    Table twin;
    const std::string shape = name == "body" ? text(given, "shape") : "";
    if (name == "probe") require_half_plane(given);
    for (const Entry& entry : given.entries) {
      if (name == "body" && take_shape(given, shape, entry, twin)) continue;
      // Few points are enough in 3D, where the facets of a circle lie in many ways.
      if ((name == "contact" && entry.key == "points") ||
          (name == "body" && entry.key == "support_rank")) {
        note("{} by default, instead of {}.", entry.key, scene_tree::toml_text(entry.value));
        continue;
      }
      if (name == "initial" && entry.key == "from")
        values_.refuse(entry.value, "from is a 3D state");
      Entry made = entry;
      made.value = value(entry, name, given);
      twin.entries.push_back(std::move(made));
    }
    return twin;
  }

  /// Refuses a line of points that leaves the half plane of its begin.
  void require_half_plane(const Table& probe) const {
    const Entry *from = probe.find("from"), *to = probe.find("to");
    if (!from || !to) return;
    const auto begin = values_.angle(std::get<Array>(from->value.data)),
               end = values_.angle(std::get<Array>(to->value.data));
    if (begin && end && std::abs(std::remainder(*begin - *end, 2 * std::numbers::pi)) > 1e-9)
      values_.refuse(to->value, "to is in another half plane of the axis than from");
  }

  Value value(const Entry& entry, const std::string& name, const Table& given) {
    Value made = entry.value;
    if (const auto* inner = std::get_if<Table>(&entry.value.data)) {
      if (entry.key == "expect" && name.empty())
        made.data = expectations(*inner);
      else if (entry.key == "functions" && name.empty())
        made.data = values_.functions(*inner);
      else
        made.data = table(*inner, entry.key);
      return made;
    }
    if (const auto* array = std::get_if<Array>(&entry.value.data)) {
      made.data = list(entry, *array, name);
      return made;
    }
    const auto* formula = std::get_if<std::string>(&entry.value.data);
    if (!formula || is_one_of(name, {"constants", "units"})) return made;
    if (entry.key == "face") {
      const auto of_shape = twin_faces.find(shape_of(given));
      if (of_shape != twin_faces.end())
        if (const auto face = of_shape->second.find(*formula); face != of_shape->second.end())
          made.data = face->second;
      if (is_one_of(shape_of(given), {"ball", "ellipsoid", "red_cell"}))
        made.data = std::string("rim");
      return made;
    }
    static const std::set<std::string> keys = formula_keys();
    if (keys.contains(entry.key)) made.data = values_.scalar(entry, *formula);
    return made;
  }
  std::string shape_of(const Table& given) const {
    const auto found = shape_of_.find(text(given, "body"));
    return found == shape_of_.end() ? std::string() : found->second;
  }

  Array list(const Entry& entry, const Array& given, const std::string& name) {
    Array made;
    for (const Value& element : given)
      if (const auto* inner = std::get_if<Table>(&element.data))
        made.push_back({table(*inner, entry.key), element.place});
    if (!made.empty()) return made;
    if (entry.key == "measures") return measures(given);
    if (entry.key == "components") return values_.components(entry, given);
    if (given.size() != 3 || is_one_of(name, {"remap", "profile"}) ||
        is_one_of(entry.key, {"fields", "bodies"}))
      return given;
    if (is_one_of(entry.key, {"centre", "point", "at", "from", "to"}))
      return values_.position(entry, given,
                              entry.key == "centre" || (name == "spring" && entry.key == "at"));
    if (is_one_of(entry.key, {"normal", "direction", "up", "axis"}))
      return values_.direction(entry, given);
    static const std::set<std::string> keys = formula_keys();
    if (keys.contains(entry.key)) return values_.vector(entry, given);
    values_.refuse(entry.value,
                   fmt::format("{} has no meaning in the half plane that is known", entry.key));
  }

  /// The name of a measure in the half plane; empty if there is none, as of a force across the
  /// axis.
  std::string measure(const std::string& name) const {
    const std::string twin = along_axis(name);
    const bool of_something = twin.find('.') != std::string::npos;
    return known_.empty() || known_.contains(twin) || !of_something ? twin : "";
  }
  std::string along_axis(const std::string& name) const {
    const TwinAxis& axis = values_.axis();
    if (name.size() < 2 || name[name.size() - 2] != '_') return name;
    const std::size_t k = std::string_view("xyz").find(name.back());
    if (k == std::string_view::npos) return name;
    const std::string stem = name.substr(0, name.size() - 1);
    if (stem.ends_with("torque_") || stem.ends_with("angular_momentum_")) return "";
    if (static_cast<int>(k) == axis.along) return stem + "y";
    return stem.ends_with("extent_") ? stem + "x" : "";
  }
  Array measures(const Array& given) {
    Array made;
    for (const Value& value : given) {
      const auto* name = std::get_if<std::string>(&value.data);
      const std::string twin = name ? measure(*name) : "";
      if (!twin.empty())
        made.push_back({twin, value.place});
      else if (name)
        note("Without the measure {}.", *name);
    }
    return made;
  }
  Table expectations(const Table& given) {
    Table made;
    for (const Entry& entry : given.entries) {
      const auto* inner = std::get_if<Table>(&entry.value.data);
      if (!inner) continue;
      const std::string of = text(*inner, "of"), twin = measure(of.empty() ? entry.key : of);
      if (twin.empty()) {
        note("Without the expectation {}.", entry.key);
        continue;
      }
      Entry expectation = entry;
      if (Entry* named = std::get<Table>(expectation.value.data).find("of"))
        named->value.data = twin;
      made.entries.push_back(std::move(expectation));
    }
    return made;
  }

  /// Whether a shape has shells of cells around a core.
  static bool is_of_shells(std::string_view shape) {
    return is_one_of(shape, {"ball", "half_sphere", "cap", "ellipsoid", "red_cell"});
  }
  /// Adds the entries of a shape in the half plane. True if the entry is done.
  bool take_shape(const Table& body, const std::string& shape, const Entry& entry, Table& twin) {
    if (entry.key == "shape") {
      const auto found = twin_shapes.find(shape);
      if (found == twin_shapes.end())
        values_.refuse(entry.value,
                       fmt::format("shape '{}' is not of revolution, or not known to be", shape));
      Entry made = entry;
      made.value.data = found->second.name;
      twin.entries.push_back(made);
      if (shape == "cylinder") add_rectangle(body, entry, twin);
      if (is_of_shells(shape)) {  // the defaults of the plane are finer
        for (const auto& [key, name] : {std::pair("core", "core"), std::pair("layers", "rings")})
          if (!body.find(key))
            twin.entries.push_back({name, entry.place, {usual_count(shape, key), entry.place}});
      }
      return true;
    }
    if (is_one_of(entry.key, {"rotate", "rotate_axis", "move", "jitter", "imperfection"}) &&
        !is_zero(entry.value))
      values_.refuse(entry.value,
                     fmt::format("{} is not of revolution, or not known to be", entry.key));
    if (shape == "cylinder" &&
        is_one_of(entry.key, {"radius", "height", "core", "rings", "layers", "centre"}))
      return true;
    if (is_of_shells(shape) && entry.key == "layers") {
      Entry made = entry;
      made.key = "rings";
      twin.entries.push_back(made);
      return true;
    }
    if (entry.key == "core" && shape != "cylinder") {
      const auto* count = std::get_if<std::int64_t>(&entry.value.data);
      if (!count || *count % 2 == 0) return false;
      note("core = {} instead of {}, for nodes on the axis.", *count + 1, *count);
      Entry made = entry;
      made.value.data = *count + 1;
      twin.entries.push_back(made);
      return true;
    }
    if (entry.key == "semi_axes") {
      const TwinAxis& axis = values_.axis();
      const auto* semi = std::get_if<Array>(&entry.value.data);
      if (!semi || semi->size() != 3) return false;
      if (scene_tree::toml_text(at(*semi, axis.across())) !=
          scene_tree::toml_text(at(*semi, axis.normal())))
        values_.refuse(entry.value, "semi_axes across the axis differ");
      Entry made = entry;
      made.value.data = Array{at(*semi, axis.across()), at(*semi, axis.along)};
      twin.entries.push_back(made);
      return true;
    }
    return false;
  }
  /// The keys of a rectangle with as many cells as a cylinder.
  void add_rectangle(const Table& body, const Entry& shape, Table& twin) const {
    const auto count = [&](const char* key) {
      const Entry* entry = body.find(key);
      const auto* given = entry ? std::get_if<std::int64_t>(&entry->value.data) : nullptr;
      return given ? *given : usual_count("cylinder", key);
    };
    const auto add = [&](const char* key, Value value) {
      value.place = shape.place;
      twin.entries.push_back({key, shape.place, std::move(value)});
    };
    const Value radius = body.find("radius")->value, height = body.find("height")->value;
    const Real half = values_.length(radius) / 2;
    const std::int64_t across = (count("core") + 1) / 2 + count("rings");
    Value along{0.0, shape.place};
    if (const Entry* centre = body.find("centre"))
      along = at(values_.position(*centre, std::get<Array>(centre->value.data)), 1);
    add("size", {Array{radius, height}, shape.place});
    add("cells", {Array{{across, shape.place}, {count("layers"), shape.place}}, shape.place});
    add("centre", {Array{{half, shape.place}, along}, shape.place});
  }

  const Document& document_;
  HalfPlaneValues values_;
  std::map<std::string, std::string> shape_of_;  // by the names of bodies
  std::vector<std::string> notes_;
  Names known_;
};

/// The particles and measures of a scene in the half plane.
struct Built {
  Index particles;
  std::set<std::string, std::less<>> measures;
};
Built built(const std::string& text) {
  const SceneInput input = SceneInput::from_text(text, "twin");
  scene_dimension(input);
  const Scene<2> scene = build(read_plan<2>(input));
  Built of_scene{scene.system.size(), {}};
  for (const MeasureSource& measure : scene.measures) of_scene.measures.insert(measure.name);
  return of_scene;
}

/// All particles, as the scene places them.
std::vector<Eigen::Vector3d> places_of(const Plan<3>& plan) {
  std::vector<Eigen::Vector3d> all;
  for (const auto& body : plan.bodies)
    all.insert(all.end(), body.geometry.grid.X.begin(), body.geometry.grid.X.end());
  return all;
}

/// Whether a shape is of revolution about z alone, or of none.
bool has_own_axis(const SceneInput& input) {
  const auto& root = std::get<Table>(input.document().root.data);
  const Entry* bodies = root.find("body");
  const auto* array = bodies ? std::get_if<Array>(&bodies->value.data) : nullptr;
  return array && std::any_of(array->begin(), array->end(), [](const Value& body) {
           const auto* table = std::get_if<Table>(&body.data);
           const Entry* shape = table ? table->find("shape") : nullptr;
           const auto* name = shape ? std::get_if<std::string>(&shape->value.data) : nullptr;
           const auto found = name ? twin_shapes.find(*name) : twin_shapes.end();
           return found == twin_shapes.end() || !found->second.any_axis;
         });
}

}  // namespace

HalfPlaneTwin half_plane_twin(const SceneInput& input, const Plan<3>& plan) {
  const std::vector<Eigen::Vector3d> places = places_of(plan);
  std::string why;
  for (const int along : {2, 1, 0}) {
    if (along < 2 && has_own_axis(input)) break;
    const TwinAxis axis = axis_through_middle(along, places);
    try {
      Twin of_scene(input, axis, places);
      const Built revolved = built(of_scene.made().text);
      HalfPlaneTwin twin = of_scene.made(revolved.measures);
      twin.particles = revolved.particles;
      return twin;
    } catch (const InputError& error) {
      why += fmt::format("{}about {}: {}", why.empty() ? "" : "\n", axis.name(), error.what());
    }
  }
  throw InputError(why);
}

}  // namespace meniscus
