// SPDX-License-Identifier: BSD-3-Clause
// Measures of a load on a face: its net force, and the mean displacement of the face.
#pragma once
#include "body/surface/face_cells.hpp"
#include "kernel/row_sums.hpp"
#include "meniscus/physics/force_term.hpp"

#include <string>
#include <vector>

namespace meniscus {

/// `force(motion)` returns the net force, a Vec<D>. The body and the face cells outlive the
/// measures.
template <int D, class F>
std::vector<MeasureSource> face_measures(const Body<D>& body, const FaceCells<D>& cells, F force) {
  std::vector<MeasureSource> measures;
  for (int i = 0; i < D; ++i) {
    measures.push_back({std::string("force_") + "xyz"[i], of_sum(dimension::force, D),
                        "sum of the forces of the traction",
                        [force, i](const Motion& motion) { return force(motion)[i]; }});
    measures.push_back({std::string("displacement_") + "xyz"[i], dimension::length,
                        "mean over the face", [&body, &cells, i](const Motion& motion) {
                          const NodalVector* u = motion.u.data() + body.first;
                          Real sum = 0;
                          for (Index k = 0; k < cells.size(); ++k)
                            sum += at(cells.area, k) * value_at(cells.mean, k, u)[i];
                          return sum / cells.total_area();
                        }});
  }
  return measures;
}

}  // namespace meniscus
