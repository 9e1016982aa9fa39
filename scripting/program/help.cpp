#include "scripting/program/help.h"

#include <algorithm>

namespace stampede::program {
namespace {

constexpr int kWidth = 100;

std::string usage(const CommandRow& command) {
  std::string text = "stampede " + command.name;
  for (const PositionalRow& row : command.positionals) {
    const std::string name = row.name + (row.repeats ? "..." : "");
    text += row.required ? " " + name : " [" + name + "]";
  }
  return text + " [options]";
}

std::string left_side(const OptionRow& option) {
  return option.value.empty() ? option.name : option.name + " " + option.value;
}

std::string right_side(const OptionRow& option) {
  std::string text = option.help;
  if (!option.choices.empty()) {
    text += ": ";
    for (std::size_t i = 0; i < option.choices.size(); ++i) text += (i == 0 ? "" : ", ") + option.choices[i];
  }
  if (!option.initial.empty()) text += " (" + option.initial + ")";
  return text;
}

struct Row {
  std::string left, right;
};

std::string two_columns(const std::vector<Row>& rows) {
  int left = 0;
  for (const Row& row : rows) left = std::max(left, display_width(row.left));
  std::string text;
  for (const Row& row : rows) {
    text += "  " + padded(row.left, left) + "  " + wrapped(row.right, kWidth, left + 4) + "\n";
  }
  return text;
}

std::vector<Row> option_rows(const std::vector<OptionRow>& options) {
  std::vector<Row> rows;
  for (const OptionRow& option : options) rows.push_back({left_side(option), right_side(option)});
  return rows;
}

constexpr const char* kExitCodes =
    "Exit codes: 0 done; 1 ran and the answer is no; 2 usage; 3 bad input file; 4 catalogue;\n"
    "5 budget spent; 6 interrupted; 70 a bug of ours.\n";

}  // namespace

const std::vector<OptionRow>& common_options() {
  static const std::vector<OptionRow> options = {
      {"--root",
       "DIR",
       "where tasks/, skills/ and worlds/ are; default: those that came with the program",
       Takes::path,
       "",
       {},
       false},
      {"--path", "DIR", "a folder of your own of the same shape, whose files win", Takes::path, "", {}, true},
      {"--json", "", "the answer as JSON", Takes::flag, "", {}, false},
      {"--help", "", "this text", Takes::flag, "", {}, false},
  };
  return options;
}

std::vector<OptionRow> all_options(const CommandRow& command) {
  std::vector<OptionRow> options = command.options;
  const bool writes =
      std::any_of(options.begin(), options.end(), [](const auto& o) { return o.takes == Takes::output; });
  if (writes)
    options.push_back(
        {"--force", "", "replace files and links that stampede did not make", Takes::flag, "", {}, false});
  options.insert(options.end(), common_options().begin(), common_options().end());
  return options;
}

std::string program_help(const std::vector<CommandRow>& commands) {
  std::vector<Row> rows;
  for (const CommandRow& command : commands) rows.push_back({command.name, command.summary});
  return "Stampede runs robot tasks in physics and stores labelled demonstrations in one SQLite file.\n\n"
         "Usage: stampede COMMAND [arguments] [options]\n\nCommands:\n" +
         two_columns(rows) + "\nOptions:\n" +
         two_columns(
             {{"--help", "this text; `stampede COMMAND --help` tells more"}, {"--version", "the program's version"}}) +
         "\n" + kExitCodes;
}

std::string command_help(const CommandRow& command) {
  std::string text = command.summary + ".\n\nUsage: " + usage(command) + "\n\n";
  text += wrapped(command.description, kWidth, 0) + "\n";
  if (!command.positionals.empty()) {
    std::vector<Row> rows;
    for (const PositionalRow& row : command.positionals) rows.push_back({row.name, row.help});
    text += "\nArguments:\n" + two_columns(rows);
  }
  text += "\nOptions:\n" + two_columns(option_rows(all_options(command)));
  if (!command.examples.empty()) {
    text += "\nExamples:\n";
    for (const std::string& example : command.examples) text += "  " + example + "\n";
  }
  return text;
}

std::string command_reference(const std::vector<CommandRow>& commands) {
  std::string text = "# The commands of `stampede`\n\nWritten by `stampede doc` from the table of commands.\n\n";
  text += kExitCodes;
  text += "\n";
  for (const CommandRow& command : commands) {
    text += "## " + command.name + "\n\n```\n" + command_help(command) + "```\n\n";
  }
  text.pop_back();
  return text;
}

std::string bash_completion(const std::vector<CommandRow>& commands) {
  std::string names, cases;
  for (const CommandRow& command : commands) {
    names += (names.empty() ? "" : " ") + command.name;
    std::string words;
    for (const OptionRow& option : all_options(command)) words += option.name + " ";
    words.pop_back();
    cases += "    " + command.name + ") words=\"" + words + "\" ;;\n";
  }
  return "# bash completion of stampede: source this file\n"
         "_stampede() {\n"
         "  local word=\"${COMP_WORDS[COMP_CWORD]}\" words=\"" +
         names +
         " --help --version\"\n"
         "  [ \"$COMP_CWORD\" -gt 1 ] && case \"${COMP_WORDS[1]}\" in\n" +
         cases +
         "  esac\n"
         "  COMPREPLY=($(compgen -W \"$words\" -- \"$word\"))\n"
         "}\n"
         "complete -o default -F _stampede stampede\n";
}

}  // namespace stampede::program
