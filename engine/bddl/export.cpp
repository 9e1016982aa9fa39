#include "engine/bddl/export.h"

#include <algorithm>
#include <cctype>

#include "engine/base/error.h"
#include "engine/bddl/express.h"

namespace stampede {
namespace symbolic {
namespace {

using Kind = BddlFormula::Kind;

std::string plain_language(const std::string& instruction) {
  std::string text;
  for (const char c : instruction) {
    const bool drop = c == '(' || c == ')' || c == ';' || std::isspace(static_cast<unsigned char>(c)) != 0;
    const bool blank = text.empty() || text.back() == ' ';
    if (!drop) text += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    if (drop && !blank) text += ' ';
  }
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text;
}

std::string file_name(const std::string& language, const BddlMapping& mapping) {
  if (mapping.dialect == BddlDialect::behavior) return "problem0.bddl";
  std::string name;
  for (const char c : language) {
    const bool good = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-';
    if (good) name += c;
    if (!good && !name.empty() && name.back() != '_') name += '_';
  }
  return (name.empty() ? "task" : name) + ".bddl";
}

class Exporter {
 public:
  Exporter(const BddlScene& scene, const BddlMapping& mapping, const Domain& domain)
      : scene_(scene),
        mapping_(mapping),
        domain_(domain),
        naming_(scene_, mapping_, result_),
        expression_(scene_, mapping_, domain_, naming_, result_) {}

  BddlExport run() {
    BddlProblem& problem = result_.problem;
    problem.dialect = mapping_.dialect;
    problem.domain = mapping_.domain;
    const std::string language = plain_language(scene_.instruction);
    problem.name = plain_language(libero() ? mapping_.problem_name : scene_.task + "-0");
    if (libero()) problem.language = language;
    result_.file_name = file_name(language, mapping_);
    naming_.name_all();
    try {
      write_goal();  // first: what it needs is known when :init is written
    } catch (const Refusal& refusal) {
      result_.refusal = refusal.why;
      return std::move(result_);
    }
    libero() ? write_libero_init() : write_behavior_init();
    for (const std::string& name : scene_.interest) {
      if (libero() && result_.names.count(name) > 0) {
        naming_.declare(name);
        problem.interest.push_back(result_.names.at(name));
      }
    }
    remark_half_open();
    if (!unsaid_.empty()) {
      std::string list;
      for (const std::string& predicate : unsaid_) list += (list.empty() ? "" : " ") + predicate;
      result_.remarks.push_back("facts of these predicates are left out of :init: " + list);
    }
    drop_unused_regions();
    result_.text = to_bddl(problem);
    return std::move(result_);
  }

 private:
  bool libero() const { return mapping_.dialect == BddlDialect::libero; }

  void write_goal() {
    BddlFormula goal = expression_.formula(scene_.goal);
    const bool constant = goal.parts.empty() && goal.kind != Kind::atom;
    if (constant && goal.kind == Kind::conjunction) {
      throw Refusal{
          "the goal holds whatever happens, and their parsers take an empty `and` as solved at once; name "
          "what must become true"};
    }
    if (constant) throw Refusal{"the goal can never hold in this scene; ask for what its objects can do"};
    result_.problem.goal = goal.kind == Kind::conjunction ? goal.parts : std::vector<BddlFormula>{goal};
    if (libero()) drop_implied();
    for (const BddlFormula& part : result_.problem.goal) {
      if (libero() && part.kind != Kind::atom) {
        throw Refusal{to_text(part) + ": LIBERO says conjunctions of atoms only; " + cure(part)};
      }
      BddlFormula opposite;
      opposite.kind = Kind::negation;
      opposite.parts = {part};
      const auto& all = result_.problem.goal;
      if (std::find(all.begin(), all.end(), opposite) != all.end()) {
        throw Refusal{to_text(part) +
                      " and its negation: two parts of one body are folded into one there; ask for "
                      "one of them"};
      }
    }
  }

  const BddlRegion* region(const std::string& key) const {
    for (const BddlRegion& one : result_.problem.regions) {
      if (one.key() == key) return &one;
    }
    return nullptr;
  }

