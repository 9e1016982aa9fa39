#include "scripting/sentences/paraphrase.h"

#include <fmt/format.h>

#include <algorithm>
#include <ostream>
#include <set>

#include "engine/base/random.h"
#include "scripting/commands/commands.h"
#include "scripting/commands/language_options.h"
#include "scripting/sentences/meaning_of.h"
#include "scripting/session/episode_job.h"

namespace stampede::program {
namespace {

template <typename Value, typename From>
std::vector<Value> chosen(const Arguments& arguments, const char* option, Value initial, From&& from,
                          const char* choices) {
  std::vector<Value> values;
  for (const std::string& text : arguments.list(option)) {
    const auto value = from(text);
    if (!value) throw UsageError(std::string(option) + " is one of " + choices + ", not '" + text + "'");
    values.push_back(*value);
  }
  if (values.empty()) values.push_back(initial);
  return values;
}

// What is asked of one task.
struct Asked {
  std::vector<LanguageLevel> levels;
  std::vector<Grain> grains;
  std::int64_t seed = 0;
  int count = 10, each_request = 5;
};

// Of one task: what its author says, and what the file beside it has.
struct TaskSentences {
  std::vector<OwnSentences> own;
  SentenceFile made;
  std::filesystem::path path;
};

Asked asked_of(const Arguments& arguments) {
  Asked asked;
  asked.levels =
      chosen(arguments, "--level", LanguageLevel::task, language_level_from, "task, world, subgoal, skill, motion");
  asked.grains = chosen(arguments, "--grain", Grain::goal, language_grain_from, "goal, steps, motions");
  asked.seed = in_range(arguments, "--seed", 0, kLargestSeed);
  asked.count = static_cast<int>(in_range(arguments, "--count", 1, 1000));
  asked.each_request = static_cast<int>(in_range(arguments, "--each", 1, 100));
  return asked;
}

class Asker {
 public:
  Asker(const Arguments& arguments, std::shared_ptr<const Library> library, Console& console)
      : library_(std::move(library)),
        console_(console),
        asked_(asked_of(arguments)),
        variation_(arguments.text("--variation")),
        show_refused_(arguments.flag("--show-refused")),
        json_(arguments.flag("--json")),
        dry_(arguments.flag("--dry-run")) {
    if (!dry_) client_.emplace(chat_settings(arguments));
    for (const std::string& name : arguments.list("TASK")) tasks_.push_back(task_info(*library_, name).name);
    if (arguments.has("--out") && tasks_.size() > 1)
      throw UsageError("--out is for one task", "leave it out: each file stands beside its task");
    out_ = arguments.text("--out");
  }

  ExitCode run() {
    try {
      for (const std::string& task : tasks_) ask_about(task);
    } catch (const Error& error) {
      if (error.where() != "interrupted") {
        finish();
        throw;
      }
      interrupted_ = true;
    }
    finish();
    if (interrupted_) console_.err << "interrupted: what is done is kept; the same command goes on from there\n";
    if (interrupted_) return kInterrupted;
    return total_.asked > 0 && total_.received == 0 ? kNo : kDone;
  }

 private:
  void ask_about(const std::string& task) {
    const std::filesystem::path path = out_.empty() ? sentence_path_of(*library_, task) : std::filesystem::path(out_);
    SentenceFile file;
    file.task = task;
    if (!dry_) check_output(path, {"a file of sentences", {}, true}, {});  // ahead of what costs money
    if (!dry_ && std::filesystem::exists(path)) file = read_sentence_file(path, path.string());
    if (file.task != task) throw Error(path.string(), "it is of task '" + file.task + "'", "name another --out");
    TaskSentences sentences{sentences_of(library_, task), std::move(file), path};
    for (const LanguageLevel level : asked_.levels) {
      const bool of_goal = level == LanguageLevel::task || level == LanguageLevel::subgoal;
      for (const std::string& name : names_for(task, level, sentences.own))
        for (const Grain grain : of_goal ? asked_.grains : std::vector<Grain>{Grain::goal})
          ask(sentences, {level, name, grain, asked_.count, asked_.each_request, asked_.seed});
    }
  }

