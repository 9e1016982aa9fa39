// An episode in memory, without any catalogue: states, pictures and arrays of it; then the same from a file.
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <stampede/session.h>
#include <string>

namespace {

bool same(const stampede::EpisodeArrays& a, const stampede::EpisodeArrays& b) {
  if (a.columns.size() != b.columns.size()) return false;
  for (std::size_t i = 0; i < a.columns.size(); ++i) {
    if (a.columns[i].name != b.columns[i].name || a.columns[i].type() != b.columns[i].type()) return false;
    if (a.columns[i].type() != "float64") continue;
    const auto x = a.columns[i].reals(), y = b.columns[i].reals();
    if (x.size() != y.size()) return false;
    for (std::size_t k = 0; k < x.size(); ++k)
      if (x[k] != y[k] && !(std::isnan(x[k]) && std::isnan(y[k]))) return false;
  }
  return true;
}

template <typename Work>
bool refused(const Work& work, const char* why) {
  try {
    work();
    return false;
  } catch (const stampede::Error& error) {
    return std::string(error.what()).find(why) != std::string::npos;
  }
}

}  // namespace

int main() {
  std::filesystem::remove_all("memory");
  std::filesystem::create_directory("memory");
  std::filesystem::current_path("memory");
  stampede::Session session({});
  const stampede::Episode e = session.run("reach_target", {.seed = 7});
  if (!e.record || e.id != 0) return 1;

  const stampede::EpisodeArrays arrays = session.arrays(e);
  const auto joints = arrays.column("joint_positions");
  const auto tip = arrays.column("gripper_pose").reals();
  if (joints.shape != std::vector<std::int64_t>{e.frames, 7} || joints.unit != "rad") return 2;
  if (arrays.column("progress").reals().back() != 1 || arrays.column("skill").integers().size() != tip.size() / 7)
    return 3;

  // The state of the last frame is the last row.
  const stampede::WorldState last = session.state(e, e.frames - 1);
  for (const stampede::StatePose& pose : last.objects) {
    const auto column = arrays.column("object_pose/" + pose.object).reals();
    if (column[column.size() - 7] != pose.position[0]) return 4;
  }
  const stampede::CameraPicture picture = session.picture(e, 0, arrays.pictures.front().request());
  if (picture.rgb.size() != static_cast<std::size_t>(picture.width * picture.height * 3) || picture.rgb.empty())
    return 5;
  if (session.points(e, 0).positions.size() < 1000) return 6;

  // No file was made, and nothing is asked of a catalogue that is not there.
  if (!std::filesystem::is_empty(".")) return 7;
  if (!refused([&] { session.state(1, 0); }, "no catalogue")) return 8;
  if (!refused([&] { session.arrays(e, {{"joint_postions"}}); }, "joint_positions")) return 9;
  if (!refused([] { stampede::Session({.catalogue = ":memory:"}); }, "leave it empty")) return 10;
  if (std::filesystem::exists(":memory:")) return 11;

  std::filesystem::current_path("..");
  std::filesystem::remove("arrays.db");
  stampede::Session stored({.catalogue = "arrays.db"});
  const stampede::Episode again = stored.run("reach_target", {.seed = 7});
  if (again.record || again.id != 1 || !same(arrays, stored.arrays(again)) || !same(arrays, stored.arrays(1))) return 12;
  const stampede::Rows rows = stored.query("SELECT task, frames, duration_s FROM episodes");
  std::printf("%s, %d frames, %.2f s, %zu columns\n", rows.text(0, "task").c_str(),
              static_cast<int>(rows.integer(0, "frames")), rows.real(0, "duration_s"), arrays.columns.size());
  return rows.integer(0, "frames") == e.frames && refused([&] { rows.text(0, "frames"); }, "integer") ? 0 : 13;
}