  // `on` the spot of a table asks for contact with the table: `on` the table adds nothing but the 3 cm of their test.
  void drop_implied() {
    const auto on = [&](const BddlFormula& part) {
      const BddlPredicateRule* rule = mapping_.from_ours(mapping_.support, false);
      return rule != nullptr && part.predicate == rule->theirs && part.terms.size() == 2;
    };
    const std::vector<BddlFormula> all = result_.problem.goal;
    std::erase_if(result_.problem.goal, [&](const BddlFormula& part) {
      if (!on(part)) return false;
      const BddlRegion* own = region(part.terms[1].name);
      const std::string& body = own == nullptr ? part.terms[1].name : own->target;
      return std::any_of(all.begin(), all.end(), [&](const BddlFormula& other) {
        const BddlRegion* spot = on(other) ? region(other.terms[1].name) : nullptr;
        return spot != nullptr && spot != own && other.terms[0] == part.terms[0] && spot->target == body &&
               !spot->ranges.empty() && naming_.is_surface(part.terms[1].name);
      });
    });
  }

  void drop_unused_regions() {
    std::set<std::string> used(result_.problem.interest.begin(), result_.problem.interest.end());
    for (const BddlLiteral& literal : result_.problem.init) {
      used.insert(literal.atom.arguments.begin(), literal.atom.arguments.end());
    }
    for (const BddlFormula& part : result_.problem.goal) {
      for (const Term& term : part.terms) used.insert(term.name);
    }
    std::erase_if(result_.problem.regions, [&](const BddlRegion& one) { return used.count(one.key()) == 0; });
  }

  static std::string cure(const BddlFormula& part) {
    if (part.kind == Kind::negation) return "ask for the opposite, such as `closed` for not `open`";
    return "ask for one of the cases";
  }

  // The literals that the facts say in their words. Facts without a word there are remembered.
  std::vector<BddlLiteral> said() {
    std::vector<BddlLiteral> literals;
    for (const Fact& fact : scene_.facts) {
      const BddlPredicateRule* rule = mapping_.from_ours(fact.predicate, false);
      const Predicate* declared = domain_.predicate(fact.predicate);
      const bool dynamic = declared != nullptr && declared->kind == PredicateKind::basic;
      if (rule == nullptr || (libero() && rule->negated)) {
        if (dynamic) unsaid_.insert(fact.predicate);
        continue;
      }
      try {
        if (const auto literal = libero() ? placed(fact) : std::nullopt) {
          literals.push_back(*literal);
          continue;
        }
        const BddlFormula formula = expression_.literal(fact.predicate, fact.arguments, false);
        const bool negated = formula.kind == Kind::negation;
        const BddlFormula& atom = negated ? formula.parts.at(0) : formula;
        Fact theirs{atom.predicate, {}};
        for (const Term& term : atom.terms) theirs.arguments.push_back(term.name);
        if (negated && !all_parts(fact)) continue;
        literals.push_back({theirs, negated});
      } catch (const Refusal& refusal) {
        result_.remarks.push_back("left out of :init: " + refusal.why);
      }
    }
    return literals;
  }

  // A negated literal of a folded part holds of the body when all its parts say the same.
  bool all_parts(const Fact& fact) const {
    const BddlThing* part = naming_.thing(fact.arguments.back());
    if (part == nullptr || part->kind != BddlThing::Kind::part) return true;
    return std::all_of(scene_.things.begin(), scene_.things.end(), [&](const BddlThing& other) {
      if (other.kind != BddlThing::Kind::part || other.owner != part->owner) return true;
      Fact same = fact;
      same.arguments.back() = other.name;
      return scene_.facts.count(same) > 0;
    });
  }

  // LIBERO: an object that stands where a placement says is on the region of that placement.
  std::optional<BddlLiteral> placed(const Fact& fact) {
    if (fact.predicate != mapping_.support || fact.arguments.size() != 2) return std::nullopt;
    for (const BddlPlacement& placement : scene_.placements) {
      if (placement.object != fact.arguments[0] || placement.on != fact.arguments[1]) continue;
      const std::string region = naming_.spot(placement);
      const BddlPredicateRule* rule = mapping_.from_ours(mapping_.support, false);
      result_.notes.insert({rule->theirs, rule->ours, rule->meaning, rule->why});
      return BddlLiteral{{rule->theirs, {naming_.theirs(placement.object), region}}, false};
    }
    return std::nullopt;
  }

