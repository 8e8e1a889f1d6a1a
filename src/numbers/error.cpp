// SPDX-License-Identifier: BSD-3-Clause
// The message of a failed step.
#include "meniscus/error.hpp"

#include <fmt/core.h>

namespace meniscus {

std::string StepFailure::text() const {
  std::string text;
  if (step >= 0) text += fmt::format("step {}, t = {:.9g}, dt = {:.4g}: ", step, time, dt);
  if (!body.empty())
    text += fmt::format("body '{}', particle {} at reference position {}: ", body, particle, place);
  text += cause;
  if (!term.empty()) text += fmt::format(" ({})", term);
  if (halvings > 0) text += fmt::format("; the step was halved {} times", halvings);
  return text;
}

}  // namespace meniscus
