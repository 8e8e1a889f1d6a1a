// SPDX-License-Identifier: BSD-3-Clause
// Pressure on a face that follows its deformation.
#include "kernel/row_sums.hpp"
#include "numbers/dense.hpp"
#include "physics/assembled_force.hpp"
#include "physics/loads/face_measures.hpp"
#include "physics/loads/pressure_patches.hpp"
#include "physics/point_elements.hpp"

#include <algorithm>
#include <cmath>

namespace meniscus {
namespace {

template <int D>
class FacePressure final : public ForceTerm, public AssembledForce {
 public:
  FacePressure(const Body<D>& body, std::string label, FaceCells<D> cells, Expression pressure,
               const Ramp& ramp, const HeldDirections& held)
      : body_(body),
        label_(std::move(label)),
        cells_(std::move(cells)),
        pressure_(std::move(pressure)),
        ramp_(ramp),
        patches_(body, cells_, held, !pressure_.depends_on_place()),
        chunk_sums_(body.chunk_sums(patches_.rows().start, patches_.rows().particle)),
        x_(patches_.X()),
        point_force_(x_),
        values_(static_cast<std::size_t>(patches_.pieces() * patches_.gauss_points())),
        reference_volume_(patches_.volume(x_)) {}

  std::string name() const override { return "traction '" + label_ + "'"; }

  Report add_force(const Motion& motion, Forces force) override {
    find_places(motion, x_);
    find_forces(motion.time, x_, point_force_);
    scatter(force);
    Report report;
    if (!patches_.closed() || pressure_.depends_on_place()) report.outside = resultant();
    return report;
  }
  /// Adds the exact tangent: the force is quadratic in the positions (2D: linear), so a difference
  /// of two forces is exact.
  void add_tangent(const Motion& motion, const Motion& change, Forces force) override {
    NodalVectors ahead(x_.size()), behind = ahead, more = ahead;
    find_places(motion, x_);
    for (Index q = 0; q < patches_.points(); ++q) {
      const NodalVector dx = value_at(patches_.rows(), q, own(change.u));
      at(ahead, q) = at(x_, q) + dx;
      at(behind, q) = at(x_, q) - dx;
    }
    patches_.place_held_rim(ahead);
    patches_.place_held_rim(behind);
    find_forces(motion.time, ahead, more);
    find_forces(motion.time, behind, point_force_);
    for (Index q = 0; q < patches_.points(); ++q)
      at(point_force_, q) = 0.5 * (at(more, q) - at(point_force_, q));
    scatter(force);
  }
  std::optional<Real> potential(const Motion& motion) override {
    if (!has_potential()) return std::nullopt;
    find_places(motion, x_);
    return uniform_pressure(motion.time) * (patches_.volume(x_) - reference_volume_);
  }
  Real load_power(const Motion& motion) override {
    find_places(motion, x_);
    find_forces(motion.time, x_, point_force_);
    return parallel_sum(patches_.points(), 0.0, [&](Index q) {
      return sum(at(point_force_, q) * value_at(patches_.rows(), q, own(motion.v)));
    });
  }
  /// Without a potential the tangent has no symmetry.
  bool has_stiffness() const override { return has_potential(); }
  void announce(StiffnessMatrix& K) override {
    elements_.announce(patches_.rows(), patches_.points_of_pieces(), body_.first, K);
  }
  void add_stiffness(const Motion& motion, std::span<const Lanes>, StiffnessMatrix& K) override {
    if (!K.is_here()) return;
    NodalVectors x(x_);
    find_places(motion, x);
    const std::vector<Real> pressures(values_.size(), uniform_pressure(motion.time));
    elements_.add(patches_.rows(), K, [&](Index piece, Eigen::MatrixXd& M) {
      patches_.add_stiffness(piece, elements_.points(piece), pressures, x, M);
    });
  }

