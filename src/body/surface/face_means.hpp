// SPDX-License-Identifier: BSD-3-Clause
// Means of formulas over face cells. The formulas depend on position and time.
#pragma once
#include "body/surface/face_cells.hpp"

#include <algorithm>

namespace meniscus {

/// Evaluates formulas and stores their means. Formulas that do not depend on position are evaluated
/// once per time, all others at all points of the face cells.
template <int D>
class FaceMeans {
 public:
  FaceMeans(const FaceCells<D>& cells, std::vector<Expression> formulas)
      : begin_(cells.begin),
        X_(cells.X),
        share_(cells.share),
        formulas_(std::move(formulas)),
        values_(static_cast<std::size_t>(cells.size()) * formulas_.size()) {
    for (std::size_t i = 0; i < formulas_.size(); ++i) evaluate(i, 0);
  }

  /// The time after which all formulas are constant.
  Real steady_after() const {
    Real last = 0;
    for (const Expression& f : formulas_) last = std::max(last, f.steady_after());
    return last;
  }
  /// The means at `time`, [cell][formula].
  const std::vector<Real>& at(Real time) {
    if (time != time_)
      for (std::size_t i = 0; i < formulas_.size(); ++i)
        if (formulas_[i].depends_on_time()) evaluate(i, time);
    time_ = time;
    return values_;
  }
  std::size_t bytes() const {
    return X_.size() * (sizeof(Vec<D>) + sizeof(Real)) + values_.size() * sizeof(Real);
  }

 private:
  void evaluate(std::size_t i, Real time) {
    const Expression& f = formulas_[i];
    const bool varies = f.depends_on_place();
    const Real same = varies ? 0 : f({0, 0, 0}, time);
    for (std::size_t k = 0; k + 1 < begin_.size(); ++k) {
      Real& mean = values_[k * formulas_.size() + i];
      mean = same;
      for (Offset q = begin_[k]; varies && q < begin_[k + 1]; ++q)
        mean += meniscus::at(share_, q) * f(spatial<D>(meniscus::at(X_, q)), time);
    }
  }

  std::vector<Offset> begin_;
  std::vector<Vec<D>> X_;
  std::vector<Real> share_;
  std::vector<Expression> formulas_;
  std::vector<Real> values_;
  Real time_ = 0;
};

}  // namespace meniscus
