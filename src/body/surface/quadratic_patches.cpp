// SPDX-License-Identifier: BSD-3-Clause
// Lagrange functions of patches, and the points that they share.
#include "body/surface/quadratic_patches.hpp"

#include "body/grid/gauss.hpp"

#include <algorithm>

namespace meniscus {
namespace {

/// Quadratic Lagrange functions of the nodes -1, 0, 1 and their derivatives.
std::array<Real, 3> lagrange(Real x) {
  return {0.5 * x * (x - 1), 1 - x * x, 0.5 * x * (x + 1)};
}
std::array<Real, 3> lagrange_slopes(Real x) {
  return {x - 0.5, -2 * x, x + 0.5};
}

}  // namespace

template <int D>
PatchFunctions<D>::PatchFunctions(const Vec<D - 1>& xi) {
  for (int a = 0; a < nodes; ++a) {
    at(L, a) = 1;
    for (auto& slope : dL) at(slope, a) = 1;
    for (int k = 0, rest = a; k < D - 1; ++k, rest /= 3) {
      const Real value = at(lagrange(xi[k]), rest % 3),
                 slope = at(lagrange_slopes(xi[k]), rest % 3);
      at(L, a) *= value;
      for (int l = 0; l < D - 1; ++l) at(at(dL, l), a) *= l == k ? slope : value;
    }
  }
}

template <int D>
std::vector<PatchFunctions<D>> patch_functions(int points) {
  const TensorRule<D - 1> rule = tensor_rule<D - 1>(points);
  std::vector<PatchFunctions<D>> all;
  for (std::size_t q = 0; q < rule.x.size(); ++q) {
    all.emplace_back(rule.x[q]);
    all.back().weight = rule.w[q];
  }
  return all;
}

template <int D>
Vec<D - 1> patch_node(int a) {
  Vec<D - 1> xi;
  for (int k = 0, rest = a; k < D - 1; ++k, rest /= 3) xi[k] = rest % 3 - 1;
  return xi;
}

template <int D>
typename PatchNodes<D>::Key patch_key(const Facet<D>& facet, const Vec<D - 1>& xi) {
  std::vector<Index> found;
  for (int corner = 0; corner < (1 << (D - 1)); ++corner) {
    bool supports = true;
    for (int k = 0; k < D - 1; ++k) supports = supports && xi[k] * corner_sign(corner, k) >= 0;
    if (supports) found.push_back(at(facet.nodes, corner));
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());  // a triangle repeats a node
  return found;
}

template <int D>
PatchNodes<D>::PatchNodes(const Grid<D>& grid) {
  for (const Facet<D>& boundary : grid.facets) {
    std::array<Index, nodes>& numbered = facet.emplace_back();
    for (int a = 0; a < nodes; ++a)
      at(numbered, a) =
          number.try_emplace(patch_key<D>(boundary, patch_node<D>(a)), count()).first->second;
  }
}

#define MENISCUS_INSTANTIATE(D)                                              \
  template struct PatchFunctions<D>;                                         \
  template std::vector<PatchFunctions<D>> patch_functions<D>(int);           \
  template Vec<D - 1> patch_node<D>(int);                                    \
  template PatchNodes<D>::Key patch_key(const Facet<D>&, const Vec<D - 1>&); \
  template struct PatchNodes<D>;
MENISCUS_INSTANTIATE(2)
MENISCUS_INSTANTIATE(3)
#undef MENISCUS_INSTANTIATE

}  // namespace meniscus
