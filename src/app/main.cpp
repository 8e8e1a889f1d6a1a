// SPDX-License-Identifier: BSD-3-Clause
// The command line.
#include "app/documents.hpp"
#include "app/hand_over.hpp"
#include "app/interruption.hpp"
#include "app/library_settings.hpp"
#include "app/main_commands.hpp"
#include "app/main_options.hpp"
#include "app/manual.hpp"
#include "app/print.hpp"
#include "app/rank_process.hpp"
#include "input/names.hpp"
#include "io/files.hpp"
#include "io/info.hpp"
#include "io/provenance.hpp"
#include "meniscus/error.hpp"
#include "parallel/ranks.hpp"
#include "scene/key_reference.hpp"

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <optional>
#include <sstream>

namespace {

using namespace meniscus;

std::string version_text() {
  const Build b = build();
  std::string text = fmt::format("meniscus {}\ngit {}{}\ncompiler {}\nflags {}", b.version,
                                 b.git_hash, b.git_dirty ? " (modified)" : "", b.compiler, b.flags);
  for (const auto& library : b.libraries)
    text += fmt::format("\n{} {}", library.first, library.second);
  return text;
}

/// Options of `meniscus keys`.
struct KeysRequest {
  std::string wanted;
  bool markdown = false, json = false, measures = false;
};

void print_reference(const KeysRequest& request) {
  std::ostringstream text;
  if (request.measures)
    print_measures(text);
  else if (request.json)
    print_key_schema(text);
  else if (request.markdown)
    print_keys_as_markdown(text, request.wanted);
  else
    print_keys(text, request.wanted);
  print_text(text.str());
}

void add_keys_options(CLI::App& command, KeysRequest& request) {
  CLI::Option* wanted = command.add_option("WORD", request.wanted,
                                           "a table (contact, ball, neo_hookean, ...) or a key, or "
                                           "what the meaning of keys mentions; all "
                                           "if not given");
  CLI::Option* markdown = command.add_flag("--markdown", request.markdown, "as tables of Markdown");
  CLI::Option* json =
      command
          .add_flag("--json", request.json,
                    "a JSON Schema, by which editors complete and check scenes as one writes")
          ->excludes(wanted)
          ->excludes(markdown);
  command
      .add_flag("--measures", request.measures,
                "instead: what can be measured of bodies and loads, with units and meanings")
      ->excludes(wanted)
      ->excludes(markdown)
      ->excludes(json);
}

struct NewRequest {
  std::string name, like;
  bool list = false;
};

void add_new_options(CLI::App& command, NewRequest& request) {
  CLI::Option* name = command.add_option("NAME", request.name, "of the new file, without .toml");
  CLI::Option* like =
      command.add_option("--like", request.like, "scene of the gallery that it begins as")
          ->type_name("EXAMPLE");
  command.add_flag("--list", request.list, "instead: name the scenes of the gallery")
      ->excludes(name)
      ->excludes(like);
}

void write_new_scene(const NewRequest& request) {
  if (request.list) return print_text(list_of_scenes());
  if (request.name.empty() || request.like.empty())
    throw CLI::RequiredError("NAME --like EXAMPLE, or --list,");
  const Document& like = document_called(request.like, gallery_scenes(), "scene of the gallery");
  const std::string file = request.name.ends_with(".toml") ? request.name : request.name + ".toml";
  write_new_file(file, commented_scene(like));
  for (const Document& mesh : meshes_of(like)) {
    const std::filesystem::path beside =
        std::filesystem::path(file).parent_path() / file_of_mesh(mesh);
    make_directory(beside.parent_path());
    if (!is_there(beside)) write_new_file(beside, mesh.text);
    say("{} is the mesh of its body\n", beside.string());
  }
  say("{0} begins as '{1}'; next: meniscus check {0}\n", file, request.like);
}

/// Names, descriptions and options of all commands, for the manual page and the completion of the
/// shell.
std::vector<CommandText> texts_of(const CLI::App& app) {
  std::vector<CommandText> commands;
  for (const CLI::App* command : app.get_subcommands({})) {
    CommandText text{command->get_name(), command->get_description(), {}};
    for (const CLI::Option* option : command->get_options()) {
      OptionText o{{}, {}, option->get_description(), option->get_required()};
      for (const std::string& name : option->get_lnames()) o.names.push_back("--" + name);
      for (const std::string& name : option->get_snames()) o.names.push_back("-" + name);
      if (option->get_expected_max() > 0)
        o.value = o.names.empty() ? option->get_name() : option->get_type_name();
      text.options.push_back(std::move(o));
    }
    commands.push_back(std::move(text));
  }
  return commands;
}

void print_help(const std::string& topic, const CLI::App& app) {
  if (topic.empty())
    return print_text(
        "Topics, for `meniscus help TOPIC`; of a command it prints the options. `meniscus help\n"
        "how_do_i` has recipes and says which topic has what.\n" +
        list_of_topics());
  std::vector<std::string> known = names_of(guide_topics());
  for (const CLI::App* command : app.get_subcommands({})) {
    if (command->get_name() == topic) return print_text(command->help());
    known.push_back(command->get_name());
  }
  if (std::find(known.begin(), known.end(), topic) == known.end())
    throw InputError(
        fmt::format("'{}' is no topic and no command; {}", topic, allowed_names(topic, known)));
  print_text(printed_topic(document_called(topic, guide_topics(), "topic")));
}

/// The error message if the first argument is neither an option nor a known command.
std::optional<std::string> unknown_command(const CLI::App& app, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return std::nullopt;
  const std::string given = argv[1];
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  if (std::find(names.begin(), names.end(), given) != names.end()) return std::nullopt;
  return fmt::format("'{}' is no command; {}", given, allowed_names(given, names));
}

constexpr const char* exit_codes =
    "Exit codes: 0 ok, 1 internal error, 2 usage, 3 input, 4 numerical failure, 5 files,\n"
    "7 an expectation of the scene or study was missed, 128 + n stopped by signal n after a "
    "checkpoint\n"
    "(130 Ctrl-C, 143 SIGTERM; SIGHUP, SIGUSR1 and SIGXCPU too; 142 the limit on wall-clock "
    "time).\n"
    "A second signal ends at once.";

/// The command line: its commands with their options, and the requests that they fill.
struct CommandLine {
  CLI::App app{"Meniscus: a meshfree simulator of drops, solids and cells"};
  RunRequest request;
  KeysRequest keys_request;
  NewRequest new_request;
  SweepRequest sweep_request;
  RevolveRequest revolve_request;
  ConvergeRequest converge_request;
  std::string file, topic;
  CLI::App *run, *check, *keys, *info, *study, *plot, *report, *fit, *help, *begin, *sweep,
      *converge, *revolve, *completion, *manual, *version;

