#include "engine/start/refusals.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/model/scene_poses.h"
#include "engine/sim/world.h"
#include "engine/start/impasse.h"
#include "engine/start/predicates.h"
#include "engine/start/task.h"
#include "engine/symbolic/pddl.h"

namespace stampede {
namespace {

constexpr std::size_t kMostScenes = 24, kMostLooked = 1000;  // that are looked at again; that are shown

std::string in_mm(double metres) { return std::to_string(std::max(1L, std::lround(1000 * metres))) + " mm"; }

// What a margin lacks, in words.
std::string in_unit(double missing, const std::string& unit) {
  if (unit == "m") return in_mm(missing);
  const std::string digits = std::to_string(missing);
  return digits.substr(0, digits.find('.') + 3) + " rad";
}

const std::string& subject_of(const Literal& literal) {
  return literal.fact.arguments.empty() ? literal.fact.predicate : literal.fact.arguments[0];
}

bool of_hand(const Looked& looked) { return looked.opening > 0; }

std::string cure_of(const Looked& looked, const std::string& subject, const std::string& robot) {
  switch (looked.fate) {
    case Looked::Fate::out_of_reach:
      return "bring " + subject + " nearer to " + robot;
    case Looked::Fate::touches:
      if (looked.touched.starts_with(subject)) return "turn " + subject + ", or give it other grasps";
      return of_hand(looked) ? "keep " + looked.touched + " away from " + subject
                             : "fewer or smaller things there, or a larger place";
    case Looked::Fate::no_follow:
      return "place " + subject + " so that " + robot + " can go with it: nearer, or turned";
    case Looked::Fate::no_way:
    case Looked::Fate::crowded:
      return "leave more room around " + subject;
    case Looked::Fate::no_room:
      return "give " + subject + " a larger place";
    case Looked::Fate::usable:
      break;
  }
  return {};
}

}  // namespace

std::string text_of(const Literal& literal) {
  return literal.negated ? "(not " + to_text(literal.fact) + ")" : to_text(literal.fact);
}

void Refusals::add(const Blocked& blocked) {
  same_moment_ = blocked.moment == last_moment_ ? same_moment_ + 1 : 1;
  last_moment_ = blocked.moment;
  Refused& one = refused_[blocked.what];
  ++one.times;
  if (!one.blocked) one.blocked = blocked;
  one.blocked->depth = std::min(one.blocked->depth, blocked.depth);
}

Refusals::Refused& Refusals::refused(const Literal& literal, std::shared_ptr<const Scene> scene, bool asked) {
  Refused& one = refused_[stampede::text_of(literal)];
  ++one.times;
  one.literal = literal;
  one.asked = asked;
  const auto known = std::ranges::find(one.scenes, scene, &Refused::Failed::scene);
  if (known != one.scenes.end())
    ++known->times;
  else if (one.scenes.size() < kMostScenes)
    one.scenes.push_back({std::move(scene), 1});
  return one;
}

void Refusals::add_unmet(const Literal& literal, std::shared_ptr<const Scene> scene, bool asked) {
  refused(literal, std::move(scene), asked);
}

void Refusals::add_no_place(const Literal& literal, std::shared_ptr<const Scene> scene, bool asked,
                            const std::vector<Looked>& looked) {
  Refused& one = refused(literal, std::move(scene), asked);
  if (const Looked* why = commonest_miss(looked); why != nullptr) one.why.push_back(*why);
  const std::size_t room = kMostLooked - std::min(kMostLooked, one.looked.size());
  const auto shown = looked.begin() + static_cast<std::ptrdiff_t>(std::min(room, looked.size()));
  one.looked.insert(one.looked.end(), looked.begin(), shown);
}

int Refusals::only(const std::string& what) const {
  const auto found = refused_.find(what);
  return found != refused_.end() && refused_.size() == 1 ? found->second.times : 0;
}

// In the scenes in which a condition failed: by how much, and what keeps the arm from it.
void Refusals::look_again(Refused& one) {
  if (!one.literal || !one.why.empty() || !one.looked.empty()) return;
  const PredicateTraits traits = symbols_.traits(one.literal->fact.predicate);
  const std::string unit = traits.requires_pairs == Pairs::touching ? "" : traits.margin_unit;
  for (const auto& [scene, times] : one.scenes) {
    World world(scene);
    const WorldView view(world);
    std::vector<Looked> looked;
    const Symbols::Watching watching(symbols_, &looked);
    const Symbols::Value value = symbols_.value(one.literal->fact, view);
    if (value.holds != one.literal->negated) continue;  // it only failed once all had come to rest
    if (value.margin && (unit == "m" || unit == "rad"))
      one.missing = one.missing < 0 ? std::abs(*value.margin) : std::min(one.missing, std::abs(*value.margin));
    if (const Looked* why = commonest_miss(looked); why != nullptr) {
      one.why.insert(one.why.end(), static_cast<std::size_t>(times), *why);
      const Vector3 base = scene->robot.body.world_from_body.translation();
      const double distance = (view.world_from(subject_of(*one.literal)).translation() - base).norm();
      if (why->fate == Looked::Fate::out_of_reach)
        one.distance = one.distance < 0 ? distance : std::min(one.distance, distance);
    }
    std::ranges::move(looked, std::back_inserter(one.looked));
    if (one.looked.size() > kMostLooked) one.looked.resize(kMostLooked);
  }
}

std::string Refusals::text_of(const std::string& what, const Refused& one) const {
  std::string text = what;
  if (one.literal && one.asked)
    if (const std::string place = symbols_.asked_at(one.literal->fact); !place.empty()) text = place + ": " + what;
  if (one.blocked) text += " (" + in_mm(one.blocked->depth) + " deep)";
  text += " failed " + std::to_string(one.times) + (one.times == 1 ? " time" : " times");
  if (one.missing >= 0)
    text += ", by " + in_unit(one.missing, symbols_.traits(one.literal->fact.predicate).margin_unit) + " at least";
  std::map<std::string, std::vector<Looked>> causes;
  for (const Looked& why : one.why) causes[cause_of(why)].push_back(why);
  std::vector<std::pair<std::string, std::vector<Looked>>> sorted(causes.begin(), causes.end());
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const auto& a, const auto& b) { return a.second.size() > b.second.size(); });
  if (!sorted.empty() && static_cast<int>(one.why.size()) < one.times)
    text += "; of " + std::to_string(one.why.size()) + " looked at";
  const char* comma = ": ";
  for (const auto& [cause, of_it] : sorted) {
    text += std::exchange(comma, ", ") + std::to_string(of_it.size()) + " " + cause;
    const Looked* nearest = nearest_miss(of_it);
    std::string amount = nearest == nullptr ? "" : amount_of(*nearest);
    if (!amount.empty()) amount += " at least";
    if (of_it.front().fate == Looked::Fate::out_of_reach && one.distance >= 0) {
      const std::string metres = std::to_string(one.distance + 0.005);
      amount += (amount.empty() ? "" : ", ") + metres.substr(0, metres.find('.') + 3) + " m from the arm";
    }
    if (!amount.empty()) text += " (" + amount + ")";
  }
  return text;
}

