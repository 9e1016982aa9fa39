#include "scripting/sentences/frame_questions.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/base/random.h"
#include "engine/language/lexicon.h"
#include "engine/start/abstract_state.h"
#include "engine/start/language.h"

namespace stampede {
namespace {

// Of an English noun that is regular, or goes as `knife` and `shelf` do.
std::string plural_of(const std::string& noun) {
  const auto ends = [&](std::string_view end) { return noun.ends_with(end); };
  const auto without = [&](std::size_t count) { return noun.substr(0, noun.size() - count); };
  if (ends("ife")) return without(2) + "ves";
  if (ends("lf")) return without(1) + "ves";
  if (ends("y") && noun.size() > 1 && std::string_view("aeiou").find(noun[noun.size() - 2]) == std::string_view::npos)
    return without(1) + "ies";
  const bool hisses = ends("s") || ends("x") || ends("z") || ends("ch") || ends("sh");
  return noun + (hisses ? "es" : "s");
}

constexpr double kAside = 0.05;  // of the distance: by so much one is left of the other, to be asked about

// `the {obj} is on the {below}`: is it true that the {a} is on the {b}?
std::string slotted(const std::string& label, const std::vector<Parameter>& parameters) {
  std::string text = label;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const std::string from = "{" + parameters[i].name + "}",
                      to = "{" + std::string(1, static_cast<char>('a' + i)) + "}";
    for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
      text.replace(at, from.size(), to);
  }
  return text;
}

Scene at_frame(const EpisodeRecord& episode, Scene scene, std::int64_t frame) {
  if (frame < 0 || frame >= static_cast<std::int64_t>(episode.frames.size())) return scene;
  const FrameRecord& record = episode.frames[static_cast<std::size_t>(frame)];
  for (std::size_t i = 0; i < episode.scene.posed.size() && i < record.object_pose.size(); ++i) {
    const Object* object = scene.object(episode.scene.posed[i]);
    const int body = object == nullptr ? -1 : scene.body_index(object->body);
    const Transform at = to_transform(record.object_pose[i]);
    if (body >= 0 && at.matrix().allFinite()) scene.bodies[static_cast<std::size_t>(body)].world_from_body = at;
  }
  return scene;
}

class QuestionMaker {
 public:
  QuestionMaker(const EpisodeRecord& episode, const Domain& domain, const Scene& scene, std::int64_t frame)
      : episode_(episode), domain_(domain), start_(scene), scene_(at_frame(episode, scene, frame)), frame_(frame) {
    for (const FactRecord& fact : episode.labels.facts)
      if (fact.first_frame <= frame && frame < fact.end_frame) facts_.insert(fact.fact);
    for (const FactRecord& fact : episode.labels.facts) ever_.insert(fact.fact);
    if (frame >= 0 && frame < static_cast<std::int64_t>(episode.frames.size()))
      unseen_ = unseen_things(abstract_state(episode, frame));
  }

  std::vector<FrameQuestion> make() {
    ask_facts();
    ask_places();
    ask_colours();
    ask_skills();
    ask_sides();
    return std::move(made_);
  }

 private:
  FrameQuestion& add(const char* type, std::string pattern, std::string answer, const char* answer_type,
                     std::string proof) {
    FrameQuestion question;
    question.frame = frame_;
    question.type = type;
    question.pattern = std::move(pattern);
    question.answer = std::move(answer);
    question.answer_type = answer_type;
    question.proof = std::move(proof);
    made_.push_back(std::move(question));
    return made_.back();
  }

  void put_slots(FrameQuestion& question, const std::vector<std::string>& things) const {
    for (std::size_t i = 0; i < things.size(); ++i) {
      question.slots[std::string(1, static_cast<char>('a' + i))] = phrase(scene_, things[i]);
      question.things.insert(things[i]);
    }
  }

