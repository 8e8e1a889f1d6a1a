// SPDX-License-Identifier: BSD-3-Clause
// The short form of verifications, and the full one, which tools/verify requests with
// MENISCUS_VERIFY=full in the environment.
#pragma once
#include <cstdlib>
#include <string_view>

namespace meniscus::test {

inline bool full_verification() {
  const char* wish = std::getenv("MENISCUS_VERIFY");
  return wish && std::string_view(wish) == "full";
}

}  // namespace meniscus::test
