#include "scripting/session/policies_fit.h"

#include "engine/base/error.h"
#include "engine/rollout/skill_policy.h"
#include "scripting/library/source_lines.h"
#include "scripting/session/start_question.h"

namespace stampede {
namespace {

using Complaints = std::map<std::string, Error>;  // by skill, or by the hash of a file

std::optional<Error> complaint_about(const ScriptFile& file, const RunOptions& options) {
  if (file.kind == DefinitionKind::task || file.source.find("policy") == std::string::npos) return std::nullopt;
  for (const std::string& name : mentions_in(file.source).policies) {
    try {
      policy_entry(options, name);
    } catch (const Error& error) {
      return Error(file.shown_path, error.where() + ": " + error.message(), error.hint());
    }
  }
  return std::nullopt;
}

// Of skills that ask for one that is not there: themselves, or by a skill or file that they use.
Complaints complaints(const Library& library, const RunOptions& options) {
  Complaints of_files, of_skills;
  for (const ScriptFile* file : library.all_files())
    if (auto complaint = complaint_about(*file, options)) of_files.emplace(file->hash, *complaint);
  if (of_files.empty()) return {};
  for (const ScriptFile* skill : library.files(DefinitionKind::skill))
    for (const ScriptFile* used : library.used_by({skill}))
      if (const auto found = of_files.find(used->hash); found != of_files.end())
        of_skills.emplace(skill->name, found->second);
  return of_skills;
}

void check_policies_of(const std::shared_ptr<const Library>& library, const Complaints& bad, const EpisodeJob& job,
                       const RunOptions& options, const std::atomic<bool>* stop) {
  PreparedEpisode prepared(library, job, options);
  const StartQuestion question = question_at_start(prepared.scripts(), prepared.options(), stop);
  if (question.start.reason != Reason::none) return;
  const PlanOutcome plan = question.said ? *question.said : solve(question.asked.domain, question.asked.problem);
  for (const PlanStep& step : plan.plan) {
    const Action* action = prepared.scripts().symbols().domain().action(step.action);
    const auto found = bad.find(action == nullptr ? step.action : action->skill);
    if (found != bad.end()) throw Error(found->second);
  }
}

}  // namespace

void check_policies(const std::shared_ptr<const Library>& library, const std::vector<EpisodeJob>& jobs,
                    const RunOptions& options, const std::atomic<bool>* stop) {
  if (options.behaviour != Behaviour::plan) return;  // which skills it draws is told by nothing
  const Complaints bad = complaints(*library, options);
  if (bad.empty()) return;
  for (const EpisodeJob& job : jobs) check_policies_of(library, bad, job, options, stop);
}

}  // namespace stampede
