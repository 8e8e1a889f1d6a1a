// SPDX-License-Identifier: BSD-3-Clause
// Preconditioner for equilibria: factors of the stiffness of linear elements, and the inverse of
// the transform from coefficients to positions.
//
// Elements are fully integrated, without averaging the volume change, like nodal cells with linear
// moments, which resist a volume change at D + 1 points. With averaging, a plane drop needs 128 to
// 1800 iterations instead of 44 to 195.
#include "solve/linear/element_preconditioner.hpp"

#include "body/particle_values.hpp"
#include "numbers/box.hpp"
#include "numbers/dense.hpp"
#include "solve/linear/nested_dissection.hpp"
#include "solve/linear/sparse_factors.hpp"

#include <fmt/core.h>

#include <cmath>

namespace meniscus {
namespace {

/// Stiffness of an element; block [a][b] gives the force at corner a by a displacement of corner b.
template <int D>
using ElementMatrix = std::array<std::array<Mat<D>, 1 << D>, 1 << D>;

/// Stiffness of an element, by two Gauss points per direction.
template <int D>
ElementMatrix<D> element_stiffness(const std::array<Vec<D>, 1 << D>& corners,
                                   const ElasticModuli& moduli) {
  ElementMatrix<D> K;
  for (auto& row : K) row.fill(Mat<D>::Zero());
  for (int q = 0; q < 1 << D; ++q) {
    Vec<D> xi;
    for (int k = 0; k < D; ++k) xi[k] = corner_sign(q, k) / std::sqrt(3.0);
    const Mat<D> J = multilinear<D, D>(corners, xi).J;
    const Mat<D> to_place = inverse<D>(J).transpose();
    auto g = corner_slopes<D>(xi);
    for (Vec<D>& slope : g) slope = to_place * slope;
    const Real weight = std::abs(determinant<D>(J));
    for (int a = 0; a < 1 << D; ++a)
      for (int b = 0; b < 1 << D; ++b) {
        Mat<D> block = moduli.lame * at(g, a) * at(g, b).transpose() +
                       moduli.shear * at(g, b) * at(g, a).transpose();
        block.diagonal().array() += moduli.shear * at(g, a).dot(at(g, b));
        at(at(K, a), b) += weight * block;
      }
  }
  return K;
}

/// True if a cell with these corners is neither folded nor close to it.
template <int D>
bool is_sound(const std::array<Vec<D>, 1 << D>& corners, Real sign) {
  constexpr Real least = 0.2;  // smallest determinant / largest
  Real smallest = unbounded, largest = 0;
  for (int q = 0; q < 1 << D; ++q) {
    Vec<D> xi;
    for (int k = 0; k < D; ++k) xi[k] = corner_sign(q, k) / std::sqrt(3.0);
    const Real J = sign * determinant<D>(multilinear<D, D>(corners, xi).J);
    smallest = std::min(smallest, J);
    largest = std::max(largest, J);
  }
  return smallest > least * largest;
}

/// Stiffness of a body. A small multiple of the masses is added so that rigid motions do not make
/// the matrix singular. For a time step, the masses themselves are added, and cells have their
/// shape at the beginning of the step.
template <int D>
std::vector<MatrixEntry> stiffness(const System<D>& system, const Body<D>& body,
                                   const ElasticModuli& moduli, const ImplicitEuler<D>* step) {
  constexpr Real share_of_mass = 1e-3;
  const Grid<D>& grid = body.geometry.grid;
  std::vector<Vec<D>> places = grid.X;
  if (step) {
    const NodalVectors u = values_at_particles(body, step->from().data() + body.first);
    for (Index A = 0; A < body.size(); ++A)
      for (int i = 0; i < D; ++i) at(places, A)[i] += at(u, A)[i];
  }
  std::vector<MatrixEntry> entries;
  for (const auto& cell : grid.cells) {
    auto corners = grid.corner_points(cell);
    if (step) {
      const Real sign =
          determinant<D>(multilinear<D, D>(corners, Vec<D>(Vec<D>::Zero())).J) > 0 ? 1 : -1;
      std::array<Vec<D>, 1 << D> now;
      for (int a = 0; a < 1 << D; ++a) at(now, a) = at(places, at(cell, a));
      if (is_sound<D>(now, sign)) corners = now;
    }
    const ElementMatrix<D> K = element_stiffness<D>(corners, moduli);
    for (int a = 0; a < 1 << D; ++a)
      for (int b = 0; b < 1 << D; ++b)
        for (int i = 0; i < D; ++i)
          for (int k = 0; k < D; ++k)
            entries.push_back({at(cell, a) * D + i, at(cell, b) * D + k, at(at(K, a), b)(i, k)});
  }
  const Real extent = box_around<D>(body.particles.X()).extent().maxCoeff();
  const Real per_volume = share_of_mass * (moduli.lame + 2 * moduli.shear) / (extent * extent);
  for (Index A = 0; A < body.size(); ++A)
    for (int i = 0; i < D; ++i)
      entries.push_back({A * D + i, A * D + i,
                         step ? at(system.mass, body.first + A) / (step->tau() * step->tau())
                              : per_volume * body.cells.volume(A)});
  return entries;
}

/// Elimination order of the rows of K, by nested dissection. In 3D the factors have two thirds of
/// the entries of minimum degree (15^3 nodes), and take half the time.
template <int D>
std::vector<Index> order_of_rows(const Grid<D>& grid) {
  std::vector<Index> order;
  order.reserve(D * grid.X.size());
  for (const Index node : nested_dissection(grid))
    for (int i = 0; i < D; ++i) order.push_back(node * D + i);
  return order;
}

/// Factors for T^-1 and its transpose, approximately. T has eigenvalues near zero, for modes in
/// which coefficients move and positions hardly do. In bulk bodies these modes are stiffer than T^t
/// K T, in shells of few layers they are not. The number added to T is just large enough for bulk
/// bodies (quasi-statics note 3).
template <int D>
SparseLU inverse_transform(const Body<D>& body) {
  constexpr Real added = 0.004;
  const auto all_rows = rows_of_all_particles(body);
  const PointRows<D>& rows = *all_rows;
  std::vector<MatrixEntry> entries;
  for (Index A = 0; A < body.size(); ++A) {
    entries.push_back({A, A, added});
    for (Offset e = at(rows.start, A); e < at(rows.start, A + 1); ++e)
      entries.push_back({A, at(rows.particle, e), at(rows.value, e)});
  }
  return {body.size(), entries};
}

/// du.A du of the strain energy of a body in its reference, for a uniform gradient of du. `rate`
/// adds the viscosity for dv = rate du.
template <int D>
Real strain_square(System<D>& system, const Body<D>& body, const Mat<D>& gradient, Real rate) {
  const NodalVectors rest(static_cast<std::size_t>(system.size()), Lanes::zero());
  NodalVectors du = rest, dv = rest, df = rest;
  for (Index A = 0; A < body.size(); ++A) {
    const Vec<D> w = gradient * at(body.particles.X(), A);
    for (int i = 0; i < D; ++i) at(du, body.first + A).set(i, w[i]);
    at(dv, body.first + A) = rate * at(du, body.first + A);
  }
  system.add_tangent({0, rest, rest, system.fields}, {0, du, dv, system.fields}, df,
                     [](const ForceTerm& term) { return term.energy_kind() == "strain"; });
  return -parallel_sum(system.size(), 0.0, [&](Index A) { return sum(at(du, A) * at(df, A)); });
}

template <int D>
Real volume_of(const Body<D>& body) {
  Real volume = 0;
  for (Index A = 0; A < body.size(); ++A) volume += body.cells.volume(A);
  return volume;
}

}  // namespace

/// Moduli of a body from the energies of uniform strains: a strain e has the energy V (lambda
/// tr(e)^2 + 2 mu e:e)/2.
template <int D>
ElasticModuli elastic_moduli(System<D>& system, const Body<D>& body, Real rate) {
  const Real volume = volume_of(body);
  ElasticModuli moduli;
  constexpr int planes = D * (D - 1) / 2;
  for (int i = 0; i < D; ++i)
    for (int j = i + 1; j < D; ++j) {
      Mat<D> shear = Mat<D>::Zero();
      shear(i, j) = shear(j, i) = 1;
      moduli.shear += strain_square(system, body, shear, rate) / (4 * volume * planes);
    }
  const Mat<D> dilation = Mat<D>::Identity();
  moduli.lame =
      (strain_square(system, body, dilation, rate) / volume - 2 * D * moduli.shear) / (D * D);
  return moduli;
}

namespace {

/// Moduli for a time step. A fluid with pressure in its reference has an elastic shear modulus
/// equal to this pressure, of either sign; negative values are left out.
template <int D>
ElasticModuli moduli_of_step(System<D>& system, const Body<D>& body, Real rate) {
  ElasticModuli moduli = elastic_moduli(system, body, rate);
  const Real elastic = elastic_moduli(system, body).shear;
  moduli.shear = moduli.shear - elastic + std::max(elastic, 0.0);
  return moduli;
}

}  // namespace

template <int D>
class ElementPreconditioner<D>::OfBody {
 public:
  explicit OfBody(const Body<D>& body)
      : first_(body.first), size_(body.size()), transform_(inverse_transform(body)) {
    if (!transform_.exists())
      throw SolveError(fmt::format(
          "body '{}': the places of its particles do not determine their coefficients", body.name));
  }

