// SPDX-License-Identifier: BSD-3-Clause
// The tangent of the internal force as a matrix, and its pressures, for Newton's method.
#include "body/grid/rule_gradients.hpp"
#include "physics/internal/stress_point_force.hpp"

namespace meniscus {
namespace {

/// p = P : F / (3 J).
Dual<Lanes> pressure_of(const Tensor<Dual<Lanes>>& H, const Tensor<Dual<Lanes>>& P) {
  return (1.0 / 3.0) * (trace(P) + contract(P, H)) / (1.0 + volume_change(H));
}

Dual<Real> first_lane(const Dual<Lanes>& x) {
  return {x.v[0], x.d[0]};
}

/// The derivative of (J_0/J)^own cof F at H, where J = J_0, along a change of H. It is the
/// geometric part of the tangent of a pressure: a cell has the pressure r + own p/J, and p is
/// expected, too. If only r were, p would leave -own p (dJ/J)^2, which outweighs own^2 K for wrong
/// volume changes above own (quasi-statics note 10).
Tensor<Lanes> pressure_tangent(const Tensor<Lanes>& H, const Tensor<Lanes>& dH, Real own) {
  const Tensor<Dual<Lanes>> along = dual(H, dH);
  const Dual<Lanes> J = 1.0 + volume_change(along);
  const Tensor<Dual<Lanes>> cofactor = cofactor_of_deformation(along);
  return Tensor<Lanes>::map(
      [&](int i, int j) { return cofactor(i, j).d - own * J.d / J.v * cofactor(i, j).v; });
}

/// The component of a tensor that goes with number K of the gradient of component i. Number D is
/// the stretch of circles, H_22 of component 0.
template <int D>
std::pair<int, int> entry_of(int i, int K) {
  return K < D ? std::pair(i, K) : std::pair(D, D);
}
/// True if component i has no number K.
template <int D>
bool is_none(int i, int K) {
  return K == D && i > 0;
}

/// A matrix of the stress change at the points of a group: to(i, j)(q n + K, r n + L) is the change
/// of w P_iK at the point q for a change of H_jL at the point r, with n = gradient_numbers().
template <int D>
struct GroupModuli {
  std::array<Eigen::MatrixXd, static_cast<std::size_t>(D* D)> of;
  Eigen::MatrixXd& operator()(int i, int j) { return at(of, i * D + j); }
};

/// Room of one thread.
template <int D>
struct Room {
  std::array<Eigen::MatrixXd, D> gradients;
  Eigen::MatrixXd GC;
  GroupModuli<D> moduli;
};

}  // namespace

/// The stress and its change along a change of H. The volume change and the pull that a coupled
/// cell shares with others stay.
template <int D, class Rule>
Tensor<Dual<Lanes>> StressPointForce<D, Rule>::stress_change(Index group, Real time,
                                                             const Tensor<Dual<Lanes>>& H,
                                                             const Shared& shared) const {
  if (!volumes_) return tangent(group, time, H);
  const Real own = volumes_->own(group);
  const Index k = volumes_->number(group);
  const Dual<Lanes> change = volume_change(H);
  const AveragedCell<Dual<Lanes>> cell(
      H, change, k >= 0 ? Dual<Lanes>(Lanes(at(shared.changes, k))) : cell_mean<D>(change), own);
  const Tensor<Dual<Lanes>> P = tangent(group, time, cell.seen);
  const Dual<Lanes> p = cell.mean_stress(P);
  return cell.stress(H, P, p, own,
                     k >= 0 ? Dual<Lanes>(Lanes(at(shared.pulls, k)))
                            : (1 - own) * cell_mean<D>(p) / cell.shared_J);
}

template <int D, class Rule>
std::vector<Dual<Lanes>> StressPointForce<D, Rule>::pressures(const Motion& motion,
                                                              const Motion& change) {
  const NodalVector *u = motion.u.data() + body_.first, *du = change.u.data() + body_.first;
  std::vector<Dual<Lanes>> p(static_cast<std::size_t>(rule_.groups()));
  const Gathered all{p.data(), body_.division.rows(rule_.groups())};
  if (!volumes_) {
    parallel_for(own_, [&](Index g) {
      const Tensor<Dual<Lanes>> H = gradients(g, u, du);
      at(p, g) = pressure_of(H, tangent(g, motion.time, H));
    });
    GatherTogether()({&all, 1});
    return p;
  }
  std::vector<Dual<Real>> changes, pulls;
  const auto cell_at = [&](Index g, const Tensor<Dual<Lanes>>& H) {
    const Dual<Lanes> change_of_points = volume_change(H);
    const Index k = volumes_->number(g);
    return AveragedCell<Dual<Lanes>>(
        H, change_of_points, k >= 0 ? Dual<Lanes>(at(changes, k)) : cell_mean<D>(change_of_points),
        volumes_->own(g));
  };
  const auto pull_of = [&](Index g, const AveragedCell<Dual<Lanes>>& cell,
                           const Dual<Lanes>& mean) {
    return (1 - volumes_->own(g)) * cell_mean<D>(mean) / cell.shared_J;
  };
  changes = volumes_->projected(
      [&](Index g) { return first_lane(cell_mean<D>(volume_change(gradients(g, u, du)))); });
  pulls = volumes_->projected([&](Index g) {
    const auto cell = cell_at(g, gradients(g, u, du));
    return first_lane(pull_of(g, cell, cell.mean_stress(tangent(g, motion.time, cell.seen))));
  });
  parallel_for(own_, [&](Index g) {
    const Tensor<Dual<Lanes>> H = gradients(g, u, du);
    const auto cell = cell_at(g, H);
    const Tensor<Dual<Lanes>> P = tangent(g, motion.time, cell.seen);
    const Dual<Lanes> mean = cell.mean_stress(P);
    const Index k = volumes_->number(g);
    at(p, g) =
        pressure_of(H, cell.stress(H, P, mean, volumes_->own(g),
                                   k >= 0 ? Dual<Lanes>(at(pulls, k)) : pull_of(g, cell, mean)));
  });
  GatherTogether()({&all, 1});
  return p;
}

template <int D, class Rule>
void StressPointForce<D, Rule>::add_pressure_tangent(const Motion& motion, const Motion& change,
                                                     std::span<const Lanes> off, Forces force) {
  const NodalVector *u = motion.u.data() + body_.first, *du = change.u.data() + body_.first;
  accumulate(force, [&](int, Index begin, Index end, NodalVector* f) {
    for (Index g = begin; g < end; ++g)
      rule_.scatter(g,
                    -rule_.weight(g) * at(off, g) *
                        pressure_tangent(gradients(g, u), gradients(g, du), share_of_points(g)),
                    f);
  });
}

template <int D, class Rule>
void StressPointForce<D, Rule>::subtract_pressure_force(const Motion& motion, const Motion& change,
                                                        std::span<const Lanes> off, Forces force) {
  const NodalVector *u = motion.u.data() + body_.first, *du = change.u.data() + body_.first;
  accumulate(force, [&](int, Index begin, Index end, NodalVector* f) {
    for (Index g = begin; g < end; ++g) {
      const Tensor<Lanes> H = gradients(g, u), there = H + gradients(g, du);
      const Lanes J = 1.0 + volume_change(there);
      const Lanes shrunk = 1.0 - share_of_points(g) * (volume_change(there) - volume_change(H)) / J;
      rule_.scatter(g,
                    rule_.weight(g) * at(off, g) *
                        (shrunk * cofactor_of_deformation(there) - cofactor_of_deformation(H)),
                    f);
    }
  });
}

template <int D, class Rule>
Real StressPointForce<D, Rule>::squared_gradients(const Motion& motion) {
  const NodalVector* u = motion.u.data() + body_.first;
  return body_.sum_over_rows(rule_.groups(), 0.0, [&](Index g) {
    const Tensor<Lanes> H = gradients(g, u);
    return sum(rule_.weight(g) * contract(H, H));
  });
}

template <int D, class Rule>
void StressPointForce<D, Rule>::announce(StiffnessMatrix& K) {
  if (volumes_) first_pressure_ = K.add_nodes(volumes_->unknowns());
  for (Index g = 0; g < rule_.groups(); ++g) {
    std::vector<Index> nodes = particles_of(rule_, g);
    for (Index& A : nodes) A += body_.first;
    if (volumes_)
      if (const Index k = volumes_->number(g); k >= 0)
        volumes_->for_extension(
            k, [&](Index unknown, Real) { nodes.push_back(first_pressure_ + unknown); });
    const Index element = K.announce(nodes);
    if (g == 0) first_element_ = element;
  }
}

/// The stiffness of a coupled cell, per volume, to the volume change that it shares, beyond its
/// stiffness to the volume changes of its points. At small strains, the volume changes of a field
/// and what Pi leaves of them are orthogonal, so that the energy of both is a sum: own^2 K and (1 -
/// own^2) K (locking note 2). Here K is the change of w P for an even dilation of the present
/// state.
template <int D, class Rule>
Dual<Real> StressPointForce<D, Rule>::stiffness_of_pressure(Index cell, Real time,
                                                            const Tensor<Lanes>& H,
                                                            const Shared& shared) const {
  const Lanes J = 1.0 + volume_change(H);
  const int space = body_.space();
  const Tensor<Lanes> along = Tensor<Lanes>::map([&](int i, int j) {
    return i < space && j < space ? (H(i, j) + (i == j ? 1.0 : 0.0)) / (space * J) : Lanes::zero();
  });
  const Tensor<Dual<Lanes>> dual_H = dual(H, along);
  const Real own = volumes_->own(cell), change = at(shared.changes, volumes_->number(cell));
  const auto work = [&](const AveragedCell<Dual<Lanes>>& of_cell, Real of_pull) {
    const Tensor<Dual<Lanes>> P = tangent(cell, time, of_cell.seen);
    const Dual<Lanes> p = of_cell.mean_stress(P);
    const Tensor<Dual<Lanes>> all = of_cell.stress(dual_H, P, p, own, Dual<Lanes>(0.0));
    const Dual<Lanes> pull = (1 - own) * cell_mean<D>(p) / of_cell.shared_J;
    return cell_mean<D>(contract(derivative(all), along))[0] + of_pull * pull.d[0];
  };
  const Dual<Lanes> of_points = volume_change(dual_H);
  const Real alone = work({dual_H, of_points, Dual<Lanes>(Lanes(change)), own}, 0),
             together = work({dual_H, of_points, Dual<Lanes>(Lanes(change), Lanes(1.0)), own}, 1);
  return {alone, together - alone};
}

/// Gives the unknowns of particles on the axis across it, which move nothing, a stiffness of their
/// own.
template <int D, class Rule>
void StressPointForce<D, Rule>::hold_on_axis(std::span<const Index> particles,
                                             Eigen::Map<Eigen::MatrixXd>& block) const {
  if (!body_.geometry.grid.revolved) return;
  const auto m = static_cast<Eigen::Index>(particles.size());
  const Real stiffness = block.diagonal().head(2 * m).cwiseAbs().mean();
  for (Eigen::Index a = 0; a < m; ++a)
    if (body_.on_axis(particles[static_cast<std::size_t>(a)])) block(a, a) += stiffness;
}

/// Elements are groups: K_AB = sum w grad N_A . dP/dH . grad N_B. A coupled cell shares the
/// pressure sum_k Phi_k lambda_k with others, whose unknowns lambda stay in the matrix:
///
///   [ K   V Phi           ]     V = sum w cof F : grad N,  W the volume of the cell,
///   [ .   -Phi^T W/k Phi  ]     k of stiffness_of_pressure()
///
/// Phi is exact here, while the force has a polynomial for the inverse of Phi^T W Phi.
template <int D, class Rule>
void StressPointForce<D, Rule>::add_stiffness(const Motion& motion, std::span<const Lanes> off,
                                              StiffnessMatrix& K) {
  constexpr Real least_share = 1e-3;
  const NodalVector* u = motion.u.data() + body_.first;
  const Shared shared = shared_by_cells(motion);
  if (own_.begin == own_.end) return;  // another process has all groups
  const auto points = static_cast<Index>(rule_.points_per_group());
  K.add(first_element_, rule_.groups(), [&](Index g, StiffnessMatrix::Element& element) {
    thread_local Room<D> room;
    Eigen::MatrixXd& GC = room.GC;
    const std::vector<Index> particles = particles_of(rule_, g);
    const int n = gradient_numbers(rule_, D);
    for (int i = 0; i < (n > D ? D : 1); ++i)
      shape_gradients(rule_, g, particles, i, at(room.gradients, i));
    const auto gradients_of = [&](int i) -> const Eigen::MatrixXd& {
      return at(room.gradients, n > D ? i : 0);
    };
    const Tensor<Lanes> H = gradients(g, u);
    const Lanes w = rule_.weight(g);
    const Index k = volumes_ ? volumes_->number(g) : -1;
    const bool points_meet = volumes_ && k < 0 && volumes_->own(g) < 1;
    for (Eigen::MatrixXd& C : room.moduli.of) C.setZero(points * n, points * n);
    for (int j = 0; j < D; ++j)
      for (int L = 0; L < n; ++L)
        for (Index r = 0; r < (points_meet ? points : 1); ++r) {
          if (is_none<D>(j, L)) continue;
          Tensor<Lanes> dH = Tensor<Lanes>::zero();
          const auto [row, column] = entry_of<D>(j, L);
          if (points_meet)
            dH(row, column).set(static_cast<int>(r), 1);
          else
            dH(row, column) = Lanes(1.0);
          Tensor<Lanes> dP = derivative(stress_change(g, motion.time, dual(H, dH), shared));
          if (!off.empty()) dP = dP + at(off, g) * pressure_tangent(H, dH, share_of_points(g));
          dP = w * dP;
          for (int i = 0; i < D; ++i)
            for (int M = 0; M < n; ++M) {
              if (is_none<D>(i, M)) continue;
              const auto of_M = entry_of<D>(i, M);
              for (Index q = 0; q < points; ++q)
                room.moduli(i, j)(q * n + M, (points_meet ? r : q) * n + L) =
                    dP(of_M.first, of_M.second)[static_cast<int>(q)];
            }
        }
    const auto m = static_cast<Eigen::Index>(particles.size());
    std::vector<std::pair<Index, Real>> extension;
    if (k >= 0)
      volumes_->for_extension(
          k, [&](Index unknown, Real value) { extension.emplace_back(unknown, value); });
    const auto size = m * D + static_cast<Eigen::Index>(extension.size());
    auto block = element.resize(size);
    for (int i = 0; i < D; ++i)
      for (int j = i; j < D; ++j) {
        GC.noalias() = gradients_of(i) * room.moduli(i, j);
        block.block(i * m, j * m, m, m).noalias() = GC * gradients_of(j).transpose();
      }
    hold_on_axis(particles, block);
    if (k < 0) return;
    const Tensor<Lanes> cofactor = cofactor_of_deformation(H);
    Eigen::VectorXd V = Eigen::VectorXd::Zero(m * D);
    for (int i = 0; i < D; ++i)
      for (Index q = 0; q < points; ++q)
        for (int L = 0; L < n; ++L) {
          if (is_none<D>(i, L)) continue;
          const auto [row, column] = entry_of<D>(i, L);
          V.segment(i * m, m) += w[static_cast<int>(q)] *
                                 cofactor(row, column)[static_cast<int>(q)] *
                                 gradients_of(i).col(q * n + L);
        }
    const Dual<Real> stiffness = stiffness_of_pressure(g, motion.time, H, shared);
    const Real of_pressure = std::max(stiffness.d, least_share * std::abs(stiffness.v));
    for (std::size_t a = 0; a < extension.size(); ++a) {
      const auto column = m * D + static_cast<Eigen::Index>(a);
      block.col(column).head(m * D) = extension[a].second * V;
      for (std::size_t b = 0; b < extension.size(); ++b)
        block(m * D + static_cast<Eigen::Index>(b), column) =
            -sum(w) / of_pressure * extension[a].second * extension[b].second;
    }
  });
}

#define MENISCUS_INSTANTIATE(D, RULE)                                                              \
  template Tensor<Dual<Lanes>> StressPointForce<D, RULE<D>>::stress_change(                        \
      Index, Real, const Tensor<Dual<Lanes>>&, const Shared&) const;                               \
  template void StressPointForce<D, RULE<D>>::hold_on_axis(std::span<const Index>,                 \
                                                           Eigen::Map<Eigen::MatrixXd>&) const;    \
  template Dual<Real> StressPointForce<D, RULE<D>>::stiffness_of_pressure(                         \
      Index, Real, const Tensor<Lanes>&, const Shared&) const;                                     \
  template std::vector<Dual<Lanes>> StressPointForce<D, RULE<D>>::pressures(const Motion&,         \
                                                                            const Motion&);        \
  template void StressPointForce<D, RULE<D>>::add_pressure_tangent(                                \
      const Motion&, const Motion&, std::span<const Lanes>, Forces);                               \
  template void StressPointForce<D, RULE<D>>::subtract_pressure_force(                             \
      const Motion&, const Motion&, std::span<const Lanes>, Forces);                               \
  template Real StressPointForce<D, RULE<D>>::squared_gradients(const Motion&);                    \
  template void StressPointForce<D, RULE<D>>::announce(StiffnessMatrix&);                          \
  template void StressPointForce<D, RULE<D>>::add_stiffness(const Motion&, std::span<const Lanes>, \
                                                            StiffnessMatrix&);
MENISCUS_INSTANTIATE(2, CellRule)
MENISCUS_INSTANTIATE(3, CellRule)
MENISCUS_INSTANTIATE(2, PointRule)
MENISCUS_INSTANTIATE(3, PointRule)
#undef MENISCUS_INSTANTIATE

}  // namespace meniscus
