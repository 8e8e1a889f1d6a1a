// SPDX-License-Identifier: BSD-3-Clause
// The command line.
#include "meniscus/app/commands.hpp"
#include "meniscus/app/interruption.hpp"
#include "meniscus/app/print.hpp"
#include "meniscus/core/error.hpp"
#include "meniscus/core/names.hpp"
#include "meniscus/io/info.hpp"
#include "meniscus/io/provenance.hpp"
#include "meniscus/scene/settings.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <climits>
#include <optional>
#include <sstream>

namespace {

using namespace meniscus;

void print_version() {
  const Build b = build();
  say("meniscus {}\ngit {}{}\ncompiler {}\nflags {}\n", b.version, b.git_hash,
      b.git_dirty ? " (modified)" : "", b.compiler, b.flags);
  for (const auto& library : b.libraries) say("{} {}\n", library.first, library.second);
}

void print_keys() {
  std::ostringstream text;
  describe_keys(text);
  print_text(text.str());
}

/// An integer of a range, refused by a sentence.
CLI::Validator integer_between(std::int64_t low, std::int64_t high) {
  return CLI::Validator(
      [=](const std::string& text) {
        std::int64_t value = 0;
        const char* end = text.data() + text.size();
        const auto [rest, error] = std::from_chars(text.data(), end, value);
        if (error == std::errc() && rest == end && value >= low && value <= high)
          return std::string();
        return fmt::format("'{}' is out of range; allowed is an integer >= {}{}", text, low,
                           high < INT_MAX ? fmt::format(" and <= {}", high) : "");
      },
      "");
}

void add_scene_options(CLI::App& command, RunRequest& request) {
  command.add_option("SCENE", request.scene, "scene file (TOML)")->required();
  command
      .add_option("--set", request.set,
                  "key=value: replace a key of the scene, e.g. time.end='1 ns'")
      ->type_size(1)
      ->allow_extra_args(false);
  command.add_option("--threads", request.threads, "number of threads; all cores by default")
      ->check(integer_between(1, 4096));
  command
      .add_option(
          "--until", request.until,
          "stop after the first step that reaches this time, e.g. '0.1 ns', with a "
          "checkpoint. Steps, rows and frames are those of the whole run, so that --restart "
          "continues it bit for bit (the end of the scene, time.end, is hit exactly)")
      ->type_name("TIME");
}

void add_run_options(CLI::App& command, RunRequest& request) {
  command
      .add_option("--output", request.output,
                  "directory of the results; by default results/SCENE, or DIR of --restart DIR")
      ->type_name("DIR");
  command.add_flag("--overwrite", request.overwrite, "replace results that are already there");
  CLI::Option* restart =
      command
          .add_option(
              "--restart", request.restart,
              "continue bit for bit from a checkpoint, or from the newest one of a run; any "
              "number of threads. Only [time], [output] and [expect] of the scene may "
              "change. A finished run goes on if time.end is made larger; its last two "
              "steps, which were fitted to the old end, stay")
          ->type_name("FILE|DIR");
  command
      .add_option("--frame", request.frame,
                  "continue from this frame of the run instead; later rows and frames are replaced")
      ->type_name("K")
      ->check(integer_between(0, INT_MAX))
      ->needs(restart);
  command
      .add_option_function<std::string>(
          "--max-walltime",
          [&request](const std::string& text) {
            request.max_walltime = parse_duration(text);
            if (!request.max_walltime)
              throw CLI::ValidationError(
                  "--max-walltime", "'" + text + "' is not a time; write H:M:S, M:S or seconds");
          },
          "write a checkpoint and stop after this time, exit code 142")
      ->type_name("H:M:S");
  command.add_flag("-q,--quiet", request.quiet, "print nothing but errors and expectations");
}

CLI::App* add_study_command(CLI::App& app, StudyRequest& request, bool& list) {
  CLI::App* command =
      app.add_subcommand("study", "error, observed order, time and memory of a family of methods");
  CLI::Option* name = command->add_option("NAME", request.name, "study to run");
  command->add_flag("--list", list, "print the known studies")->excludes(name);
  command->add_option("--levels", request.levels, "resolutions, e.g. --levels 6 10 14")
      ->check(integer_between(1, INT_MAX));
  command->add_option("--set", request.set, "key=value: settings of the study")
      ->type_size(1)
      ->allow_extra_args(false);
  command->add_option("--output", request.output, "directory for study.csv and study.json")
      ->type_name("DIR");
  command->add_option("--threads", request.threads, "number of threads; all cores by default")
      ->check(integer_between(1, 4096));
  command->add_flag("--short", request.brief, "the short form of the tests: few levels, seconds");
  return command;
}

/// What is wrong with the first word if it is no command.
std::optional<std::string> unknown_command(const CLI::App& app, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return std::nullopt;
  const std::string given = argv[1];
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  if (std::find(names.begin(), names.end(), given) != names.end()) return std::nullopt;
  return fmt::format("'{}' is no command; {}", given, allowed_names(given, names));
}

int dispatch(int argc, char** argv) {
  CLI::App app("Meniscus: a meshfree simulator of drops, solids and cells");
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 ok, 1 internal error, 2 usage, 3 input, 4 numerical failure, 5 files,\n"
      "7 an expectation of the scene or study was missed, 128 + n stopped by signal n after a "
      "checkpoint\n"
      "(130 Ctrl-C, 143 SIGTERM; SIGHUP, SIGUSR1 and SIGXCPU too; 142 the limit on wall-clock "
      "time).\n"
      "A second signal ends at once.");
  RunRequest request;
  request.command_line = portable_command_line(argc, argv);
  StudyRequest study_request;
  study_request.command_line = request.command_line;
  bool list = false;
  std::string file;

