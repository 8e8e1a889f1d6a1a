// SPDX-License-Identifier: BSD-3-Clause
// Texts that are compiled into the program: the guide, the scenes and their meshes. CMake collects
// them from inputs/.
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace meniscus {

struct Document {
  std::string_view name, text;  ///< name: name of its file without the extension
};

/// The topics of the guide, in Markdown, by name.
std::span<const Document> guide_topics();
/// The scenes of inputs/, by name.
std::span<const Document> gallery_scenes();
/// The mesh files that these scenes read, inputs/FIELD/meshes/NAME.msh.
std::span<const Document> gallery_meshes();

/// The directory tools/plotting in the source tree from which this program was built.
std::string_view plotting_sources();

std::vector<std::string> names_of(std::span<const Document> documents);
/// The document with this name. Throws InputError if there is none; the message begins with `kind`,
/// e.g. "topic".
const Document& document_called(std::string_view name, std::span<const Document> documents,
                                std::string_view kind);

/// A topic as text for the terminal: Markdown without its markup.
std::string printed_topic(const Document& topic);
/// A list of all topics, one per line.
std::string list_of_topics();
/// A list of all scenes with their titles, one per line.
std::string list_of_scenes();

/// A scene of the gallery as a starting point for a new scene. Tables that serve only tests are
/// removed, and each table and key gets a comment that explains it.
std::string commented_scene(const Document& scene);
/// The meshes that a scene of the gallery reads.
std::vector<Document> meshes_of(const Document& scene);
/// The path by which scenes refer to the mesh: "meshes/NAME.msh".
std::string file_of_mesh(const Document& mesh);

}  // namespace meniscus
