// SPDX-License-Identifier: BSD-3-Clause
// Messages of the registries.
#include "input/registry.hpp"

#include "input/names.hpp"
#include "meniscus/error.hpp"

#include <fmt/core.h>

#include <stdexcept>

namespace meniscus::registry {

void throw_taken(std::string_view kind, std::string_view name) {
  throw std::logic_error(fmt::format("the {} '{}' is registered twice", kind, name));
}

void throw_unknown(std::string_view kind, std::string_view name,
                   const std::vector<std::string>& known) {
  throw InputError(fmt::format("there is no {} '{}'; {}", kind, name, allowed_names(name, known)));
}

}  // namespace meniscus::registry
