// A sensor of one's own: how far it is from the hand to what is below it, sixty times a second.
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <stampede/session.h>

namespace {

constexpr double kReach = 2.0;  // m

// Reads the simulator, and nothing else: so episodes repeat.
std::vector<double> look_down(const stampede::SimulatorView& now) {
  std::array<double, 3> from = now.pose("panda.hand").position;
  from[2] -= 0.01;  // from below the ends of the fingers
  const std::array<double, 3> to = {from[0], from[1], from[2] - kReach};
  return {now.distance(from, to).value_or(kReach), now.joint_effort("panda.joint2")};
}

}  // namespace

int main() {
  std::filesystem::remove("sensor.db");
  stampede::Session session({.catalogue = "sensor.db"});
  session.add_sensor("below", {.unit = "m, N m",
                               .components = {"distance", "shoulder"},
                               .rate_hz = 60,
                               .version = "1",
                               .read = look_down});
  const stampede::Episode e = session.run("pick_and_lift", {.seed = 7});

  // It is recorded: an array with a row a sample, and when each was taken.
  const stampede::EpisodeArrays arrays = session.arrays(e, {{"sensor/below", "sensor_time/below"}});
  const stampede::ArrayColumn &below = arrays.column("sensor/below"), &time = arrays.column("sensor_time/below");
  const std::int64_t samples = below.shape[0];
  if (below.rate_hz != 60 || below.labels[0] != "distance" || samples != 3 * (e.frames - 1)) return 1;
  double nearest = kReach;
  for (std::size_t i = 0; i < below.reals().size(); i += 2) nearest = std::min(nearest, below.reals()[i]);
  std::printf("%d samples in %.2f s, the nearest %.3f m\n", static_cast<int>(samples), time.reals().back(), nearest);
  if (nearest > 0.1) return 2;

  // The catalogue has the same numbers.
  const stampede::Rows rows = session.query(
      "SELECT count(*) AS n, min(value) AS nearest FROM sensors WHERE sensor = 'below' AND name = 'distance'");
  if (rows.integer(0, "n") != samples || rows.real(0, "nearest") != nearest) return 3;

  // An agent observes it beside the other channels.
  stampede::Environment world = session.environment("pick_and_lift", {.channels = {"gripper_pose", "sensor/below"}});
  if (!std::isnan(world.reset({.seed = 7})["sensor/below"].reals()[0])) return 4;  // it has not been read yet
  const stampede::StepResult now = world.step({.space = "tool_path_delta", .values = {0.1, 0, -0.1, 0, 0, 0}});
  std::printf("%.3f m below the hand\n", now.observation["sensor/below"].reals()[0]);
  return now.refusal ? 5 : 0;
}
