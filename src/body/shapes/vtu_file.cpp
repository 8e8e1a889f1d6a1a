// SPDX-License-Identifier: BSD-3-Clause
// Meshes of VTK: unstructured grids as XML, with their numbers as text or as base64 in place.
// Source: VTK file formats, section "XML File Formats".
#include "meniscus/core/error.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>

#include "mesh_cells.hpp"
#include "mesh_text.hpp"

namespace meniscus {
namespace {

/// An array of a file: its tag, and what stands behind it.
struct XmlArray {
  std::map<std::string, std::string> attributes;
  std::string_view content;
  int line;
};

class VtuReader {
 public:
  VtuReader(std::string_view text, const std::string& name) : text_(text), name_(name) {}

  MeshData read() {
    scan();
    if (!grid_) fail("is no UnstructuredGrid; expected is a .vtu file");
    MeshData data;
    const std::vector<Real> X = numbers<Real>(array("Points", ""), 3 * points_);
    for (std::size_t i = 0; i < X.size(); i += 3) data.X.emplace_back(X[i], X[i + 1], X[i + 2]);
    const auto types = numbers<std::int64_t>(array("Cells", "types"), cells_),
               ends = numbers<std::int64_t>(array("Cells", "offsets"), cells_);
    const auto nodes = numbers<std::int64_t>(
        array("Cells", "connectivity"), ends.empty() ? 0 : std::max<std::int64_t>(ends.back(), 0));
    for (std::size_t c = 0; c < types.size(); ++c) add_cell(c, types[c], ends, nodes, data);
    return data;
  }

 private:
  [[noreturn]] void fail(const std::string& what, int line = 0) const {
    throw InputError(line > 0 ? fmt::format("{}: line {}: {}", name_, line, what)
                              : fmt::format("{}: {}", name_, what));
  }

  int line_of(std::size_t place) const {
    return 1 + static_cast<int>(std::count(
                   text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(place), '\n'));
  }

  static std::map<std::string, std::string> attributes_of(std::string_view tag) {
    std::map<std::string, std::string> found;
    for (std::size_t equals = tag.find('='); equals != tag.npos; equals = tag.find('=', equals)) {
      std::size_t end = equals;
      while (end > 0 && tag[end - 1] == ' ') --end;
      std::size_t begin = end;
      while (begin > 0 && tag[begin - 1] != ' ' && tag[begin - 1] != '\n' && tag[begin - 1] != '\t')
        --begin;
      const std::size_t open = tag.find_first_of("\"'", equals);
      const std::size_t close = open == tag.npos ? open : tag.find(tag[open], open + 1);
      if (close == tag.npos) return found;
      found.emplace(tag.substr(begin, end - begin), tag.substr(open + 1, close - open - 1));
      equals = close;
    }
    return found;
  }

