// SPDX-License-Identifier: BSD-3-Clause
// VTK files: as written by VTK, with appended bytes, with compression, and refused files.
#include "body/mesh/mesh_file.hpp"
#include "files_of_vtk.hpp"
#include "meniscus/error.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <chrono>
#include <cstdint>
#include <cstring>
#include <random>

namespace meniscus::test_vtu_files {
namespace {

std::string problem_of(const std::string& text) {
  try {
    read_vtu(text, "x.vtu");
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

std::string changed(std::string text, const std::string& from, const std::string& to) {
  const std::size_t place = text.find(from);
  EXPECT_NE(place, text.npos) << from;
  return text.replace(place, from.size(), to);
}

void expect_square(const std::string& text) {
  const MeshData data = read_vtu(text, "x.vtu");
  ASSERT_EQ(data.X.size(), 6u);
  for (int i = 0; i < 6; ++i)
    EXPECT_EQ(data.X[static_cast<std::size_t>(i)], Eigen::Vector3d(i % 3, i / 3, 0)) << i;
  ASSERT_EQ(data.cells.size(), 2u);
  EXPECT_EQ(data.cells[0].corners, (std::vector<Index>{0, 1, 4, 3}));
  EXPECT_EQ(data.cells[1].corners, (std::vector<Index>{1, 2, 5, 4}));
}

TEST(VtuFiles, AreReadAsVtkWritesThem) {
  for (const std::string& text : {test::vtk_ascii, test::vtk_binary, test::vtk_appended})
    expect_square(text);
}

template <class T>
std::string bytes_of(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

/// How an array is stored: with 64-bit sizes if `wide`, compressed in blocks of `block` bytes, or
/// uncompressed if `block` is 0.
struct Stored {
  bool wide = false;
  std::uint64_t block = 0;
};

std::string header(const std::vector<std::uint64_t>& numbers, bool wide) {
  std::string bytes;
  for (const std::uint64_t number : numbers)
    bytes.append(reinterpret_cast<const char*>(&number), wide ? 8 : 4);
  return bytes;
}

std::string compressed(const std::string& data) {
  uLongf size = compressBound(data.size());
  std::string result(size, '\0');
  EXPECT_EQ(compress(reinterpret_cast<Bytef*>(result.data()), &size,
                     reinterpret_cast<const Bytef*>(data.data()), data.size()),
            Z_OK);
  result.resize(size);
  return result;
}

std::string stored(const std::string& data, const Stored& how) {
  if (how.block == 0) return header({data.size()}, how.wide) + data;
  std::vector<std::uint64_t> numbers{(data.size() + how.block - 1) / how.block, how.block,
                                     data.size() % how.block};
  std::string blocks;
  for (std::size_t begin = 0; begin < data.size(); begin += how.block) {
    const std::string block = compressed(data.substr(begin, how.block));
    numbers.push_back(block.size());
    blocks += block;
  }
  return header(numbers, how.wide) + blocks;
}

/// A file with appended raw bytes.
std::string raw_file(const std::string& points, const std::string& nodes, const std::string& ends,
                     const std::string& types, const Stored& how, const std::string& count = "6") {
  const auto array = [](const std::string& name, const std::string& type, std::size_t offset) {
    return fmt::format("<DataArray type='{}' Name='{}' format='appended' offset='{}'/>", type, name,
                       offset);
  };
  return fmt::format(
             "<VTKFile type='UnstructuredGrid' byte_order='LittleEndian' header_type='{}'{}>"
             "<UnstructuredGrid><Piece NumberOfPoints='{}' NumberOfCells='2'><Points>{}</Points>"
             "<Cells>{}{}{}</Cells></Piece></UnstructuredGrid>"
             "<AppendedData encoding='raw'>\n  _",
             how.wide ? "UInt64" : "UInt32", how.block ? " compressor='vtkZLibDataCompressor'" : "",
             count, array("Points", "Float64", 0), array("connectivity", "Int64", points.size()),
             array("offsets", "Int64", points.size() + nodes.size()),
             array("types", "UInt8", points.size() + nodes.size() + ends.size())) +
         points + nodes + ends + types + "\n</AppendedData></VTKFile>\n";
}

std::string raw_square(const Stored& how) {
  return raw_file(
      stored(bytes_of<double>({0, 0, 0, 1, 0, 0, 2, 0, 0, 0, 1, 0, 1, 1, 0, 2, 1, 0}), how),
      stored(bytes_of<std::int64_t>({0, 1, 4, 3, 1, 2, 5, 4}), how),
      stored(bytes_of<std::int64_t>({4, 8}), how), stored(bytes_of<std::uint8_t>({9, 9}), how),
      how);
}

TEST(VtuFiles, AppendedBytesAreReadCompressedOrNot) {
  for (const bool wide : {false, true})
    for (const std::uint64_t block : {0, 8, 50, 144, 10000}) {
      SCOPED_TRACE(fmt::format("{} {}", wide, block));
      expect_square(raw_square({wide, block}));
    }
}

TEST(VtuFiles, SayWhatIsWrong) {
  const auto expect = [](const std::string& found, const std::string& words) {
    EXPECT_NE(found.find(words), found.npos) << found << "\nshould say: " << words;
    EXPECT_EQ(std::count(found.begin(), found.end(), '\n'), 0) << found;
  };
  const auto ascii = [&](const std::string& from, const std::string& to) {
    return problem_of(changed(test::vtk_ascii, from, to));
  };
  expect(problem_of(changed(test::vtk_binary, "ZLib", "LZ4")),
         "is compressed by 'vtkLZ4DataCompressor'; expected is vtkZLibDataCompressor");
  expect_square(changed(test::vtk_ascii, "ZLib", "LZ4"));  // not used there
  expect(ascii("UInt32", "UInt16"), "line 2: header_type is 'UInt16'; expected is UInt32");
  expect(ascii("0 0 0 1 0 0\n", "0 0 0 1 0 0 <x/>\n"), "the numbers of an array are interrupted");
  expect(ascii("</Cells>", "</Points>"), "</Points> closes nothing; expected is </Cells>");
  expect(ascii("</Cells>", "</Cells"), "line 48: a tag does not end; expected is >");
  expect(ascii("</VTKFile>", ""), "the file ends in <VTKFile>; expected is </VTKFile>");
  expect(ascii("RangeMin=\"0\"", "RangeMin=\"0"), "line 6: a tag does not end; expected is >");
  expect(ascii("NumberOfPoints=\"6\"", "NumberOfPoints=6"),
         "line 4: an attribute of <Piece> is not");
  expect(ascii("<?xml", "<!DOCTYPE x [<!ENTITY a \"b\">]><?xml"), "a declaration <! is not read");
  expect(ascii("<CellData>", "<!-- <CellData>"), "a comment does not end; expected is -->");
  const std::string raw = raw_square({false, 0}), zip = raw_square({false, 50});
  expect(problem_of(changed(raw, "offset='0'", "offset='4000'")),
         "the offset 4000 is behind the end of the ");
  expect(problem_of(changed(raw, "offset='0'", "offset='-1'")), "-1 is out of range");
  expect(problem_of(raw.substr(0, raw.size() - 28)), "the numbers end too early");
  expect(problem_of(changed(raw, "raw", "hex")), "encoding 'hex'; expected is raw or base64");
  expect(problem_of(changed(raw, "\n  _", "\n  -")), "do not begin; expected is an underscore");
  expect(problem_of(changed(raw, "'6'", "'5'")),
         "the array says that it has 144 bytes; expected are 120");
  std::string damaged = zip;
  damaged[zip.find("\n  _") + 60] ^= 32;
  expect(problem_of(damaged), "a compressed block is damaged");
}

/// Small files that claim, or decompress to, more than the memory holds.
TEST(VtuFiles, BombsAreRefused) {
  const std::string nodes = stored(bytes_of<std::int64_t>({0, 1, 4, 3, 1, 2, 5, 4}), {true, 64}),
                    ends = stored(bytes_of<std::int64_t>({4, 8}), {true, 64}),
                    types = stored(bytes_of<std::uint8_t>({9, 9}), {true, 64});
  // Claims 2.4e10 bytes in a block of a few bytes.
  const std::string block = compressed(std::string(1000, '\0'));
  const std::string claims = header({1, 24'000'000'000, 0, block.size()}, true) + block;
  EXPECT_NE(problem_of(raw_file(claims, nodes, ends, types, {true, 64}, "1000000000"))
                .find("the mesh has 1000000000 points and 2 cells and take about"),
            std::string::npos);
  const std::string smaller = header({1, 24'000'000, 0, block.size()}, true) + block;
  EXPECT_NE(problem_of(raw_file(smaller, nodes, ends, types, {true, 64}, "1000000"))
                .find("bytes says that it becomes 24000000; zlib makes 1032 of one at most"),
            std::string::npos);
  const std::string more = header({1, 144, 0, block.size()}, true) + block;
  EXPECT_NE(problem_of(raw_file(more, nodes, ends, types, {true, 64}))
                .find("a compressed block is damaged, or has another size"),
            std::string::npos);
  const std::string many = header({~std::uint64_t{0}, 0, 144}, true);
  EXPECT_NE(problem_of(raw_file(many, nodes, ends, types, {true, 64})).find("end too early"),
            std::string::npos);
}

/// Reading takes time proportional to the number of elements, not to its square.
TEST(VtuFiles, AreReadInLinearTime) {
  std::string text = "<VTKFile><UnstructuredGrid><Piece NumberOfPoints='0' NumberOfCells='0'>";
  for (int k = 0; k < 200'000; ++k) text += "<DataArray/>\n";
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_NE(problem_of(text).find("line 200001: the file ends in <Piece>"), std::string::npos);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(2));
}

TEST(VtuFiles, DamagedOnesAreRefusedOrRead) {
  std::mt19937 random(6);
  for (const std::string& text : {test::vtk_ascii, test::vtk_binary, test::vtk_appended,
                                  raw_square({true, 0}), raw_square({false, 50})})
    for (int k = 0; k < 2000; ++k) {
      std::string other = text;
      for (int changes = 1 + static_cast<int>(random() % 3); changes > 0 && !other.empty();
           --changes) {
        const std::size_t place = random() % other.size();
        switch (random() % 5) {
          case 0:
            other[place] = static_cast<char>(random() % 256);
            break;
          case 1:
            other[place] = static_cast<char>('0' + random() % 10);
            break;
          case 2:
            other.erase(place, random() % 20);
            break;
          case 3:
            other.resize(place);
            break;
          default:
            other.insert(place, other.substr(random() % other.size(), random() % 30));
        }
      }
      problem_of(other);
    }
}

}  // namespace
}  // namespace meniscus::test_vtu_files
