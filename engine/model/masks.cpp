#include "engine/model/masks.h"

#include <algorithm>
#include <set>

#include "engine/base/error.h"
#include "engine/model/body_tree.h"

namespace stampede {
namespace {

constexpr const char* kHandClass = "hand";

// The object that is the part itself; else the one that is the whole body; null: no object has that body.
const Object* object_of(const Scene& scene, const std::string& body, int part) {
  const Object* whole = nullptr;
  for (const Object& object : scene.objects) {
    if (object.body != body || object.kind == ObjectKind::region || object.kind == ObjectKind::hand) continue;
    if (object.kind == ObjectKind::part && object.part == part) return &object;
    if (object.kind == ObjectKind::body) whole = &object;
  }
  return whole;
}

// What hides what is behind it; the rest tints it and is in no mask.
bool opaque(double alpha) { return alpha >= kOpaque; }

bool in_masks(const Part& part) {
  return std::any_of(part.shapes.begin(), part.shapes.end(),
                     [](const Shape& shape) { return shape.visible && opaque(shape.colour.alpha); });
}

bool in_masks(const Region& region) { return region.visible && opaque(region.colour.alpha); }

bool is_hand(const Scene& scene, int part) { return hangs_on(scene.robot.body, part, scene.robot.tip_part); }

std::string class_of_region(const Scene& scene, const Region& region) {
  const Object* object = scene.object(region.name);
  return object == nullptr || object->class_name.empty() ? "region" : object->class_name;
}

void collect_classes(Scene& scene) {
  std::set<std::string> classes;
  for (std::size_t part = 0; part < scene.robot.body.parts.size(); ++part)
    classes.insert(class_of_part(scene, -1, static_cast<int>(part)));
  for (std::size_t body = 0; body < scene.bodies.size(); ++body)
    for (std::size_t part = 0; part < scene.bodies[body].parts.size(); ++part)
      classes.insert(class_of_part(scene, static_cast<int>(body), static_cast<int>(part)));
  for (const Region& region : scene.regions)
    if (region.visible) classes.insert(class_of_region(scene, region));
  scene.classes.assign(classes.begin(), classes.end());
}

int semantic_of(const Scene& scene, const std::string& class_name) {
  const auto found = std::find(scene.classes.begin(), scene.classes.end(), class_name);
  if (found == scene.classes.end())
    throw Error("scene", "its classes leave out '" + class_name + "'", "leave Scene::classes empty, or name them all");
  return static_cast<int>(found - scene.classes.begin()) + 1;
}

MaskEntry entry_of(const Scene& scene, int body, std::size_t part) {
  const Body& owner = scene.body_at(body);
  const std::string& body_name = body < 0 ? scene.robot.name : owner.name;
  MaskEntry entry;
  entry.instance = owner.parts[part].instance;
  const Object* object = body < 0 ? nullptr : object_of(scene, body_name, static_cast<int>(part));
  if (body < 0 && is_hand(scene, static_cast<int>(part)))
    entry.object = scene.robot.name + "." + scene.robot.hand;
  else
    entry.object = object == nullptr ? body_name : object->name;
  entry.name = part == 0 && body >= 0 ? body_name : body_name + "." + owner.parts[part].name;
  entry.class_name = class_of_part(scene, body, static_cast<int>(part));
  entry.semantic = semantic_of(scene, entry.class_name);
  return entry;
}

}  // namespace

std::string class_of_part(const Scene& scene, int body, int part) {
  if (body < 0) return is_hand(scene, part) ? kHandClass : scene.robot.name;
  const Object* object = object_of(scene, scene.bodies[static_cast<std::size_t>(body)].name, part);
  if (object == nullptr) return scene.bodies[static_cast<std::size_t>(body)].name;
  return object->kind == ObjectKind::part || object->class_name.empty() ? object->type : object->class_name;
}

void number_masks(Scene& scene, RandomKey key) {
  int next = 1;
  for (Part& part : scene.robot.body.parts) {
    part.instance = in_masks(part) ? next : 0;  // a link without shapes leaves its number out
    ++next;
  }
  std::vector<int*> others;
  for (Body& body : scene.bodies)
    for (Part& part : body.parts) {
      part.instance = 0;
      if (!in_masks(part)) continue;
      if (body.fixture)
        part.instance = next++;
      else
        others.push_back(&part.instance);
    }
  for (Region& region : scene.regions) {
    region.instance = 0;
    if (in_masks(region)) others.push_back(&region.instance);
  }
  std::vector<int> numbers(others.size());
  for (int& number : numbers) number = next++;
  Random(key).shuffle(numbers);
  for (std::size_t i = 0; i < others.size(); ++i) *others[i] = numbers[i];
  if (next > 65536) throw Error("scene", "it has more parts than 16-bit masks can tell apart", "use fewer objects");
  if (scene.classes.empty()) collect_classes(scene);
}

std::vector<MaskEntry> mask_key(const Scene& scene) {
  std::vector<MaskEntry> entries;
  const auto add_parts = [&](const Body& body, int index) {
    for (std::size_t part = 0; part < body.parts.size(); ++part)
      if (body.parts[part].instance != 0 || in_masks(body.parts[part])) entries.push_back(entry_of(scene, index, part));
  };
  add_parts(scene.robot.body, -1);
  for (std::size_t body = 0; body < scene.bodies.size(); ++body) add_parts(scene.bodies[body], static_cast<int>(body));
  for (const Region& region : scene.regions) {
    if (region.instance == 0 && !in_masks(region)) continue;
    const std::string name = class_of_region(scene, region);
    entries.push_back({region.instance, region.name, region.name, name, semantic_of(scene, name)});
  }
  std::sort(entries.begin(), entries.end(),
            [](const MaskEntry& a, const MaskEntry& b) { return a.instance < b.instance; });
  if (!entries.empty() && entries.front().instance == 0)
    throw Error("scene", "its parts have no mask numbers", "call number_masks first");
  return entries;
}

}  // namespace stampede
