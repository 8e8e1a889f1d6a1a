// SPDX-License-Identifier: BSD-3-Clause
// Result frames of rigid partners, which move without deforming.
#include "app/partner_frames.hpp"

#include <deque>

namespace meniscus {
namespace {

template <int D>
std::vector<Real> coordinates(const std::vector<Vec<D>>& X, const Vec<D>& displacement) {
  std::vector<Real> x;
  for (const Vec<D>& place : X)
    for (int i = 0; i < D; ++i) x.push_back(place[i] + displacement[i]);
  return x;
}

}  // namespace

template <int D>
PartnerFrames<D>::PartnerFrames(const Simulation<D>& simulation, const RunDirectory& directory,
                                const Provenance& provenance, bool continued)
    : unit_(simulation.scene().units.symbol(dimension::length)) {
  const Scene<D>& scene = simulation.scene();
  if (scene.partners.empty()) return;
  Box<D> box;
  for (const Body<D>& body : scene.system.bodies)
    for (const Vec<D>& X : body.particles.X()) box.include(X);
  std::deque<std::vector<Real>> X;
  std::deque<std::vector<Index>> cells;
  std::vector<BodyReference> surfaces;
  for (const DrawnPartner<D>& partner : scene.partners) {
    const Part& part = parts_.emplace_back(Part{partner.shape->drawing(box), partner.motion});
    std::vector<Index>& corners = cells.emplace_back();
    for (const auto& facet : part.drawing.facets)
      corners.insert(corners.end(), facet.begin(), facet.end());
    X.push_back(coordinates<D>(part.drawing.X, Vec<D>::Zero()));
    surfaces.push_back({partner.contact, {{"X", D, unit_, X.back()}}, 1 << (D - 1), corners, {}});
  }
  ResultOptions options;
  options.name = "partners";
  options.time_unit = scene.units.symbol(dimension::time);
  if (continued) options.continue_after = simulation.state().step;
  file_ = std::make_unique<ResultFile>(directory, provenance, surfaces, options);
}

template <int D>
void PartnerFrames<D>::write(std::int64_t step, Real time) {
  if (!file_) return;
  std::vector<Real> x;
  for (const Part& part : parts_) {
    const std::vector<Real> own = coordinates<D>(part.drawing.X, part.motion.displacement(time));
    x.insert(x.end(), own.begin(), own.end());
  }
  const ResultField position{"position", D, unit_, x};
  file_->write_frame(step, time, {&position, 1});
}

template class PartnerFrames<2>;
template class PartnerFrames<3>;

}  // namespace meniscus
