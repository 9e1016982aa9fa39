// The abstract columns: facts, what they mean for goal and skills, and the segment that runs.
#include <algorithm>
#include <cstring>
#include <limits>
#include <set>

#include "engine/record/array_maker.h"
#include "engine/record/atom_formula.h"
#include "engine/symbolic/evaluation.h"
#include "engine/symbolic/pddl.h"

namespace stampede {
namespace {

// The frames of an interval that exist.
template <typename Record>
std::pair<std::size_t, std::size_t> frames_of(const Record& record, std::size_t frames) {
  const auto clamped = [&](std::int64_t frame) {
    return static_cast<std::size_t>(std::clamp<std::int64_t>(frame, 0, static_cast<std::int64_t>(frames)));
  };
  return {clamped(record.first_frame), clamped(record.end_frame)};
}

}  // namespace

void ArrayMaker::facts() {
  std::set<Fact> atoms;
  std::set<std::string> hiding;  // predicates that were not known all the time: as in abstract_state()
  for (const FactRecord& one : episode_.labels.facts) {
    atoms.insert(one.fact);
    if (!one.observed) hiding.insert(one.fact.predicate);
  }
  for (const FactRecord& one : episode_.labels.observed_facts) {
    atoms.insert(one.fact);
    hiding.insert(one.fact.predicate);
  }
  AtomPlaces places;
  for (const Fact& atom : atoms) {
    places.emplace(atom, places.size());
    arrays_.atoms.push_back({atom.predicate, atom.arguments});
  }
  const std::size_t width = atoms.size();
  rows_.assign(tables_.frames * width, 0);
  std::vector<std::uint8_t> known(rows_.size(), 0);
  const auto mark = [&](std::vector<std::uint8_t>& rows, const FactRecord& one) {
    const auto [begin, end] = frames_of(one, tables_.frames);
    const std::size_t place = places.at(one.fact);
    for (std::size_t frame = begin; frame < end; ++frame) rows[frame * width + place] = 1;
  };
  for (const FactRecord& one : episode_.labels.facts) {
    mark(rows_, one);
    if (!hiding.contains(one.fact.predicate)) mark(known, one);
  }
  for (const FactRecord& one : episode_.labels.observed_facts) mark(known, one);
  std::vector<std::string> labels;
  for (const Fact& atom : atoms) labels.push_back(to_text(atom));
  const std::vector<std::int64_t> shape = {arrays_.frames, static_cast<std::int64_t>(width)};
  if (wanted("facts")) add({"facts", "", "", labels}, shape, rows_);
  if (wanted("known")) add({"known", "", "", std::move(labels)}, shape, std::move(known));
}

// By the problem that was stored with the episode: NaN, and no skills, where no start was found.
void ArrayMaker::goal() {
  const bool progress = wanted("progress"), applicable = wanted("applicable");
  if (!progress && !applicable) return;
  std::vector<double> shares(tables_.frames, std::numeric_limits<double>::quiet_NaN());
  ApplicableActions actions;
  const std::string* domain_text = document_of(episode_, DocumentKind::pddl_domain);
  const std::string* problem_text = document_of(episode_, DocumentKind::pddl_problem);
  const std::size_t width = arrays_.atoms.size();
  if (domain_text && problem_text && width > 0) {
    const Domain domain = domain_from_pddl(*domain_text, "pddl_domain");
    const Problem problem = problem_from_pddl(*problem_text, "pddl_problem", domain);
    const std::vector<TypedObject> objects = symbolic::all_objects(domain, problem.objects);
    Facts ever;
    AtomPlaces places;
    for (std::size_t i = 0; i < width; ++i) {
      const Fact atom{arrays_.atoms[i].predicate, arrays_.atoms[i].arguments};
      places.emplace(atom, i);
      ever.insert(atom);
    }
    const AtomWorld world{places, domain, objects, ever};
    const AtomFormula asked(problem.goal, world);
    for (std::size_t frame = 0; frame < tables_.frames; ++frame) {
      const std::uint8_t* row = &rows_[frame * width];
      const bool same = frame > 0 && std::memcmp(row, row - width, width) == 0;
      shares[frame] = same ? shares[frame - 1] : asked.share(row);
    }
    if (applicable) actions = applicable_actions(world, rows_, width);
  }
  if (progress) add({"progress", ""}, {arrays_.frames}, std::move(shares));
  if (!applicable) return;
  std::vector<std::string> labels;
  for (const Fact& action : actions.actions) {
    arrays_.skills.push_back({action.predicate, action.arguments});
    labels.push_back(to_text(action));
  }
  const auto count = static_cast<std::int64_t>(labels.size());
  add({"applicable", "", "", std::move(labels)}, {arrays_.frames, count}, std::move(actions.values));
}

// The innermost of each kind: children start no earlier than their parents and have greater ids.
void ArrayMaker::segments() {
  for (const SegmentRecord& one : episode_.labels.segments) {
    ArraySegment& segment = arrays_.segments.emplace_back();
    segment.id = one.ordinal, segment.parent = one.parent, segment.kind = to_string(one.kind);
    segment.name = one.skill, segment.case_name = one.case_name, segment.arguments = one.arguments;
    segment.first_frame = one.span.first_frame, segment.end_frame = one.span.end_frame;
    segment.success = one.outcome == Outcome::success;
    segment.reason = to_string(one.reason), segment.label = one.label;
  }
  for (const char* kind : {"subgoal", "skill", "motion"}) {
    if (!wanted(kind)) continue;
    std::vector<std::int64_t> ids(tables_.frames, -1);
    for (const ArraySegment& segment : arrays_.segments) {
      if (segment.kind != kind) continue;
      const auto [begin, end] = frames_of(segment, tables_.frames);
      for (std::size_t frame = begin; frame < end; ++frame) ids[frame] = std::max(ids[frame], segment.id);
    }
    add({kind, ""}, {arrays_.frames}, std::move(ids));
  }
}

void ArrayMaker::labels() {
  const ArrayNeeds needs = needs_of(request_);
  known_.insert(known_.end(), {"facts", "known", "progress", "applicable", "subgoal", "skill", "motion"});
  if (needs.facts) facts();
  if (needs.facts) goal();
  if (needs.segments) segments();
}

}  // namespace stampede
