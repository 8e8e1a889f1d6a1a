// SPDX-License-Identifier: BSD-3-Clause
// Loads: force terms and measures of the bodies of a scene. Each kind of load has a table [[name]].
//
// A load has its own file in src/features, in an anonymous namespace. It is a struct MyLoad<D> with
// the members that rows() reads, check(), build(), and an example. The file ends with
//   const bool registered = register_load<MyLoad>("my_load", Stage::volume, "short description");
// No other code refers to the load by name. D = 2 includes bodies of revolution in the half plane
// (space_dimension(grid) == 3). Rows, face cells and patches know them; check() refuses a load
// across the axis.
#pragma once
#include "body/shapes/geometry.hpp"
#include "body/surface/wetted_wall.hpp"
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

/// A body as described in the scene, before its particles are made.
template <int D>
struct BodyPlan {
  BodySettings settings;
  Geometry<D> geometry;
  std::shared_ptr<const Material<D>> material;
  bool in_order;              ///< false if the body cannot be made; its geometry is then a stand-in
  bool enclosed = false;      ///< Integration::enclosed, for fluids
  bool curvature = false;     ///< a term needs the curvature of its surface (second derivatives)
  bool pulled_along = false;  ///< a term pulls along its surface, as a tension that varies
  bool loaded_faces = false;  ///< Body::loaded_faces
  std::vector<WettedFace<D>> wetted = {};  ///< Body::wetted
  SolidSettings solid = {};                ///< for solids
};
template <int D>
using BodyPlans = std::vector<BodyPlan<D>>;

/// Notes a problem if a name has other characters than letters, digits, _ and -. For names that
/// become part of names in run.h5 and history.csv.
void require_plain_name(const Block& block, const std::string& name);

/// The planned body with this name. Null if there is none; a problem is then noted at `key`. Also
/// null for a body that cannot be made, since further problems would only concern its stand-in.
template <int D>
const BodyPlan<D>* require_body(const Block& block, const BodyPlans<D>& bodies,
                                const std::string& name, std::string_view key = "body");

/// Order in which loads are built and their forces are added: by stage, then by the name of the
/// kind, then by their order in the scene. A later stage can use data that an earlier stage has set
/// for a body.
enum class Stage { surface, volume, contact, measure };

/// One table of a scene.
template <int D>
class Load {
 public:
  virtual ~Load() = default;

  /// Key and value that distinguish a load from others of its kind. Two loads with the same
  /// identity are refused, since their measures would have the same names. Empty if any number of
  /// equal loads is allowed.
  struct Identity {
    std::string key, value;
  };
  virtual std::optional<Identity> identity() const { return std::nullopt; }
  /// A part of the scene that only one load of any kind may use, e.g. "the surface of 'drop'".
  /// Empty if there is none.
  virtual std::string claim() const { return ""; }
  /// Notes problems of the load with these bodies in the block.
  virtual void check(const Block& block, const BodyPlans<D>& bodies) const = 0;
  /// Sets requirements of the load in the plans of the bodies.
  virtual void prepare(BodyPlans<D>&) const {}
  /// Adds force terms and measures. Throws InputError for problems that are found only here.
  virtual void build(Assembly<D>& assembly) const = 0;

  std::string place;  ///< "file:line:column: table" to begin messages with
};

/// The entry of a kind of load in the registry.
template <int D>
struct LoadEntry {
  static constexpr const char* kind = "load";
  std::string_view name;  ///< name of its tables: [[name]]
  std::string_view example;
  Stage stage;
  std::vector<KeyTable> (*keys)();
  std::unique_ptr<Load<D>> (*read)(
      const Block&);  ///< reads the keys of rows(); check() does the rest
};

/// The registry of the kinds of loads in D dimensions.
template <int D>
const Registry<LoadEntry<D>>& loads() {
  return Registry<LoadEntry<D>>::all();
}

/// Registers the load L of D dimensions. L::rows() are its keys. If it has inner tables,
/// L::read_inner(block) reads them and L::inner_tables() describes them.
template <int D, class L>
bool register_load_in(std::string_view name, Stage stage, std::string_view meaning) {
  // Static, since functions without captures use them.
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

/// Registers the load L<D> in 2D and 3D.
template <template <int> class L>
bool register_load(std::string_view name, Stage stage, std::string_view meaning) {
  return register_load_in<2, L<2>>(name, stage, meaning) &&
         register_load_in<3, L<3>>(name, stage, meaning);
}

}  // namespace meniscus
