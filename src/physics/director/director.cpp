// SPDX-License-Identifier: BSD-3-Clause
// The director field of a body.
#include "physics/director/director.hpp"

#include "body/particle_values.hpp"
#include "kernel/row_sums.hpp"
#include "numbers/dense.hpp"

#include <algorithm>
#include <cmath>

namespace meniscus {
namespace {

/// The gradient at a particle. In a body of revolution (2, 2) is the stretch of its circle.
template <int D>
Tensor<Real> gradient_of(const PointRows<D>& rows, Index A, const NodalVector* field) {
  const std::array<Lanes, D> columns = gradient_at(rows, A, field);
  Real stretch = 0;
  if (rows.folded)
    for (Offset e = at(rows.start, A); e < at(rows.start, A + 1); ++e)
      stretch += circle_stretch_at(rows, A, e) * field[at(rows.particle, e)][0];
  return Tensor<Real>::map([&](int i, int K) {
    return i < D && K < D ? at(columns, K)[i] : i == 2 && K == 2 ? stretch : 0.0;
  });
}

/// Adds P . dF_A/du_B to all particles B.
template <int D>
void scatter_gradient(const PointRows<D>& rows, Index A, const Tensor<Real>& P, NodalVector* f) {
  std::array<Lanes, D> column;
  for (int K = 0; K < D; ++K) at(column, K) = Lanes(P(0, K), P(1, K), D == 3 ? P(2, K) : 0.0, 0);
  for (Offset e = at(rows.start, A); e < at(rows.start, A + 1); ++e) {
    NodalVector& sum = f[at(rows.particle, e)];
    for (int K = 0; K < D; ++K) sum += slope_at(rows, e, K) * at(column, K);
    if (rows.folded) sum += Lanes(circle_stretch_at(rows, A, e) * P(2, 2), 0, 0, 0);
  }
}

Tensor<Real> inverse_of(const Tensor<Real>& x) {
  return (1 / determinant(x)) * transpose(cofactor(x));
}

Eigen::Vector3d product(const Tensor<Real>& A, const Eigen::Vector3d& x) {
  const auto row = [&](int i) { return A(i, 0) * x[0] + A(i, 1) * x[1] + A(i, 2) * x[2]; };
  return {row(0), row(1), row(2)};
}

Lanes lanes_of(const Eigen::Vector3d& x) {
  return {x[0], x[1], x[2], 0};
}

std::vector<Real> resistance(const NematicNumbers& numbers, std::vector<Real> volume) {
  for (Real& c : volume) c *= numbers.rotational_viscosity;
  return volume;
}

}  // namespace

template <int D>
Director<D>::Director(const Body<D>& body, std::size_t number, const NematicBody<D>& nematic)
    : CarriedField(number, body.first, resistance(nematic.numbers, nematic.volume),
                   "director of body '" + body.name + "'",
                   "a lower frank_constant, a larger rotational_viscosity"),
      body_(body),
      numbers_(nematic.numbers),
      gradients_(build_point_rows<D>(body.particles, body.particles.X(),
                                     {.value = body.geometry.grid.revolved, .gradient = true},
                                     body.name)),
      chunk_sums_(body.chunk_sums(gradients_.start, gradients_.particle)),
      volume_(nematic.volume) {
  for (const Vec<D>& h : nematic.director) initial_.push_back(spatial<D>(h));
}

/// Transports the director with the motion. With D = (F_1 - F_0) [(F_0 + F_1)/2]^-1 and B = skew D
/// + lambda sym D - nu2 tr D I, h becomes (I - B/2)^-1 (I + B/2) h. This is exact for rotations and
/// reversible.
template <int D>
void Director<D>::carry(const NodalVector* from, const NodalVector* to,
                        std::span<NodalVector> x) const {
  const Real lambda = numbers_.flow_alignment, nu2 = numbers_.dilatation_coupling;
  parallel_for(chunk_sums_.own_rows(body_.size()), [&](Index A) {
    const Tensor<Real> H0 = gradient_of(gradients_, A, from), H1 = gradient_of(gradients_, A, to);
    const Tensor<Real> change = (H1 - H0) * inverse_of(deformation_gradient(0.5 * (H0 + H1)));
    const Tensor<Real> half =
        add_diagonal(Tensor<Real>::map([&](int i, int j) {
                       return 0.25 * ((lambda + 1) * change(i, j) + (lambda - 1) * change(j, i));
                     }),
                     -0.5 * nu2 * trace(change));
    const Tensor<Real> one = Tensor<Real>::identity();
    at(x, A) = lanes_of(product(inverse_of(one - half), product(one + half, spatial(at(x, A)))));
  });
  gather(x);
}

template <int D>
void Director<D>::gather(std::span<NodalVector> x) const {
  body_.gather(x);
}

template <int D>
void Director<D>::add_reaction(const Motion& motion, Forces force) {
  if (force.fields.empty()) return;
  const NodalVector* u = motion.u.data() + body_.first;
  const auto x = part(std::span<const NodalVector>(at(motion.fields, number()).x));
  const auto forces_on_x = part(std::span<const NodalVector>(at(force.fields, number()).f));
  const Real lambda = numbers_.flow_alignment, nu2 = numbers_.dilatation_coupling;
  chunk_sums_.accumulate(body_.part(force), [&](int, Index begin, Index end, NodalVector* f) {
    for (Index A = begin; A < end; ++A) {
      const Eigen::Vector3d h = spatial(at(x, A)), S = -spatial(at(forces_on_x, A));
      const Tensor<Real> F = deformation_gradient(gradient_of(gradients_, A, u));
      const Tensor<Real> Y =
          add_diagonal(Tensor<Real>::map([&](int i, int j) {
                         return 0.5 * ((lambda - 1) * h[i] * S[j] + (lambda + 1) * S[i] * h[j]);
                       }),
                       -nu2 * S.dot(h));
      scatter_gradient(gradients_, A, (-1 / determinant(F)) * (Y * cofactor(F)), f);
    }
  });
}

template <int D>
NodalVectors Director<D>::values(const Motion& motion) const {
  return values_at_particles(body_, at(motion.fields, number()).x.data() + body_.first);
}

/// Mean of a value per particle over the reference volume.
template <int D>
template <class F>
Real Director<D>::mean(F&& of_particle) const {
  Real sum = 0, volume = 0;
  for (Index A = 0; A < body_.size(); ++A) {
    sum += body_.cells.volume(A) * of_particle(A);
    volume += body_.cells.volume(A);
  }
  return sum / volume;
}

/// Order parameter: the largest eigenvalue of the mean of (d h h/|h|^2 - I)/(d - 1) in the space of
/// dimension d.
template <int D>
Real Director<D>::order(const Motion& motion) const {
  Mat<D> Q = Mat<D>::Zero();
  const bool revolved = body_.geometry.grid.revolved;
  Real volume = 0;
  const NodalVectors directors = values(motion);
  for (Index A = 0; A < body_.size(); ++A) {
    const Eigen::Vector3d h = spatial(at(directors, A));
    const Real square = h.squaredNorm();
    if (!(square > 0)) continue;
    const Vec<D> axis = h.template head<D>();
    Mat<D> square_of = axis * axis.transpose();
    if (revolved) {  // the mean over the circle, whose other direction across the axis has as much
      square_of(0, 0) *= 0.5;
      square_of(0, 1) = square_of(1, 0) = 0;
    }
    Q += body_.cells.volume(A) / square * square_of;
    volume += body_.cells.volume(A);
  }
  if (!(volume > 0)) return 0;
  const Vec<D> eigenvalues = symmetric_eigenvalues<D>(Q / volume);
  return (body_.space() * eigenvalues.maxCoeff() - 1) / (body_.space() - 1);
}

/// The elastic couple h x s per volume, with the force s = -dE/dh on the director. Zero at rest.
template <int D>
void Director<D>::couples(const Motion& motion, std::span<Real> values) {
  const NodalVector* u = motion.u.data() + body_.first;
  const auto x = part(std::span<const NodalVector>(at(motion.fields, number()).x));
  NodalVectors f(x.size());
  hold_places(u);
  held_force(x.data(), f);
  for (Index A = 0; A < body_.size(); ++A) {
    const Eigen::Vector3d m = cross(spatial(at(x, A)), -spatial(at(f, A))) / at(volume_, A);
    for (int i = 0; i < 3; ++i) at(values, 3 * A + i) = m[i];
  }
}

/// P2 of the angle between the present and the initial director; 1 where a director is zero.
template <int D>
Real Director<D>::tilt(const Lanes& director, Index A) const {
  const Eigen::Vector3d h = spatial(director), &h0 = at(initial_, A);
  const Real squares = h.squaredNorm() * h0.squaredNorm(), product = h.dot(h0);
  const int space = body_.space();
  return squares > 0 ? (space * product * product / squares - 1) / (space - 1) : 1;
}

template <int D>
std::vector<FieldSource> Director<D>::fields() {
  return {{"director", D, dimension::none, "director of a nematic",
           [this](const Motion& motion, std::span<Real> values) {
             const NodalVectors h = this->values(motion);
             for (Index A = 0; A < body_.size(); ++A)
               for (int i = 0; i < D; ++i) at(values, D * A + i) = at(h, A)[i];
           }},
          {"director_couple", 3, dimension::pressure,
           "couple h x s per volume that the director exerts while it is not at rest, s = dE/dh",
           [this](const Motion& motion, std::span<Real> values) { couples(motion, values); }},
          {"director_tilt", 1, dimension::none,
           "P2 = (3 c^2 - 1)/2 (2D: 2 c^2 - 1), c the cosine between the director and that of the "
           "start",
           [this](const Motion& motion, std::span<Real> values) {
             const NodalVectors h = this->values(motion);
             for (Index A = 0; A < body_.size(); ++A) at(values, A) = tilt(at(h, A), A);
           }}};
}

template <int D>
std::vector<MeasureSource> Director<D>::measures() {
  const auto length = [this](const Motion& motion) {
    const NodalVectors h = values(motion);
    return mean([&](Index A) { return spatial(at(h, A)).norm(); });
  };
  const auto couple = [this](const Motion& motion) {
    std::vector<Real> m(3 * volume_.size());
    couples(motion, m);
    return std::sqrt(mean([&](Index A) {
      return std::pow(at(m, 3 * A), 2) + std::pow(at(m, 3 * A + 1), 2) +
             std::pow(at(m, 3 * A + 2), 2);
    }));
  };
  return {
      {"director_couple", dimension::pressure,
       "rms of the couple h x s per volume that the director exerts while it is not at rest",
       couple},
      {"director_order", dimension::none,
       "order of the directors: 1 where all are parallel, 0 where they have all directions",
       [this](const Motion& motion) { return order(motion); }},
      {"director_tilt", dimension::none,
       "mean of P2 = (3 c^2 - 1)/2 (2D: 2 c^2 - 1), c the cosine between the director and that of "
       "the start",
       [this](const Motion& motion) {
         const NodalVectors h = values(motion);
         return mean([&](Index A) { return tilt(at(h, A), A); });
       }},
      {"director_length", dimension::none, "mean of |h|", length}};
}

template <int D>
std::size_t Director<D>::bytes() const {
  return CarriedField::bytes() + gradients_.bytes() + chunk_sums_.bytes() +
         volume_.size() * sizeof(Real) + initial_.size() * sizeof(Eigen::Vector3d);
}

template class Director<2>;
template class Director<3>;

}  // namespace meniscus
