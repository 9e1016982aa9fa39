// Options about language models and their sentences, shared by the commands that have them.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "engine/episode/runner.h"
#include "scripting/program/command.h"
#include "scripting/program/json_text.h"
#include "scripting/sentences/chat_client.h"
#include "scripting/sentences/sentence_file.h"

namespace stampede::program {

std::vector<OptionRow> model_options();  // --url, --model, --timeout, --retries, --rate, --price-in, --price-out

// Of the options, or else of STAMPEDE_LLM_URL, STAMPEDE_LLM_MODEL; the key of STAMPEDE_LLM_KEY alone: a command line is
// seen by others. Throws UsageError where something is missing or makes no sense.
ChatSettings chat_settings(const Arguments& arguments);

std::string cost_line(const ChatCost& cost, const ChatSettings& settings);
void write_cost(const ChatCost& cost, const ChatSettings& settings, JsonText& json);

// In the last of the roots that has one; else beside the task's file.
std::filesystem::path sentence_path_of(const Library& library, const std::string& task);
std::string shown_sentence_path(const Library& library, const std::string& task);

// Of each task, for RunSettings::sentences; tells of variations without any. Throws Error where a task has no file.
std::map<std::string, std::vector<MadeSentence>> made_sentences(const Library& library,
                                                                const std::vector<std::string>& tasks,
                                                                Console& console);

}  // namespace stampede::program
