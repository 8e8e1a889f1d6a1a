// SPDX-License-Identifier: BSD-3-Clause
// Surface tension of the polyhedron (2D: polygon) through the places of the boundary particles.
#include "meniscus/approx/row_sums.hpp"
#include "meniscus/physics/surface_tension.hpp"

#include <Eigen/Geometry>

namespace meniscus {
namespace {

template <int D>
class TriangleSurfaceTension final : public ForceTerm {
 public:
  TriangleSurfaceTension(const Body<D>& body, Real gamma)
      : body_(body), gamma_(gamma), nodes_(boundary_nodes(body.geometry.grid)) {
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
  }

  std::string name() const override { return "surface tension of '" + body_.name + "'"; }
  std::string_view energy_kind() const override { return "surface"; }

  void add_force(const Motion& motion, std::span<Lanes> force) override {
    const std::vector<Vec<D>> x = places(motion);
    std::vector<Vec<D>> pull(x.size(), Vec<D>::Zero());
    for (const auto& simplex : simplices_) {
      if constexpr (D == 3) {
        const Vec<3>&a = at(x, simplex[0]), &b = at(x, simplex[1]), &c = at(x, simplex[2]);
        const Vec<3> n = (b - a).cross(c - a).normalized();
        for (std::size_t k = 0; k < 3; ++k)  // f_I = (gamma/2) (x_I+2 - x_I+1) x n
          at(pull, simplex[k]) += 0.5 * gamma_ *
              (at(x, simplex[(k + 2) % 3]) - at(x, simplex[(k + 1) % 3])).cross(n);
      } else {
        const Vec<2> t = (at(x, simplex[1]) - at(x, simplex[0])).normalized();
        at(pull, simplex[0]) += gamma_ * t;
        at(pull, simplex[1]) -= gamma_ * t;
      }
    }
    NodalVectors load(x.size());
    for (Index B = 0; B < static_cast<Index>(x.size()); ++B) set_vector<D>(load, B, at(pull, B));
    auto own = force.subspan(static_cast<std::size_t>(body_.first),
                             static_cast<std::size_t>(body_.size()));
    windows_.accumulate(own, [&](int, Index begin, Index end, Lanes* f) {
      for (Index B = begin; B < end; ++B) scatter_value(rows_, B, at(load, B), f);
    });
  }

  std::optional<Real> stored_energy(const Motion& motion) const override {
    return gamma_ * area(motion);
  }
  std::vector<MeasureSource> measures() const override {
    return {{"area", D == 3 ? dimension::area : dimension::length,
             "current area of the surface (2D: length)",
             [this](const Motion& motion) { return area(motion); }}};
  }
  std::size_t bytes() const override {
    return rows_.bytes() + windows_.bytes() + X_.size() * sizeof(Vec<D>) +
           simplices_.size() * sizeof(simplices_[0]);
  }
  Offset pairs() const override { return rows_.entries(); }

 private:
  std::vector<Vec<D>> places(const Motion& motion) const {
    const Lanes* u = motion.u.data() + body_.first;
    std::vector<Vec<D>> x = X_;
    parallel_for(rows_.size(), [&](Index B) {
      const Lanes displacement = value_at(rows_, B, u);
      for (int i = 0; i < D; ++i) at(x, B)[i] += displacement[i];
    });
    return x;
  }
  Real area(const Motion& motion) const {
    const std::vector<Vec<D>> x = places(motion);
    Real sum = 0;
    for (const auto& simplex : simplices_) {
      const Vec<D> a = at(x, simplex[1]) - at(x, simplex[0]);
      if constexpr (D == 3)
        sum += 0.5 * a.cross(at(x, simplex[2]) - at(x, simplex[0])).norm();
      else
        sum += a.norm();
    }
    return sum;
  }

  const Body<D>& body_;
  Real gamma_;
  std::vector<Index> nodes_;
  std::vector<Vec<D>> X_;
  std::vector<std::array<Index, D>> simplices_;  // numbers in nodes_
  PointRows<D> rows_;
  ForceWindows windows_;
};

}  // namespace

template <int D>
std::unique_ptr<ForceTerm> triangle_surface_tension(const Body<D>& body, Real gamma) {
  return std::make_unique<TriangleSurfaceTension<D>>(body, gamma);
}
template std::unique_ptr<ForceTerm> triangle_surface_tension(const Body<2>&, Real);
template std::unique_ptr<ForceTerm> triangle_surface_tension(const Body<3>&, Real);

}  // namespace meniscus
