#include "scripting/library/scene_outline.h"

#include <algorithm>

namespace stampede {
namespace {

OutlinedThing outlined(const Value& node, const std::string& otherwise) {
  return {node["type"].is_text() ? node["type"].text : otherwise, texts_of(node["traits"])};
}

}  // namespace

void SceneOutline::add(const std::string& name, const Value& entry, const LibraryDraft& draft) {
  const Definition* found =
      draft.find(DefinitionKind::object, entry.items.empty() ? std::string() : entry.items[0].text);
  static const Value kEmpty;
  const Value& node = found == nullptr ? kEmpty : found->node;
  const auto either = [&](const char* field) -> const Value& {
    return entry[field].present() ? entry[field] : node[field];
  };
  const bool region = either("region").present();
  OutlinedThing& thing = things[name];
  thing = {either("type").is_text() ? either("type").text : region ? "region" : "", texts_of(either("traits"))};
  thing.known = found != nullptr;
  thing.positioned = entry["at"].present() || either("place").present();
  const bool fixed =
      either("fixed").kind == Value::Kind::boolean ? either("fixed").boolean : !listed(thing.traits, "movable");
  thing.free = found != nullptr && !fixed && !region;
  const auto add_regions = [&](const std::string& owner, const Value& regions) {
    for (const auto& [region_name, one] : regions.fields) things[owner + "." + region_name] = outlined(one, "region");
  };
  add_regions(name, either("regions"));
  if (either("tip").present() && !region) things[name + ".tip"] = {"region", {}};
  for (const auto& [part_name, part] : either("parts").fields) {
    OutlinedThing& made = things[name + "." + part_name];
    made = outlined(part, "");
    made.positioned = true;
    made.free = std::any_of(kMovingJoints.begin(), kMovingJoints.end(),
                            [&](const char* joint) { return part[joint]["lets_go"].present(); });
    add_regions(name + "." + part_name, part["regions"]);
  }
}

std::string hand_of(const std::string& world, const LibraryDraft& draft) {
  const Definition* found = draft.find(DefinitionKind::world, world);
  if (found == nullptr) return "panda.hand";
  const Value& entry = found->node["robot"];
  const std::string robot = entry.items.empty() ? "robot" : entry.items[0].text;
  const Definition* definition = draft.find(DefinitionKind::robot, robot);
  const bool named = definition != nullptr && definition->node["hand"].is_text();
  return robot + "." + (named ? definition->node["hand"].text : "hand");
}

SceneOutline outline_of(const std::string& world, const LibraryDraft& draft) {
  SceneOutline outline{hand_of(world, draft), {}};
  outline.things[outline.hand] = {"hand", {}};
  const Definition* found = draft.find(DefinitionKind::world, world);
  if (found == nullptr) return outline;
  for (const auto& [name, entry] : found->node["fixtures"].fields) outline.add(name, entry, draft);
  for (const auto& [name, region] : found->node["regions"].fields) outline.things[name] = outlined(region, "region");
  return outline;
}

std::vector<std::string> things_in(const Value& object) {
  std::vector<std::string> things = keys_of(object["regions"].fields);
  if (object["tip"].present()) things.emplace_back("tip");
  for (const auto& [part, fields] : object["parts"].fields) {
    things.push_back(part);
    for (const auto& [region, unused] : fields["regions"].fields) things.push_back(part + "." + region);
  }
  return things;
}

}  // namespace stampede
