// SPDX-License-Identifier: BSD-3-Clause
// Surface tension of the polyhedron (2D: polygon) through the places of the boundary particles.
#include "meniscus/approx/row_sums.hpp"
#include "meniscus/core/dense.hpp"
#include "meniscus/physics/surface_tension.hpp"
#include "meniscus/physics/tension_form.hpp"

namespace meniscus {

template <int D>
FlatPull<D> flat_pull(const std::array<Vec<D>, D>& x) {
  FlatPull<D> pull;
  if constexpr (D == 3) {
    const Vec<3> normal = cross(x[1] - x[0], x[2] - x[0]), n = normal.normalized();
    pull.area = 0.5 * normal.norm();
    for (std::size_t k = 0; k < 3; ++k)
      pull.force[k] = 0.5 * cross(x[(k + 2) % 3] - x[(k + 1) % 3], n);
  } else {
    const Vec<2> edge = x[1] - x[0], t = edge.normalized();
    pull.area = edge.norm();
    pull.force = {t, -t};
  }
  return pull;
}
template FlatPull<2> flat_pull<2>(const std::array<Vec<2>, 2>&);
template FlatPull<3> flat_pull<3>(const std::array<Vec<3>, 3>&);

namespace {

/// Change of FlatPull::force when the corners x move by dx.
template <int D>
std::array<Vec<D>, D> flat_pull_change(const std::array<Vec<D>, D>& x,
                                       const std::array<Vec<D>, D>& dx) {
  std::array<Vec<D>, D> change;
  // Of the unit vector along `a` when that changes by `da`.
  const auto turn = [](const Vec<D>& a, const Vec<D>& da) -> Vec<D> {
    const Vec<D> n = a.normalized();
    return (da - n * n.dot(da)) / a.norm();
  };
  if constexpr (D == 3) {
    const Vec<3> a = x[1] - x[0], b = x[2] - x[0], da = dx[1] - dx[0], db = dx[2] - dx[0];
    const Vec<3> normal = cross(a, b), n = normal.normalized();
    const Vec<3> dn = turn(normal, cross(da, b) + cross(a, db));
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t p = (k + 1) % 3, q = (k + 2) % 3;
      change[k] = 0.5 * (cross(dx[q] - dx[p], n) + cross(x[q] - x[p], dn));
    }
  } else {
    const Vec<2> dt = turn(x[1] - x[0], dx[1] - dx[0]);
    change = {dt, -dt};
  }
  return change;
}

template <int D>
class TriangleSurfaceTension final : public TensionForm<D> {
 public:
  TriangleSurfaceTension(const Body<D>& body, Real gamma)
      : TensionForm<D>(body, gamma), nodes_(boundary_nodes(body.geometry.grid)) {
    std::vector<Index> number(static_cast<std::size_t>(body.size()), -1);
    for (const Index A : nodes_) {
      at(number, A) = static_cast<Index>(X_.size());
      X_.push_back(at(body.particles.X(), A));
    }
    simplices_ = triangulate_boundary(body.geometry.grid);
    for (auto& simplex : simplices_)
      for (Index& A : simplex) A = at(number, A);
    rows_ = build_point_rows<D>(body.particles, X_, {.value = true}, body.name);
    windows_ = {rows_.start, rows_.particle, body.size()};
    pull_.resize(X_.size());
    load_.resize(X_.size());
  }

  Report add_force(const Motion& motion, Forces force) override {
    find_places(motion, x_);
    std::fill(pull_.begin(), pull_.end(), Vec<D>::Zero());
    for (const auto& simplex : simplices_) {
      const FlatPull<D> pull = flat_pull<D>(corners(simplex, x_));
      for (std::size_t k = 0; k < D; ++k) at(pull_, simplex[k]) += gamma_ * pull.force[k];
    }
    scatter(pull_, force);
    return {};
  }

  void add_tangent(const Motion& motion, const Motion& change, Forces force) override {
    std::vector<Vec<D>> x, dx(X_.size()), pull(X_.size(), Vec<D>::Zero());
    find_places(motion, x);
    for (Index B = 0; B < rows_.size(); ++B)
      at(dx, B) = displacement(B, this->displacements(change));
    for (const auto& simplex : simplices_) {
      const auto dp = flat_pull_change<D>(corners(simplex, x), corners(simplex, dx));
      for (std::size_t k = 0; k < D; ++k) at(pull, simplex[k]) += gamma_ * dp[k];
    }
    scatter(pull, force);
  }

  std::size_t bytes() const override {
    return rows_.bytes() + windows_.bytes() + X_.size() * (3 * sizeof(Vec<D>) + sizeof(Lanes)) +
           simplices_.size() * sizeof(simplices_[0]);
  }
  Offset pairs() const override { return rows_.entries(); }

 private:
  using TensionForm<D>::body_;
  using TensionForm<D>::gamma_;

  /// x = places x(X_B) of the boundary particles.
  void find_places(const Motion& motion, std::vector<Vec<D>>& x) const {
    const NodalVector* u = this->displacements(motion);
    x.resize(X_.size());
    parallel_for(rows_.size(), [&](Index B) { at(x, B) = at(X_, B) + displacement(B, u); });
  }
  Vec<D> displacement(Index B, const NodalVector* u) const {
    const Lanes sum = value_at(rows_, B, u);
    Vec<D> x;
    for (int i = 0; i < D; ++i) x[i] = sum[i];
    return x;
  }
  /// force_A += sum_B N_A(X_B) pull_B
  void scatter(const std::vector<Vec<D>>& pull, std::span<NodalVector> force) {
    for (Index B = 0; B < rows_.size(); ++B) set_vector<D>(load_, B, at(pull, B));
    windows_.accumulate(this->own_part(force), [&](int, Index begin, Index end, NodalVector* f) {
      for (Index B = begin; B < end; ++B) scatter_value(rows_, B, at(load_, B), f);
    });
  }
  static std::array<Vec<D>, D> corners(const std::array<Index, D>& simplex,
                                       const std::vector<Vec<D>>& x) {
    std::array<Vec<D>, D> places;
    for (std::size_t k = 0; k < D; ++k) places[k] = at(x, simplex[k]);
    return places;
  }
  Real area(const Motion& motion) const override {
    std::vector<Vec<D>> x;
    find_places(motion, x);
    Real sum = 0;
    for (const auto& simplex : simplices_) sum += flat_pull<D>(corners(simplex, x)).area;
    return sum;
  }

  std::vector<Index> nodes_;
  std::vector<Vec<D>> X_;
  std::vector<std::array<Index, D>> simplices_;  // numbers in nodes_
  PointRows<D> rows_;
  ForceWindows windows_;
  // Work space of a force: places of the boundary particles and the pull on them.
  std::vector<Vec<D>> x_, pull_;
  NodalVectors load_;
};

}  // namespace

template <int D>
std::unique_ptr<ForceTerm> triangle_surface_tension(const Body<D>& body, Real gamma) {
  return std::make_unique<TriangleSurfaceTension<D>>(body, gamma);
}
template std::unique_ptr<ForceTerm> triangle_surface_tension(const Body<2>&, Real);
template std::unique_ptr<ForceTerm> triangle_surface_tension(const Body<3>&, Real);

}  // namespace meniscus
