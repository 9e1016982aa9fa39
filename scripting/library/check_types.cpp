// worlds/types.lua of each root, and what objects declare for themselves: types = { cube = { parent = "block" } } or
// { cube = "block" }; traits by name or as a list.
#include <algorithm>

#include "engine/base/naming.h"
#include "scripting/library/checks.h"

namespace stampede {
namespace {

class TypeReader {
 public:
  explicit TypeReader(LibraryDraft& draft) : draft_(draft), domain_(draft.vocabulary().domain) {}

  void read() {
    domain_.types = {{"hand", kRootType}, {"region", kRootType}};
    for (const ScriptFile* file : draft_.library()->files(DefinitionKind::types)) {
      if (file->bytecode.empty()) continue;
      if (const Definition* read = draft_.read_type_file(*file)) declare(*read, "", read->node);
    }
    for (const auto& [name, definition] : draft_.of(DefinitionKind::object))
      if (const Value& declared = definition.node["declares"]; declared.is_table())
        declare(definition, "declares.", declared);
    check_parents();
    check_cycles();
    for (const std::string& name : domain_.traits)
      if (domain_.types.contains(name))
        complain_of("trait " + name, "'" + name + "' is a type too", "call the trait " + proposed_name(name, {name}));
  }

 private:
  void declare(const Definition& definition, const std::string& prefix, const Value& node) {
    for (const auto& [name, entry] : node["types"].fields) {
      const std::string path = prefix + "types." + name;
      const Value& parent = entry.is_table() ? entry["parent"] : entry;
      domain_.types[name] = parent.is_text() ? parent.text : kRootType;
      origins_[name] = {&definition, path};
      for (const auto& [key, value] : entry.fields)
        if (key != "parent" && key != "nouns")
          definition.complain(path + "." + key, "a type has no field '" + key + "'",
                              name + " = { parent = \"thing\", nouns = \"what else it is called\" }");
      check_name(name, path, definition.complainer(), "type name");
    }
    declare_traits(definition, prefix + "traits.", node["traits"]);
    for (const auto& [key, value] : node.fields)
      if (key != "types" && key != "traits" && key != "numbers")
        definition.complain(prefix + key, "there is no field '" + key + "' beside types, traits and numbers",
                            did_you_mean(key, {"types", "traits", "numbers"}));
  }

  void declare_traits(const Definition& definition, const std::string& prefix, const Value& traits) {
    std::vector<std::string> names = texts_of(traits);
    for (const auto& [name, entry] : traits.fields) {
      names.push_back(name);
      for (const auto& [key, value] : entry.fields)
        if (key != "numbers")
          definition.complain(prefix + name + "." + key, "a trait has no field '" + key + "'",
                              name + " = { \"what can be done with it\", numbers = { … } }");
    }
    for (const std::string& name : names) {
      const auto place = std::lower_bound(domain_.traits.begin(), domain_.traits.end(), name);
      if (place == domain_.traits.end() || *place != name) domain_.traits.insert(place, name);
      origins_["trait " + name] = {&definition, prefix + name};
      check_name(name, prefix + name, definition.complainer(), "trait name");
    }
  }

  void check_parents() {
    const std::vector<std::string> known = keys_of(domain_.types);
    for (auto& [name, parent] : domain_.types) {
      if (parent == kRootType || domain_.types.contains(parent)) continue;
      complain_of(name, "its parent '" + parent + "' is not a type", did_you_mean(parent, known));
      parent = kRootType;
    }
  }

  void check_cycles() {
    for (auto& [name, parent] : domain_.types) {
      std::string chain = name, at = name;
      for (std::size_t step = 0; at != kRootType && step <= domain_.types.size(); ++step) {
        at = domain_.types.at(at);
        chain += " < " + at;
        if (at != name) continue;
        complain_of(name, "a cycle of types: " + chain, "every type ends at object");
        parent = kRootType;
        break;
      }
    }
  }

  void complain_of(const std::string& name, const std::string& what, const std::string& hint) const {
    if (const auto found = origins_.find(name); found != origins_.end())
      found->second.first->complain(found->second.second, what, hint);
  }

  LibraryDraft& draft_;
  Domain& domain_;
  std::map<std::string, std::pair<const Definition*, std::string>> origins_;  // file and field
};

}  // namespace

void read_types(LibraryDraft& draft) { TypeReader(draft).read(); }

}  // namespace stampede
