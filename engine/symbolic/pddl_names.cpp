#include <algorithm>
#include <map>
#include <set>

#include "engine/base/error.h"
#include "engine/base/names.h"
#include "engine/symbolic/pddl_text.h"
#include "engine/symbolic/task_planner.h"

namespace stampede::symbolic {

bool is_pddl_name(std::string_view name) {
  const std::string text = name_text(name, Names::pddl);
  return !text.empty() && text.front() >= 'a' && text.front() <= 'z' &&
         std::all_of(text.begin(), text.end(),
                     [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == '-'; });
}

namespace {

// What Fast Downward and VAL would stumble over: signs, words of PDDL, and names that differ only in case.
class NameCheck {
 public:
  explicit NameCheck(std::string where) : where_(std::move(where)) {}

  void one(const char* kind, const std::string& name) const {
    static const std::set<std::string> kReserved = {"and",    "assign", "decrease", "define",   "either",
                                                    "exists", "forall", "imply",    "increase", "not",
                                                    "number", "object", "or",       "when"};
    const std::string text = name_text(name, Names::pddl);
    if (!is_pddl_name(text)) {
      throw Error(where_, std::string("the ") + kind + " `" + name + "` is not a name in PDDL",
                  "begin with a letter; then letters, digits, `_` and `-`");
    }
    if (kReserved.contains(text)) {
      throw Error(where_, std::string("the ") + kind + " `" + name + "` has a name that PDDL keeps for itself",
                  "choose another");
    }
  }

  void unique(const char* kind, const std::vector<std::string>& names) const {
    std::map<std::string, std::string> seen;
    for (const std::string& name : names) {
      one(kind, name);
      const auto [other, is_new] = seen.try_emplace(name_text(name, Names::pddl), name);
      if (is_new) continue;
      throw Error(
          where_,
          std::string("two of kind ") + kind + ", `" + other->second + "` and `" + name + "`, are one name in PDDL",
          "PDDL does not tell capital letters from small ones");
    }
  }

 private:
  std::string where_;
};

}  // namespace

void check_names(const Domain& domain) {
  const NameCheck check("domain " + domain.name);
  check.one("domain", domain.name);
  std::vector<std::string> types, predicates = names_of(domain.predicates);
  for (const auto& [type, parent] : domain.types) types.push_back(type);
  predicates.insert(predicates.end(), domain.traits.begin(), domain.traits.end());
  check.unique("type", types);
  check.unique("predicate", predicates);
  check.unique("function", names_of(domain.functions));
  check.unique("constant", names_of(domain.constants));
  check.unique("action", names_of(domain.actions));
  for (const Action& action : domain.actions) check.unique("parameter", names_of(action.parameters));
}

void check_names(const Problem& problem) {
  const NameCheck check("problem " + problem.name);
  check.one("problem", problem.name);
  check.unique("object", names_of(problem.objects));
}

}  // namespace stampede::symbolic
