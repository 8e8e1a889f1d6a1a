// SPDX-License-Identifier: BSD-3-Clause
// Surface tension of the polyhedron (2D: polygon) through the positions of the boundary particles.
#include "body/surface/boundary_simplices.hpp"
#include "numbers/dense.hpp"
#include "physics/surface/surface_tension.hpp"
#include "physics/surface/tension_term.hpp"

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

/// Change of FlatPull::force if the corners x move by dx.
template <int D>
std::array<Vec<D>, D> flat_pull_change(const std::array<Vec<D>, D>& x,
                                       const std::array<Vec<D>, D>& dx) {
  std::array<Vec<D>, D> change;
  // Change of the unit vector along `a` if `a` changes by `da`.
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
class TriangleSurfaceTension final : public TensionTerm<D> {
 public:
  TriangleSurfaceTension(const Body<D>& body, Real gamma)
      : TensionTerm<D>(body, gamma), boundary_(body) {
    x_.resize(boundary_.X.size());
    pull_.resize(boundary_.X.size());
    load_.resize(boundary_.X.size());
  }

  Report add_force(const Motion& motion, Forces force) override {
    find_places(motion, x_);
    std::fill(pull_.begin(), pull_.end(), Vec<D>::Zero());
    for (const auto& simplex : boundary_.corners) {
      const FlatPull<D> pull = flat_pull<D>(corners(simplex, x_));
      for (std::size_t k = 0; k < D; ++k) at(pull_, simplex[k]) += gamma_ * pull.force[k];
    }
    scatter(pull_, force);
    return {};
  }

  void add_tangent(const Motion& motion, const Motion& change, Forces force) override {
    const std::size_t n = boundary_.X.size();
    std::vector<Vec<D>> x(n), dx(n), pull(n, Vec<D>::Zero());
    find_places(motion, x);
    for (Index B = 0; B < boundary_.rows.size(); ++B)
      at(dx, B) = boundary_.displacement(B, this->displacements(change));
    for (const auto& simplex : boundary_.corners) {
      const auto dp = flat_pull_change<D>(corners(simplex, x), corners(simplex, dx));
      for (std::size_t k = 0; k < D; ++k) at(pull, simplex[k]) += gamma_ * dp[k];
    }
    scatter(pull, force);
  }

  bool reads(StepReads& reads) override {
    boundary_.list_reads(reads, body_.first);
    return true;
  }

  std::size_t bytes() const override {
    return boundary_.bytes() + boundary_.X.size() * (2 * sizeof(Vec<D>) + sizeof(Lanes));
  }
  Offset pairs() const override { return boundary_.rows.entries(); }

 private:
  using TensionTerm<D>::body_;
  using TensionTerm<D>::gamma_;

  void find_places(const Motion& motion, std::vector<Vec<D>>& x) const {
    boundary_.find_places(this->displacements(motion), x);
  }
  void scatter(const std::vector<Vec<D>>& pull, const ForceVector& force) {
    for (Index B = 0; B < boundary_.rows.size(); ++B) set_vector<D>(load_, B, at(pull, B));
    boundary_.scatter(load_, this->own_part(force));
  }
  static std::array<Vec<D>, D> corners(const std::array<Index, D>& simplex,
                                       const std::vector<Vec<D>>& x) {
    return BoundarySimplices<D>::places_of(simplex, x);
  }
  Real area(const Motion& motion) const override {
    std::vector<Vec<D>> x(boundary_.X.size());
    find_places(motion, x);
    Real sum = 0;
    for (const auto& simplex : boundary_.corners) sum += flat_pull<D>(corners(simplex, x)).area;
    return sum;
  }

  BoundarySimplices<D> boundary_;
  // Work space of a force: positions of the boundary particles and the forces on them.
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
