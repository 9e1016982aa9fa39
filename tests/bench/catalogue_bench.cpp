// Questions to a large catalogue: synthesised through the writer from a few recorded episodes, under other seeds.
//   catalogue_bench RECORDED.db OUT.db EPISODES     makes OUT.db when it is not there, then asks
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>

#include "db/catalogue.h"
#include "engine/base/hash.h"

using namespace stampede;

namespace {

double seconds_of(const std::function<void()>& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

// Honest sizes: every row of the recorded episode but pictures, only key and seed are new.
void synthesise(const std::filesystem::path& recorded, const std::filesystem::path& out, std::int64_t episodes) {
  const Catalogue source = Catalogue::open(recorded);
  std::vector<EpisodeRecord> records;
  for (const EpisodeSummary& episode : source.episodes()) records.push_back(source.read_episode(episode.id));
  Catalogue catalogue = Catalogue::write(out);
  for (std::int64_t i = 0; i < episodes; ++i) {
    EpisodeRecord& record = records[static_cast<std::size_t>(i) % records.size()];
    record.seed = i;
    record.key = content_hash("catalogue_bench " + std::to_string(i));
    catalogue.add(record, {"0.1.0", "bench"});
  }
  catalogue.close();
}

// Counts rows and reads every value, as a program that wants them would.
struct Reader : RowReceiver {
  void columns(const std::vector<std::string>&) override {}
  bool row(const std::vector<SqlValue>&) override {
    ++rows;
    return true;
  }
  std::int64_t rows = 0;
};

void ask(const Catalogue& catalogue, const char* name, const std::string& question,
         const std::vector<SqlValue>& parameters = {}) {
  Reader reader;
  const double time = seconds_of([&] { catalogue.query(question, reader, {parameters, 0}); });
  std::printf("%-34s %9.3f s %9lld rows\n", name, time, static_cast<long long>(reader.rows));
  std::fflush(stdout);
}

// Of the episode in the middle, and of the one with most segments.
void ask_points(const Catalogue& catalogue) {
  const std::int64_t middle = catalogue.episodes().size() / 2 + 1;
  for (const char* view : {"episodes",     "segments", "tries",     "facts",       "observed_facts", "frames",
                           "steps",        "poses",    "joints",    "hands",       "actions",        "contacts",
                           "grasps",       "vias",     "keyframes", "parameters",  "transitions",    "failures",
                           "instructions", "plans",    "axes",      "definitions", "sensors"}) {
    const std::string name = std::string(view) + " of one episode";
    ask(catalogue, name.c_str(), std::string("SELECT * FROM ") + view + " WHERE episode = ?1", {middle});
  }
  const auto longest = catalogue.query("SELECT episode FROM segments GROUP BY episode ORDER BY count(*) DESC LIMIT 1");
  ask(catalogue, "transitions of the longest", "SELECT * FROM transitions WHERE episode = ?1",
      {longest.rows.at(0).at(0)});
  std::printf("%-34s %9.3f s\n", "read_episode of the longest",
              seconds_of([&] { catalogue.read_episode(std::get<std::int64_t>(longest.rows[0][0])); }));
}

}  // namespace

int main(int count, char** words) {
  if (count != 4) {
    std::fprintf(stderr, "usage: catalogue_bench RECORDED.db OUT.db EPISODES\n");
    return 2;
  }
  const std::filesystem::path out = words[2];
  const std::int64_t episodes = std::atoll(words[3]);
  if (!std::filesystem::exists(out)) {
    const double time = seconds_of([&] { synthesise(words[1], out, episodes); });
    std::printf("made: %.1f s, %.2f ms an episode, %.1f kB each\n", time, 1e3 * time / static_cast<double>(episodes),
                1e-3 * static_cast<double>(std::filesystem::file_size(out)) / static_cast<double>(episodes));
  }
  const Catalogue catalogue = Catalogue::open(out);
  for (const NamedQuery& query : named_queries()) ask(catalogue, query.name.c_str(), query.name);
  ask_points(catalogue);
  ask(catalogue, "steps of 80,000 frames", "SELECT * FROM steps LIMIT 80000");
  return 0;
}
