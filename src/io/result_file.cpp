// SPDX-License-Identifier: BSD-3-Clause
// Writing and continuing a result file.
#include "io/result_file.hpp"

#include "input/text.hpp"
#include "io/files.hpp"
#include "io/hdf5_file.hpp"
#include "io/meta.hpp"
#include "io/result_series.hpp"
#include "io/vtkhdf.hpp"
#include "meniscus/error.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace meniscus {
namespace {

std::int64_t particle_count(const BodyReference& body) {
  const ResultField& first = body.arrays.at(0);
  return std::ssize(first.values) / first.components;
}

/// Number of stored components: 2D vectors are stored with z = 0.
int stored_components(const ResultField& field) {
  switch (field.components) {
    case 1:
    case 3:
    case 6:
    case 9:
      return field.components;
    case 2:
      return 3;
    default:
      throw std::invalid_argument(
          fmt::format("field '{}' has {} components", field.name, field.components));
  }
}

std::vector<Real> with_zero_z(std::span<const Real> xy) {
  std::vector<Real> xyz;
  xyz.reserve(xy.size() / 2 * 3);
  for (std::size_t i = 0; i + 1 < xy.size(); i += 2) xyz.insert(xyz.end(), {xy[i], xy[i + 1], 0});
  return xyz;
}

void require_size(const ResultField& field, std::int64_t particles) {
  if (std::ssize(field.values) != particles * field.components)
    throw std::invalid_argument(fmt::format("field '{}' has {} numbers for {} particles of {}",
                                            field.name, field.values.size(), particles,
                                            field.components));
}

void require_field_name(const std::string& name) {
  const auto allowed = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
  };
  // The names "state" and "body" are used by the file itself.
  if (name.empty() || name == "state" || name == "body" ||
      !std::all_of(name.begin(), name.end(), allowed))
    throw std::invalid_argument(fmt::format("'{}' cannot be the name of a field", name));
}

void write_field(hdf5::Group& group, const ResultField& field, hdf5::Storage storage) {
  const int columns = stored_components(field);
  const hdf5::Shape shape{std::ssize(field.values) / field.components, columns};
  if (columns == field.components)
    group.write(field.name, field.values, shape, storage, field.unit);
  else
    group.write(field.name, with_zero_z(field.values), shape, storage, field.unit);
}

bool is_in_space(const BodyReference& body) {
  return body.corners == 8 || (body.simplices && body.corners == 4);
}

/// VTK's number of the cell type.
int cell_type(const BodyReference& body) {
  if (body.corners == 2) return vtkhdf::line;
  if (body.simplices) return is_in_space(body) ? vtkhdf::tetrahedron : vtkhdf::triangle;
  return is_in_space(body) ? vtkhdf::hexahedron : vtkhdf::quadrilateral;
}

std::string describe(const FrameLayout& layout) {
  std::vector<std::string> fields;
  for (const StoredField& f : layout.fields)
    fields.push_back(fmt::format("{} ({}, {})", f.name, f.components, f.unit));
  return fmt::format("{} particles, {} cells, {}, fields {}", layout.particles, layout.cells,
                     layout.precision == hdf5::Type::float32 ? "float32" : "float64",
                     joined(fields, ", "));
}

}  // namespace

class ResultFile::Writer {
 public:
  Writer(const RunDirectory& directory, const Provenance& provenance,
         std::span<const BodyReference> bodies, const ResultOptions& options)
      : options_(options),
        sidecars_(directory.path(), options.name),
        path_(place_in_series(directory, options.name, options.epoch, sidecars_)),
        continuing_(options.continue_after && is_there(path_)),
        file_(continuing_ ? hdf5::File::open_to_append(path_)
                          : hdf5::File::create(temporary_name(path_))) {
    for (const BodyReference& body : bodies) {
      bodies_.push_back({body.name, particles_});
      particles_ += particle_count(body);
      const int type = cell_type(body);
      cell_type_ = cells_ == 0 || type == cell_type_ ? type : 0;
      cells_ += std::ssize(body.cells) / body.corners;
      corners_ += std::ssize(body.cells);
    }
    if (continuing_) {
      require_same_bodies(bodies);
      drop_later_frames();
      note_continuation(provenance);
    } else {
      hdf5::Group root = file_.root();
      root.set("epoch", options_.epoch);
      write_meta(root, provenance);
      write_reference(bodies);
      root.create_group("steps");
      file_.flush();
      rename_file(temporary_name(path_), path_);  // a file in the series must state its epoch
    }
    vtkhdf::write_view(path_);
    if (!file_.root().has("VTKHDF")) mesh_ = mesh_of(bodies);
    file_.flush();
  }

