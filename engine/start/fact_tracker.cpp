#include "engine/start/fact_tracker.h"

#include <algorithm>
#include <cmath>

#include "engine/sim/world.h"
#include "engine/symbolic/instances.h"
#include "engine/symbolic/pddl_text.h"

namespace stampede {
namespace {

// Objects a parameter can be bound to: right type, all traits.
std::vector<std::string> candidates(const Parameter& parameter, const Domain& domain, const WorldView& view,
                                    const std::vector<TypedObject>& objects) {
  std::vector<std::string> names;
  for (const TypedObject& typed : objects) {
    if (!parameter.type.empty() && !domain.is_a(typed.type, parameter.type)) continue;
    const Object* thing = view.scene().object(typed.name);
    if (thing == nullptr) continue;
    const auto has = [&](const std::string& trait) {
      return std::find(thing->traits.begin(), thing->traits.end(), trait) != thing->traits.end();
    };
    if (std::all_of(parameter.traits.begin(), parameter.traits.end(), has)) names.push_back(typed.name);
  }
  return names;
}

void erase_hands(const Scene& scene, std::vector<std::string>& names) {
  std::erase_if(names, [&](const std::string& name) { return scene.object(name)->kind == ObjectKind::hand; });
}

bool whole_and_part(const std::string& a, const std::string& b) {
  return a.size() < b.size() ? b.starts_with(a) && b[a.size()] == '.'
                             : a != b && a.starts_with(b) && a[b.size()] == '.';
}

// `own`: whether a thing may be related to its own parts.
void combine(const std::vector<std::vector<std::string>>& choices, bool own, Fact& fact, std::vector<Fact>& out) {
  if (fact.arguments.size() == choices.size()) {
    out.push_back(fact);
    return;
  }
  for (const std::string& choice : choices[fact.arguments.size()]) {
    const auto barred = [&](const std::string& other) {
      return other == choice || (!own && whole_and_part(other, choice));
    };
    if (std::any_of(fact.arguments.begin(), fact.arguments.end(), barred)) continue;
    fact.arguments.push_back(choice);
    combine(choices, own, fact, out);
    fact.arguments.pop_back();
  }
}

std::int64_t frame_at(std::int64_t step, int steps_per_frame) { return (step + steps_per_frame - 1) / steps_per_frame; }

// What quantifies over an episode's objects, whoever will ask for it.
void limit_formulas(const symbolic::View& all) {
  for (const Predicate& predicate : all.domain.predicates)
    if (predicate.kind == PredicateKind::derived)
      symbolic::limit_instances(predicate.derived, all, "predicate " + predicate.name);
  for (const Action& action : all.domain.actions) {
    const std::string place = "skill " + (action.skill.empty() ? action.name : action.skill);
    symbolic::limit_instances(action.precondition, all, place);
    for (const Effect& effect : action.effects) {
      symbolic::limit_instances("forall", effect.forall, all, place);
      symbolic::limit_instances(effect.when, all, place);
    }
  }
}

}  // namespace

std::vector<AttributeFact> attribute_facts(const Scene& scene, const Domain& domain) {
  std::vector<AttributeFact> facts;
  for (const Object& thing : scene.objects)
    for (const auto& [key, value] : thing.attributes) {
      const Predicate* predicate = domain.predicate(key);
      if (predicate == nullptr || predicate->parameters.size() != 2 || !symbolic::is_pddl_name(value)) continue;
      const bool named = scene.object(value) != nullptr;
      facts.push_back({{key, {thing.name, value}}, named ? std::string() : predicate->parameters[1].type});
    }
  return facts;
}

FactTracker::FactTracker(Symbols& symbols, const WorldView& view, const std::set<std::string>& asked)
    : symbols_(symbols), dt_(view.world().dt()) {
  enumerate(view, asked);
  index_arguments(view);
  add_static(view);
  limit_formulas({static_, symbols_.domain(), objects_});
  state_.atoms.resize(names_.size());
}

void FactTracker::enumerate(const WorldView& view, const std::set<std::string>& asked) {
  const Domain& domain = symbols_.domain();
  for (const Object& thing : view.scene().objects) objects_.push_back({thing.name, thing.type});
  for (const Predicate& predicate : domain.predicates) {
    if (predicate.kind == PredicateKind::derived) {
      derived_names_.insert(predicate.name);
      continue;
    }
    const PredicateTraits traits = symbols_.traits(predicate.name);
    const bool where_named = predicate.kind == PredicateKind::start || traits.only_named;
    if (where_named && !asked.contains(predicate.name)) continue;
    const bool attribute = std::any_of(view.scene().objects.begin(), view.scene().objects.end(),
                                       [&](const Object& thing) { return thing.attributes.contains(predicate.name); });
    if (attribute) continue;  // known without reading the world
    std::vector<std::vector<std::string>> choices;
    std::int64_t count = 1;
    std::vector<std::string> variables;
    for (const Parameter& parameter : predicate.parameters) {
      choices.push_back(candidates(parameter, domain, view, objects_));
      if (traits.only_named && parameter.type.empty()) erase_hands(view.scene(), choices.back());
      count = symbolic::times(count, static_cast<std::int64_t>(choices.back().size()));
      variables.push_back(parameter.name);
    }
    if (count > symbolic::kMostInstances)
      symbolic::too_many_instances(predicate.name, variables, count, symbolic::kMostInstances,
                                   "predicate " + predicate.name);
    Group group{predicate.name, traits, predicate.kind == PredicateKind::fixed, symbols_.can_hide(predicate.name),
                names_.size(),  0};
    Fact fact{predicate.name, {}};
    combine(choices, group.fixed, fact, names_);
    group.count = names_.size() - group.first;
    groups_.push_back(group);
  }
}

void FactTracker::add_static(const WorldView& view) {
  for (const Object& thing : view.scene().objects)
    for (const std::string& trait : thing.traits) static_.insert({trait, {thing.name}});
  std::set<std::string> values;
  for (const auto& [fact, type] : attribute_facts(view.scene(), symbols_.domain())) {
    static_.insert(fact);
    if (!type.empty() && values.insert(fact.arguments[1]).second) objects_.push_back({fact.arguments[1], type});
  }
  for (const TypedObject& constant : symbols_.domain().constants) {
    const auto is_it = [&](const TypedObject& one) { return one.name == constant.name; };
    if (std::none_of(objects_.begin(), objects_.end(), is_it)) objects_.push_back(constant);
  }
  std::sort(objects_.begin(), objects_.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
}

// All that each frame would look up by name otherwise.
void FactTracker::index_arguments(const WorldView& view) {
  const Scene& scene = view.scene();
  std::map<std::string, int> indices;
  owners_.resize(scene.bodies.size() + 1);
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const Object& thing = scene.objects[i];
    indices[thing.name] = static_cast<int>(i);
    radii_.push_back(view.size(thing.name).norm() / 2);
    for (int body = -1; body < static_cast<int>(scene.bodies.size()); ++body) {
      const auto& parts = scene.body_at(body).parts;
      for (int part = 0; part < static_cast<int>(parts.size()); ++part)
        if (view.owns(thing, {body, part}))
          owners_[static_cast<std::size_t>(body + 1)].push_back({part, static_cast<int>(i)});
    }
  }
  for (std::size_t i = 0; i < names_.size(); ++i) {
    const auto& arguments = names_[i].arguments;
    index_.emplace(names_[i], static_cast<int>(i));
    pairs_.push_back({-1, -1});
    if (!arguments.empty()) pairs_.back()[1] = indices.at(arguments.back());
    if (arguments.size() > 1) pairs_.back()[0] = indices.at(arguments[arguments.size() - 2]);
  }
  needs_place_.resize(scene.objects.size());
  for (const Group& group : groups_)
    for (std::size_t i = group.first; i < group.first + group.count; ++i)
      for (const int argument : pairs_[i])
        if (group.traits.requires_pairs == Pairs::near && argument >= 0)
          needs_place_[static_cast<std::size_t>(argument)] = 1;
}

FactTracker::Neighbours FactTracker::neighbours(const WorldView& view) const {
  const std::size_t count = radii_.size();
  Neighbours near;
  near.touching.resize(count * count);
  for (const Contact& contact : view.world().contacts())
    for (const Owner& first : owners_[static_cast<std::size_t>(contact.a.body + 1)]) {
      if (first.part != contact.a.part) continue;
      for (const Owner& second : owners_[static_cast<std::size_t>(contact.b.body + 1)]) {
        if (second.part != contact.b.part) continue;
        const auto a = static_cast<std::size_t>(first.object), b = static_cast<std::size_t>(second.object);
        near.touching[a * count + b] = near.touching[b * count + a] = 1;
      }
    }
  near.held.resize(count);
  if (const auto held = view.world().grasped())
    for (const Owner& owner : owners_[static_cast<std::size_t>(held->body + 1)])
      if (owner.part == held->part) near.held[static_cast<std::size_t>(owner.object)] = 1;
  near.at.resize(count);
  for (std::size_t i = 0; i < count; ++i)
    if (needs_place_[i] != 0) near.at[i] = view.world_from(view.scene().objects[i]).translation();
  return near;
}

bool FactTracker::can_hold(const Group& group, std::size_t atom, const Neighbours& near) const {
  constexpr double kNear = 0.05;  // m between bounding spheres
  if (group.traits.requires_pairs == Pairs::all || pairs_[atom][1] < 0) return true;
  if (group.traits.requires_pairs == Pairs::held) return near.held[static_cast<std::size_t>(pairs_[atom][1])] != 0;
  if (pairs_[atom][0] < 0) return true;
  const auto a = static_cast<std::size_t>(pairs_[atom][0]), b = static_cast<std::size_t>(pairs_[atom][1]);
  if (near.touching[a * radii_.size() + b] != 0) return true;
  if (group.traits.requires_pairs == Pairs::touching) return false;
  return (near.at[a] - near.at[b]).norm() < radii_[a] + radii_[b] + kNear;
}

std::map<Fact, Symbols::Value> FactTracker::read_all(const WorldView& view, bool filtered) const {
  std::map<Fact, Symbols::Value> values;
  const Neighbours near = neighbours(view);
  for (const Group& group : groups_)
    for (std::size_t i = group.first; i < group.first + group.count; ++i)
      values[names_[i]] = !filtered || can_hold(group, i, near) ? symbols_.value(names_[i], view) : Symbols::Value{};
  return values;
}

void FactTracker::begin(const std::map<Fact, Symbols::Value>& values) {
  state_ = State{};
  state_.atoms.resize(names_.size());
  state_.facts = static_;
  for (std::size_t i = 0; i < names_.size(); ++i) {
    const auto found = values.find(names_[i]);
    if (found == values.end() || !found->second.holds) continue;
    state_.atoms[i].holds = state_.atoms[i].raw = true;
    state_.atoms[i].margin = found->second.margin;
    state_.facts.insert(names_[i]);
  }
  changed_ = true;
  refresh_derived(0);
}

void FactTracker::step(const WorldView& view) {
  for (const Group& group : groups_) {
    if (!group.traits.momentary) continue;
    for (std::size_t i = group.first; i < group.first + group.count; ++i) {
      if (group.traits.remember && state_.atoms[i].holds) continue;
      update(i, group, symbols_.value(names_[i], view), view.world().step_count());
    }
  }
  refresh_derived(view.world().step_count());
}

void FactTracker::frame(const WorldView& view) {
  const std::int64_t step = view.world().step_count();
  const Neighbours near = neighbours(view);
  for (const Group& group : groups_) {
    if (group.traits.momentary || group.fixed) continue;
    for (std::size_t i = group.first; i < group.first + group.count; ++i) {
      const Atom& atom = state_.atoms[i];
      if (group.traits.remember && atom.holds) continue;
      const bool read = atom.raw || atom.holds || can_hold(group, i, near);
      update(i, group, read ? symbols_.value(names_[i], view) : Symbols::Value{}, step);
    }
  }
  refresh_derived(step);
  look(view);
}

// What changes in sight is known from when it changed, though that is certain only once it has settled; what changed
// out of sight, from when it came into sight.
void FactTracker::look(const WorldView& view) {
  const std::int64_t step = view.world().step_count();
  for (const Group& group : groups_) {
    if (!group.hides) continue;
    for (std::size_t i = group.first; i < group.first + group.count; ++i) {
      Atom& atom = state_.atoms[i];
      const bool in_sight =
          (!atom.seen || atom.known != atom.holds || atom.raw != atom.holds) && symbols_.observable(names_[i], view);
      if (!in_sight) {
        atom.seen_since_step = -1;
        continue;
      }
      if (atom.seen_since_step < 0) atom.seen_since_step = step;
      atom.seen = true;
      if (atom.known == atom.holds) continue;
      const std::int64_t at_step = std::max(atom.since_step, atom.seen_since_step);
      if (atom.known) {
        FactRecord record;
        record.fact = names_[i];
        record.start_step = atom.known_since_step;
        record.end_step = at_step;
        state_.closed_known.push_back(std::move(record));
      }
      ++changes_;
      atom.known = atom.holds;
      atom.known_since_step = at_step;
    }
  }
}

void FactTracker::tell(const std::vector<Fact>& facts) {
  for (const Fact& fact : facts) {
    const int index = index_of(fact);
    if (index < 0) continue;
    Atom& atom = state_.atoms[static_cast<std::size_t>(index)];
    atom.seen = true;
    atom.known = atom.holds;
    ++changes_;
  }
}

std::set<std::string> FactTracker::out_of_sight(const WorldView& view) const {
  std::set<std::string> things;
  for (const Group& group : groups_)
    for (std::size_t i = group.first; group.hides && i < group.first + group.count; ++i)
      if (state_.atoms[i].holds && !names_[i].arguments.empty() && !symbols_.observable(names_[i], view))
        things.insert(names_[i].arguments.front());
  return things;
}

void FactTracker::forget_closed() {
  state_.closed.clear();
  state_.closed_known.clear();
}

std::vector<Fact> FactTracker::never_seen() const {
  std::vector<Fact> facts;
  for (const Group& group : groups_)
    for (std::size_t i = group.first; group.hides && i < group.first + group.count; ++i)
      if (!state_.atoms[i].seen) facts.push_back(names_[i]);
  return facts;
}

Facts FactTracker::known_basic() const {
  Facts seen = static_;
  for (const Group& group : groups_)
    for (std::size_t i = group.first; i < group.first + group.count; ++i)
      if (group.hides ? state_.atoms[i].known : state_.atoms[i].holds) seen.insert(names_[i]);
  return seen;
}

Facts FactTracker::observed() const { return with_derived(known_basic(), symbols_.domain(), objects_); }

void FactTracker::update(std::size_t index, const Group& group, const Symbols::Value& value, std::int64_t step) {
  Atom& atom = state_.atoms[index];
  if (value.holds != atom.raw) {
    atom.raw = value.holds;
    atom.raw_since_step = step;
    if (value.holds && !atom.holds) atom.margin.reset();
  }
  if (value.holds && value.margin) atom.margin = std::max(atom.margin.value_or(*value.margin), *value.margin);
  if (atom.raw == atom.holds) return;
  const double settle = group.traits.momentary ? 0 : group.traits.settle_s;
  if (static_cast<double>(step - atom.raw_since_step) * dt_ + 1e-9 >= settle)
    commit(index, atom.raw, atom.raw_since_step, atom.margin);
}

void FactTracker::commit(std::size_t index, bool holds, std::int64_t at_step, std::optional<double> margin) {
  Atom& atom = state_.atoms[index];
  if (atom.holds) {
    FactRecord record;
    record.fact = names_[index];
    record.start_step = atom.since_step;
    record.end_step = at_step;
    record.margin = margin;
    state_.closed.push_back(std::move(record));
  }
  atom.holds = holds;
  atom.since_step = at_step;
  if (holds)
    state_.facts.insert(names_[index]);
  else
    state_.facts.erase(names_[index]);
  changed_ = true;
}

Facts FactTracker::basic() const {
  Facts basic;
  for (const Fact& fact : state_.facts)
    if (!derived_names_.contains(fact.predicate)) basic.insert(fact);
  return basic;
}

void FactTracker::refresh_derived(std::int64_t step) {
  if (!changed_) return;
  changed_ = false;
  ++changes_;
  Facts now = with_derived(basic(), symbols_.domain(), objects_);
  for (auto since = state_.derived_since.begin(); since != state_.derived_since.end();) {
    if (now.contains(since->first)) {
      ++since;
      continue;
    }
    FactRecord record;
    record.fact = since->first;
    record.start_step = since->second;
    record.end_step = step;
    state_.closed.push_back(std::move(record));
    since = state_.derived_since.erase(since);
  }
  for (const Fact& fact : now)
    if (derived_names_.contains(fact.predicate)) state_.derived_since.try_emplace(fact, step);
  state_.facts = std::move(now);
}

bool FactTracker::follows(const std::string& predicate) const {
  return std::ranges::any_of(groups_, [&](const Group& group) { return group.predicate == predicate; });
}

int FactTracker::index_of(const Fact& fact) const {
  const auto found = index_.find(fact);
  return found == index_.end() ? -1 : found->second;
}

bool FactTracker::known(const Fact& fact) const {
  const int index = index_of(fact);
  if (index < 0) return derived_names_.contains(fact.predicate) ? observed().contains(fact) : static_.contains(fact);
  const bool hides = std::any_of(groups_.begin(), groups_.end(),
                                 [&](const Group& group) { return group.hides && group.predicate == fact.predicate; });
  const Atom& atom = state_.atoms[static_cast<std::size_t>(index)];
  return hides ? atom.known : atom.holds;
}

bool FactTracker::pending(const Fact& fact) const {
  const int index = index_of(fact);
  if (index < 0) return false;
  const Atom& atom = state_.atoms[static_cast<std::size_t>(index)];
  return atom.raw != atom.holds;
}

std::vector<FactRecord> FactTracker::intervals(std::int64_t end_step, int steps_per_frame) const {
  std::vector<FactRecord> records = state_.closed.copy();
  const auto open = [&](const Fact& fact, std::int64_t start, std::optional<double> margin) {
    FactRecord record;
    record.fact = fact;
    record.start_step = start;
    record.end_step = end_step;
    record.open_end = true;
    record.margin = margin;
    records.push_back(std::move(record));
  };
  for (std::size_t i = 0; i < names_.size(); ++i)
    if (state_.atoms[i].holds) open(names_[i], state_.atoms[i].since_step, state_.atoms[i].margin);
  for (const auto& [fact, start] : state_.derived_since) open(fact, start, std::nullopt);
  for (const Fact& fact : static_) open(fact, 0, std::nullopt);
  const std::vector<FactRecord> known = observed_intervals(end_step, steps_per_frame);
  for (FactRecord& record : records) {
    const auto own = std::find_if(groups_.begin(), groups_.end(),
                                  [&](const Group& group) { return group.predicate == record.fact.predicate; });
    if (own == groups_.end() || !own->hides) continue;
    record.observed = std::any_of(known.begin(), known.end(), [&](const FactRecord& seen) {
      return seen.fact == record.fact && seen.start_step <= record.start_step && seen.end_step >= record.end_step;
    });
  }
  finish(records, steps_per_frame);
  return records;
}

std::vector<FactRecord> FactTracker::observed_intervals(std::int64_t end_step, int steps_per_frame) const {
  std::vector<FactRecord> records = state_.closed_known.copy();
  for (std::size_t i = 0; i < names_.size(); ++i) {
    if (!state_.atoms[i].known) continue;
    FactRecord record;
    record.fact = names_[i];
    record.start_step = state_.atoms[i].known_since_step;
    record.end_step = end_step;
    record.open_end = true;
    records.push_back(std::move(record));
  }
  finish(records, steps_per_frame);
  return records;
}

// Frames, and an order that does not depend on when intervals ended.
void FactTracker::finish(std::vector<FactRecord>& records, int steps_per_frame) const {
  std::erase_if(records,
                [](const FactRecord& record) { return record.end_step <= record.start_step && !record.open_end; });
  for (FactRecord& record : records) {
    record.open_start = record.start_step == 0;
    record.first_frame = frame_at(record.start_step, steps_per_frame);
    record.end_frame = frame_at(record.end_step, steps_per_frame) + (record.open_end ? 1 : 0);
  }
  std::sort(records.begin(), records.end(), [](const FactRecord& a, const FactRecord& b) {
    return std::tie(a.fact, a.start_step) < std::tie(b.fact, b.start_step);
  });
}

}  // namespace stampede
