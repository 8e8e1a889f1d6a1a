// SPDX-License-Identifier: BSD-3-Clause
// The methods that the curvature study compares, grouped by the panels of its plots.
#pragma once
#include "study/support/curvature_methods.hpp"

#include <fmt/core.h>

namespace meniscus::study {

/// The rank of the neighbour whose distance scales the support: 20 (2D: 8) for the quadratic basis.
template <int D>
constexpr int rank_of_degree(int degree) {
  constexpr std::array<int, 4> space{0, 6, 20, 26}, plane{0, 4, 8, 12};
  return at(D == 3 ? space : plane, degree);
}

/// "1.8 d_20"
inline std::string support_text(Real factor, int rank) {
  const std::string two = fmt::format("{:.2f}", factor);
  return fmt::format("{} d_{}", two.back() == '0' ? two.substr(0, 3) : two, rank);
}

template <int D>
CurvatureMethod<D> curvature_method(int degree, Real factor, KernelFunction kernel_function,
                                    Places places) {
  constexpr std::array<std::string_view, 4> bases{"", "linear", "quadratic", "cubic"};
  CurvatureMethod<D> m;
  m.degree = degree;
  m.support = {factor, rank_of_degree<D>(degree)};
  m.kernel_function = kernel_function;
  m.places = places;
  m.line = fmt::format("{} {}, {}, {}", at(bases, degree), support_text(factor, m.support.rank),
                       at(kernel_function_names, static_cast<int>(kernel_function)),
                       places == Places::points ? "points" : "nodes");
  return m;
}

/// The main methods, for further maps and for the short form.
template <int D>
std::vector<CurvatureMethod<D>> main_methods(bool brief);

/// All methods: every support with every kernel at points and nodes, the bases, stages, and means
/// to raise the order.
template <int D>
std::vector<CurvatureMethod<D>> all_methods();

}  // namespace meniscus::study
