// SPDX-License-Identifier: BSD-3-Clause
// The files DIR/run.h5 and DIR/run.xdmf contain the frames of a run for plotting tools and
// ParaView. After each remap a new file begins: run.1.h5, run.2.h5, ... Each file is complete in
// itself. run.xdmf lists the frames of all files; run.vtkhdf.series lists the files.
//
// run.h5:
//   /steps/<k>/<field>      one array per field of frame k = 0, 1, ...; attributes step, time
//   /steps/<k>/state/...    the complete state at double precision, if the frame has it
//   /reference/<body>/...   X, volume, cells, surface, ...: constant data
//   /meta                   provenance and the complete input
//   /VTKHDF                 the same frames as a mesh that moves (VTK 9.3, ParaView 5.12 or newer,
//                           which open run.vtkhdf, a link to it)
// The rigid partners of contacts are in partners.h5 and its views, in the same way: the cells are
// the surfaces of the partners, and the only field is the position. Surfaces of bodies of
// revolution may be in revolved.h5 likewise. Every array has an attribute
// "units". run.xdmf describes the frames for older versions of ParaView. A frame is safe when
// write_frame() returns: after an interruption, even by kill -9, the file opens and contains it.
// The file can be read during the run.
#pragma once
#include "io/provenance.hpp"
#include "io/run_directory.hpp"
#include "numbers/types.hpp"
#include "state/snapshot.hpp"

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace meniscus {

/// A field with values per particle, all components of a particle together: values[components * I +
/// c].
struct ResultField {
  std::string name;  ///< letters, digits, '_'
  /// 1: scalar. 2 or 3: vector; a vector of a 2D run is stored with z = 0. 6: symmetric tensor in
  /// the order xx, yy, zz, xy, yz, xz. 9: tensor, row-major.
  int components = 1;
  std::string unit = "1";
  std::span<const Real> values;
};

/// Constant data of a body. A field contains the particles of all bodies, one body after the other.
/// In `cells` and `facets`, particles are numbered from 0 within the body.
struct BodyReference {
  std::string name;                 ///< not empty, without '/'
  std::vector<ResultField> arrays;  ///< at least one; all have one value per particle of the body
  int corners;  ///< per cell: 8 for a hexahedron, 4 for a quadrilateral, 2 for a line, D + 1 for a
                ///< simplex
  /// Corners of the cells in the order of VTK: around the face at the lower end of the third
  /// direction, then around the face at the upper end.
  std::span<const Index> cells;
  /// Corners of the surface facets in tensor order; a triangle abc is a b c c. If empty, the cells
  /// themselves are the surface.
  std::span<const Index> facets;
  bool simplices = false;  ///< the cells are tetrahedra or triangles
};

struct ResultOptions {
  std::string name = "run";  ///< first part of the file names
  enum class Precision { float32, float64 };
  Precision precision = Precision::float64;  ///< of fields; the state is always in double precision
  int compression = 0;                       ///< deflate level, 0 (none) to 9
  std::string time_unit = "s";
  /// Number of remaps so far. Files of earlier epochs are kept; files of later epochs are removed.
  std::int64_t epoch = 0;
  /// Continues the file of this epoch after this step. Frames of later steps are removed, since the
  /// run will make them again. Begins a new file if there is none.
  std::optional<std::int64_t> continue_after{};
};

/// Writes or continues the frames of a run.
class ResultFile {
 public:
  /// Throws FileError if the file cannot be made. When a run is continued, throws FileError if the
  /// file is damaged or has other bodies or particle counts.
  ResultFile(const RunDirectory&, const Provenance&, std::span<const BodyReference>,
             const ResultOptions&);
  ~ResultFile();

  /// Adds a frame and returns its number. One field is "position" (2 or 3 components); all frames
  /// have the same fields. When this returns, the frame is safe even if the process is killed.
  /// Throws SolveError with field and particle if a value is NaN or infinite. Throws FileError if
  /// the disk is full or broken, or if the continued file has other fields; earlier frames stay
  /// valid.
  std::int64_t write_frame(std::int64_t step, Real time, std::span<const ResultField> fields,
                           const Snapshot* state = nullptr);

  std::int64_t frames() const;
  /// Number of frames that `continue_after` removed.
  std::int64_t dropped_frames() const;

 private:
  class Writer;
  std::unique_ptr<Writer> writer_;
};

}  // namespace meniscus
