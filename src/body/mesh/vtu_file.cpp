// SPDX-License-Identifier: BSD-3-Clause
// Unstructured grids of VTK as XML. Numbers are text, base64 in place, or appended bytes. Source:
// VTK file formats, section "XML File Formats".
#include "body/mesh/mesh_cells.hpp"
#include "body/mesh/mesh_text.hpp"
#include "body/mesh/vtk_numbers.hpp"
#include "body/mesh/xml_scanner.hpp"
#include "body/shapes/cell_count.hpp"
#include "meniscus/error.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <optional>

namespace meniscus {
namespace {

using Attributes = std::map<std::string, std::string>;

std::string attribute_of(const Attributes& attributes, const char* key, const char* fallback = "") {
  const auto found = attributes.find(key);
  return found == attributes.end() ? fallback : found->second;
}

/// An array of a file: its tag, and its text without the text of child elements.
struct XmlArray {
  Attributes attributes;
  std::string_view content;
  int line;
};

bool only_space(std::string_view text) {
  return text.find_first_not_of(" \t\r\n") == text.npos;
}

class VtuReader {
 public:
  VtuReader(std::string_view text, const std::string& name) : xml_(text, name), name_(name) {}

  MeshData read() {
    scan();
    if (!grid_) fail("is no UnstructuredGrid; expected is a .vtu file");
    require_memory(100.0 * static_cast<Real>(points_) + 400.0 * static_cast<Real>(cells_),
                   fmt::format("{}: the mesh has {} points and {} cells", name_, points_, cells_));
    MeshData data;
    const std::vector<Real> X = numbers<Real>(array("Points", ""), 3 * points_);
    for (std::size_t i = 0; i < X.size(); i += 3) data.X.emplace_back(X[i], X[i + 1], X[i + 2]);
    const auto types = numbers<std::int64_t>(array("Cells", "types"), cells_),
               ends = numbers<std::int64_t>(array("Cells", "offsets"), cells_);
    const std::int64_t corners = ends.empty() ? 0 : ends.back();
    constexpr std::int64_t most_per_cell = 1000;
    if (corners < 0 || corners > most_per_cell * cells_)
      fail(
          fmt::format("the offsets of {} cells end with {}; expected are at most {} nodes for each",
                      cells_, corners, most_per_cell),
          array("Cells", "offsets").line);
    const auto nodes = numbers<std::int64_t>(array("Cells", "connectivity"), corners);
    for (std::size_t c = 0; c < types.size(); ++c) add_cell(c, types[c], ends, nodes, data);
    return data;
  }

 private:
  [[noreturn]] void fail(const std::string& what, int line = 0) const {
    if (line > 0) xml_.fail(what, line);
    throw InputError(fmt::format("{}: {}", name_, what));
  }

