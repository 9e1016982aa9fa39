#include "engine/symbolic/instances.h"

#include <algorithm>

#include "engine/base/error.h"
#include "engine/base/names.h"

namespace stampede::symbolic {
namespace {

constexpr std::int64_t kCountless = 1'000'000'000'000'000'000;

std::string with_commas(std::int64_t count) {
  std::string text = std::to_string(count);
  for (std::size_t at = text.size(); at > 3; at -= 3) text.insert(at - 3, ",");
  return text;
}

void limit(const Formula& formula, const View& view, std::int64_t outer, std::vector<std::string>& names,
           const std::string& place) {
  if (!formula.variables.empty()) {
    outer = times(outer, instances_of(formula.variables, view));
    for (const Parameter& one : formula.variables) names.push_back(one.name);
    if (outer > kMostInstances)
      too_many_instances(formula.kind == Formula::Kind::exists ? "exists" : "forall", names, outer, kMostInstances,
                         place);
  }
  for (const Formula& part : formula.parts) limit(part, view, outer, names, place);
  names.resize(names.size() - formula.variables.size());
}

}  // namespace

std::int64_t times(std::int64_t count, std::int64_t choices) {
  return choices > 0 && count > kCountless / choices ? kCountless : count * choices;
}

std::int64_t instances_of(const std::vector<Parameter>& variables, const View& view) {
  std::int64_t count = 1;
  for (const Parameter& one : variables)
    count = times(count, std::count_if(view.objects.begin(), view.objects.end(),
                                       [&](const TypedObject& object) { return admits(one, object, view); }));
  return count;
}

void limit_instances(const Formula& formula, const View& view, const std::string& place) {
  std::vector<std::string> names;
  limit(formula, view, 1, names, place);
}

void limit_instances(const std::string& what, const std::vector<Parameter>& variables, const View& view,
                     const std::string& place) {
  const std::int64_t count = instances_of(variables, view);
  if (count > kMostInstances) too_many_instances(what, names_of(variables), count, kMostInstances, place);
}

void too_many_instances(const std::string& what, const std::vector<std::string>& variables, std::int64_t count,
                        std::int64_t most, const std::string& place) {
  std::string text = what + " over";
  for (const std::string& name : variables) text += (name.starts_with('?') ? " " : " ?") + name;
  throw Error(place,
              text + ": " + (count >= kCountless ? "more than " : "") + with_commas(count) + " instances, at most " +
                  with_commas(most),
              "name fewer variables, or give them narrower types or traits");
}

}  // namespace stampede::symbolic
