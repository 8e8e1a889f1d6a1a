// SPDX-License-Identifier: BSD-3-Clause
// Meshes of Gmsh. Source of the formats: the reference manual of Gmsh 4.8, sections 9.1 and 9.2.
#include "meniscus/core/error.hpp"

#include <unordered_map>

#include "mesh_cells.hpp"
#include "mesh_text.hpp"

namespace meniscus {
namespace {

class MshReader {
 public:
  MshReader(std::string_view text, const std::string& name) : text_(text, name) {}

  MeshData read() {
    while (!text_.ended()) {
      const std::string section(text_.word("a section, such as $Nodes"));
      if (section.front() != '$')
        text_.fail(
            "what stands between sections is not known; expected is a section, such as "
            "$Nodes");
      if (section != "$MeshFormat" && !version_)
        text_.fail("the section $MeshFormat is missing; expected is a mesh of Gmsh");
      if (section == "$MeshFormat")
        read_format();
      else if (section == "$PhysicalNames")
        read_names();
      else if (section == "$Entities" && version_ == 4)
        read_entities();
      else if (section == "$Nodes")
        version_ == 4 ? read_blocks_of_nodes() : read_nodes();
      else if (section == "$Elements")
        version_ == 4 ? read_blocks_of_elements() : read_elements();
      else
        skip("$End" + section.substr(1));
      if (section != last_skipped_) end_of("$End" + section.substr(1));
    }
    if (!version_) text_.fail("the file is empty; expected is a mesh of Gmsh");
    if (data_.X.empty() || data_.cells.empty())
      text_.fail("the file has no $Nodes, or no $Elements; expected are both");
    return std::move(data_);
  }

 private:
  using Tag = std::pair<int, long>;  ///< dimension and number

  void read_format() {
    const std::string version(text_.word("a version, 2.2 or 4.1"));
    if (version != "2.2" && version != "2" && version != "4.1")
      text_.fail("version '" + version + "' is not known; expected is 2.2 or 4.1");
    version_ = version.front() - '0';
    if (text_.integer("0, for a text file") != 0)
      text_.fail("the file is binary; expected is a text file: gmsh -format msh41 without -bin");
    text_.integer("the size of a number");
  }

  void skip(const std::string& end) {
    while (text_.word(end) != end) {
    }
    last_skipped_ = "$" + end.substr(4);
  }

  void end_of(const std::string& end) {
    if (const std::string found(text_.word(end)); found != end)
      text_.fail("'" + found.substr(0, 40) + "' is one more than was announced; expected is " +
                 end);
  }

  void read_names() {
    for (long left = text_.integer("a number of names", 0); left > 0; --left) {
      const Tag tag{static_cast<int>(text_.integer("a dimension from 0 to 3", 0, 3)),
                    text_.integer("the number of a physical group")};
      names_[tag] = text_.quoted("its name");
    }
  }

  void read_entities() {
    std::array<long, 4> counts{};
    for (long& count : counts) count = text_.integer("a number of entities", 0);
    for (int d = 0; d < 4; ++d)
      for (long left = at(counts, d); left > 0; --left) {
        const long entity = text_.integer("the number of an entity");
        for (int k = 0; k < (d == 0 ? 3 : 6); ++k) text_.real("a bound of an entity");
        for (long groups = text_.integer("a number of physical groups", 0), k = 0; k < groups; ++k)
          if (const long group = text_.integer("the number of a physical group"); k == 0)
            group_[{d, entity}] = group;
        if (d > 0)
          for (long k = text_.integer("a number of bounding entities", 0); k > 0; --k)
            text_.integer("the number of an entity");
      }
  }

  void add_node(long number, const Eigen::Vector3d& X) {
    if (!number_.emplace(number, static_cast<Index>(data_.X.size())).second)
      text_.fail(fmt::format("node {} is there twice; expected is once", number));
    data_.X.push_back(X);
  }
  Eigen::Vector3d place() {
    Eigen::Vector3d X;
    for (int k = 0; k < 3; ++k) X[k] = text_.real("a coordinate of a node");
    return X;
  }

