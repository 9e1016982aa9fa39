#include <algorithm>
#include <cctype>
#include <map>

#include "engine/base/enum_names.h"
#include "engine/base/hash.h"
#include "engine/base/text_file.h"
#include "engine/base/utf8.h"
#include "scripting/library/draft.h"
#include "scripting/lua/sandbox.h"

namespace stampede {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 10> kKindNames{"task",  "skill", "predicate", "object", "world",
                                                      "robot", "types", "colours",   "words",  "module"};
constexpr std::uintmax_t kLargest = 1u << 20;  // bytes of one file

struct Home {
  const char* folder;
  DefinitionKind kind;
};
constexpr Home kHomes[] = {{"tasks", DefinitionKind::task},
                           {"skills", DefinitionKind::skill},
                           {"worlds", DefinitionKind::world},
                           {"worlds/objects", DefinitionKind::object},
                           {"worlds/predicates", DefinitionKind::predicate},
                           {"worlds/robots", DefinitionKind::robot}};

DefinitionKind kind_of(const std::string& shown_path) {
  if (shown_path == "worlds/types.lua") return DefinitionKind::types;
  if (shown_path == "worlds/colours.lua") return DefinitionKind::colours;
  if (shown_path == "worlds/words.lua") return DefinitionKind::words;
  const std::string folder = shown_path.substr(0, shown_path.rfind('/'));
  for (const Home& home : kHomes) {
    if (folder == home.folder) return home.kind;
  }
  return DefinitionKind::module;
}

// The first line when it is a comment, without its dashes and full stop.
std::string description_of(const std::string& source) {
  if (!source.starts_with("--")) return {};
  std::string line = source.substr(0, source.find('\n'));
  line.erase(0, line.find_first_not_of("- \t") == std::string::npos ? line.size() : line.find_first_not_of("- \t"));
  while (!line.empty() && (line.back() == '.' || line.back() == ' ' || line.back() == '\r')) line.pop_back();
  return line;
}

std::vector<fs::path> lua_files(const fs::path& root, const char* folder) {
  std::vector<fs::path> found;
  std::error_code code;
  const fs::path start = root / folder;
  if (!fs::is_directory(start, code)) return found;
  for (fs::recursive_directory_iterator entry(start, code), end; !code && entry != end; entry.increment(code))
    if (entry->path().extension() == ".lua" && entry->is_regular_file(code)) found.push_back(entry->path());
  std::sort(found.begin(), found.end());
  return found;
}

// What lies outside, behind a link, is not read.
std::string source_of(const fs::path& real_root, const fs::path& path, const std::string& shown) {
  std::error_code code;
  const fs::path real = fs::canonical(path, code);
  if (std::mismatch(real_root.begin(), real_root.end(), real.begin(), real.end()).first != real_root.end())
    throw Error(shown, "a link that leads out of its root", "copy the file instead");
  std::string source = read_text_file(path, kLargest);
  require_text(source, shown);
  return source;
}

// A file of a later root replaces one of the same name, but its types, colours and words add to those of the roots
// before it.
void stand_beside(const fs::path& root, const std::map<std::string, ScriptFile>& files, ScriptFile& file) {
  const std::string folder = fs::weakly_canonical(root).filename().string(), stem = file.name;
  std::string plain;
  for (const char c : folder) plain += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
  const auto taken = [&] {
    return std::any_of(files.begin(), files.end(), [&](const auto& one) {
      return one.first == file.shown_path || (one.second.kind == file.kind && one.second.name == file.name);
    });
  };
  for (int n = 2; taken(); ++n) {
    file.name = stem + std::to_string(n);
    file.shown_path = plain + (n > 2 ? std::to_string(n) : "") + "/worlds/" + stem + ".lua";
  }
}

struct Folder {  // a root
  std::size_t place;
  fs::path path, real_path;  // as it was named; without links
};

// One that cannot be read is a file without a text: what is wrong with it is a mistake of that file alone.
template <typename Source>
void take_source(ScriptFile& file, const Source& source, std::vector<Error>& complaints) {
  try {
    file.source = source();
    file.description = description_of(file.source);
    file.hash = content_hash(file.source);
    file.bytecode = Sandbox::compile(file.source, file.shown_path);
  } catch (const Error& error) {
    if (is_about(error, file))
      complaints.push_back(error);
    else  // its path as it was opened, or none: Lua's own limits have no place
      complaints.emplace_back(file.shown_path, error.message(),
                              error.message() == "C stack overflow"
                                  ? "its brackets and blocks are nested too deep: at most 200"
                                  : error.hint());
  }
}

void read_file(const Folder& folder, const fs::path& path, bool shared_too, std::map<std::string, ScriptFile>& files,
               std::vector<Error>& complaints) {
  const auto& [place, root, real_root] = folder;
  ScriptFile file;
  file.path = path;
  file.root = place;
  file.shown_path = path.lexically_relative(root).generic_string();
  file.kind = kind_of(file.shown_path);
  file.name = path.stem().string();
  if (!shared_too && is_shared(file.kind)) return;
  if (file.kind == DefinitionKind::types || file.kind == DefinitionKind::colours || file.kind == DefinitionKind::words)
    stand_beside(root, files, file);
  take_source(
      file, [&] { return source_of(real_root, path, file.shown_path); }, complaints);
  file.replaces = files.contains(file.shown_path);
  files[file.shown_path] = std::move(file);
}

// It lies where the last folder has a file of its name, or else in the first.
ScriptFile given_file(const Roots& roots, const GivenScript& given, std::vector<Error>& complaints) {
  ScriptFile file;
  for (std::size_t place = roots.folders.size(); place-- > 0;) {
    file.root = place;
    file.path = roots.folders[place] / given.shown_path;
    std::error_code code;
    if (fs::exists(file.path, code)) break;
  }
  file.shown_path = given.shown_path;
  file.name = given.name;
  file.kind = given.kind;
  take_source(
      file,
      [&] {
        require_text(given.source, file.shown_path);
        return given.source;
      },
      complaints);
  return file;
}

}  // namespace

