// SPDX-License-Identifier: BSD-3-Clause
// `meniscus sweep`: runs a scene with all combinations of values of some keys.
#include "app/sweep.hpp"

#include "app/child.hpp"
#include "app/commands.hpp"
#include "app/print.hpp"
#include "app/stages.hpp"
#include "input/text.hpp"
#include "io/files.hpp"
#include "meniscus/error.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <set>
#include <sstream>

namespace meniscus {
namespace {

using Values = SweepTable::Values;
using Columns = std::vector<std::array<std::string, 3>>;  ///< name, unit, number

/// All combinations of the values; the last key varies fastest.
std::vector<Values> combinations(const std::vector<SweptKey>& keys) {
  std::vector<Values> all(1);
  for (const SweptKey& key : keys) {
    std::vector<Values> longer;
    for (const Values& begun : all)
      for (const std::string& value : key.values) {
        longer.push_back(begun);
        longer.back().push_back(value);
      }
    all = std::move(longer);
  }
  return all;
}

/// The last part of a key, such as "gamma" of "surface_tension.drop.gamma". The whole key if
/// another key ends with the same part.
std::string short_name(const std::string& key, const std::vector<SweptKey>& keys) {
  const auto last = [](const std::string& path) { return path.substr(path.rfind('.') + 1); };
  const auto same = std::count_if(keys.begin(), keys.end(),
                                  [&](const SweptKey& k) { return last(k.key) == last(key); });
  return same == 1 ? last(key) : key;
}

/// Directory of a combination, such as "gamma=72.8mN_m", without characters that file names should
/// not contain.
std::string directory_name(const std::vector<SweptKey>& keys, const Values& values) {
  std::string name;
  for (std::size_t i = 0; i < keys.size(); ++i)
    name += (i > 0 ? "," : "") + short_name(keys[i].key, keys) + "=" + values[i];
  for (char& c : name) {
    const bool plain = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                       std::string_view("+-.,=_^").find(c) != std::string_view::npos;
    if (!plain) c = '_';
  }
  return name;
}

std::vector<std::string> directory_names(const std::vector<SweptKey>& keys,
                                         const std::vector<Values>& all) {
  constexpr std::size_t longest = 255;  // bytes of a file name
  std::vector<std::string> names;
  for (const Values& values : all) {
    names.push_back(directory_name(keys, values));
    if (names.back().size() > longest)
      throw InputError(
          fmt::format("the directory of a run would be called '{}', which is too long; "
                      "[constants] of the scene give short values names",
                      names.back()));
    if (std::count(names.begin(), names.end(), names.back()) > 1)
      throw InputError(
          fmt::format("two runs would have the directory '{}'; allowed are values that differ in "
                      "letters and digits",
                      names.back()));
  }
  return names;
}

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
        (verdict == "met" || verdict == "MISSED"))
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

class Sweep {
 public:
  explicit Sweep(const SweepRequest& request)
      : request_(request), folder_(request.output), table_(keys_of(request)) {
    for (const std::string& setting : request.set) keys_.push_back(swept_key(setting));
    stages_ = SceneInput::from_file(request.scene).stages();
    if (folder_.empty())
      folder_ = std::filesystem::path("results") /
                (std::filesystem::path(request.scene).stem().string() + "-sweep");
  }

  int run() {
    const std::vector<Values> all = combinations(keys_);
    const std::vector<std::string> names = directory_names(keys_, all);
    open();
    Child child;
    int worst = exit_ok;
    for (std::size_t k = 0; k < all.size(); ++k) {
      const std::string counted = fmt::format("{} of {}: {}", k + 1, all.size(), names[k]);
      const SweepTable::Row* row = table_.find(all[k]);
      int code = row != nullptr ? row->exit_code : exit_ok;
      if (row != nullptr && is_done(code)) {
        say("{}: done before, exit code {}\n", counted, code);
      } else {
        code = run_one(child, all[k], folder_ / names[k]);
        say("{}: exit code {}\n", counted, code);
      }
      if (const auto signal = child.signal()) {
        say("stopped by signal {}; the same command goes on{}\n", *signal,
            request_.overwrite ? ", without --overwrite" : "");
        return exit_signal + *signal;
      }
      if (gravity(code) > gravity(worst)) worst = code;
    }
    say("{} runs, a row each in {}\n", all.size(), (folder_ / "sweep.csv").string());
    return worst;
  }

