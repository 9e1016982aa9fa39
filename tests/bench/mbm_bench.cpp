// MotionBenchMaker's problems for the Panda (Chamzas et al., IEEE RA-L 2022, doi:10.1109/LRA.2021.3133603) by
// plan_path: search, shortening and certification.
// mbm_bench [PROBLEMS.json] [--json OUT.json] [--repeat N] [--every N] [--planner ompl:NAME|all]
// --every: each Nth problem alone; --planner all: a row for each planner.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "engine/motion/planner.h"
#include "engine/sim/world.h"
#include "tests/support/panda.h"

namespace {

using namespace stampede;
using Json = nlohmann::json;

constexpr double kFinger = 0.065;  // m each, as in the problems: beyond the Panda's own stroke

Robot wide_panda() {
  Robot robot = panda_robot();
  const double lower[] = {-2.9671, -1.8326, -2.9671, -3.1416, -2.9671, -0.0873, -2.9671};
  const double upper[] = {2.9671, 1.8326, 2.9671, 0.0873, 2.9671, 3.8223, 2.9671};
  for (std::size_t j = 0; j < robot.arm.size(); ++j) {
    robot.limits[j].lower = lower[j];
    robot.limits[j].upper = upper[j];
  }
  for (const int finger : robot.fingers) robot.body.parts[static_cast<std::size_t>(finger)].joint.upper = kFinger;
  robot.opening_max = 2 * kFinger;
  return robot;
}

Scene scene_of(const Json& problem) {
  Scene scene;
  scene.robot = wide_panda();
  for (const Json& obstacle : problem["obstacles"]) {
    Body body;
    body.name = obstacle["id"].get<std::string>() + std::to_string(scene.bodies.size());
    const auto size = obstacle["dimensions"].get<std::vector<double>>();
    const auto at = obstacle["position"].get<std::vector<double>>();
    const auto turn = obstacle["quaternion_xyzw"].get<std::vector<double>>();
    body.world_from_body =
        make_transform({at[0], at[1], at[2]}, Quaternion(turn[3], turn[0], turn[1], turn[2]).normalized());
    Shape shape;
    if (obstacle["type"] == "box") {
      shape.kind = ShapeKind::box;
      shape.size = {size[0], size[1], size[2]};
    } else {
      shape.kind = ShapeKind::cylinder;
      shape.length = size[0];
      shape.radius = size[1];
    }
    Part part;
    part.name = body.name;
    part.shapes.push_back(shape);
    body.parts.push_back(part);
    scene.bodies.push_back(body);
  }
  return scene;
}

JointVector joints(const Json& values) {
  JointVector q(static_cast<Eigen::Index>(values.size()));
  for (std::size_t j = 0; j < values.size(); ++j) q[static_cast<Eigen::Index>(j)] = values[j].get<double>();
  return q;
}

double length(const std::vector<JointVector>& path) {
  double sum = 0;
  for (std::size_t i = 1; i < path.size(); ++i) sum += (path[i] - path[i - 1]).norm();
  return sum;
}

bool touches(const CollisionState& state, const std::vector<JointVector>& path, double step_rad) {
  for (std::size_t i = 1; i < path.size(); ++i) {
    const int count = std::max(1, static_cast<int>((path[i] - path[i - 1]).cwiseAbs().maxCoeff() / step_rad) + 1);
    for (int k = 0; k <= count; ++k)
      if (!state.free(path[i - 1] + (static_cast<double>(k) / count) * (path[i] - path[i - 1]))) return true;
  }
  return false;
}

double share(std::vector<double> values, double which) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  return values[std::min(values.size() - 1, static_cast<std::size_t>(which * static_cast<double>(values.size())))];
}

struct Tally {
  int problems = 0, ends_free = 0, solved = 0, touching = 0;
  std::vector<double> ms, lengths;
};

void print_row(const std::string& name, const Tally& tally) {
  std::printf("%-18s %8d %9d %6d %9.2f %8.2f %7.2f %8d\n", name.c_str(), tally.problems, tally.ends_free, tally.solved,
              share(tally.ms, 0.5), share(tally.ms, 0.95), share(tally.lengths, 0.5), tally.touching);
  std::fflush(stdout);
}

