// A lock as text: JSON in which a person sees what is locked; the scripts are one block of packed text.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <set>

#include "engine/base/base64.h"
#include "engine/base/deflated.h"
#include "engine/base/hash.h"
#include "engine/base/read_json.h"
#include "scripting/session/lock.h"

namespace stampede {
namespace {

using Json = nlohmann::json;

constexpr std::int64_t kFormat = 1;
constexpr std::size_t kMostSource = std::size_t{64} << 20;  // bytes of all scripts
constexpr std::int64_t kMostSeeds = 1'000'000'000'000;
constexpr const char* kCure = "make the lock again with `stampede lock`";

std::string quoted(const std::string& text) { return Json(text).dump(-1, ' ', false, Json::error_handler_t::replace); }

// Items of a list, a line each.
template <typename List, typename Line>
std::string lines(const List& list, const std::string& indent, const Line& line) {
  std::string text = "[";
  for (const auto& one : list) text += (text.size() > 1 ? ",\n" : "\n") + indent + line(one);
  return text + "]";
}

std::string text_of(const LockedRun& run) {
  std::string options, scripts;
  for (const auto& [name, value] : run.options)
    options += (options.empty() ? "" : ", ") + quoted(name) + ": " + quoted(value);
  for (const std::size_t one : run.scripts) scripts += (scripts.empty() ? "" : ",") + std::to_string(one);
  return fmt::format("{{\"options\": {{{}}},\n   \"split\": \"{}\", \"scripts\": [{}],\n   \"episodes\": {}}}", options,
                     to_string(run.split), scripts, lines(run.strands, "    ", [](const LockedStrand& strand) {
                       const SeedStrand& of = strand.episodes;
                       return fmt::format("[{}, {}, {}, {}, {}, \"{}\"]", quoted(of.task), quoted(of.variation),
                                          of.first_seed, of.stride, of.count, strand.hash);
                     }));
}

class LockReader {
 public:
  explicit LockReader(const std::filesystem::path& file) : file_(file.string()), json_(json_from_file(file, kCure)) {}

  Lock read() const {
    if (!json_.is_object() || !json_.contains("stampede_lock")) fail("it is no lock");
    if (json_["stampede_lock"] != kFormat)
      throw Error(file_, "a lock of another form than this release knows", "read it with the release that wrote it");
    require_known_fields(
        json_, {"stampede_lock", "release", "numerics", "episodes", "hash", "runs", "scripts", "sources"}, file_);
    Lock lock;
    lock.engine = {text(json_, "release"), text(json_, "numerics")};
    lock.hash = text(json_, "hash");
    read_scripts(lock);
    for (const Json& one : list(json_, "runs")) lock.runs.push_back(run_from(one, lock));
    if (lock.runs.empty()) fail("it locks nothing");
    if (whole(field(json_, "episodes"), 0, kMostSeeds) != lock.episodes())
      fail("it says another number of episodes than it lists");
    return lock;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw Error(file_, what, kCure); }

  const Json& field(const Json& object, const char* name) const {
    if (!object.is_object() || !object.contains(name)) fail("it has no '" + std::string(name) + "'");
    return object[name];
  }
  std::string text(const Json& object, const char* name) const { return text(field(object, name)); }
  std::string text(const Json& value) const {
    if (!value.is_string()) fail(value.dump() + " is no text");
    return value.get<std::string>();
  }
  const Json& list(const Json& object, const char* name) const {
    if (!field(object, name).is_array()) fail("'" + std::string(name) + "' is no list");
    return object[name];
  }
  std::int64_t whole(const Json& value, std::int64_t least, std::int64_t most) const {
    if (!value.is_number_integer() || value < least || value > most)
      fail(fmt::format("{} is no whole number from {} to {}", value.dump(), least, most));
    return value.get<std::int64_t>();
  }

  // A name of a path of a root, such as `tasks/stack.lua`, and nothing that leads out of it.
  void check_path(const std::string& path) const {
    const std::filesystem::path parts(path);
    const bool inside = !parts.is_absolute() && std::ranges::none_of(parts, [](const std::filesystem::path& part) {
      return part == ".." || part == "." || part.empty();
    });
    if (!inside || parts.extension() != ".lua" || path.find('\n') != std::string::npos)
      fail(Json(path).dump() + " is no path of a script");
  }