  void read_nodes() {
    for (long left = text_.integer("a number of nodes", 1, most_); left > 0; --left) {
      const long number = text_.integer("the number of a node");
      add_node(number, place());
    }
  }

  void read_blocks_of_nodes() {
    const long blocks = text_.integer("a number of blocks of nodes", 0);
    text_.integer("a number of nodes", 1, most_);
    for (int k = 0; k < 2; ++k) text_.integer("the number of a node");
    for (long block = 0; block < blocks; ++block) {
      const long dimension = text_.integer("a dimension from 0 to 3", 0, 3);
      text_.integer("the number of an entity");
      const bool parametric = text_.integer("0 or 1", 0, 1) == 1;
      const long count = text_.integer("a number of nodes", 0, most_);
      std::vector<long> numbers;
      for (long k = 0; k < count; ++k) numbers.push_back(text_.integer("the number of a node"));
      for (const long number : numbers) {
        add_node(number, place());
        for (long k = 0; parametric && k < dimension; ++k) text_.real("a parameter of a node");
      }
    }
  }

  void read_elements() {
    for (long left = text_.integer("a number of elements", 1, most_); left > 0; --left) {
      const long number = text_.integer("the number of an element");
      const int line = text_.line();
      const long type = text_.integer("the type of an element");
      long group = 0;
      for (long tags = text_.integer("a number of tags", 0), k = 0; k < tags; ++k)
        if (const long tag = text_.integer("a tag"); k == 0) group = tag;
      read_element(number, line, type, [&](int) { return group; });
    }
  }

  void read_blocks_of_elements() {
    const long blocks = text_.integer("a number of blocks of elements", 0);
    text_.integer("a number of elements", 1, most_);
    for (int k = 0; k < 2; ++k) text_.integer("the number of an element");
    for (long block = 0; block < blocks; ++block) {
      text_.integer("a dimension from 0 to 3", 0, 3);
      const long entity = text_.integer("the number of an entity");
      const long type = text_.integer("the type of an element");
      for (long left = text_.integer("a number of elements", 0, most_); left > 0; --left) {
        const long number = text_.integer("the number of an element");
        read_element(number, text_.line(), type, [&](int dimension) {
          const auto found = group_.find({dimension, entity});
          return found == group_.end() ? 0 : found->second;
        });
      }
    }
  }

  void read_element(long number, int line, long type, const auto& group_in) {
    const auto refuse = [&](const std::string& what) {
      text_.fail(fmt::format("element {} {}", number, what));
    };
    try {
      const std::optional<MeshKind> kind = gmsh_kind(type);
      std::vector<Index> nodes;
      for (int k = 0; k < (kind ? kind->nodes : 1); ++k) {
        const long node = text_.integer("the number of a node");
        const auto found = number_.find(node);
        if (found == number_.end())
          throw InputError(fmt::format(
              "has the node {}, which the file does not have; expected are nodes of $Nodes", node));
        nodes.push_back(found->second);
      }
      if (!kind) return;
      MeshCell cell =
          mesh_cell(*kind, nodes, fmt::format("line {}: element {}", line, number), data_);
      const int dimension = kind->shape == MeshShape::line         ? 1
                            : kind->shape < MeshShape::tetrahedron ? 2
                                                                   : 3;
      if (const long group = group_in(dimension)) {
        const auto name = names_.find({dimension, group});
        cell.face = name != names_.end() ? name->second : fmt::format("{}", group);
      }
      data_.cells.push_back(std::move(cell));
    } catch (const InputError& error) {
      const std::string what = error.what();
      what.find(": line ") == what.npos ? refuse(what) : throw;
    }
  }

  static constexpr long most_ = 1'000'000'000;
  MeshText text_;
  int version_ = 0;
  std::string last_skipped_;
  std::map<Tag, std::string> names_;
  std::map<Tag, long> group_;  ///< of an entity, the first
  std::unordered_map<long, Index> number_;
  MeshData data_;
};

}  // namespace

MeshData read_msh(std::string_view text, const std::string& name) {
  return MshReader(text, name).read();
}

}  // namespace meniscus
