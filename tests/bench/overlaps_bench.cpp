// How deep things lie in each other in the episodes of catalogues: overlaps_bench FILE.db...
#include <algorithm>
#include <cstdio>
#include <map>

#include "db/catalogue.h"
#include "tests/support/overlap.h"

using namespace stampede;

namespace {

struct Row {
  int episodes = 0, successes = 0;
  std::array<int, test::kOverlapKinds.size()> bad{};            // episodes, by kind
  std::array<std::string, test::kOverlapKinds.size()> worst{};  // of each kind
  std::array<double, test::kOverlapKinds.size()> depth{};
};

void add(Row& row, const EpisodeRecord& episode) {
  ++row.episodes;
  row.successes += episode.outcome == Outcome::success;
  std::array<bool, test::kOverlapKinds.size()> seen{};
  for (const test::Overlap& overlap : test::overlaps_of(episode)) {
    const auto kind = static_cast<std::size_t>(overlap.kind);
    row.bad[kind] += !std::exchange(seen[kind], true);
    if (overlap.depth <= row.depth[kind]) continue;
    row.depth[kind] = overlap.depth;
    row.worst[kind] = "seed " + std::to_string(episode.seed) + " " + to_text(overlap);
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::map<std::string, Row> rows;
  for (int i = 1; i < argc; ++i) {
    const Catalogue catalogue = Catalogue::open(argv[i]);
    for (const EpisodeSummary& episode : catalogue.episodes())
      add(rows[episode.task], catalogue.read_episode(episode.id));
  }
  Row all;
  std::printf("%-38s %8s %8s", "episodes in which something overlaps", "episodes", "success");
  for (const char* kind : test::kOverlapKinds) std::printf(" %9s", kind);
  std::printf("\n");
  const auto print = [](const std::string& name, const Row& row) {
    std::printf("%-38s %8d %8d", name.c_str(), row.episodes, row.successes);
    for (const int bad : row.bad) std::printf(" %9d", bad);
    std::printf("\n");
  };
  for (const auto& [task, row] : rows) {
    print(task, row);
    for (const std::string& worst : row.worst)
      if (!worst.empty()) std::printf("    %s\n", worst.c_str());
    all.episodes += row.episodes;
    all.successes += row.successes;
    for (std::size_t kind = 0; kind < row.bad.size(); ++kind) all.bad[kind] += row.bad[kind];
  }
  print("all", all);
}
