// The commands of the program; commands.cpp is the list.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "engine/base/output_file.h"
#include "scripting/program/command.h"

namespace stampede {
class Library;
struct EngineInfo;
struct Roots;
struct ScriptFile;
}  // namespace stampede

namespace stampede::program {

const std::vector<CommandRow>& all_commands();

CommandRow list_command();
CommandRow check_command();
CommandRow run_command();
CommandRow evaluate_command();
CommandRow show_command();
CommandRow plan_command();
CommandRow validate_command();
CommandRow export_command();
CommandRow import_command();
CommandRow paraphrase_command();
CommandRow query_command();
CommandRow dataset_command();
CommandRow score_command();
CommandRow baseline_command();
CommandRow questions_command();
CommandRow cluster_command();
CommandRow merge_command();
CommandRow index_command();
CommandRow lock_command();
CommandRow make_command();
CommandRow verify_command();
CommandRow replay_command();
CommandRow render_command();
CommandRow new_command();
CommandRow doc_command();

std::int64_t episode_number(const std::string& text);  // throws UsageError

// What --root and --path name. What has mistakes is left out, and only those who use it hear of them (require_sound).
// With tasks these alone are read.
std::shared_ptr<const Library> load_library(const Arguments& arguments, const std::vector<std::string>& tasks = {});
// The same, whatever mistakes files have: for commands that ask only for words of it.
std::shared_ptr<const Library> words_of(const Arguments& arguments);
// On stderr: which files were left out, for they have mistakes, but those that are `told` already.
void tell_left_out(const Library& library, const std::vector<const ScriptFile*>& told, Console& console);
Roots roots_of(const Arguments& arguments);
EngineInfo this_engine();  // as catalogues and locks tell it: the release, and what numbers come out of this build here
// For its outputs: what it reads, and --force.
OutputRules output_rules(const Arguments& arguments, const Console& console);
// For commands that write a file: the last --path is made when it is not there.
void make_own_folder(const Arguments& arguments);

// The number that an option was given. Throws UsageError outside [least, most].
std::int64_t in_range(const Arguments& arguments, const char* option, std::int64_t least, std::int64_t most);
// What --workers says, or a core each.
int workers_of(const Arguments& arguments);
constexpr std::int64_t kMostEpisodes = 1'000'000, kMostWorkers = 256, kLargestSeed = 1'000'000'000'000;

}  // namespace stampede::program
