#include "scripting/library/library.h"

#include <algorithm>

#include "engine/base/hash.h"
#include "scripting/library/builder.h"

namespace stampede {
namespace {

std::string all_texts(const std::vector<Error>& errors) {
  std::string text;
  for (const Error& error : errors) text += (text.empty() ? "" : "\n") + std::string(error.what());
  return text;
}

// Its place is the file, or a line of it.
bool is_about(const Error& error, const ScriptFile& file) {
  return error.where().starts_with(file.shown_path) &&
         (error.where().size() == file.shown_path.size() || error.where()[file.shown_path.size()] == ':');
}

}  // namespace

LibraryError::LibraryError(std::vector<Error> errors) : Error({}, all_texts(errors)), errors_(std::move(errors)) {}

std::shared_ptr<const Library> Library::load(const Roots& roots) {
  std::vector<Error> complaints;
  std::shared_ptr<const Library> library = load(roots, complaints);
  if (!complaints.empty()) throw LibraryError(std::move(complaints));
  return library;
}

std::shared_ptr<const Library> Library::load(const Roots& roots, std::vector<Error>& complaints) {
  return LibraryBuilder(roots, complaints).build();
}

std::shared_ptr<const Library> Library::load_usable(const Roots& roots) {
  std::vector<Error> complaints;
  const std::shared_ptr<Library> library = LibraryBuilder(roots, complaints).build();
  const auto own = [&](const Error& error) {  // of a file that a task may do without
    for (const ScriptFile& file : library->files_) {
      const bool shared = file.kind == DefinitionKind::skill || file.kind == DefinitionKind::predicate ||
                          file.kind == DefinitionKind::types || file.kind == DefinitionKind::colours ||
                          file.kind == DefinitionKind::module;
      if (!shared && is_about(error, file)) return true;
    }
    return false;
  };
  if (!std::all_of(complaints.begin(), complaints.end(), own)) throw LibraryError(std::move(complaints));
  library->complaints_ = std::move(complaints);
  return library;
}

void Library::require_sound(const std::vector<const ScriptFile*>& files) const {
  std::vector<Error> found;
  for (const Error& error : complaints_) {
    const auto about = [&](const ScriptFile* file) { return is_about(error, *file); };
    if (std::any_of(files.begin(), files.end(), about)) found.push_back(error);
  }
  if (!found.empty()) throw LibraryError(std::move(found));
}

const ScriptFile* Library::file(DefinitionKind kind, std::string_view name) const {
  for (const ScriptFile& file : files_) {
    if (file.kind == kind && file.name == name) return &file;
  }
  return nullptr;
}

std::vector<const ScriptFile*> Library::files(DefinitionKind kind) const {
  std::vector<const ScriptFile*> result;
  for (const ScriptFile& file : files_) {
    if (file.kind == kind) result.push_back(&file);
  }
  return result;
}

std::vector<const ScriptFile*> Library::all_files() const {
  std::vector<const ScriptFile*> result;
  for (const ScriptFile& file : files_) result.push_back(&file);
  return result;
}

const ScriptFile* Library::module(std::string_view require_name) const {
  std::string path(require_name);
  std::replace(path.begin(), path.end(), '.', '/');
  path += ".lua";
  for (const ScriptFile& file : files_) {
    if (file.shown_path == path) return &file;
  }
  return nullptr;
}

const SkillInfo* Library::skill(std::string_view name) const {
  const auto found = skills_.find(name);
  return found == skills_.end() ? nullptr : &found->second;
}

const Library::TaskInfo* Library::task(std::string_view name) const {
  const auto found = tasks_.find(name);
  return found == tasks_.end() ? nullptr : &found->second;
}

const Domain& Library::domain_of(std::string_view name) const {
  const TaskInfo* info = task(name);
  const auto found = info == nullptr ? domains_.end() : domains_.find(info->skills);
  return found == domains_.end() ? domain_ : found->second;
}

std::string Library::hash() const {
  Hasher hasher;
  for (const ScriptFile& file : files_) hasher.text(file.shown_path).text(file.source);
  return hasher.digest();
}

}  // namespace stampede
