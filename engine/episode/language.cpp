#include "engine/episode/language.h"

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
  if (!several) return spaced(name);
  return std::string(kOrdinals[number - 1]) + " " + spaced(stem) + (region.type == "region" ? " place" : "");
}

std::string words(const Scene& scene, const Object& thing) {
  if (thing.kind == ObjectKind::hand) return "hand";
  const std::size_t dot = thing.name.rfind('.');  // a region of a part is the part's, and that the thing's
  if (dot != std::string::npos) {
    const Object* whole = scene.object(thing.name.substr(0, dot));
    const std::string part =
        thing.kind == ObjectKind::region ? place_words(scene, thing) : spaced(thing.name.substr(dot + 1));
    return whole == nullptr ? part : part + " of the " + words(scene, *whole);
  }
  const auto colour = thing.attributes.find("colour");
  const std::string name = spaced(thing.class_name.empty() ? thing.name : thing.class_name);
  return colour == thing.attributes.end() ? name : spaced(colour->second) + " " + name;
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
  return -point.y();
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

// A region of a body, and that body or another of its parts: how it is made, and nobody's news.
bool of_one_body(const Scene& scene, const Fact& fact) {
  if (fact.arguments.size() != 2) return false;
  const Object &first = *scene.object(fact.arguments[0]), &second = *scene.object(fact.arguments[1]);
  return (first.kind == ObjectKind::region || second.kind == ObjectKind::region) && !first.body.empty() &&
         first.body == second.body;
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
    if (known && !of_one_body(scene, fact))
      sentences.push_back(fill(predicate->label, predicate->parameters, fact.arguments, scene));
  }
  return sentences;
}

}  // namespace stampede
