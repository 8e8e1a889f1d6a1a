// SPDX-License-Identifier: BSD-3-Clause
// The VTKHDF view of a result file.
#include "io/vtkhdf.hpp"

#include "io/files.hpp"
#include "io/run_directory.hpp"

#include <algorithm>

namespace meniscus::vtkhdf {
namespace {

using hdf5::Type;

/// Constant point data.
constexpr const char* body_array = "body";
constexpr const char* surface_array = "surface";

bool is_constant(const std::string& array) {
  return array == body_array || array == surface_array;
}

void write_integers(hdf5::Group& group, const std::string& name,
                    const std::vector<std::int64_t>& values, Type type = Type::int64) {
  group.write(name, values, {std::ssize(values)}, {type}, "1");
}

/// Writes the cells and their counts once; all frames share them.
void write_cells(hdf5::Group& view, const FrameLayout& layout, const Mesh& mesh) {
  std::vector<std::int64_t> offsets{0};
  for (const std::int64_t type : mesh.types) offsets.push_back(offsets.back() + corners_of(type));
  write_integers(view, "NumberOfPoints", {layout.particles});
  write_integers(view, "NumberOfCells", {layout.cells});
  write_integers(view, "NumberOfConnectivityIds", {offsets.back()});
  write_integers(view, "Connectivity", mesh.connectivity);
  write_integers(view, "Offsets", offsets);
  write_integers(view, "Types", mesh.types, Type::uint8);
  if (layout.cell_type == 0 && layout.cells > 0) {
    std::vector<std::int64_t> mixed;
    for (std::size_t c = 0; c < mesh.types.size(); ++c) {
      const std::int64_t type = mesh.types[c];  // XDMF's numbers of the types
      mixed.push_back(type == hexahedron ? 9 : type == tetrahedron ? 6 : type == triangle ? 4 : 5);
      mixed.insert(mixed.end(), mesh.connectivity.begin() + offsets[c],
                   mesh.connectivity.begin() + offsets[c + 1]);
    }
    write_integers(view, mixed_topology, mixed);
  }
}

void create_steps(hdf5::Group& view, const FrameLayout& layout, const std::string& time_unit) {
  hdf5::Group steps = view.create_group("Steps");
  steps.set("NSteps", std::int64_t{0});
  steps.create_series("Values", 1, Type::float64, 0, time_unit);
  steps.create_series("NumberOfParts", 1, Type::int64, 1, "1");
  steps.create_series("PartOffsets", 1, Type::int64, 0, "1");
  steps.create_series("PointOffsets", 1, Type::int64, 0, "1");
  steps.create_series("CellOffsets", 1, Type::int64, 0, "1");
  steps.create_series("ConnectivityIdOffsets", 1, Type::int64, 0, "1");
  hdf5::Group offsets = steps.create_group("PointDataOffsets");
  for (const char* name : {body_array, surface_array})
    offsets.create_series(name, 1, Type::int64, 0, "1");
  for (const StoredField& field : layout.fields)
    if (field.name != "position") offsets.create_series(field.name, 1, Type::int64, 0, "1");
}

/// Names of the series with the offsets of the data of each step.
std::vector<std::string> point_offset_series(const FrameLayout& layout) {
  std::vector<std::string> names = {"PointOffsets"};
  for (const StoredField& field : layout.fields)
    if (field.name != "position") names.push_back("PointDataOffsets/" + field.name);
  return names;
}

void set_length(hdf5::Group& view, const FrameLayout& layout, std::int64_t length) {
  hdf5::Group steps = view.group("Steps");
  for (const char* name :
       {"Values", "NumberOfParts", "PartOffsets", "CellOffsets", "ConnectivityIdOffsets",
        "PointDataOffsets/body", "PointDataOffsets/surface"})
    steps.resize_series(name, length);
  for (const std::string& name : point_offset_series(layout)) steps.resize_series(name, length);
}

}  // namespace

void create(hdf5::Group& root, const FrameLayout& layout, const Mesh& mesh,
            const std::string& time_unit) {
  hdf5::Group view = root.create_group("VTKHDF");
  constexpr std::int64_t version[] = {2, 0};
  view.set("Version", version);
  view.set("Type", "UnstructuredGrid");
  write_cells(view, layout, mesh);
  create_steps(view, layout, time_unit);
  hdf5::Group point_data = view.create_group("PointData");
  write_integers(point_data, body_array, mesh.body);
  write_integers(point_data, surface_array, mesh.surface);
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
  layout.cells = view.info("Types").shape.rows;
  layout.corners = view.info("Connectivity").shape.rows;
  const std::vector<std::int64_t> types = view.integers("Types");
  if (!types.empty() && std::count(types.begin(), types.end(), types[0]) == std::ssize(types))
    layout.cell_type = static_cast<int>(types[0]);
  const hdf5::ArrayInfo points = view.info("Points");
  layout.precision = points.type;
  layout.fields.push_back({"position", points.shape.columns, points.unit});
  for (const std::string& name : point_data.names()) {
    if (is_constant(name)) continue;
    const hdf5::ArrayInfo info = point_data.info(name);
    layout.fields.push_back({name, info.shape.columns, info.unit});
  }
  std::sort(layout.fields.begin(), layout.fields.end(),
            [](const auto& a, const auto& b) { return a.name < b.name; });
  return layout;
}

void write_view(const std::filesystem::path& result_file) {
  const std::filesystem::path path = view_of(result_file);
  const RemovedUnlessRenamed unfinished(temporary_name(path));
  hdf5::File file = hdf5::File::create(temporary_name(path));
  file.root().link("VTKHDF", result_file.filename().string(), "/VTKHDF");
  file.close();
  rename_file(temporary_name(path), path);
}

}  // namespace meniscus::vtkhdf