 private:
  static std::vector<std::string> keys_of(const SweepRequest& request) {
    std::vector<std::string> keys;
    for (const std::string& setting : request.set) {
      keys.push_back(swept_key(setting).key);
      if (std::count(keys.begin(), keys.end(), keys.back()) > 1)
        throw InputError(fmt::format("--set {}: the key is named twice", keys.back()));
    }
    return keys;
  }

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

  int run_one(Child& child, const Values& values, const std::filesystem::path& directory) {
    const auto start = std::chrono::steady_clock::now();
    const SweepTable::Row* stopped = request_.overwrite ? nullptr : table_.find(values);
    const double before = stopped && stopped->numbers.contains("seconds")
                              ? std::strtod(stopped->numbers.at("seconds").c_str(), nullptr)
                              : 0;
    const bool begun = has_checkpoint(stages_.empty() ? directory : directory / stages_.front());
    std::optional<ChildEnd> end;
    if (begun && !request_.overwrite)
      end = child.call(arguments(values, {"--restart", directory.string()}));
    if (!end || end->exit_code == exit_input || end->exit_code == exit_file)
      end = child.call(arguments(values, {"--output", directory.string(), "--overwrite"}));
    Columns columns =
        last_row((stages_.empty() ? directory : directory / stages_.back()) / "history.csv");
    const Columns expected = expectations(end->output);
    columns.insert(columns.end(), expected.begin(), expected.end());
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    columns.push_back({"seconds", "s", fmt::format("{:.3f}", before + elapsed.count())});
    table_.put(values, end->exit_code, columns);
    replace_file(folder_ / "sweep.csv", table_.text());
    return end->exit_code;
  }

  std::vector<std::string> arguments(const Values& values,
                                     const std::vector<std::string>& where) const {
    std::vector<std::string> words{"run", request_.scene, "--quiet"};
    for (std::size_t i = 0; i < keys_.size(); ++i) {
      words.push_back("--set");
      words.push_back(keys_[i].key + "=" + values[i]);
    }
    if (request_.threads > 0) {
      words.push_back("--threads");
      words.push_back(fmt::format("{}", request_.threads));
    }
    words.insert(words.end(), where.begin(), where.end());
    return words;
  }

  const SweepRequest& request_;
  std::filesystem::path folder_;
  std::vector<SweptKey> keys_;
  std::vector<std::string> stages_;  // of the scene
  SweepTable table_;
};

}  // namespace

SweptKey swept_key(const std::string& setting) {
  const std::size_t equals = setting.find('=');
  SweptKey result{setting.substr(0, equals), {}};
  if (equals == std::string::npos || equals == 0)
    throw InputError(fmt::format(
        "--set {}: expected KEY=VALUE,VALUE,... such as body.drop.core=4,6,8", setting));
  std::string value;
  int depth = 0;
  char quote = 0;
  const auto end_value = [&] {
    const std::size_t first = value.find_first_not_of(' '), last = value.find_last_not_of(' ');
    if (first == std::string::npos)
      throw InputError(fmt::format("--set {}: a value is missing", setting));
    if (value[first] == '=' || value[first] == '@')  // a spreadsheet would evaluate it as a formula
      throw InputError(
          fmt::format("--set {}: a value begins with '{}'; allowed are numbers, texts "
                      "and formulas",
                      setting, value[first]));
    result.values.push_back(value.substr(first, last + 1 - first));
    value.clear();
  };
  for (const char c : setting.substr(equals + 1)) {
    if (quote == 0 && depth == 0 && c == ',') {
      end_value();
      continue;
    }
    if (c == '"' || c == '\'')
      quote = quote == 0 ? c : quote == c ? char{0} : quote;
    else if (quote == 0 && (c == '(' || c == '[' || c == '{'))
      ++depth;
    else if (quote == 0 && (c == ')' || c == ']' || c == '}'))
      --depth;
    value += c;
  }
  end_value();
  const std::set<std::string> different(result.values.begin(), result.values.end());
  if (different.size() < result.values.size())
    throw InputError(fmt::format("--set {}: a value is named twice", setting));
  return result;
}

int sweep(const SweepRequest& request) {
  return Sweep(request).run();
}

}  // namespace meniscus
