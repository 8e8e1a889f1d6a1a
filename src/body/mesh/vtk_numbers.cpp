// SPDX-License-Identifier: BSD-3-Clause
// Decodes base64, and arrays that zlib has compressed in blocks.
#include "body/mesh/vtk_numbers.hpp"

#include "meniscus/error.hpp"

#include <fmt/core.h>
#include <zlib.h>

#include <bit>
#include <cstring>
#include <utility>
#include <vector>

namespace meniscus {
namespace {

int value_of_letter(char c) {
  return c >= 'A' && c <= 'Z'   ? c - 'A'
         : c >= 'a' && c <= 'z' ? c - 'a' + 26
         : c >= '0' && c <= '9' ? c - '0' + 52
         : c == '+'             ? 62
         : c == '/'             ? 63
                                : -1;
}

bool is_space_between_letters(char c) {
  return c == ' ' || c == '\n' || c == '\r' || c == '\t';
}

[[noreturn]] void fail_at_end() {
  throw InputError("the numbers end too early");
}

std::uint64_t header_number(VtkBytes& bytes, const VtkStorage& storage) {
  static_assert(std::endian::native == std::endian::little);
  std::uint64_t number = 0;
  std::memcpy(&number, bytes.read(static_cast<std::uint64_t>(storage.header_bytes)).data(),
              static_cast<std::size_t>(storage.header_bytes));
  return number;
}

void require_expected(std::uint64_t said, std::uint64_t expected) {
  if (said != expected)
    throw InputError(
        fmt::format("the array says that it has {} bytes; expected are {}", said, expected));
}

/// Decompresses a block and appends its `size` bytes to `data`.
void add_inflated(const std::string& compressed, std::uint64_t size, std::string& data) {
  // zlib enlarges a block at most 1032 times: a damaged size is refused before memory is reserved.
  if (size / 1032 > compressed.size())
    throw InputError(
        fmt::format("a block of {} bytes says that it becomes {}; zlib makes 1032 of one at most",
                    compressed.size(), size));
  const std::size_t begin = data.size();
  data.resize(begin + size);
  uLongf length = size;
  const int status =
      uncompress(reinterpret_cast<Bytef*>(data.data() + begin), &length,
                 reinterpret_cast<const Bytef*>(compressed.data()), compressed.size());
  if (status != Z_OK || length != size)
    throw InputError("a compressed block is damaged, or has another size than its header says");
}

std::string read_compressed(VtkBytes& bytes, std::uint64_t expected, const VtkStorage& storage) {
  const std::uint64_t blocks = header_number(bytes, storage),
                      block_size = header_number(bytes, storage),
                      last_size = header_number(bytes, storage);
  // A last size of 0 means that the last block has full size.
  const std::uint64_t last = last_size > 0 ? last_size : block_size;
  if (blocks > 0 && block_size > 0 && blocks - 1 > expected / block_size)
    throw InputError(fmt::format(
        "the array says that it has {} blocks of {} bytes; expected are {} bytes in all", blocks,
        block_size, expected));
  require_expected(blocks == 0 ? 0 : (blocks - 1) * block_size + last, expected);
  std::vector<std::uint64_t> sizes;
  for (std::uint64_t b = 0; b < blocks; ++b) sizes.push_back(header_number(bytes, storage));
  std::string data;
  for (std::uint64_t b = 0; b < blocks; ++b)
    add_inflated(bytes.read(sizes[b]), b + 1 < blocks ? block_size : last, data);
  return data;
}

}  // namespace

/// Decodes four letters. After padding (=) a new base64 text may begin.
void VtkBytes::decode_four_letters() {
  std::uint32_t bits = 0;
  int count = 0, padding = 0;
  while (count < 4) {
    if (text_.empty()) fail_at_end();
    const char c = text_.front();
    text_.remove_prefix(1);
    if (is_space_between_letters(c)) continue;
    const int value = c == '=' ? 0 : value_of_letter(c);
    if (value < 0)
      throw InputError("the numbers are not in base64; expected are A-Z a-z 0-9 + / =");
    padding += c == '=';
    bits = bits << 6 | static_cast<std::uint32_t>(value);
    ++count;
  }
  for (int k = 0; k < 3 - padding; ++k) decoded_ += static_cast<char>(bits >> (16 - 8 * k) & 255);
}

std::string VtkBytes::read(std::uint64_t count) {
  if (!base64_) {
    if (count > text_.size()) fail_at_end();
    std::string bytes(text_.substr(0, count));
    text_.remove_prefix(count);
    return bytes;
  }
  if (count > 3 + text_.size()) fail_at_end();
  while (decoded_.size() < count) decode_four_letters();
  std::string bytes = std::move(decoded_);
  decoded_ = bytes.substr(count);
  bytes.resize(count);
  return bytes;
}

bool VtkBytes::ended() {
  while (!text_.empty() && is_space_between_letters(text_.front())) text_.remove_prefix(1);
  return text_.empty() && decoded_.empty();
}

std::string read_stored(VtkBytes& bytes, std::uint64_t expected, const VtkStorage& storage) {
  if (storage.compressed) return read_compressed(bytes, expected, storage);
  require_expected(header_number(bytes, storage), expected);
  return bytes.read(expected);
}

}  // namespace meniscus
