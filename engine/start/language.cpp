#include "engine/start/language.h"

#include <algorithm>
#include <array>
#include <set>

namespace stampede {
namespace {

// `red_square2`: red square 2; `c8` stays.
std::string spaced(std::string text) {
  std::replace(text.begin(), text.end(), '_', ' ');
  const std::size_t digits = text.find_last_not_of("0123456789") + 1;
  const std::size_t word = text.rfind(' ', digits) + 1;  // 0: the first
  if (digits < text.size() && digits > word + 1) text.insert(digits, " ");
  return text;
}

constexpr std::array kOrdinals = {"first",   "second", "third", "fourth", "fifth",    "sixth",
                                  "seventh", "eighth", "ninth", "tenth",  "eleventh", "twelfth"};

// Regions that are numbered: `base3` is the third base place, `red_square2` the second red square, `d7` the square d7.
std::string place_words(const Scene& scene, const Object& region) {
  const std::string name = region.name.substr(region.name.rfind('.') + 1);
  const std::size_t digits = name.find_last_not_of("0123456789") + 1;
  if (digits == 0 || digits == name.size() || name.size() - digits > 2) return spaced(name);
  if (digits == 1) return "square " + name;
  const std::string stem = name.substr(0, digits), owner = region.name.substr(0, region.name.size() - name.size());
  const auto number = static_cast<std::size_t>(std::stoi(name.substr(digits)));
  if (number < 1 || number > kOrdinals.size()) return spaced(name);
  const bool several = scene.object(owner + stem + (number == 1 ? "2" : "1")) != nullptr;
  if (!several && number > 1) return spaced(name);
  const std::string place = spaced(stem) + (region.type == "region" ? " place" : "");
  return several ? std::string(kOrdinals[number - 1]) + " " + place : place;
}

// `wide_block`: wide red block; `numbered_block_1`: numbered block one.
std::string class_words(const std::string& class_name, const std::string& colour) {
  static const std::set<std::string> kBeforeColours{"small", "large", "big",   "little", "wide",  "narrow", "tall",
                                                    "long",  "short", "thick", "thin",   "round", "square", "flat"};
  constexpr std::array kCardinals = {"one",   "two",   "three", "four", "five",   "six",
                                     "seven", "eight", "nine",  "ten",  "eleven", "twelve"};
  std::string text = spaced(class_name);
  const std::size_t digits = text.find_last_not_of("0123456789") + 1;
  if (digits > 1 && digits < text.size() && text.size() - digits <= 2 && text[digits - 1] == ' ') {
    const auto number = static_cast<std::size_t>(std::stoi(text.substr(digits)));
    if (number >= 1 && number <= kCardinals.size()) text = text.substr(0, digits) + kCardinals[number - 1];
  }
  if (colour.empty()) return text;
  const std::size_t space = text.find(' ');
  if (space == std::string::npos || !kBeforeColours.contains(text.substr(0, space))) return spaced(colour) + " " + text;
  return text.substr(0, space + 1) + spaced(colour) + text.substr(space);
}

std::string last_word(const std::string& text) { return text.substr(text.rfind(' ') + 1); }

// The left tap of a basin tap is the left tap of the basin, and the peg of a square peg the square peg itself.
std::string part_of_whole(const std::string& part, const std::string& whole, bool region) {
  if (last_word(part) != last_word(whole)) return part + " of the " + whole;
  if (region && part == last_word(whole)) return whole;
  const std::size_t space = whole.rfind(' ');
  return space == std::string::npos || part == last_word(whole) ? part + " of the " + whole
                                                                : part + " of the " + whole.substr(0, space);
}

std::string words(const Scene& scene, const Object& thing) {
  if (thing.kind == ObjectKind::hand) return "hand";
  const std::size_t dot = thing.name.rfind('.');  // a region of a part is the part's, and that the thing's
  if (dot != std::string::npos) {
    const Object* whole = scene.object(thing.name.substr(0, dot));
    const std::string part =
        thing.kind == ObjectKind::region ? place_words(scene, thing) : spaced(thing.name.substr(dot + 1));
    return whole == nullptr ? part : part_of_whole(part, words(scene, *whole), thing.kind == ObjectKind::region);
  }
  const auto colour = thing.attributes.find("colour");
  return class_words(thing.class_name.empty() ? thing.name : thing.class_name,
                     colour == thing.attributes.end() ? "" : colour->second);
}

constexpr double kHigher_m = 0.03;  // by so much one of them is above another

Vector3 start_of(const Scene& scene, const Object& thing) {
  const int body = scene.body_index(thing.body);
  if (body < 0) return Vector3::Zero();
  return scene.bodies[static_cast<std::size_t>(body)].world_from_body.translation();
}

// How far to the right something is in the picture of the first camera that stands in the world.
double rightness(const Scene& scene, const Vector3& point) {
  for (const Camera& camera : scene.cameras) {
    if (!camera.mount_body.empty()) continue;
    const Vector3 seen = camera.mount_from_camera.inverse() * point;
    return seen.x() / std::max(seen.z(), 1e-3);
  }
  return point.y();  // of who looks at the robot
}

constexpr double kClear = 0.03;  // of the distance: by so much one is seen beside another

struct Told {
  std::string words;
  bool clear = true;
};

// Things that share their words are told apart by where they are in the first picture: one above the other, or else
// from left to right.
Told told_apart(const Scene& scene, const Object& thing, std::vector<const Object*> same, const std::string& own) {
  const auto order = [&](const auto& value) {
    std::stable_sort(same.begin(), same.end(), [&](const Object* a, const Object* b) { return value(*a) < value(*b); });
  };
  const auto height = [&](const Object& one) { return start_of(scene, one).z(); };
  order(height);
  bool stacked = same.size() <= 3;
  for (std::size_t i = 0; i + 1 < same.size(); ++i)
    stacked = stacked && height(*same[i + 1]) - height(*same[i]) > kHigher_m;
  if (!stacked) order([&](const Object& one) { return rightness(scene, start_of(scene, one)); });
  bool clear = true;
  for (std::size_t i = 0; i + 1 < same.size() && !stacked; ++i)
    clear =
        clear && rightness(scene, start_of(scene, *same[i + 1])) - rightness(scene, start_of(scene, *same[i])) > kClear;
  const auto rank = static_cast<std::size_t>(std::find(same.begin(), same.end(), &thing) - same.begin());
  const bool last = rank + 1 == same.size();
  if (same.size() <= 3 && !(rank == 0 || last)) return {"middle " + own, clear};
  if (same.size() <= 3)
    return {(stacked ? rank == 0 ? "lower " : "upper " : rank == 0 ? "left " : "right ") + own, clear};
  if (rank == 0 || last) return {(last ? "rightmost " : "leftmost ") + own, clear};
  return {rank < kOrdinals.size() ? kOrdinals[rank] + (" " + own) + " from the left" : own, clear};
}

Told told(const Scene& scene, const std::string& name) {
  const Object* thing = scene.object(name);
  if (thing == nullptr) return {spaced(name)};
  const std::string own = words(scene, *thing);
  std::vector<const Object*> same;
  for (const Object& other : scene.objects)
    if (other.kind != ObjectKind::region && words(scene, other) == own) same.push_back(&other);
  if (same.size() < 2 || thing->kind == ObjectKind::region) return {own};
  return told_apart(scene, *thing, std::move(same), own);
}

}  // namespace

std::string phrase(const Scene& scene, const std::string& name) { return told(scene, name).words; }

std::optional<std::string> clear_phrase(const Scene& scene, const std::string& name) {
  Told found = told(scene, name);
  return found.clear ? std::optional(std::move(found.words)) : std::nullopt;
}

std::string fill(const std::string& text, const std::vector<Parameter>& parameters,
                 const std::vector<std::string>& arguments, const Scene& scene) {
  std::string filled;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t end = text[i] == '{' ? text.find('}', i) : std::string::npos;
    if (end == std::string::npos) {
      filled += text[i++];
      continue;
    }
    const std::string name = text.substr(i + 1, end - i - 1);
    const auto found =
        std::find_if(parameters.begin(), parameters.end(), [&](const auto& p) { return p.name == name; });
    const auto index = static_cast<std::size_t>(found - parameters.begin());
    filled += index < arguments.size() ? phrase(scene, arguments[index]) : "{" + name + "}";
    i = end + 1;
  }
  return filled;
}

