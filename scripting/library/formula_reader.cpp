#include "scripting/library/formula_reader.h"

#include <algorithm>
#include <utility>

#include "engine/base/naming.h"
#include "engine/base/text.h"
#include "engine/model/scene.h"
#include "engine/symbolic/instances.h"
#include "engine/symbolic/pddl.h"

namespace stampede {
namespace {

constexpr std::size_t kMostOrders = 5040;      // 7!
constexpr std::int64_t kMostWritten = 20'000;  // instances of a formula that are written out: each member of a group

bool is_group(const std::string& name) { return name.size() > 1 && name.back() == '*'; }

std::string shown(const std::string& predicate, std::size_t count) {
  return predicate + " takes " +
         (count == 0   ? "no arguments"
          : count == 1 ? "1 argument"
                       : std::to_string(count) + " arguments");
}

class Reader {
 public:
  Reader(const FormulaContext& context, const Value& whole)
      : context_(context), domain_(*context.domain), holds_something_(asks_for_held(whole, context)) {}

  Formula formula(const Value& node) {
    if (node.is_table() && node.tag().empty() && node.fields.empty()) {
      if (node.items.size() == 1 && whole_) return formula(node.items[0]);
      const Part part(*this);
      return list(node, Formula::Kind::conjunction);
    }
    const std::string tag = node.tag();
    const Line line(*this, node);
    if (tag == "in_order") return in_order(node);
    const Part part(*this);
    if (tag == "literal") return literal_formula(node);
    if (tag == "all_of") return list(node, Formula::Kind::conjunction);
    if (tag == "any_of") {
      ++narrow_;
      Formula result = list(node, Formula::Kind::disjunction);
      --narrow_;
      return result;
    }
    if (tag == "not") return negation(formula(one_item(node)));
    if (tag == "exists" || tag == "forall") return quantified(node, tag == "exists");
    if (tag == "any_order") return any_order(node);
    if (tag == "at_least") return at_least(node);
    if (tag == "equal") return equal(node);
    if (tag == "pddl") return formula_from_pddl(node["text"].text, place());
    if (tag == "when") fail("when belongs to effects, not to conditions", "any_of and is_not say it in conditions");
    if (tag == "call") fail("a skill call is no condition", "write act in steps, is in conditions");
    fail("a literal or formula is missing, this is " + node.type_name(), "write for example is.on(\"cup\", \"shelf\")");
  }

  void effects(const Value& node, std::vector<Effect>& result, const Effect& frame, int depth) {
    const std::string tag = node.tag();
    const Line line(*this, node);
    if (node.is_table() && (tag.empty() || tag == "all_of")) {
      for (const Value& item : node.items) effects(item, result, frame, depth);
    } else if (tag == "literal") {
      result.push_back(effect(node, frame));
    } else if (tag == "when") {
      if (frame.when.kind != Formula::Kind::always) fail("a when inside a when", "join both conditions with all_of");
      Effect inner = frame;
      inner.when = formula(node["condition"]);
      effects(node["effects"], result, inner, depth);
    } else if (tag == "forall") {
      if (!frame.forall.empty()) fail("a forall inside a forall", "give one forall both variables");
      if (depth > 0) fail("effects nest one level", {});
      Effect inner = frame;
      inner.forall = variables(node);
      for (const Parameter& variable : inner.forall) open(variable.name);
      effects(one_item(node), result, inner, depth + 1);
      for (std::size_t i = 0; i < inner.forall.size(); ++i) scope_.pop_back();
    } else if (tag == "at_least") {
      counted_effects(node, result, frame, depth);
    } else {
      const bool counts = tag == "any_of" || tag == "any_order" || tag == "exists";
      fail("an effect is a literal, when or forall, this is " + (counts ? tag : node.type_name()),
           counts
               ? "a plan has to know what holds afterwards, and this leaves open which: a predicate of its own counts, "
                 "such as is.poured(\"obj\", \"box\"), and its `holds` looks how many they are"
               : "");
    }
  }

