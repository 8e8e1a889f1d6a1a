// SPDX-License-Identifier: BSD-3-Clause
// Writes a run with known numbers, for check_results.py, kill_writer.py and every_kill.py:
//   result_writer DIR FRAMES float32|float64 COMPRESSION [LAST]
// With LAST, continues an existing run after the frame LAST, without history and checkpoints. A
// line "frame k" on stdout means that frame k is on disk.
#include "io/checkpoint.hpp"
#include "io/history.hpp"
#include "io/result_file.hpp"

#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>
#include <vector>

using namespace meniscus;

namespace {

constexpr Index particles = 300, first_body = 100;

/// Component c of particle I in frame k; exact in single precision.
Real value(std::int64_t k, Index I, int c) {
  return static_cast<Real>(k) + I / 512.0 + c / 8.0;
}

std::vector<Real> values(std::int64_t k, Index count, int components) {
  std::vector<Real> all;
  for (Index I = 0; I < count; ++I)
    for (int c = 0; c < components; ++c) all.push_back(value(k, I, c));
  return all;
}

/// Corners of the cells A ... A + 7 for A = 0, 1, ...; the first facet consists of particles 0 to
/// 3.
std::vector<Index> corners(Index count) {
  std::vector<Index> all;
  for (Index A = 0; A + 8 <= count; ++A)
    for (Index a = 0; a < 8; ++a) all.push_back(A + a);
  return all;
}

BodyReference body(const std::string& name, std::span<const Real> X, std::span<const Real> volume,
                   std::span<const Index> cells) {
  return {name, {{"X", 3, "m", X}, {"volume", 1, "m^3", volume}}, 8, cells, cells.first(4)};
}

void write_run(const std::string& path, std::int64_t frames, const ResultOptions& options) {
  const bool continuing = options.continue_after.has_value();
  const RunDirectory directory(path, continuing ? ExistingRun::keep : ExistingRun::replace);
  const Provenance source = provenance("result_writer", "dimension = 3\n# \xce\xb3 = 0.0728 N/m\n");
  const auto X = values(0, particles, 3), volume = values(0, particles, 1);
  const std::span<const Real> all_X = X, all_volume = volume;
  const std::vector<Index> cells[] = {corners(first_body), corners(particles - first_body)};
  const BodyReference bodies[] = {
      body("drop", all_X.first(3 * first_body), all_volume.first(first_body), cells[0]),
      body("wall", all_X.subspan(3 * first_body), all_volume.subspan(first_body), cells[1])};
  ResultFile result(directory, source, bodies, options);
  std::optional<HistoryWriter> history;
  std::optional<CheckpointWriter> checkpoints;
  if (!continuing) {
    history.emplace(directory.history_file(),
                    std::vector<HistoryColumn>{{"time", "s"}, {"kinetic_energy", "J"}});
    checkpoints.emplace(directory, source);
  }
  for (std::int64_t k = result.frames(); k < frames; ++k) {
    const auto one = values(k, particles, 1), two = values(k, particles, 2),
               three = values(k, particles, 3), six = values(k, particles, 6),
               nine = values(k, particles, 9);
    Snapshot state;
    state.add_reals("velocity", three, "m/s");
    state.add_integers("step", std::vector<std::int64_t>{10 * k});
    const ResultField fields[] = {{"position", 3, "m", three},
                                  {"pressure", 1, "Pa", one},
                                  {"velocity", 2, "m/s", two},
                                  {"strain", 6, "1", six},
                                  {"stress", 9, "Pa", nine}};
    const Real time = 0.5 * static_cast<Real>(k);
    if (history) history->write(std::vector<Real>{time, 1.0 / 3.0});
    result.write_frame(10 * k, time, fields, &state);
    if (checkpoints && k % 4 == 3) checkpoints->write(10 * k, time, state);
    std::printf("frame %lld\n", static_cast<long long>(k));
    std::fflush(stdout);
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 5 && argc != 6) return 2;
  ResultOptions options;
  options.precision = std::string(argv[3]) == "float32" ? ResultOptions::Precision::float32
                                                        : ResultOptions::Precision::float64;
  options.compression = std::atoi(argv[4]);
  if (argc == 6) options.continue_after = 10 * std::atoll(argv[5]);
  try {
    write_run(argv[1], std::atoll(argv[2]), options);
  } catch (const std::exception& failure) {
    std::fprintf(stderr, "%s\n", failure.what());
    return 5;
  }
}
