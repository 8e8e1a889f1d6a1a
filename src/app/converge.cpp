// SPDX-License-Identifier: BSD-3-Clause
// `meniscus converge`: a sweep over the resolution, and the error of each result.
#include "app/converge.hpp"

#include "app/commands.hpp"
#include "app/error_budget.hpp"
#include "app/print.hpp"
#include "app/series_table.hpp"
#include "io/files.hpp"
#include "meniscus/error.hpp"
#include "scene/scene.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <utility>

namespace meniscus {
namespace {

constexpr const char* refine_key = "resolution.refine";

using Expectations = std::vector<std::pair<std::string, ExpectSettings>>;

/// The edges of meshes can only be halved.
bool has_mesh(const Block& root) {
  const std::vector<Block> bodies = root.tables("body");
  return std::any_of(bodies.begin(), bodies.end(),
                     [](const Block& body) { return body.text("shape", "") == "mesh"; });
}

/// Values of resolution.refine: the value of the scene times powers of the factor.
std::vector<std::string> refinements_of(const ConvergeRequest& request) {
  const SceneInput input = SceneInput::from_file(request.scene, request.set);
  Real factor = request.factor;
  if (!(factor > 0)) factor = scene_dimension(input) == 2 || has_mesh(input.root()) ? 2 : 1.5;
  std::vector<std::string> all;
  for (int level = 0; level < request.levels; ++level)
    all.push_back(fmt::format("{:.6g}", input.root().refinement() * std::pow(factor, level)));
  return all;
}

/// The scene at a level; of a scene with stages, each stage as if it were the first.
std::vector<SceneInput> scenes_of(const ConvergeRequest& request, const std::string& refinement) {
  std::vector<std::string> settings = request.set;
  settings.push_back(fmt::format("{}={}", refine_key, refinement));
  const SceneInput input = SceneInput::from_file(request.scene, settings);
  const std::vector<std::string> stages = input.stages();
  if (stages.empty()) return {input};
  std::vector<SceneInput> all;
  for (const std::string& name : stages)
    all.push_back(SceneInput::from_file(request.scene, settings, StageChoice{name, ""}));
  return all;
}

/// A scene at a level: the mean size of its cells relative to its own, and the expectations. If
/// several stages have an expectation of one name, the last stage counts.
struct Level {
  Real h = 0;
  Expectations expected;
};

template <int D>
Level level_of(const std::vector<SceneInput>& scenes) {
  Real cells = 0;
  Level level;
  for (const SceneInput& input : scenes) {
    scene_dimension(input);  // must be read first
    const Plan<D> plan = read_plan<D>(input);
    if (cells == 0)
      for (const BodyPlan<D>& body : plan.bodies)
        cells += static_cast<Real>(body.geometry.grid.cells.size());
    for (const auto& expected : plan.expectations) {
      std::erase_if(level.expected, [&](const auto& of_stage_before) {
        return of_stage_before.first == expected.first;
      });
      level.expected.push_back(expected);
    }
  }
  level.h = std::pow(cells, -1.0 / D);
  return level;
}

Level level_of(const ConvergeRequest& request, const std::string& refinement) {
  const std::vector<SceneInput> scenes = scenes_of(request, refinement);
  return scene_dimension(scenes.front()) == 2 ? level_of<2>(scenes) : level_of<3>(scenes);
}

template <int D>
std::vector<std::pair<std::string, Real>> lengths_by_cells(const SceneInput& input) {
  return build_scene<D>(input).lengths_by_cells;
}

/// Names the lengths of physics that follow the cells because the scene leaves them to the program.
/// With --range fixed, the result sets them to their values in the first level.
ConvergeRequest with_lengths(ConvergeRequest request) {
  const auto scenes = scenes_of(request, refinements_of(request).front());
  const bool stages = !SceneInput::from_file(request.scene, request.set).stages().empty();
  if (stages && (request.hold_lengths || request.budget))
    throw InputError(
        fmt::format("{}: has stages; --range fixed and --budget are for a scene without [[stage]]",
                    request.scene));
  for (const SceneInput& input : scenes) {
    const auto lengths =
        scene_dimension(input) == 2 ? lengths_by_cells<2>(input) : lengths_by_cells<3>(input);
    for (const auto& [key, value] : lengths) {
      say("{} is {:.4g} {} at first, by the size of the cells: {}\n", key, value,
          input.root().units().symbol(dimension::length),
          request.hold_lengths ? "it is held"
                               : "it changes with the levels; --range fixed holds it");
      if (request.hold_lengths) request.set.push_back(fmt::format("{}={:.9g}", key, value));
    }
  }
  return request;
}

/// A result of the scene: a column of sweep.csv.
struct Result {
  std::string name, column;
  ExpectSettings asked;  ///< of it; nothing for a column of --of
};

/// The levels of a scene.
struct Levels {
  std::vector<std::string> refinements;  ///< values of resolution.refine
  SweptRuns fixed;                       ///< the keys of --set with the value that all levels have
  std::vector<Real> h;
  std::vector<Result> results;
  std::filesystem::path directory;
};

SweptRuns fixed_of(const ConvergeRequest& request) {
  std::vector<std::string> fixed;
  for (const std::string& setting : request.set) {
    const SweptKey one = swept_key(setting);
    if (one.values.size() > 1)
      throw InputError(fmt::format("--set {}: has {} values; allowed is one, of all levels",
                                   setting, one.values.size()));
    if (one.key != refine_key) fixed.push_back(setting);
  }
  return combinations_of(fixed);
}

/// The keys and values of all runs, and others that differ.
SweptRuns with_fixed(const SweptRuns& fixed, const std::vector<std::string>& keys,
                     const std::vector<SweptRuns::Values>& values) {
  SweptRuns runs{fixed.keys, {}};
  runs.keys.insert(runs.keys.end(), keys.begin(), keys.end());
  for (const SweptRuns::Values& own : values) {
    runs.values.push_back(fixed.values.front());
    runs.values.back().insert(runs.values.back().end(), own.begin(), own.end());
  }
  return runs;
}

/// Reads all levels before any is run. Throws InputError.
Levels levels_of(const ConvergeRequest& request) {
  Levels levels;
  levels.fixed = fixed_of(request);
  levels.refinements = refinements_of(request);
  Expectations expected;
  for (const std::string& refinement : levels.refinements) {
    Level level = level_of(request, refinement);
    if (!levels.h.empty() && !(level.h < levels.h.back() * (1 - 1e-9)))
      throw InputError(fmt::format(
          "{}: {} = {} has no more cells than the level before; expected is a larger --factor",
          request.scene, refine_key, refinement));
    levels.h.push_back(level.h);
    expected = std::move(level.expected);
  }
  for (auto& [name, e] : expected) levels.results.push_back({name, "expect." + name, std::move(e)});
  for (const std::string& column : request.of) levels.results.push_back({column, column, {}});
  if (levels.results.empty())
    throw InputError(request.scene +
                     ": has no [expect], and --of names no column: there is nothing to report");
  levels.directory = request.output;
  if (levels.directory.empty())
    levels.directory =
        "results/" + std::filesystem::path(request.scene).stem().string() + "-convergence";
  return levels;
}

/// Makes runs in a directory, and returns their table and the exit code of the sweep.
std::pair<SweepTable, int> table_of(const ConvergeRequest& request, const SweptRuns& runs,
                                    const std::filesystem::path& directory) {
  SweepRequest making;
  making.scene = request.scene;
  making.output = directory.string();
  making.threads = request.threads;
  making.overwrite = request.overwrite;
  std::pair<SweepTable, int> made{SweepTable(runs.keys), sweep(making, runs)};
  const std::filesystem::path csv = directory / "sweep.csv";
  if (is_there(csv)) made.first.read(read_file(csv), csv.string());
  return made;
}

std::vector<const SweepTable::Row*> rows_of(const SweepTable& table, const SweptRuns& runs) {
  std::vector<const SweepTable::Row*> rows;
  for (const SweptRuns::Values& values : runs.values) rows.push_back(table.find(values));
  return rows;
}

std::string cell(const std::optional<Real>& value, const char* format) {
  return value ? fmt::format(fmt::runtime(format), *value) : "";
}

/// Seconds of the first level from which on all are within a share of the limit.
std::optional<Real> seconds_to(Real share, Real limit,
                               const std::vector<std::optional<Real>>& values,
                               const std::vector<std::optional<Real>>& seconds) {
  std::size_t first = values.size();
  while (first > 0 && std::abs(*values[first - 1] - limit) <= share * std::abs(limit)) --first;
  return first < values.size() ? seconds[first] : std::nullopt;
}

/// Whether a series has the order and the error bar of an expectation: "met" or "MISSED"; empty if
/// none is given.
std::string verdict_of(const ExpectSettings& asked, const std::optional<Convergence>& found) {
  if (!asked.order && !asked.error_bar_within) return "";
  const bool order = !asked.order || (found && found->order && *found->order >= *asked.order);
  const bool bar = !asked.error_bar_within ||
                   (found && found->error_bar <= *asked.error_bar_within * std::abs(found->limit));
  return order && bar ? "met" : "MISSED";
}

/// Prints and writes the table of the levels; returns the exit code.
int report(const Levels& levels, const Series& series) {
  TableLines lines{{"result"}};
  for (const std::string& level : levels.refinements) lines.front().push_back("refine " + level);
  for (const char* name :
       {"order", "limit", "error bar", "s to 1 %", "s to 0.1 %", "expected", "asked"})
    lines.front().emplace_back(name);
  const std::vector<std::optional<Real>> seconds = series.values("seconds");
  bool met = true;
  for (const Result& result : levels.results) {
    const auto values = series.values(result.column);
    const std::optional<Convergence> found = series.convergence(result.column);
    std::vector<std::string>& line = lines.emplace_back(1, result.name);
    for (const auto& value : values) line.push_back(cell(value, "{:.8g}"));
    line.push_back(!found ? "" : found->order ? fmt::format("{:.1f}", *found->order) : "none");
    line.push_back(found ? fmt::format("{:.8g}", found->limit) : "");
    line.push_back(found ? fmt::format("{:.2g}", found->error_bar) : "");
    for (const Real share : {1e-2, 1e-3})
      line.push_back(found ? cell(seconds_to(share, found->limit, values, seconds), "{:.3g}") : "");
    line.push_back(cell(result.asked.value, "{:.6g}"));
    line.push_back(verdict_of(result.asked, found));
    met = met && line.back() != "MISSED";
  }
  std::vector<std::string>& last = lines.emplace_back(1, "seconds");
  for (const auto& s : seconds) last.push_back(cell(s, "{:.3g}"));
  last.resize(lines.front().size());
  print_and_write(lines, levels.directory / "convergence.csv");
  return met ? exit_ok : exit_expectation;
}

/// The error of the scene itself in a series of which it is the first or the last run: a share of
/// its value, or the number where the scene expects 0.
std::string error_in(const Series& series, const Result& result, bool scene_is_first) {
  const std::optional<Convergence> found = series.convergence(result.column);
  if (!found) return "-";
  const auto values = series.values(result.column);
  const Real own = scene_is_first ? *values.front() : *values.back();
  const Real error = scene_is_first ? found->error_of(own) : found->error_bar;
  if (own == 0 || result.asked.value == 0.0) return fmt::format("{:.2g}", error);
  return fmt::format("{:.2g} %", 100 * error / std::abs(own));
}

/// Varies what else the scene is an approximation in, and prints the errors of the scene itself.
int report_budget(const ConvergeRequest& request, const Levels& levels, const Series& resolution,
                  const SweepTable::Row* own) {
  TableLines lines{{"result", "value", "resolution"}};
  for (const Result& result : levels.results)
    lines.push_back({result.name, cell(resolution.values(result.column).front(), "{:.6g}"),
                     error_in(resolution, result, true)});
  int worst = exit_ok;
  const SceneInput input = SceneInput::from_file(request.scene, request.set);
  for (const ModelError& error : model_errors(input)) {
    std::vector<std::string> keys{refine_key};
    keys.insert(keys.end(), error.keys.begin(), error.keys.end());
    std::vector<SweptRuns::Values> changed;
    for (const SweptRuns::Values& values : error.values) {
      if (values.empty()) continue;
      changed.push_back({levels.refinements.front()});
      changed.back().insert(changed.back().end(), values.begin(), values.end());
    }
    const SweptRuns runs = with_fixed(levels.fixed, keys, changed);
    const auto [table, code] = table_of(request, runs, levels.directory / error.name);
    if (code >= exit_signal) return code;
    if (code != exit_expectation) worst = std::max(worst, code);
    std::vector<const SweepTable::Row*> rows = rows_of(table, runs);
    rows.insert(error.scene_is_first ? rows.begin() : rows.end(), own);
    const Series series(error.h, rows);
    lines.front().push_back(error.name);
    for (std::size_t k = 0; k < levels.results.size(); ++k)
      lines[k + 1].push_back(error_in(series, levels.results[k], error.scene_is_first));
  }
  print_and_write(lines, levels.directory / "budget.csv");
  return worst;
}

}  // namespace

int converge(const ConvergeRequest& asked) {
  fixed_of(asked);  // throws for --set with several values
  const ConvergeRequest request = with_lengths(asked);
  const Levels levels = levels_of(request);
  std::vector<SweptRuns::Values> values;
  for (const std::string& refinement : levels.refinements) values.push_back({refinement});
  const SweptRuns runs = with_fixed(levels.fixed, {refine_key}, values);
  const auto [table, code] = table_of(request, runs, levels.directory);
  if (code >= exit_signal) return code;
  const std::vector<const SweepTable::Row*> rows = rows_of(table, runs);
  const Series series(levels.h, rows);
  const int verdict = report(levels, series);
  if (code != exit_ok && code != exit_expectation) return code;
  if (request.budget)
    if (const int end = report_budget(request, levels, series, rows.front()); end != exit_ok)
      return end;
  return verdict;
}

}  // namespace meniscus
