// SPDX-License-Identifier: BSD-3-Clause
// Provenance and snapshots as HDF5 groups.
#include "meta.hpp"

#include "meniscus/core/error.hpp"
#include "meniscus/io/sha256.hpp"

#include <fmt/format.h>

namespace meniscus {
namespace {

std::string hash_text(const Snapshot& state) {
  return fmt::format("{:016x}", state.hash());
}

void read_arrays(const hdf5::Group& group, const std::string& prefix, Snapshot& state) {
  for (const std::string& name : group.names()) {
    if (group.has_group(name)) {
      read_arrays(group.group(name), prefix + name + '/', state);
      continue;
    }
    const hdf5::ArrayInfo info = group.info(name);
    if (info.type == hdf5::Type::text)
      state.add(prefix + name, {group.text(name), info.unit});
    else if (info.type == hdf5::Type::int64)
      state.add(prefix + name, {group.integers(name), info.unit});
    else
      state.add(prefix + name, {group.reals(name), info.unit});
  }
}

}  // namespace

void write_meta(hdf5::Group& root, const Provenance& provenance) {
  hdf5::Group meta = root.create_group("meta");
  meta.set("program", "meniscus");
  meta.set("version", provenance.build.version);
  meta.set("git_hash", provenance.build.git_hash);
  meta.set("git_dirty", std::int64_t{provenance.build.git_dirty});
  meta.set("compiler", provenance.build.compiler);
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
    throw FileError("The input text in the file does not agree with its SHA-256: it was damaged.");
  return input;
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
  Snapshot state;
  read_arrays(group, "", state);
  if (hash_text(state) != group.attribute_text("hash"))
    throw FileError("The saved state does not agree with its hash: it was damaged.");
  return state;
}

}  // namespace meniscus
