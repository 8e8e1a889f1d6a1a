// SPDX-License-Identifier: BSD-3-Clause
// The shapes of rigid partners of a contact, and their registry.
//
// A shape is a struct in its own file in src/physics/laws/partners. It has rows(), an example near
// a ball of radius 1 about the origin and, if numbers can contradict each other, check(block). The
// file ends with
//
//   const bool registered = register_partner<2, MyShape<2>>("my_shape", "meaning") && ...;
#pragma once
#include "input/key_table.hpp"
#include "input/registry.hpp"
#include "numbers/box.hpp"
#include "physics/contact/rigid/rigid_partner.hpp"

#include <array>
#include <memory>
#include <string_view>
#include <vector>

namespace meniscus {

template <int D>
class PartnerShape {
 public:
  virtual ~PartnerShape() = default;

  /// The distance d of a point from the surface, negative inside the material, with grad d (unit
  /// vector out of the material) and grad grad d.
  struct Foot {
    Real distance;
    Vec<D> normal;
    Mat<D> bend;
  };
  virtual Foot foot(const Vec<D>& x) const = 0;
  /// True if the surface is a plane.
  virtual bool flat() const { return false; }
  /// True if the surface has the same curvature at all places in all directions, so that a drop on
  /// it has one contact angle.
  virtual bool round() const { return flat(); }
  /// Points in the material, one of which lies inside any body that has run over the partner. Empty
  /// if no body can be around the partner.
  virtual std::vector<Vec<D>> places() const { return {}; }

  /// The surface for viewers: facets (2D: lines) by their corners in the order of VTK.
  struct Drawing {
    std::vector<Vec<D>> X;
    std::vector<std::array<Index, (1 << (D - 1))>> facets;
  };
  /// The drawing; of an infinite surface the part around the box.
  virtual Drawing drawing(const Box<D>& box) const = 0;

  /// The field of this shape with `beta` Lennard-Jones particles per volume. Throws InputError for
  /// numbers that make no shape.
  virtual std::unique_ptr<RigidPartner<D>> lennard_jones(const ContactLaw& law,
                                                         Real beta) const = 0;
};

template <int D>
struct PartnerEntry {
  static constexpr const char* kind = "rigid partner";
  std::string_view name, meaning, example;
  std::vector<KeyText> (*keys)();
  std::shared_ptr<const PartnerShape<D>> (*read)(const Block&);  ///< notes problems in the block
};

template <int D>
const Registry<PartnerEntry<D>>& partners() {
  return Registry<PartnerEntry<D>>::all();
}

template <int D, class P>
bool register_partner(std::string_view name, std::string_view meaning) {
  return register_entry(
      PartnerEntry<D>{name, meaning, example_of<P>(), [] { return key_texts(P::rows()); },
                      [](const Block& block) -> std::shared_ptr<const PartnerShape<D>> {
                        auto shape = std::make_shared<P>();
                        for (const auto& row : P::rows()) row.read(*shape, block);
                        if constexpr (requires { shape->check(block); })
                          if (block.in_order()) shape->check(block);
                        return shape;
                      }});
}

}  // namespace meniscus
