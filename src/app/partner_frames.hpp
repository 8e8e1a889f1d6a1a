// SPDX-License-Identifier: BSD-3-Clause
// DIR/partners.h5 and its views: where the rigid partners of contacts are in the frames of a run.
#pragma once
#include "io/result_file.hpp"
#include "run/simulation.hpp"

namespace meniscus {

/// The surfaces of the rigid partners of a scene; writes nothing if it has none.
template <int D>
class PartnerFrames {
 public:
  /// `continued`: the run goes on in the directory it was in before.
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
