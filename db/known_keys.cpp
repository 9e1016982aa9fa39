#include "db/known_keys.h"

namespace stampede {
namespace {

std::string named(const EpisodeSummary& episode) {
  std::string text = episode.task;
  if (!episode.variation.empty()) text.append(" ").append(episode.variation);
  return text + " seed " + std::to_string(episode.seed) + " (key " + episode.key.substr(0, 8) + "…)";
}

}  // namespace

void refuse_other_content(const std::string& path, const EpisodeSummary& episode, const std::string& other,
                          std::int64_t there) {
  throw CatalogueError(path,
                       "episode " + std::to_string(episode.id) + ", " + named(episode) + ", is in " + other +
                           " too (episode " + std::to_string(there) + "), with other content",
                       "they were made by different builds, or one has pictures that the other lacks: leave one "
                       "of the two files out, or make the episode again");
}

void KnownKeys::own(const Catalogue& catalogue, const std::filesystem::path& path) {
  for (const EpisodeSummary& episode : catalogue.episodes())
    owners_.emplace(episode.key, Owner{&catalogue, path.string(), episode.id});
}

std::vector<std::int64_t> KnownKeys::add(const Catalogue& catalogue, const std::filesystem::path& path,
                                         std::int64_t& existing) {
  std::vector<std::int64_t> fresh;
  for (const EpisodeSummary& episode : catalogue.episodes()) {
    const auto [owner, is_new] = owners_.emplace(episode.key, Owner{&catalogue, path.string(), episode.id});
    if (is_new) {
      fresh.push_back(episode.id);
      continue;
    }
    const Owner& other = owner->second;
    if (other.catalogue == &catalogue && other.id == episode.id) continue;  // asked before
    if (other.catalogue->episode_hash(other.id) != catalogue.episode_hash(episode.id))
      refuse_other_content(path.string(), episode, other.path, other.id);
    ++existing;
  }
  return fresh;
}

}  // namespace stampede