  // Literals in order; what is none goes to `others`.
  void beginning(const Value& node, std::vector<Literal>& result, std::vector<Formula>& others) {
    const Line line(*this, node);
    const std::string tag = node.tag();
    if (node.is_table() && (tag.empty() || tag == "all_of")) {
      for (const Value& item : node.items) beginning(item, result, others);
      return;
    }
    if (tag == "not" && one_item(node).tag() == "literal" && !one_item(node)["negated"].boolean) {
      Value inner = one_item(node);
      inner.fields["negated"].boolean = true;
      return beginning(inner, result, others);
    }
    if (tag == "in_order") fail("nothing comes in an order before the start", "in_order belongs to the goal");
    if (tag != "literal") return others.push_back(formula(node));
    check_predicate(node);
    for (const std::vector<Term>& terms : expanded(node)) {
      Literal literal{{node["predicate"].text, {}}, node["negated"].boolean};
      for (const Term& term : terms) {
        if (term.variable) fail("variables belong to formulas, '?" + term.name + "' stands in a list of facts", {});
        literal.fact.arguments.push_back(term.name);
      }
      result.push_back(std::move(literal));
    }
  }

 private:
  // While it lives, what is read is a part of the formula.
  class Part {
   public:
    explicit Part(Reader& reader) : reader_(reader), before_(std::exchange(reader.whole_, false)) {}
    ~Part() { reader_.whole_ = before_; }
    Part(const Part&) = delete;
    Part& operator=(const Part&) = delete;

   private:
    Reader& reader_;
    bool before_;
  };

  // While it lives, what is read is written out once for each choice of members of these groups, all of which are
  // counted together before the first is made.
  class Written {
   public:
    Written(Reader& reader, const Value& node, const char* what)
        : reader_(reader), before_(reader.written_), names_before_(reader.written_for_.size()) {
      for (const Value& variable : node["variables"].items) {
        const std::size_t colon = variable.text.find(':');
        const std::string range = colon == std::string::npos ? std::string() : trimmed(variable.text.substr(colon + 1));
        if (is_group(range)) by(trimmed(variable.text.substr(0, colon)), reader.group_members(range).size());
      }
      reader.limit_written(what, reader.written_for_, reader.written_);
    }
    // `count` choices of what `name` stands for.
    Written(Reader& reader, const std::string& name, std::size_t count, const char* what)
        : reader_(reader), before_(reader.written_), names_before_(reader.written_for_.size()) {
      by(name, count);
      reader.limit_written(what, reader.written_for_, reader.written_);
    }
    ~Written() {
      reader_.written_ = before_;
      reader_.written_for_.resize(names_before_);
    }
    Written(const Written&) = delete;
    Written& operator=(const Written&) = delete;

   private:
    void by(const std::string& name, std::size_t count) {
      reader_.written_ = symbolic::times(reader_.written_, static_cast<std::int64_t>(count));
      reader_.written_for_.push_back(name);
    }
    Reader& reader_;
    std::int64_t before_;
    std::size_t names_before_;
  };

  // A goal's stages, all of which have come true at its end.
  Formula in_order(const Value& node) {
    if (!whole_ || context_.field != "goal")
      fail("in_order stands inside another formula, or not in a goal",
           "it is a whole goal: goal = in_order { first, second }; what comes in no order goes into its last part");
    const Part part(*this);
    for (const Value& stage : node.items) {
      const Line line(*this, stage);
      const Formula read = formula(stage);
      if (!only_literals(read))
        fail("a part of in_order is more than literals", "write it without any_of, exists, forall and is_not(all_of)");
      if (const std::string derived = derived_in(read); !derived.empty())
        fail("'" + derived + "' is derived: no action makes it true by itself, so nobody can wait for its turn",
             "name what it is derived from");
    }
    return list(node, Formula::Kind::conjunction);
  }

  std::string derived_in(const Formula& formula) const {
    if (formula.kind == Formula::Kind::atom) {
      const Predicate* predicate = context_.domain->predicate(formula.predicate);
      return predicate != nullptr && predicate->kind == PredicateKind::derived ? formula.predicate : "";
    }
    for (const Formula& part : formula.parts)
      if (std::string name = derived_in(part); !name.empty()) return name;
    return {};
  }

