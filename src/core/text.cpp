// SPDX-License-Identifier: BSD-3-Clause
// Texts made of texts.
#include "meniscus/core/text.hpp"

namespace meniscus {

std::string joined(const std::vector<std::string>& items, std::string_view separator) {
  std::string text;
  for (const std::string& item : items) {
    if (&item != &items.front()) text += separator;
    text += item;
  }
  return text;
}

}  // namespace meniscus
