// SPDX-License-Identifier: BSD-3-Clause
// Linear elastostatics with the force terms of the program.
#include "study/support/elastic_case.hpp"

#include "body/grid/ordering.hpp"
#include "kernel/row_sums.hpp"
#include "meniscus/body/shapes.hpp"
#include "meniscus/physics/law_registry.hpp"
#include "numbers/dense.hpp"
#include "numbers/random.hpp"
#include "study/support/force_cases.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <random>

namespace meniscus::study {
namespace {

constexpr Real small = 0x1p-200;

/// Cauchy stress of small strains and its divergence.
template <int D>
struct Stress {
  Mat<D> sigma;
  Vec<D> divergence = Vec<D>::Zero();

  Stress(const MapPoint<D>& u, Moduli m)
      : sigma(m.mu * (u.F + u.F.transpose()) + m.lambda * u.F.trace() * Mat<D>::Identity()) {
    for (int i = 0; i < D; ++i)
      for (int k = 0; k < D; ++k)
        divergence[i] += m.mu * at(u.G, i)(k, k) + (m.mu + m.lambda) * at(u.G, k)(k, i);
  }
};

/// Adds N_A force to `load`. Points are processed in portions, because the rows of all points would
/// take gigabytes.
template <int D>
class LoadSum {
 public:
  LoadSum(const Body<D>& body, NodalVectors& load) : body_(body), load_(load) {}

  /// Adds a force at X. The weight `w` is summed in the fourth lane.
  void add(const Vec<D>& X, const Vec<D>& force, Real w) {
    points_.push_back(X);
    force_.push_back(Lanes::zero());
    for (int i = 0; i < D; ++i) force_.back().set(i, force[i]);
    force_.back().set(3, w);
    if (points_.size() >= 8192) flush();
  }
  void flush() {
    const auto rows = build_point_rows<D>(body_.particles, points_, {.value = true}, body_.name);
    for (Index q = 0; q < rows.size(); ++q) scatter_value(rows, q, at(force_, q), load_.data());
    points_.clear();
    force_.clear();
  }

 private:
  const Body<D>& body_;
  NodalVectors& load_;
  std::vector<Vec<D>> points_;
  AlignedVector<Lanes> force_;
};

template <int D>
void remove_modes(const std::vector<NodalVectors>& modes, NodalVectors& u) {
  for (const NodalVectors& mode : modes) u = sum_of(std::move(u), -dot(mode, u), mode);
}

/// Rigid velocity fields and their gradients: translations, then rotations.
template <int D>
struct RigidFields {
  static constexpr int count = D * (D + 1) / 2;
  std::array<Mat<D>, count> W;  ///< gradient
  std::array<Vec<D>, count> c;  ///< value at the origin

  RigidFields() {
    int n = 0;
    for (int i = 0; i < D; ++i, ++n) {
      at(c, n) = Vec<D>::Unit(i);
      at(W, n) = Mat<D>::Zero();
    }
    for (int i = 0; i < D; ++i)
      for (int k = i + 1; k < D; ++k, ++n) {
        at(c, n) = Vec<D>::Zero();
        at(W, n) = Mat<D>::Zero();
        at(W, n)(i, k) = 1;
        at(W, n)(k, i) = -1;
      }
  }
  Vec<D> value(int n, const Vec<D>& X) const { return at(c, n) + at(W, n) * X; }
};

/// Integrals over the body for errors of displacement and gradient without the rigid part.
template <int D>
struct ErrorIntegrals {
  static constexpr int modes = RigidFields<D>::count;
  using Vector = Eigen::Matrix<Real, modes, 1>;
  using Matrix = Eigen::Matrix<Real, modes, modes>;

  RigidFields<D> rigid;
  Matrix RR = Matrix::Zero(), WW = Matrix::Zero();
  Vector Re = Vector::Zero(), We = Vector::Zero();
  Real e2 = 0, u2 = 0, grad_e2 = 0, grad_u2 = 0;

