// SPDX-License-Identifier: BSD-3-Clause
// A program with the library: runs a scene to its end and prints a measure of it.
//   example SCENE MEASURE [KEY.PATH=VALUE ...]
#include <meniscus/run.hpp>

#include <cstdio>
#include <string>
#include <vector>

int main(int count, char** arguments) {
  const char *scene = arguments[1], *measure = arguments[2];
  const std::vector<std::string> overrides(arguments + 3, arguments + count);
  meniscus::Run run = meniscus::Run::from_file(scene, overrides);
  while (!run.finished()) run.advance();
  std::printf("%lld %.17g\n", static_cast<long long>(run.step()), run.measure(measure));
}
