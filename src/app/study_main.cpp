// SPDX-License-Identifier: BSD-3-Clause
// The command line of the studies, a program of its own: `meniscus study` hands over to it.
#include "app/commands.hpp"
#include "app/library_settings.hpp"
#include "app/main_options.hpp"
#include "app/print.hpp"
#include "io/provenance.hpp"

namespace {

using namespace meniscus;

int dispatch(int argc, char** argv) {
  CLI::App app("Error, observed order, time and memory of families of methods", "meniscus study");
  StudyRequest request;
  request.command_line = portable_command_line(argc, argv);
  bool list = false;
  CLI::Option* name = app.add_option("NAME", request.name, "study to run");
  app.add_flag("--list", list, "print the known studies")->excludes(name);
  app.add_option("--levels", request.levels, "resolutions, e.g. --levels 6 10 14")
      ->check(integer_between(1, INT_MAX));
  app.add_option("--set", request.set, "key=value: settings of the study")
      ->type_size(1)
      ->allow_extra_args(false);
  app.add_option("--output", request.output, "directory for study.csv and study.json")
      ->type_name("DIR")
      ->check(not_empty());
  app.add_option("--threads", request.threads, "number of threads; all cores by default")
      ->check(integer_between(1, 4096));
  app.add_flag("--short", request.brief, "the short form of the tests: few levels, seconds");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return answered(app, e);
  }
  if (!list) {
    begin_with_settings(argv);
    return run_study(request);
  }
  list_studies();
  require_printed();
  return exit_ok;
}

}  // namespace

int main(int argc, char** argv) {
  return meniscus::exit_code_of([&] { return dispatch(argc, argv); });
}
