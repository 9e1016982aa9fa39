#include "db/shared_writer.h"

#include <set>

#include "db/catalogue_impl.h"
#include "db/insert.h"
#include "db/table_text.h"
#include "engine/base/hash.h"

namespace stampede {
namespace {

constexpr const char* kOnce = " ON CONFLICT DO NOTHING";

// Seed and split are columns of episode: with them, hardly two episodes would share an engine run.
std::string options_text(const EpisodeRecord& episode) {
  std::string text = "{";
  for (const auto& [name, value] : episode.made.options) {
    if (name == "seed" || name == "split") continue;
    text += (text.size() > 1 ? "," : "") + json_text(name) + ":" + json_text(value);
  }
  return text + "}";
}

}  // namespace

SharedWriter::SharedWriter(const sql::Database& database)
    : database_(database),
      definition_(insert(database, "definition", "kind, name, hash, path, source", kOnce)),
      engine_run_(insert(database, "engine_run", "hash, engine_version, numerics, options", kOnce)),
      engine_run_definition_(insert(database, "engine_run_definition", "engine_run, kind, name, hash", kOnce)),
      predicate_(insert(database, "predicate", "engine_run, name, kind", kOnce)),
      variation_(insert(database, "variation", "task, variation", kOnce)),
      variation_axis_(insert(database, "variation_axis", "task, variation, axis, value", kOnce)),
      scene_(insert(database, "scene", "hash, document", kOnce)),
      asset_(insert(database, "asset", "hash, body", kOnce)) {}

void SharedWriter::write_variation(const EpisodeRecord& episode) {
  if (episode.real) return;
  variation_.run(episode.task, episode.variation);
  for (const auto& [axis, value] : episode.axes) variation_axis_.run(episode.task, episode.variation, axis, value);
}

std::string SharedWriter::write_engine_run(const EpisodeRecord& episode, const EngineInfo& engine) {
  const std::string options = options_text(episode);
  Hasher hasher;
  hasher.text(engine.version).text(engine.numerics).text(options);
  std::set<std::tuple<std::string, std::string, std::string>> names;  // in one order, whatever the record's
  for (const DefinitionRecord& d : episode.made.definitions) names.emplace(d.kind, d.name, d.hash);
  for (const auto& [kind, name, hash] : names) hasher.text(kind).text(name).text(hash);
  for (const auto& [name, kind] : episode.scene.predicates) hasher.text(name).text(kind);
  const std::string run = hasher.digest();
  engine_run_.run(run, engine.version, engine.numerics, options);
  if (sqlite3_changes(database_.handle()) == 0) return run;
  for (const DefinitionRecord& d : episode.made.definitions) {
    definition_.run(d.kind, d.name, d.hash, d.path, d.source);
    engine_run_definition_.run(run, d.kind, d.name, d.hash);
  }
  for (const auto& [name, kind] : episode.scene.predicates) predicate_.run(run, name, kind);
  return run;
}

std::string SharedWriter::write_scene(const std::string& document) {
  const std::string hash = content_hash(document);
  const PackedScene packed = pack_scene(document);
  scene_.run(hash, packed.document);
  if (sqlite3_changes(database_.handle()) == 0) return hash;
  for (const auto& [asset, body] : packed.assets) asset_.run(asset, body);
  return hash;
}

}  // namespace stampede
