// SPDX-License-Identifier: BSD-3-Clause
// Runs a study, prints its table row by row and its checks, and writes its files.
#include "app/commands.hpp"
#include "app/print.hpp"
#include "input/text.hpp"
#include "io/files.hpp"
#include "io/provenance.hpp"
#include "meniscus/error.hpp"
#include "study/study.hpp"

#include <fmt/core.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

namespace meniscus {
namespace {

std::string order_text(std::optional<Real> order) {
  return order ? fmt::format("{:.2f}", *order) : "";
}

void print_measurement(const StudyRun& run) {
  const auto& all = run.measurements();
  const Measurement& m = all.back();
  if (all.size() == 1 || all[all.size() - 2].method != m.method) say("\n{}\n", m.method);
  say("  {:>5} {:>8} h {:<9.3g}", m.level, m.particles, m.h);
  for (const auto& [name, value] : m.errors)
    say(" {} {:.3g}{}", name, value,
        run.order(m, name) ? fmt::format(" ({})", order_text(run.order(m, name))) : "");
  for (const auto& [name, value] : m.values) say(", {} {:.6g}", name, value);
  say("; {:.3g} + {:.3g} s, {:.3g} MB\n", m.set_up, m.time, 1e-6 * static_cast<Real>(m.bytes));
  if (!m.remark.empty()) say("        {}\n", m.remark);
  std::fflush(stdout);
}

/// Names of the errors or values of all measurements, each once, in order of appearance.
std::vector<std::string> names_of(const StudyRun& run, Measurement::Numbers Measurement::*numbers) {
  std::vector<std::string> names;
  for (const Measurement& m : run.measurements())
    for (const auto& number : m.*numbers)
      if (std::find(names.begin(), names.end(), number.first) == names.end())
        names.push_back(number.first);
  return names;
}

std::optional<Real> number_of(const Measurement::Numbers& numbers, const std::string& name) {
  for (const auto& [key, value] : numbers)
    if (key == name && std::isfinite(value)) return value;
  return {};
}

std::string csv(const StudyRun& run) {
  const auto errors = names_of(run, &Measurement::errors);
  const auto values = names_of(run, &Measurement::values);
  std::string text = "method,level,particles,h";
  for (const auto& name : errors) text += fmt::format(",{0},order of {0}", name);
  for (const auto& name : values) text += "," + name;
  text += ",set-up s,time s,bytes\n";
  const auto cell = [](std::optional<Real> x) { return x ? fmt::format(",{:.9g}", *x) : ","; };
  for (const Measurement& m : run.measurements()) {
    text += fmt::format("\"{}\",{},{},{:.9g}", m.method, m.level, m.particles, m.h);
    for (const auto& name : errors) {
      const auto e = number_of(m.errors, name);
      text += cell(e) + cell(e ? run.order(m, name) : std::nullopt);
    }
    for (const auto& name : values) text += cell(number_of(m.values, name));
    text += fmt::format(",{:.4g},{:.4g},{}\n", m.set_up, m.time, m.bytes);
  }
  return text;
}

/// A JSON string; names hold no control characters.
std::string json_text(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '\\' || c == '"') result += '\\';
    result += c == '\n' ? ' ' : c;
  }
  return result + '"';
}
std::string json_number(Real x) {
  return std::isfinite(x) ? fmt::format("{:.9g}", x) : "null";
}
std::string json_object(const Measurement::Numbers& numbers) {
  std::string text;
  for (const auto& [name, value] : numbers)
    text += fmt::format("{}{}: {}", text.empty() ? "" : ", ", json_text(name), json_number(value));
  return "{" + text + "}";
}

std::string json(const StudyEntry& entry, const StudyRun& run, const StudyRequest& request) {
  const Build b = build();
  std::string text = fmt::format(
      "{{\n\"study\": {}, \"summary\": {}, \"level\": {}, \"h\": {},\n\"version\": {}, \"git\": "
      "{}, "
      "\"compiler\": {}, \"command\": {}, \"threads\": {}, \"short\": {},\n\"measurements\": [",
      json_text(entry.name), json_text(entry.summary), json_text(entry.level_meaning),
      json_text(entry.h_meaning), json_text(b.version),
      json_text(b.git_hash + (b.git_dirty ? " (modified)" : "")), json_text(b.compiler),
      json_text(request.command_line), omp_get_max_threads(), run.brief());
  const char* separator = "\n";
  for (const Measurement& m : run.measurements()) {
    Measurement::Numbers orders;
    for (const auto& error : m.errors)
      if (const auto order = run.order(m, error.first)) orders.emplace_back(error.first, *order);
    text += fmt::format(
        "{}{{\"method\": {}, \"level\": {}, \"particles\": {}, \"h\": {}, \"errors\": {}, "
        "\"orders\": {}, \"values\": {}, \"set_up\": {}, \"time\": {}, \"bytes\": {}, \"remark\": "
        "{}}}",
        separator, json_text(m.method), m.level, m.particles, json_number(m.h),
        json_object(m.errors), json_object(orders), json_object(m.values), json_number(m.set_up),
        json_number(m.time), m.bytes, json_text(m.remark));
    separator = ",\n";
  }
  text += "],\n\"checks\": [";
  separator = "\n";
  for (const Check& c : run.checks()) {
    text +=
        fmt::format("{}{{\"what\": {}, \"value\": {}, \"allowed\": {}, \"met\": {}}}", separator,
                    json_text(c.what), json_number(c.value), json_text(c.allowed.text()), c.met());
    separator = ",\n";
  }
  text += "],\n\"notes\": [";
  separator = "\n";
  for (const std::string& note : run.notes()) {
    text += separator + json_text(note);
    separator = ",\n";
  }
  return text + "]\n}\n";
}

/// Prints the checks; returns how many are missed.
int print_checks(const StudyRun& run) {
  int missed = 0;
  if (!run.checks().empty()) say("\n");
  for (const Check& c : run.checks()) {
    say("{}: {}: {:.4g}, asked {}\n", c.met() ? "met   " : "MISSED", c.what, c.value,
        c.allowed.text());
    missed += !c.met();
  }
  return missed;
}

}  // namespace

void list_studies() {
  for (const auto& [name, entry] : studies()) {
    say("{:<14} {}\n{:<14} levels: {}; by default", name, entry.summary, "", entry.level_meaning);
    for (const int level : entry.levels) say(" {}", level);
    say("\n");
  }
}

int run_study(const StudyRequest& request) {
  if (request.name.empty()) {
    list_studies();
    return exit_usage;
  }
  if (request.threads > 0) omp_set_num_threads(request.threads);
  const StudyEntry& entry = studies().at(request.name);
  const SceneInput settings = SceneInput::from_text("", "study " + request.name, request.set);
  const std::filesystem::path output = request.output;
  if (!request.output.empty()) make_directory(output);

  std::vector<int> levels = request.levels;
  if (levels.empty()) levels = request.brief ? entry.brief_levels : entry.levels;
  std::sort(levels.begin(), levels.end());
  StudyRun run(levels, request.brief, settings, print_measurement);
  say("{}\nlevels: {}; time: set-up + method, wall clock, {} threads\n", entry.summary,
      entry.level_meaning, omp_get_max_threads());
  entry.run(run);
  if (!run.notes().empty()) say("\n{}\n", joined(run.notes(), "\n"));
  const int missed = print_checks(run);
  if (!request.output.empty()) {
    replace_file(output / "study.csv", csv(run));
    replace_file(output / "study.json", json(entry, run, request));
  }
  return missed > 0 ? exit_expectation : exit_ok;
}

}  // namespace meniscus