  const Predicate* told(const Fact& fact) const {
    const Predicate* predicate = domain_.predicate(fact.predicate);
    const bool spoken = predicate != nullptr && !predicate->label.empty() && predicate->kind != PredicateKind::fixed;
    return spoken && seen_clearly(fact.arguments) ? predicate : nullptr;
  }

  // Regions are not seen, nor what lies hidden; of things that share their words, those that do not stand apart cannot
  // be named.
  bool seen_clearly(const std::vector<std::string>& names) const {
    return std::all_of(names.begin(), names.end(), [&](const std::string& name) {
      const Object* object = scene_.object(name);
      return !unseen_.contains(name) && object != nullptr && object->kind != ObjectKind::region &&
             clear_phrase(scene_, name);
    });
  }

  // A label has the names of the start.
  std::string relabelled(const SegmentRecord& segment) const {
    std::string label = segment.label;
    for (const std::string& name : segment.arguments) {
      const std::string from = phrase(start_, name), to = phrase(scene_, name);
      if (const std::size_t at = label.find(from); at != std::string::npos) label.replace(at, from.size(), to);
    }
    return label;
  }

  bool is_named(const SegmentRecord& segment) const {
    return std::all_of(segment.arguments.begin(), segment.arguments.end(), [&](const std::string& name) {
      return scene_.object(name) == nullptr || clear_phrase(scene_, name);
    });
  }

  // What holds, and for each as near a thing as there is that does not: it held at another time, or of another thing.
  void ask_facts() {
    std::vector<Fact> yes, no;
    for (const Fact& fact : ever_)
      if (told(fact) != nullptr) (facts_.contains(fact) ? yes : no).push_back(fact);
    for (const Fact& fact : yes)
      for (const Fact& other : yes) {
        if (no.size() >= yes.size()) break;
        if (fact.predicate != other.predicate || fact.arguments.size() < 2 ||
            fact.arguments.front() == other.arguments.front())
          continue;
        Fact mixed = fact;
        mixed.arguments.back() = other.arguments.back();
        if (!ever_.contains(mixed) && mixed.arguments.front() != mixed.arguments.back()) no.push_back(mixed);
      }
    Random random(
        RandomKey("questions that hold").with(episode_.task).with(episode_.variation).with(episode_.seed).with(frame_));
    random.shuffle(yes);
    random.shuffle(no);
    const std::size_t each = std::min(yes.size(), no.size());  // as many of each
    for (std::size_t i = 0; i < each; ++i)
      for (const Fact* fact : {&yes[i], &no[i]}) {
        const Predicate* predicate = told(*fact);
        const bool holds = facts_.contains(*fact);
        FrameQuestion& question =
            add("holds", "is it true that " + slotted(predicate->label, predicate->parameters) + "?",
                holds ? "yes" : "no", "yes_no", (holds ? "" : "not ") + to_text(*fact));
        put_slots(question, fact->arguments);
      }
  }

  void ask_places() {
    for (const Fact& fact : facts_) {
      if ((fact.predicate != "on" && fact.predicate != "inside") || told(fact) == nullptr) continue;
      FrameQuestion& question = add("where", fact.predicate == "on" ? "what is the {a} on?" : "what is the {a} inside?",
                                    phrase(scene_, fact.arguments[1]), "thing", to_text(fact));
      put_slots(question, {fact.arguments[0]});
      question.things.insert(fact.arguments[1]);
    }
  }