  std::int64_t count_of(const std::map<std::string, std::string>& attributes, const char* key,
                        int line) const {
    const auto found = attributes.find(key);
    if (found == attributes.end()) fail(fmt::format("{} is missing in Piece", key), line);
    MeshText number(found->second, name_, line);
    return number.integer(key, 0, 1'000'000'000);
  }

  /// Notes what is needed of the tags.
  void scan() {
    std::string section;
    for (std::size_t open = text_.find('<'); open != text_.npos; open = text_.find('<', open + 1)) {
      if (text_.substr(open).starts_with("<!--")) {
        open = text_.find("-->", open);
        if (open == text_.npos) fail("a comment does not end; expected is -->");
        continue;
      }
      const std::size_t close = text_.find('>', open);
      if (close == text_.npos) fail("a tag does not end; expected is >", line_of(open));
      const std::string_view tag = text_.substr(open + 1, close - open - 1);
      const std::string kind(tag.substr(0, tag.find_first_of(" \t\r\n/", 1)));
      if (kind == "VTKFile") {
        file_ = attributes_of(tag);
        require_plain();
      } else if (kind == "UnstructuredGrid") {
        grid_ = true;
      } else if (kind == "AppendedData") {
        break;
      } else if (kind == "Piece") {
        const auto attributes = attributes_of(tag);
        const int line = line_of(open);
        if (points_ > 0) fail("there is a second Piece; expected is one mesh", line);
        points_ = count_of(attributes, "NumberOfPoints", line);
        cells_ = count_of(attributes, "NumberOfCells", line);
      } else if (kind == "Points" || kind == "Cells" || kind == "PointData" || kind == "CellData" ||
                 kind == "FieldData") {
        section = kind;
      } else if (kind == "DataArray" && (section == "Points" || section == "Cells")) {
        XmlArray array{attributes_of(tag), {}, line_of(open)};
        const std::size_t end = text_.find("</DataArray", close);
        if (!tag.ends_with('/') && end != text_.npos)
          array.content = text_.substr(close + 1, end - close - 1);
        else if (!tag.ends_with('/'))
          fail("a DataArray does not end; expected is </DataArray>", array.line);
        arrays_[{section, section == "Points" ? "" : array.attributes["Name"]}] = array;
      }
    }
  }

  void require_plain() const {
    const auto has = [&](const char* key) { return file_.find(key) != file_.end(); };
    if (has("type") && file_.at("type") != "UnstructuredGrid")
      fail("is of type '" + file_.at("type") + "'; expected is UnstructuredGrid");
    if (has("compressor"))
      fail(
          "is compressed; expected is a file without compression (ParaView: Compressor Type None; "
          "meshio: compression=None)");
    if (has("byte_order") && file_.at("byte_order") != "LittleEndian")
      fail("has byte_order '" + file_.at("byte_order") + "'; expected is LittleEndian");
  }

  const XmlArray& array(const std::string& section, const std::string& name) const {
    const auto found = arrays_.find({section, name});
    if (found == arrays_.end())
      fail(fmt::format("the array {}{}{} is missing; expected is one", section,
                       name.empty() ? "" : " ", name));
    return found->second;
  }

  static std::string attribute(const XmlArray& array, const char* key, const char* fallback) {
    const auto found = array.attributes.find(key);
    return found == array.attributes.end() ? fallback : found->second;
  }

  template <class T>
  std::vector<T> numbers(const XmlArray& array, std::int64_t count) const {
    const std::string format = attribute(array, "format", "ascii");
    std::vector<T> values;
    if (format == "ascii") {
      MeshText text(array.content, name_, array.line);
      while (static_cast<std::int64_t>(values.size()) <= count && !text.ended())
        if constexpr (std::is_same_v<T, Real>)
          values.push_back(text.real("a number"));
        else
          values.push_back(text.integer("an integer"));
    } else if (format == "binary") {
      values = decoded<T>(array);
    } else {
      fail(fmt::format("the format is '{}'; expected is ascii or binary, with the numbers in place "
                       "(ParaView: Data Mode Ascii or Binary)",
                       format),
           array.line);
    }
    if (static_cast<std::int64_t>(values.size()) != count)
      fail(fmt::format("the array has {}{} numbers; expected are {}",
                       static_cast<std::int64_t>(values.size()) > count ? "more than " : "",
                       std::min<std::int64_t>(std::ssize(values), count), count),
           array.line);
    return values;
  }

  /// Of base64, four characters at a time: where one part ends with =, another may begin.
  std::string bytes_of(const XmlArray& array) const {
    std::string bytes;
    std::uint32_t bits = 0;
    int count = 0, padding = 0;
    for (const char c : array.content) {
      if (c == ' ' || c == '\n' || c == '\r' || c == '\t') continue;
      const int value = c >= 'A' && c <= 'Z'   ? c - 'A'
                        : c >= 'a' && c <= 'z' ? c - 'a' + 26
                        : c >= '0' && c <= '9' ? c - '0' + 52
                        : c == '+'             ? 62
                        : c == '/'             ? 63
                        : c == '='             ? 0
                                               : -1;
      if (value < 0)
        fail("the numbers are not in base64; expected are A-Z a-z 0-9 + / =", array.line);
      padding += c == '=';
      bits = bits << 6 | static_cast<std::uint32_t>(value);
      if (++count < 4) continue;
      for (int k = 0; k < 3 - padding; ++k) bytes += static_cast<char>(bits >> (16 - 8 * k) & 255);
      bits = 0;
      count = padding = 0;
    }
    if (count != 0) fail("the numbers in base64 end too early", array.line);
    return bytes;
  }

  template <class T, class Stored>
  static std::vector<T> converted(std::string_view bytes) {
    std::vector<T> values(bytes.size() / sizeof(Stored));
    for (std::size_t i = 0; i < values.size(); ++i) {
      Stored stored;
      std::memcpy(&stored, bytes.data() + i * sizeof(Stored), sizeof(Stored));
      values[i] = static_cast<T>(stored);
    }
    return values;
  }

  template <class T>
  std::vector<T> decoded(const XmlArray& array) const {
    static_assert(std::endian::native == std::endian::little);
    const std::string bytes = bytes_of(array);
    const auto header = file_.find("header_type");
    const std::size_t size = header != file_.end() && header->second == "UInt64" ? 8 : 4;
    std::uint64_t length = 0;
    if (bytes.size() < size) fail("the numbers in base64 end too early", array.line);
    std::memcpy(&length, bytes.data(), size);
    if (length != bytes.size() - size)
      fail(fmt::format("the array has {} bytes, but says that it has {}", bytes.size() - size,
                       length),
           array.line);
    const std::string_view data = std::string_view(bytes).substr(size);
    const std::string type = attribute(array, "type", "");
    if constexpr (std::is_same_v<T, Real>) {
      if (type == "Float64") return finite(converted<T, double>(data), array);
      if (type == "Float32") return finite(converted<T, float>(data), array);
      fail(fmt::format("numbers of type '{}'; expected is Float32 or Float64", type), array.line);
    } else {
      if (type == "Int64") return converted<T, std::int64_t>(data);
      if (type == "UInt64") return converted<T, std::uint64_t>(data);
      if (type == "Int32") return converted<T, std::int32_t>(data);
      if (type == "UInt32") return converted<T, std::uint32_t>(data);
      if (type == "UInt8") return converted<T, std::uint8_t>(data);
      if (type == "Int8") return converted<T, std::int8_t>(data);
      fail(fmt::format("numbers of type '{}'; expected are integers of 8, 32 or 64 bits", type),
           array.line);
    }
  }

  std::vector<Real> finite(std::vector<Real> values, const XmlArray& array) const {
    for (const Real value : values)
      if (!std::isfinite(value))
        fail("a coordinate is not finite; expected are numbers", array.line);
    return values;
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

  std::string_view text_;
  std::string name_;
  bool grid_ = false;
  std::int64_t points_ = 0, cells_ = 0;
  std::map<std::string, std::string> file_;
  std::map<std::pair<std::string, std::string>, XmlArray> arrays_;
};

}  // namespace

MeshData read_vtu(std::string_view text, const std::string& name) {
  return VtuReader(text, name).read();
}

}  // namespace meniscus
