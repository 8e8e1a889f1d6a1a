// SPDX-License-Identifier: BSD-3-Clause
// Numbers taken from the history of a run, compared with what the scene expects.
#include "meniscus/scene/expectations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meniscus {
namespace {

/// Linear interpolation; `t` lies within the times.
Real value_at_time(const std::vector<Real>& time, const std::vector<Real>& y, Real t) {
  const auto next = std::lower_bound(time.begin(), time.end(), t);
  if (next == time.begin()) return y.front();
  if (next == time.end()) return y.back();
  const auto k = static_cast<std::size_t>(next - time.begin());
  const Real s = (t - time[k - 1]) / (time[k] - time[k - 1]);
  return (1 - s) * y[k - 1] + s * y[k];
}

/// Minus the least-squares slope of ln |y| over t.
Real decay_rate(std::span<const Real> t, std::span<const Real> y) {
  Real n = 0, st = 0, sy = 0, stt = 0, sty = 0;
  for (std::size_t k = 0; k < t.size(); ++k) {
    const Real ly = std::log(std::abs(y[k]));
    n += 1;
    st += t[k] - t[0];
    sy += ly;
    stt += (t[k] - t[0]) * (t[k] - t[0]);
    sty += (t[k] - t[0]) * ly;
  }
  return -(n * sty - st * sy) / (n * stt - st * st);
}

Real reduce(const std::string& how, std::span<const Real> t, std::span<const Real> y) {
  if (how == "decay_rate") return decay_rate(t, y);
  if (how == "max") return *std::max_element(y.begin(), y.end());
  if (how == "min") return *std::min_element(y.begin(), y.end());
  Real total = 0, largest = 0;
  for (const Real x : y) {
    total += x;
    largest = std::max(largest, std::abs(x));
  }
  return how == "max_abs" ? largest : total / static_cast<Real>(y.size());
}

ExpectationResult evaluate(const std::string& name, const ExpectSettings& e,
                           const HistoryColumns& history, bool stopped_early) {
  const std::vector<Real>& time = history("time");
  const std::vector<Real>& y = history(e.of);
  ExpectationResult result{name, 0, e.value, 0, true, false};
  result.tolerance = std::max(e.within, e.within_relative * std::abs(e.value));
  const Real last = time.back() * (1 + 1e-12);
  if (e.reduce == "at") {
    result.reached = e.at < 0 ? !stopped_early : e.at <= last;
    if (result.reached) result.obtained = e.at < 0 ? y.back() : value_at_time(time, y, e.at);
  } else {
    result.reached = e.to < 0 ? !stopped_early : e.to <= last;
    std::vector<Real> t_span, y_span;
    for (std::size_t k = 0; k < time.size(); ++k)
      if (time[k] >= e.from && (e.to < 0 || time[k] <= e.to)) {
        t_span.push_back(time[k]);
        y_span.push_back(y[k]);
      }
    const std::size_t needed = e.reduce == "decay_rate" ? 3 : 1;
    result.reached = result.reached && t_span.size() >= needed;
    if (result.reached) result.obtained = reduce(e.reduce, t_span, y_span);
  }
  result.met = result.reached && std::abs(result.obtained - e.value) <= result.tolerance;
  return result;
}

}  // namespace

std::vector<ExpectationResult> evaluate_expectations(
    const std::vector<std::pair<std::string, ExpectSettings>>& expectations,
    const HistoryColumns& history, bool stopped_early) {
  std::vector<ExpectationResult> results;
  for (const auto& entry : expectations)
    results.push_back(evaluate(entry.first, entry.second, history, stopped_early));
  return results;
}

std::string expectation_table(const std::vector<ExpectationResult>& results) {
  std::size_t width = 11;
  for (const auto& r : results) width = std::max(width, r.name.size());
  std::string table = fmt::format("{:<{}}  {:>14}  {:>14}  {:>10}  {}\n", "expectation", width,
                                  "obtained", "expected", "within", "");
  for (const auto& r : results)
    table += r.reached ? fmt::format("{:<{}}  {:>14.7g}  {:>14.7g}  {:>10.3g}  {}\n", r.name, width,
                                     r.obtained, r.expected, r.tolerance, r.met ? "met" : "MISSED")
                       : fmt::format("{:<{}}  {:>14}  {:>14.7g}  {:>10.3g}  not reached\n", r.name,
                                     width, "-", r.expected, r.tolerance);
  return table;
}

}  // namespace meniscus
