// SPDX-License-Identifier: BSD-3-Clause
// Summaries of result files and checkpoints.
#include "meniscus/io/info.hpp"

#include "meniscus/core/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "hdf5_file.hpp"
#include "meta.hpp"

namespace meniscus {
namespace {

using Output = std::back_insert_iterator<std::string>;

const char* type_name(hdf5::Type type) {
  switch (type) {
    case hdf5::Type::float32:
      return "float32";
    case hdf5::Type::float64:
      return "float64";
    case hdf5::Type::int32:
      return "int32";
    case hdf5::Type::int64:
      return "int64";
    case hdf5::Type::text:
      return "text";
  }
  return "";
}

void describe_program(const hdf5::Group& root, Output out) {
  const hdf5::Group meta = root.group("meta");
  fmt::format_to(out, "program   {}\n", read_program(root));
  fmt::format_to(out, "started   {}, {} threads\n", meta.attribute_text("started_utc"),
                 meta.integer("threads"));
  fmt::format_to(out, "command   {}\n", meta.attribute_text("command_line"));
  fmt::format_to(out, "input     SHA-256 {}\n", meta.attribute_text("input_sha256"));
}

void describe_arrays(const hdf5::Group& group, Output out) {
  group.for_each_array([&](const std::string& name, const hdf5::ArrayInfo& info) {
    const std::string columns =
        info.shape.columns > 1 ? fmt::format(" x {}", info.shape.columns) : "";
    fmt::format_to(out, "  {:<24} {:<8} {:>10}{:<5} {}\n", name, type_name(info.type),
                   info.shape.rows, columns, info.unit);
  });
}

void describe_bodies(const hdf5::Group& reference, Output out) {
  fmt::format_to(out, "bodies\n");
  for (const std::string& name : reference.names())
    fmt::format_to(out, "  {:<24} {} particles\n", name,
                   reference.group(name).integer("particles"));
}

void describe_frames(const hdf5::Group& steps, const std::string& time_unit, Output out) {
  const auto name = [](std::int64_t k) { return fmt::format("{}", k); };
  std::int64_t frames = 0;
  while (steps.has(name(frames))) ++frames;
  if (frames > 0) {
    const hdf5::Group first = steps.group(name(0));
    fmt::format_to(out, "fields\n");
    for (const std::string& field : first.names()) {
      if (first.has_group(field)) continue;
      const hdf5::ArrayInfo info = first.info(field);
      fmt::format_to(out, "  {:<24} {:<8} {} component{}, {}\n", field, type_name(info.type),
                     info.shape.columns, info.shape.columns > 1 ? "s" : "", info.unit);
    }
  }
  fmt::format_to(out, "frames    {}\n", frames);
  for (std::int64_t k = 0; k < frames; ++k) {
    const hdf5::Group frame = steps.group(name(k));
    fmt::format_to(out, "  {:<5} step {:<10} time {:<12.6g} {}{}\n", k, frame.integer("step"),
                   frame.real("time"), time_unit, frame.has("state") ? "  with state" : "");
  }
}

void describe_run(const hdf5::Group& root, Output out) {
  describe_program(root, out);
  describe_bodies(root.group("reference"), out);
  const std::string time_unit =
      root.has("VTKHDF") ? root.group("VTKHDF").info("Steps/Values").unit : "";
  describe_frames(root.group("steps"), time_unit, out);
}

void describe_checkpoint(const hdf5::Group& root, Output out) {
  describe_program(root, out);
  fmt::format_to(out, "step      {}\ntime      {:.17g}\nhash      {}\n", root.integer("step"),
                 root.real("time"), root.group("state").attribute_text("hash"));
  fmt::format_to(out, "state\n");
  describe_arrays(root.group("state"), out);
}

}  // namespace

std::string describe_file(const std::filesystem::path& path) {
  const auto file_path = std::filesystem::is_directory(path) ? path / "run.h5" : path;
  const hdf5::File file = hdf5::File::open(file_path);
  const hdf5::Group root = file.root();
  std::string text = fmt::format("file      {}\n", file_path.string());
  const Output out = std::back_inserter(text);
  if (root.has("steps"))
    describe_run(root, out);
  else if (root.has("state"))
    describe_checkpoint(root, out);
  else
    throw FileError(
        fmt::format("'{}' is neither a result file nor a checkpoint", file_path.string()));
  // Texts of a file are not to command the terminal.
  std::replace_if(
      text.begin(), text.end(),
      [](unsigned char c) { return (c < 0x20 && c != '\n') || c == 0x7f; }, '?');
  return text;
}

}  // namespace meniscus
