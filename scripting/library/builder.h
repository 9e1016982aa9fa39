// Makes a Library: runs every file once, checks everything that can be checked without physics, collects complaints.
#pragma once

#include <functional>
#include <list>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "scripting/library/definitions.h"
#include "scripting/library/fields.h"
#include "scripting/library/formula_reader.h"
#include "scripting/library/library.h"
#include "scripting/library/value.h"

namespace stampede {

// Finds and compiles the Lua files of all roots; a later root's file replaces an earlier one's of the same path.
std::vector<ScriptFile> find_files(const Roots& roots, std::vector<Error>& complaints);

struct Definition {
  const ScriptFile* file = nullptr;
  Value node;
  std::map<std::string, int> lines;
};

// One thing that a task's scene will have, as far as files tell.
struct SceneObject {
  std::string type;
  std::vector<std::string> traits;
  bool free = false;        // must be placed
  bool positioned = false;  // its entry says where it is
  bool known = true;        // its file has been read
};
using SceneObjects = std::map<std::string, SceneObject>;

// Of which tasks many variations are tried, not a few.
enum class Thorough { none, named, all };

struct BuilderOptions {
  Thorough thorough = Thorough::none;
  std::vector<std::string> named = {};
  std::vector<ScriptFile> left_out = {};  // files that are read as if they were not there
};

class LibraryBuilder {
 public:
  LibraryBuilder(const Roots& roots, std::vector<Error>& complaints, BuilderOptions options);
  std::shared_ptr<Library> build();

 private:
  using Definitions = std::map<std::string, Definition>;

  // builder.cpp
  void read_definitions();
  void check_names();
  void finish();
  std::optional<std::string> part_fault(const std::string& name) const;
  Definitions& of(DefinitionKind kind) { return definitions_[kind]; }
  Error error_at(const Definition& definition, const std::string& path, const std::string& what,
                 const std::string& hint) const;
  void complain(const Definition& definition, const std::string& path, const std::string& what,
                const std::string& hint = {});
  Complain complainer(const Definition& definition);
  FormulaContext context(const Definition& definition, const std::string& field) const;
  // Runs `work`; what it throws becomes a complaint.
  template <typename Work>
  bool guarded(const Work& work) {
    try {
      work();
      return true;
    } catch (const Error& error) {
      add(error);
      return false;
    }
  }
  // As guarded; what has no place of a file's is said to be of this one.
  template <typename Work>
  void guarded_in(const ScriptFile& file, const Work& work) {
    try {
      work();
    } catch (const Error& error) {
      add(placed_in(file, error));
    }
  }
  Error placed_in(const ScriptFile& file, const Error& error) const;
  void add(const Error& error);

  // check_predicates.cpp
  void read_types();
  using TypeOrigins = std::map<std::string, std::pair<const Definition*, std::string>>;  // file and field
  void declare_types(const Definition& definition, const std::string& prefix, const Value& node, TypeOrigins& origins);
  void check_type_tree(const TypeOrigins& origins);
  void declare_predicates();  // names and parameters
  void define_predicates();   // traits, derived formulas
  void read_exclusions(const Definition& definition, const Predicate& predicate, PredicateTraits& traits);
  void check_strata();
  void declare_attributes();
  std::vector<Parameter> parameters_of(const Definition& definition, bool add_hand);
  void check_label(const Definition& definition, const std::string& label, const std::vector<Parameter>& parameters);

  // check_numbers.cpp
  void declare_numbers();
  void each_declaration(const std::function<void(const Definition&, const std::string& path, const std::string& name,
                                                 const Value& number, const std::string& trait)>& visit);
  void check_entry_numbers(const Definition& definition, const Value& entry, const Value& node,
                           const std::string& path);  // check_objects.cpp
  void check_reads(const std::set<std::string>& had);

  // check_scripts.cpp
  void check_scripts();
  void check_run(const Definition& definition);

  // check_skills.cpp
  void read_skills();
  void read_skill(const Definition& definition);
  void read_action(const Definition& definition, const SkillInfo& info, const Value& fields,
                   const std::string& case_name);
  void read_replaced(const Definition& definition, SkillInfo& info);
  void end_moved(const Definition& definition, const SkillInfo& info);
  std::vector<std::string> chosen_skills(const Definition& task, const std::string& world);
  void make_domains();
  void read_continuous(const Definition& definition, SkillInfo& info);
  void read_stream(const Definition& definition, const std::string& path, const SkillInfo& info, ContinuousInfo& one);
  void read_value(const Definition& definition, const std::string& path, const Value& node, ContinuousInfo& one);

  // check_objects.cpp
  void check_objects();
  void check_start(const Definition& definition, const Value& joints, const Value& arm, const std::string& path);
  void check_entry(const Definition& definition, const Value& entry, const std::string& path, const char* what);
  void add_object(SceneObjects& objects, const std::string& name, const Value& entry) const;
  SceneObjects world_objects(const std::string& world) const;
  void check_body(const Definition& definition, const Value& body, const std::string& path);
  void check_sizes(const Definition& definition, const Value& body, const std::string& path);
  void check_thread(const Definition& definition, const Value& joint, const std::string& where);
  void check_tip(const Definition& definition, const Value& node, const std::string& path);
  void check_shows(const Definition& definition, const Value& body);
  void check_links(const Definition& definition, const Value& parts, const std::string& name);
  std::string hand_of(const std::string& world) const;

  // check_assets.cpp
  void check_assets(const Definition& definition);

  // check_worlds.cpp
  void check_worlds();
  void check_rates(const Definition& definition);
  void check_motion(const Definition& definition);
  void check_sensors(const Definition& definition);
  void check_camera(const Definition& definition, const Value& camera, const std::string& path,
                    const SceneObjects& objects);
  void check_light(const Definition& definition);
  void check_randomise(const Definition& definition, const SceneObjects& objects);
  void check_observe(const Definition& definition, const Value& world);
  void check_one_of(const Definition& definition, const std::string& path, const Value& text, const char* what,
                    const std::vector<std::string>& known);

  // check_tasks.cpp, variations.cpp
  void read_tasks();
  // How many variations of a task are tried: the first, and others at equal distances.
  std::size_t most_variations(const std::string& task) const;
  void read_task(const Definition& definition);
  std::vector<Value> variations_of(const Definition& definition, DefinitionState& state);
  void check_variation(const Definition& definition, DefinitionState& state, const Value& variation,
                       const std::string& text);
  Value field_for(const Definition& definition, DefinitionState& state, const char* field, const Value& variation);
  class TaskFormulas;  // task_formulas.h
  void check_stands(const Definition& definition, const Value& entry, const SceneObject& object,
                    const std::string& path);
  void check_instructions(const Definition& definition, const Value& texts, const Value& variation);
  void check_slots(const Definition& definition, const char* field, const std::string& text, const Value& variation);

  BuilderOptions options_;
  std::vector<Error>& complaints_;
  std::shared_ptr<Library> library_;
  std::map<DefinitionKind, Definitions> definitions_;
  std::set<std::string> attributes_;
  std::list<Definition> type_files_;  // worlds/types.lua of each root
  NumberTable numbers_;
};

void push_node(lua_State* state, const Value& node);
bool listed(const std::vector<std::string>& names, std::string_view name);
std::vector<std::string> parameter_names(const Value& definition);  // of `params`, as they are written
std::string variation_text(const Value& variation);                 // `colour=red,height=3`

}  // namespace stampede
