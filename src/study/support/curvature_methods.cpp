// SPDX-License-Identifier: BSD-3-Clause
// Evaluation of curvature by the methods of the study, and its errors.
#include "study/support/curvature_methods.hpp"

#include "kernel/row_sums.hpp"
#include "numbers/surface_geometry.hpp"
#include "parallel/parallel.hpp"
#include "study/support/surface_fit.hpp"

#include <fmt/core.h>

#include <cmath>

namespace meniscus::study {
namespace {

/// Boundary nodes as surface points, each with its share of the area of the facets.
template <int D>
SurfacePoints<D> node_points(const Geometry<D>& geometry, const SurfacePoints<D>& points) {
  std::vector<Real> share(static_cast<std::size_t>(geometry.grid.node_count()), 0.0);
  for (Index q = 0; q < points.size(); ++q)
    for (const Index A : at(geometry.grid.facets, at(points.facet, q)).nodes)
      at(share, A) += at(points.area, q) / (1 << (D - 1));
  const MappedPatches<D>& unit = mapped_patches(*geometry.surface);
  SurfacePoints<D> nodes;
  nodes.exact = true;
  for (const Index A : boundary_nodes(geometry.grid)) {
    const auto foot = unit.patches()[0].project(at(unit.unit_X(), A));
    nodes.X.push_back(foot.X);
    nodes.N.push_back(foot.N);
    nodes.grad_N.push_back(foot.grad_N);
    nodes.area.push_back(at(share, A));
  }
  return nodes;
}

template <int D>
PointRows<D> rows_of_degree(int degree, const ParticleSet<D>& particles,
                            std::span<const Vec<D>> places, RowContent content) {
  switch (degree) {
    case 1:
      return build_point_rows<D, 1>(particles, places, content, "body");
    case 3:
      return build_point_rows<D, 3>(particles, places, content, "body");
    default:
      return build_point_rows<D, 2>(particles, places, content, "body");
  }
}

template <int D>
NodalVectors coefficients(const SmoothMap<D>& map, const std::vector<Vec<D>>& X) {
  NodalVectors d(X.size());
  for (std::size_t A = 0; A < X.size(); ++A) set_vector<D>(d, static_cast<Index>(A), map(X[A]).x);
  return d;
}

template <int D>
Mat<D> gradient_matrix(const PointRows<D>& rows, Index q, const NodalVector* field) {
  const auto column = gradient_at(rows, q, field);
  Mat<D> F;
  for (int i = 0; i < D; ++i)
    for (int K = 0; K < D; ++K) F(i, K) = at(column, K)[i];
  return F;
}

/// n_i x_i,KL from the second derivatives of shape functions.
template <int D>
Mat<D> direct_along(const PointRows<D>& rows, Index q, const Lanes* d, const Vec<D>& n) {
  const auto packed = hessian_along<D>(rows, q, d, n);
  Mat<D> nG;
  for (int K = 0; K < D; ++K)
    for (int L = 0; L < D; ++L) nG(K, L) = at(packed, hessian_index(D, K, L));
  return nG;
}

/// F at the particles: field[K][A] is column K of F at particle A.
template <int D>
struct NodalGradients {
  std::array<NodalVectors, D> column;

  void fill(const PointRows<D>& rows, std::span<const Index> particles, const Lanes* d) {
    parallel_for(rows.size(), [&](Index q) {
      const auto columns = gradient_at(rows, q, d);
      for (int K = 0; K < D; ++K) at(at(column, K), at(particles, q)) = at(columns, K);
    });
  }
  Mat<D> along(const PointRows<D>& rows, Index q, const Vec<D>& n) const {
    Mat<D> nG;
    for (int K = 0; K < D; ++K)
      nG.row(K) = n.transpose() * gradient_matrix(rows, q, at(column, K).data());
    return 0.5 * (nG + nG.transpose());
  }
};

/// The result of a method at its places.
template <int D>
struct Found {
  std::vector<Real> curvature;
  std::vector<Vec<D>> normal;
  std::vector<Mat<D>> F;  ///< F from the first reference, over all stages
};

template <int D>
Vec<D> in_space(const std::array<Real, 3>& x) {
  Vec<D> y;
  for (int i = 0; i < D; ++i) y[i] = at(x, i);
  return y;
}

/// One stage: the rows of a reference cloud, and the curvature of a deformed state.
template <int D>
class Stage {
 public:
  Stage(const CurvatureMethod<D>& method, ParticleSet<D> particles, const SurfacePoints<D>& surface)
      : particles_(std::move(particles)), surface_(surface) {
    const auto X = particles_.X();
    const bool direct = method.second == SecondDerivatives::direct;
    rows_ = rows_of_degree<D>(method.degree, particles_, surface.X,
                              {.value = true, .gradient = true, .hessian = direct});
    if (direct) return;
    std::vector<bool> reached(X.size(), false);
    for (const Index A : rows_.particle) at(reached, A) = true;
    std::vector<Vec<D>> places;
    for (std::size_t A = 0; A < X.size(); ++A)
      if (reached[A]) {
        near_.push_back(static_cast<Index>(A));
        places.push_back(X[A]);
      }
    near_rows_ = rows_of_degree<D>(method.degree, particles_, places, {.gradient = true});
    for (NodalVectors& column : gradients_.column) column.assign(X.size(), Lanes::zero());
  }

