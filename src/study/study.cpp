// SPDX-License-Identifier: BSD-3-Clause
// Bookkeeping of a study: measurements, checks, observed orders.
#include "study/study.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace meniscus {
namespace {

std::optional<Real> order_between(const Measurement& coarse, const Measurement& fine,
                                  std::string_view error) {
  constexpr Real round_off = 1e-13;
  const Real e1 = coarse.error(error), e2 = fine.error(error);
  if (!(e1 > round_off && e2 > round_off) || coarse.h == fine.h) return {};
  return std::log(e1 / e2) / std::log(coarse.h / fine.h);
}

}  // namespace

Real Measurement::error(std::string_view name) const {
  for (const auto& [key, value] : errors)
    if (key == name) return value;
  throw std::out_of_range(fmt::format("there is no error '{}' of '{}'", name, method));
}

void StudyRun::finish_settings() const {
  settings().done();
  settings_.check();
}

void StudyRun::record(Measurement measurement) {
  measurements_.push_back(std::move(measurement));
  listener_(*this);
}

void StudyRun::require(std::string what, Real value, Range allowed) {
  checks_.push_back({std::move(what), value, allowed});
}

const Measurement* StudyRun::find(std::string_view method, int level) const {
  for (const Measurement& m : measurements_)
    if (m.method == method && m.level == level) return &m;
  return nullptr;
}

std::optional<Real> StudyRun::order(const Measurement& measurement, std::string_view error) const {
  const Measurement* before = nullptr;
  for (const Measurement& m : measurements_) {
    if (&m == &measurement) break;
    if (m.method == measurement.method) before = &m;
  }
  return before ? order_between(*before, measurement, error) : std::nullopt;
}

Real StudyRun::overall_order(std::string_view method, std::string_view error) const {
  const auto same = [&](const Measurement& m) { return m.method == method; };
  const auto first = std::find_if(measurements_.begin(), measurements_.end(), same);
  const auto last = std::find_if(measurements_.rbegin(), measurements_.rend(), same);
  constexpr Real none = std::numeric_limits<Real>::quiet_NaN();
  if (first == measurements_.end()) return none;
  return order_between(*first, *last, error).value_or(none);
}

double Stopwatch::now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}
double Stopwatch::seconds() const {
  return now() - begin_;
}

}  // namespace meniscus
