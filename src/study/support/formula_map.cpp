// SPDX-License-Identifier: BSD-3-Clause
// A map given by formulas. Its derivatives are central differences of eighth order with step 0.02
// (the body has radius 1). For formulas that vary over lengths of order one, the error is about
// 1e-13 in F and 1e-11 in G, far below the errors studied.
#include "input/input.hpp"
#include "input/text.hpp"
#include "meniscus/error.hpp"
#include "study/support/maps.hpp"

#include <fmt/core.h>

#include <cmath>

namespace meniscus::study {
namespace {

/// First and second derivative along a direction.
template <int D>
struct Along {
  Vec<D> first, second;
};

template <int D>
class FormulaMap {
 public:
  explicit FormulaMap(std::vector<Expression> formulas) : formulas_(std::move(formulas)) {}

  Vec<D> place(const Vec<D>& X) const {
    Eigen::Vector3d at_X = Eigen::Vector3d::Zero();
    at_X.head<D>() = X;
    Vec<D> x;
    for (int i = 0; i < D; ++i) x[i] = at(formulas_, i).unchecked(at_X);
    return x;
  }

  MapPoint<D> operator()(const Vec<D>& X) const { return point(X, 0.02); }

  MapPoint<D> point(const Vec<D>& X, Real step) const {
    MapPoint<D> point{place(X), {}, {}};
    for (int k = 0; k < D; ++k) {
      const Along<D> axis = along(X, point.x, Vec<D>::Unit(k), step);
      point.F.col(k) = axis.first;
      for (int i = 0; i < D; ++i) at(point.G, i)(k, k) = axis.second[i];
    }
    for (int k = 0; k < D; ++k)
      for (int l = k + 1; l < D; ++l) {
        // (d_k + d_l)^2 - (d_k - d_l)^2 = 4 d_k d_l
        const Vec<D> mixed =
            0.25 * (along(X, point.x, Vec<D>::Unit(k) + Vec<D>::Unit(l), step).second -
                    along(X, point.x, Vec<D>::Unit(k) - Vec<D>::Unit(l), step).second);
        for (int i = 0; i < D; ++i) at(point.G, i)(k, l) = at(point.G, i)(l, k) = mixed[i];
      }
    return point;
  }

 private:
  Along<D> along(const Vec<D>& X, const Vec<D>& x, const Vec<D>& direction, Real step) const {
    constexpr std::array<Real, 4> slope{4.0 / 5, -1.0 / 5, 4.0 / 105, -1.0 / 280};
    constexpr std::array<Real, 4> bend{8.0 / 5, -1.0 / 5, 8.0 / 315, -1.0 / 560};
    Along<D> sum{Vec<D>::Zero(), -205.0 / 72 * x};
    for (std::size_t m = 0; m < slope.size(); ++m) {
      const Vec<D> way = (static_cast<Real>(m) + 1) * step * direction;
      const Vec<D> up = place(X + way), down = place(X - way);
      sum.first += slope[m] * (up - down);
      sum.second += bend[m] * (up + down);
    }
    return {sum.first / step, sum.second / (step * step)};
  }

  std::vector<Expression> formulas_;
};

/// Refuses formulas with a kink, a jump or a pole, where two step widths give different
/// derivatives.
template <int D>
void require_smooth(const FormulaMap<D>& map, const std::string& name) {
  constexpr int n = 6;
  for (int k = 0; k < std::pow(2 * n + 1, D); ++k) {
    Vec<D> X;
    for (int i = 0, rest = k; i < D; ++i, rest /= 2 * n + 1)
      X[i] = static_cast<Real>(rest % (2 * n + 1) - n) / n;
    if (X.norm() > 1) continue;
    const MapPoint<D> wide = map.point(X, 0.04), narrow = map.point(X, 0.02);
    Real difference = 0, size = 1;
    for (int i = 0; i < D; ++i) {
      difference = std::max(difference, (at(wide.G, i) - at(narrow.G, i)).norm());
      size = std::max(size, at(narrow.G, i).norm());
    }
    if (difference > 1e-5 * size || !std::isfinite(difference)) {
      std::vector<std::string> place;
      for (const Real x : X) place.push_back(fmt::format("{:.3g}", x));
      throw InputError(
          fmt::format("{}: the map is not smooth enough near X = ({}): its second derivatives "
                      "found with two step widths differ by {:.2g}; use formulas without kinks, "
                      "jumps and poles that vary over lengths of order one",
                      name, joined(place, ", "), difference));
    }
  }
}

template <int D>
std::vector<NamedMap<D>> make_map(std::vector<Expression> formulas, const std::string& name) {
  const FormulaMap<D> map(std::move(formulas));
  require_smooth(map, name);
  return {NamedMap<D>(name, straight_path<D>(map))};
}

}  // namespace

Maps map_from_file(const std::string& path) {
  const SceneInput input = SceneInput::from_file(path);
  const Block& file = input.root();
  std::vector<Expression> formulas;
  for (const char* key : {"x", "y", "z"})
    if (key[0] != 'z' || file.has("z"))
      formulas.push_back(file.expression(key, dimension::none, {}, {}, Variables::place));
  file.done();
  input.check();
  const std::string name = path.substr(path.find_last_of('/') + 1);
  if (formulas.size() == 3) return {{}, make_map<3>(std::move(formulas), name)};
  return {make_map<2>(std::move(formulas), name), {}};
}

}  // namespace meniscus::study