  static bool only_literals(const Formula& formula) {
    if (formula.kind == Formula::Kind::conjunction)
      return std::all_of(formula.parts.begin(), formula.parts.end(), only_literals);
    return formula.kind == Formula::Kind::atom || formula.kind == Formula::Kind::always ||
           (formula.kind == Formula::Kind::negation && formula.parts[0].kind == Formula::Kind::atom);
  }

  // The line of the innermost value that knows its own.
  class Line {
   public:
    Line(Reader& reader, const Value& node) : reader_(reader), before_(reader.line_) {
      if (node.line() > 0) reader.line_ = node.line();
    }
    ~Line() { reader_.line_ = before_; }
    Line(const Line&) = delete;
    Line& operator=(const Line&) = delete;

   private:
    Reader& reader_;
    int before_;
  };

  std::string place() const { return line_ > 0 ? context_.file + ":" + std::to_string(line_) : context_.file; }
  [[noreturn]] void fail(const std::string& what, const std::string& hint) const {
    throw Error(place(), context_.field.empty() ? what : context_.field + ": " + what, hint);
  }

  const Value& one_item(const Value& node) const {
    if (node.items.size() != 1) fail(node.tag() + " takes one formula", {});
    return node.items[0];
  }

  Formula list(const Value& node, Formula::Kind kind) {
    std::vector<Formula> parts;
    for (const Value& item : node.items) {
      Formula part = formula(item);
      const bool empty = kind == Formula::Kind::conjunction && part.kind == Formula::Kind::always;  // b[0] of any_order
      if (!empty) parts.push_back(std::move(part));
    }
    return kind == Formula::Kind::conjunction ? conjunction(std::move(parts)) : disjunction(std::move(parts));
  }

  // Of those that say a part of the name: `on` for on_top; else those that begin as it does: `inside` for in_container.
  static std::string alike(const std::string& name, const std::vector<std::string>& known) {
    const std::vector<std::string> words = split(name, '_');
    std::vector<std::string> like;
    for (const std::string& one : known)
      if (std::find(words.begin(), words.end(), one) != words.end()) like.push_back(one);
    if (like.empty())
      std::copy_if(known.begin(), known.end(), std::back_inserter(like),
                   [&](const std::string& one) { return words[0].size() > 1 && one.starts_with(words[0]); });
    std::sort(like.begin(), like.end());
    return like.empty() || like.size() > 6 ? "" : "there are: " + joined(like, ", ");
  }

  void check_predicate(const Value& node) {
    const std::string& name = node["predicate"].text;
    const auto trait = std::find(domain_.traits.begin(), domain_.traits.end(), name);
    if (const Predicate* known = domain_.predicate(name)) {
      if (known->kind == PredicateKind::start && context_.field != "init" && !node["stays"].boolean)
        fail("'" + name + "' is only asked of starts and is no fact",
             "name it in init, or take start_only out of its file");
      return;
    }
    if (trait != domain_.traits.end()) return;
    std::vector<std::string> known;
    if (node.items.size() < 2) known = domain_.traits;  // which are said of one thing
    for (const Predicate& predicate : domain_.predicates) known.push_back(predicate.name);
    std::string hint = did_you_mean(name, known);
    if (hint.empty()) hint = alike(name, known);
    if (name == "same") hint = "equal(\"?x\", \"?y\") says so";
    if (domain_.types.contains(name)) hint = "it is a type: write exists(\"?x: " + name + "\", …)";
    fail("there is no predicate '" + name + "'", hint);
  }

  std::vector<Parameter> parameters_of(const std::string& name) const {
    if (const Predicate* predicate = domain_.predicate(name)) return predicate->parameters;
    return {{"obj", "", {}}};  // a trait
  }

  bool in_scope(const std::string& name) const {
    if (std::find(scope_.begin(), scope_.end(), name) != scope_.end()) return true;
    return std::any_of(context_.parameters.begin(), context_.parameters.end(),
                       [&](const Parameter& parameter) { return parameter.name == name; });
  }

  std::vector<std::string> names_in_scope() const {
    std::vector<std::string> names;
    for (const std::string& name : scope_) names.push_back("?" + name);
    for (const Parameter& parameter : context_.parameters)
      names.push_back(context_.schema ? parameter.name : "?" + parameter.name);
    return names;
  }