struct Answers {
  std::map<std::string, Tally> tallies;  // by set of problems, and "all"
  Json each = Json::array();
};

Answers answer(const Json& problems, const MotionLimits& limits, int repeat) {
  Answers answers;
  for (const Json& problem : problems) {
    const World world(std::make_shared<const Scene>(scene_of(problem)));
    CollisionState state = world.collision_state();
    state.set_opening(2 * kFinger);
    const JointVector start = joints(problem["start"]), goal = joints(problem["goal"]);
    const bool ends_free = state.free(start) && state.free(goal);
    std::vector<double> ms;
    JointPath found;
    for (int i = 0; i < repeat; ++i) {
      const auto before = std::chrono::steady_clock::now();
      found = plan_path({state, start, limits, RandomKey("mbm").with(problem["id"].get<int>())}, goal);
      ms.push_back(1e3 * std::chrono::duration<double>(std::chrono::steady_clock::now() - before).count());
    }
    const bool solved = found.reason == Reason::none;
    const std::string set = problem["set"];
    if (ends_free && !solved && limits.planner.empty())
      std::fprintf(stderr, "%s %d: %s\n", set.c_str(), problem["id"].get<int>(), found.detail.c_str());
    answers.each.push_back({{"set", set},
                            {"id", problem["id"]},
                            {"ends_free", ends_free},
                            {"solved", solved},
                            {"ms", share(ms, 0.5)},
                            {"length", solved ? length(found.waypoints) : 0}});
    for (const std::string& name : {set, std::string("all")}) {
      Tally& tally = answers.tallies[name];
      ++tally.problems;
      tally.ends_free += ends_free;
      if (!ends_free) continue;
      tally.ms.push_back(share(ms, 0.5));
      if (!solved) continue;
      ++tally.solved;
      tally.lengths.push_back(length(found.waypoints));
      tally.touching += touches(state, found.waypoints, 0.0025);
    }
  }
  return answers;
}

}  // namespace

int main(int count, char** words) {
  std::string path = "../shared/data/mbm_panda_dev.json", out, planner;
  int repeat = 1, every = 1;
  for (int i = 1; i < count; ++i) {
    if (std::strcmp(words[i], "--json") == 0 && i + 1 < count)
      out = words[++i];
    else if (std::strcmp(words[i], "--repeat") == 0 && i + 1 < count)
      repeat = std::max(1, std::atoi(words[++i]));
    else if (std::strcmp(words[i], "--every") == 0 && i + 1 < count)
      every = std::max(1, std::atoi(words[++i]));
    else if (std::strcmp(words[i], "--planner") == 0 && i + 1 < count)
      planner = words[++i];
    else
      path = words[i];
  }
  if (!std::filesystem::exists(path)) {
    std::fprintf(stderr, "%s is not there: give a file of MotionBenchMaker's problems\n", path.c_str());
    return 0;
  }
  const Json file = Json::parse(std::ifstream(path));
  Json problems = Json::array();
  for (std::size_t i = 0; i < file["problems"].size(); i += static_cast<std::size_t>(every))
    problems.push_back(file["problems"][i]);
  std::printf("%-18s %8s %9s %6s %9s %8s %7s %8s\n", planner == "all" ? "planner" : "set", "problems", "ends free",
              "solved", "median ms", "95 % ms", "rad", "touching");
  MotionLimits limits;
  if (planner == "all") {
    print_row("our own", answer(problems, limits, repeat).tallies["all"]);
    for (const std::string& name : motion_planner_names()) {
      limits.planner = name;
      print_row(name, answer(problems, limits, repeat).tallies["all"]);
    }
    return 0;
  }
  check_motion_planner(planner, "--planner");
  limits.planner = planner;
  const Answers answers = answer(problems, limits, repeat);
  for (const auto& [name, tally] : answers.tallies) print_row(name, tally);
  if (!out.empty()) std::ofstream(out) << Json{{"problems", answers.each}}.dump(1) << '\n';
}
