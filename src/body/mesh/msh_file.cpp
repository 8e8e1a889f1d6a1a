// SPDX-License-Identifier: BSD-3-Clause
// Meshes of Gmsh, text or binary. Source of the formats: the reference manual of Gmsh 4.8, sections
// 9.1 and 9.2.
#include "body/mesh/mesh_cells.hpp"
#include "body/mesh/msh_numbers.hpp"
#include "meniscus/error.hpp"

#include <cstdlib>
#include <unordered_map>

namespace meniscus {
namespace {

class MshReader {
 public:
  MshReader(std::string_view text, const std::string& name) : name_(name), numbers_(text, name) {}

  MeshData read() {
    while (!text_.ended()) {
      const std::string section(text_.word("a section, such as $Nodes"));
      if (section.front() != '$')
        text_.fail(
            "what stands between sections is not known; expected is a section, such as "
            "$Nodes");
      if (section != "$MeshFormat" && !version_)
        text_.fail("the section $MeshFormat is missing; expected is a mesh of Gmsh");
      if (!read_section(section))
        text_.skip_past("$End" + section.substr(1));
      else
        end_of("$End" + section.substr(1));
    }
    if (!version_) text_.fail("the file is empty; expected is a mesh of Gmsh");
    if (data_.X.empty() || data_.cells.empty())
      text_.fail("the file has no $Nodes, or no $Elements; expected are both");
    return std::move(data_);
  }

 private:
  using Tag = std::pair<int, long>;  ///< dimension and number of a group or entity

  /// Reads a section of the file. Returns false if the section is not needed.
  bool read_section(const std::string& section) {
    if (section == "$MeshFormat")
      read_format();
    else if (section == "$PhysicalNames")
      read_names();
    else if (section == "$Entities" && version_ == 4)
      read_entities(false);
    else if (section == "$PartitionedEntities" && version_ == 4)
      read_entities(true);
    else if (section == "$Nodes" && version_ == 4)
      read_blocks_of_nodes();
    else if (section == "$Nodes" || section == "$ParametricNodes")
      read_nodes(section == "$ParametricNodes");
    else if (section == "$Elements" && version_ == 4)
      read_blocks_of_elements();
    else if (section == "$Elements")
      numbers_.binary() ? read_elements_of_bytes() : read_elements();
    else
      return false;
    return true;
  }

  void read_format() {
    const std::string version(text_.word("a version, 2.2 or 4.1"));
    if (version != "2.2" && version != "2" && version != "4.1")
      text_.fail("version '" + MeshText::shown(version) +
                 "' is not known; expected is 2.2 or 4.1 (gmsh -format msh41)");
    version_ = version.front() - '0';
    const bool binary = text_.integer("0 or 1, for a binary file", 0, 1) == 1;
    text_.integer("8, the size of a number", 8, 8);
    if (!binary) return;
    numbers_.set_binary();
    numbers_.begin_bytes();
    if (numbers_.integer("the number 1 in the order of bytes of the file") != 1)
      text_.fail("the bytes are in the order of another machine; expected is little-endian");
  }

  void end_of(const std::string& end) {
    if (const std::string found(text_.word(end)); found != end)
      text_.fail("'" + MeshText::shown(found) + "' is one more than was announced; expected is " +
                 end);
  }

  void read_names() {
    for (long left = text_.integer("a number of names", 0); left > 0; --left) {
      const Tag tag{static_cast<int>(text_.integer("a dimension from 0 to 3", 0, 3)),
                    text_.integer("the number of a physical group")};
      names_[tag] = text_.quoted("its name");
    }
  }

  /// Reads the physical groups of entities. In partitioned meshes, parts of an entity inherit its
  /// groups.
  void read_entities(bool partitioned) {
    numbers_.begin_bytes();
    if (partitioned) {
      numbers_.size("a number of partitions", 0);
      for (long left = numbers_.size("a number of ghost entities", 0); left > 0; --left)
        for (int k = 0; k < 2; ++k) numbers_.integer("a number of a ghost entity");
    }
    std::array<long, 4> counts{};
    for (long& count : counts) count = numbers_.size("a number of entities", 0);
    for (int d = 0; d < 4; ++d)
      for (long left = at(counts, d); left > 0; --left) {
        const long entity = numbers_.integer("the number of an entity");
        if (partitioned) {
          for (int k = 0; k < 2; ++k) numbers_.integer("a parent of an entity");
          for (long k = numbers_.size("a number of partitions", 0); k > 0; --k)
            numbers_.integer("the number of a partition");
        }
        for (int k = 0; k < (d == 0 ? 3 : 6); ++k) numbers_.real("a bound of an entity");
        for (long groups = numbers_.size("a number of physical groups", 0), k = 0; k < groups; ++k)
          if (const long group = numbers_.integer("the number of a physical group"); k == 0)
            group_[{d, entity}] = std::abs(group);
        if (d > 0)
          for (long k = numbers_.size("a number of bounding entities", 0); k > 0; --k)
            numbers_.integer("the number of an entity");
      }
  }

  void add_node(long number, const Eigen::Vector3d& X) {
    if (!number_.emplace(number, static_cast<Index>(data_.X.size())).second)
      text_.fail(fmt::format("node {} is there twice; expected is once", number));
    data_.X.push_back(X);
  }
  Eigen::Vector3d place() {
    Eigen::Vector3d X;
    for (int k = 0; k < 3; ++k) X[k] = numbers_.real("a coordinate of a node");
    return X;
  }