  void ask_colours() {
    std::map<std::string, std::vector<const Object*>> by_class;
    for (const Object& object : scene_.objects)
      if (object.kind == ObjectKind::body && !object.class_name.empty())
        by_class[spaced_name(object.class_name)].push_back(&object);
    for (const auto& [name, objects] : by_class) {
      if (std::any_of(objects.begin(), objects.end(), [&](const Object* one) { return unseen_.contains(one->name); }))
        continue;
      std::map<std::string, int> colours;
      for (const Object* object : objects)
        if (const auto colour = object->attributes.find("colour"); colour != object->attributes.end())
          ++colours[colour->second];
      if (colours.empty()) continue;
      if (objects.size() == 1) {
        FrameQuestion& question =
            add("colour", "what colour is the {a}?", spaced_name(colours.begin()->first), "colour",
                "(colour " + objects.front()->name + " " + colours.begin()->first + ")");
        question.slots["a"] = name;
        question.things.insert(objects.front()->name);
      }
      for (const auto& [colour, count] : colours) {
        FrameQuestion& question = add("count", "how many {a} are there?", std::to_string(count), "number", "");
        question.slots["a"] = spaced_name(colour) + " " + plural_of(name);
        for (const Object* object : objects) {
          const auto own = object->attributes.find("colour");
          if (own == object->attributes.end() || own->second != colour) continue;
          question.things.insert(object->name);
          question.proof += (question.proof.empty() ? "" : " ") + ("(colour " + object->name + " " + colour + ")");
        }
      }
    }
  }

  void ask_skills() {
    const SegmentRecord *next = nullptr, *last = nullptr;
    for (const SegmentRecord& segment : episode_.labels.segments) {
      if (segment.kind != SegmentKind::skill || segment.label.empty()) continue;
      if (!is_named(segment)) continue;
      if (segment.span.first_frame >= frame_ && next == nullptr) next = &segment;
      if (segment.span.end_frame <= frame_ && segment.outcome == Outcome::success) last = &segment;
    }
    if (next != nullptr) {
      FrameQuestion& question = add("next_skill", "what does the robot do next?", relabelled(*next), "skill",
                                    "segment " + std::to_string(next->ordinal));
      question.things.insert(next->arguments.begin(), next->arguments.end());
    }
    if (last == nullptr) return;
    std::string changes;
    for (const EffectRecord& effect : last->declared_effects) {
      const Predicate* predicate = told(effect.fact);
      if (predicate == nullptr || !came_true(effect, last->span)) continue;
      const std::string label = fill(predicate->label, predicate->parameters, effect.fact.arguments, scene_);
      changes += (changes.empty() ? "" : "; ") + (effect.negated ? "no longer: " + label : label);
    }
    if (changes.empty()) return;
    FrameQuestion& question = add("changed", "what did it change that the robot did this: {a}?", changes, "facts",
                                  "segment " + std::to_string(last->ordinal));
    question.slots["a"] = relabelled(*last);
    question.things.insert(last->arguments.begin(), last->arguments.end());
  }

  // What was so before is declared too, and is no change.
  bool came_true(const EffectRecord& effect, const Span& span) const {
    return std::any_of(episode_.labels.facts.begin(), episode_.labels.facts.end(), [&](const FactRecord& one) {
      const std::int64_t at = effect.negated ? one.end_frame : one.first_frame;
      return one.fact == effect.fact && at > span.first_frame && at <= span.end_frame;
    });
  }

