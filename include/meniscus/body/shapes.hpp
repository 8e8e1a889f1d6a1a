// SPDX-License-Identifier: BSD-3-Clause
// The shapes that a scene can name. To add one, write one file in src/body/shapes with a struct
// like those below and the line `const bool registered = register_shape<D, MyShape>();`.
#pragma once
#include "body/shapes/geometry.hpp"
#include "body/shapes/meridian.hpp"
#include "body/shapes/refinement.hpp"
#include "input/key_table.hpp"
#include "input/registry.hpp"

#include <optional>
#include <string_view>
#include <vector>

namespace meniscus {

/// Cubed sphere: core^3 cells inside `layers` shells of 6 core^2 cells each. It has (core + 1)^3 +
/// layers (6 core^2 + 2) nodes.
struct Ball {
  static constexpr const char* name = "ball";
  static constexpr const char* meaning = "ball, meshed as a cubed sphere";
  static constexpr std::string_view example = "radius = 1\ncore = 2\nlayers = 1\n";
  Real radius = 1;
  int core = 10, layers = 5;
  std::vector<Real> centre{0, 0, 0};

  static Rows<Ball> rows();
  Geometry<3> geometry() const;
};

/// The cubed sphere stretched along the axes.
struct Ellipsoid {
  static constexpr const char* name = "ellipsoid";
  static constexpr const char* meaning = "ellipsoid, a stretched ball";
  static constexpr std::string_view example = "semi_axes = [1, 1, 1.2]\ncore = 2\nlayers = 1\n";
  std::vector<Real> semi_axes{1, 1, 1};
  int core = 10, layers = 5;
  std::vector<Real> centre{0, 0, 0};

  static Rows<Ellipsoid> rows();
  Geometry<3> geometry() const;
};

/// The half of Ball with z >= 0, or z <= 0 with `below`, centred at its flat face.
struct HalfSphere {
  static constexpr const char* name = "half_sphere";
  static constexpr const char* meaning = "half ball above its flat face z = 0, or below it";
  static constexpr std::string_view example = "radius = 1\ncore = 4\nlayers = 1\n";
  Real radius = 1;
  int core = 10, layers = 5;
  bool below = false;
  std::vector<Real> centre{0, 0, 0};

  static Rows<HalfSphere> rows();
  Geometry<3> geometry() const;
};

/// Cylinder or disc about z: the cells of Disk in `layers` equal layers.
struct Cylinder {
  static constexpr const char* name = "cylinder";
  static constexpr const char* meaning = "cylinder or disc about z";
  static constexpr std::string_view example =
      "radius = 1\nheight = 1\ncore = 4\nrings = 1\nlayers = 2\n";
  Real radius = 1, height = 1;
  int core = 18, rings = 9, layers = 3;
  std::vector<Real> centre{0, 0, 0};

  static Rows<Cylinder> rows();
  Geometry<3> geometry() const;
};

/// Parameters common to all shells: a wall of even thickness about z. It has (6 n^2 + 2) layers
/// nodes with n = quarter of a meridian / spacing.
struct Wall {
  Real thickness = 0.1;
  int layers = 4;  ///< particles through the wall
  Real spacing = 0.1;
  std::vector<Real> centre{0, 0, 0};
};

/// A hollow disk with flat faces and a semicircular rim. Its outer surface has the distance height
/// / 2 from a flat circular plate.
struct DiskShell : Wall {
  static constexpr const char* name = "disk_shell";
  static constexpr const char* meaning = "hollow disk with round rim";
  static constexpr std::string_view example =
      "radius = 2\nheight = 1.6\nthickness = 0.4\nspacing = 0.6\n";
  Real radius = 1, height = 0.5;

  static Rows<DiskShell> rows();
  Meridian meridian() const;  ///< of the outer surface; throws InputError if there is none
  Geometry<3> geometry() const;
};

struct CylinderShell : Wall {
  static constexpr const char* name = "cylinder_shell";
  static constexpr const char* meaning = "hollow cylinder with rounded edges";
  static constexpr std::string_view example =
      "radius = 2\nheight = 3\nthickness = 0.4\nspacing = 0.8\nedge_radius = 0.8\n";
  Real radius = 1, height = 1, edge_radius = 0.5;

  static Rows<CylinderShell> rows();
  Meridian meridian() const;  ///< of the outer surface; throws InputError if there is none
  Geometry<3> geometry() const;
};

struct SpheroidShell : Wall {
  static constexpr const char* name = "spheroid_shell";
  static constexpr const char* meaning = "hollow spheroid with a wall of even thickness";
  static constexpr std::string_view example =
      "radius = 2\nheight = 3\nthickness = 0.4\nspacing = 0.7\n";
  Real radius = 1, height = 1;