  /// 2 kappa, computed as in a force term.
  void evaluate(const NodalVectors& d, std::vector<Real>& curvature) {
    if (!near_.empty()) gradients_.fill(near_rows_, near_, d.data());
    curvature.resize(surface_.X.size());
    parallel_for(surface_.size(), [&](Index q) {
      const auto frame = frame_at(gradient_matrix(rows_, q, d.data()), q);
      at(curvature, q) = twice_mean_curvature(frame, embed<D>(bending(q, d, frame), 0), grad_N(q));
    });
  }

  /// F of this stage, and the deformed surface, which is the reference of the next stage.
  SurfacePoints<D> deformed_surface(const NodalVectors& d, std::vector<Mat<D>>& F) const {
    SurfacePoints<D> next = surface_;
    F.resize(surface_.X.size());
    parallel_for(surface_.size(), [&](Index q) {
      at(F, q) = gradient_matrix(rows_, q, d.data());
      const auto frame = frame_at(at(F, q), q);
      const Tensor<Real> B = normal_gradient(frame, embed<D>(bending(q, d, frame), 0), grad_N(q));
      const Lanes x = value_at(rows_, q, d.data());
      for (int i = 0; i < D; ++i) {
        at(next.X, q)[i] = x[i];
        for (int j = 0; j < D; ++j) at(next.grad_N, q)(i, j) = B(i, j);
      }
      at(next.N, q) = in_space<D>(frame.n);
      at(next.area, q) *= frame.area_ratio;
    });
    return next;
  }

  const PointRows<D>& rows() const { return rows_; }
  bool direct() const { return near_.empty(); }
  std::size_t bytes() const {
    std::size_t bytes = rows_.bytes() + near_rows_.bytes();
    for (const NodalVectors& column : gradients_.column) bytes += column.size() * sizeof(Lanes);
    return bytes;
  }

 private:
  SurfaceFrame<Real> frame_at(const Mat<D>& F, Index q) const {
    return surface_frame(embed<D>(F, 1), embed<D>(at(surface_.N, q)));
  }
  Tensor<Real> grad_N(Index q) const { return embed<D>(at(surface_.grad_N, q), 0); }
  Mat<D> bending(Index q, const NodalVectors& d, const SurfaceFrame<Real>& frame) const {
    const Vec<D> n = in_space<D>(frame.n);
    return direct() ? direct_along<D>(rows_, q, d.data(), n) : gradients_.along(rows_, q, n);
  }