  void renew(const System<D>& system, const Body<D>& body, const ElasticModuli& moduli,
             const ImplicitEuler<D>* step) {
    factors_ = std::make_unique<SparseCholesky>(
        D * body.size(), stiffness(system, body, moduli, step), order_of_rows(body.geometry.grid));
    if (!(factors_->smallest_pivot().value > 0))
      throw SolveError(fmt::format("body '{}' has no stiffness in its reference", body.name));
  }

  void apply(const NodalVectors& r, NodalVectors& z) const {
    Eigen::VectorXd x(size_);
    std::vector<Real> b(static_cast<std::size_t>(size_ * D));
    for (int i = 0; i < D; ++i) {
      for (Index A = 0; A < size_; ++A) x[A] = at(r, first_ + A)[i];
      transform_.solve_transposed(x);
      for (Index A = 0; A < size_; ++A) at(b, A * D + i) = x[A];
    }
    factors_->solve(b);
    for (Index A = 0; A < size_; ++A) at(z, first_ + A) = Lanes::zero();
    for (int i = 0; i < D; ++i) {
      for (Index A = 0; A < size_; ++A) x[A] = at(b, A * D + i);
      transform_.solve(x);
      for (Index A = 0; A < size_; ++A) at(z, first_ + A).set(i, x[A]);
    }
  }

