// The only file that includes CLI11.
#include "scripting/program/command_line.h"

#include <poll.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <ostream>

#include "engine/base/error.h"
#include "engine/base/naming.h"
#include "engine/base/output_file.h"
#include "engine/base/stopping.h"
#include "engine/base/text.h"
#include "scripting/library/library.h"
#include "scripting/program/help.h"
#include "scripting/program/json_text.h"
#include "scripting/program/printable_stream.h"

namespace stampede::program {

bool Arguments::has(std::string_view name) const {
  const auto found = values_.find(name);
  return found != values_.end() && found->second.given;
}

std::string Arguments::text(std::string_view name) const {
  const std::vector<std::string>& values = list(name);
  return values.empty() ? std::string() : values.back();
}

const std::vector<std::string>& Arguments::list(std::string_view name) const {
  static const std::vector<std::string> none;
  const auto found = values_.find(name);
  return found == values_.end() ? none : found->second.values;
}

std::optional<std::int64_t> Arguments::integer(std::string_view name) const {
  const std::string value = text(name);
  if (value.empty()) return std::nullopt;
  return std::stoll(value);
}

void Arguments::set(std::string name, std::vector<std::string> values, bool given) {
  values_[std::move(name)] = {std::move(values), given};
}

namespace {

struct Usage {  // thrown for command lines that make no sense
  std::string message, hint;
};

void check_value(const OptionRow& option, const std::string& value) {
  if (option.takes == Takes::integer) {
    std::int64_t number = 0;  // read by from_chars: CLI11 takes a number that is too large for the largest there is
    const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
    if (error == std::errc::result_out_of_range) throw Usage{option.name + ": " + value + " is too large a number", ""};
    if (error != std::errc() || end != value.data() + value.size()) {
      throw Usage{option.name + " takes a whole number, not '" + value + "'", ""};
    }
  }
  if ((option.takes == Takes::path || option.takes == Takes::output) && value.empty())
    throw Usage{option.name + " needs a path", option.help};
  if (!option.choices.empty() && std::find(option.choices.begin(), option.choices.end(), value) == option.choices.end())
    throw Usage{option.name + " cannot be '" + value + "'", "it is one of " + joined(option.choices)};
}

// CLI11's own words for a mistake, with the nearest option as cure where there is one.
[[noreturn]] void throw_usage(const CLI::ParseError& error, const CommandRow& command, const CLI::App& app) {
  const std::vector<std::string> rest = app.remaining();
  std::string hint = "see stampede " + command.name + " --help";
  if (const auto word = std::find_if(rest.begin(), rest.end(), [](const auto& w) { return w.rfind('-', 0) == 0; });
      word != rest.end()) {
    std::vector<std::string> names;
    for (const OptionRow& option : all_options(command)) names.push_back(option.name);
    if (const auto near = nearest(*word, names)) hint = "did you mean " + *near + "?";
    throw Usage{"stampede " + command.name + " has no option " + *word, hint};
  }
  const std::string what = error.what(), name = what.substr(0, what.find(':'));
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr && name.rfind("--", 0) == 0) {
    const bool missing = what.find("missing") != std::string::npos;
    throw Usage{name + (missing ? " needs a value" : " is given more than once"), hint};
  }
  throw Usage{what, hint};
}

void place_positionals(const CommandRow& command, const std::vector<std::string>& places, Arguments& arguments) {
  auto next = places.begin();
  auto rows_after = static_cast<std::ptrdiff_t>(command.positionals.size());
  for (const PositionalRow& row : command.positionals) {
    // One that repeats leaves a word for each row after it, where there are so many.
    const std::ptrdiff_t left = places.end() - next, most = row.repeats ? left - --rows_after : (--rows_after, 1);
    const auto end = next + std::min(left, std::max<std::ptrdiff_t>(most, 1));
    if (row.required && next == end) throw Usage{"stampede " + command.name + " needs " + row.name, row.help};
    for (auto place = next; place != end; ++place) arguments.add_input(*place);
    arguments.set(row.name, {next, end}, next != end);
    next = end;
  }
  if (next != places.end()) {
    throw Usage{"too many arguments: '" + *next + "' has no place", "see stampede " + command.name + " --help"};
  }
}

// A folder is not standard output. Two outputs of one command in one place: the second would replace the first.
void check_outputs(const CommandRow& command, const Arguments& arguments) {
  std::map<std::filesystem::path, std::string> places;
  for (const OptionRow& row : all_options(command)) {
    if (row.takes != Takes::output || !arguments.has(row.name)) continue;
    const bool folder = row.value == "FOLDER" || row.value == "DIR";
    if (folder && is_standard_output(arguments.text(row.name)))
      throw Usage{row.name + " is a folder, and standard output is none", "name a folder"};
    const std::filesystem::path path = std::filesystem::absolute(arguments.text(row.name)).lexically_normal();
    const auto [there, is_new] = places.emplace(path, row.name);
    if (!is_new) throw Usage{there->second + " and " + row.name + " are one file", "name two"};
  }
}

Arguments parse(const CommandRow& command, std::vector<std::string> words) {
  CLI::App app;
  app.set_help_flag();
  app.allow_extras(false);
  std::map<std::string, std::vector<std::string>> values;  // nodes stay where they are: CLI11 keeps references
  std::map<std::string, CLI::Option*> options;
  for (const OptionRow& row : all_options(command)) {
    if (row.takes == Takes::flag) {
      options[row.name] = app.add_flag(row.name);
      continue;
    }
    options[row.name] =
        app.add_option(row.name, values[row.name])
            ->expected(1)
            ->multi_option_policy(row.repeats ? CLI::MultiOptionPolicy::TakeAll : CLI::MultiOptionPolicy::Throw);
    options[row.name]->allow_extra_args(false);  // the next word is an argument of the command
  }
  std::vector<std::string> places;  // shared out by hand: CLI11 gives the first positional all it can
  app.add_option("words", places)->expected(0, 1 << 20);
  std::reverse(words.begin(), words.end());  // CLI11 takes vectors from the back
  try {
    app.parse(words);
  } catch (const CLI::ParseError& error) {
    throw_usage(error, command, app);
  }
  Arguments arguments;
  for (const OptionRow& row : all_options(command)) {
    const bool given = options[row.name]->count() > 0;
    for (const std::string& value : values[row.name]) check_value(row, value);
    if (!given && !row.initial.empty()) values[row.name] = {row.initial};
    if (row.takes == Takes::path)
      for (const std::string& value : values[row.name]) arguments.add_input(value);
    arguments.set(row.name, values[row.name], given);
  }
  if (arguments.has("--help")) return arguments;
  place_positionals(command, places, arguments);
  check_outputs(command, arguments);
  return arguments;
}

bool takes_standard_output(const CommandRow& command, const Arguments& arguments) {
  return std::any_of(command.options.begin(), command.options.end(), [&](const OptionRow& row) {
    return row.takes == Takes::output && arguments.has(row.name) && is_standard_output(arguments.text(row.name));
  });
}

ExitCode complain(const std::string& kind, const std::string& message, ExitCode code, Console& console) {
  console.out.flush();
  console.err << kind << message << std::endl;
  return code;
}

// Machines read these as they are.
bool answers_exactly(const Arguments& arguments) {
  const std::string format = arguments.text("--format");
  return arguments.has("--json") || format == "json" || format == "csv";
}

// Data that goes to standard output goes alone: what else is told is told on standard error.
ExitCode run(const CommandRow& command, const Arguments& arguments, Console& console) {
  const bool alone = takes_standard_output(command, arguments);
  Console told{alone                        ? console.err
               : answers_exactly(arguments) ? *console.data
                                            : console.out,
               console.err,
               alone ? console.err_is_terminal : console.out_is_terminal,
               console.err_is_terminal,
               console.width,
               console.stop,
               console.data,
               console.bare_err};
  return command.run(arguments, told);
}

ExitCode dispatch(const std::vector<CommandRow>& commands, const std::vector<std::string>& words, Console& console) {
  if (words.empty()) throw Usage{"which command?", "see stampede --help"};
  if (words[0] == "help" && words.size() == 2) return dispatch(commands, {words[1], "--help"}, console);
  if (words[0] == "--help" || words[0] == "help" || words[0] == "-h") {
    console.out << program_help(commands);
    return kDone;
  }
  if (words[0] == "--version") {
    console.out << "stampede " STAMPEDE_VERSION "\n";
    return kDone;
  }
  std::vector<std::string> names;
  for (const CommandRow& command : commands) {
    names.push_back(command.name);
    if (command.name != words[0]) continue;
    const Arguments arguments = parse(command, {words.begin() + 1, words.end()});
    if (arguments.has("--help")) {
      console.out << command_help(command);
      return kDone;
    }
    return run(command, arguments, console);
  }
  const auto near = nearest(words[0], names);
  throw Usage{"there is no command '" + words[0] + "'", near ? "did you mean '" + *near + "'?" : "see stampede --help"};
}

// Standard output is a pipe that nobody reads any more.
bool reader_has_left() {
  pollfd output{STDOUT_FILENO, 0, 0};
  return ::poll(&output, 1, 0) > 0 && (output.revents & POLLERR) != 0;
}

}  // namespace

