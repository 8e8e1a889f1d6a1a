// SPDX-License-Identifier: BSD-3-Clause
// Adds the place in the scene file to messages about bodies and contacts.
#include "app/set_up.hpp"

#include <fmt/core.h>

namespace meniscus {

std::string placed(const SceneInput& input, const std::string& message) {
  const Block& root = input.root();
  const std::string start = root.place(),
                    file = start.substr(0, start.rfind(':', start.rfind(':') - 1));
  if (message.starts_with(file + ":") || message.starts_with("--set ")) return message;
  for (const char* kind : {"contact", "body"})
    for (const Block& block : root.tables(kind))
      if (const std::string name = block.text("name", "");
          !name.empty() && message.find("'" + name + "'") != message.npos)
        return fmt::format("{}: {}", block.place(), message);
  return fmt::format("{}: {}", start, message);
}

}  // namespace meniscus
