#include "scripting/library/builder.h"

#include <algorithm>

#include "engine/base/naming.h"
#include "scripting/library/checks.h"

namespace stampede {
namespace {

void check_file_names(LibraryDraft& draft) {
  for (const ScriptFile& file : draft.files()) {
    if (file.kind == DefinitionKind::module) continue;
    if (const auto fault = name_fault(file.name)) {
      const std::string sound = proposed_name(file.name, names_of(draft.library()->files(file.kind)));
      draft.complaints().add(Error(file.shown_path, "the name '" + file.name + "' " + *fault,
                                   "rename the file, to " + sound + ".lua for example"));
    }
  }
}

}  // namespace

bool BuilderOptions::is_thorough(const std::string& task) const {
  return thorough == Thorough::all || (thorough == Thorough::named && listed(named, task));
}

std::shared_ptr<Library> build_library(const Roots& roots, std::vector<Error>& complaints,
                                       const BuilderOptions& options) {
  LibraryDraft draft(roots, complaints, options.left_out);
  check_file_names(draft);
  draft.read_definitions(options.read);
  read_types(draft);
  declare_numbers(draft);
  declare_predicates(draft);
  define_predicates(draft);
  check_objects(draft);
  check_worlds(draft);
  read_skills(draft);
  check_rivals(draft);
  read_words(draft);
  read_tasks(draft, options);
  check_scripts(draft);
  make_domains(draft);
  draft.complaints().sort();
  return draft.library();
}

}  // namespace stampede
