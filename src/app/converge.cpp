// SPDX-License-Identifier: BSD-3-Clause
// `meniscus converge`: a sweep over the resolution, and the error of each result.
#include "app/converge.hpp"

#include "app/commands.hpp"
#include "app/print.hpp"
#include "app/sweep.hpp"
#include "io/files.hpp"
#include "meniscus/error.hpp"
#include "numbers/convergence.hpp"
#include "scene/plan.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <optional>

namespace meniscus {
namespace {

constexpr const char* refine_key = "resolution.refine";

std::vector<std::string> refinements_of(const ConvergeRequest& request) {
  std::vector<std::string> all;
  for (int level = 0; level < request.levels; ++level)
    all.push_back(fmt::format("{:.6g}", std::pow(request.factor, level)));
  return all;
}

/// A scene at a level: the mean size of its cells relative to its own, and the expectations.
struct Level {
  Real h = 0;
  std::vector<std::pair<std::string, Real>> expected;
};

template <int D>
Level level_of(const SceneInput& input) {
  const Plan<D> plan = read_plan<D>(input);
  Real cells = 0;
  for (const BodyPlan<D>& body : plan.bodies)
    cells += static_cast<Real>(body.geometry.grid.cells.size());
  Level level{std::pow(cells, -1.0 / D), {}};
  for (const auto& [name, e] : plan.expectations) level.expected.emplace_back(name, e.value);
  return level;
}

Level level_of(const ConvergeRequest& request, const std::string& refinement) {
  std::vector<std::string> settings = request.set;
  settings.push_back(fmt::format("{}={}", refine_key, refinement));
  const SceneInput input = SceneInput::from_file(request.scene, settings);
  return scene_dimension(input) == 2 ? level_of<2>(input) : level_of<3>(input);
}

std::optional<Real> number(const SweepTable::Row* row, const std::string& column) {
  if (!row || !row->numbers.contains(column)) return std::nullopt;
  const std::string& text = row->numbers.at(column);
  Real value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() ? std::optional(value)
                                                                  : std::nullopt;
}

/// The results of all levels.
class Results {
 public:
  Results(std::vector<Real> h, std::vector<const SweepTable::Row*> rows)
      : h_(std::move(h)), rows_(std::move(rows)) {
    for (const auto* row : rows_) seconds_.push_back(number(row, "seconds").value_or(0));
  }

  /// A line of the table: name, values, order, limit, error bar, seconds to 1 % and to 0.1 %,
  /// expected.
  std::vector<std::string> line(const std::string& name, const std::string& column,
                                std::optional<Real> expected) const {
    std::vector<std::string> cells{name};
    std::vector<Real> values;
    for (const auto* row : rows_) {
      const std::optional<Real> value = number(row, column);
      cells.push_back(value ? fmt::format("{:.6g}", *value) : "");
      if (value) values.push_back(*value);
    }
    if (values.size() < rows_.size() || values.size() < 3) {
      cells.insert(cells.end(), {"", "", "", "", ""});
    } else {
      const Convergence c = convergence_of(h_, values);
      cells.push_back(c.order ? fmt::format("{:.1f}", *c.order) : "none");
      cells.push_back(fmt::format("{:.6g}", c.limit));
      cells.push_back(fmt::format("{:.2g}", c.error_bar));
      for (const Real share : {1e-2, 1e-3}) cells.push_back(seconds_to(share, c, values));
    }
    cells.push_back(expected ? fmt::format("{:.6g}", *expected) : "");
    return cells;
  }
  std::vector<std::string> seconds() const {
    std::vector<std::string> cells{"seconds"};
    for (const Real s : seconds_) cells.push_back(fmt::format("{:.3g}", s));
    cells.resize(cells.size() + 6);
    return cells;
  }

 private:
  /// Seconds of the first level from which on all are within a share of the limit.
  std::string seconds_to(Real share, const Convergence& c, const std::vector<Real>& values) const {
    std::size_t first = values.size();
    while (first > 0 && std::abs(values[first - 1] - c.limit) <= share * std::abs(c.limit)) --first;
    return first < values.size() ? fmt::format("{:.3g}", seconds_[first]) : "";
  }