 private:
  Index first_, size_;
  SparseLU transform_;
  std::unique_ptr<SparseCholesky> factors_;
};

template <int D>
ElementPreconditioner<D>::ElementPreconditioner(System<D>& system, const ImplicitEuler<D>* step) {
  for (const Body<D>& body : system.bodies) bodies_.push_back(std::make_unique<OfBody>(body));
  renew(system, step);
}

template <int D>
void ElementPreconditioner<D>::renew(System<D>& system, const ImplicitEuler<D>* step) {
  moduli_.clear();
  energy_scale_ = stiffness_scale_ = 0;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    const Body<D>& body = system.bodies[b];
    moduli_.push_back(step ? moduli_of_step(system, body, 1 / step->tau())
                           : elastic_moduli(system, body));
    bodies_[b]->renew(system, body, moduli_.back(), step);
    energy_scale_ += moduli_.back().shear * volume_of(body);
    stiffness_scale_ += moduli_.back().shear * (D == 3 ? std::cbrt(volume_of(body)) : 1);
  }
}

template <int D>
ElementPreconditioner<D>::~ElementPreconditioner() = default;

template <int D>
void ElementPreconditioner<D>::apply(const NodalVectors& r, NodalVectors& z) const {
  for (const auto& body : bodies_) body->apply(r, z);
}

template ElasticModuli elastic_moduli(System<2>&, const Body<2>&, Real);
template ElasticModuli elastic_moduli(System<3>&, const Body<3>&, Real);
template class ElementPreconditioner<2>;
template class ElementPreconditioner<3>;

}  // namespace meniscus