  static Rows<SpheroidShell> rows();
  Meridian meridian() const;  ///< of the outer surface; throws InputError if there is none
  Geometry<3> geometry() const;
};

struct SphereShell : Wall {
  static constexpr const char* name = "sphere_shell";
  static constexpr const char* meaning = "hollow sphere";
  static constexpr std::string_view example = "radius = 2\nthickness = 0.4\nspacing = 0.7\n";
  Real radius = 1;

  static Rows<SphereShell> rows();
  Meridian meridian() const;  ///< of the outer surface; throws InputError if there is none
  Geometry<3> geometry() const;
};

/// A core of core^2 cells inside `rings` rings of 4 core cells.
struct Disk {
  static constexpr const char* name = "disk";
  static constexpr const char* meaning = "disk";
  static constexpr std::string_view example = "radius = 1\ncore = 4\nrings = 2\n";
  Real radius = 1;
  int core = 18, rings = 9;
  std::vector<Real> centre{0, 0};

  static Rows<Disk> rows();
  Geometry<2> geometry() const;
};

/// The disk stretched along the axes.
struct Ellipse {
  static constexpr const char* name = "ellipse";
  static constexpr const char* meaning = "ellipse, a stretched disk";
  static constexpr std::string_view example = "semi_axes = [1, 1.2]\ncore = 4\nrings = 2\n";
  std::vector<Real> semi_axes{1, 1};
  int core = 18, rings = 9;
  std::vector<Real> centre{0, 0};

  static Rows<Ellipse> rows();
  Geometry<2> geometry() const;
};

/// A ring of `layers` layers with `around` cells each.
struct Ring {
  static constexpr const char* name = "ring";
  static constexpr const char* meaning = "ring, the section of a thick-walled cylinder";
  static constexpr std::string_view example =
      "radius = 1\nthickness = 0.4\naround = 24\nlayers = 3\n";
  Real radius = 1, thickness = 0.5;
  int around = 48, layers = 6;
  std::vector<Real> centre{0, 0};

  static Rows<Ring> rows();
  Geometry<2> geometry() const;
};

/// Box (3D) or rectangle (2D) of equal cells along the axes.
template <int D>
struct Brick {
  static constexpr const char* name = D == 3 ? "box" : "rectangle";
  static constexpr const char* meaning = D == 3 ? "box of equal cells" : "rectangle of equal cells";
  static constexpr std::string_view example =
      D == 3 ? "size = [1, 1, 2]\nspacing = 0.5\n" : "size = [1, 2]\nspacing = 0.5\n";
  std::vector<Real> size = std::vector<Real>(D, 1);
  std::vector<Real> cells;   ///< number per direction; empty: from `spacing`
  Real spacing = 0;          ///< largest edge of a cell
  std::vector<Real> corner;  ///< lowest corner; empty: from `centre`
  std::vector<Real> centre;  ///< empty: from `corner`, or the origin if that is empty too

  static Rows<Brick> rows();
  Geometry<D> geometry() const;
};

/// A registered shape.
template <int D>
struct ShapeEntry {
  static constexpr const char* kind = "shape";
  std::string_view name, meaning, example;
  std::vector<KeyText> (*keys)();
  /// Makes the geometry; returns nothing if the table has a problem. Throws InputError if the
  /// numbers make no shape.
  std::optional<Geometry<D>> (*make)(const Block&);
};

/// The registry of the shapes of D dimensions.
template <int D>
const Registry<ShapeEntry<D>>& shapes() {
  return Registry<ShapeEntry<D>>::all();
}

/// Registers the shape S, which has name, meaning, example, rows() and geometry(). geometry()
/// throws InputError if the numbers make no shape.
template <int D, class S>
bool register_shape() {
  return register_entry(ShapeEntry<D>{S::name, S::meaning, example_of<S>(),
                                      [] { return key_texts(S::rows()); },
                                      [](const Block& block) -> std::optional<Geometry<D>> {
                                        S shape = read<S>(block);
                                        const Real k = block.refinement();
                                        if (k != 1 && !refine(shape, k))
                                          block.problem("shape",
                                                        "has the cells of a file, whose edges can "
                                                        "only be halved; allowed for [resolution] "
                                                        "refine is a power of 2: 1, 2, 4, ...");
                                        if (!block.in_order()) return std::nullopt;
                                        return shape.geometry();
                                      }});
}

/// The body that a table of the scene describes. `shape` names a registered shape whose keys are in
/// the same table. The keys of placement.hpp place it. `imperfection` (rms length, default 0) with
/// `imperfection_seed` displaces it (imperfection.hpp). `jitter` (fraction of the shortest edge,
/// default 0) with `jitter_seed` moves the interior nodes. If the numbers make no body, a problem
/// is noted and a coarse box is returned instead. The caller calls block.done(). If `revolved`, it
/// is the half plane of a body of revolution, see half_plane().
template <int D>
Geometry<D> read_geometry(const Block& block, bool revolved = false);

}  // namespace meniscus
