// SPDX-License-Identifier: BSD-3-Clause
// Writes checkpoints alternately to two files, and finds the newest valid one.
#include "io/checkpoint.hpp"

#include "io/files.hpp"
#include "io/hdf5_file.hpp"
#include "io/meta.hpp"
#include "meniscus/error.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cinttypes>
#include <cmath>
#include <cstdio>

namespace meniscus {
namespace {

constexpr std::size_t header_size = 512;  // the smallest user block of HDF5
constexpr const char* file_names[] = {"checkpoint-a.h5", "checkpoint-b.h5"};

struct Header {
  std::int64_t serial = 0;
  std::uint64_t checksum = 0;
};

std::string header_text(const Header& header) {
  std::string text = fmt::format("meniscus checkpoint 1\nserial {}\nchecksum {:016x}\n",
                                 header.serial, header.checksum);
  text.resize(header_size, '\0');
  return text;
}

/// The beginning of a file, and the checksum of the rest.
struct Content {
  std::string beginning;
  std::uint64_t checksum;
  bool more;  ///< true if the file continues behind the beginning
};

Content read_content(const std::filesystem::path& file) {
  Content content{};
  Fnv1a hash;
  read_pieces(file, [&](std::string_view piece) {
    const std::size_t missing = std::min(header_size - content.beginning.size(), piece.size());
    content.beginning += piece.substr(0, missing);
    hash.add(piece.substr(missing));
    content.more = content.more || piece.size() > missing;
  });
  content.checksum = hash.value();
  return content;
}

/// The header of the file, if all bytes are valid.
std::optional<Header> valid_header(const std::filesystem::path& file) {
  const Content content = read_content(file);
  Header header;
  if (!content.more ||
      std::sscanf(content.beginning.c_str(),
                  "meniscus checkpoint 1\nserial %" SCNd64 "\nchecksum %" SCNx64, &header.serial,
                  &header.checksum) != 2 ||
      header_text(header) != content.beginning || content.checksum != header.checksum)
    return {};
  return header;
}

std::string damaged(const std::filesystem::path& file) {
  return fmt::format("'{}' is damaged or not a checkpoint", file.string());
}

ReadCheckpoint read_state_and_input(const hdf5::Group& holder, const hdf5::Group& root,
                                    const std::filesystem::path& path) {
  ReadCheckpoint read{
      {holder.integer("step"), holder.real("time"), read_state(holder), read_input(root)},
      path,
      {}};
  const Checkpoint& c = read.checkpoint;
  if (c.step < 0 || !std::isfinite(c.time) || c.time < 0)
    throw FileError(fmt::format("'{}' holds step {} at time {}, which no run has", path.string(),
                                c.step, c.time));
  if (const std::string now = program_text(build()), then = read_program(root); then != now)
    read.warnings.push_back(
        fmt::format("'{}' was written by {}; this is {}: the last digits may differ from one run "
                    "without a stop",
                    path.string(), then, now));
  return read;
}

ReadCheckpoint read_file_of_checkpoint(const std::filesystem::path& path) {
  if (!valid_header(path))
    throw FileError(damaged(path) + "; to continue from a frame of a result file, name the frame");
  const hdf5::File file = hdf5::File::open(path);
  const hdf5::Group root = file.root();
  return read_state_and_input(root, root, path);
}

struct Newest {
  std::filesystem::path file;  ///< empty if no file is valid
  std::int64_t serial = 0;
  std::vector<std::string> warnings;
};

Newest newest_checkpoint(const std::filesystem::path& directory) {
  Newest newest;
  for (const char* name : file_names) {
    const auto file = directory / name;
    if (!is_there(file)) continue;
    const auto header = valid_header(file);
    if (!header)
      newest.warnings.push_back(damaged(file));
    else if (newest.file.empty() || header->serial > newest.serial)
      newest.file = file, newest.serial = header->serial;
  }
  return newest;
}

ReadCheckpoint read_newest(const std::filesystem::path& directory) {
  Newest newest = newest_checkpoint(directory);
  if (newest.file.empty()) {
    std::string found = newest.warnings.empty() ? "there is none" : "";
    for (const std::string& warning : newest.warnings)
      found += (found.empty() ? "" : "; ") + warning;
    throw FileError(fmt::format(
        "found no checkpoint to continue from in '{}': {}{}", directory.string(), found,
        newest.warnings.empty() ? "" : "; continue from a frame of run.h5 that holds the state"));
  }
  ReadCheckpoint read = read_file_of_checkpoint(newest.file);
  read.warnings.insert(read.warnings.begin(), newest.warnings.begin(), newest.warnings.end());
  return read;
}

std::int64_t frame_count(const hdf5::Group& steps) {
  std::int64_t frames = 0;
  while (steps.has(fmt::format("{}", frames))) ++frames;
  return frames;
}

std::string frames_with_state(const hdf5::Group& steps, std::int64_t first) {
  const std::int64_t frames = frame_count(steps);
  std::int64_t last = -1;
  for (std::int64_t k = 0; k < frames; ++k)
    if (steps.group(fmt::format("{}", k)).has("state")) last = k;
  if (frames == 0) return "it has no frames";
  const std::string all = fmt::format("it has the frames {} to {}", first, first + frames - 1);
  return last < 0 ? all + ", all without the state, which output.restartable = true stores"
                  : fmt::format("{}; the last one with the state is {}", all, first + last);
}

/// Reads a frame of a result file, or of one file of a series; `first` is the number of its first
/// frame.
ReadCheckpoint read_frame(const std::filesystem::path& path, std::int64_t frame,
                          std::int64_t first = 0) {
  const hdf5::File file = hdf5::File::open(path);
  const hdf5::Group root = file.root();
  if (!root.has("steps"))
    throw FileError(fmt::format("'{}' has no frames: it is not a result file", path.string()));
  const hdf5::Group steps = root.group("steps");
  const std::string name = fmt::format("{}", frame - first);
  if (!steps.has(name) || !steps.group(name).has("state"))
    throw FileError(fmt::format("cannot continue from frame {} of '{}': {}", frame, path.string(),
                                frames_with_state(steps, first)));
  return read_state_and_input(steps.group(name), root, path);
}

ReadCheckpoint read_frame_of_run(const std::filesystem::path& directory, std::int64_t frame) {
  const auto files = result_series(directory);
  std::int64_t first = 0;
  for (std::size_t k = 0; k + 1 < files.size(); ++k) {
    const std::int64_t frames = frame_count(hdf5::File::open(files[k]).root().group("steps"));
    if (frame < first + frames) return read_frame(files[k], frame, first);
    first += frames;
  }
  return read_frame(files.empty() ? directory / "run.h5" : files.back(), frame, first);
}

}  // namespace

CheckpointWriter::CheckpointWriter(const RunDirectory& directory, Provenance provenance)
    : directory_(directory.path()), provenance_(std::move(provenance)) {
  const Newest newest = newest_checkpoint(directory_);
  serial_ = newest.serial;
  newest_ = newest.file;
}

std::filesystem::path CheckpointWriter::write(std::int64_t step, Real time, const Snapshot& state) {
  const auto target = directory_ / file_names[newest_ == directory_ / file_names[0] ? 1 : 0];
  const auto temporary = temporary_name(target);
  const RemovedUnlessRenamed remover(temporary);
  hdf5::File file = hdf5::File::create(temporary, header_size);
  {
    hdf5::Group root = file.root();
    root.set("step", step);
    root.set("time", time);
    write_state(root, state);
    write_meta(root, provenance_);
  }
  file.close();
  overwrite_beginning(temporary, header_text({serial_ + 1, read_content(temporary).checksum}));
  sync_to_disk(temporary);
  rename_file(temporary, target);
  sync_to_disk(directory_);
  ++serial_;
  newest_ = target;
  return target;
}

ReadCheckpoint read_checkpoint(const std::filesystem::path& path,
                               std::optional<std::int64_t> frame) {
  const bool directory = is_directory_there(path);
  if (frame) return directory ? read_frame_of_run(path, *frame) : read_frame(path, *frame);
  return directory ? read_newest(path) : read_file_of_checkpoint(path);
}

}  // namespace meniscus
