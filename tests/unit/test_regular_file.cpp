// SPDX-License-Identifier: BSD-3-Clause
// Files without an end (pipes, devices) are not opened.
#include "body/mesh/mesh_file.hpp"
#include "input/regular_file.hpp"
#include "meniscus/error.hpp"
#include "mesh_support.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>

namespace meniscus::test_regular_file {
namespace {

const std::string content = "what stands in a file";

/// A FIFO without a writer would block for ever; /dev/zero has no end.
TEST(RegularFile, OthersAreRefused) {
  const std::filesystem::path folder =
      std::filesystem::path(test::written("real.msh", content)).parent_path();
  ASSERT_EQ(mkfifo((folder / "fifo.msh").c_str(), 0600), 0);
  std::filesystem::create_symlink("/dev/zero", folder / "zero.vtu");
  std::filesystem::create_directory(folder / "folder.msh");
  std::filesystem::create_symlink("real.msh", folder / "link.msh");
  const auto problem = [&](const char* name) {
    try {
      text_of_mesh_file((folder / name).string());
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("none");
  };
  for (const auto& [name, kind] : {std::pair("fifo.msh", "it is a FIFO; expected is a file"),
                                   {"zero.vtu", "it is a device; expected is a file"},
                                   {"folder.msh", "it is a directory; expected is a file"}})
    EXPECT_NE(problem(name).find(fmt::format("{}': {}", name, kind)), std::string::npos)
        << problem(name);
  EXPECT_EQ(problem("link.msh"), "none");
  EXPECT_EQ(content_of_regular_file((folder / "real.msh").string(), content.size()), content);
  EXPECT_THROW(content_of_regular_file((folder / "real.msh").string(), content.size() - 1),
               FileError);
}

}  // namespace
}  // namespace meniscus::test_regular_file
