// SPDX-License-Identifier: BSD-3-Clause
// Loads: what acts on the bodies of a scene or is measured of them, one kind of table [[name]]
// each.
//
// A load lives in its own file in src/features, in an anonymous namespace: a struct MyLoad<D> with
// the members that rows() reads, check(), build(), and an example. The file ends with
//   const bool registered = register_load<MyLoad>("my_load", Stage::volume, "what it is");
// Nothing else speaks of it by name.
#pragma once
#include "body/shapes/geometry.hpp"
#include "input/key_table.hpp"
#include "input/registry.hpp"
#include "scene/settings.hpp"

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace meniscus {

template <int D>
class Assembly;
template <int D>
class Material;

/// A body as a scene describes it, before particles are made of it.
template <int D>
struct BodyPlan {
  BodySettings settings;
  Geometry<D> geometry;
  std::shared_ptr<const Material<D>> material;
  bool in_order;              ///< a body that cannot be made has a stand-in for its geometry
  bool enclosed = false;      ///< if it is a fluid: Integration::enclosed
  bool curvature = false;     ///< of its surface, by second derivatives, is asked for
  bool loaded_faces = false;  ///< Body::loaded_faces
  SolidSettings solid = {};   ///< if it is none
};
template <int D>
using BodyPlans = std::vector<BodyPlan<D>>;

/// Notes a problem if a name, which becomes part of names in run.h5 and history.csv, has other
/// characters than letters, digits, _ and -.
void require_plain_name(const Block& block, const std::string& name);

/// The planned body of that name; null, and a problem noted at `key`, if there is none. Also null
/// for a body that cannot be made: what else would be said of it is about its stand-in.
template <int D>
const BodyPlan<D>* require_body(const Block& block, const BodyPlans<D>& bodies,
                                const std::string& name, std::string_view key = "body");

/// Loads are built, and their forces added up, by stage, then by the name of the kind, then as they
/// follow each other in the scene. A later stage can ask what an earlier one has said of a body.
enum class Stage { surface, volume, contact, measure };

/// One table of a scene.
template <int D>
class Load {
 public:
  virtual ~Load() = default;

  /// The key and its value that tell this load from others of its kind; none if there may be any
  /// number of equal ones. Measures of two with equal ones would have equal names.
  struct Identity {
    std::string key, value;
  };
  virtual std::optional<Identity> identity() const { return std::nullopt; }
  /// What only one load of any kind may have, e.g. "the surface of 'drop'"; empty if nothing.
  virtual std::string claim() const { return ""; }
  /// Notes in the block what cannot be with these bodies.
  virtual void check(const Block& block, const BodyPlans<D>& bodies) const = 0;
  /// Says in the plans what it asks of the bodies themselves.
  virtual void prepare(BodyPlans<D>&) const {}
  /// Adds force terms and measures. Throws InputError for what shows only here.
  virtual void build(Assembly<D>& assembly) const = 0;

  std::string place;  ///< "file:line:column: table" to begin messages with
};

/// What the program knows of a kind of load by its name.
template <int D>
struct LoadEntry {
  static constexpr const char* kind = "load";
  std::string_view name;  ///< of its tables: [[name]]
  std::string_view example;
  Stage stage;
  std::vector<KeyTable> (*keys)();
  std::unique_ptr<Load<D>> (*read)(const Block&);  ///< the keys of rows(); the rest is in check()
};

/// The registry of the kinds of loads in D dimensions.
template <int D>
const Registry<LoadEntry<D>>& loads() {
  return Registry<LoadEntry<D>>::all();
}

/// Enters the load L of D dimensions. L::rows() are its keys; tables within its own, if it has
/// some, are read by L::read_inner(block) and described by L::inner_tables().
template <int D, class L>
bool register_load_in(std::string_view name, Stage stage, std::string_view meaning) {
  // Functions without captures need the texts where they can find them.
  static const std::string heading = "[[" + std::string(name) + "]]: " + std::string(meaning);
  static const std::string example =
      "[[" + std::string(name) + "]]\n" + std::string(example_of<L>());
  LoadEntry<D> entry{name, example_of<L>(), stage, nullptr, nullptr};
  entry.keys = [] {
    std::vector<KeyTable> tables{{heading, key_texts(L::rows()), example}};
    if constexpr (requires { L::inner_tables(); })
      for (KeyTable& table : L::inner_tables()) tables.push_back(std::move(table));
    return tables;
  };
  entry.read = [](const Block& block) -> std::unique_ptr<Load<D>> {
    auto load = std::make_unique<L>();
    for (const auto& row : L::rows()) row.read(*load, block);
    if constexpr (requires { load->read_inner(block); }) load->read_inner(block);
    load->place = block.place();
    return load;
  };
  return register_entry(std::move(entry));
}

/// Enters the load L<D> in both dimensions.
template <template <int> class L>
bool register_load(std::string_view name, Stage stage, std::string_view meaning) {
  return register_load_in<2, L<2>>(name, stage, meaning) &&
         register_load_in<3, L<3>>(name, stage, meaning);
}

}  // namespace meniscus
