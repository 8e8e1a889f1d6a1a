// SPDX-License-Identifier: BSD-3-Clause
// DIR/partners.h5 and its views for ParaView: the positions of the rigid partners of contacts in
// each frame.
#pragma once
#include "io/result_file.hpp"
#include "run/simulation.hpp"

namespace meniscus {

/// Writes the surfaces of the rigid partners of a scene. Writes nothing if the scene has none.
template <int D>
class PartnerFrames {
 public:
  /// `continued`: the run continues in the directory of an earlier run.
  PartnerFrames(const Simulation<D>& simulation, const RunDirectory& directory,
                const Provenance& provenance, bool continued);

  /// Adds a frame. Throws FileError.
  void write(std::int64_t step, Real time);

 private:
  struct Part {
    typename PartnerShape<D>::Drawing drawing;
    RigidMotion<D> motion;
  };
  std::string unit_;
  std::vector<Part> parts_;
  std::unique_ptr<ResultFile> file_;
};

}  // namespace meniscus
