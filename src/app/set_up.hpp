// SPDX-License-Identifier: BSD-3-Clause
// Errors before the first step. They are reported as errors of the scene, with their place in it.
#pragma once
#include "input/input.hpp"
#include "meniscus/error.hpp"

#include <string>
#include <utility>

namespace meniscus {

/// Puts a place in the scene before the message of a failed set-up: the place of the body or
/// contact that the message names, otherwise the start of the scene. A message that has a place
/// already is returned unchanged.
std::string placed(const SceneInput& input, const std::string& message);

/// Calls `work`, which reads, builds or starts a scene, and returns its result. Turns a SolveError
/// into an InputError and gives every message a place.
template <class Work>
auto set_up(const SceneInput& input, Work&& work) {
  try {
    return std::forward<Work>(work)();
  } catch (const SolveError& error) {
    throw InputError(placed(input, error.what()));
  } catch (const InputError& error) {
    throw InputError(placed(input, error.what()));
  }
}

}  // namespace meniscus
