// SPDX-License-Identifier: BSD-3-Clause
// Verifications have a short and a full form. tools/verify selects the full form by
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
