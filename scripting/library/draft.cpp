#include "scripting/library/draft.h"

#include <algorithm>

#include "scripting/library/lua_value.h"
#include "scripting/library/scene_outline.h"
#include "scripting/library/source_lines.h"

namespace stampede {
namespace {

// `file:12` sorts as a file and a number.
std::pair<std::string, int> place_of(const Error& error) {
  const std::size_t colon = error.where().rfind(':');
  if (colon == std::string::npos) return {error.where(), 0};
  return {error.where().substr(0, colon), std::atoi(error.where().c_str() + colon + 1)};
}

}  // namespace

std::string place_in(const ScriptFile& file, int line) { return file.shown_path + ":" + std::to_string(line); }

void Complaints::add(const Error& error) {
  const auto same = [&](const Error& other) {
    return other.where() == error.where() && other.message() == error.message();
  };
  if (std::none_of(found_.begin(), found_.end(), same)) found_.push_back(error);
}

void Complaints::sort() {
  std::stable_sort(found_.begin(), found_.end(),
                   [](const Error& a, const Error& b) { return place_of(a) < place_of(b); });
}

std::string Definition::place(const std::string& path) const { return place_in(*file, line_of(lines, path)); }

Error Definition::error(const std::string& path, const std::string& what, const std::string& hint) const {
  return Error(place(path), path.empty() ? what : path + ": " + what, hint);
}

void Definition::complain(const std::string& path, const std::string& what, const std::string& hint) const {
  complaints->add(error(path, what, hint));
}

void Definition::complain_unknown(const std::string& path, const std::string& what, const std::string& name,
                                  const std::vector<std::string>& known) const {
  complain(path, "there is no " + what + " '" + name + "'", did_you_mean(name, known));
}

void Definition::require_known(const std::string& path, const std::string& what, const Value& text,
                               const std::vector<std::string>& known) const {
  if (text.is_text() && !listed(known, text.text)) complain_unknown(path, what, text.text, known);
}

Complain Definition::complainer() const {
  return
      [this](const std::string& path, const std::string& what, const std::string& hint) { complain(path, what, hint); };
}

std::vector<std::string> Definition::parameter_names() const {
  std::vector<std::string> names = texts_of(node["params"]);
  for (std::string& name : names) name = name.substr(0, name.find(':'));
  return names;
}

LibraryDraft::LibraryDraft(const Roots& roots, std::vector<Error>& complaints, const std::vector<ScriptFile>& left_out)
    : library_(std::make_shared<Library>()), complaints_(complaints) {
  library_->roots_ = roots;
  library_->files_ = find_files(roots, complaints);
  std::erase_if(library_->files_, [&](const ScriptFile& file) {
    return std::any_of(left_out.begin(), left_out.end(),
                       [&](const ScriptFile& one) { return one.shown_path == file.shown_path; });
  });
  std::erase_if(complaints, [&](const Error& error) {  // said when they were read first
    return std::any_of(left_out.begin(), left_out.end(), [&](const ScriptFile& one) { return is_about(error, one); });
  });
}

void LibraryDraft::remark(const Error& remark) { Complaints(library_->remarks_).add(remark); }

void LibraryDraft::read_definitions(const std::vector<std::string>& tasks) {
  for (const ScriptFile& file : files()) {
    if (file.kind == DefinitionKind::task && !tasks.empty() && !listed(tasks, file.name)) continue;
    if (file.kind == DefinitionKind::types || file.kind == DefinitionKind::module || file.bytecode.empty()) continue;
    guarded_in(file, [&] {
      DefinitionState& state = fresh_state();
      state.push(file.kind, file.name);
      Definition definition{&file, value_as_written(state.state(), -1, file.shown_path), field_lines(file.source),
                            &complaints_};
      if (definition.node.line() > 0) definition.lines[""] = definition.node.line();
      if (const Record* fields = record(to_string(file.kind))) {
        check_record(*fields, definition.node, {}, definition.complainer());
      }
      if (file.description.empty() && file.kind != DefinitionKind::colours && file.kind != DefinitionKind::words) {
        complaints_.add(Error(place_in(file, 1),
                              "the first line is no comment that describes the " + std::string(to_string(file.kind)),
                              "begin the file with -- and one sentence"));
      }
      definitions_[file.kind].emplace(file.name, std::move(definition));
    });
  }
  auto& colours = definitions_[DefinitionKind::colours];
  if (const auto all = colours.find("colours"); all != colours.end())
    for (const auto& [name, other] : colours)
      if (name != all->first) all->second.node.fields.insert(other.node.fields.begin(), other.node.fields.end());
}

const Definition* LibraryDraft::read_type_file(const ScriptFile& file) {
  Definition& definition = type_files_.emplace_back(Definition{&file, {}, field_lines(file.source), &complaints_});
  const bool read = complaints_.guarded([&] {
    DefinitionState state(library_);
    state.push(DefinitionKind::types, file.name);
    definition.node = value_as_written(state.state(), -1, file.shown_path);
  });
  return read ? &definition : nullptr;
}

const Definitions& LibraryDraft::of(DefinitionKind kind) const {
  static const Definitions kNone;
  const auto found = definitions_.find(kind);
  return found == definitions_.end() ? kNone : found->second;
}

const Definition* LibraryDraft::find(DefinitionKind kind, const std::string& name) const {
  const Definitions& definitions = of(kind);
  const auto found = definitions.find(name);
  return found == definitions.end() ? nullptr : &found->second;
}

DefinitionState& LibraryDraft::fresh_state() {
  if (state_ != nullptr)
    state_->start_afresh();
  else
    state_ = std::make_unique<DefinitionState>(library_, kCheckLimits);
  return *state_;
}

void LibraryDraft::guarded_in(const ScriptFile& file, const std::function<void()>& work) {
  try {
    work();
  } catch (const Error& error) {
    state_.reset();  // its budget may be spent
    complaints_.add(placed_in(file, error));
  }
}

Error LibraryDraft::placed_in(const ScriptFile& file, const Error& error) const {
  if (std::any_of(files().begin(), files().end(), [&](const ScriptFile& one) { return is_about(error, one); }))
    return error;
  return Error(file.shown_path, (error.where().empty() ? "" : error.where() + ": ") + error.message(), error.hint());
}

FormulaContext LibraryDraft::context(const Definition& definition, const std::string& field) const {
  FormulaContext result;
  result.file = definition.file->shown_path;
  result.field = field;
  result.domain = &library_->vocabulary_.domain;
  result.traits = &library_->vocabulary_.predicate_traits;
  result.part_fault = [this](const std::string& part) { return part_fault(part); };
  return result;
}

FormulaContext LibraryDraft::schema(const Definition& definition, const std::string& field,
                                    const std::vector<Parameter>& parameters) const {
  FormulaContext result = context(definition, field);
  result.schema = true;
  result.parameters = parameters;
  return result;
}

// Nothing where some object has such a part or region; what comes from a URDF is not known here.
std::optional<std::string> LibraryDraft::part_fault(const std::string& name) const {
  std::vector<std::string> known;
  for (const auto& [object, definition] : of(DefinitionKind::object)) {
    if (definition.node["urdf"].present()) return std::nullopt;
    for (const std::string& thing : things_in(definition.node)) known.push_back(thing);
  }
  if (listed(known, name)) return std::nullopt;
  return did_you_mean(name, known);
}

}  // namespace stampede
