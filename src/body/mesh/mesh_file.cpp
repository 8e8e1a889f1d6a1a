// SPDX-License-Identifier: BSD-3-Clause
// Opening mesh files.
#include "body/mesh/mesh_file.hpp"

#include "input/regular_file.hpp"
#include "meniscus/error.hpp"
#include "parallel/memory.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>

namespace meniscus {

std::string text_of_mesh_file(const std::string& path) {
  const std::filesystem::path file(path);
  const auto refuse = [&](const std::string& what) {
    throw InputError(fmt::format("{}: {}", path, what));
  };
  if (file.extension() != ".msh" && file.extension() != ".vtu")
    refuse("is no mesh; expected is a file whose name ends with .msh or .vtu");
  const Real most =
      std::clamp(available_memory() / 8, 0.0, 4e9);  // cells need more memory than their text
  try {
    return content_of_regular_file(path, static_cast<std::uintmax_t>(most));
  } catch (const FileError& error) {
    throw InputError(
        fmt::format("{} (a mesh is named from the folder of the scene on)", error.what()));
  }
}

MeshData read_mesh(std::string_view text, const std::string& path) {
  return path.ends_with(".msh") ? read_msh(text, path) : read_vtu(text, path);
}

}  // namespace meniscus
