// SPDX-License-Identifier: BSD-3-Clause
// The reference of all measures: builds small scenes with everything registered, and lists their
// measures.
#include "input/names.hpp"
#include "meniscus/physics/interaction_registry.hpp"
#include "meniscus/physics/partner_registry.hpp"
#include "meniscus/physics/surface_registry.hpp"
#include "parallel/ranks.hpp"
#include "scene/example_scenes.hpp"
#include "scene/key_reference.hpp"
#include "scene/scene.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <functional>

namespace meniscus {
namespace {

constexpr int dimensions = 3;  // 3D has all measures of 2D
constexpr const char* tension = "[[surface_tension]]\nbody = \"drop\"\ngamma = 1\n";

struct MeasureText {
  std::string name, unit, meaning;  ///< name: "BODY.aspect" or "NAME.gap"
};

struct MeasureTable {
  std::string heading;
  std::vector<MeasureText> measures;
};

bool has(const MeasureTable& table, const std::string& name) {
  return std::any_of(table.measures.begin(), table.measures.end(),
                     [&](const MeasureText& m) { return m.name == name; });
}

/// Adds the measures of a scene, except measures of bodies that are in `known` already.
void add(MeasureTable& table, const std::string& text, const std::vector<MeasureTable>& known) {
  const SceneInput input = SceneInput::from_text(text);
  scene_dimension(input);
  const Scene<dimensions> scene = build_scene<dimensions>(input);
  const auto& bodies = scene.system.bodies;
  for (const MeasureSource& source : scene.measures) {
    const std::size_t dot = source.name.find('.');
    const std::string of = source.name.substr(0, dot);
    const bool of_body =
        std::any_of(bodies.begin(), bodies.end(), [&](const auto& b) { return b.name == of; });
    const std::string name = (of_body ? "BODY" : "NAME") + source.name.substr(dot);
    const bool known_already =
        of_body && std::any_of(known.begin(), known.end(),
                               [&](const MeasureTable& other) { return has(other, name); });
    if (!known_already && !has(table, name))
      table.measures.push_back({name, scene.units.symbol(source.dimension), source.meaning});
  }
}

/// Scenes in which a drop touches each partner and a soft body, for each interaction.
std::vector<std::string> contact_scenes() {
  std::vector<std::string> scenes{
      scene_with_load(dimensions, "contact", legacy_contact(dimensions))};
  for (const auto& [interaction, by] : interactions<dimensions>()) {
    if (interaction == "legacy_switch") continue;  // already included
    const std::string law = fmt::format("interaction = \"{}\"\n{}", interaction, by.example);
    scenes.push_back(
        scene_with_load(dimensions, "contact", "bodies = [\"drop\", \"other\"]\n" + law + tension));
    for (const auto& [name, partner] : partners<dimensions>())
      scenes.push_back(scene_with_load(
          dimensions, "contact",
          fmt::format("bodies = [\"drop\"]\nfriction = 1\n{}[contact.partner]\ntype = \"{}\"\n{}{}",
                      law, name, partner.example, tension)));
  }
  return scenes;
}

/// Calls `found` for each table of measures, until it says that it has seen enough.
void for_measure_tables(const std::function<bool(const MeasureTable&)>& found) {
  std::vector<MeasureTable> tables;
  bool enough = false;
  const auto section = [&](const std::string& heading, const std::vector<std::string>& scenes) {
    if (enough) return;
    MeasureTable table{heading, {}};
    for (const std::string& scene : scenes) add(table, scene, tables);
    if (table.measures.empty()) return;
    enough = found(table);
    tables.push_back(std::move(table));
  };
  const std::string heading = example_heading(dimensions);
  section("of every body", {heading + example_ball(dimensions, "other") + example_solid()});
  section("of a fluid", {heading + one_drop(dimensions)});
  const std::string nematic =
      heading + example_ball(dimensions, "drop") + example_nematic(dimensions);
  section("of a nematic",
          {nematic, nematic + "[[surface]]\nbody = \"drop\"\nlaw = { type = \"anchoring\", "
                              "strength = 1 }\n"});
  section("of a shell", {heading + one_shell()});
  const auto of_load = [&](const std::string& name, const std::string& example) {
    std::vector<std::string> scenes{scene_with_load(dimensions, name, example)};
    if (name == "cavity")  // the cavity of a shell has a gap, too
      scenes.push_back(scene_with_load(dimensions, name,
                                       "body = \"shell\"\nsurface = \"inner\"\npressure = 0.3\n"));
    if (name == "contact")
      for (std::string& scene : contact_scenes()) scenes.push_back(std::move(scene));
    if (name == "wetted")
      scenes.push_back(scene_with_load(dimensions, name,
                                       "body = \"drop\"\nface = \"flat\"\nadvancing_angle = "
                                       "80\nreceding_angle = 60\n"));
    if (name == "surface")
      for (const auto& [law, entry] : surface_laws())
        if (law != "anchoring")  // of a nematic, above
          scenes.push_back(
              scene_with_load(dimensions, name,
                              fmt::format("body = \"drop\"\n[surface.law]\ntype = \"{}\"\n{}", law,
                                          entry.example)));
    section("with [[" + name + "]]", scenes);
  };
  // Surface tension first, because the scenes of other loads contain it too.
  of_load("surface_tension", std::string(loads<dimensions>().at("surface_tension").example));
  for (const auto& [name, load] : loads<dimensions>())
    if (name != "surface_tension") of_load(name, std::string(load.example));
}

/// The name of a measure in a scene, and its place.
struct AskedMeasure {
  Block block;
  std::string key, name;