  std::int64_t count_of(const Attributes& attributes, const char* key, int line) const {
    const auto found = attributes.find(key);
    if (found == attributes.end()) fail(fmt::format("{} is missing in Piece", key), line);
    MeshText number(found->second, name_, line);
    return number.integer(key, 0, 1'000'000'000);
  }

  /// Scans the elements of the file up to the appended bytes, and remembers the arrays of the mesh.
  void scan() {
    std::string section;
    XmlArray* array = nullptr;  // the array whose element is open
    std::size_t depth_of_array = 0;
    for (XmlPiece piece = xml_.next(); piece.kind != XmlPiece::Kind::end; piece = xml_.next()) {
      if (piece.kind == XmlPiece::Kind::open && piece.name == "AppendedData") {
        note_appended(piece);
        return;
      }
      if (piece.kind == XmlPiece::Kind::open && !array) {
        note_element(piece, section);
        if (piece.name == "DataArray" && (section == "Points" || section == "Cells")) {
          array = &add_array(piece, section);
          depth_of_array = xml_.depth();
        }
      } else if (piece.kind == XmlPiece::Kind::close && array && xml_.depth() < depth_of_array) {
        array = nullptr;
      } else if (piece.kind == XmlPiece::Kind::text && array && xml_.depth() == depth_of_array &&
                 !only_space(piece.content)) {
        if (!array->content.empty())
          fail("the numbers of an array are interrupted; expected are all of them in one place",
               piece.line);
        array->content = piece.content;
        array->line = piece.line;
      }
    }
  }

  void note_element(const XmlPiece& tag, std::string& section) {
    if (tag.name == "VTKFile") {
      file_ = xml_.attributes(tag);
      require_readable(tag.line);
    } else if (tag.name == "UnstructuredGrid") {
      grid_ = true;
    } else if (tag.name == "Piece") {
      if (points_ > 0) fail("there is a second Piece; expected is one mesh", tag.line);
      const Attributes attributes = xml_.attributes(tag);
      points_ = count_of(attributes, "NumberOfPoints", tag.line);
      cells_ = count_of(attributes, "NumberOfCells", tag.line);
    } else if (tag.name != "DataArray") {
      section = tag.name;
    }
  }

  XmlArray& add_array(const XmlPiece& tag, const std::string& section) {
    Attributes attributes = xml_.attributes(tag);
    const std::string name = section == "Points" ? "" : attribute_of(attributes, "Name");
    const auto [added, is_new] =
        arrays_.try_emplace({section, name}, XmlArray{std::move(attributes), {}, tag.line});
    if (!is_new)
      fail(fmt::format("the array {} {} is there twice", section, MeshText::shown(name)), tag.line);
    return added->second;
  }

  /// Finds the appended bytes, which begin behind an underscore.
  void note_appended(const XmlPiece& tag) {
    const std::string encoding = attribute_of(xml_.attributes(tag), "encoding", "base64");
    if (encoding != "raw" && encoding != "base64")
      fail(fmt::format("the appended data have the encoding '{}'; expected is raw or base64",
                       MeshText::shown(encoding)),
           tag.line);
    appended_base64_ = encoding == "base64";
    const std::size_t mark = xml_.rest().find('_');
    if (mark == std::string_view::npos || !only_space(xml_.rest().substr(0, mark)))
      fail("the appended data do not begin; expected is an underscore", tag.line);
    appended_ = xml_.rest().substr(mark + 1);
  }

  void require_readable(int line) {
    if (const std::string type = attribute_of(file_, "type", "UnstructuredGrid");
        type != "UnstructuredGrid")
      fail("is of type '" + MeshText::shown(type) + "'; expected is UnstructuredGrid");
    if (const std::string order = attribute_of(file_, "byte_order", "LittleEndian");
        order != "LittleEndian")
      fail("has byte_order '" + MeshText::shown(order) + "'; expected is LittleEndian");
    const std::string header = attribute_of(file_, "header_type", "UInt32");
    if (header != "UInt32" && header != "UInt64")
      fail(
          fmt::format("header_type is '{}'; expected is UInt32 or UInt64", MeshText::shown(header)),
          line);
    storage_.header_bytes = header == "UInt64" ? 8 : 4;
    storage_.compressed = !attribute_of(file_, "compressor").empty();
  }

  const XmlArray& array(const std::string& section, const std::string& name) const {
    const auto found = arrays_.find({section, name});
    if (found == arrays_.end())
      fail(fmt::format("the array {}{}{} is missing; expected is one", section,
                       name.empty() ? "" : " ", name));
    return found->second;
  }

  template <class T>
  std::vector<T> numbers(const XmlArray& array, std::int64_t count) const {
    const std::string format = attribute_of(array.attributes, "format", "ascii");
    if (format == "ascii") return numbers_of_text<T>(array, count);
    if (format != "binary" && format != "appended")
      fail(fmt::format("the format is '{}'; expected is ascii, binary or appended",
                       MeshText::shown(format)),
           array.line);
    const std::string compressor = attribute_of(file_, "compressor");
    if (storage_.compressed && compressor != "vtkZLibDataCompressor")
      fail(
          fmt::format("is compressed by '{}'; expected is vtkZLibDataCompressor (ParaView: "
                      "Compressor Type ZLib; meshio: compression=\"zlib\") or no compression",
                      MeshText::shown(compressor)));
    const bool in_place = format == "binary";
    VtkBytes bytes(in_place ? array.content : appended_of(array), in_place || appended_base64_);
    try {
      std::vector<T> values = stored<T>(bytes, array, count);
      if (in_place && !bytes.ended()) throw InputError("the array has more bytes than it says");
      return values;
    } catch (const InputError& error) {
      fail(error.what(), array.line);
    }
  }

  template <class T>
  std::vector<T> numbers_of_text(const XmlArray& array, std::int64_t count) const {
    std::vector<T> values;
    MeshText text(array.content, name_, array.line);
    while (std::ssize(values) <= count && !text.ended())
      if constexpr (std::is_same_v<T, Real>)
        values.push_back(text.real("a number"));
      else
        values.push_back(text.integer("an integer"));
    if (std::ssize(values) != count)
      fail(fmt::format("the array has {}{} numbers; expected are {}",
                       std::ssize(values) > count ? "more than " : "",
                       std::min<std::int64_t>(std::ssize(values), count), count),
           array.line);
    return values;
  }

  std::string_view appended_of(const XmlArray& array) const {
    const std::string text = attribute_of(array.attributes, "offset", "none");
    MeshText number(text, name_, array.line);
    const auto offset = static_cast<std::size_t>(number.integer("an offset, at least 0", 0));
    if (offset > appended_.size())
      fail(fmt::format("the offset {} is behind the end of the {} appended bytes", offset,
                       appended_.size()),
           array.line);
    return appended_.substr(offset);
  }

  template <class T, class Stored>
  std::vector<T> converted(VtkBytes& bytes, std::int64_t count) const {
    const auto size = static_cast<std::uint64_t>(count) * sizeof(Stored);
    const std::string data = read_stored(bytes, size, storage_);
    std::vector<T> values(static_cast<std::size_t>(count));
    for (std::size_t i = 0; i < values.size(); ++i) {
      Stored number;
      std::memcpy(&number, data.data() + i * sizeof(Stored), sizeof(Stored));
      values[i] = static_cast<T>(number);
      if constexpr (std::is_same_v<T, Real>)
        if (!std::isfinite(values[i]))
          throw InputError("a coordinate is not finite; expected are numbers");
    }
    return values;
  }

  template <class T>
  std::vector<T> stored(VtkBytes& bytes, const XmlArray& array, std::int64_t count) const {
    const std::string type = attribute_of(array.attributes, "type");
    if constexpr (std::is_same_v<T, Real>) {
      if (type == "Float64") return converted<T, double>(bytes, count);
      if (type == "Float32") return converted<T, float>(bytes, count);
      throw InputError(fmt::format("numbers of type '{}'; expected is Float32 or Float64",
                                   MeshText::shown(type)));
    } else {
      if (type == "Int64") return converted<T, std::int64_t>(bytes, count);
      if (type == "UInt64") return converted<T, std::uint64_t>(bytes, count);
      if (type == "Int32") return converted<T, std::int32_t>(bytes, count);
      if (type == "UInt32") return converted<T, std::uint32_t>(bytes, count);
      if (type == "UInt8") return converted<T, std::uint8_t>(bytes, count);
      if (type == "Int8") return converted<T, std::int8_t>(bytes, count);
      throw InputError(
          fmt::format("numbers of type '{}'; expected are integers of 8, 32 or 64 "
                      "bits",
                      MeshText::shown(type)));
    }
  }

  void add_cell(std::size_t c, std::int64_t type, const std::vector<std::int64_t>& ends,
                const std::vector<std::int64_t>& nodes, MeshData& data) const {
    const std::string where = fmt::format("cell {}", c);
    try {
      const std::optional<MeshKind> kind = vtk_kind(type);
      const std::int64_t begin = c == 0 ? 0 : ends[c - 1], count = ends[c] - begin;
      if (begin < 0 || count < 0 || ends[c] > std::ssize(nodes))
        throw InputError(
            "has an offset that is less than the one before, or beyond the array; "
            "expected are ascending offsets");
      if (!kind) return;
      if (count != kind->nodes)
        throw InputError(fmt::format("has {} nodes; expected are {}", count, kind->nodes));
      std::vector<Index> own;
      for (std::int64_t k = begin; k < ends[c]; ++k) {
        const std::int64_t node = nodes[static_cast<std::size_t>(k)];
        if (node < 0 || node >= std::ssize(data.X))
          throw InputError(fmt::format("has the node {}; expected are nodes from 0 to {}", node,
                                       std::ssize(data.X) - 1));
        own.push_back(static_cast<Index>(node));
      }
      data.cells.push_back(mesh_cell(*kind, own, where, data));
    } catch (const InputError& error) {
      fail(where + " " + error.what());
    }
  }

  XmlScanner xml_;
  const std::string& name_;
  VtkStorage storage_;
  std::string_view appended_;  ///< appended bytes, from the underscore on
  bool appended_base64_ = false;
  bool grid_ = false;
  std::int64_t points_ = 0, cells_ = 0;
  Attributes file_;
  std::map<std::pair<std::string, std::string>, XmlArray> arrays_;
};

}  // namespace

MeshData read_vtu(std::string_view text, const std::string& name) {
  return VtuReader(text, name).read();
}

}  // namespace meniscus