  Term term(const std::string& text, const Parameter* parameter) {
    const std::size_t dot = text.find('.');
    const std::size_t mark = !text.empty() && text[0] == '?' ? 1 : 0;
    if (dot != std::string::npos && (mark == 1 || context_.schema) && in_scope(text.substr(mark, dot - mark)))
      return part_term(text.substr(mark, dot - mark), text.substr(dot + 1));
    if (mark == 1) {
      const std::string name = text.substr(1);
      if (!in_scope(name)) fail("unknown variable '" + text + "'", did_you_mean(text, names_in_scope()));
      return {true, name};
    }
    if (parameter != nullptr && parameter->type == "value") return {false, text};
    if (context_.schema) {
      if (!in_scope(text)) fail("unknown parameter '" + text + "'", did_you_mean(text, names_in_scope()));
      return {true, text};
    }
    if (context_.object_fault) {
      if (const auto fault = context_.object_fault(text)) fail("there is no object '" + text + "'", *fault);
    }
    return {false, text};
  }

  // A part of what a variable stands for is a variable itself: see with_parts.
  Term part_term(const std::string& whole, const std::string& part) {
    if (context_.part_fault) {
      if (const auto fault = context_.part_fault(part)) fail("nothing has a part or region '" + part + "'", *fault);
    }
    std::string name = whole + "_" + part;
    std::replace(name.begin(), name.end(), '.', '_');
    while (in_scope(name)) name += "_part";
    const PartTerm one{{true, name}, {true, whole}, part_name_of(part)};
    if (std::find(parts_.begin(), parts_.end(), one) == parts_.end()) parts_.push_back(one);
    return one.term;
  }

  // The literal, about parts that there are: exists ?x_lid: part_of(?x_lid, ?x), part_name(?x_lid, lid), literal. What
  // is said of all ?x is said of those that have the part: forall ?x_lid: not part_of(…), or not part_name(…), or
  // literal.
  Formula with_parts(Formula literal) {
    for (const PartTerm& part : std::exchange(parts_, {})) {
      const bool of_all = std::find(universal_.begin(), universal_.end(), part.whole.name) != universal_.end();
      Formula of = atom("part_of", {part.term, part.whole});
      Formula named = atom("part_name", {part.term, {false, part.name}});
      Formula result;
      result.kind = of_all ? Formula::Kind::forall : Formula::Kind::exists;
      result.variables = {{part.term.name, "", {}}};
      result.parts = {of_all ? disjunction({negation(std::move(of)), negation(std::move(named)), std::move(literal)})
                             : conjunction({std::move(of), std::move(named), std::move(literal)})};
      literal = std::move(result);
    }
    return literal;
  }

  Term hand_term() {
    for (const Parameter& parameter : context_.parameters) {
      if (parameter.type == "hand") return {true, parameter.name};
    }
    if (context_.schema)
      fail("the hand is left out and there is no parameter of type hand", "add a parameter \"hand: hand\"");
    return {false, context_.hand};
  }

  // The argument tuples of a literal: one, or one per member of each group that it names.
  std::vector<std::vector<Term>> expanded(const Value& node) {
    const std::string& name = node["predicate"].text;
    const std::vector<Parameter> parameters = parameters_of(name);
    const int hand = hand_position(parameters, domain_);
    const std::size_t given = node["pairwise"].boolean ? parameters.size() : node.items.size();
    const bool fill = hand >= 0 && given + 1 == parameters.size();
    if (given != parameters.size() && !fill) {
      std::string hint = "is." + name + "(";
      for (std::size_t i = 0; i < parameters.size(); ++i) hint += (i > 0 ? ", " : "") + parameters[i].name;
      fail(shown(name, parameters.size()) + ", not " + std::to_string(given), "write " + hint + ")");
    }
    if (node["pairwise"].boolean) return pairs_of(node, parameters);
    limit_members(node);
    std::vector<std::vector<Term>> tuples(1);
    std::size_t next = 0;
    for (std::size_t i = 0; i < parameters.size(); ++i) {
      if (fill && static_cast<int>(i) == hand) {
        for (auto& tuple : tuples) tuple.push_back(hand_term());
        continue;
      }
      const std::string& text = node.items[next++].text;
      if (!is_group(text)) {
        const Term one = term(text, &parameters[i]);
        for (auto& tuple : tuples) tuple.push_back(one);
        continue;
      }
      std::vector<std::vector<Term>> longer;
      const std::vector<std::string> names = members(text);
      const std::vector<Value>& except = node["except"].items;
      for (const auto& tuple : tuples) {
        for (const std::string& member : names) {
          if (std::any_of(except.begin(), except.end(), [&](const Value& one) { return one.text == member; })) continue;
          longer.push_back(tuple);
          longer.back().push_back({false, member});
        }
      }
      tuples = std::move(longer);
    }
    return tuples;
  }

