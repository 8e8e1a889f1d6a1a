// SPDX-License-Identifier: BSD-3-Clause
// Expectations: numbers taken from the history of a run and compared.
#include "scene/expectations.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace meniscus {
namespace {

/// Linear interpolation of y at the time t, which must lie within the times.
Real value_at_time(const std::vector<Real>& time, const std::vector<Real>& y, Real t) {
  const auto next = std::lower_bound(time.begin(), time.end(), t);
  if (next == time.begin()) return y.front();
  if (next == time.end()) return y.back();
  const auto k = static_cast<std::size_t>(next - time.begin());
  const Real s = (t - time[k - 1]) / (time[k] - time[k - 1]);
  return (1 - s) * y[k - 1] + s * y[k];
}

/// Decay rate: minus the least-squares slope of ln |y| over t.
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

/// Number of times that y falls from `level` or above to below it.
Real falls(std::span<const Real> y, Real level) {
  int count = 0;
  for (std::size_t k = 1; k < y.size(); ++k) count += y[k - 1] >= level && y[k] < level;
  return count;
}

Real reduce(const ExpectSettings& e, std::span<const Real> t, std::span<const Real> y) {
  const std::string& how = e.reduce;
  if (how == "decay_rate") return decay_rate(t, y);
  Real total = 0, largest_size = 0;
  for (const Real x : y) {
    total += x;
    largest_size = std::max(largest_size, std::abs(x));
  }
  if (std::isnan(total)) return total;  // comparisons with NaN are false
  if (how == "falls") return falls(y, *e.level);
  if (how == "max") return *std::max_element(y.begin(), y.end());
  if (how == "min") return *std::min_element(y.begin(), y.end());
  return how == "max_abs" ? largest_size : total / static_cast<Real>(y.size());
}

/// The part of the history that an expectation evaluates.
struct Span {
  std::vector<Real> time, y;
};

Span span_between(const std::vector<Real>& time, const std::vector<Real>& y, Real from, Real to) {
  Span span;
  for (std::size_t k = 0; k < time.size(); ++k)
    if (time[k] >= from && time[k] <= to) {
      span.time.push_back(time[k]);
      span.y.push_back(y[k]);
    }
  return span;
}

/// True if the rows cover the span [from, to]; the last time may differ by round-off.
bool covers(const std::vector<Real>& time, Real from, Real to) {
  return !time.empty() && time.front() <= from && time.back() >= to * (1 - 1e-12);
}

ExpectationResult evaluate(const std::string& name, const ExpectSettings& e,
                           const HistoryColumns& history, Real end) {
  const std::vector<Real>& time = history("time");
  const std::vector<Real>& y = history(e.of);
  const bool at_a_time = e.reduce == "at";
  const Real to = (at_a_time ? e.at : e.to).value_or(end), from = at_a_time ? to : e.from;
  ExpectationResult result{name, 0, e.value, {}, true, false};
  if (e.judged()) {
    result.expected = e.value.value_or(0);
    result.tolerance =
        std::max(e.within.value_or(0), e.within_relative.value_or(0) * std::abs(*result.expected));
  }
  result.reached = covers(time, from, to);
  if (!result.reached) return result;
  if (at_a_time) {
    result.obtained = value_at_time(time, y, to);
  } else {
    const Span span = span_between(time, y, from, to * (1 + 1e-12));
    const std::size_t needed = e.reduce == "decay_rate" ? 3 : 1;
    result.obtained = span.y.size() < needed ? std::nan("") : reduce(e, span.time, span.y);
  }
  result.met = result.tolerance ? std::abs(result.obtained - *result.expected) <= *result.tolerance
                                : !std::isnan(result.obtained);
  return result;
}

std::string verdict_of(const ExpectationResult& r) {
  if (!r.reached) return "not reached";
  if (!r.met) return "MISSED";
  return r.tolerance ? "met" : "reported";
}

/// A number with its digits, or a dash.
std::string cell_of(const std::optional<Real>& number, int digits) {
  return number ? fmt::format("{:.{}g}", *number, digits) : "-";
}

}  // namespace

std::vector<ExpectationResult> evaluate_expectations(
    const std::vector<std::pair<std::string, ExpectSettings>>& expectations,
    const HistoryColumns& history, Real end) {
  std::vector<ExpectationResult> results;
  for (const auto& entry : expectations)
    results.push_back(evaluate(entry.first, entry.second, history, end));
  return results;
}

std::string expectation_table(const std::vector<ExpectationResult>& results) {
  std::size_t width = 11;
  for (const auto& r : results) width = std::max(width, r.name.size());
  const auto line = [&](const auto&... cells) {
    return fmt::format("{:<{}}  {:>16}  {:>14}  {:>10}  {}\n", cells...);
  };
  std::string table = line("expectation", width, "obtained", "expected", "within", "");
  for (const auto& r : results)
    table += line(r.name, width, cell_of(r.reached ? std::optional(r.obtained) : std::nullopt, 10),
                  cell_of(r.expected, 7), cell_of(r.tolerance, 3), verdict_of(r));
  return table;
}

}  // namespace meniscus
