// SPDX-License-Identifier: BSD-3-Clause
// The XDMF description of a result file.
#include "io/xdmf.hpp"

#include "io/files.hpp"
#include "io/vtkhdf.hpp"

#include <fmt/core.h>

namespace meniscus {
namespace {

/// XDMF type of an array. Type "Matrix" keeps six numbers in the order of VTK, which is used here;
/// XDMF's Tensor6 has another order.
const char* attribute_type(int components) {
  switch (components) {
    case 1:
      return "Scalar";
    case 3:
      return "Vector";
    case 9:
      return "Tensor";
    default:
      return "Matrix";
  }
}

const char* topology_type(int cell_type) {
  switch (cell_type) {
    case vtkhdf::hexahedron:
      return "Hexahedron";
    case vtkhdf::quadrilateral:
      return "Quadrilateral";
    case vtkhdf::tetrahedron:
      return "Tetrahedron";
    case vtkhdf::triangle:
      return "Triangle";
    case vtkhdf::line:
      return "Polyline";
    default:
      return "Mixed";
  }
}

/// A data item. `array`: the file and the path of the array in it.
std::string data_item(const std::string& array, std::int64_t rows, int columns, hdf5::Type type) {
  const bool integer = type == hdf5::Type::int64;
  return fmt::format(
      R"(<DataItem Dimensions="{}{}" NumberType="{}" Precision="{}" Format="HDF">{}</DataItem>)",
      rows, columns == 1 ? "" : fmt::format(" {}", columns), integer ? "Int" : "Float",
      type == hdf5::Type::float32 ? 4 : 8, array);
}

}  // namespace

void XdmfSidecar::add_frame(const std::string& hdf5_name, std::int64_t k, Real time,
                            const FrameLayout& layout) {
  const std::int64_t n = layout.particles;
  const auto add = [&](const std::string& line) { frames_ += line + '\n'; };
  const auto add_attribute = [&](const std::string& name, int components, const std::string& item) {
    add(fmt::format(R"(<Attribute Name="{}" AttributeType="{}" Center="Node">)", name,
                    attribute_type(components)));
    add(item + "</Attribute>");
  };
  add(fmt::format(R"(<Grid Name="frame {}" GridType="Uniform">)", k));
  add(fmt::format(R"(<Time Value="{:.17g}"/>)", time));
  add(fmt::format(R"(<Topology TopologyType="{}" NumberOfElements="{}"{}>)",
                  topology_type(layout.cell_type), layout.cells,
                  layout.cell_type == vtkhdf::line ? R"( NodesPerElement="2")" : ""));
  const bool mixed = layout.cell_type == 0;
  add(data_item(
          fmt::format("{}:/VTKHDF/{}", hdf5_name, mixed ? vtkhdf::mixed_topology : "Connectivity"),
          layout.corners + (mixed ? layout.cells : 0), 1, hdf5::Type::int64) +
      "</Topology>");
  add(R"(<Geometry GeometryType="XYZ">)");
  add(data_item(fmt::format("{}:/steps/{}/position", hdf5_name, k), n, 3, layout.precision) +
      "</Geometry>");
  for (const std::string name : {"body", "surface"})
    add_attribute(name, 1,
                  data_item(hdf5_name + ":/VTKHDF/PointData/" + name, n, 1, hdf5::Type::int64));
  for (const StoredField& field : layout.fields)
    if (field.name != "position")
      add_attribute(field.name, field.components,
                    data_item(fmt::format("{}:/steps/{}/{}", hdf5_name, k, field.name), n,
                              field.components, layout.precision));
  add("</Grid>");
}

void XdmfSidecar::write() const {
  replace_file(path_, fmt::format(R"(<?xml version="1.0" ?>
<!DOCTYPE Xdmf SYSTEM "Xdmf.dtd" []>
<Xdmf Version="3.0">
<Domain>
<Grid Name="bodies" GridType="Collection" CollectionType="Temporal">
{}</Grid>
</Domain>
</Xdmf>
)",
                                  frames_));
}

}  // namespace meniscus