  CommandLine() {
    app.require_subcommand(1);
    app.footer(exit_codes);
    app.set_version_flag("--version", version_text, "as the command version");
    run = app.add_subcommand("run", "run a scene");
    add_scene_options(*run, request);
    add_run_options(*run, request);
    check = app.add_subcommand("check", "do everything short of running");
    add_scene_options(*check, request);
    keys = app.add_subcommand("keys", "print every key of a scene");
    add_keys_options(*keys, keys_request);
    info = app.add_subcommand("info", "print what is in a result file or checkpoint");
    info->add_option("FILE", file, "run.h5, a checkpoint, or the directory of a run")
        ->required()
        ->check(not_empty());
    study = add_other("study", "error, observed order, time and memory of a family of methods");
    plot = add_other("plot", "pictures or a movie of a run or study: meniscus plot DIR");
    report = add_other("report", "one page about a run: meniscus report DIR");
    fit = add_other("fit", "parameters of scenes from measured data: meniscus fit FIT.toml");
    help = app.add_subcommand("help", "print a topic of the guide");
    help->add_option("TOPIC", topic, "contact, units, restart, ...; a list if not given");
    begin =
        app.add_subcommand("new", "write a scene to begin with, as one of the gallery, explained");
    add_new_options(*begin, new_request);
    sweep = app.add_subcommand("sweep", "run a scene with all combinations of values of some keys");
    add_sweep_options(*sweep, sweep_request);
    converge = app.add_subcommand(
        "converge", "run a scene at several spacings; order, limit and error bar of its results");
    add_converge_options(*converge, converge_request);
    revolve = app.add_subcommand(
        "revolve", "write the twin of a scene whose bodies are of revolution, in the half plane");
    add_revolve_options(*revolve, revolve_request);
    completion = app.add_subcommand("completion", "print the completion of bash for this program");
    manual = app.add_subcommand("manual", "print the manual page, for man");
    version = app.add_subcommand("version", "print version and build");
  }

 private:
  /// A command of another program, whose options, help included, are read there.
  CLI::App* add_other(const char* name, const char* meaning) {
    CLI::App* command = app.add_subcommand(name, meaning);
    command->prefix_command()->set_help_flag();
    return command;
  }
};

/// Runs the command that was parsed; returns the exit code.
int execute(const CommandLine& line, char** argv) {
  if (line.run->parsed() || line.check->parsed() || line.sweep->parsed() || line.converge->parsed())
    begin_with_settings(argv);
  if (line.run->parsed()) return run_with_ranks(line.request, argv);
  if (line.check->parsed()) check(line.request);
  if (line.study->parsed()) hand_over_to_studies(argv);
  if (line.plot->parsed()) hand_over_to_python("plot", argv);
  if (line.report->parsed()) hand_over_to_python("report", argv);
  if (line.fit->parsed()) hand_over_to_python("fit", argv);
  if (line.keys->parsed()) print_reference(line.keys_request);
  if (line.info->parsed()) print_text(describe_file(line.file));
  if (line.version->parsed()) say("{}\n", version_text());
  if (line.help->parsed()) print_help(line.topic, line.app);
  if (line.sweep->parsed()) return sweep(line.sweep_request);
  if (line.converge->parsed()) return converge(line.converge_request);
  if (line.revolve->parsed()) revolve(line.revolve_request);
  if (line.completion->parsed()) print_text(bash_completion(texts_of(line.app)));
  if (line.manual->parsed())
    print_text(manual_page(texts_of(line.app), build().version, line.app.get_description() + ".",
                           exit_codes));
  require_printed();
  return exit_ok;
}

int dispatch(int argc, char** argv) {
  CommandLine line;
  line.request.command_line = portable_command_line(argc, argv);
  if (const auto refusal = unknown_command(line.app, argc, argv)) {
    print_complaint(*refusal);
    return exit_usage;
  }
  try {
    line.app.parse(argc, argv);
    if (launch().size > 1 && !line.run->parsed())
      throw InputError("several ranks can only run a scene: mpirun ... meniscus run SCENE");
    if (line.begin->parsed()) write_new_scene(line.new_request);
  } catch (const CLI::ParseError& e) {
    return answered(line.app, e);
  }
  return execute(line, argv);
}

}  // namespace

int main(int argc, char** argv) {
  const int exit_code = meniscus::exit_code_of([&] { return dispatch(argc, argv); });
  return meniscus::ranks().leave(exit_code, meniscus::last_complaint());
}
