// SPDX-License-Identifier: BSD-3-Clause
// The methods of the curvature study.
#include "study/support/curvature_list.hpp"

namespace meniscus::study {
namespace {

template <int D>
class List {
 public:
  explicit List(std::string panel) : panel_(std::move(panel)) {}

  CurvatureMethod<D>& add(int degree, Real factor, KernelFunction kernel_function, Places places) {
    methods.push_back(curvature_method<D>(degree, factor, kernel_function, places));
    methods.back().panel = panel_;
    return methods.back();
  }
  void add_recovered(int degree, Real factor, KernelFunction kernel_function, Places places) {
    CurvatureMethod<D>& m = add(degree, factor, kernel_function, places);
    m.second = SecondDerivatives::recovered;
    m.line += ", recovered";
  }
  void add_smoothed(Real factor, KernelFunction kernel_function, Places places) {
    CurvatureMethod<D>& m = add(2, factor, kernel_function, places);
    m.smoothed = true;
    m.line += ", smoothed";
  }

  std::vector<CurvatureMethod<D>> methods;

 private:
  std::string panel_;
};

constexpr auto cubic = KernelFunction::cubic_spline, quintic = KernelFunction::quintic_spline;
constexpr auto at_points = Places::points, at_nodes = Places::nodes;

}  // namespace

template <int D>
std::vector<CurvatureMethod<D>> main_methods(bool brief) {
  List<D> list("methods");
  list.add(2, 1.8, cubic, at_points);
  list.add_recovered(2, 1.8, cubic, at_points);
  list.add(3, 2.0, cubic, at_points);
  if (brief) return list.methods;
  list.add(2, 1.5, cubic, at_points);
  list.add(2, 2.0, cubic, at_points);
  list.add(2, 2.0, quintic, at_nodes);
  list.add_recovered(2, 2.3, quintic, at_points);
  list.add(3, 1.75, cubic, at_points);
  list.add_recovered(3, 2.0, cubic, at_points);
  return list.methods;
}

template <int D>
std::vector<CurvatureMethod<D>> all_methods() {
  std::vector<CurvatureMethod<D>> all;
  const auto append = [&](const List<D>& list) {
    all.insert(all.end(), list.methods.begin(), list.methods.end());
  };
  for (const Places places : {at_points, at_nodes})
    for (const KernelFunction kernel_function :
         {cubic, quintic, KernelFunction::wendland_c2, KernelFunction::wendland_c4,
          KernelFunction::triweight}) {
      List<D> list(fmt::format("{}, {}",
                               at(kernel_function_names, static_cast<int>(kernel_function)),
                               places == at_points ? "points" : "nodes"));
      for (const Real factor : {1.5, 1.8, 2.0, 2.3}) list.add(2, factor, kernel_function, places);
      append(list);
    }

  List<D> bases("bases");
  bases.add(1, 1.6, cubic, at_points);
  bases.add(3, 1.75, cubic, at_points);
  bases.add(3, 2.0, cubic, at_points);
  bases.add(3, 2.0, cubic, at_nodes);
  append(bases);

  List<D> recovered("recovered");
  for (const Real factor : {1.5, 1.8, 2.0, 2.3})
    recovered.add_recovered(2, factor, cubic, at_points);
  recovered.add_recovered(2, 2.3, quintic, at_points);
  recovered.add_recovered(2, 1.8, cubic, at_nodes);
  recovered.add_recovered(3, 1.75, cubic, at_points);
  recovered.add_recovered(3, 2.0, cubic, at_points);
  append(recovered);

  List<D> smoothed("smoothed");
  smoothed.add_smoothed(1.8, cubic, at_points);
  smoothed.add_smoothed(2.3, quintic, at_points);
  smoothed.add_smoothed(2.3, quintic, at_nodes);
  append(smoothed);

  List<D> stages("re-referenced");
  for (const int k : {2, 4, 8}) {
    CurvatureMethod<D>& m = stages.add(2, 1.8, cubic, at_points);
    m.stages = k;
    m.line += fmt::format(", {} stages", k);
  }
  append(stages);
  return all;
}

template std::vector<CurvatureMethod<2>> main_methods(bool);
template std::vector<CurvatureMethod<3>> main_methods(bool);
template std::vector<CurvatureMethod<2>> all_methods();
template std::vector<CurvatureMethod<3>> all_methods();

}  // namespace meniscus::study