  // Of each two of the things and members of groups that are named, in their order.
  std::vector<std::vector<Term>> pairs_of(const Value& node, const std::vector<Parameter>& parameters) {
    const std::string& name = node["predicate"].text;
    if (parameters.size() != 2)
      fail("pairwise: " + shown(name, parameters.size()) + ", and is not said of two things",
           "name a predicate of two, such as apart");
    std::vector<std::string> things;
    for (const Value& item : node.items) {
      if (!is_group(item.text)) {
        things.push_back(item.text);
        continue;
      }
      const std::vector<std::string> names = members(item.text);
      things.insert(things.end(), names.begin(), names.end());
    }
    if (things.size() < 2) fail("pairwise: there are no two things to say '" + name + "' of", "name another");
    limit_written(name, things, static_cast<std::int64_t>(things.size() * (things.size() - 1) / 2));
    std::vector<std::vector<Term>> tuples;
    for (std::size_t i = 0; i < things.size(); ++i)
      for (std::size_t k = i + 1; k < things.size(); ++k)
        tuples.push_back({term(things[i], &parameters[0]), term(things[k], &parameters[1])});
    return tuples;
  }

  // Of a literal that names groups: before any of them is made.
  void limit_members(const Value& node) const {
    std::int64_t count = written_;
    std::vector<std::string> groups;
    for (const Value& item : node.items) {
      if (!is_group(item.text)) continue;
      count = symbolic::times(count, static_cast<std::int64_t>(members(item.text).size()));
      groups.push_back(item.text);
    }
    if (!groups.empty()) limit_written(node["predicate"].text, groups, count);
  }

  void limit_written(const std::string& what, const std::vector<std::string>& names, std::int64_t count) const {
    if (count > kMostWritten)
      symbolic::too_many_instances(context_.field.empty() ? what : context_.field + ": " + what, names, count,
                                   kMostWritten, place());
  }

  std::vector<std::string> members(const std::string& group) const {
    if (context_.schema)
      fail("groups such as '" + group + "' belong to tasks", "quantify instead: forall(\"?x: block\", …)");
    if (narrow_ > 0) {
      fail("the group '" + group + "' stands for all its members, which any_of and exists cannot mean",
           "quantify over it: exists(\"?x: " + group + "\", …)");
    }
    return group_members(group);
  }

  std::vector<std::string> group_members(const std::string& group) const {
    if (!context_.expand) fail("groups cannot stand here: '" + group + "'", {});
    try {
      return context_.expand(group);
    } catch (const Error& error) {
      fail(error.message(), error.hint());
    }
  }

  Formula literal_formula(const Value& node) {
    const std::string& name = node["predicate"].text;
    check_predicate(node);
    if (node["implied"].boolean && holds_something_) return {};
    if (const Predicate* known = domain_.predicate(name);
        known != nullptr && known->kind == PredicateKind::start && context_.field != "init")
      return {};  // of what stays: it is asked of starts alone
    const bool negated = node["negated"].boolean;
    std::vector<Formula> parts;
    for (std::vector<Term>& terms : expanded(node)) {
      Formula one = atom(name, std::move(terms));
      parts.push_back(negated ? negation(std::move(one)) : std::move(one));
    }
    return with_parts(conjunction(std::move(parts)));
  }

  Formula equal(const Value& node) {
    if (node.items.size() != 2) fail("same takes 2 arguments, not " + std::to_string(node.items.size()), {});
    Formula result;
    result.kind = Formula::Kind::equal;
    for (const Value& item : node.items) result.terms.push_back(term(item.text, nullptr));
    return with_parts(node["negated"].boolean ? negation(std::move(result)) : result);
  }

