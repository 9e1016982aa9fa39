// What an agent observes in symbols: facts, skills, goal, plan, and texts of them.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/record/atom_formula.h"
#include "engine/rollout/rollout.h"
#include "stampede/environment.h"

namespace stampede {

// Lifetime: refers to all that it is made of. Unless the settings say `hidden`, facts are those that are known.
class SymbolChannels {
 public:
  struct Channel {
    std::string_view name;
    ChannelValue (*value)(SymbolChannels& of);  // at a frame, without its name
  };
  static std::span<const Channel> all();
  static const Channel* find(std::string_view name);  // null: there is no such channel

  SymbolChannels(Rollout& rollout, const RunOptions& options, const EnvironmentSettings& settings);

  const std::vector<Fact>& atoms() const { return atoms_; }  // basic ones, then derived ones
  const std::vector<PlanStep>& skills() const { return skills_; }
  const std::vector<std::uint8_t>& feasible();      // of each skill, now
  const Facts& facts();                             // that the agent may know of
  Facts last_facts() { return std::move(facts_); }  // as they were when they were last asked for

  // After the world was put back: nothing that was seen so far counts.
  void forget();

 private:
  void enumerate_atoms();
  void enumerate_skills();
  std::vector<std::uint8_t> row_of(const Facts& facts) const;  // which atoms hold
  const std::vector<std::uint8_t>& row();                      // of facts()
  AtomFormula compiled(const Formula& formula) const;
  double progress();
  const std::vector<double>& goal();
  std::vector<std::string> plan();
  std::string pddl() const;
  std::vector<std::string> sentences();

  Rollout& rollout_;
  const RunOptions& options_;
  const EnvironmentSettings& settings_;
  std::vector<Fact> atoms_;
  AtomPlaces places_;
  std::vector<PlanStep> skills_;
  // To ask for all things of a kind is most of the work: such parts are compiled when the others hold the first time.
  struct Precondition {
    AtomFormula plain;
    std::optional<AtomFormula> quantified;
  };
  std::vector<Precondition> preconditions_;  // of skills_, once asked for
  std::optional<AtomFormula> goal_;
  std::vector<double> wanted_;  // of the stage wanted_at_
  std::vector<std::uint8_t> row_, feasible_;
  Facts facts_;
  std::int64_t facts_at_ = -1, row_at_ = -1, feasible_at_ = -1, plan_at_ = -1, wanted_at_ = -1;
  std::vector<std::string> plan_;
};

}  // namespace stampede
