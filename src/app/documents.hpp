// SPDX-License-Identifier: BSD-3-Clause
// Texts that the program has with it, as CMake has found them in inputs/: the guide and the scenes.
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace meniscus {

struct Document {
  std::string_view name, text;  ///< name: that of its file, without the ending
};

/// The topics of the guide, in Markdown, by name.
std::span<const Document> guide_topics();
/// The scenes of inputs/, by name.
std::span<const Document> gallery_scenes();
/// The meshes that they read, inputs/meshes/NAME.msh.
std::span<const Document> gallery_meshes();

/// Where the sources of this program have tools/plotting.
std::string_view plotting_sources();

std::vector<std::string> names_of(std::span<const Document> documents);
/// The document of that name. Throws InputError, which begins with `kind` ("topic"), if there is
/// none.
const Document& document_called(std::string_view name, std::span<const Document> documents,
                                std::string_view kind);

/// A topic as it is printed: Markdown without its signs.
std::string printed_topic(const Document& topic);
/// All topics, a line each.
std::string list_of_topics();
/// All scenes, a line each, with their titles.
std::string list_of_scenes();

/// A scene of the gallery as one to begin with: without what is for tests, and with what tables and
/// keys mean beside them.
std::string commented_scene(const Document& scene);
/// The meshes that a scene of the gallery names.
std::vector<Document> meshes_of(const Document& scene);
/// "meshes/NAME.msh", as scenes name them.
std::string file_of_mesh(const Document& mesh);

}  // namespace meniscus
