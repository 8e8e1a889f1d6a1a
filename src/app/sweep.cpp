// SPDX-License-Identifier: BSD-3-Clause
// `meniscus sweep`: runs a scene with several values of some keys.
#include "app/sweep.hpp"

#include "app/child.hpp"
#include "app/commands.hpp"
#include "app/print.hpp"
#include "app/stages.hpp"
#include "io/files.hpp"
#include "meniscus/error.hpp"

#include <fmt/core.h>
#include <omp.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <sstream>

namespace meniscus {
namespace {

using Clock = std::chrono::steady_clock;
using Columns = std::vector<std::array<std::string, 3>>;  ///< name, unit, number

/// The last row of the history of a run. Empty if there is none.
Columns last_row(const std::filesystem::path& history) {
  if (!is_there(history)) return {};
  std::istringstream lines(read_file(history));
  std::string names, units, row, line;
  std::getline(lines, names);
  std::getline(lines, units);
  while (std::getline(lines, line)) row = line;
  Columns columns;
  std::istringstream name(names.substr(std::min<std::size_t>(2, names.size()))),
      unit(units.substr(std::min<std::size_t>(2, units.size()))), number(row);
  std::array<std::string, 3> next;
  while (std::getline(name, next[0], ',') && std::getline(unit, next[1], ',') &&
         std::getline(number, next[2], ','))
    columns.push_back(next);
  return columns;
}

/// Obtained values of the table of expectations that a run has printed.
Columns expectations(const std::string& printed) {
  Columns columns;
  std::istringstream lines(printed);
  std::string line;
  while (std::getline(lines, line)) {
    std::istringstream words(line);
    std::string name, obtained, expected, within, verdict;
    if (words >> name >> obtained >> expected >> within >> verdict &&
        (verdict == "met" || verdict == "MISSED" || verdict == "reported"))
      columns.push_back({"expect." + name, "", obtained});
  }
  return columns;
}

/// True if a run with this exit code need not be repeated, because it would end in the same way.
bool is_done(int exit_code) {
  return exit_code == exit_ok || exit_code == exit_expectation || exit_code == exit_numerical;
}

/// Rank of an exit code by severity; larger is worse.
int gravity(int exit_code) {
  constexpr int rising[] = {exit_ok,    exit_expectation, exit_numerical,
                            exit_input, exit_file,        exit_internal};
  return static_cast<int>(std::find(std::begin(rising), std::end(rising), exit_code) -
                          std::begin(rising));
}

/// The runs of a sweep in their directories.
class Sweep {
 public:
  Sweep(const SweepRequest& request, SweptRuns runs)
      : request_(request),
        runs_(std::move(runs)),
        names_(directories_of(runs_)),
        folder_(request.output),
        table_(runs_.keys) {
    stages_ = SceneInput::from_file(request.scene).stages();
    if (folder_.empty())
      folder_ = std::filesystem::path("results") /
                (std::filesystem::path(request.scene).stem().string() + "-sweep");
  }

  int run() {
    open();
    const std::size_t n = runs_.values.size();
    std::size_t next = 0;
    while (next < n || !going_.empty()) {
      if (next < n && !children_.signal() && going_.size() < places())
        begin(next++);
      else if (!going_.empty())
        end_next();
      else
        break;
    }
    if (const auto signal = children_.signal()) {
      say("stopped by signal {}; the same command goes on{}\n", *signal,
          request_.overwrite ? ", without --overwrite" : "");
      return exit_signal + *signal;
    }
    say("{} runs, a row each in {}\n", n, (folder_ / "sweep.csv").string());
    return worst_;
  }

 private:
  /// A run in progress.
  struct Going {
    std::size_t number;
    bool restarted;
    double before;  ///< seconds that the run took until it was stopped
    Clock::time_point since;
  };

  std::size_t places() const { return static_cast<std::size_t>(request_.parallel); }

