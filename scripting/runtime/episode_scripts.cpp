#include "scripting/runtime/episode_scripts.h"

#include <algorithm>
#include <tuple>

#include "scripting/runtime/lua_symbols.h"
#include "scripting/runtime/lua_task.h"
#include "scripting/runtime/skill_run.h"

namespace stampede {

struct EpisodeScripts::Impl {
  Impl(std::shared_ptr<const Library> library, const EpisodeJob& job, int further_things,
       std::shared_ptr<Assets> assets)
      : tests(std::move(library)),
        task(tests, job, further_things, std::move(assets)),
        symbols(tests, job.task),
        skills(tests) {}
  TestState tests;
  LuaTask task;
  LuaSymbols symbols;
  LuaSkills skills;
};

// What a script that is used says wrongly is told by its own complaint, not by what comes of it.
EpisodeScripts::EpisodeScripts(std::shared_ptr<const Library> library, const EpisodeJob& job, int further_things,
                               std::shared_ptr<Assets> assets) {
  try {
    impl_ = std::make_unique<Impl>(library, job, further_things, std::move(assets));
  } catch (const Error&) {
    std::vector<const ScriptFile*> files = {library->file(DefinitionKind::task, job.task)};
    for (const DefinitionKind kind : {DefinitionKind::object, DefinitionKind::world, DefinitionKind::robot})
      for (const ScriptFile* file : library->files(kind)) files.push_back(file);
    std::erase(files, nullptr);
    library->require_sound(files);
    throw;
  }
  library->require_sound(impl_->task.files());
}

EpisodeScripts::EpisodeScripts(std::shared_ptr<const Library> library, std::string_view task,
                               std::string_view variation, std::int64_t seed)
    : EpisodeScripts(std::move(library), {std::string(task), std::string(variation), seed}) {}

EpisodeScripts::~EpisodeScripts() = default;

TaskDraw EpisodeScripts::task() {
  return [impl = impl_.get()](int number) { return impl->task.draw(number); };
}
Symbols& EpisodeScripts::symbols() { return impl_->symbols; }
SkillLibrary& EpisodeScripts::skills() { return impl_->skills; }

std::vector<DefinitionRecord> EpisodeScripts::definitions() const {
  const Library& library = *impl_->tests.library();
  std::vector<const ScriptFile*> files = impl_->task.files();
  for (const ScriptFile* file : library.all_files())
    if (is_shared(file->kind)) files.push_back(file);
  if (const auto* task = library.task(impl_->task.name()); task == nullptr || !task->is_imported)
    std::erase_if(files, [](const ScriptFile* file) { return is_foreign(file->shown_path); });
  std::vector<DefinitionRecord> records;
  for (const ScriptFile* file : files) {
    DefinitionRecord record{std::string(to_string(file->kind)), file->name, file->shown_path, file->source, file->hash};
    const auto same = [&](const DefinitionRecord& other) {
      return other.kind == record.kind && other.name == record.name;
    };
    if (std::none_of(records.begin(), records.end(), same)) records.push_back(std::move(record));
  }
  std::sort(records.begin(), records.end(), [](const DefinitionRecord& a, const DefinitionRecord& b) {
    return std::tie(a.kind, a.name) < std::tie(b.kind, b.name);
  });
  return records;
}

}  // namespace stampede
