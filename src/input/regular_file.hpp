// SPDX-License-Identifier: BSD-3-Clause
// Reading files that have an end.
#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace meniscus {

/// Calls take(piece) for the bytes of a file, in order. Never waits for a FIFO and never reads a
/// device. Throws FileError, "cannot read '<path>': <reason>", if the file cannot be opened, is not
/// a regular file, or has more than `most` bytes.
void read_regular_file(const std::string& path, std::uintmax_t most,
                       const std::function<void(std::string_view)>& take);

/// Returns the content of a file; throws as read_regular_file().
std::string content_of_regular_file(const std::string& path, std::uintmax_t most);

}  // namespace meniscus