  void add(const Vec<D>& X, Real w, const MapPoint<D>& exact, const Vec<D>& u, const Mat<D>& grad) {
    const Vec<D> e = u - exact.x;
    const Mat<D> grad_e = grad - exact.F;
    e2 += w * e.squaredNorm();
    u2 += w * exact.x.squaredNorm();
    grad_e2 += w * grad_e.squaredNorm();
    grad_u2 += w * exact.F.squaredNorm();
    for (int m = 0; m < modes; ++m) {
      const Vec<D> r = rigid.value(m, X);
      const Mat<D>& W = at(rigid.W, m);
      Re[m] += w * r.dot(e);
      We[m] += w * W.cwiseProduct(grad_e).sum();
      for (int n = 0; n < modes; ++n) {
        RR(m, n) += w * r.dot(rigid.value(n, X));
        WW(m, n) += w * W.cwiseProduct(at(rigid.W, n)).sum();
      }
    }
  }
  ElasticErrors errors() const {
    const Vector c = solve_symmetric(RR, Re);
    const Real L2 = e2 - c.dot(Re), H1 = grad_e2 - 2 * c.dot(We) + c.dot(WW * c);
    return {std::sqrt(std::max(0.0, L2) / u2), std::sqrt(std::max(0.0, H1) / grad_u2)};
  }
};

/// Like jitter_interior(), but boundary nodes move along the boundary, too. Otherwise the irregular
/// part of the body would grow with refinement and hide the order.
template <int D>
void jitter(Grid<D>& grid, Real reach, std::uint64_t seed) {
  const NodeCells cells = cells_of_nodes(grid);
  std::mt19937_64 bits(seed);
  for (Index i = 0; i < grid.node_count(); ++i) {
    const Vec<D> place = at(grid.X, i);
    const auto folds = [&](const NodeCells::Entry& e) {
      return find_fold(grid, e.cell).has_value();
    };
    const auto around = cells.of(i);
    do {
      for (int k = 0; k < D; ++k) {
        const bool free = place[k] > 0.5 * reach && place[k] < 1 - 0.5 * reach;
        if (free) at(grid.X, i)[k] = place[k] + reach * symmetric_uniform(bits);
      }
    } while (std::any_of(around.begin(), around.end(), folds));
  }
}

}  // namespace

template <int D>
Geometry<D> unit_box_geometry(int n, Real jitter_share, std::uint64_t seed) {
  Brick<D> shape;
  shape.cells.assign(D, n);
  shape.corner.assign(D, 0);
  Geometry<D> geometry = shape.geometry();
  if (jitter_share > 0) jitter(geometry.grid, jitter_share / n, seed);
  order_spatially(geometry);
  return geometry;
}

template <int D>
std::unique_ptr<Body<D>> box_of(Geometry<D> geometry, ParticleSet<D> particles) {
  std::vector<Vec<D>> probes = geometry.grid.X;
  const auto centres = cell_gauss_points(geometry.grid, 1).X;
  probes.insert(probes.end(), centres.begin(), centres.end());
  particles.ensure_quality(probes, "box");
  return std::make_unique<Body<D>>("box", std::move(geometry), std::move(particles));
}

template <int D>
std::unique_ptr<Body<D>> unit_box(int n, Real jitter_share, std::uint64_t seed) {
  constexpr Real spacings = 2.6;
  Geometry<D> geometry = unit_box_geometry<D>(n, jitter_share, seed);
  ParticleSet<D> particles(geometry.grid.X, spacings / n, KernelFunction::cubic_spline);
  return box_of(std::move(geometry), std::move(particles));
}

template <int D>
ElasticCase<D> elastic_case(std::unique_ptr<Body<D>> body, SmoothMap<D> exact, Moduli moduli) {
  ElasticCase<D> c{std::move(body), std::move(exact), moduli, {}};
  c.load.assign(static_cast<std::size_t>(c.body->size()), Lanes::zero());
  LoadSum<D> sum(*c.body, c.load);
  CellQuadrature<D> q;
  for (Index L = 0; L < c.body->size(); ++L) {
    c.body->cells.quadrature(L, q);
    for (std::size_t p = 0; p < q.volume_X.size(); ++p)
      sum.add(q.volume_X[p], -q.volume_w[p] * Stress<D>(c.exact(q.volume_X[p]), moduli).divergence,
              q.volume_w[p]);
    for (std::size_t p = q.body_facets_begin; p < q.facet_X.size(); ++p)
      sum.add(q.facet_X[p], Stress<D>(c.exact(q.facet_X[p]), moduli).sigma * q.facet_dA[p], 0);
  }
  sum.flush();
  // The integration rule has fewer points than these loads. Therefore a uniform body force uses the
  // integrals of shape functions by this rule, like the masses of a body.
  const std::vector<Real> integral = build_cell_rule(*c.body).shape_integral;
  for (Index A = 0; A < c.body->size(); ++A) {
    const Vec<D> force = -Stress<D>(c.exact(at(c.body->particles.X(), A)), moduli).divergence;
    Lanes& load = at(c.load, A);
    const Real difference = at(integral, A) - load[3];
    for (int i = 0; i < D; ++i) load.set(i, load[i] + difference * force[i]);
    load.set(3, 0);
  }
  return c;
}

std::vector<Rule> elastic_rules(bool brief) {
  std::vector<Rule> rules{{"q_scni", {"q_scni", 0, "full"}}, {"gauss 2", {"gauss", 2}}};
  if (!brief) {
    rules.push_back({"gauss 3", {"gauss", 3}});
    rules.push_back({"gauss 5", {"gauss", 5}});
    rules.push_back({"nodal", {"nodal", 0}});
  }
  return rules;
}

template <int D>
LinearBody<D>::LinearBody(Body<D>& body, const Integration& integration, Moduli moduli)
    : size_(body.size()) {
  const SceneInput numbers = SceneInput::from_text(
      fmt::format("density = 1\nmu = {:.17g}\nlambda = {:.17g}", moduli.mu, moduli.lambda));
  term_ = laws()
              .at("st_venant_kirchhoff")
              .template material<D>(numbers.root())
              ->build(body, integration)
              .force;
}

template <int D>
NodalVectors LinearBody<D>::stiffness_times(const NodalVectors& u) {
  NodalVectors scaled = u;
  for (NodalVector& x : scaled) x *= small;
  NodalVectors result = force_of(*term_, scaled);
  for (NodalVector& x : result) x *= -1 / small;
  return result;
}

template <int D>
Real LinearBody<D>::energy(const NodalVectors& u) {
  return 0.5 * dot(u, stiffness_times(u));
}

template <int D>
std::vector<NodalVectors> rigid_modes(const Body<D>& body) {
  const RigidFields<D> fields;
  std::vector<NodalVectors> modes;
  for (int m = 0; m < RigidFields<D>::count; ++m) {
    NodalVectors mode(static_cast<std::size_t>(body.size()));
    for (Index A = 0; A < body.size(); ++A)
      set_vector<D>(mode, A, fields.value(m, at(body.particles.X(), A) - Vec<D>::Constant(0.5)));
    remove_modes<D>(modes, mode);
    const Real length = norm(mode);
    for (NodalVector& x : mode) x /= length;
    modes.push_back(std::move(mode));
  }
  return modes;
}

template <int D>
Solution solve(LinearBody<D>& linear, const ElasticCase<D>& c, Real tolerance) {
  const auto rigid = rigid_modes(*c.body);
  NodalVectors load = c.load;
  remove_modes<D>(rigid, load);
  const Real scale = norm(load);
  Solution s{NodalVectors(load.size(), Lanes::zero()), 0, 1};
  // Restarts from the true residual, from which the recursive one drifts away by rounding.
  constexpr int restarts = 3;
  for (int pass = 0; pass < restarts && s.residual > tolerance; ++pass) {
    NodalVectors r = sum_of(load, -1, linear.stiffness_times(s.u)), p = r;
    remove_modes<D>(rigid, r);
    Real rr = dot(r, r), least = rr;
    const int most = 200 * static_cast<int>(std::sqrt(linear.size()) + 10);
    for (int k = 0, idle = 0; k < most && idle < 500 && std::sqrt(rr) > 0.5 * tolerance * scale;
         ++k, ++idle, ++s.iterations) {
      const NodalVectors Kp = linear.stiffness_times(p);
      const Real curvature = dot(p, Kp);
      if (!(curvature > 0)) break;  // a direction without stiffness, or rounding
      s.u = sum_of(std::move(s.u), rr / curvature, p);
      r = sum_of(std::move(r), -rr / curvature, Kp);
      const Real next = dot(r, r);
      p = sum_of(r, next / rr, p);
      rr = next;
      if (rr < least) {
        least = rr;
        idle = 0;
      }
    }
    remove_modes<D>(rigid, s.u);
    s.residual = norm(sum_of(load, -1, linear.stiffness_times(s.u))) / scale;
  }
  return s;
}

template <int D>
ElasticErrors errors_of(const ElasticCase<D>& c, NodalVectors u) {
  const Body<D>& body = *c.body;
  // Removes approximately the best rigid motion first, so that nothing large has to cancel below.
  NodalVectors e = u;
  for (Index A = 0; A < body.size(); ++A)
    set_vector<D>(e, A, Vec<D>(vector_at<D>(u, A) - c.exact(at(body.particles.X(), A)).x));
  for (const NodalVectors& mode : rigid_modes(body)) u = sum_of(std::move(u), -dot(mode, e), mode);

  const auto points = cell_gauss_points(body.geometry.grid, 4);
  ErrorIntegrals<D> integrals;
  constexpr std::size_t some = 8192;
  for (std::size_t first = 0; first < points.X.size(); first += some) {
    const std::size_t count = std::min(some, points.X.size() - first);
    const auto rows = build_point_rows<D>(body.particles, {points.X.data() + first, count},
                                          {.value = true, .gradient = true}, body.name);
    for (Index q = 0; q < rows.size(); ++q) {
      const std::size_t p = first + static_cast<std::size_t>(q);
      const Lanes value = value_at(rows, q, u.data());
      const auto column = gradient_at(rows, q, u.data());
      Vec<D> u_h;
      Mat<D> grad;
      for (int i = 0; i < D; ++i) {
        u_h[i] = value[i];
        for (int K = 0; K < D; ++K) grad(i, K) = at(column, K)[i];
      }
      integrals.add(points.X[p], points.weight[p], c.exact(points.X[p]), u_h, grad);
    }
  }
  return integrals.errors();
}

#define MENISCUS_INSTANTIATE(D)                                                         \
  template Geometry<D> unit_box_geometry(int, Real, std::uint64_t);                     \
  template std::unique_ptr<Body<D>> box_of(Geometry<D>, ParticleSet<D>);                \
  template std::unique_ptr<Body<D>> unit_box(int, Real, std::uint64_t);                 \
  template ElasticCase<D> elastic_case(std::unique_ptr<Body<D>>, SmoothMap<D>, Moduli); \
  template class LinearBody<D>;                                                         \
  template std::vector<NodalVectors> rigid_modes(const Body<D>&);                       \
  template Solution solve(LinearBody<D>&, const ElasticCase<D>&, Real);                 \
  template ElasticErrors errors_of(const ElasticCase<D>&, NodalVectors);
MENISCUS_INSTANTIATE(2)
MENISCUS_INSTANTIATE(3)
#undef MENISCUS_INSTANTIATE

}  // namespace meniscus::study
