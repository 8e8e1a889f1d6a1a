// SPDX-License-Identifier: BSD-3-Clause
// Errors before the first step: they are errors of the scene and have a place in it.
#pragma once
#include "input/input.hpp"
#include "meniscus/error.hpp"

#include <string>
#include <utility>

namespace meniscus {

/// The message of a failed set-up behind its place in the scene: that of the body or contact that
/// it names, unless it has one already.
std::string placed(const SceneInput& input, const std::string& message);

/// What `work` returns, which reads, builds or begins a scene. SolveError becomes InputError, and
/// every message has a place.
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