  CLI::App* run_command = app.add_subcommand("run", "run a scene");
  add_scene_options(*run_command, request);
  add_run_options(*run_command, request);
  CLI::App* check_command = app.add_subcommand("check", "do everything short of running");
  add_scene_options(*check_command, request);
  CLI::App* keys_command = app.add_subcommand("keys", "print every key of a scene");
  CLI::App* info_command =
      app.add_subcommand("info", "print what is in a result file or checkpoint");
  info_command->add_option("FILE", file, "run.h5, a checkpoint, or the directory of a run")
      ->required();
  CLI::App* study_command = add_study_command(app, study_request, list);
  CLI::App* version_command = app.add_subcommand("version", "print version and build");

  if (const auto refusal = unknown_command(app, argc, argv)) {
    print_complaint(*refusal);
    return exit_usage;
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? exit_ok : exit_usage;
  }
  if (run_command->parsed()) return run(request);
  if (check_command->parsed()) check(request);
  if (study_command->parsed()) {
    if (!list) return study(study_request);
    list_studies();
  }
  if (keys_command->parsed()) print_keys();
  if (info_command->parsed()) print_text(describe_file(file));
  if (version_command->parsed()) print_version();
  require_printed();
  return exit_ok;
}

int complain(const char* kind, const std::exception& e, int code) {
  print_complaint(fmt::format("{}{}", kind, e.what()));
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  meniscus::secure_streams();
  try {
    return dispatch(argc, argv);
  } catch (const meniscus::InputError& e) {
    return complain("", e, meniscus::exit_input);
  } catch (const meniscus::SolveError& e) {
    return complain("the run failed: ", e, meniscus::exit_numerical);
  } catch (const meniscus::FileError& e) {
    return complain("", e, meniscus::exit_file);
  } catch (const std::bad_alloc& e) {
    return complain("not enough memory: ", e, meniscus::exit_numerical);
  } catch (const std::exception& e) {
    return complain("internal error: ", e, meniscus::exit_internal);
  }
}
