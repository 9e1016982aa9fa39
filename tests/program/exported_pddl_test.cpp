// The PDDL text of every task that ships, as a strict reader sees it: VAL's type checker takes no untyped variable in a
// typed domain, and a plan names the problem's objects.
#include <catch2/catch.hpp>

#include "engine/symbolic/pddl.h"
#include "engine/symbolic/pddl_tokens.h"
#include "scripting/library/library.h"
#include "tests/program/say.h"

namespace stampede::program {
namespace {

using symbolic::Node;

std::vector<std::string> shipped_tasks() {
  std::vector<std::string> names;
  const auto library = Library::load(Roots{{STAMPEDE_SOURCE_DIR}});
  for (const ScriptFile* file : library->files(DefinitionKind::task)) names.push_back(file->name);
  return names;
}

// Appends the variables of a declaration, from item `from` on, that no type follows.
void untyped_of(const Node& list, std::size_t from, std::vector<std::string>& found) {
  for (std::size_t i = from; i < list.items.size(); ++i) {
    const bool is_variable = list.items[i].word.starts_with("?");
    const bool is_typed = i + 2 < list.items.size() && list.items[i + 1].word == "-";
    if (is_variable && !is_typed) found.push_back(std::string(list.items[i].place) + " " + list.items[i].word);
  }
}

void find_untyped(const Node& node, std::vector<std::string>& found) {
  const std::string& head = node.head();
  if ((head == "forall" || head == "exists") && node.items.size() > 1) untyped_of(node.items[1], 0, found);
  if (head == ":derived" && node.items.size() > 1) untyped_of(node.items[1], 1, found);
  for (std::size_t i = 0; i < node.items.size(); ++i) {
    if (head == ":predicates" || head == ":functions") untyped_of(node.items[i], 1, found);
    if (i > 0 && node.items[i - 1].word == ":parameters") untyped_of(node.items[i], 0, found);
    find_untyped(node.items[i], found);
  }
}

std::vector<std::string> untyped(const std::string& text) {
  std::vector<std::string> found;
  find_untyped(symbolic::parse_list(text, "text"), found);
  return found;
}

// What `plan` writes of a task reads back, with every variable typed and no name but the problem's.
void check_written(const std::string& task, const std::string& sized) {
  const Said said = say({"plan", task, sized, "--seed", "5", "--root", STAMPEDE_SOURCE_DIR});
  INFO(task << " " << sized << "\n" << said.err);
  REQUIRE(said.code == kDone);
  const std::size_t at_problem = said.out.find("(define (problem"), at_plan = said.out.find("\n; plan\n");
  REQUIRE(at_problem != std::string::npos);
  REQUIRE(at_plan != std::string::npos);
  const std::string domain_text = said.out.substr(0, at_problem);
  const std::string problem_text = said.out.substr(at_problem, at_plan - at_problem);
  const std::string plan_text = said.out.substr(at_plan);
  CHECK(untyped(domain_text) == std::vector<std::string>{});
  CHECK(untyped(problem_text) == std::vector<std::string>{});

  const Domain domain = domain_from_pddl(domain_text, "domain");
  const Problem problem = problem_from_pddl(problem_text, "problem", domain);
  CHECK(plan_text.find('.') == std::string::npos);
  std::set<std::string> words;
  const Node steps = symbolic::parse_list("(" + plan_text + ")", "plan");
  for (const Node& item : steps.items)
    for (std::size_t i = 1; i < item.items.size(); ++i) words.insert(item.items[i].word);
  for (const TypedObject& object : problem.objects) words.erase(to_pddl_name(object.name));
  CHECK(words == std::set<std::string>{});
}

}  // namespace

TEST_CASE("the domains of all tasks type every variable, and plans name the problem's objects") {
  check_written(GENERATE(from_range(shipped_tasks())), "--pddl");
}

TEST_CASE("domains cut to their task type every variable, and plans name the problem's objects") {
  check_written(GENERATE(from_range(shipped_tasks())), "--task-sized");
}

TEST_CASE("a plan is read with the problem's names and with ours") {
  CHECK(plan_from_text("(open chest--top_drawer)\n", "plan") == plan_from_text("(open chest.top_drawer)\n", "plan"));
  CHECK(to_pddl(Plan{{"open", {"chest.top_drawer", "panda.hand"}}}) == "(open chest--top_drawer panda--hand)\n");
}

}  // namespace stampede::program
