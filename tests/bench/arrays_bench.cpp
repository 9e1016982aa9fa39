// Episodes as arrays: from memory, and from a catalogue of 80,000 frames.
#include <benchmark/benchmark.h>

#include "engine/record/arrays.h"
#include "scripting/session/session_core.h"

using namespace stampede;

namespace {

constexpr std::int64_t kFrames = 80'000;

const EpisodeRecord& episode() {
  static const std::shared_ptr<const EpisodeRecord> record =
      SessionCore(STAMPEDE_SOURCE_DIR, {}, {}).run("put_item_in_drawer", {.seed = 7}).record;
  return *record;
}

// The same episode as often as it takes, each under a key of its own.
struct Filled {
  std::filesystem::path path = std::filesystem::temp_directory_path() / "stampede_arrays_bench.db";
  std::int64_t episodes = 0;
  Filled() {
    std::filesystem::remove(path);
    Catalogue catalogue = Catalogue::write(path);
    EpisodeRecord copy = episode();
    for (std::int64_t frames = 0; frames < kFrames; frames += static_cast<std::int64_t>(copy.frames.size())) {
      copy.made.key = "copy " + std::to_string(episodes);
      copy.seed = episodes;
      catalogue.add(copy, {"bench", "bench"});
      ++episodes;
    }
  }
  ~Filled() { std::filesystem::remove(path); }
};

const Filled& filled() {
  static const Filled file;
  return file;
}

void from_memory(benchmark::State& state) {
  std::int64_t frames = 0;
  for (auto _ : state) frames += episode_arrays(episode()).frames;
  state.counters["frames/s"] = benchmark::Counter(static_cast<double>(frames), benchmark::Counter::kIsRate);
}
BENCHMARK(from_memory)->Unit(benchmark::kMillisecond);

void from_catalogue(benchmark::State& state, const ArrayRequest& request) {
  const Catalogue catalogue = Catalogue::open(filled().path);
  for (auto _ : state) {
    std::int64_t frames = 0;
    for (std::int64_t id = 1; id <= filled().episodes; ++id) frames += catalogue.read_arrays(id, request).frames;
    state.counters["frames"] = static_cast<double>(frames);
  }
}
BENCHMARK_CAPTURE(from_catalogue, all, ArrayRequest{})->Unit(benchmark::kMillisecond)->Iterations(1);
BENCHMARK_CAPTURE(from_catalogue, joints_actions_skills,
                  ArrayRequest{{"joint_positions", "gripper_open", "gripper_pose", "action", "skill", "done"}})
    ->Unit(benchmark::kMillisecond)
    ->Iterations(1);
BENCHMARK_CAPTURE(from_catalogue, applicable, ArrayRequest{{"applicable"}})
    ->Unit(benchmark::kMillisecond)
    ->Iterations(1);

void whole_records(benchmark::State& state) {
  const Catalogue catalogue = Catalogue::open(filled().path);
  for (auto _ : state)
    for (std::int64_t id = 1; id <= filled().episodes; ++id)
      benchmark::DoNotOptimize(catalogue.read_episode(id).frames.size());
}
BENCHMARK(whole_records)->Unit(benchmark::kMillisecond)->Iterations(1);

}  // namespace

BENCHMARK_MAIN();
