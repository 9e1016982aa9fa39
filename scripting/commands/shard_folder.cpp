#include "scripting/commands/shard_folder.h"

#include <fmt/format.h>

#include <fstream>
#include <utility>

#include "engine/base/error.h"
#include "engine/base/read_json.h"
#include "engine/base/shell_program.h"
#include "engine/base/text.h"
#include "engine/base/text_file.h"
#include "scripting/program/json_text.h"

namespace stampede::program {
namespace {

namespace fs = std::filesystem;

constexpr const char* kManifest = "cluster.json";
constexpr int kFormat = 1;

// The program that is to run on the nodes: this one, unless STAMPEDE names another there.
constexpr const char* kHead = R"text(#!/bin/sh
# Written by `stampede cluster`. {}
set -eu
cd "$(dirname "$0")"
stampede={}
if [ -n "${{STAMPEDE:-}}" ]; then stampede=$STAMPEDE; fi
)text";

constexpr const char* kShard = R"text(
shard=$1
log=logs/$shard.txt
part=parts/part$(printf %06d "$shard").db
if [ -e "$part" ]; then exit 0; fi
exec >>"$log" 2>&1
work=$(mktemp -d "${{TMPDIR:-/tmp}}/stampede.XXXXXX")
beside=$part.$(uname -n).$$
trap 'rm -rf "$work" "$beside"' EXIT
trap 'exit 143' INT TERM
code=0
"$stampede" make run.plan --shard "$shard/{}" --out "$work/part.db" --workers "${{SLURM_CPUS_PER_TASK:-1}}"{} || code=$?
if [ "$code" -eq 0 ]; then cp "$work/part.db" "$beside" && mv "$beside" "$part" || code=$?; fi
if [ "$code" -ne 0 ]; then echo "exit code $code on $(uname -n): $(tail -n 2 "$log" | tr -s '\n ' ' ')"; fi
exit "$code"
)text";

constexpr const char* kFinish = R"text(
set -- parts/part??????.db
if [ ! -e "$1" ]; then
  echo "no shard is made: logs/ says why" >&2
  exit 1
fi
"$stampede" merge demos.db "$@"
if "$stampede" verify run.plan demos.db >missing.txt; then
  mv missing.txt complete.txt
else
  code=$?
  cat missing.txt
  exit "$code"
fi
)text";

std::string this_program() { return fs::canonical("/proc/self/exe").string(); }

std::vector<std::string> texts_of(const nlohmann::json& list, const std::string& where) {
  if (!list.is_array()) throw Error(where, "not a list of texts");
  std::vector<std::string> texts;
  for (const auto& one : list) {
    if (!one.is_string()) throw Error(where, "not a list of texts");
    texts.push_back(one.get<std::string>());
  }
  return texts;
}

std::int64_t whole_number(const nlohmann::json& object, const char* name, std::int64_t most, const std::string& where) {
  const auto& number = object.at(name);
  if (!number.is_number_integer() || number.get<std::int64_t>() < 1 || number.get<std::int64_t>() > most)
    throw Error(where, fmt::format("'{}' is a whole number from 1 to {}", name, most));
  return number.get<std::int64_t>();
}

void add_texts(const char* name, const std::vector<std::string>& texts, JsonText& json) {
  json.key(name).array();
  for (const std::string& text : texts) json.value(text);
  json.end();
}

}  // namespace

ShardFolder::ShardFolder(fs::path path, const Lock& plan, Shape shape)
    : path_(fs::absolute(std::move(path)).lexically_normal()), shape_(std::move(shape)) {
  std::error_code error;
  if (fs::exists(path_ / kManifest, error))
    throw Error(path_.string(), "a run lies there already",
                "`stampede cluster resume` goes on with it; another run takes another folder");
  if (fs::exists(path_, error) && (!fs::is_directory(path_, error) || !fs::is_empty(path_, error)))
    throw Error(path_.string(), "there is something of another kind", "name a folder that is not there yet");
  fs::create_directories(path_, error);
  if (!fs::create_directory(path_ / "parts", error) || !fs::create_directory(path_ / "logs", error))
    throw Error(path_.string(), error ? error.message() : "another command fills it now", "name another folder");
  write_text_file(path_ / "run.plan", to_text(plan));
  write_scripts();
  write_manifest();
}

ShardFolder::ShardFolder(fs::path path) : path_(fs::absolute(std::move(path)).lexically_normal()) {
  const fs::path file = path_ / kManifest;
  const std::string where = file.string(), cure = "name a folder that `stampede cluster` made";
  std::error_code error;
  if (!fs::exists(file, error)) throw Error(path_.string(), "no run lies there", cure);
  const nlohmann::json json = json_from_file(file, cure);
  require_known_fields(json, {"format", "episodes", "shards", "roots", "options", "arrays", "finish"}, where);
  for (const char* name : {"format", "episodes", "shards", "roots", "options", "arrays", "finish"})
    if (!json.contains(name)) throw Error(where, fmt::format("'{}' is missing", name), cure);
  if (json["format"] != kFormat) throw Error(where, "of another release", "use the release that made it");
  shape_.episodes = whole_number(json, "episodes", std::int64_t{1} << 40, where);
  shape_.shards = static_cast<int>(whole_number(json, "shards", kMostShards, where));
  shape_.roots = texts_of(json["roots"], where + ": roots");
  submitted_.options = texts_of(json["options"], where + ": options");
  submitted_.arrays = texts_of(json["arrays"], where + ": arrays");
  if (!json["finish"].is_string()) throw Error(where, "'finish' is a text");
  submitted_.finish = json["finish"].get<std::string>();
  write_scripts();
}

bool ShardFolder::has_part(int shard) const {
  std::error_code error;
  return fs::exists(path_ / fmt::format("parts/part{:06}.db", shard), error);
}

bool ShardFolder::is_complete() const {
  std::error_code error;
  return fs::exists(path_ / "complete.txt", error);
}

std::string ShardFolder::last_words(int shard) const {
  std::ifstream log(path_ / fmt::format("logs/{}.txt", shard), std::ios::binary);
  std::string last;
  for (std::string line; std::getline(log, line);)
    if (!trimmed(line).empty()) last = trimmed(line);
  return last;
}

void ShardFolder::keep(Submitted submitted) {
  submitted_ = std::move(submitted);
  write_manifest();
}

void ShardFolder::write_scripts() const {
  const std::string program = shell_word(this_program());
  std::string roots;
  for (const std::string& word : shape_.roots) roots += " " + shell_word(word);
  const auto head = [&](const char* what) { return fmt::format(fmt::runtime(kHead), what, program); };
  write_text_file(path_ / "shard.sh", head("sh shard.sh I: makes shard I, unless its part is there.") +
                                          fmt::format(fmt::runtime(kShard), shape_.shards, roots));
  write_text_file(path_ / "finish.sh", head("Merges the parts; the exit code is 0 when nothing is missing.") + kFinish);
}

void ShardFolder::write_manifest() const {
  JsonText json;
  json.object().field("format", kFormat).field("episodes", shape_.episodes).field("shards", shape_.shards);
  add_texts("roots", shape_.roots, json);
  add_texts("options", submitted_.options, json);
  add_texts("arrays", submitted_.arrays, json);
  write_text_file(path_ / kManifest, json.field("finish", submitted_.finish).end().text());
}

}  // namespace stampede::program
