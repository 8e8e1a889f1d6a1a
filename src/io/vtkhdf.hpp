// SPDX-License-Identifier: BSD-3-Clause
// The group /VTKHDF, which presents the frames as one moving unstructured grid. The cells of the
// bodies are stored once. Field data are virtual datasets over /steps/<k>/<field>, which grow by
// themselves; a frame adds only small index arrays.
// Source: VTK File Formats, "VTKHDF File Format" 2.x, sections UnstructuredGrid and Temporal Data.
#pragma once
#include "io/frame_layout.hpp"
#include "numbers/types.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace meniscus::vtkhdf {

/// The parts of the grid that are the same in all frames.
struct Mesh {
  std::vector<std::int64_t> body;          ///< number of the body of each particle
  std::vector<std::int64_t> surface;       ///< 1 for particles on the surface of their body, else 0
  std::vector<std::int64_t> connectivity;  ///< corners of all cells in the order of VTK
  std::vector<std::int64_t> types;         ///< VTK types of the cells
};

/// VTK's numbers of cell types.
enum CellType { line = 3, triangle = 5, quadrilateral = 9, tetrahedron = 10, hexahedron = 12 };

/// Number of corners of a cell.
constexpr std::int64_t corners_of(std::int64_t type) {
  return type == hexahedron ? 8 : type == triangle ? 3 : type == line ? 2 : 4;
}

/// Array with the cells for XDMF, each cell after its type. Only in files with several types of
/// cells.
inline constexpr const char* mixed_topology = "MixedTopology";

/// Creates the group. Its point data are the fields, `body` and `surface`. Throws FileError.
void create(hdf5::Group& root, const FrameLayout& layout, const Mesh& mesh,
            const std::string& time_unit);

/// Writes the view of a result file: a small file with a link to /VTKHDF, whose extension makes
/// ParaView recognise it. Throws FileError.
void write_view(const std::filesystem::path& result_file);

/// Makes frame `k` the last frame: all index arrays get k + 1 rows.
void append(hdf5::Group& root, const FrameLayout& layout, std::int64_t k, Real time);

/// Sets the number of frames that readers see. Needs a flush of its own, because HDF5 orders the
/// changes within one flush: before it the arrays must be long enough, and they may shrink only
/// after it.
void announce(hdf5::Group& root, std::int64_t frames);

/// Removes all rows of the index arrays.
void clear(hdf5::Group& root, const FrameLayout& layout);

/// The layout with which create() was called.
FrameLayout layout(const hdf5::Group& root);

}  // namespace meniscus::vtkhdf
