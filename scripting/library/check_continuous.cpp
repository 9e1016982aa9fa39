// Continuous parameters of skills: numbers with bounds, or streams that they are drawn from.
#include <limits>

#include "scripting/library/checks.h"

namespace stampede {
namespace {

// A bound: one number for all components, or one each.
std::vector<double> bound(const Value& node, std::size_t count, double otherwise) {
  std::vector<double> result(count, node.is_number() ? node.number : otherwise);
  for (std::size_t i = 0; i < node.items.size() && i < count; ++i) result[i] = node.items[i].number;
  return result;
}

class ContinuousReader {
 public:
  ContinuousReader(LibraryDraft& draft, const Definition& skill, const std::vector<Parameter>& parameters)
      : draft_(draft), skill_(skill), parameters_(parameters) {}

  ContinuousInfo read(const std::string& name, const Value& node) {
    const std::string path = "continuous." + name;
    ContinuousInfo one;
    one.name = name;
    check_name(name, path, skill_.complainer());
    if (name == "controller" || name == "stiffness")
      skill_.complain(path, "'" + name + "' is a continuous parameter of every skill already",
                      "set the field " + name + " of the skill");
    if (node.tag() == "stream") {
      if (node["source"].text == "grasps")
        read_grasps(node, path, one);
      else
        read_sample(node, path, one);
    } else if (node.is_number() || (node.is_table() && node.tag().empty())) {
      read_value(node, path, one);
    } else {
      skill_.complain(path, "a continuous parameter is a number, a list or a stream, this is " + node.type_name());
    }
    return one;
  }

 private:
  // stream("grasps", "part", "pull")
  void read_grasps(const Value& node, const std::string& path, ContinuousInfo& one) {
    const std::vector<std::string> names = names_of(parameters_);
    one.source = ContinuousInfo::Source::grasps;
    one.object = node["object"].is_text() ? node["object"].text : names.empty() ? "" : names[0];
    if (!listed(names, one.object)) skill_.complain_unknown(path, "parameter", one.object, names);
    one.to = node["to"].text;
    if (!one.to.empty() && !draft_.numbers().all().contains(one.to))
      draft_.complaints().add(unknown_number(skill_.place(path), one.to, keys_of(draft_.numbers().all())));
  }

  // stream("sample", is.on("obj", "to"))
  void read_sample(const Value& node, const std::string& path, ContinuousInfo& one) {
    one.source = ContinuousInfo::Source::sample;
    const Formula literal = formula_from(node["literal"], draft_.schema(skill_, path, parameters_));
    one.literal.predicate = literal.predicate;
    one.literal.arguments = names_of(literal.terms);
    const Definition* predicate = draft_.find(DefinitionKind::predicate, literal.predicate);
    if (predicate == nullptr || !predicate->node["sample"].present())
      skill_.complain(path, "the predicate '" + literal.predicate + "' has no sample to draw from",
                      "give it one, or a fixed value here");
  }

  // 0.1, { 0.1, min = 0, max = 0.3, unit = "m" } or { { x, y, z }, unit = "m" }.
  void read_value(const Value& node, const std::string& path, ContinuousInfo& one) {
    constexpr double kInfinite = std::numeric_limits<double>::infinity();
    if (node.is_number()) one.initial = {node.number};
    const bool vector = !node.items.empty() && node.items.front().is_table();
    for (const Value& item : vector ? node.items.front().items : node.items)
      if (item.is_number()) one.initial.push_back(item.number);
    if (one.initial.empty())
      skill_.complain(path, "a continuous parameter begins with its default",
                      "such as { 0.1, min = 0, max = 0.3, unit = \"m\" }");
    one.lower = bound(node["min"], one.initial.size(), -kInfinite);
    one.upper = bound(node["max"], one.initial.size(), kInfinite);
    one.unit = node["unit"].text;
    one.frame = node["frame"].text;
    for (std::size_t i = 0; i < one.initial.size(); ++i)
      if (one.initial[i] < one.lower[i] || one.initial[i] > one.upper[i])
        skill_.complain(path, "its default " + std::to_string(one.initial[i]) + " lies outside min and max");
    const std::vector<std::string> known = {"min", "max", "unit", "frame"};
    for (const auto& [key, value] : node.fields)
      if (!listed(known, key))
        skill_.complain(path + "." + key, "a continuous parameter has no field '" + key + "'",
                        did_you_mean(key, known));
  }

  LibraryDraft& draft_;
  const Definition& skill_;
  const std::vector<Parameter>& parameters_;
};

}  // namespace

void read_continuous(LibraryDraft& draft, const Definition& skill, SkillInfo& info) {
  ContinuousReader reader(draft, skill, info.parameters);
  draft.complaints().guarded([&] {
    for (const auto& [name, node] : skill.node["continuous"].fields) info.continuous.push_back(reader.read(name, node));
  });
}

}  // namespace stampede