  void ask(TaskSentences& sentences, const ParaphraseJob& job) {
    if (console_.stopped()) throw Error("interrupted", "");
    const std::string& task = sentences.made.task;
    const SentenceChecker checker(*meaning_for(library_, {task, job.level, job.of}, job.seed, sentences.own));
    if (dry_) {
      const std::vector<ChatRequest> requests = requests_of(job, checker.meaning());
      for (std::size_t i = 0; i < requests.size(); ++i)
        if (i == 0 || prompt_text(requests[i]) != prompt_text(requests[i - 1]))
          console_.out << prompt_text(requests[i]) << "\n";
      console_.out << fmt::format("{} {} {}: {} requests, with other seeds\n\n", task, to_string(job.level), job.of,
                                  requests.size());
      return;
    }
    std::vector<Refused> refused;
    const ParaphraseTally tally = paraphrase(job, checker, distractors(task, job.level, sentences.own), *client_,
                                             sentences.made, console_.stop, show_refused_ ? &refused : nullptr);
    if (tally.jobs_there == 0) write_sentence_file(sentences.made, sentences.path);
    total_.add(tally);
    console_.err << fmt::format(
        "{} {} {} {}: {}\n", task, to_string(job.level), job.of, to_string(job.grain),
        tally.jobs_there > 0 ? "is there already" : fmt::format("{} of {} pass", tally.passed, tally.received));
    for (const Refused& one : refused) console_.err << fmt::format("  {} ({}): {}\n", one.reason, one.detail, one.text);
  }

  std::vector<std::string> names_for(const std::string& task, LanguageLevel level,
                                     const std::vector<OwnSentences>& all) const {
    if (level != LanguageLevel::task && level != LanguageLevel::subgoal) return labels_for(task, level, all);
    const std::vector<std::string> variations = matching_variations(task_info(*library_, task), variation_);
    if (level == LanguageLevel::task) return variations;
    std::vector<std::string> names;
    for (const OwnSentences& one : all)
      if (std::find(variations.begin(), variations.end(), one.variation) != variations.end())
        for (const Subgoal& subgoal : one.subgoals) names.push_back(subgoal_key(subgoal.name, one.variation));
    if (names.empty())
      throw Error(task, "it has no subgoals with a sentence to say in other words",
                  "give it some: subgoals = { { \"open_it\", is.open(…), \"open the drawer\" } }");
    return names;
  }

  // Of skills those that the plan of the first variation has.
  std::vector<std::string> labels_for(const std::string& task, LanguageLevel level,
                                      const std::vector<OwnSentences>& all) const {
    std::set<std::string> skills;
    if (level == LanguageLevel::skill)
      for (const auto& [skill, sense] : meaning_of(library_, task, all.front().variation, asked_.seed, all).skills)
        skills.insert(skill);
    std::vector<std::string> names;
    for (const auto& [name, label] : labels_of(*library_, level))
      if (level != LanguageLevel::skill || skills.contains(name)) names.push_back(name);
    return names;
  }

  // Goals of other variations, and of other tasks.
  std::vector<std::string> distractors(const std::string& task, LanguageLevel level,
                                       const std::vector<OwnSentences>& all) const {
    std::vector<std::string> others;
    if (level == LanguageLevel::task || level == LanguageLevel::subgoal) {
      std::vector<std::string> near, far;
      for (const OwnSentences& one : all) {
        if (level == LanguageLevel::task) near.push_back(one.sentences.front());
        if (level == LanguageLevel::subgoal)
          for (const Subgoal& subgoal : one.subgoals) near.push_back(subgoal.sentence);
      }
      for (const ScriptFile* file : library_->files(DefinitionKind::task)) {
        const Library::TaskInfo* info = library_->task(file->name);
        if (info != nullptr && info->name != task && !info->instructions.empty() &&
            info->instructions.front().find('{') == std::string::npos)
          far.push_back(info->instructions.front());
      }
      Random random(RandomKey("other goals").with(task).with(asked_.seed));
      random.shuffle(near);
      random.shuffle(far);
      near.resize(std::min<std::size_t>(near.size(), 2));
      others = std::move(near);
      others.insert(others.end(), far.begin(), far.end());
    } else {
      for (const auto& [name, label] : labels_of(*library_, level)) others.push_back(label);
      Random(RandomKey("other labels").with(asked_.seed)).shuffle(others);
    }
    return others;
  }