  ParticleSet<D> particles_;
  SurfacePoints<D> surface_;
  PointRows<D> rows_, near_rows_;
  std::vector<Index> near_;
  NodalGradients<D> gradients_;
};

/// The shortest time of an evaluation that is repeated for about 20 ms.
template <class F>
double shortest_time(F&& evaluate) {
  const Stopwatch all;
  double shortest = unbounded;
  do {
    const Stopwatch one;
    evaluate();
    shortest = std::min(shortest, one.seconds());
  } while (all.seconds() < 0.02);
  return shortest;
}

template <int D>
Real gradient_error(const Stage<D>& stage, const NodalVectors& d,
                    const std::vector<MapPoint<D>>& exact, const std::vector<Real>& da) {
  Real error = 0, size = 0;
  for (Index q = 0; q < stage.rows().size(); ++q)
    for (int i = 0; i < D; ++i) {
      const Mat<D> G = direct_along<D>(stage.rows(), q, d.data(), Vec<D>::Unit(i));
      error += at(da, q) * (G - at(at(exact, q).G, i)).squaredNorm();
      size += at(da, q) * at(at(exact, q).G, i).squaredNorm();
    }
  return std::sqrt(error / size);
}

template <int D>
Measurement::Numbers errors_of(const Found<D>& found, const SurfacePoints<D>& exact,
                               const std::vector<MapPoint<D>>& map) {
  Real mean = 0, mean_size = 0, rms = 0, rms_size = 0, square = 0, size = 0, largest = 0,
       normal = 0, F = 0, F_size = 0, area = 0;
  for (Index q = 0; q < exact.size(); ++q) {
    const Real k = -at(exact.grad_N, q).trace(), e = std::abs(at(found.curvature, q) - k);
    const Real da = at(exact.area, q);
    mean += e, mean_size += std::abs(k);
    rms += e * e, rms_size += k * k;
    square += da * e * e, size += da * k * k;
    largest = std::max(largest, e);
    normal += da * (at(found.normal, q) - at(exact.N, q)).squaredNorm();
    F += da * (at(found.F, q) - at(map, q).F).squaredNorm();
    F_size += da * at(map, q).F.squaredNorm();
    area += da;
  }
  return {{"L2", std::sqrt(square / size)},     {"max", largest / std::sqrt(size / area)},
          {"mean", mean / mean_size},           {"rms", std::sqrt(rms / rms_size)},
          {"normal", std::sqrt(normal / area)}, {"F", std::sqrt(F / F_size)}};
}

/// The particles of a method at the nodes X of the grid.
template <int D>
ParticleSet<D> particles_of(const CurvatureMethod<D>& method, const std::vector<Vec<D>>& X,
                            const Grid<D>& grid) {
  if (!method.by_cells) return {X, method.support, method.kernel_function};
  return {X, supports_by_cells<D>(grid, Mat<D>::Identity(), method.support.factor),
          method.kernel_function};
}

}  // namespace

template <int D>
CurvatureProblem<D>::CurvatureProblem(const Geometry<D>& unit, NamedMap<D> map)
    : map_(std::move(map)), grid_(unit.grid), points_(surface_points(unit, 2)) {
  nodes_ = node_points(unit, points_);
  require_no_fold<D>(map_, grid_.X);
  require_no_fold<D>(map_, points_.X);
  h_ = std::pow(volume(unit.grid) / unit.grid.node_count(), 1.0 / D);
}

template <int D>
Measurement CurvatureProblem<D>::measure(const CurvatureMethod<D>& method) const {
  SurfacePoints<D> surface = method.places == Places::points ? points_ : nodes_, exact = surface;
  std::vector<MapPoint<D>> map;
  const SmoothMap<D> whole = map_.path(method.stages, method.stages);
  for (const Vec<D>& X : surface.X) map.push_back(whole(X));
  deform(exact, whole);

  Measurement result{.method = fmt::format("{}, {}: {}", map_.name, method.panel, method.line),
                     .particles = grid_.node_count(),
                     .h = h_};
  std::vector<Vec<D>> cloud = grid_.X;
  Found<D> found;
  found.F.assign(map.size(), Mat<D>::Identity());
  std::optional<Real> G;
  for (int k = 1; k <= method.stages; ++k) {
    const NodalVectors d = coefficients<D>(map_.path(k, method.stages), grid_.X);
    const Stopwatch set_up;
    Stage<D> stage(method, particles_of(method, cloud, grid_), surface);
    std::optional<SurfaceFit<D>> fit;
    if (method.smoothed) fit.emplace(surface.X);
    result.set_up += set_up.seconds();
    result.time += shortest_time([&] {
      stage.evaluate(d, found.curvature);
      if (fit) fit->apply(found.curvature);
    });
    result.bytes = std::max(result.bytes, stage.bytes() + (fit ? fit->bytes() : 0));
    std::vector<Mat<D>> F;
    surface = stage.deformed_surface(d, F);
    for (std::size_t q = 0; q < F.size(); ++q) found.F[q] = F[q] * found.F[q];
    for (std::size_t A = 0; A < cloud.size(); ++A)
      cloud[A] = vector_at<D>(d, static_cast<Index>(A));
    if (method.stages == 1 && stage.direct()) G = gradient_error(stage, d, map, exact.area);
  }
  found.normal = surface.N;
  result.errors = errors_of(found, exact, map);
  if (G) result.errors.emplace_back("G", *G);
  return result;
}

template class CurvatureProblem<2>;
template class CurvatureProblem<3>;

}  // namespace meniscus::study
