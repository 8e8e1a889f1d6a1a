// SPDX-License-Identifier: BSD-3-Clause
// SHA-256. This is the only file that includes OpenSSL.
#include "input/sha256.hpp"

#include <fmt/core.h>
#include <openssl/sha.h>

#include <array>

namespace meniscus {

std::string sha256(std::string_view bytes) {
  std::array<unsigned char, SHA256_DIGEST_LENGTH> digest{};
  SHA256(reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size(), digest.data());
  std::string text;
  for (const unsigned char byte : digest) text += fmt::format("{:02x}", byte);
  return text;
}

}  // namespace meniscus