  // Left and right in the picture of the first camera that stands in the world.
  void ask_sides() {
    const auto camera = std::find_if(scene_.cameras.begin(), scene_.cameras.end(),
                                     [](const Camera& one) { return one.mount_body.empty(); });
    if (camera == scene_.cameras.end() || frame_ < 0 || frame_ >= static_cast<std::int64_t>(episode_.frames.size()))
      return;
    const FrameRecord& frame = episode_.frames[static_cast<std::size_t>(frame_)];
    const Transform camera_from_world = camera->mount_from_camera.inverse();
    std::vector<std::pair<std::string, double>> seen;
    const auto moves = [&](const std::string& name) {
      const std::vector<std::string>& traits = scene_.object(name)->traits;
      return std::find(traits.begin(), traits.end(), "movable") != traits.end();
    };
    // Not what all stands on, and not what its name says of anyway: `the left cup`.
    const auto can_be_asked = [&](const std::string& name) {
      static const std::set<std::string> kUnder = {"table", "floor", "pedestal"};
      const std::optional<std::string> called = clear_phrase(scene_, name);
      return called && !unseen_.contains(name) && !kUnder.contains(name) && called->find("left") == std::string::npos &&
             called->find("right") == std::string::npos && called->find("middle") == std::string::npos;
    };
    for (std::size_t i = 0; i < episode_.scene.posed.size() && i < frame.object_pose.size(); ++i) {
      const Object* object = scene_.object(episode_.scene.posed[i]);
      if (object == nullptr || object->kind != ObjectKind::body || !can_be_asked(object->name)) continue;
      const Vector3 at = camera_from_world * to_transform(frame.object_pose[i]).translation();
      if (at.z() > 0.05 && std::isfinite(at.x())) seen.emplace_back(object->name, at.x() / at.z());
    }
    bool other_way = Random(RandomKey("side").with(episode_.task).with(episode_.seed).with(frame_)).below(2) == 0;
    for (std::size_t i = 0; i < seen.size(); ++i)
      for (std::size_t k = i + 1; k < seen.size(); ++k) {
        if (std::abs(seen[i].second - seen[k].second) < kAside || !(moves(seen[i].first) || moves(seen[k].first)))
          continue;
        const bool left = seen[i].second < seen[k].second;
        other_way = !other_way;  // yes and no in turn
        const bool first = left == other_way;
        const std::string &a = first ? seen[i].first : seen[k].first, &b = first ? seen[k].first : seen[i].first;
        FrameQuestion& question = add("side", "is the {a} left of the {b}?", other_way ? "yes" : "no", "yes_no",
                                      "poses of " + a + " and " + b + " in " + camera->name);
        put_slots(question, {a, b});
        question.camera = camera->name;
      }
  }

  const EpisodeRecord& episode_;
  const Domain& domain_;
  const Scene& start_;
  const Scene scene_;  // with the things where they are at the frame, which their names go by
  std::int64_t frame_;
  Facts facts_, ever_;
  std::set<std::string> unseen_;  // what nobody can know of at the frame
  std::vector<FrameQuestion> made_;
};

}  // namespace

std::string FrameQuestion::text(const std::string& with_pattern) const {
  std::string filled = with_pattern;
  for (const auto& [slot, name] : slots) {
    const std::string from = "{" + slot + "}";
    for (std::size_t at = filled.find(from); at != std::string::npos; at = filled.find(from, at + name.size()))
      filled.replace(at, from.size(), name);
  }
  return filled;
}

std::vector<FrameQuestion> questions_about(const EpisodeRecord& episode, const Domain& domain, const Scene& scene,
                                           std::int64_t frame) {
  return QuestionMaker(episode, domain, scene, frame).make();
}

std::vector<FrameQuestion> chosen_questions(std::vector<FrameQuestion> all, const EpisodeRecord& episode,
                                            std::int64_t frame, int most) {
  Random random(RandomKey("questions").with(episode.task).with(episode.variation).with(episode.seed).with(frame));
  random.shuffle(all);
  std::map<std::string, std::vector<FrameQuestion>> by_type;
  for (FrameQuestion& one : all)
    by_type[one.type + (one.answer_type == "yes_no" ? one.answer : "")].push_back(std::move(one));
  std::vector<std::string> types;
  for (const auto& [type, list] : by_type) types.push_back(type);
  random.shuffle(types);
  std::vector<FrameQuestion> chosen;
  for (std::size_t round = 0; static_cast<int>(chosen.size()) < most; ++round) {
    bool any = false;
    for (const std::string& type : types) {
      std::vector<FrameQuestion>& list = by_type[type];
      if (round >= list.size()) continue;
      any = true;
      if (static_cast<int>(chosen.size()) < most) chosen.push_back(std::move(list[round]));
    }
    if (!any) break;
  }
  return chosen;
}

}  // namespace stampede