  void finish() {
    if (dry_) return;
    if (json_) {
      JsonText json;
      json.object().field("asked", total_.asked).field("received", total_.received).field("passed", total_.passed);
      json.field("there_already", total_.jobs_there).field("interrupted", interrupted_).key("refused").object();
      for (const auto& [reason, count] : total_.refused) json.field(reason, count);
      write_cost(client_->cost(), client_->settings(), json.end());
      console_.out << json.end().text();
      return;
    }
    console_.out << fmt::format("{} asked for, {} received, {} passed", total_.asked, total_.received, total_.passed);
    if (total_.jobs_there > 0) console_.out << fmt::format(", {} times it was there already", total_.jobs_there);
    console_.out << "\n";
    for (const auto& [reason, count] : total_.refused) console_.out << fmt::format("{:>6} {}\n", count, reason);
    console_.out << cost_line(client_->cost(), client_->settings());
  }

  std::shared_ptr<const Library> library_;
  Console& console_;
  Asked asked_;
  std::string variation_, out_;
  bool show_refused_, json_, dry_, interrupted_ = false;
  std::vector<std::string> tasks_;
  std::optional<ChatClient> client_;
  ParaphraseTally total_;
};

ExitCode do_paraphrase(const Arguments& arguments, Console& console) {
  return Asker(arguments, load_library(arguments), console).run();
}

}  // namespace

CommandRow paraphrase_command() {
  CommandRow row{
      "paraphrase",
      "Ask a language model for more sentences, check each, and keep what passes",
      "For each variation a start is made, the model is told what stands there and asked for other ways to say what is "
      "to be "
      "done. Nothing is believed: a parser of our own checks names, colours, counts, order and sides against the "
      "scene, then the model is asked back which of the scene's things and which goal its sentence means, and "
      "near-duplicates go. What passes is stored beside the task, in tasks/NAME.sentences.json, where `run "
      "--sentences` takes it from; what fails is counted by reason. What the file has already is not asked again, and "
      "Ctrl-C keeps what is done. The server speaks the usual chat-completions protocol; its key is read from "
      "STAMPEDE_LLM_KEY and neither shown nor stored.",
      {{"TASK", "names of tasks", true, true}},
      {{"--variation", "TEXT", "only this variation, or those with some axes: colour=red", Takes::text, "", {}, false},
       {"--seed", "S", "of the start, and of what is asked", Takes::integer, "0", {}, false},
       {"--count", "N", "sentences to ask for, for each variation, level and grain", Takes::integer, "10", {}, false},
       {"--each", "N", "of these, in one request; small models do better with 1", Takes::integer, "5", {}, false},
       {"--grain",
        "NAME",
        "how much a task's or subgoal's sentence says: goal (which is taken), steps, motions",
        Takes::text,
        "",
        {},
        true},
       {"--level",
        "NAME",
        "what is said in other words: task (which is taken), world, subgoal, skill, motion",
        Takes::text,
        "",
        {},
        true},
       {"--dry-run", "", "print what would be asked, and ask nobody", Takes::flag, "", {}, false},
       {"--show-refused", "", "tell each sentence that does not pass, and why", Takes::flag, "", {}, false},
       {"--out", "FILE", "instead of the file beside the task", Takes::path, "", {}, false}},
      {"stampede paraphrase stack_blocks --variation colour=red,height=3 --dry-run",
       "stampede paraphrase put_item_in_drawer --variation level=top --grain steps --count 20 --dry-run"},
      do_paraphrase};
  for (OptionRow& option : model_options()) row.options.push_back(std::move(option));
  return row;
}

}  // namespace stampede::program
