// Pictures to PNG files: time and size for each kind, and for a frame of five cameras.
#include <benchmark/benchmark.h>

#include "engine/render/png.h"
#include "engine/render/point_cloud.h"
#include "engine/render/sensor_noise.h"
#include "tests/engine/render/traced.h"

using namespace stampede;

namespace {

constexpr int kCameras = 5;

std::vector<Picture> frame(int side) {
  std::vector<Picture> pictures;
  for (int i = 0; i < kCameras; ++i) pictures.push_back(TracedScene().draw(TracedScene::view(i, side, side)));
  return pictures;
}

// Of one camera: the mean over five.
void encode_kind(benchmark::State& state) {
  const auto kind = static_cast<PictureKind>(state.range(0));
  const std::vector<Picture> pictures = frame(static_cast<int>(state.range(1)));
  std::size_t bytes = 0, camera = 0;
  for (auto _ : state) bytes += to_png(pictures[camera++ % kCameras], kind).size();
  state.counters["bytes"] = static_cast<double>(bytes) / static_cast<double>(state.iterations());
  state.SetLabel(std::string(to_string(kind)));
}
BENCHMARK(encode_kind)->ArgsProduct({{0, 1, 2, 3}, {128, 512}})->Unit(benchmark::kMicrosecond);

// All twenty pictures.
void encode_frame(benchmark::State& state) {
  const std::vector<Picture> pictures = frame(128);
  std::size_t bytes = 0;
  for (auto _ : state) {
    bytes = 0;
    for (const Picture& picture : pictures)
      for (const PictureKind kind : kPictureKinds) bytes += to_png(picture, kind).size();
  }
  state.counters["bytes"] = static_cast<double>(bytes);
}
BENCHMARK(encode_frame)->Unit(benchmark::kMicrosecond);

void decode_kind(benchmark::State& state) {
  const auto kind = static_cast<PictureKind>(state.range(0));
  const Bytes png = to_png(frame(128)[0], kind);
  Picture picture;
  for (auto _ : state) from_png(png, kind, picture);
  state.SetLabel(std::string(to_string(kind)));
}
BENCHMARK(decode_kind)->DenseRange(0, 3)->Unit(benchmark::kMicrosecond);

void noise(benchmark::State& state) {
  const Picture clean = frame(128)[0];
  const CameraNoise both{0.02, 0.00145};
  std::int64_t count = 0;
  for (auto _ : state) {
    Picture picture = clean;
    add_noise(picture, Camera(), both, RandomKey("bench").with(count++));
    benchmark::DoNotOptimize(picture);
  }
}
BENCHMARK(noise)->Unit(benchmark::kMicrosecond);

void cloud(benchmark::State& state) {
  View view = TracedScene::view(0);
  const Picture picture = TracedScene().draw(view);
  if (state.range(0) != 0) view.camera.distortion = {-0.2, 0.05, 0.001, 0.001, 0};
  for (auto _ : state) benchmark::DoNotOptimize(point_cloud(picture, view));
}
BENCHMARK(cloud)->Arg(0)->Arg(1)->Unit(benchmark::kMicrosecond);

}  // namespace

BENCHMARK_MAIN();
