// SPDX-License-Identifier: BSD-3-Clause
// The group /VTKHDF: the frames as an unstructured grid that moves. Its cells are those of the
// bodies and stand there once; field data are virtual datasets over /steps/<k>/<field> that grow by
// themselves; only small index arrays are written.
// Source: VTK File Formats, "VTKHDF File Format" 2.x, sections UnstructuredGrid and Temporal Data.
#pragma once
#include "io/frame_layout.hpp"
#include "numbers/types.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace meniscus::vtkhdf {

/// What does not change from frame to frame.
struct Mesh {
  std::vector<std::int64_t> body;          ///< number of the body of each particle
  std::vector<std::int64_t> surface;       ///< 1 for particles on the surface of their body, else 0
  std::vector<std::int64_t> connectivity;  ///< corners of all cells in the order of VTK
  std::vector<std::int64_t> types;         ///< of the cells
};

/// The numbers of VTK.
enum CellType { line = 3, triangle = 5, quadrilateral = 9, tetrahedron = 10, hexahedron = 12 };

/// Corners of a cell.
constexpr std::int64_t corners_of(std::int64_t type) {
  return type == hexahedron ? 8 : type == triangle ? 3 : type == line ? 2 : 4;
}

/// Where a file with cells of several types has them as XDMF wants them, each after its type.
inline constexpr const char* mixed_topology = "MixedTopology";

/// The point data are the fields, `body` and `surface`. Throws FileError.
void create(hdf5::Group& root, const FrameLayout& layout, const Mesh& mesh,
            const std::string& time_unit);

/// Writes the view of a result file, a link to its /VTKHDF under the name by which ParaView knows
/// what it is. Throws FileError.
void write_view(const std::filesystem::path& result_file);

/// Makes frame `k` the last one: all index arrays get k + 1 rows.
void append(hdf5::Group& root, const FrameLayout& layout, std::int64_t k, Real time);

/// Tells readers that there are so many frames. To be flushed apart: the arrays must be longer
/// before, and shorter after, and within one flush HDF5 has an order of its own.
void announce(hdf5::Group& root, std::int64_t frames);

/// The index arrays have no rows any more.
void clear(hdf5::Group& root, const FrameLayout& layout);

/// The layout with which create() was called.
FrameLayout layout(const hdf5::Group& root);

}  // namespace meniscus::vtkhdf
