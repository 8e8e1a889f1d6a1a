// SPDX-License-Identifier: BSD-3-Clause
// A program with the library: runs a scene to its end and prints a measure of it.
#include <meniscus/run.hpp>

#include <cstdio>

int main(int, char** arguments) {
  const char *scene = arguments[1], *measure = arguments[2];
  meniscus::Run run = meniscus::Run::from_file(scene);
  while (!run.finished()) run.advance();
  std::printf("%lld %.17g\n", static_cast<long long>(run.step()), run.measure(measure));
}
