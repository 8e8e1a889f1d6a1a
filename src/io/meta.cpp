// SPDX-License-Identifier: BSD-3-Clause
// Provenance and snapshots as HDF5 groups.
#include "io/meta.hpp"

#include "input/sha256.hpp"
#include "meniscus/error.hpp"

#include <fmt/core.h>

namespace meniscus {
namespace {

std::string hash_text(const Snapshot& state) {
  return fmt::format("{:016x}", state.hash());
}

Snapshot::Values read_values(const hdf5::Group& group, const std::string& name, hdf5::Type type) {
  switch (type) {
    case hdf5::Type::text:
      return group.text(name);
    case hdf5::Type::int64:
      return group.integers(name);
    default:
      return group.reals(name);
  }
}

std::size_t bytes_of(const Snapshot::Values& values) {
  if (const auto* text = std::get_if<std::string>(&values)) return text->size();
  return 8 * std::visit([](const auto& v) { return v.size(); }, values);
}

/// Reads the arrays of a snapshot. Throws FileError if together they are larger than the file,
/// which could name the same bytes many times.
Snapshot read_arrays(const hdf5::Group& group) {
  Snapshot state;
  std::size_t bytes = 0;
  const std::size_t most = group.file_size();
  group.for_each_array([&](const std::string& name, const hdf5::ArrayInfo& info) {
    Snapshot::Values values = read_values(group, name, info.type);
    bytes += bytes_of(values);
    if (bytes > most)
      throw FileError(fmt::format("the saved state is larger than its file: '{}'", name));
    state.add(name, {std::move(values), info.unit});
  });
  return state;
}

}  // namespace

void write_meta(hdf5::Group& root, const Provenance& provenance) {
  hdf5::Group meta = root.create_group("meta");
  meta.set("program", "meniscus");
  meta.set("version", provenance.build.version);
  meta.set("git_hash", provenance.build.git_hash);
  meta.set("git_dirty", std::int64_t{provenance.build.git_dirty});
  meta.set("compiler", provenance.build.compiler);
  meta.set("flags", provenance.build.flags);
  for (const auto& [library, version] : provenance.build.libraries) meta.set(library, version);
  meta.set("threads", std::int64_t{provenance.threads});
  meta.set("command_line", provenance.command_line);
  meta.set("started_utc", provenance.started_utc);
  meta.set("input_sha256", sha256(provenance.input));
  meta.write_text("input", provenance.input);
}

std::string read_input(const hdf5::Group& root) {
  const hdf5::Group meta = root.group("meta");
  std::string input = meta.text("input");
  if (sha256(input) != meta.attribute_text("input_sha256"))
    throw FileError("the input text in the file does not agree with its SHA-256: it was damaged");
  return input;
}

std::string read_program(const hdf5::Group& root) {
  const hdf5::Group meta = root.group("meta");
  const auto text = [&](const char* name) {
    return meta.has_attribute(name) ? meta.attribute_text(name) : std::string("unknown");
  };
  const bool dirty = meta.has_attribute("git_dirty") && meta.integer("git_dirty") != 0;
  return program_text(
      {text("version"), text("git_hash"), dirty, text("compiler"), text("flags"), {}});
}

void write_state(hdf5::Group& parent, const Snapshot& state) {
  state.require_finite();
  hdf5::Group group = parent.create_group("state");
  group.set("hash", hash_text(state));
  for (const auto& [name, array] : state.arrays()) {
    const std::string& unit = array.unit;
    if (const auto* text = std::get_if<std::string>(&array.values))
      group.write_text(name, *text);
    else if (const auto* n = std::get_if<std::vector<std::int64_t>>(&array.values))
      group.write(name, *n, {std::ssize(*n)}, {hdf5::Type::int64}, unit);
    else if (const auto* x = std::get_if<std::vector<Real>>(&array.values))
      group.write(name, *x, {std::ssize(*x)}, {hdf5::Type::float64}, unit);
  }
}

Snapshot read_state(const hdf5::Group& parent) {
  const hdf5::Group group = parent.group("state");
  Snapshot state = read_arrays(group);
  if (hash_text(state) != group.attribute_text("hash"))
    throw FileError("the saved state does not agree with its hash: it was damaged");
  try {
    state.require_finite();
  } catch (const SolveError& error) {
    throw FileError(error.what());
  }
  return state;
}

}  // namespace meniscus