  std::string of() const { return name.substr(0, name.find('.')); }
  /// Empty if there is no point.
  std::string what() const {
    const std::size_t point = name.find('.');
    return point == name.npos ? "" : name.substr(point + 1);
  }
};

/// Columns of the history that are no measures have no point.
std::vector<AskedMeasure> asked_measures(const Block& root, const RunSettings& run) {
  std::vector<AskedMeasure> asked;
  if (const auto output = root.table("output"))
    for (const std::string& name : run.output.measures)
      asked.push_back({*output, "measures", name});
  if (const auto expect = root.table("expect"))
    for (const auto& [name, e] : run.expectations)
      if (const auto block = expect->table(name); block && e.of.find('.') != e.of.npos)
        asked.push_back({*block, block->has("of") ? "of" : "", e.of});
  return asked;
}

}  // namespace

void print_measures(std::ostream& out) {
  std::vector<MeasureTable> tables;
  for_measure_tables([&](const MeasureTable& table) {
    tables.push_back(table);
    return false;
  });
  out << "Measures, numbers over time: the names of them in output.measures and in \"of\" of\n"
         "[expect.*]. BODY is the name of a body, NAME that of a contact, probe, face, ... Units "
         "are\n"
         "those of SI; in 2D a sum over a body is per unit depth. A name that a scene does "
         "not\n"
         "have is refused with a list of those it has.\n";
  std::size_t widest = 0, widest_unit = 0;
  for (const MeasureTable& table : tables)
    for (const MeasureText& m : table.measures) {
      widest = std::max(widest, m.name.size());
      widest_unit = std::max(widest_unit, m.unit.size());
    }
  for (const MeasureTable& table : tables) {
    out << "\n" << table.heading << "\n";
    for (const MeasureText& m : table.measures)
      out << fmt::format("  {:<{}}  {:<{}}  {}\n", m.name, widest, m.unit, widest_unit, m.meaning);
  }
}

void note_unknown_measures(const Block& root, const RunSettings& run,
                           const std::vector<std::string>& names) {
  if (ranks().size() > 1) return;  // which would build the small scenes together
  std::vector<AskedMeasure> asked = asked_measures(root, run);
  // A table that nobody knows, or that says no name, may have any.
  const bool all_names =
      root.in_order() && std::find(names.begin(), names.end(), "") == names.end();
  std::erase_if(asked, [&](const AskedMeasure& m) {
    if (std::any_of(names.begin(), names.end(), [&](const std::string& name) {
          return m.of() == name || m.of().starts_with(name + "-");
        }))
      return false;
    if (all_names)
      m.block.problem(m.key, fmt::format("'{}' is unknown: nothing of this scene is called '{}'{}",
                                         m.name, m.of(), did_you_mean(m.of(), names)));
    return true;
  });
  // Measures of a probe have the names of its fields.
  for (const Block& probe : root.tables("probe"))
    std::erase_if(
        asked, [name = probe.text("name", "")](const AskedMeasure& m) { return m.of() == name; });
  std::vector<std::string> known;
  if (!asked.empty())
    for_measure_tables([&](const MeasureTable& table) {
      for (const MeasureText& m : table.measures) {
        known.push_back(m.name.substr(m.name.find('.') + 1));
        std::erase_if(asked, [&](const AskedMeasure& a) { return a.what() == known.back(); });
      }
      return asked.empty();
    });
  for (const AskedMeasure& m : asked)
    m.block.problem(m.key, fmt::format("'{}' is unknown: no measure is called '{}'; `meniscus keys "
                                       "--measures` lists all{}",
                                       m.name, m.what(), did_you_mean(m.what(), known)));
}

}  // namespace meniscus
