#include "engine/episode/language.h"

#include <algorithm>
#include <array>

namespace stampede {
namespace {

std::string spaced(std::string text) {
  std::replace(text.begin(), text.end(), '_', ' ');
  return text;
}

std::string words(const Scene& scene, const Object& thing) {
  if (thing.kind == ObjectKind::hand) return "hand";
  const std::size_t dot = thing.name.find('.');
  if (dot != std::string::npos) {
    const Object* whole = scene.object(thing.name.substr(0, dot));
    const std::string part = spaced(thing.name.substr(dot + 1));
    return whole == nullptr ? part : part + " of the " + words(scene, *whole);
  }
  const auto colour = thing.attributes.find("colour");
  const std::string name = spaced(thing.class_name.empty() ? thing.name : thing.class_name);
  return colour == thing.attributes.end() ? name : spaced(colour->second) + " " + name;
}

}  // namespace

std::string phrase(const Scene& scene, const std::string& name) {
  static constexpr std::array kOrdinals = {"first", "second",  "third",  "fourth", "fifth",
                                           "sixth", "seventh", "eighth", "ninth",  "tenth"};
  const Object* thing = scene.object(name);
  if (thing == nullptr) return spaced(name);
  const std::string own = words(scene, *thing);
  std::size_t rank = 0, same = 0;
  for (const Object& other : scene.objects) {
    if (other.kind == ObjectKind::region || words(scene, other) != own) continue;
    if (other.name == name) rank = same;
    ++same;
  }
  return same > 1 && rank < kOrdinals.size() ? std::string(kOrdinals[rank]) + " " + own : own;
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

std::vector<std::string> describe_world(const Facts& facts, const Domain& domain, const Scene& scene) {
  std::vector<std::string> sentences;
  for (const Fact& fact : facts) {
    const Predicate* predicate = domain.predicate(fact.predicate);
    if (predicate == nullptr || predicate->label.empty()) continue;
    const bool known = std::all_of(fact.arguments.begin(), fact.arguments.end(),
                                   [&](const std::string& name) { return scene.object(name) != nullptr; });
    if (known) sentences.push_back(fill(predicate->label, predicate->parameters, fact.arguments, scene));
  }
  return sentences;
}

}  // namespace stampede