  void read_scripts(Lock& lock) const {
    std::vector<std::size_t> sizes;
    std::size_t all = 0;
    for (const Json& one : list(json_, "scripts")) {
      if (!one.is_array() || one.size() != 5) fail("a script is [kind, name, path, hash, bytes]");
      DefinitionRecord& script = lock.scripts.emplace_back();
      script.kind = text(one[0]), script.name = text(one[1]), script.path = text(one[2]), script.hash = text(one[3]);
      if (!definition_kind_from(script.kind)) fail("there is no kind of script '" + script.kind + "'");
      check_path(script.path);
      sizes.push_back(static_cast<std::size_t>(whole(one[4], 0, kMostSource)));
      all += sizes.back();
      if (all > kMostSource) fail("its scripts have more than 64 MiB");
    }
    std::string sources;
    try {
      sources = inflated(from_base64(text(json_, "sources")), all);
    } catch (const Error&) {
      fail("the text of its scripts is damaged");
    }
    std::size_t begin = 0;
    for (std::size_t i = 0; i < sizes.size(); begin += sizes[i++]) {
      DefinitionRecord& script = lock.scripts[i];
      script.source = sources.substr(begin, sizes[i]);
      if (content_hash(script.source) != script.hash) fail("the text of " + script.path + " is not what was locked");
    }
  }

  LockedRun run_from(const Json& json, const Lock& lock) const {
    LockedRun run;
    if (!field(json, "options").is_object()) fail("'options' is no object");
    for (const auto& [name, value] : json["options"].items()) run.options[name] = text(value);
    const auto split = split_from(text(json, "split"));
    if (!split) fail("there is no split '" + text(json, "split") + "'");
    run.split = *split;
    std::set<std::string> paths;
    for (const Json& one : list(json, "scripts")) {
      run.scripts.push_back(
          static_cast<std::size_t>(whole(one, 0, static_cast<std::int64_t>(lock.scripts.size()) - 1)));
      if (!paths.insert(lock.scripts[run.scripts.back()].path).second)
        fail("a run has two scripts " + lock.scripts[run.scripts.back()].path);
    }
    for (const Json& one : list(json, "episodes")) run.strands.push_back(strand_from(one, run.split));
    if (run.strands.empty()) fail("a run has no episodes");
    return run;
  }

  LockedStrand strand_from(const Json& json, Split split) const {
    if (!json.is_array() || json.size() != 6) fail("episodes are [task, variation, first seed, stride, count, hash]");
    SeedStrand strand{text(json[0]), text(json[1]), whole(json[2], 0, kMostSeeds), whole(json[3], 1, kMostSeeds),
                      whole(json[4], 1, 1'000'000'000)};
    if (strand.count > (kMostSeeds - strand.first_seed) / strand.stride) fail("a seed is beyond 10^12");
    try {
      check_split(split, strand.first_seed, strand.first_seed + (strand.count - 1) * strand.stride);
    } catch (const Error& error) {
      fail(error.message());
    }
    return {std::move(strand), text(json[5])};
  }

  std::string file_;
  Json json_;
};

}  // namespace

std::string to_text(const Lock& lock) {
  std::string sources;
  for (const DefinitionRecord& script : lock.scripts) sources += script.source;
  return fmt::format(
      "{{\"stampede_lock\": {}, \"release\": {}, \"numerics\": {},\n \"episodes\": {}, \"hash\": {},\n \"runs\": {},\n "
      "\"scripts\": {},\n \"sources\": \"{}\"}}\n",
      kFormat, quoted(lock.engine.version), quoted(lock.engine.numerics), lock.episodes(), quoted(lock.hash),
      lines(lock.runs, "  ", text_of),
      lines(lock.scripts, "  ",
            [](const DefinitionRecord& script) {
              return fmt::format("[{}, {}, {}, {}, {}]", quoted(script.kind), quoted(script.name), quoted(script.path),
                                 quoted(script.hash), script.source.size());
            }),
      to_base64(deflated(sources)));
}

Lock lock_from_file(const std::filesystem::path& file) { return LockReader(file).read(); }

}  // namespace stampede
