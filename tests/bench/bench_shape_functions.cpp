// SPDX-License-Identifier: BSD-3-Clause
// Time per evaluation point of quadratic shape functions in three dimensions, neighbour search
// included, on one thread. Limit: 12 us with all second derivatives at about 85 neighbours.
#include "body/grid/ordering.hpp"
#include "kernel/point_rows.hpp"
#include "measure.hpp"
#include "meniscus/body/shapes.hpp"

#include <memory>

namespace meniscus::bench {
namespace {

struct Cloud {
  ParticleSet<3> particles;
  std::vector<Vec<3>> points;
};

/// The ball of 4341 particles, with supports for about 85 neighbours, and its cell centres.
std::shared_ptr<const Cloud> ball() {
  const SceneInput input =
      SceneInput::from_text("shape = \"ball\"\nradius = 1\ncore = 10\nlayers = 5");
  Geometry<3> geometry = read_geometry<3>(input.root());
  input.check();
  order_spatially(geometry);
  const auto points = cell_gauss_points(geometry.grid, 1).X;
  return std::make_shared<const Cloud>(
      Cloud{{geometry.grid.X, ParticleSet<3>::AdaptiveSupport{.factor = 1.63, .rank = 20},
             KernelFunction::cubic_spline},
            points});
}

}  // namespace

void add_shape_function_cases() {
  struct Case {
    const char* name;
    RowContent content;
  };
  const auto cloud = ball();
  for (const Case& c : {Case{"values", {.value = true}},
                        Case{"values, first derivatives", {.value = true, .gradient = true}},
                        Case{"values, first and second derivatives",
                             {.value = true, .gradient = true, .hessian = true}}})
    add_case("shape functions", c.name, 1, [cloud, c](benchmark::State& state) {
      PointRows<3> rows;
      // Time windows are short: each covers a part of the cloud.
      constexpr std::size_t part = 20;
      std::size_t begin = 0;
      double least = 1e300, neighbors = 0;
      for (auto _ : state) {
        begin = begin + 2 * part > cloud->points.size() ? 0 : begin + part;
        const double time = seconds([&] {
          rows = build_point_rows<3>(
              cloud->particles, std::span(cloud->points).subspan(begin, part), c.content, "ball");
        });
        state.SetIterationTime(time);
        // The time is per neighbour, because the parts differ in their numbers of neighbours.
        least = std::min(least, time / static_cast<double>(rows.entries()));
        neighbors += static_cast<double>(rows.entries()) / part;
      }
      neighbors /= static_cast<double>(state.iterations());
      set_columns(state, {{"us/point", 1e6 * least * neighbors}, {"neighbours", neighbors}});
    });
}

}  // namespace meniscus::bench
