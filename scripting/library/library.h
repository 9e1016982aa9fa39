// All Lua files of a set of roots: found, compiled, checked, and turned into vocabulary that C++ understands.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "engine/base/error.h"
#include "engine/language/english.h"
#include "engine/start/declared.h"
#include "scripting/library/numbers.h"

struct lua_State;

namespace stampede {

enum class DefinitionKind { task, skill, predicate, object, world, robot, types, colours, words, module };
std::string_view to_string(DefinitionKind kind);
std::optional<DefinitionKind> definition_kind_from(std::string_view name);
// Every task's domain is made of these: each episode of a library is.
bool is_shared(DefinitionKind kind);
// Of another language: only tasks that were imported from one are made of it.
bool is_foreign(std::string_view shown_path);

// The smallest file of a kind that passes `check` beside our worlds and predicates (for `stampede new`).
// Throws Error for a bad name, with a sound one as cure.
std::string new_file(DefinitionKind kind, std::string_view name);

struct ScriptFile {
  DefinitionKind kind = DefinitionKind::task;
  std::string name;  // the file's name without .lua
  std::filesystem::path path;
  std::string shown_path;   // relative to its root, for messages and catalogues
  std::string description;  // its first comment line
  std::string source, bytecode, hash;
  bool replaces = false;  // a file of an earlier root
  std::size_t root = 0;   // its place in Roots::folders
};

// Its place is the file, or a line of it.
bool is_about(const Error& error, const ScriptFile& file);

// Every complaint of a file set at once, sorted by file and line.
class LibraryError : public Error {
 public:
  explicit LibraryError(std::vector<Error> errors);
  const std::vector<Error>& errors() const { return errors_; }

 private:
  std::vector<Error> errors_;
};

// A script that does not come from a folder: what a lock holds.
struct GivenScript {
  DefinitionKind kind = DefinitionKind::task;
  std::string name, shown_path, source;
};

// Later roots win over earlier ones, file by file: `--root` first, then each `--path`.
struct Roots {
  std::vector<std::filesystem::path> folders;
  // Where there are some, they go before those of the folders, and of what every task is made of (skills, predicates,
  // types, colours, modules) there are no others. What they read beside them (meshes, robot descriptions) is where a
  // folder has it.
  std::vector<GivenScript> given = {};
};

// Immutable after load and shared by all workers.
class Library {
 public:
  // Files with mistakes are left out, and what is said of them is only thrown at those who use them: see require_sound.
  // What every task shares must be right: types, colours and words, or LibraryError says all that is wrong there. Of
  // tasks only those named are read, where some are: all others are as unknown as their mistakes. Of each task's
  // variations a few are tried; a run says what is wrong with those that it meets.
  static std::shared_ptr<const Library> load(const Roots& roots, const std::vector<std::string>& tasks = {});
  // All complaints, and what can be read; of each task, or of these alone, up to 240 variations are tried.
  static std::shared_ptr<const Library> check(const Roots& roots, std::vector<Error>& complaints,
                                              const std::vector<std::string>& tasks = {});
  // What can be read, whatever mistakes there are: for those who ask for words of it.
  static std::shared_ptr<const Library> load_words(const Roots& roots);
  // About these files and what they use: of the rounds in which files were left out, those of the first that has any.
  std::vector<Error> complaints_about(const std::vector<const ScriptFile*>& files) const;
  // Throws LibraryError with these, if there are any.
  void require_sound(const std::vector<const ScriptFile*>& files) const;
  // These files and those that they name, and so on: objects, worlds, robots, predicates, skills, modules. Of a task
  // without steps also skills that were left out and that alone could make true what the task speaks of, or that stand
  // in the place of an earlier root's.
  std::vector<const ScriptFile*> used_by(const std::vector<const ScriptFile*>& files) const;
  const std::vector<ScriptFile>& left_out() const { return left_out_; }

  const Roots& roots() const { return roots_; }
  const ScriptFile* file(DefinitionKind kind, std::string_view name) const;
  std::vector<const ScriptFile*> files(DefinitionKind kind) const;  // by name
  std::vector<const ScriptFile*> all_files() const;                 // by kind, then name
  const ScriptFile* module(std::string_view require_name) const;    // what require "name" finds inside the roots

  // The vocabulary: types, traits, predicates, actions of all skills. One domain for all worlds of a library;
  // an action's name is its skill, or skill_case. The hand is an object of type `hand`; predicates and actions that
  // name it have it as a parameter like any other (`hand_empty(hand)`, `holding(hand, obj)`).
  // Skills that replace others are in the domains of those tasks only that ask for them.
  const Domain& domain() const { return vocabulary_.domain; }
  const Domain& domain_of(std::string_view task) const;
  const std::map<std::string, PredicateTraits>& predicate_traits() const { return vocabulary_.predicate_traits; }
  bool can_hide(const std::string& predicate) const { return vocabulary_.hiding.contains(predicate); }
  const SkillInfo* skill(std::string_view name) const;
  const std::shared_ptr<const English>& english() const { return vocabulary_.english; }
  const Numbers& numbers() const { return vocabulary_.numbers; }
  const std::vector<Error>& remarks() const { return remarks_; }  // on what is no mistake, and perhaps not meant

  struct TaskInfo {
    std::string name, world, description;
    std::string hand;                                            // the world's hand: `panda.hand`
    std::vector<std::map<std::string, std::string>> variations;  // axis -> value as text, in the file's order
    std::vector<std::string> variation_texts;                    // canonical: `colour=red,height=3`; `` for none
    std::vector<std::string> instructions;
    std::vector<std::string> skills;  // that replace others here, by name
    std::set<std::string> hiding;     // predicates of which it says what can be seen
    bool is_imported = false;         // from a problem in another language, which it holds
  };
  const TaskInfo* task(std::string_view name) const;
  std::string hash() const;  // of all files: part of every episode's key

 private:
  friend class LibraryDraft;
  struct Vocabulary {
    Domain domain;
    std::map<std::vector<std::string>, Domain> domains;  // by TaskInfo::skills, where there are some
    std::map<std::string, PredicateTraits> predicate_traits;
    std::set<std::string> hiding;            // predicates whose files say `observable`
    std::shared_ptr<const English> english;  // with nouns of types and objects, and verbs of skills
    Numbers numbers;                         // that things can have, as files declare them
    std::map<std::string, SkillInfo, std::less<>> skills;
    std::map<std::string, TaskInfo, std::less<>> tasks;
  };

  Roots roots_;
  std::vector<ScriptFile> files_;
  std::vector<ScriptFile> left_out_;            // have mistakes
  std::vector<std::vector<Error>> complaints_;  // about them and about tasks; first causes, then what comes of them
  std::vector<Error> remarks_;
  Vocabulary vocabulary_;
};

}  // namespace stampede