  bool reads(StepReads& reads) override {
    reads.particles(patches_.rows().particle, body_.first);
    reads.rows(chunk_sums_, body_.first);
    return true;
  }
  Real steady_after() const override { return std::max(pressure_.steady_after(), ramp_.end); }
  Real uncancelled_force(const Motion& motion) const override {
    Real sum = 0;
    for (const Lanes& f : forces_at(motion)) sum += std::sqrt(meniscus::sum(f * f));
    return sum;
  }
  std::vector<MeasureSource> measures() const override {
    return face_measures(body_, cells_, [this](const Motion& motion) {
      Vec<D> sum = Vec<D>::Zero();
      const NodalVectors forces = forces_at(motion);
      for (Index q = 0; q < patches_.points(); ++q) sum += vector_at<D>(forces, q);
      return sum;
    });
  }
  std::size_t bytes() const override {
    return patches_.bytes() + chunk_sums_.bytes() + 2 * x_.size() * sizeof(NodalVector) +
           values_.size() * sizeof(Real);
  }
  Offset pairs() const override { return patches_.rows().entries(); }

 private:
  const NodalVector* own(std::span<const NodalVector> field) const {
    return field.data() + body_.first;
  }
  /// The force of an even pressure is the gradient of p V.
  bool has_potential() const { return patches_.has_volume() && !pressure_.depends_on_place(); }
  Real uniform_pressure(Real time) const {
    return ramp_.fraction(time) * pressure_({0, 0, 0}, time);
  }
  void find_places(const Motion& motion, NodalVectors& x) const {
    parallel_for(patches_.points(), [&](Index q) {
      at(x, q) = at(patches_.X(), q) + value_at(patches_.rows(), q, own(motion.u));
    });
    patches_.place_held_rim(x);
  }
  /// Sets the pressures at the Gauss points of all pieces. Formulas are evaluated at reference
  /// positions.
  void find_pressures(Real time) {
    if (!pressure_.depends_on_place()) {
      std::fill(values_.begin(), values_.end(), uniform_pressure(time));
      return;
    }
    const Real ramp = ramp_.fraction(time);
    const Index per_piece = patches_.gauss_points();
    for (Index k = 0; k < patches_.pieces(); ++k)
      for (Index g = 0; g < per_piece; ++g)
        at(values_, k * per_piece + g) = ramp * pressure_(spatial<D>(patches_.place(k, g)), time);
  }
  void find_forces(Real time, const NodalVectors& x, NodalVectors& forces) {
    find_pressures(time);
    patches_.find_forces(values_, x, forces);
  }
  NodalVectors forces_at(const Motion& motion) const {
    FacePressure copy(*this);
    copy.find_places(motion, copy.x_);
    copy.find_forces(motion.time, copy.x_, copy.point_force_);
    return copy.point_force_;
  }
  void scatter(std::span<NodalVector> force) {
    chunk_sums_.accumulate(body_.part(force), [&](int, Index begin, Index end, NodalVector* f) {
      for (Index q = begin; q < end; ++q) scatter_value(patches_.rows(), q, at(point_force_, q), f);
    });
  }
  Resultant resultant() const {
    Resultant all;
    for (Index q = 0; q < patches_.points(); ++q) {
      const Eigen::Vector3d f = spatial(at(point_force_, q));
      all += {f, cross(spatial(at(x_, q)), f)};
    }
    return {all.force, all.moment};
  }

  const Body<D>& body_;
  std::string label_;
  FaceCells<D> cells_;
  Expression pressure_;
  Ramp ramp_;
  PressurePatches<D> patches_;
  ChunkSums chunk_sums_;
  MeanElements<D> elements_;
  // Work space of a force: positions of points, forces on them, pressures [piece][Gauss point].
  NodalVectors x_, point_force_;
  std::vector<Real> values_;
  Real reference_volume_;
};

}  // namespace

template <int D>
std::unique_ptr<ForceTerm> face_pressure(const Body<D>& body, std::string label, FaceCells<D> cells,
                                         Expression pressure, const Ramp& ramp,
                                         const HeldDirections& held) {
  return std::make_unique<FacePressure<D>>(body, std::move(label), std::move(cells),
                                           std::move(pressure), ramp, held);
}
template std::unique_ptr<ForceTerm> face_pressure(const Body<2>&, std::string, FaceCells<2>,
                                                  Expression, const Ramp&, const HeldDirections&);
template std::unique_ptr<ForceTerm> face_pressure(const Body<3>&, std::string, FaceCells<3>,
                                                  Expression, const Ramp&, const HeldDirections&);

}  // namespace meniscus
