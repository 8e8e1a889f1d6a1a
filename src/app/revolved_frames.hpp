// SPDX-License-Identifier: BSD-3-Clause
// DIR/revolved.h5 and its views for ParaView: the surfaces of bodies of revolution, turned about
// their axis.
#pragma once
#include "io/result_file.hpp"
#include "run/simulation.hpp"

namespace meniscus {

/// Turns the surface of the half plane about the axis, which stays y, with scalars and vectors.
/// Writes nothing unless output.revolved is set.
template <int D>
class RevolvedFrames {
 public:
  /// `continued`: the run continues in the directory of an earlier run.
  RevolvedFrames(const Simulation<D>& simulation, const RunDirectory& directory,
                 const Provenance& provenance, bool continued);

  /// Adds a frame of fields of all particles in the half plane. Throws FileError.
  void write(std::int64_t step, Real time, std::span<const ResultField> fields);

 private:
  std::vector<std::vector<Index>> on_surface_;  // [body] particles, numbered over all bodies
  std::unique_ptr<ResultFile> file_;
};

}  // namespace meniscus
