// SPDX-License-Identifier: BSD-3-Clause
// SHA-256 hash, which identifies the input of a run.
#pragma once
#include <string>
#include <string_view>

namespace meniscus {

/// The digest of `bytes` as 64 hexadecimal digits, as `sha256sum` prints it. Source: FIPS 180-4.
std::string sha256(std::string_view bytes);

}  // namespace meniscus
