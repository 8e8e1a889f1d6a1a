// SPDX-License-Identifier: BSD-3-Clause
// libFuzzer target of the scene reader: any text is read or refused, the complete input can be read
// again, and every problem has a place.
#include "unit/input_scene.hpp"

#include <cstdlib>

using namespace meniscus;

namespace {

/// The complete input and an empty report, or an empty text and the report.
std::pair<std::string, std::string> read(const std::string& toml) {
  try {
    const SceneInput input = SceneInput::from_text(toml, "s.toml");
    const input_test::LiquidScene scene = input_test::read_scene(input.root());
    const std::string complete = input.complete();
    input.check();
    for (const auto& liquid : scene.liquids) liquid.at({1e-9, 1, 2});
    return {complete, ""};
  } catch (const InputError& error) {
    return {"", error.what()};
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  const auto [complete, report] = read({reinterpret_cast<const char*>(data), size});
  if (complete.empty() && !report.starts_with("s.toml:")) std::abort();
  if (!complete.empty() && read(complete).first.empty()) std::abort();
  return 0;
}