std::vector<std::string> Refusals::cures(const Refused& one, int draws) const {
  std::vector<std::string> cures;
  if (one.blocked && !one.blocked->cure.empty()) cures.push_back(one.blocked->cure);
  if (!one.literal) return cures;
  for (const Looked& why : one.why) {
    std::string cure = cure_of(why, subject_of(*one.literal), one.scenes.front().scene->robot.name);
    if (!cure.empty() && std::ranges::find(cures, cure) == cures.end()) cures.push_back(std::move(cure));
  }
  const Predicate* predicate = symbols_.domain().predicate(one.literal->fact.predicate);
  const bool fact = predicate != nullptr && predicate->kind == PredicateKind::basic;
  if (fact && !one.literal->negated && one.times == draws && !symbols_.traits(predicate->name).sampled)
    cures.push_back("nothing makes it so: '" + predicate->name + "' has no `sample`; give it one, or ask for less");
  return cures;
}

void Refusals::show(const Task& task, const std::string& what, Refused& one, const std::string& detail) const {
  Impasse impasse;
  impasse.task = task.name;
  impasse.variation = task.variation;
  impasse.seed = options_.seed;
  impasse.step = "init " + what;
  impasse.reason = Reason::init_impossible;
  impasse.detail = detail;
  impasse.subject = subject_of(*one.literal);
  impasse.draws = one.times;
  impasse.looked = std::move(one.looked);
  impasse.scene = one.scenes.front().scene;
  impasse.state = initial_state(*impasse.scene);
  options_.services.witness(impasse);
}

std::string Refusals::tell(const Task& task, int draws, bool always_same) {
  std::string all;
  std::vector<std::string> cured;
  std::vector<std::pair<std::string, Refused*>> sorted;
  for (auto& [what, one] : refused_) sorted.emplace_back(what, &one);
  std::ranges::stable_sort(sorted, std::ranges::greater{}, [](const auto& one) { return one.second->times; });
  for (const auto& [what, failed] : sorted) {
    Refused& one = *failed;
    look_again(one);
    const std::string text = text_of(what, one);
    all += (all.empty() ? "" : "; ") + text;
    for (std::string& cure : cures(one, draws))
      if (std::ranges::find(cured, cure) == cured.end()) cured.push_back(std::move(cure));
    if (one.literal && options_.services.witness) show(task, what, one, text);
  }
  if (always_same) all += ": in each draw it is the same";
  for (const std::string& cure : cured) all += "; " + cure;
  return all;
}

}  // namespace stampede
