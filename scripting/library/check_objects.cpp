// Objects: what each needs, its parts and regions, what its shapes show, how its joints hang together.
#include <algorithm>

#include "scripting/library/checks.h"
#include "scripting/library/scene_outline.h"

namespace stampede {
namespace {

class ObjectCheck {
 public:
  ObjectCheck(LibraryDraft& draft, const Definition& definition)
      : draft_(draft), definition_(definition), node_(definition.node), parts_(node_["parts"]) {}

  void check() {
    check_thing(node_, {});
    check_shows(node_);
    check_tip(definition_, node_, {});
    check_assets(definition_, draft_.library()->roots());
    if (!node_["region"].present() && !node_["type"].is_text())
      definition_.complain({}, "an object needs the field 'type'", "one of worlds/types.lua");
    const auto fields = {"shape", "shapes", "urdf", "region"};
    if (std::none_of(fields.begin(), fields.end(), [&](const char* field) { return node_[field].present(); }))
      definition_.complain({}, "an object needs shapes, a region or a urdf", "shape = box { 0.04, 0.04, 0.04 }");
    for (const auto& [name, part] : parts_.fields) check_part(name, part);
    for (const auto& [name, region] : node_["regions"].fields) check_thing(region, "regions." + name);
  }

 private:
  void check_thing(const Value& thing, const std::string& path) {
    check_body(draft_, definition_, thing, path);
    draft_.numbers().check_needed(texts_of(thing["traits"]), keys_of(thing["numbers"].fields), path,
                                  definition_.complainer());
  }

  void check_part(const std::string& name, const Value& part) {
    const std::string path = "parts." + name;
    const bool from_urdf = node_["urdf"].present();
    check_thing(part, path);
    check_shows(part);
    int joints = part["fixed"].present();
    for (const char* kind : kMovingJoints) joints += part[kind].present();
    if (joints != 1 && !from_urdf) definition_.complain(path, "a part needs one of slider, hinge, screw and fixed");
    const Value& parent = part["parent"];
    if (parent.is_text() && !parts_[parent.text].present() && !from_urdf)
      definition_.complain_unknown(path + ".parent", "part", parent.text, keys_of(parts_.fields));
    check_links(name);
    for (const auto& [region_name, region] : part["regions"].fields)
      check_thing(region, path + ".regions." + region_name);
  }

  void check_shows(const Value& body) {
    for (const char* list : {"shapes", "visual"})
      for (const Value& shape : body[list].items)
        if (shape["shows"].present()) check_shown(shape["shows"], shape.line());
  }

  // A shape is shown by one fact of one thing of its object.
  void check_shown(const Value& shows, int line_of_shape) {
    const std::string place = place_in(*definition_.file, shows.line() > 0 ? shows.line() : line_of_shape);
    const auto say = [&](const std::string& what, const std::string& hint) {
      draft_.complaints().add(Error(place, "shows: " + what, hint));
    };
    const std::string example = "such as is.pressed(\"button\") or is_not.open(\"self\")";
    if (shows.tag() != "literal")
      return say("what a shape is shown by is one fact, this is " + shows.type_name(), example);
    const std::string& name = shows["predicate"].text;
    const Domain& domain = draft_.vocabulary().domain;
    const Predicate* predicate = domain.predicate(name);
    if (predicate == nullptr)
      return say("there is no predicate '" + name + "'", did_you_mean(name, names_of(domain.predicates)));
    if (predicate->parameters.size() != 1 || shows.items.size() != 1)
      return say("'" + name + "' is no fact of one thing", example);
    std::vector<std::string> known = things_in(node_);
    known.emplace_back("self");
    const std::string& thing = shows.items[0].text;
    if (!listed(known, thing)) say("the object has no part or region '" + thing + "'", did_you_mean(thing, known));
  }

  const Value& joint_of(const std::string& part) const {
    for (const char* kind : kMovingJoints)
      if (const Value& joint = parts_[part][kind]; joint.present()) return joint;
    return parts_[part]["hinge"];
  }

  // Latches and couplings name other moving parts, and couplings come to an end.
  void check_links(const std::string& name) {
    std::string path = "parts." + name;
    for (const char* kind : kMovingJoints)
      if (parts_[name][kind].present()) path += std::string(".") + kind;
    std::vector<std::string> moving;
    for (const auto& [other, unused] : parts_.fields)
      if (other != name && joint_of(other).present()) moving.push_back(other);
    for (const auto& [field, word] : {std::pair{"latch", "key"}, std::pair{"follows", "part"}}) {
      const Value& target = joint_of(name)[field][word];
      if (!target.is_text() || listed(moving, target.text)) continue;
      if (target.text == name)
        definition_.complain(path + "." + field, "it names its own part", "name another moving part");
      else
        definition_.complain(path + "." + field, "there is no other part '" + target.text + "' that moves",
                             did_you_mean(target.text, moving));
    }
    std::string chain = name, at = name;
    for (std::size_t step = 0; step <= parts_.fields.size(); ++step) {
      const Value& next = joint_of(at)["follows"]["part"];
      if (!next.is_text() || next.text == at) return;
      at = next.text;
      chain += " -> " + at;
      if (at == name)
        return definition_.complain(path + ".follows", "couplings in a circle: " + chain,
                                    "one of them moves by itself");
    }
  }

  LibraryDraft& draft_;
  const Definition& definition_;
  const Value &node_, &parts_;
};

}  // namespace

void check_objects(LibraryDraft& draft) {
  for (const auto& [name, definition] : draft.of(DefinitionKind::object)) ObjectCheck(draft, definition).check();
}

}  // namespace stampede
