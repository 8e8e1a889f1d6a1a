// SPDX-License-Identifier: BSD-3-Clause
// Opening mesh files.
#include "meniscus/body/mesh_file.hpp"

#include "meniscus/core/error.hpp"

#include <fmt/core.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <system_error>

namespace meniscus {

std::string text_of_mesh_file(const std::string& path) {
  const std::filesystem::path file(path);
  const auto refuse = [&](const std::string& what) {
    throw InputError(fmt::format("{}: {}", path, what));
  };
  if (file.extension() != ".msh" && file.extension() != ".vtu")
    refuse("is no mesh; expected is a file whose name ends with .msh or .vtu");
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored)) refuse("is a directory; expected is a file");
  std::ifstream stream(file, std::ios::binary);
  if (!stream)
    refuse(
        fmt::format("cannot be read: {}; expected is a file, named from the folder of the scene "
                    "on",
                    std::generic_category().message(errno)));
  const std::uintmax_t size = std::filesystem::file_size(file, ignored);
  constexpr std::uintmax_t most = 4'000'000'000;
  if (ignored || size > most) refuse("is no file of at most 4 GB; expected is one");
  std::string text(size, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(size));
  if (stream.gcount() != static_cast<std::streamsize>(size)) refuse("reading failed");
  return text;
}

MeshData read_mesh(std::string_view text, const std::string& path) {
  return path.ends_with(".msh") ? read_msh(text, path) : read_vtu(text, path);
}

}  // namespace meniscus