  void open(const std::string& name) {
    if (in_scope(name)) fail("the variable '?" + name + "' shadows another of that name", "rename it");
    scope_.push_back(name);
  }

  std::vector<Parameter> variables(const Value& node) const {
    std::vector<Parameter> result;
    for (const Value& variable : node["variables"].items) {
      if (variable.text.empty() || variable.text[0] != '?') {
        fail("write variables with a question mark: \"?" + variable.text + "\"", {});
      }
      result.push_back(parameter_from(variable.text.substr(1), domain_, place()));
    }
    return result;
  }

  // So many of a type, whichever: a skill knows no task's groups.
  void counted_effects(const Value& node, std::vector<Effect>& result, const Effect& frame, int depth) {
    if (!frame.forall.empty() || depth > 0) fail("at_least inside a forall", "count in a skill of its own");
    if (frame.when.kind != Formula::Kind::always)
      fail("at_least inside a when", "write when inside: at_least(n, type, function(x) return when(…, …) end)");
    const std::string type = trimmed(node["group"].text), variable = node["variables"].items.at(0).text.substr(1);
    if (type.ends_with("*"))
      fail("at_least in an effect takes a type, and '" + type + "' is a group of a task",
           "at_least(" + std::to_string(static_cast<int>(node["n"].number)) + ", \"" + type.substr(0, type.size() - 1) +
               "\", …)");
    Effect inner = frame;
    inner.forall = {parameter_from(variable + ": " + type, domain_, place())};
    inner.at_least = static_cast<int>(node["n"].number);
    open(inner.forall[0].name);
    effects(one_item(node), result, inner, depth + 1);
    scope_.pop_back();
  }

  // A variable whose range is a group is replaced by each member.
  Formula quantified(const Value& node, bool exists) {
    const Written written(*this, node, exists ? "exists" : "forall");
    return quantified_over(node, exists);
  }

  Formula quantified_over(const Value& node, bool exists) {
    for (std::size_t i = 0; i < node["variables"].items.size(); ++i) {
      const std::string& text = node["variables"].items[i].text;
      const std::size_t colon = text.find(':');
      if (colon == std::string::npos || !is_group(trimmed(text.substr(colon + 1)))) continue;
      Value rest = node;
      auto& left = rest.fields["variables"].items;
      left.erase(left.begin() + static_cast<std::ptrdiff_t>(i));
      std::vector<Formula> parts;
      const std::string name = trimmed(text.substr(0, colon));
      for (const std::string& member : group_members(trimmed(text.substr(colon + 1)))) {
        parts.push_back(quantified_over(replaced(rest, {{name, member}}), exists));
      }
      return exists ? disjunction(std::move(parts)) : conjunction(std::move(parts));
    }
    if (node["variables"].items.empty()) return formula(one_item(node));
    Formula result;
    result.kind = exists ? Formula::Kind::exists : Formula::Kind::forall;
    result.variables = variables(node);
    for (const Parameter& variable : result.variables) {
      open(variable.name);
      if (!exists) universal_.push_back(variable.name);
    }
    narrow_ += exists ? 1 : 0;
    result.parts.push_back(formula(one_item(node)));
    narrow_ -= exists ? 1 : 0;
    for (std::size_t i = 0; i < result.variables.size(); ++i) scope_.pop_back();
    if (!exists) universal_.resize(universal_.size() - result.variables.size());
    return result;
  }

  using StandIns = std::vector<std::pair<std::string, std::string>>;  // a variable, and what it stands for

  static void replace(Value& node, const StandIns& stand_ins) {
    if (node.is_text()) {
      const auto same = [&](const auto& one) { return one.first == node.text; };
      const auto found = std::find_if(stand_ins.begin(), stand_ins.end(), same);
      if (found != stand_ins.end()) node.text = found->second;
    }
    for (Value& item : node.items) replace(item, stand_ins);
    for (auto& [key, field] : node.fields)
      if (key != "predicate" && key != "tag") replace(field, stand_ins);
  }