ExitCode run_program(const std::vector<CommandRow>& commands, const std::vector<std::string>& words, Console& bare) {
  const StopScope scope(bare.stop);
  PrintableStream out(bare.out), err(bare.err);
  Console console{out, err, bare.out_is_terminal, bare.err_is_terminal, bare.width, bare.stop, &bare.out, &bare.err};
  try {
    const ExitCode code = dispatch(commands, words, console);
    bare.out.flush();
    if (!bare.out && reader_has_left()) return code;  // `| head`: it has what it wanted
    if (!bare.out) return complain("stampede: ", "the answer could not be written", kBadInput, console);
    return code;
  } catch (const Usage& usage) {
    return complain("stampede: ", usage.message + (usage.hint.empty() ? "" : "\n    " + usage.hint), kUsage, console);
  } catch (const LibraryError& error) {
    for (const Error& one : error.errors()) console.err << one.what() << "\n";
    return complain(
        "stampede: ",
        std::to_string(error.errors().size()) + (error.errors().size() == 1 ? " mistake" : " mistakes") + " in scripts",
        kBadInput, console);
  } catch (const CatalogueError& error) {
    return complain("", error.what(), kCatalogue, console);
  } catch (const UsageError& error) {
    return complain("stampede: ", error.what(), kUsage, console);
  } catch (const Error& error) {
    return complain("", error.what(), kBadInput, console);
  } catch (const Interrupted&) {
    return complain("", "interrupted", kInterrupted, console);
  } catch (const std::exception& error) {
    return complain("stampede: a bug of ours: ", error.what(), kBug, console);
  }
}

}  // namespace stampede::program