  std::int64_t write_frame(std::int64_t step, Real time, std::span<const ResultField> fields,
                           const Snapshot* state) {
    for (const ResultField& field : fields) require_storable(field, step);
    if (state) state->require_finite();
    if (!layout_) layout_ = layout_of(fields);
    require_same_layout(layout_of(fields));
    hdf5::Group root = file_.root(), steps = root.group("steps");
    const std::string name = fmt::format("{}", frames_);

    hdf5::Group frame = steps.create_group(name);
    frame.set("step", step);
    frame.set("time", time);
    for (const ResultField& field : fields) write_field(frame, field, storage());
    if (state) write_state(frame, *state);
    if (mesh_) vtkhdf::create(root, *layout_, *std::exchange(mesh_, {}), options_.time_unit);
    vtkhdf::append(root, *layout_, frames_, time);
    file_.flush();
    vtkhdf::announce(root, frames_ + 1);
    file_.flush();

    sidecars_.add_frame(path_.filename().string(), frames_, time, *layout_);
    sidecars_.write();
    return frames_++;
  }

  std::int64_t frames() const { return frames_; }
  std::int64_t dropped_frames() const { return dropped_frames_; }

 private:
  struct BodyRange {
    std::string name;
    std::int64_t first_particle;
  };

  hdf5::Storage storage() const {
    const bool single = options_.precision == ResultOptions::Precision::float32;
    return {single ? hdf5::Type::float32 : hdf5::Type::float64, options_.compression};
  }

  FrameLayout layout_of(std::span<const ResultField> fields) const {
    FrameLayout layout{particles_, cells_, corners_, cell_type_, storage().type, {}};
    for (const ResultField& field : fields)
      layout.fields.push_back({field.name, stored_components(field), field.unit});
    std::sort(layout.fields.begin(), layout.fields.end(),
              [](const auto& a, const auto& b) { return a.name < b.name; });
    if (std::none_of(fields.begin(), fields.end(),
                     [](const ResultField& field) { return field.name == "position"; }))
      throw std::invalid_argument("a frame needs the field 'position'");
    return layout;
  }

  void require_same_layout(const FrameLayout& layout) const {
    if (layout == *layout_) return;
    throw FileError(
        fmt::format("cannot add to '{}': its frames have {}, the new one has {}; choose the same "
                    "fields and precision, or another directory with --output",
                    path_.string(), describe(*layout_), describe(layout)));
  }

  void require_storable(const ResultField& field, std::int64_t step) const {
    require_field_name(field.name);
    require_size(field, particles_);
    const bool single = storage().type == hdf5::Type::float32;
    const Real limit =
        single ? std::numeric_limits<float>::max() : std::numeric_limits<Real>::max();
    for (std::size_t i = 0; i < field.values.size(); ++i) {
      if (std::abs(field.values[i]) <= limit) continue;
      const auto I = static_cast<std::int64_t>(i) / field.components;
      const auto body = std::find_if(bodies_.rbegin(), bodies_.rend(),
                                     [&](const BodyRange& b) { return b.first_particle <= I; });
      throw SolveError(
          fmt::format("the field '{}' is {} at particle {} of body '{}' in step {}{}; the frame "
                      "was not written",
                      field.name, field.values[i], I - body->first_particle, body->name, step,
                      std::isfinite(field.values[i]) ? ", too large for float32" : ""));
    }
  }

