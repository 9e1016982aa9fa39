#include "scripting/library/builder.h"

#include <algorithm>

#include "scripting/library/naming.h"
#include "scripting/library/source_lines.h"

namespace stampede {
namespace {

constexpr SandboxLimits kCheckLimits{5'000'000, 32u << 20};  // a definition that needs more is a runaway

// `file:12` sorts as a file and a number.
std::pair<std::string, int> place_of(const Error& error) {
  const std::size_t colon = error.where().rfind(':');
  if (colon == std::string::npos) return {error.where(), 0};
  return {error.where().substr(0, colon), std::atoi(error.where().c_str() + colon + 1)};
}

}  // namespace

bool listed(const std::vector<std::string>& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::vector<std::string> parameter_names(const Value& definition) {
  std::vector<std::string> names;
  for (const Value& text : definition["params"].items) names.push_back(text.text.substr(0, text.text.find(':')));
  return names;
}

LibraryBuilder::LibraryBuilder(const Roots& roots, std::vector<Error>& complaints, BuilderOptions options)
    : options_(std::move(options)), complaints_(complaints), library_(std::make_shared<Library>()) {
  library_->roots_ = roots;
}

std::shared_ptr<Library> LibraryBuilder::build() {
  library_->files_ = find_files(library_->roots_, complaints_);
  std::erase_if(library_->files_, [&](const ScriptFile& file) {
    return std::any_of(options_.left_out.begin(), options_.left_out.end(),
                       [&](const ScriptFile& one) { return one.shown_path == file.shown_path; });
  });
  std::erase_if(complaints_, [&](const Error& error) {  // said when they were read first
    return std::any_of(options_.left_out.begin(), options_.left_out.end(),
                       [&](const ScriptFile& one) { return is_about(error, one); });
  });
  check_names();
  read_definitions();
  read_types();
  declare_numbers();
  declare_predicates();
  declare_attributes();
  define_predicates();
  check_strata();
  check_objects();
  check_worlds();
  read_skills();
  read_tasks();
  check_scripts();
  finish();
  return library_;
}

void LibraryBuilder::check_names() {
  for (const ScriptFile& file : library_->files_) {
    if (file.kind == DefinitionKind::module) continue;
    const auto fault = name_fault(file.name);
    if (!fault) continue;
    std::vector<std::string> taken;
    for (const ScriptFile* other : library_->files(file.kind)) taken.push_back(other->name);
    add(Error(file.shown_path, "the name '" + file.name + "' " + *fault,
              "rename the file, to " + proposed_name(file.name, taken) + ".lua for example"));
  }
}

void LibraryBuilder::read_definitions() {
  for (const ScriptFile& file : library_->files_) {
    if (file.kind == DefinitionKind::types || file.kind == DefinitionKind::module || file.bytecode.empty()) continue;
    guarded_in(file, [&] {
      DefinitionState state(library_, kCheckLimits);
      state.push(file.kind, file.name);
      Definition definition{&file, value_as_written(state.state(), -1, file.shown_path), field_lines(file.source)};
      if (definition.node.line() > 0) definition.lines[""] = definition.node.line();
      if (const Record* fields = record(to_string(file.kind))) {
        check_record(*fields, definition.node, {}, complainer(definition));
      }
      if (file.description.empty() && file.kind != DefinitionKind::colours) {
        add(Error(file.shown_path + ":1",
                  "the first line is no comment that describes the " + std::string(to_string(file.kind)),
                  "begin the file with -- and one sentence"));
      }
      of(file.kind).emplace(file.name, std::move(definition));
    });
  }
  auto& colours = of(DefinitionKind::colours);
  if (const auto all = colours.find("colours"); all != colours.end())
    for (const auto& [name, other] : colours)
      if (name != all->first) all->second.node.fields.insert(other.node.fields.begin(), other.node.fields.end());
}

Error LibraryBuilder::error_at(const Definition& definition, const std::string& path, const std::string& what,
                               const std::string& hint) const {
  const std::string place = definition.file->shown_path + ":" + std::to_string(line_of(definition.lines, path));
  return Error(place, path.empty() ? what : path + ": " + what, hint);
}

void LibraryBuilder::complain(const Definition& definition, const std::string& path, const std::string& what,
                              const std::string& hint) {
  add(error_at(definition, path, what, hint));
}

Complain LibraryBuilder::complainer(const Definition& definition) {
  return [this, &definition](const std::string& path, const std::string& what, const std::string& hint) {
    complain(definition, path, what, hint);
  };
}

Error LibraryBuilder::placed_in(const ScriptFile& file, const Error& error) const {
  const auto& files = library_->files_;
  if (std::any_of(files.begin(), files.end(), [&](const ScriptFile& one) { return is_about(error, one); }))
    return error;
  return Error(file.shown_path, (error.where().empty() ? "" : error.where() + ": ") + error.message(), error.hint());
}

void LibraryBuilder::add(const Error& error) {
  const auto same = [&](const Error& other) {
    return other.where() == error.where() && other.message() == error.message();
  };
  if (std::none_of(complaints_.begin(), complaints_.end(), same)) complaints_.push_back(error);
}

FormulaContext LibraryBuilder::context(const Definition& definition, const std::string& field) const {
  FormulaContext result;
  result.file = definition.file->shown_path;
  result.field = field;
  result.domain = &library_->domain_;
  result.traits = &library_->predicate_traits_;
  result.part_fault = [this](const std::string& part) { return part_fault(part); };
  return result;
}

// Nothing where some object has such a part or region; what comes from a URDF is not known here.
std::optional<std::string> LibraryBuilder::part_fault(const std::string& name) const {
  std::vector<std::string> known;
  const auto objects = definitions_.find(DefinitionKind::object);
  if (objects == definitions_.end()) return std::nullopt;
  for (const auto& [object, definition] : objects->second) {
    if (definition.node["urdf"].present()) return std::nullopt;
    for (const auto& [region, unused] : definition.node["regions"].fields) known.push_back(region);
    if (definition.node["tip"].present()) known.push_back("tip");
    for (const auto& [part, fields] : definition.node["parts"].fields) {
      known.push_back(part);
      for (const auto& [region, unused] : fields["regions"].fields) known.push_back(part + "." + region);
    }
  }
  if (std::find(known.begin(), known.end(), name) != known.end()) return std::nullopt;
  return did_you_mean(name, known);
}

void LibraryBuilder::finish() {
  Domain& domain = library_->domain_;
  domain.name = "stampede";
  const auto by_name = [](const auto& a, const auto& b) { return a.name < b.name; };
  std::sort(domain.actions.begin(), domain.actions.end(), by_name);
  make_domains();
  std::stable_sort(complaints_.begin(), complaints_.end(),
                   [](const Error& a, const Error& b) { return place_of(a) < place_of(b); });
}

}  // namespace stampede
