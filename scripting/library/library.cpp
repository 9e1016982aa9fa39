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

}  // namespace

bool is_about(const Error& error, const ScriptFile& file) {
  return error.where().starts_with(file.shown_path) &&
         (error.where().size() == file.shown_path.size() || error.where()[file.shown_path.size()] == ':');
}

LibraryError::LibraryError(std::vector<Error> errors) : Error({}, all_texts(errors)), errors_(std::move(errors)) {}

std::shared_ptr<const Library> Library::check(const Roots& roots, std::vector<Error>& complaints,
                                              const std::vector<std::string>& tasks) {
  return build_library(roots, complaints,
                       {.thorough = tasks.empty() ? Thorough::all : Thorough::named, .named = tasks});
}

std::shared_ptr<const Library> Library::load_words(const Roots& roots) {
  std::vector<Error> untold;
  return build_library(roots, untold, {});
}

namespace {

bool is_shared(const ScriptFile& file) {
  return file.kind == DefinitionKind::types || file.kind == DefinitionKind::colours ||
         file.kind == DefinitionKind::words;
}

}  // namespace

// Reads again without what has mistakes, until what is left has none but in tasks: each round finds who needed what the
// rounds before left out.
std::shared_ptr<const Library> Library::load(const Roots& roots, const std::vector<std::string>& tasks) {
  std::vector<ScriptFile> left_out;
  std::vector<std::vector<Error>> rounds;
  for (;;) {
    std::vector<Error> complaints;
    const std::shared_ptr<Library> library = build_library(roots, complaints, {.read = tasks, .left_out = left_out});
    const std::size_t before = left_out.size();
    std::vector<Error> shared;
    for (const Error& error : complaints) {
      const auto& files = library->files_;
      const auto file = std::find_if(files.begin(), files.end(), [&](const auto& one) { return is_about(error, one); });
      if (file == files.end() || is_shared(*file)) {
        shared.push_back(error);
      } else if (file->kind != DefinitionKind::task &&
                 std::none_of(left_out.begin(), left_out.end(),
                              [&](const ScriptFile& one) { return one.shown_path == file->shown_path; })) {
        left_out.push_back(*file);
      }
    }
    if (!shared.empty()) throw LibraryError(std::move(shared));
    rounds.push_back(std::move(complaints));
    if (left_out.size() > before) continue;
    library->left_out_ = std::move(left_out);
    library->complaints_ = std::move(rounds);
    return library;
  }
}

std::vector<Error> Library::complaints_about(const std::vector<const ScriptFile*>& files) const {
  if (std::all_of(complaints_.begin(), complaints_.end(), [](const auto& round) { return round.empty(); })) return {};
  const std::vector<const ScriptFile*> used = used_by(files);
  for (const std::vector<Error>& round : complaints_) {
    std::vector<Error> found;
    for (const Error& error : round)
      if (std::any_of(used.begin(), used.end(), [&](const ScriptFile* file) { return is_about(error, *file); }))
        found.push_back(error);
    if (!found.empty()) return found;
  }
  return {};
}

void Library::require_sound(const std::vector<const ScriptFile*>& files) const {
  std::vector<Error> found = complaints_about(files);
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
  const auto found = vocabulary_.skills.find(name);
  return found == vocabulary_.skills.end() ? nullptr : &found->second;
}

const Library::TaskInfo* Library::task(std::string_view name) const {
  const auto found = vocabulary_.tasks.find(name);
  return found == vocabulary_.tasks.end() ? nullptr : &found->second;
}

const Domain& Library::domain_of(std::string_view name) const {
  const TaskInfo* info = task(name);
  const auto found = info == nullptr ? vocabulary_.domains.end() : vocabulary_.domains.find(info->skills);
  return found == vocabulary_.domains.end() ? vocabulary_.domain : found->second;
}

std::string Library::hash() const {
  Hasher hasher;
  for (const ScriptFile& file : files_) hasher.text(file.shown_path).text(file.source);
  return hasher.digest();
}

}  // namespace stampede
