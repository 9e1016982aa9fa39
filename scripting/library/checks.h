// The parts that make a library, in the order in which they run. Each has one duty, adds to the draft what it reads and
// complains of what is wrong there. Room-internal.
#pragma once

#include <string>
#include <vector>

#include "scripting/library/builder.h"
#include "scripting/library/draft.h"

namespace stampede {

constexpr const char* kRootType = "object";  // every type ends there

void read_types(LibraryDraft& draft);  // those that objects declare for themselves too
void declare_numbers(LibraryDraft& draft);
void declare_predicates(LibraryDraft& draft);  // names and parameters; attributes as well
void define_predicates(LibraryDraft& draft);   // traits, derived formulas
void check_objects(LibraryDraft& draft);
void check_worlds(LibraryDraft& draft);
void read_skills(LibraryDraft& draft);
void check_rivals(LibraryDraft& draft);  // skills that could take another's place in any plan: remarks
void read_words(LibraryDraft& draft);    // with nouns of types and objects, and verbs of skills
void read_tasks(LibraryDraft& draft, const BuilderOptions& options);
void check_scripts(LibraryDraft& draft);
void make_domains(LibraryDraft& draft);  // chosen_skills.cpp: one for each choice of skills

// What several of them are made of.
// check_body.cpp: of an object, a part, a region, an entry.
void check_body(LibraryDraft& draft, const Definition& definition, const Value& body, const std::string& path);
void check_tip(const Definition& definition, const Value& node, const std::string& path);
// { "cube", colour = "red" }, of an object or a robot.
void check_entry(LibraryDraft& draft, const Definition& definition, const Value& entry, const std::string& path,
                 DefinitionKind kind);
// Files that an object names.
void check_assets(const Definition& definition, const Roots& roots);
// check_observe.cpp: what a world observes, or a task in that world; the size of a picture.
void check_observe(const Definition& definition, const Value& world);
void check_size(const Definition& definition, const Value& size, const std::string& path);
// check_parameters.cpp: `params` of a predicate or skill, and what its label names of them.
std::vector<Parameter> parameters_of(LibraryDraft& draft, const Definition& definition);
void check_label(const Definition& definition, const std::vector<Parameter>& parameters);
// Continuous parameters of a skill, into `info`.
void read_continuous(LibraryDraft& draft, const Definition& skill, SkillInfo& info);
// Skills that replace others in a task of this world, sorted.
std::vector<std::string> chosen_skills(LibraryDraft& draft, const Definition& task, const std::string& world);

}  // namespace stampede
