// SPDX-License-Identifier: BSD-3-Clause
// Measures of the shape of a body, and of its error against an exact solution.
#include "measure/shape_measures.hpp"

#include "body/particle_values.hpp"
#include "kernel/row_sums.hpp"
#include "measure/surface_extents.hpp"
#include "meniscus/measure/measure_registry.hpp"
#include "numbers/box.hpp"
#include "numbers/dense.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

namespace meniscus {
namespace {

/// Extents of the surface, and shape modes of the positions x(X_B) of its particles.
template <int D>
class SurfaceShape {
 public:
  explicit SurfaceShape(const Body<D>& body)
      : body_(body), extents_(body), particles_(boundary_nodes(body.geometry.grid)) {
    Box<D> box;
    for (const Index A : particles_) box.include(at(body.particles.X(), A));
    box.extent().maxCoeff(&axis_);
    if (body.geometry.grid.revolved) axis_ = 1;
  }

  Vec<D> extents(const Motion& motion) { return extents_.box(motion).extent(); }

  /// Least-squares fit r = r0 + r2 P2 + r4 P4 of the distance from the centre (2D: cos 2 phi,
  /// cos 4 phi) about the long reference axis, or the axis of revolution: (r0, r2, r4).
  Eigen::Vector3d legendre_fit(const Motion& motion) {
    const std::vector<Vec<D>> x = places(motion);
    const Vec<D> centre = extents_.box(motion).centre();
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (const Vec<D>& p : x) {
      const Real r = (p - centre).norm(), c = (p[axis_] - centre[axis_]) / r, c2 = c * c;
      const bool in_space = space_dimension(body_.geometry.grid) == 3;
      const Real share = body_.geometry.grid.revolved ? p[0] : 1;  // the length of its circle
      const Eigen::Vector3d mode =
          in_space ? Eigen::Vector3d(1, 1.5 * c2 - 0.5, (35 * c2 * c2 - 30 * c2 + 3) / 8)
                   : Eigen::Vector3d(1, 2 * c2 - 1, 8 * c2 * c2 - 8 * c2 + 1);
      normal += share * mode * mode.transpose();
      right += share * r * mode;
    }
    return solve_symmetric(normal, right);
  }

 private:
  std::vector<Vec<D>> places(const Motion& motion) const {
    const NodalVector* u = motion.u.data() + body_.first;
    const NodalVectors displacement = values_at_particles(body_, u, particles_);
    std::vector<Vec<D>> x;
    for (std::size_t k = 0; k < particles_.size(); ++k) {
      x.push_back(at(body_.particles.X(), particles_[k]));
      for (int i = 0; i < D; ++i) x[k][i] += displacement[k][i];
    }
    return x;
  }

  const Body<D>& body_;
  SurfaceExtents<D> extents_;
  std::vector<Index> particles_;
  Eigen::Index axis_ = 0;
};

}  // namespace

template <int D>
std::vector<MeasureSource> shape_measures(const Body<D>& body, const UnitSystem&) {
  const auto surface = std::make_shared<SurfaceShape<D>>(body);
  std::vector<MeasureSource> measures;
  for (int i = 0; i < D; ++i)
    measures.push_back({std::string("extent_") + "xyz"[i], dimension::length,
                        "extent of the surface along the axis",
                        [surface, i](const Motion& m) { return surface->extents(m)[i]; }});
  measures.push_back(
      {"aspect", dimension::none, "largest extent over smallest", [surface](const Motion& m) {
         const Vec<D> extents = surface->extents(m);
         return extents.maxCoeff() / extents.minCoeff();
       }});
  measures.push_back({"radius", dimension::length, "mean distance of the surface from its centre",
                      [surface](const Motion& m) { return surface->legendre_fit(m)[0]; }});
  measures.push_back({"p2", dimension::none,
                      "amplitude of the second Legendre mode (2D: cos 2 phi) over the mean radius",
                      [surface](const Motion& m) {
                        const Eigen::Vector3d r = surface->legendre_fit(m);
                        return r[1] / r[0];
                      }});
  return measures;
}

namespace {
const bool shape_measures_registered =
    register_measures("shape", shape_measures<2>, shape_measures<3>);
}

namespace {

/// Volume integrals of the squared error and of the squared exact solution.
struct ErrorAndSize {
  Real error = 0, size = 0;
};

/// Adds the contribution of particle A with the displacement u and the velocity v.
template <int D>
void add_particle(const Body<D>& body, const ExactSolution& exact, Real time, Index A,
                  const Lanes& u, const Lanes& v, ErrorAndSize& sum) {
  const Eigen::Vector3d X = spatial<D>(at(body.particles.X(), A));
  const Real V = body.cells.volume(A);
  for (int i = 0; i < D; ++i) {
    const Real u_exact = exact.rate * at(exact.displacement, i)(X, time);
    const Real v_exact = at(exact.velocity, i)(X, time);
    sum.error += V * (std::pow(exact.rate * u[i] - u_exact, 2) + std::pow(v[i] - v_exact, 2));
    sum.size += V * (u_exact * u_exact + v_exact * v_exact);
  }
}

}  // namespace

/// Relative error of displacement and velocity. Only one thread of a rank can evaluate a formula at
/// a time, so the particles are divided between ranks, not threads.
template <int D>
MeasureSource state_error(const Body<D>& body, ExactSolution exact) {
  const auto compute = [&body, exact = std::move(exact)](const Motion& m) {
    const Index n = body.size();
    NodalVectors u(static_cast<std::size_t>(n)), v(u.size());
    parallel_for(body.division.own_rows(n), [&](Index A) {
      at(u, A) = value_at(body.at_particles, A, m.u.data() + body.first);
      at(v, A) = value_at(body.at_particles, A, m.v.data() + body.first);
    });
    std::vector<ErrorAndSize> of_chunk(static_cast<std::size_t>(chunk_count(n)));
    on_each_rank([&] {
      const OwnItems own = body.division.own_items(chunk_count(n));
      for (Index c = own.begin; c < own.end; ++c)
        for (Index A = chunk_begin(n, c); A < chunk_begin(n, c + 1); ++A)
          add_particle(body, exact, m.time, A, at(u, A), at(v, A), at(of_chunk, c));
    });
    body.division.complete_items(chunk_count(n), of_chunk.data(), sizeof of_chunk[0]);
    ErrorAndSize all;
    for (const ErrorAndSize& sum : of_chunk) {
      all.error += sum.error;
      all.size += sum.size;
    }
    return all.error > 0 ? std::sqrt(all.error / all.size) : 0;  // both are 0 if nothing moves
  };
  return {"state_error", dimension::none,
          "error of places and velocities against the exact solution", compute};
}

template std::vector<MeasureSource> shape_measures(const Body<2>&, const UnitSystem&);
template std::vector<MeasureSource> shape_measures(const Body<3>&, const UnitSystem&);
template MeasureSource state_error(const Body<2>&, ExactSolution);
template MeasureSource state_error(const Body<3>&, ExactSolution);

}  // namespace meniscus