  std::vector<Real> h_;
  std::vector<const SweepTable::Row*> rows_;
  std::vector<Real> seconds_;
};

void print_aligned(const std::vector<std::vector<std::string>>& lines) {
  std::vector<std::size_t> width(lines.front().size(), 0);
  for (const auto& line : lines)
    for (std::size_t c = 0; c < line.size(); ++c) width[c] = std::max(width[c], line[c].size());
  for (const auto& line : lines) {
    std::string text = fmt::format("{:<{}}", line[0], width[0]);
    for (std::size_t c = 1; c < line.size(); ++c)
      text += fmt::format("  {:>{}}", line[c], width[c]);
    text.erase(text.find_last_not_of(' ') + 1);
    say("{}\n", text);
  }
}

std::string csv_of(const std::vector<std::vector<std::string>>& lines) {
  std::string csv;
  for (const auto& line : lines)
    for (std::size_t c = 0; c < line.size(); ++c)
      csv += line[c] + (c + 1 < line.size() ? "," : "\n");
  return csv;
}

/// Names the lengths that change with the cells because the scene leaves them to the program.
void say_lengths_of_cells(const ConvergeRequest& request) {
  const SceneInput input = SceneInput::from_file(request.scene, request.set);
  int k = 0;
  for (const Block& contact : input.root().tables("contact")) {
    if ((contact.has("contact_angle") || contact.has("adhesion")) && !contact.has("range") &&
        !contact.has("sigma0"))
      say("contact[{0}] has no range: it is half a facet and changes with the levels; "
          "contact.range "
          "holds it\n",
          k);
    ++k;
  }
  k = 0;
  for (const Block& body : input.root().tables("body")) {
    const auto material = body.is_array("material") ? std::nullopt : body.table("material");
    if (material && material->has("frank_constant") && material->has("rotational_viscosity") &&
        !material->has("core_length"))
      say("body[{}].material has no core_length: it is two spacings and changes with the levels\n",
          k);
    ++k;
  }
}

/// The levels of a scene.
struct Series {
  std::vector<std::string> levels;       ///< values of resolution.refine
  std::vector<std::string> keys, fixed;  ///< of --set, and their values
  std::vector<Real> h;
  std::vector<std::pair<std::string, Real>> expected;
};

/// Reads all levels before any is run. Throws InputError.
Series series_of(const ConvergeRequest& request) {
  Series series;
  for (const std::string& setting : request.set) {
    const SweptKey one = swept_key(setting);
    if (one.values.size() > 1)
      throw InputError(fmt::format("--set {}: has {} values; allowed is one, of all levels",
                                   setting, one.values.size()));
    series.keys.push_back(one.key);
    series.fixed.push_back(one.values.front());
  }
  series.levels = refinements_of(request);
  for (const std::string& refinement : series.levels) {
    Level level = level_of(request, refinement);
    if (!series.h.empty() && !(level.h < series.h.back() * (1 - 1e-9)))
      throw InputError(fmt::format(
          "{}: {} = {} has no more cells than the level before; expected is a larger --factor",
          request.scene, refine_key, refinement));
    series.h.push_back(level.h);
    series.expected = std::move(level.expected);
  }
  if (series.expected.empty() && request.of.empty())
    throw InputError(request.scene +
                     ": has no [expect], and --of names no column: there is nothing to report");
  return series;
}

/// Prints and writes what the runs in a directory say.
void report(const Series& series, const std::vector<std::string>& of,
            const std::filesystem::path& directory) {
  std::vector<std::string> keys = series.keys;
  keys.emplace_back(refine_key);
  SweepTable table(keys);
  table.read(read_file(directory / "sweep.csv"), (directory / "sweep.csv").string());
  std::vector<const SweepTable::Row*> rows;
  std::vector<std::vector<std::string>> lines{{"result"}};
  for (const std::string& level : series.levels) {
    std::vector<std::string> values = series.fixed;
    values.push_back(level);
    rows.push_back(table.find(values));
    lines.front().push_back("refine " + level);
  }
  for (const char* head : {"order", "limit", "error bar", "s to 1 %", "s to 0.1 %", "expected"})
    lines.front().emplace_back(head);
  const Results results(series.h, rows);
  for (const auto& [name, value] : series.expected)
    lines.push_back(results.line(name, "expect." + name, value));
  for (const std::string& column : of) lines.push_back(results.line(column, column, std::nullopt));
  lines.push_back(results.seconds());
  print_aligned(lines);
  replace_file(directory / "convergence.csv", csv_of(lines));
  say("written to {}\n", (directory / "convergence.csv").string());
}

}  // namespace

int converge(const ConvergeRequest& request) {
  const Series series = series_of(request);
  say_lengths_of_cells(request);
  SweepRequest runs{request.scene, request.output, request.set, request.threads, request.overwrite};
  if (runs.output.empty())
    runs.output =
        "results/" + std::filesystem::path(request.scene).stem().string() + "-convergence";
  std::string values;
  for (const std::string& level : series.levels) values += (values.empty() ? "" : ",") + level;
  runs.set.push_back(fmt::format("{}={}", refine_key, values));
  const int code = sweep(runs);
  if (code >= exit_signal) return code;
  report(series, request.of, runs.output);
  return code == exit_expectation ? exit_ok : code;
}

}  // namespace meniscus