  vtkhdf::Mesh mesh_of(std::span<const BodyReference> bodies) const {
    vtkhdf::Mesh mesh;
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      const auto first = static_cast<std::size_t>(bodies_[b].first_particle);
      const std::size_t end = first + static_cast<std::size_t>(particle_count(bodies[b]));
      mesh.body.resize(end, static_cast<std::int64_t>(b));
      mesh.surface.resize(end, 0);
      for (const Index A : bodies[b].cells)
        mesh.connectivity.push_back(bodies_[b].first_particle + A);
      mesh.types.insert(mesh.types.end(),
                        bodies[b].cells.size() / static_cast<std::size_t>(bodies[b].corners),
                        cell_type(bodies[b]));
      for (const Index A : bodies[b].facets.empty() ? bodies[b].cells : bodies[b].facets)
        mesh.surface[first + static_cast<std::size_t>(A)] = 1;
    }
    return mesh;
  }

  void write_reference(std::span<const BodyReference> bodies) {
    hdf5::Group reference = file_.root().create_group("reference");
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      if (bodies[b].name.empty() || bodies[b].name.find('/') != std::string::npos)
        throw std::invalid_argument(fmt::format("body name '{}'", bodies[b].name));
      hdf5::Group group = reference.create_group(bodies[b].name);
      group.set("id", static_cast<std::int64_t>(b));
      group.set("particles", particle_count(bodies[b]));
      group.set("first_particle", bodies_[b].first_particle);
      for (const ResultField& array : bodies[b].arrays) {
        require_size(array, particle_count(bodies[b]));
        write_field(group, array, {hdf5::Type::float64, options_.compression});
      }
      write_corners(group, "cells", bodies[b].cells, bodies[b].corners);
      if (!bodies[b].facets.empty())
        write_corners(group, "surface", bodies[b].facets, is_in_space(bodies[b]) ? 4 : 2);
    }
  }

  void write_corners(hdf5::Group& group, const std::string& name, std::span<const Index> corners,
                     int columns) const {
    group.write(name, std::vector<std::int64_t>(corners.begin(), corners.end()),
                {std::ssize(corners) / columns, columns}, {hdf5::Type::int32, options_.compression},
                "1");
  }

  void require_same_bodies(std::span<const BodyReference> bodies) const {
    const hdf5::Group reference = file_.root().group("reference");
    bool same = reference.names().size() == bodies.size();
    for (std::size_t b = 0; same && b < bodies.size(); ++b) {
      same = reference.has_group(bodies[b].name);
      if (!same) break;
      const hdf5::Group group = reference.group(bodies[b].name);
      same = group.integer("particles") == particle_count(bodies[b]) &&
             group.integer("first_particle") == bodies_[b].first_particle;
    }
    if (!same)
      throw FileError(
          fmt::format("cannot continue '{}': its bodies are not those of this scene; choose "
                      "another directory with --output",
                      path_.string()));
  }

  void drop_later_frames() {
    hdf5::Group root = file_.root(), steps = root.group("steps");
    if (root.has("VTKHDF")) {
      layout_ = vtkhdf::layout(root);
      vtkhdf::announce(root, 0);
      file_.flush();
      vtkhdf::clear(root, *layout_);
    }
    std::int64_t stored = 0;
    while (steps.has(fmt::format("{}", stored))) ++stored;
    while (frames_ < stored) {
      const hdf5::Group frame = steps.group(fmt::format("{}", frames_));
      if (frame.integer("step") > *options_.continue_after) break;
      const Real time = frame.real("time");
      vtkhdf::append(root, *layout_, frames_, time);
      sidecars_.add_frame(path_.filename().string(), frames_++, time, *layout_);
    }
    dropped_frames_ = stored - frames_;
    // Remove the last frame first, and flush after each: the file has frames 0, 1, ... without a
    // gap at any time.
    while (stored > frames_) {
      steps.remove(fmt::format("{}", --stored));
      file_.flush();
    }
    if (layout_) vtkhdf::announce(root, frames_);
    file_.flush();
    sidecars_.write();
  }

  /// Lists a continuation below the group "meta", which keeps the provenance of the first part.
  void note_continuation(const Provenance& provenance) {
    hdf5::Group meta = file_.root().group("meta");
    hdf5::Group list = meta.has("continuations") ? meta.group("continuations")
                                                 : meta.create_group("continuations");
    hdf5::Group part = list.create_group(fmt::format("{}", list.names().size()));
    part.set("after_step", *options_.continue_after);
    write_meta(part, provenance);
  }

  ResultOptions options_;
  Sidecars sidecars_;
  std::filesystem::path path_;
  RemovedUnlessRenamed unfinished_{temporary_name(path_)};
  bool continuing_;
  hdf5::File file_;
  std::vector<BodyRange> bodies_;
  std::int64_t particles_ = 0, cells_ = 0, frames_ = 0, dropped_frames_ = 0;
  std::int64_t corners_ = 0;
  int cell_type_ = 0;
  std::optional<vtkhdf::Mesh> mesh_;   ///< kept until the first frame
  std::optional<FrameLayout> layout_;  ///< layout of all frames; empty before the first
};

ResultFile::ResultFile(const RunDirectory& directory, const Provenance& provenance,
                       std::span<const BodyReference> bodies, const ResultOptions& options)
    : writer_(std::make_unique<Writer>(directory, provenance, bodies, options)) {}
ResultFile::~ResultFile() = default;

std::int64_t ResultFile::write_frame(std::int64_t step, Real time,
                                     std::span<const ResultField> fields, const Snapshot* state) {
  return writer_->write_frame(step, time, fields, state);
}

std::int64_t ResultFile::frames() const {
  return writer_->frames();
}
std::int64_t ResultFile::dropped_frames() const {
  return writer_->dropped_frames();
}

}  // namespace meniscus
