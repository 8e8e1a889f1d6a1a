// SPDX-License-Identifier: BSD-3-Clause
// The VTKHDF view of a result file.
#include "vtkhdf.hpp"

#include <algorithm>
#include <numeric>

namespace meniscus::vtkhdf {
namespace {

using hdf5::Type;

constexpr const char* cell_kinds[] = {"Vertices", "Lines", "Polygons", "Strips"};
constexpr const char* body_array = "body";

std::vector<std::int64_t> count_up(std::int64_t n) {
  std::vector<std::int64_t> numbers(static_cast<std::size_t>(n));
  std::iota(numbers.begin(), numbers.end(), 0);
  return numbers;
}

/// One vertex per particle, no other cells. The connectivity is stored once; VTK wants the counts
/// for each step.
void create_cells(hdf5::Group& view, std::int64_t particles) {
  for (const char* kind : cell_kinds) {
    const std::int64_t cells = kind == cell_kinds[0] ? particles : 0;
    hdf5::Group group = view.create_group(kind);
    group.write("Connectivity", count_up(cells), {cells}, {Type::int64}, "1");
    group.write("Offsets", count_up(cells + 1), {cells + 1}, {Type::int64}, "1");
    group.create_series("NumberOfCells", 1, Type::int64, cells, "1");
    group.create_series("NumberOfConnectivityIds", 1, Type::int64, cells, "1");
  }
}

void create_steps(hdf5::Group& view, const FrameLayout& layout, const std::string& time_unit) {
  hdf5::Group steps = view.create_group("Steps");
  steps.set("NSteps", std::int64_t{0});
  steps.create_series("Values", 1, Type::float64, 0, time_unit);
  steps.create_series("NumberOfParts", 1, Type::int64, 1, "1");
  steps.create_series("PartOffsets", 1, Type::int64, 0, "1");
  steps.create_series("PointOffsets", 1, Type::int64, 0, "1");
  steps.create_series("CellOffsets", 4, Type::int64, 0, "1");
  steps.create_series("ConnectivityIdOffsets", 4, Type::int64, 0, "1");
  hdf5::Group offsets = steps.create_group("PointDataOffsets");
  offsets.create_series(body_array, 1, Type::int64, 0, "1");
  for (const StoredField& field : layout.fields)
    if (field.name != "position") offsets.create_series(field.name, 1, Type::int64, 0, "1");
}

/// The series that say for each step where its data begin: one entry is one frame of particles.
std::vector<std::string> point_offset_series(const FrameLayout& layout) {
  std::vector<std::string> names = {"PointOffsets"};
  for (const StoredField& field : layout.fields)
    if (field.name != "position") names.push_back("PointDataOffsets/" + field.name);
  return names;
}

void set_length(hdf5::Group& view, const FrameLayout& layout, std::int64_t length) {
  hdf5::Group steps = view.group("Steps");
  view.resize_series("NumberOfPoints", length);
  for (const std::string kind : cell_kinds) {
    view.resize_series(kind + "/NumberOfCells", length);
    view.resize_series(kind + "/NumberOfConnectivityIds", length);
  }
  for (const char* name : {"Values", "NumberOfParts", "PartOffsets", "CellOffsets",
                           "ConnectivityIdOffsets", "PointDataOffsets/body"})
    steps.resize_series(name, length);
  for (const std::string& name : point_offset_series(layout)) steps.resize_series(name, length);
}

}  // namespace

void create(hdf5::Group& root, const FrameLayout& layout,
            std::span<const std::int64_t> body_of_particle, const std::string& time_unit) {
  hdf5::Group view = root.create_group("VTKHDF");
  constexpr std::int64_t version[] = {2, 0};
  view.set("Version", version);
  view.set("Type", "PolyData");
  view.create_series("NumberOfPoints", 1, Type::int64, layout.particles, "1");
  create_cells(view, layout.particles);
  create_steps(view, layout, time_unit);
  hdf5::Group point_data = view.create_group("PointData");
  point_data.write(body_array, body_of_particle, {layout.particles}, {Type::int64}, "1");
  for (const StoredField& field : layout.fields) {
    const std::string pattern = "/steps/%b/" + field.name;
    const hdf5::Shape shape{layout.particles, field.components};
    if (field.name == "position")
      view.create_view("Points", pattern, shape, layout.precision, field.unit);
    else
      point_data.create_view(field.name, pattern, shape, layout.precision, field.unit);
  }
}

void append(hdf5::Group& root, const FrameLayout& layout, std::int64_t k, Real time) {
  hdf5::Group view = root.group("VTKHDF");
  set_length(view, layout, k + 1);
  hdf5::Group steps = view.group("Steps");
  steps.set_series("Values", k, time);
  steps.set_series("PartOffsets", k, static_cast<Real>(k));
  for (const std::string& name : point_offset_series(layout))
    steps.set_series(name, k, static_cast<Real>(k * layout.particles));
}

void announce(hdf5::Group& root, std::int64_t frames) {
  root.group("VTKHDF").group("Steps").set("NSteps", frames);
}

void clear(hdf5::Group& root, const FrameLayout& layout) {
  hdf5::Group view = root.group("VTKHDF");
  set_length(view, layout, 0);
}

FrameLayout layout(const hdf5::Group& root) {
  const hdf5::Group view = root.group("VTKHDF"), point_data = view.group("PointData");
  FrameLayout layout;
  layout.particles = point_data.info(body_array).shape.rows;
  const hdf5::ArrayInfo points = view.info("Points");
  layout.precision = points.type;
  layout.fields.push_back({"position", points.shape.columns, points.unit});
  for (const std::string& name : point_data.names()) {
    if (name == body_array) continue;
    const hdf5::ArrayInfo info = point_data.info(name);
    layout.fields.push_back({name, info.shape.columns, info.unit});
  }
  std::sort(layout.fields.begin(), layout.fields.end(),
            [](const auto& a, const auto& b) { return a.name < b.name; });
  return layout;
}

}  // namespace meniscus::vtkhdf
