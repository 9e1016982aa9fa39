// Questions to a large catalogue, made of a few recorded episodes by copying their rows.
//   catalogue_bench RECORDED.db OUT.db EPISODES     makes OUT.db when it is not there, then asks
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <functional>

#include "db/catalogue.h"
#include "db/embedded_sql.h"
#include "db/schema.h"
#include "db/sqlite.h"

using namespace stampede;

namespace {

// Of CPU: whoever shares the machine does not count.
double seconds_of(const std::function<void()>& work) {
  const std::clock_t begin = std::clock();
  work();
  return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

// Stored by the writer, timed: all rows of the recorded episodes but pictures.
void store(const std::filesystem::path& recorded, const std::filesystem::path& out) {
  const Catalogue source = Catalogue::open(recorded);
  std::vector<EpisodeRecord> records;
  for (const EpisodeSummary& episode : source.episodes()) records.push_back(source.read_episode(episode.id));
  Catalogue catalogue = Catalogue::write(out);
  std::size_t frames = 0;
  const double time = seconds_of([&] {
    for (const EpisodeRecord& record : records) {
      catalogue.add(record, {"0.1.0", "bench"});
      frames += record.frames.size();
    }
  });
  const auto count = static_cast<double>(records.size());
  std::printf("stored: %.2f ms an episode of %.0f frames\n", 1e3 * time / count, static_cast<double>(frames) / count);
}

// Rows of the first episodes again and again, under other numbers, keys and seeds: table by table, without a log, and
// indexed at the end.
void multiply(const std::filesystem::path& out, std::int64_t episodes) {
  const std::filesystem::path few = out.string() + ".few";
  std::filesystem::copy_file(out, few, std::filesystem::copy_options::overwrite_existing);
  {
    const sql::Database database(out.string(), SQLITE_OPEN_READWRITE, out.string());
    database.attach(few.string(), "few");
    database.run("PRAGMA journal_mode = MEMORY; PRAGMA synchronous = OFF; PRAGMA cache_size = -500000; BEGIN");
    const std::int64_t stored = database.number("SELECT count(*) FROM episode");
    database.run("CREATE TEMP TABLE copy AS WITH RECURSIVE n (id) AS (SELECT " + std::to_string(stored + 1) +
                 " UNION ALL SELECT id + 1 FROM n WHERE id < " + std::to_string(episodes) + ") SELECT id, (id - 1) % " +
                 std::to_string(stored) + " + 1 AS source FROM n");
    std::vector<std::string> drops;
    sql::Statement indexes(database, "SELECT name FROM sqlite_master WHERE type = 'index' AND sql IS NOT NULL");
    for (indexes.start(); indexes.step();) indexes.read(drops.emplace_back());
    for (const std::string& name : drops) database.run("DROP INDEX " + name);
    for (const Table& table : current_tables()) {
      if (!table.of_episode) continue;
      const std::string& name = table.name;
      const std::string number = name == "episode" ? "id" : "episode";
      std::string taken;
      for (const std::string& column : table.columns)
        taken += name != "episode"  ? ", t." + column
                 : column == "key"  ? ", 'copy ' || c.id"
                 : column == "seed" ? ", c.id"
                                    : ", t." + column;
      database.run("INSERT INTO " + name + " (" + number + ", " + quoted_columns(table.columns) + ") SELECT c.id" +
                   taken + " FROM temp.copy c CROSS JOIN few." + name + " t ON t." + number + " = c.source");
    }
    database.run("COMMIT");
  }
  std::filesystem::remove(few);
  Catalogue::write(out).close();  // with indexes
  sql::Database(out.string(), SQLITE_OPEN_READWRITE, out.string())
      .run("PRAGMA analysis_limit = 1000; ANALYZE");  // as a run does when it closes the file
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

// Of one episode: `which` orders them.
void ask_points(const Catalogue& catalogue, const char* which) {
  const auto found = catalogue.query(std::string("SELECT episode, task, duration_s FROM episodes ORDER BY ") + which +
                                     ", episode LIMIT 1");
  const auto episode = std::get<std::int64_t>(found.rows.at(0).at(0));
  std::printf("\nepisode %lld, %s, %.1f s\n", static_cast<long long>(episode),
              std::get<std::string>(found.rows[0][1]).c_str(), std::get<double>(found.rows[0][2]));
  for (const SqlFile& view : embedded_views())
    if (view.name != "coverage")
      ask(catalogue, view.name.c_str(), "SELECT * FROM " + view.name + " WHERE episode = ?1", {episode});
  std::printf("%-34s %9.3f s\n", "read_episode", seconds_of([&] { catalogue.read_episode(episode); }));
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
    store(words[1], out);
    const double time = seconds_of([&] { multiply(out, episodes); });
    std::printf("multiplied: %.0f s, %.1f kB an episode\n", time,
                1e-3 * static_cast<double>(std::filesystem::file_size(out)) / static_cast<double>(episodes));
  }
  const Catalogue catalogue = Catalogue::open(out);
  for (const NamedQuery& query : named_queries()) ask(catalogue, query.name.c_str(), query.name);
  // The longest, and one of the length of most.
  ask_points(catalogue, "frames DESC");
  ask_points(catalogue, "abs(frames - (SELECT avg(frames) FROM episode))");
  ask(catalogue, "steps of 80,000 frames", "SELECT * FROM steps LIMIT 80000");
  return 0;
}