  static Value replaced(Value node, const StandIns& stand_ins) {
    replace(node, stand_ins);
    return node;
  }

  // The disjunction over all ordered choices of n distinct members.
  Formula any_order(const Value& node) {
    const std::vector<std::string> names = group_members(node["group"].text);
    const auto count = static_cast<std::size_t>(node["n"].number);
    if (count > names.size()) {
      fail("any_order chooses " + std::to_string(count) + " of the " + std::to_string(names.size()) + " members of '" +
               node["group"].text + "'",
           "make the group larger: count = " + std::to_string(count));
    }
    std::size_t orders = 1;
    for (std::size_t i = 0; i < count; ++i) orders *= names.size() - i;
    if (orders > kMostOrders)
      fail("any_order has " + std::to_string(orders) + " orders, at most 5040", "choose fewer members");
    const Written written(*this, node["group"].text, orders, "any_order");
    std::vector<Formula> parts;
    std::vector<std::size_t> chosen;
    choose(node, names, count, chosen, parts);
    return disjunction(std::move(parts));
  }

  void choose(const Value& node, const std::vector<std::string>& names, std::size_t count,
              std::vector<std::size_t>& chosen, std::vector<Formula>& parts) {
    if (chosen.size() == count) {
      StandIns stand_ins;
      for (std::size_t i = 0; i < count; ++i) stand_ins.emplace_back(node["variables"].items[i].text, names[chosen[i]]);
      ++narrow_;
      parts.push_back(formula(replaced(one_item(node), stand_ins)));
      --narrow_;
      return;
    }
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (std::find(chosen.begin(), chosen.end(), i) != chosen.end()) continue;
      chosen.push_back(i);
      choose(node, names, count, chosen, parts);
      chosen.pop_back();
    }
  }

  // The disjunction over all choices of n members.
  Formula at_least(const Value& node) {
    const std::vector<std::string> names = group_members(node["group"].text);
    const auto count = static_cast<std::size_t>(node["n"].number);
    if (count > names.size()) {
      fail("at_least asks for " + std::to_string(count) + " of the " + std::to_string(names.size()) + " members of '" +
               node["group"].text + "'",
           "make the group larger: count = " + std::to_string(count));
    }
    std::size_t choices = 1;  // each step is a binomial coefficient, so it divides
    for (std::size_t i = 0; i < count && choices <= kMostOrders; ++i) choices = choices * (names.size() - i) / (i + 1);
    if (choices > kMostOrders)
      fail("at_least has more than 5040 choices", "make the group smaller, or ask for nearly all or nearly none of it");
    const Written written(*this, node["group"].text, choices, "at_least");
    ++narrow_;
    std::vector<Formula> single;
    for (const std::string& name : names)
      single.push_back(formula(replaced(one_item(node), {{node["variables"].items[0].text, name}})));
    --narrow_;
    std::vector<Formula> parts;
    std::vector<bool> chosen(names.size());
    std::fill_n(chosen.begin(), count, true);
    do {
      std::vector<Formula> together;
      for (std::size_t i = 0; i < names.size(); ++i)
        if (chosen[i]) together.push_back(single[i]);
      parts.push_back(conjunction(std::move(together)));
    } while (std::prev_permutation(chosen.begin(), chosen.end()));
    return disjunction(std::move(parts));
  }

  Effect effect(const Value& node, const Effect& frame) {
    check_predicate(node);
    const std::string& name = node["predicate"].text;
    const Predicate* predicate = domain_.predicate(name);
    if (predicate == nullptr) fail("an effect cannot change the trait '" + name + "'", {});
    if (predicate->kind == PredicateKind::derived) {
      fail("an effect cannot name the derived predicate '" + name + "'", "name the facts that it is derived from");
    }
    if (predicate->kind == PredicateKind::fixed)
      fail("an effect cannot change the static predicate '" + name + "'", {});
    Effect result = frame;
    result.predicate = name;
    if (node["pairwise"].boolean) fail("pairwise cannot stand in an effect", "write one literal for each two");
    result.terms = expanded(node).at(0);
    if (!parts_.empty())
      fail("an effect cannot name a part of a parameter: '" + parts_[0].whole.name + "." + parts_[0].name + "'",
           "make the part a parameter, and part_of(\"part\", \"" + parts_[0].whole.name + "\") a precondition");
    result.negated = node["negated"].boolean;
    return result;
  }