  void read_nodes(bool parametric) {
    long left = text_.integer("a number of nodes", 1, most_);
    for (numbers_.begin_bytes(); left > 0; --left) {
      const long number = numbers_.integer("the number of a node");
      add_node(number, place());
      if (!parametric) continue;
      const long dimension = numbers_.integer("a dimension from 0 to 3", 0, 3);
      numbers_.integer("the number of an entity");
      for (long k = 0; dimension < 3 && k < dimension; ++k) numbers_.real("a parameter of a node");
    }
  }

  void read_blocks_of_nodes() {
    numbers_.begin_bytes();
    const long blocks = numbers_.size("a number of blocks of nodes", 0),
               total = numbers_.size("a number of nodes", 1, most_);
    for (int k = 0; k < 2; ++k) numbers_.size("the number of a node");
    for (long block = 0; block < blocks; ++block) {
      const long dimension = numbers_.integer("a dimension from 0 to 3", 0, 3);
      numbers_.integer("the number of an entity");
      const bool parametric = numbers_.integer("0 or 1", 0, 1) == 1;
      const long count = numbers_.size("a number of nodes", 0, most_);
      std::vector<long> numbers;
      for (long k = 0; k < count; ++k) numbers.push_back(numbers_.size("the number of a node"));
      for (const long number : numbers) {
        add_node(number, place());
        for (long k = 0; parametric && k < dimension; ++k) numbers_.real("a parameter of a node");
      }
    }
    require_total(std::ssize(data_.X), total, "nodes");
  }

  void require_total(long found, long announced, const char* what) const {
    if (found != announced)
      text_.fail(
          fmt::format("the blocks have {} {} in all, but {} were announced; expected is the "
                      "announced number",
                      found, what, announced));
  }

  void read_elements() {
    for (long left = text_.integer("a number of elements", 1, most_); left > 0; --left) {
      const long number = text_.integer("the number of an element");
      const std::string where = text_.place();
      const long type = text_.integer("the type of an element");
      const long group = first_of_tags(text_.integer("a number of tags", 0));
      read_element(number, where, type, [&](int) { return group; });
    }
  }

  /// Reads the elements of a binary file of version 2.2, which stores them by kind.
  void read_elements_of_bytes() {
    long left = text_.integer("a number of elements", 1, most_);
    numbers_.begin_bytes();
    while (left > 0) {
      const long type = numbers_.integer("the type of an element"),
                 count = numbers_.integer("a number of elements", 1, left),
                 tags = numbers_.integer("a number of tags", 0);
      left -= count;
      for (long k = 0; k < count; ++k) {
        const long number = numbers_.integer("the number of an element");
        const std::string where = text_.place();
        const long group = first_of_tags(tags);
        read_element(number, where, type, [&](int) { return group; });
      }
    }
  }

  /// Reads `count` tags and returns the first one, the physical group.
  long first_of_tags(long count) {
    long first = 0;
    for (long k = 0; k < count; ++k)
      if (const long tag = numbers_.integer("a tag"); k == 0) first = std::abs(tag);
    return first;
  }

  void read_blocks_of_elements() {
    numbers_.begin_bytes();
    const long blocks = numbers_.size("a number of blocks of elements", 0),
               total = numbers_.size("a number of elements", 1, most_);
    long found = 0;
    for (int k = 0; k < 2; ++k) numbers_.size("the number of an element");
    for (long block = 0; block < blocks; ++block) {
      numbers_.integer("a dimension from 0 to 3", 0, 3);
      const long entity = numbers_.integer("the number of an entity");
      const long type = numbers_.integer("the type of an element");
      for (long left = numbers_.size("a number of elements", 0, most_); left > 0; --left, ++found) {
        const long number = numbers_.size("the number of an element");
        read_element(number, text_.place(), type, [&](int dimension) {
          const auto group = group_.find({dimension, entity});
          return group == group_.end() ? 0 : group->second;
        });
      }
    }
    require_total(found, total, "elements");
  }

  /// The number of a node. The version and the header of the file determine its number of bytes.
  long node_number() {
    constexpr std::string_view expected = "the number of a node";
    return version_ == 4 ? numbers_.size(expected) : numbers_.integer(expected);
  }

  void read_element(long number, const std::string& place, long type, const auto& group_in) {
    const auto refuse = [&](const std::string& what) {
      text_.fail(fmt::format("element {} {}", number, what));
    };
    try {
      const std::optional<MeshKind> kind = gmsh_kind(type);
      std::vector<Index> nodes;
      for (int k = 0; k < (kind ? kind->nodes : 1); ++k) {
        const long node = node_number();
        const auto found = number_.find(node);
        if (found == number_.end())
          throw InputError(fmt::format(
              "has the node {}, which the file does not have; expected are nodes of $Nodes", node));
        nodes.push_back(found->second);
      }
      if (!kind) return;
      MeshCell cell = mesh_cell(*kind, nodes, fmt::format("{}: element {}", place, number), data_);
      const int dimension = kind->shape == MeshShape::line         ? 1
                            : kind->shape < MeshShape::tetrahedron ? 2
                                                                   : 3;
      if (const long group = group_in(dimension)) {
        const auto name = names_.find({dimension, group});
        cell.group = name != names_.end() ? name->second : fmt::format("{}", group);
      }
      data_.cells.push_back(std::move(cell));
    } catch (const InputError& error) {
      const std::string what = error.what();
      what.starts_with(name_) ? throw : refuse(what);
    }
  }

  static constexpr long most_ = 1'000'000'000;
  const std::string& name_;
  MshNumbers numbers_;
  MeshText& text_ = numbers_.text();
  int version_ = 0;
  std::map<Tag, std::string> names_;
  std::map<Tag, long> group_;  ///< [entity] its first physical group
  std::unordered_map<long, Index> number_;
  MeshData data_;
};

}  // namespace

MeshData read_msh(std::string_view text, const std::string& name) {
  return MshReader(text, name).read();
}

}  // namespace meniscus