  /// Opens the directory of the sweep and reads the results of earlier runs. Throws InputError if
  /// these used another scene, of which a copy is kept.
  void open() {
    const std::filesystem::path copy = folder_ / "scene.toml", csv = folder_ / "sweep.csv";
    const std::string scene = read_file(request_.scene);
    make_directory(folder_);
    if (request_.overwrite) remove_file(csv);
    if (!request_.overwrite && is_there(csv)) {
      if (read_file(copy) != scene)
        throw InputError(fmt::format(
            "{} has runs of another scene, that of {}; --output names another directory, "
            "--overwrite begins anew",
            folder_.string(), copy.string()));
      table_.read(read_file(csv), csv.string());
    }
    replace_file(copy, scene);
  }

  void note(std::size_t number, const std::string& what) {
    say("{} of {}: {}: {}\n", number + 1, names_.size(), names_[number], what);
  }

  void note_end(std::size_t number, int code, const char* when) {
    note(number, fmt::format("{}exit code {}", when, code));
    if (gravity(code) > gravity(worst_)) worst_ = code;
  }

  /// Starts a run, or continues it if it was stopped; one that is done is left alone.
  void begin(std::size_t number) {
    const SweepTable::Row* row = table_.find(runs_.values[number]);
    if (row != nullptr && is_done(row->exit_code))
      return note_end(number, row->exit_code, "done before, ");
    const std::filesystem::path directory = folder_ / names_[number];
    const bool again = !request_.overwrite &&
                       has_checkpoint(stages_.empty() ? directory : directory / stages_.front());
    const double before = again && row != nullptr && row->numbers.contains("seconds")
                              ? std::strtod(row->numbers.at("seconds").c_str(), nullptr)
                              : 0;
    start({number, again, before, Clock::now()});
  }

  void start(const Going& run) {
    const std::string directory = (folder_ / names_[run.number]).string();
    std::vector<std::string> words = arguments(runs_.values[run.number]);
    if (run.restarted)
      words.insert(words.end(), {"--restart", directory});
    else
      words.insert(words.end(), {"--output", directory, "--overwrite"});
    going_.emplace(children_.start(words), run);
  }

  /// Waits for a run to end, and writes its row. A run that cannot be continued begins anew.
  void end_next() {
    const auto [process, end] = children_.next();
    Going run = going_.at(process);
    going_.erase(process);
    if (run.restarted && (end.exit_code == exit_input || end.exit_code == exit_file)) {
      run.restarted = false;
      run.before = 0;
      return start(run);
    }
    const std::filesystem::path directory = folder_ / names_[run.number];
    Columns columns =
        last_row((stages_.empty() ? directory : directory / stages_.back()) / "history.csv");
    const Columns expected = expectations(end.output);
    columns.insert(columns.end(), expected.begin(), expected.end());
    const std::chrono::duration<double> elapsed = Clock::now() - run.since;
    columns.push_back({"seconds", "s", fmt::format("{:.3f}", run.before + elapsed.count())});
    table_.put(runs_.values[run.number], end.exit_code, columns);
    table_.arrange(runs_.values);
    replace_file(folder_ / "sweep.csv", table_.text());
    note_end(run.number, end.exit_code, "");
  }

  std::vector<std::string> arguments(const SweptRuns::Values& values) const {
    std::vector<std::string> words{"run", request_.scene, "--quiet"};
    for (std::size_t i = 0; i < runs_.keys.size(); ++i) {
      words.push_back("--set");
      words.push_back(runs_.keys[i] + "=" + values[i]);
    }
    int threads = request_.threads;
    if (threads == 0 && request_.parallel > 1)
      threads = std::max(1, omp_get_max_threads() / request_.parallel);
    if (threads > 0) {
      words.push_back("--threads");
      words.push_back(fmt::format("{}", threads));
    }
    return words;
  }

  const SweepRequest& request_;
  SweptRuns runs_;
  std::vector<std::string> names_;
  std::filesystem::path folder_;
  std::vector<std::string> stages_;  // of the scene
  SweepTable table_;
  Children children_;
  std::map<int, Going> going_;  // by process
  int worst_ = exit_ok;
};

}  // namespace

int sweep(const SweepRequest& request) {
  return sweep(request, request.random > 0 ? sample_of(request.set, request.random)
                                           : combinations_of(request.set));
}

int sweep(const SweepRequest& request, SweptRuns runs) {
  return Sweep(request, std::move(runs)).run();
}

}  // namespace meniscus