std::string_view to_string(DefinitionKind kind) { return enum_name(kKindNames, kind); }

std::optional<DefinitionKind> definition_kind_from(std::string_view name) {
  return enum_from<DefinitionKind>(kKindNames, name);
}

bool is_shared(DefinitionKind kind) {
  using enum DefinitionKind;
  return kind == skill || kind == predicate || kind == types || kind == colours || kind == module;
}

bool is_foreign(std::string_view shown_path) { return shown_path.starts_with("worlds/bddl/"); }

std::vector<ScriptFile> find_files(const Roots& roots, std::vector<Error>& complaints) {
  std::map<std::string, ScriptFile> files;
  for (std::size_t place = 0; place < roots.folders.size(); ++place) {
    const fs::path& root = roots.folders[place];
    std::error_code code;
    if (!fs::is_directory(root, code)) {
      complaints.emplace_back(root.string(), "is not a folder",
                              "--root and --path take folders with tasks, skills and worlds");
      continue;
    }
    const Folder folder{place, root, fs::canonical(root, code)};
    for (const char* home : {"tasks", "skills", "worlds"})
      for (const fs::path& path : lua_files(root, home))
        read_file(folder, path, roots.given.empty(), files, complaints);
  }
  for (const GivenScript& given : roots.given) files[given.shown_path] = given_file(roots, given, complaints);
  std::vector<ScriptFile> result;
  for (auto& [path, file] : files) result.push_back(std::move(file));
  std::stable_sort(result.begin(), result.end(), [](const ScriptFile& a, const ScriptFile& b) {
    return std::tie(a.kind, a.name) < std::tie(b.kind, b.name);
  });
  return result;
}

}  // namespace stampede
