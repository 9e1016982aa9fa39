// A library in the making: what all parts that make it share. Room-internal.
#pragma once

#include <functional>
#include <list>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "engine/geometry/value.h"
#include "scripting/library/definitions.h"
#include "scripting/library/fields.h"
#include "scripting/library/formula_reader.h"
#include "scripting/library/library.h"
#include "scripting/library/name_lists.h"

namespace stampede {

constexpr SandboxLimits kCheckLimits{5'000'000, 32u << 20};  // a definition that needs more is a runaway

// Finds and compiles the Lua files of all roots; a later root's file replaces an earlier one's of the same path.
std::vector<ScriptFile> find_files(const Roots& roots, std::vector<Error>& complaints);

// `tasks/stack.lua:12`
std::string place_in(const ScriptFile& file, int line);

// In the order in which they are found, each once.
class Complaints {
 public:
  explicit Complaints(std::vector<Error>& found) : found_(found) {}
  void add(const Error& error);
  std::size_t count() const { return found_.size(); }
  void sort();  // by file and line

  // Runs `work`; what it throws becomes a complaint. Has it come to its end?
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

 private:
  std::vector<Error>& found_;
};

// What a file returns, as it is written, and what is wrong with it.
struct Definition {
  const ScriptFile* file = nullptr;
  Value node;
  std::map<std::string, int> lines;  // of its fields
  Complaints* complaints = nullptr;

  std::string place(const std::string& path) const;  // of a field (`objects.block.count`), or of the table around it
  Error error(const std::string& path, const std::string& what, const std::string& hint) const;
  void complain(const std::string& path, const std::string& what, const std::string& hint = {}) const;
  // There is no such thing of this name; perhaps one of those that are known is meant.
  void complain_unknown(const std::string& path, const std::string& what, const std::string& name,
                        const std::vector<std::string>& known) const;
  // Where this is a text, one of those that are known.
  void require_known(const std::string& path, const std::string& what, const Value& text,
                     const std::vector<std::string>& known) const;
  Complain complainer() const;
  std::vector<std::string> parameter_names() const;  // of `params`, as they are written
};
using Definitions = std::map<std::string, Definition>;  // of one kind, by name

class LibraryDraft {
 public:
  // Finds the files; those `left_out` are as if they were not there.
  LibraryDraft(const Roots& roots, std::vector<Error>& complaints, const std::vector<ScriptFile>& left_out);
  LibraryDraft(const LibraryDraft&) = delete;
  LibraryDraft& operator=(const LibraryDraft&) = delete;

  const std::shared_ptr<Library>& library() const { return library_; }
  auto& vocabulary() { return library_->vocabulary_; }
  const std::vector<ScriptFile>& files() const { return library_->files_; }
  Complaints& complaints() { return complaints_; }
  NumberTable& numbers() { return numbers_; }
  void remark(const Error& remark);  // on what is no mistake; each once

  // Runs each file but modules and types; of tasks these, or all where none is named.
  void read_definitions(const std::vector<std::string>& tasks);
  const Definitions& of(DefinitionKind kind) const;
  const Definition* find(DefinitionKind kind, const std::string& name) const;  // nullptr: none that could be read
  // Runs worlds/types.lua of one root; nullptr: it has failed.
  const Definition* read_type_file(const ScriptFile& file);
  const std::list<Definition>& type_files() const { return type_files_; }

  // For the file that is read next: nothing is left in it of those before. The last one given is then no longer used.
  DefinitionState& fresh_state();

  // Complaints of `work` that have no place in a file are said to be of this one.
  void guarded_in(const ScriptFile& file, const std::function<void()>& work);
  // Of a formula in this field.
  FormulaContext context(const Definition& definition, const std::string& field) const;
  FormulaContext schema(const Definition& definition, const std::string& field,
                        const std::vector<Parameter>& parameters) const;

 private:
  Error placed_in(const ScriptFile& file, const Error& error) const;
  std::optional<std::string> part_fault(const std::string& name) const;

  std::shared_ptr<Library> library_;
  Complaints complaints_;
  std::map<DefinitionKind, Definitions> definitions_;
  std::list<Definition> type_files_;
  std::unique_ptr<DefinitionState> state_;
  NumberTable numbers_;
};

}  // namespace stampede
