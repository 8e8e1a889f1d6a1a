// SPDX-License-Identifier: BSD-3-Clause
// A preconditioner of finite elements in which held faces are fixed.
#include "solve/linear/held_preconditioner.hpp"

#include "parallel/parallel.hpp"

namespace meniscus {

template <int D>
HeldPreconditioner<D>::HeldPreconditioner(System<D>& system, const ImplicitEuler<D>* step)
    : elements_(system, step), constraints_(system.constraints.get()), particles_(system.size()) {
  find_responses();
}

template <int D>
void HeldPreconditioner<D>::renew(System<D>& system, const ImplicitEuler<D>* step) {
  elements_.renew(system, step);
  find_responses();
}

template <int D>
void HeldPreconditioner<D>::find_responses() {
  if (!constraints_) return;
  const Index rows = constraints_->rows(), particles = particles_;
  Y_.resize(static_cast<std::size_t>(rows) * static_cast<std::size_t>(particles));
  Eigen::MatrixXd CY(rows, rows);
  NodalVectors column(static_cast<std::size_t>(particles)), y = column;
  std::vector<Real> unit(static_cast<std::size_t>(rows)), Cy = unit;
  for (Index r = 0; r < rows; ++r) {
    std::fill(column.begin(), column.end(), Lanes::zero());
    std::fill(unit.begin(), unit.end(), 0.0);
    at(unit, r) = 1;
    constraints_->add_transposed(unit, 1, column);
    elements_.apply(column, y);
    constraints_->apply(y, Cy);
    for (Index s = 0; s < rows; ++s) CY(s, r) = at(Cy, s);
    for (Index A = 0; A < particles; ++A) at(Y_, static_cast<Offset>(A) * rows + r) = at(y, A);
  }
  factors_.compute(0.5 * (CY + CY.transpose()));
}

template <int D>
void HeldPreconditioner<D>::add_response(std::vector<Real>& b, NodalVectors& u) const {
  Eigen::Map<Eigen::VectorXd> lambda(b.data(), constraints_->rows());
  lambda = factors_.solve(lambda).eval();
  const Index rows = constraints_->rows();
  sweep(static_cast<Index>(u.size()), [&](Index begin, Index end) {
    for (Index A = begin; A < end; ++A)
      for (Index r = 0; r < rows; ++r)
        at(u, A) += at(b, r) * at(Y_, static_cast<Offset>(A) * rows + r);
  });
}

template <int D>
Real HeldPreconditioner<D>::apply(const NodalVectors& r, NodalVectors& z) const {
  elements_.apply(r, z);
  if (constraints_) {
    std::vector<Real> b(static_cast<std::size_t>(constraints_->rows()));
    for (int pass = 0; pass < 2; ++pass) {  // the second pass removes round-off
      constraints_->apply(z, b);
      for (Real& x : b) x = -x;
      add_response(b, z);
    }
  }
  return parallel_sum(static_cast<Index>(r.size()), 0.0,
                      [&](Index A) { return sum(at(r, A) * at(z, A)); });
}

template <int D>
void HeldPreconditioner<D>::meet(Real time, NodalVectors& u) const {
  if (!constraints_) return;
  std::vector<Real> g(static_cast<std::size_t>(constraints_->rows())), Cu = g;
  for (int pass = 0; pass < 2; ++pass) {
    constraints_->targets(time, g);
    constraints_->apply(u, Cu);
    for (std::size_t r = 0; r < g.size(); ++r) g[r] -= Cu[r];
    add_response(g, u);
  }
}

template class HeldPreconditioner<2>;
template class HeldPreconditioner<3>;

}  // namespace meniscus