namespace {

// Regions and parts of one body: how it is made, and nobody's news.
bool of_one_body(const Scene& scene, const Fact& fact) {
  if (fact.arguments.size() != 2) return false;
  const Object *first = scene.object(fact.arguments[0]), *second = scene.object(fact.arguments[1]);
  return first != nullptr && second != nullptr && !first->body.empty() && first->body == second->body;
}

// What follows of a place from how its body is made and which of its doors are shut: that something is before a shelf.
bool follows_from_make(const Facts& facts, const Predicate& predicate, const Scene& scene, const Fact& fact) {
  return predicate.kind == PredicateKind::derived && fact.arguments.size() == 1 &&
         std::any_of(facts.begin(), facts.end(), [&](const Fact& other) {
           return of_one_body(scene, other) && other.arguments[0] == fact.arguments[0];
         });
}

}  // namespace

Facts mentionable(const Facts& holds, const Facts& known, const Domain& domain, const Scene& scene) {
  std::set<std::string> hidden;
  for (const Fact& fact : holds) {
    const Predicate* predicate = domain.predicate(fact.predicate);
    const Object* thing = fact.arguments.empty() ? nullptr : scene.object(fact.arguments[0]);
    if (thing == nullptr || predicate == nullptr || predicate->kind != PredicateKind::basic) continue;
    const int body = thing->kind == ObjectKind::body ? scene.body_index(thing->body) : -1;
    if (body >= 0 && scene.bodies[static_cast<std::size_t>(body)].free && !known.contains(fact))
      hidden.insert(thing->name);
  }
  Facts said;
  for (const Fact& fact : known)
    if (std::none_of(fact.arguments.begin(), fact.arguments.end(),
                     [&](const std::string& name) { return hidden.contains(name.substr(0, name.find('.'))); }))
      said.insert(fact);
  return said;
}

std::vector<std::string> describe_world(const Facts& facts, const Domain& domain, const Scene& scene) {
  std::vector<std::string> sentences;
  for (const Fact& fact : facts) {
    const Predicate* predicate = domain.predicate(fact.predicate);
    if (predicate == nullptr || predicate->label.empty()) continue;
    const bool known = std::all_of(fact.arguments.begin(), fact.arguments.end(),
                                   [&](const std::string& name) { return scene.object(name) != nullptr; });
    if (known && !of_one_body(scene, fact) && !follows_from_make(facts, *predicate, scene, fact))
      sentences.push_back(fill(predicate->label, predicate->parameters, fact.arguments, scene));
  }
  return sentences;
}

}  // namespace stampede
