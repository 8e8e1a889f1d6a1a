// SPDX-License-Identifier: BSD-3-Clause
// Prints the shell completion and the manual page, made from the options of the command line.
#include "app/manual.hpp"

#include "app/documents.hpp"
#include "input/text.hpp"
#include "scene/key_reference.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace meniscus {
namespace {

using Words = std::vector<std::string>;

/// Names of all tables and their kinds, to complete `meniscus keys`.
Words words_of_keys() {
  Words words;
  for (const KeyTable& table : key_tables()) {
    const KeyHeading heading = heading_of(table);
    for (const std::string& word : {heading.path, heading.kind})
      if (!word.empty() && std::find(words.begin(), words.end(), word) == words.end())
        words.push_back(word);
  }
  return words;
}

/// Arguments of compgen that list the candidates for a value of this name. Empty if the value can
/// be any text.
std::string candidates(const std::string& value, const Words& commands) {
  const auto words = [](const Words& list) { return "-W '" + joined(list, " ") + "'"; };
  if (value == "SCENE") return "-o plusdirs -f -X '!*.toml'";
  if (value == "DIR") return "-d";
  if (value == "FILE" || value == "FILE|DIR") return "-f";
  if (value == "WORD") return words(words_of_keys());
  if (value == "EXAMPLE") return words(names_of(gallery_scenes()));
  if (value == "TOPIC") {
    Words topics = names_of(guide_topics());
    topics.insert(topics.end(), commands.begin(), commands.end());
    return words(topics);
  }
  return "";
}

/// The branch of the shell's `case` that completes one command.
std::string branch_of(const CommandText& command, const Words& commands) {
  Words names;
  std::string before, place;
  for (const OptionText& option : command.options) {
    names.insert(names.end(), option.names.begin(), option.names.end());
    const std::string list = candidates(option.value, commands);
    if (option.names.empty())
      place = list;
    else if (!option.value.empty())
      before += fmt::format("        {}) list=({}) ;;\n", joined(option.names, "|"), list);
  }
  return fmt::format(
      "    {})\n"
      "      case $before in\n"
      "{}"
      "        *) list=({}) options='{}' ;;\n"
      "      esac ;;\n",
      command.name, before, place, joined(names, " "));
}

/// Escapes text for roff: a backslash, and a point or quote at the beginning of a line.
std::string roff(const std::string& text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool begins_line = i == 0 || text[i - 1] == '\n';
    if (begins_line && (text[i] == '.' || text[i] == '\'')) result += "\\&";
    if (text[i] == '\\')
      result += "\\e";
    else if (text[i] == '-')
      result += "\\-";
    else
      result += text[i];
  }
  return result;
}

std::string synopsis(const CommandText& command) {
  std::string text = "meniscus " + command.name;
  for (const OptionText& option : command.options)
    if (option.names.empty())
      text += option.required ? " " + option.value : " [" + option.value + "]";
  return text + (command.options.size() > 1 ? " [options]" : "");
}

}  // namespace

std::string bash_completion(const std::vector<CommandText>& commands) {
  Words names;
  for (const CommandText& command : commands) names.push_back(command.name);
  std::string branches;
  for (const CommandText& command : commands) branches += branch_of(command, names);
  return fmt::format(
      "# Completion of meniscus for bash, as `meniscus completion` prints it.\n"
      "_meniscus() {{\n"
      "  local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD - 1]}}\n"
      "  local list=() options=\n"
      "  if ((COMP_CWORD == 1)); then\n"
      "    mapfile -t COMPREPLY < <(compgen -W '{} --help' -- \"$word\")\n"
      "    return\n"
      "  fi\n"
      "  case ${{COMP_WORDS[1]}} in\n"
      "{}"
      "  esac\n"
      "  [[ $word == -* ]] && list=()\n"
      "  mapfile -t COMPREPLY < <(\n"
      "    [[ $word == -* ]] && compgen -W \"$options\" -- \"$word\"\n"
      "    ((${{#list[@]}})) && compgen \"${{list[@]}}\" -- \"$word\"\n"
      "  )\n"
      "}}\n"
      "complete -o filenames -F _meniscus meniscus\n",
      joined(names, " "), branches);
}

std::string manual_page(const std::vector<CommandText>& commands, const std::string& version,
                        const std::string& description, const std::string& exit_codes) {
  std::string page = fmt::format(
      ".TH MENISCUS 1 \"\" \"meniscus {}\" \"User commands\"\n"
      ".SH NAME\nmeniscus \\- meshfree simulator of drops, solids and cells\n"
      ".SH SYNOPSIS\n.B meniscus\n.I command\n[\n.I options\n]\n"
      ".SH DESCRIPTION\n{}\n",
      version, roff(description));
  for (const CommandText& command : commands) {
    page += fmt::format(".SH {}\n.B {}\n.PP\n{}\n", roff(command.name), roff(synopsis(command)),
                        roff(command.meaning));
    for (const OptionText& option : command.options) {
      const std::string names = joined(option.names, ", ");
      page += fmt::format(".TP\n.B {}{}{}\n{}\n", roff(names),
                          names.empty() || option.value.empty() ? "" : " ", roff(option.value),
                          roff(option.meaning));
    }
  }
  page += ".SH EXIT STATUS\n.nf\n" + roff(exit_codes) +
          "\n.fi\n.SH TOPICS\n.B meniscus help TOPIC\n" +
          "prints one of: " + joined(names_of(guide_topics()), ", ") + ".\n";
  return page;
}

}  // namespace meniscus
