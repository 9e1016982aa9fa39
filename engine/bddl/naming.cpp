#include <algorithm>
#include <cctype>

#include "engine/base/error.h"
#include "engine/bddl/express.h"

namespace stampede::symbolic {
namespace {

using ThingKind = BddlThing::Kind;

std::string small_word(const std::string& name) {
  std::string word;
  for (const char c : name) {
    const bool good = std::isalnum(static_cast<unsigned char>(c)) != 0;
    word += good ? static_cast<char>(std::tolower(static_cast<unsigned char>(c))) : '_';
  }
  return word;
}

std::string last_word(const std::string& name) { return small_word(name.substr(name.rfind('.') + 1)); }

}  // namespace

BddlNaming::BddlNaming(const BddlScene& scene, const BddlMapping& mapping, BddlExport& result)
    : scene_(scene), mapping_(mapping), result_(result) {}

const BddlThing* BddlNaming::thing(const std::string& name) const {
  for (const BddlThing& one : scene_.things) {
    if (one.name == name) return &one;
  }
  return nullptr;
}

std::string BddlNaming::unique(const std::string& name) {
  std::string result = name;
  for (int i = 2; !taken_.insert(result).second; ++i) result = name + "_" + std::to_string(i);
  return result;
}

void BddlNaming::add(std::vector<BddlGroup>& groups, const std::string& category, const std::string& name) {
  for (BddlGroup& group : groups) {
    if (group.category != category) continue;
    group.names.push_back(name);
    return;
  }
  groups.push_back({category, {name}});
}

void BddlNaming::name_all() {
  std::set<std::string> seen;
  for (const BddlThing& one : scene_.things) {
    if (!seen.insert(one.name).second) throw Error(one.name, "is in the scene twice", "names are unique");
  }
  const bool libero = mapping_.dialect == BddlDialect::libero;
  for (const bool bodies : {true, false}) {  // bodies first: parts and regions need their names
    for (const BddlThing& one : scene_.things) {
      if ((one.kind != ThingKind::part && one.kind != ThingKind::region) != bodies) continue;
      libero ? name_libero(one) : name_behavior(one);
    }
  }
}

void BddlNaming::name_libero(const BddlThing& thing) {
  if (thing.kind == ThingKind::hand) return;
  if (thing.kind == ThingKind::object || thing.kind == ThingKind::fixture) {
    const auto has = [](const std::vector<std::string>& list, const std::string& word) {
      return std::find(list.begin(), list.end(), word) != list.end();
    };
    if (has(mapping_.unsaid, thing.class_name)) return;  // stands in their arena
    const std::string* category = mapping_.category(thing.class_name, thing.type);
    if (category == nullptr && thing.kind == ThingKind::fixture) {
      result_.remarks.push_back("`" + thing.name + "` is left out: the mapping has no category for `" +
                                thing.class_name + "`");
      return;
    }
    const std::string written = category == nullptr ? small_word(thing.class_name) : *category;
    if (category == nullptr || has(mapping_.unknown, written)) {
      remark("LIBERO has no object `" + written + "` (`" + thing.name +
             "`): register one of that name before the problem is loaded, or map its category to one that it has");
    }
    const auto fixed = mapping_.instances.find(written);
    const std::string name = unique(fixed == mapping_.instances.end() ? small_word(thing.name) : fixed->second);
    if (fixed != mapping_.instances.end() && name != fixed->second)
      remark("`" + thing.name + "` is a second `" + written + "`: their arena has one only");
    result_.names[thing.name] = name;
    add(thing.kind == ThingKind::fixture ? result_.problem.fixtures : result_.problem.objects, written, name);
    return;
  }
  const auto owner = result_.names.find(thing.owner);
  if (owner == result_.names.end()) return;
  std::string site = last_word(thing.name);
  if (thing.kind == ThingKind::part) {
    const auto mapped = std::find_if(mapping_.sites.begin(), mapping_.sites.end(),
                                     [&](const BddlPair& pair) { return pair.ours == last_word(thing.name); });
    if (mapped != mapping_.sites.end()) site = mapped->theirs;
  }
  BddlRegion region{site, owner->second, {}, {0, 0}, {0, 0, 1, 0}};
  for (int i = 2; !taken_.insert(region.key()).second; ++i) region.name = site + "_" + std::to_string(i);
  if (thing.kind == ThingKind::region) region.ranges = thing.area;
  result_.names[thing.name] = region.key();
  sites_[thing.name] = region;
}

void BddlNaming::name_behavior(const BddlThing& thing) {
  const std::string* category = mapping_.category(thing.class_name, thing.type);
  if (thing.kind == ThingKind::part) {
    const auto owner = result_.names.find(thing.owner);
    if (owner != result_.names.end()) result_.names[thing.name] = owner->second;
    return;
  }
  if (thing.kind == ThingKind::region && !thing.owner.empty()) return;  // its class is its owner's
  if (category != nullptr) {
    result_.names[thing.name] = add_instance(*category);
  } else if (thing.kind != ThingKind::region) {
    result_.remarks.push_back("`" + thing.name + "` is left out: the mapping has no synset for `" + thing.class_name +
                              "`");
  }
}

std::string BddlNaming::add_instance(const std::string& category) {
  std::size_t count = 1;
  for (const BddlGroup& group : result_.problem.objects) {
    if (group.category == category) count += group.names.size();
  }
  const std::string name = category + "_" + std::to_string(count);
  add(result_.problem.objects, category, name);
  return name;
}

const std::string& BddlNaming::theirs(const std::string& ours) const {
  const auto found = result_.names.find(ours);
  if (found != result_.names.end()) return found->second;
  const BddlThing* one = thing(ours);
  const std::string dialect(to_string(mapping_.dialect));
  if (one == nullptr) throw Refusal{"`" + ours + "` is not in the scene"};
  if (one->kind == ThingKind::hand)
    throw Refusal{"`" + ours + "`: " + dialect + " has no word for a hand; leave it out of the goal"};
  if (one->kind == ThingKind::region && mapping_.dialect == BddlDialect::behavior) {
    throw Refusal{"`" + ours + "`: BEHAVIOR has no regions; name the body"};
  }
  throw Refusal{"`" + ours + "` has no name there; add a category for the class `" +
                (one->owner.empty() || thing(one->owner) == nullptr ? one->class_name : thing(one->owner)->class_name) +
                "` to the mapping"};
}

void BddlNaming::remark(const std::string& text) {
  auto& remarks = result_.remarks;
  if (std::find(remarks.begin(), remarks.end(), text) == remarks.end()) remarks.push_back(text);
}

void BddlNaming::add_region(const BddlRegion& region) {
  for (const BddlRegion& other : result_.problem.regions) {
    if (other.key() == region.key()) return;
  }
  result_.problem.regions.push_back(region);
}

void BddlNaming::declare(const std::string& ours) {
  const auto site = sites_.find(ours);
  if (site == sites_.end()) return;
  const BddlRegion& region = site->second;
  const bool known = std::any_of(mapping_.sites.begin(), mapping_.sites.end(),
                                 [&](const BddlPair& pair) { return region.name == pair.theirs; });
  if (!known && region.ranges.empty()) {
    remark("`" + region.key() + "`: their model of `" + region.target + "` must have a site of that name");
  }
  add_region(region);
}

std::string BddlNaming::surface(const BddlThing& fixture) {
  const std::string key = fixture.name + " surface";  // a blank: no name of ours
  if (sites_.count(key) == 0) {
    BddlRegion region{"top_surface", theirs(fixture.name), fixture.area, {0, 0}, {0, 0, 1, 0}};
    for (int i = 2; !taken_.insert(region.key()).second; ++i) region.name = "top_surface_" + std::to_string(i);
    sites_[key] = region;
    surfaces_.insert(region.key());
  }
  add_region(sites_[key]);
  return sites_[key].key();
}

bool BddlNaming::is_surface(const std::string& theirs) const {
  if (surfaces_.count(theirs) > 0) return true;
  return std::any_of(result_.problem.fixtures.begin(), result_.problem.fixtures.end(), [&](const BddlGroup& group) {
    return std::find(group.names.begin(), group.names.end(), theirs) != group.names.end();
  });
}

std::string BddlNaming::spot(const BddlPlacement& placement) {
  BddlRegion region{theirs(placement.object) + "_init_region",
                    theirs(placement.on),
                    placement.ranges,
                    placement.yaw_rad,
                    {0, 0, 1, 0}};
  for (int i = 2; !taken_.insert(region.key()).second; ++i) {
    region.name = theirs(placement.object) + "_init_region_" + std::to_string(i);
  }
  add_region(region);
  return region.key();
}

}  // namespace stampede::symbolic
