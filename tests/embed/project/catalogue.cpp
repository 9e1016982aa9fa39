// What a trainer reads of a catalogue: its demonstrations, windows of numbers and pictures, the skill of each frame.
#include <cstdio>
#include <filesystem>
#include <stampede/catalogue_reader.h>
#include <stampede/session.h>

int main() {
  std::filesystem::remove("catalogue.db");
  stampede::Session session({.catalogue = "catalogue.db"});
  const stampede::PictureStorage front = {.cameras = {"front"}, .width = 64, .height = 48, .depth = false};
  session.run("pick_and_lift", {.seed = 7, .pictures = front});

  // From here on no script is needed, and the file may lie anywhere.
  const stampede::CatalogueReader demos("catalogue.db");
  const stampede::Rows found = demos.query("SELECT episode, frames FROM demos WHERE task = ?1", {"pick_and_lift"});
  if (found.size() != 1) return 1;
  const std::int64_t id = found.integer(0, "episode"), frames = found.integer(0, "frames");
  const stampede::EpisodeArrays arrays = demos.arrays(id, {{"joint_positions", "action/joint_position", "skill"}});

  constexpr std::int64_t kWindow = 16;
  std::int64_t windows = 0, bytes = 0;
  for (std::int64_t first = 0; first + kWindow <= frames; first += kWindow, ++windows) {
    std::vector<std::int64_t> rows;
    for (std::int64_t i = 0; i < kWindow; ++i) rows.push_back(first + i);
    const stampede::PictureFrames seen = demos.pictures(id, "front_rgb", {.frames = rows, .threads = 2});
    if (seen.shape != std::vector<std::int64_t>{kWindow, 48, 64, 3}) return 2;
    bytes += static_cast<std::int64_t>(std::get<std::vector<std::uint8_t>>(seen.data).size());
    const std::int64_t skill = arrays.column("skill").integers()[static_cast<std::size_t>(first)];
    const char* label = skill < 0 ? "-" : arrays.segments[static_cast<std::size_t>(skill)].label.c_str();
    std::printf("frames %3d on: joint 2 at %.2f rad, %s\n", static_cast<int>(first),
                arrays.column("joint_positions").reals()[static_cast<std::size_t>(7 * first + 1)], label);
  }
  if (windows == 0 || bytes != windows * kWindow * 48 * 64 * 3) return 3;

  // Depth was not stored: it is drawn now, at the size that is asked for, where the caller says so.
  try {
    demos.pictures(id, "front_depth", {.frames = {0}});
    return 4;
  } catch (const stampede::Error& error) {
    std::puts(error.what());
  }
  const stampede::PictureFrames drawn = demos.pictures(id, "front_depth", {.frames = {0, frames - 1}, .draw = true});
  return drawn.shape.front() == 2 && std::get<std::vector<float>>(drawn.data).front() >= 0 ? 0 : 5;
}
