// SPDX-License-Identifier: BSD-3-Clause
// Keys by which loads name a face of a body.
#pragma once
#include "body/surface/face_cells.hpp"
#include "input/optional_rows.hpp"
#include "meniscus/scene/load.hpp"

namespace meniscus {

/// A body and a part of its surface, given by the name of a face, by a formula, or by both.
struct FaceKeys {
  std::string body, face;
  std::optional<Expression> where;

  /// Notes a problem if the face does not exist.
  template <int D>
  void check(const Block& block, const BodyPlans<D>& bodies) const;
  /// Notes that neither `face` nor `where` is given: "a held face is named".
  template <int D>
  void require_named(const Block& block, const BodyPlans<D>& bodies, std::string_view what) const;
  /// Sets `loaded_faces` of the body.
  template <int D>
  void prepare(BodyPlans<D>& bodies) const {
    for (BodyPlan<D>& planned : bodies) planned.loaded_faces |= planned.settings.name == body;
  }
  /// The face cells. `place` is the place of the table, with which messages begin. Throws like
  /// face_cells().
  template <int D>
  FaceCells<D> cells(const std::string& place, const Body<D>& body) const;
  /// "beam-x_min"; "beam" if the face has no name.
  std::string label() const { return face.empty() ? body : body + "-" + face; }
};

/// Makes a row of a struct from a row of one of its members.
template <class M, class Part>
Row<M> row_of_part(const Row<Part>& row, Part M::*part) {
  return {row.key,
          row.type,
          row.unit,
          row.range,
          row.fallback,
          row.meaning,
          [=](M& m, const Block& block) { row.read(m.*part, block); }};
}

/// `without`: what is meant where both keys are missing.
template <class M>
Rows<M> face_rows(FaceKeys M::*face, const std::string& without = "the whole surface") {
  return {row_of_part(text_row("body", &FaceKeys::body, "name of the body"), face),
          row_of_part(text_row("face", &FaceKeys::face,
                               "name of a face of its shape, as `meniscus check` lists them; "
                               "empty: " +
                                   without,
                               ""),
                      face),
          row_of_part(optional_expression_row(
                          "where", &FaceKeys::where, dimension::none, range::any, "1",
                          "only facets at whose reference place x, y, z this formula is not zero, "
                          "e.g. \"x < 0.1\""),
                      face)};
}

}  // namespace meniscus