  void write_libero_init() {
    for (const BddlPlacement& placement : scene_.placements) {  // of fixtures there is no fact
      const BddlThing* thing = naming_.thing(placement.object);
      const bool named = result_.names.count(placement.object) > 0 && result_.names.count(placement.on) > 0;
      if (thing == nullptr || thing->kind != BddlThing::Kind::fixture || !named) continue;
      if (const auto literal = placed({mapping_.support, {placement.object, placement.on}})) add_init(*literal);
    }
    for (const BddlLiteral& literal : said()) add_init(literal);
    for (const BddlThing& thing : scene_.things) {
      if (thing.kind == BddlThing::Kind::object) remark_unplaced(thing);
    }
  }

  void write_behavior_init() {
    std::string floor;
    for (const BddlThing& thing : scene_.things) {
      const auto name = result_.names.find(thing.name);
      if (thing.kind != BddlThing::Kind::fixture || name == result_.names.end()) continue;
      const auto of_class = mapping_.rooms.find(thing.class_name), of_type = mapping_.rooms.find(thing.type);
      const std::string& room = of_class != mapping_.rooms.end()  ? of_class->second
                                : of_type != mapping_.rooms.end() ? of_type->second
                                                                  : mapping_.room;
      add_init({{"inroom", {name->second, room}}, false});
      if (name->second.starts_with("floor.n.01_") && floor.empty()) floor = name->second;
    }
    const std::vector<BddlLiteral> literals = said();
    for (const BddlLiteral& literal : literals) {
      // A body is open when any of its parts is.
      const BddlLiteral opposite{literal.atom, !literal.negated};
      if (literal.negated && std::find(literals.begin(), literals.end(), opposite) != literals.end()) continue;
      add_init(literal);
    }
    for (const BddlThing& thing : scene_.things) {
      if (thing.kind == BddlThing::Kind::object) remark_unplaced(thing);
      const auto name = result_.names.find(thing.name);
      if (thing.kind != BddlThing::Kind::hand || name == result_.names.end()) continue;
      if (floor.empty()) {
        floor = naming_.add_instance("floor.n.01");
        add_init({{"inroom", {floor, mapping_.room}}, false});
        result_.remarks.push_back("`" + floor + "` is added: their agent must stand on a floor");
      }
      add_init({{"ontop", {name->second, floor}}, false});
    }
  }

  void add_init(const BddlLiteral& literal) {
    auto& init = result_.problem.init;
    if (std::find(init.begin(), init.end(), literal) == init.end()) init.push_back(literal);
  }

  // A drawer between the two words is lost there: open and close are all they say of a joint.
  void remark_half_open() {
    for (const BddlThing& thing : scene_.things) {
      const auto parts = mapping_.parts.find(thing.class_name);
      const std::string last = thing.name.substr(thing.name.rfind('.') + 1);
      if (thing.kind != BddlThing::Kind::part || parts == mapping_.parts.end() ||
          std::find(parts->second.begin(), parts->second.end(), last) == parts->second.end())
        continue;
      bool can_say = false, says = false;
      for (const BddlPredicateRule& rule : mapping_.predicates) {
        if (rule.theirs != "open" && rule.theirs != "close") continue;
        can_say = true;
        says = says || scene_.facts.count({rule.ours, {thing.name}}) > 0;
      }
      if (can_say && !says)
        result_.remarks.push_back("`" + thing.name + "` is neither open nor closed, which " +
                                  std::string(to_string(mapping_.dialect)) +
                                  " cannot say: it starts there as their model has it");
    }
  }

  void remark_unplaced(const BddlThing& thing) {
    const auto name = result_.names.find(thing.name);
    if (name == result_.names.end()) return;
    const auto& init = result_.problem.init;
    const bool placed = std::any_of(init.begin(), init.end(), [&](const BddlLiteral& literal) {
      return literal.atom.arguments.size() == 2 && literal.atom.arguments[0] == name->second;
    });
    if (!placed) {
      result_.remarks.push_back("`" + name->second + "` is placed by no literal of :init: their samplers need one");
    }
  }

  const BddlScene& scene_;
  const BddlMapping& mapping_;
  const Domain& domain_;
  BddlExport result_;
  BddlNaming naming_;
  BddlExpression expression_;
  std::set<std::string> unsaid_;
};

}  // namespace
}  // namespace symbolic

BddlExport export_bddl(const BddlScene& scene, const BddlMapping& mapping, const Domain& domain) {
  check_mapping(mapping, "BDDL mapping");
  return symbolic::Exporter(scene, mapping, domain).run();
}

}  // namespace stampede
