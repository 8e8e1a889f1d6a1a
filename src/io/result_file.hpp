// SPDX-License-Identifier: BSD-3-Clause
// DIR/run.h5 and DIR/run.xdmf: the frames of a run, for people, plotting tools and ParaView. A run
// whose bodies are referred anew goes on in run.1.h5, run.2.h5, ..., each whole in itself;
// run.xdmf has the frames of all, and run.vtkhdf.series lists the files.
//
// run.h5:
//   /steps/<k>/<field>      one array per field of frame k = 0, 1, ...; attributes step, time
//   /steps/<k>/state/...    the complete state at double precision, if the frame has it
//   /reference/<body>/...   X, volume, cells, surface, ...: what does not change
//   /meta                   provenance and the complete input
//   /VTKHDF                 the same frames as a mesh that moves (VTK 9.3, ParaView 5.12 or newer,
//                           which open run.vtkhdf, a link to it)
// Rigid partners are drawn by partners.h5 and its views in the same way: their surfaces are cells,
// the only field is the position. Every array has an attribute "units". run.xdmf describes the
// frames to older ParaView. After an interruption, even kill -9, the file opens and has every frame
// that write_frame() had returned from. It can be read while the run goes on.
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

/// Values per particle, particle by particle: values[components * I + c].
struct ResultField {
  std::string name;  ///< letters, digits, '_'
  /// 1 scalar; 2 or 3 vector (of a 2D run: stored with z = 0); 6 symmetric tensor in the order
  /// xx, yy, zz, xy, yz, xz; 9 tensor by rows.
  int components = 1;
  std::string unit = "1";
  std::span<const Real> values;
};

/// What does not change of a body. Particles of the bodies follow each other in every field; those
/// of a body are counted from 0 in its cells and facets.
struct BodyReference {
  std::string name;                 ///< not empty, without '/'
  std::vector<ResultField> arrays;  ///< at least one; all have one value per particle of the body
  int corners;  ///< of a cell: 8 of a hexahedron, 4 of a quadrilateral, 2 of a line; of simplices
                ///< one more than D
  /// Corners of the cells in the order of VTK: around the face at the lower end of the third
  /// direction, then around that at the upper.
  std::span<const Index> cells;
  /// Corners of the facets of the surface in tensor order; a b c c of a triangle. Empty: all cells
  /// are of the surface.
  std::span<const Index> facets;
  bool simplices = false;  ///< the cells are tetrahedra or triangles
};

struct ResultOptions {
  std::string name = "run";  ///< of the files
  enum class Precision { float32, float64 };
  Precision precision = Precision::float64;  ///< of fields; a state is always double
  int compression = 0;                       ///< deflate level, 0 (none) to 9
  std::string time_unit = "s";
  /// How often bodies were referred anew: files of earlier epochs stay, of later ones are removed.
  std::int64_t epoch = 0;
  /// Continue the file of this epoch after this step: frames of later steps are dropped (the run
  /// will make them again), the others stay. Without the file a new one is begun.
  std::optional<std::int64_t> continue_after{};
};

/// Writes or continues the frames of a run.
class ResultFile {
 public:
  /// Throws FileError if the file cannot be made, or if the run to be continued has other bodies,
  /// particle counts, or is damaged.
  ResultFile(const RunDirectory&, const Provenance&, std::span<const BodyReference>,
             const ResultOptions&);
  ~ResultFile();

  /// Adds a frame and returns its number. One field is "position" (2 or 3 components); all frames
  /// have the same fields. When it returns, the frame survives a kill.
  /// Throws SolveError naming field and particle if a value is NaN or infinite, FileError if the
  /// disk does not take it or if a continued file has other fields; the frames before are safe.
  std::int64_t write_frame(std::int64_t step, Real time, std::span<const ResultField> fields,
                           const Snapshot* state = nullptr);

  std::int64_t frames() const;
  /// How many frames continue_after removed.
  std::int64_t dropped_frames() const;

 private:
  class Writer;
  std::unique_ptr<Writer> writer_;
};

}  // namespace meniscus