  struct PartTerm {
    Term term, whole;
    std::string name;
    friend bool operator==(const PartTerm&, const PartTerm&) = default;
  };

  const FormulaContext& context_;
  const Domain& domain_;
  bool holds_something_;                  // by what the whole formula asks for
  std::vector<PartTerm> parts_;           // that the literal being read names
  std::vector<std::string> scope_;        // quantified variables, outermost first
  std::vector<std::string> universal_;    // those of them that a forall binds
  std::int64_t written_ = 1;              // times that what is read is written out, for the groups around it
  std::vector<std::string> written_for_;  // the variables and groups that it is written out for
  int line_ = 0;
  int narrow_ = 0;     // inside any_of or exists
  bool whole_ = true;  // what is read is the whole formula
};

}  // namespace

bool asks_for_held(const Value& node, const FormulaContext& context) {
  if (node.tag() == "literal" && context.traits != nullptr && !node["negated"].boolean) {
    const auto traits = context.traits->find(node["predicate"].text);
    return traits != context.traits->end() && traits->second.requires_pairs == Pairs::held;
  }
  return std::any_of(node.items.begin(), node.items.end(),
                     [&](const Value& item) { return asks_for_held(item, context); });
}

int hand_position(const std::vector<Parameter>& parameters, const Domain&) {
  int position = -1;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (parameters[i].type != "hand") continue;
    if (position >= 0) return -1;  // two hands: the author says which
    position = static_cast<int>(i);
  }
  return position;
}

Parameter parameter_from(const std::string& text, const Domain& domain, const std::string& place) {
  Parameter parameter;
  const std::size_t colon = text.find(':');
  parameter.name = trimmed(text.substr(0, colon));
  if (const auto fault = name_fault(parameter.name)) {
    throw Error(place, "the parameter name '" + parameter.name + "' " + *fault,
                "such as '" + proposed_name(parameter.name) + "'");
  }
  std::string rest = colon == std::string::npos ? std::string() : text.substr(colon + 1) + "&";
  while (!rest.empty()) {
    const std::size_t end = rest.find('&');
    const std::string word = trimmed(rest.substr(0, end));
    rest.erase(0, end + 1);
    if (std::find(domain.traits.begin(), domain.traits.end(), word) != domain.traits.end()) {
      parameter.traits.push_back(word);
    } else if (domain.types.contains(word) && parameter.type.empty()) {
      parameter.type = word;
    } else if (domain.types.contains(word)) {
      throw Error(place, "'" + parameter.name + "' has two types, " + parameter.type + " and " + word, "keep one");
    } else {
      std::vector<std::string> known = domain.traits;
      for (const auto& [type, parent] : domain.types) known.push_back(type);
      const bool all = word == "anything" || word == "any" || word == "object";
      throw Error(place, "'" + word + "' is neither a type nor a trait",
                  all ? "a parameter of any thing says none: \"" + parameter.name + "\"" : did_you_mean(word, known));
    }
  }
  return parameter;
}

Formula formula_from(const Value& node, const FormulaContext& context) { return Reader(context, node).formula(node); }

std::vector<Formula> stages_from(const Value& node, const FormulaContext& context) {
  const bool wrapped = node.is_table() && node.tag().empty() && node.items.size() == 1;
  const Value& goal = wrapped ? node.items[0] : node;
  if (goal.tag() != "in_order") return {};
  std::vector<Formula> stages;
  for (const Value& part : goal.items) stages.push_back(Reader(context, goal).formula(part));
  return stages;
}

std::vector<Effect> effects_from(const Value& node, const FormulaContext& context) {
  std::vector<Effect> result;
  Reader(context, node).effects(node, result, {}, 0);
  return result;
}

Beginning beginning_from(const Value& node, const FormulaContext& context) {
  Beginning result;
  std::vector<Formula> others;
  Reader(context, node).beginning(node, result.literals, others);
  if (!others.empty()) result.constraint = conjunction(std::move(others));
  return result;
}

}  // namespace stampede
