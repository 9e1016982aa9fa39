// Environments: steps, resets, going back; `environment_bench soak N [TASK...]`: random actions and what must never
// happen; `threads`: two against one; `skills`: what acting by
// skills costs; `reward [TASK...]`: whether the dense reward rises along a demonstration.
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <fstream>
#include <numeric>
#include <string>
#include <thread>

#include "engine/base/error.h"
#include "engine/base/random.h"
#include "engine/episode/runner.h"
#include "engine/record/record.h"
#include "engine/sim/world.h"
#include "scripting/session/session_core.h"

namespace {

using namespace stampede;

constexpr double kSlack_rad = 1.1e-3;  // of joint limits

std::shared_ptr<SessionCore> scripts() {
  return std::make_shared<SessionCore>(STAMPEDE_SOURCE_DIR, std::vector<std::filesystem::path>{}, "");
}

// Of this process's CPU: other work on the machine does not count.
double seconds_since(std::clock_t begin) { return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC; }

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

AgentAction random_action(const ActionSpace& space, Random& random) {
  AgentAction action{.space = space.name};
  for (const ActionComponent& one : space.components) action.values.push_back(random.between(one.lower, one.upper));
  return action;
}

ActionSpace space_of(const Environment& world, const std::string& name) {
  const std::vector<ActionSpace> spaces = world.spaces();
  return *std::find_if(spaces.begin(), spaces.end(), [&](const ActionSpace& one) { return one.name == name; });
}

// CPU seconds of one step of random joint deltas, without the resets in between.
double step_s(Environment& world, int steps, std::int64_t seed) {
  world.reset({.seed = seed});
  const ActionSpace space = space_of(world, "joint_delta");
  Random random(RandomKey("steps").with(seed));
  double spent = 0;
  for (int i = 0; i < steps; ++i) {
    const AgentAction action = random_action(space, random);
    const std::clock_t begin = std::clock();
    const StepResult now = world.step(action);
    spent += seconds_since(begin);
    if (now.terminated || now.truncated) world.reset({.seed = ++seed});
  }
  return spent / steps;
}

// The same commands to the same scene, and nothing but the world's own steps: CPU seconds of each frame.
std::vector<double> bare_frames_s(const EpisodeRecord& episode) {
  World world(std::make_shared<const Scene>(scene_from_document(episode.scene.document)));
  world.keep_log(false);
  std::vector<double> frames;
  std::size_t next = 0;
  while (frames.size() + 1 < episode.frames.size()) {
    const std::clock_t begin = std::clock();
    for (int i = 0; i < episode.physics_hz / episode.frame_hz; ++i) {
      for (; next < episode.commands.size() && episode.commands[next].step == world.step_count(); ++next)
        world.apply(episode.commands[next].operation);
      world.step();
    }
    frames.push_back(seconds_since(begin));
  }
  return frames;
}

double bare_frame_s(const EpisodeRecord& episode) {
  const std::vector<double> frames = bare_frames_s(episode);
  return std::accumulate(frames.begin(), frames.end(), 0.0) / static_cast<double>(frames.size());
}

void measure() {
  const auto session = scripts();
  Environment plain = session->environment("reach_target", {});
  std::vector<double> steps, bare;
  for (std::int64_t round = 0; round < 5; ++round) {  // in turn: a slow phase of the machine meets both
    steps.push_back(step_s(plain, 400, round));
    Environment recorded = session->environment("reach_target", {.horizon_s = 1000, .record = true});
    step_s(recorded, 400, round);
    bare.push_back(bare_frame_s(*recorded.episode().record));
  }
  std::printf("reach_target, joint_delta: %.0f steps/s; bare physics: %.0f %% of a step\n", 1 / median(steps),
              100 * median(bare) / median(steps));

  EnvironmentSettings seeing{.width = 128, .height = 128};
  for (const char* camera : {"front", "left_shoulder", "right_shoulder", "overhead", "wrist"})
    seeing.channels.push_back(std::string(camera) + "_rgb");
  Environment eyes = session->environment("reach_target", seeing);
  step_s(eyes, 20, 100);  // the first picture starts the renderer
  steps.clear();
  for (std::int64_t round = 0; round < 5; ++round) steps.push_back(step_s(eyes, 100, round));
  std::printf("with five rgb cameras of 128 x 128: %.0f steps/s\n", 1 / median(steps));

  for (const char* task : {"reach_target", "stack_blocks"}) {
    Environment world = session->environment(task, {});
    std::vector<double> resets;
    for (std::int64_t seed = 0; seed < 30; ++seed) {
      const std::clock_t begin = std::clock();
      world.reset({.seed = seed});
      resets.push_back(1000 * seconds_since(begin));
    }
    std::printf("%s: reset %.1f ms, the median of 30\n", task, median(resets));
  }

  Environment blocks = session->environment("stack_blocks", {});
  blocks.reset({.seed = 1});
  const ActionSpace space = space_of(blocks, "joint_delta");
  Random random(RandomKey("branches"));
  std::vector<double> branches;
  for (int i = 0; i < 200; ++i) {
    const std::clock_t begin = std::clock();
    const SavedState here = blocks.save();
    blocks.restore(here);
    branches.push_back(1000 * seconds_since(begin));
    blocks.step(random_action(space, random));
  }
  std::printf("stack_blocks: save and restore %.2f ms, the median of 200\n", median(branches));
}

// What acting by skills costs beside physics: whole skills of the plan, a frame at a time. A few frames plan the motion
// that follows, so the median of what is left after physics is what acting itself costs.
void skills() {
  const auto session = scripts();
  for (const char* task : {"reach_target", "push_buttons", "stack_blocks"}) {
    std::vector<double> beside, begins;
    for (std::int64_t seed = 0; seed < 3; ++seed) {
      Environment world = session->environment(task, {.record = true});
      world.reset({.seed = seed});
      std::vector<double> frames;
      const auto timed = [&](const AgentAction& action) {
        const std::clock_t begin = std::clock();
        const StepResult now = world.step(action);
        frames.insert(frames.end(), static_cast<std::size_t>(now.frames), 1000 * seconds_since(begin));
        return now;
      };
      for (const TaskPlanStep& call : session->plan(task, {.seed = seed}).steps) {
        StepResult now = timed({.space = "skill", .frames = 1, .skill = call.action, .arguments = call.arguments});
        if (!frames.empty()) begins.push_back(frames.back());
        while (!now.running.empty()) now = timed({.space = "go_on", .frames = 1});
        if (now.terminated || now.truncated || now.refusal) break;
      }
      const std::vector<double> bare = bare_frames_s(*world.episode().record);
      for (std::size_t i = 0; i < std::min(frames.size(), bare.size()); ++i)
        beside.push_back(frames[i] - 1000 * bare[i]);
    }
    std::printf(
        "%s: a frame of a skill costs %.3f ms beside its physics; a skill's first frame, planning included, %.1f\n",
        task, median(beside), median(begins));
  }
}

void threads() {
  constexpr int kSteps = 3000;
  const auto session = scripts();
  const auto drive = [&](std::int64_t seed) {
    Environment world = session->environment("reach_target", {});
    step_s(world, kSteps, seed);
  };
  const auto wall_s = [](const auto& work) {
    const auto begin = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  };
  std::vector<double> ratios;
  for (int round = 0; round < 5; ++round) {
    // The same two, one after the other: their episodes do not cost the same.
    const double one = wall_s([&] { drive(1), drive(2); }) / 2;
    const double two = wall_s([&] {
      std::thread left([&] { drive(1); }), right([&] { drive(2); });
      left.join();
      right.join();
    });
    ratios.push_back(2 * one / two);
    std::printf("one: %.0f steps/s, two: %.0f steps/s, %.2f x\n", kSteps / one, 2 * kSteps / two, ratios.back());
  }
  std::printf("median %.2f x\n", median(ratios));
}

double resident_mb() {
  std::int64_t all = 0, resident = 0;
  std::ifstream("/proc/self/statm") >> all >> resident;
  return static_cast<double>(resident * sysconf(_SC_PAGESIZE)) / 1e6;
}

// A skill of the list, feasible or not, with what it takes drawn within its finite bounds.
AgentAction random_skill(const Environment& world, Random& random) {
  const std::vector<SkillChoice> choices = world.skills();
  const SkillChoice& one = choices[static_cast<std::size_t>(random.below(static_cast<std::int64_t>(choices.size())))];
  AgentAction action{.space = "skill", .skill = one.skill, .arguments = one.arguments};
  for (const SkillDescription& described : world.skill_descriptions()) {
    if (described.skill != one.skill) continue;
    for (const SkillParameterInfo& parameter : described.continuous) {
      SkillParameter drawn{parameter.name, {}};
      for (std::size_t i = 0; i < std::min(parameter.lower.size(), parameter.upper.size()); ++i)
        drawn.values.push_back(std::isfinite(parameter.upper[i] - parameter.lower[i])
                                   ? random.between(parameter.lower[i], parameter.upper[i])
                                   : std::nan(""));
      const bool finite =
          std::all_of(drawn.values.begin(), drawn.values.end(), [](double v) { return !std::isnan(v); });
      if (finite && !drawn.values.empty() && random.below(2) == 0) action.parameters.push_back(std::move(drawn));
    }
  }
  return action;
}

// Acts at random, and looks at all that comes back.
struct Soak {
  Environment world;
  std::string task;
  Random random;
  std::int64_t seed = 0, acted = 0, skills = 0, done = 0, refused = 0, frames = 0, episodes = 0, wrong = 0;

  Soak(Environment world_in, const std::string& name, std::int64_t first_seed)
      : world(std::move(world_in)),
        task(name),
        random(RandomKey("soak").with(name).with(first_seed)),
        seed(first_seed) {
    begin();
  }

  void begin() {
    ++episodes;
    look(world.reset({.seed = seed++}));
  }

  void fail(const std::string& what, const AgentAction& action) {
    ++wrong;
    std::string text = action.space + " " + action.skill;
    for (const std::string& argument : action.arguments) text += " " + argument;
    for (const double value : action.values) text += " " + std::to_string(value);
    std::printf("%s seed %lld, action %lld: %s: %s\n", task.c_str(), static_cast<long long>(seed - 1),
                static_cast<long long>(acted), text.c_str(), what.c_str());
  }

  void look(const EnvironmentObservation& now, const AgentAction& action = {}) {
    for (const ChannelValue& one : now.channels)
      for (const double value : one.reals())
        if (!std::isfinite(value)) return fail(one.name + " is no number", action);
    const std::vector<double>& q = now["joint_positions"].reals();
    const std::vector<ActionComponent> limits = world.spaces().front().components;
    for (std::size_t j = 0; j < limits.size(); ++j)
      if (q[j] < limits[j].lower - kSlack_rad || q[j] > limits[j].upper + kSlack_rad)
        return fail(limits[j].name + " is at " + std::to_string(q[j]), action);
  }

  // False: the episode has ended.
  bool act() {
    const std::vector<ActionSpace> spaces = world.spaces();
    const std::int64_t space = acted % static_cast<std::int64_t>(spaces.size());
    AgentAction action =
        acted % 50 == 49 ? random_skill(world, random) : random_action(spaces[static_cast<std::size_t>(space)], random);
    if (action.space == "skill" && action.skill.empty()) action = random_skill(world, random), action.frames = 1;
    if (action.space == "go_on") action.frames = 5;
    ++acted;
    StepResult now;
    try {
      now = world.step(action);
    } catch (const std::exception& error) {
      fail(error.what(), action);
      return false;
    }
    frames += now.frames;
    refused += now.refusal ? 1 : 0;
    skills += action.space == "skill" && action.frames == 0 ? 1 : 0;
    for (const SkillEnd& end : now.ended) done += !end.arguments.empty() && end.success ? 1 : 0;
    if (now.refusal && now.frames != 0) fail("refused, and yet frames went by: " + now.refusal->what, action);
    if (!std::isfinite(now.reward)) fail("the reward is no number", action);
    look(now.observation, action);
    return !now.terminated && !now.truncated;
  }
};

bool soak(const std::string& task, std::int64_t count, SessionCore& session) {
  Soak plain(session.environment(task, {.hidden = true}), task, 0);
  const std::clock_t begin = std::clock();
  double quarter = 0;
  const std::int64_t all = count + count / 50;
  while (plain.acted < all) {
    if (!plain.act()) plain.begin();
    if (plain.acted == all / 4) quarter = resident_mb();
  }
  const double end = resident_mb(), spent = seconds_since(begin);
  Soak kept(session.environment(task, {.hidden = true, .reward = RewardKind::dense, .record = true}), task, 1000);
  while (kept.acted < 200 && kept.act()) {
  }
  const std::string difference = replay_episode(*kept.world.episode().record);
  std::printf(
      "%-38s %6lld actions, %5lld refused, %4lld skills, %4lld done, %4lld episodes, %7lld frames, %5.1f s, "
      "%.0f to %.0f MB; %lld wrong; replay of %lld: %s\n",
      task.c_str(), static_cast<long long>(plain.acted), static_cast<long long>(plain.refused),
      static_cast<long long>(plain.skills), static_cast<long long>(plain.done), static_cast<long long>(plain.episodes),
      static_cast<long long>(plain.frames), spent, quarter, end, static_cast<long long>(plain.wrong + kept.wrong),
      static_cast<long long>(kept.acted), difference.empty() ? "equal" : difference.c_str());
  std::fflush(stdout);
  return plain.wrong + kept.wrong == 0 && difference.empty();
}

// Ranks from 0, the mean of them where values are equal.
std::vector<double> ranks(const std::vector<double>& values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  std::vector<double> result(values.size());
  for (std::size_t i = 0; i < order.size();) {
    std::size_t end = i;
    while (end < order.size() && values[order[end]] == values[order[i]]) ++end;
    for (std::size_t k = i; k < end; ++k) result[order[k]] = static_cast<double>(i + end - 1) / 2;
    i = end;
  }
  return result;
}

// Spearman's: with the time, which is the place.
double rank_correlation(const std::vector<double>& values) {
  const std::vector<double> rank = ranks(values);
  const double mean = static_cast<double>(values.size() - 1) / 2;
  double both = 0, one = 0, time = 0;
  for (std::size_t i = 0; i < rank.size(); ++i) {
    const double a = rank[i] - mean, b = static_cast<double>(i) - mean;
    both += a * b, one += a * a, time += b * b;
  }
  return one > 0 ? both / std::sqrt(one * time) : 0;
}

// The skills of an episode that nobody called from within another one.
std::vector<AgentAction> calls_of(const EpisodeRecord& episode) {
  std::vector<AgentAction> calls;
  for (const SegmentRecord& one : episode.labels.segments) {
    if (one.kind != SegmentKind::skill) continue;
    if (episode.labels.segments.at(static_cast<std::size_t>(one.parent)).kind != SegmentKind::subgoal) continue;
    const std::string name = one.case_name.empty() ? one.skill : one.skill + "_" + one.case_name;
    calls.push_back({.space = "skill", .frames = 1, .skill = name, .arguments = one.arguments});
  }
  return calls;
}

std::string told(const AgentAction& call) {
  std::string text = "(" + call.skill;
  for (const std::string& argument : call.arguments) text += " " + argument;
  return text + ")";
}

void reward(const std::string& task, SessionCore& session) {
  Episode run;
  for (std::int64_t seed = 7; run.outcome != Outcome::success && seed < 12; ++seed)
    run = session.run(task, {.seed = seed, .on_failure = OnFailure::stop});
  if (run.outcome != Outcome::success) {
    std::printf("%-38s no run succeeds: %s\n", task.c_str(), run.detail.c_str());
    return;
  }
  Environment world = session.environment(task, {.channels = {}, .reward = RewardKind::dense});
  world.reset({.seed = run.seed});
  std::vector<double> rewards;
  std::string parts;
  bool over = false;
  std::vector<AgentAction> calls = calls_of(*run.record);
  calls.push_back({.space = "hold", .frames = 1});
  for (const AgentAction& call : calls) {
    const std::size_t before = rewards.size();
    StepResult now = world.step(call);
    if (now.frames > 0) rewards.push_back(now.reward);
    while (!now.running.empty() && !over) {
      now = world.step({.space = "go_on", .frames = 1});
      if (now.frames > 0) rewards.push_back(now.reward);
      over = now.terminated || now.truncated;
    }
    const std::vector<double> own(rewards.begin() + static_cast<std::ptrdiff_t>(before), rewards.end());
    if (own.empty()) continue;
    char line[160];
    std::snprintf(line, sizeof line, " %zu frames, %.3f to %.3f, at least %.3f, at most %.3f, %.2f\n", own.size(),
                  own.front(), own.back(), *std::min_element(own.begin(), own.end()),
                  *std::max_element(own.begin(), own.end()), rank_correlation(own));
    parts += "    " + (call.space == "skill" ? told(call) : call.space) + line;
    if (now.refusal) parts += "      refused: " + now.refusal->what + "\n";
    for (const SkillEnd& end : now.ended)
      if (!end.success) parts += "      failed: " + end.reason + " " + end.detail + "\n";
  }
  const double correlation = rank_correlation(rewards);
  std::printf("%-38s seed %lld, %4zu frames, correlation %5.2f, %.3f at first, %.3f at last\n", task.c_str(),
              static_cast<long long>(run.seed), rewards.size(), correlation, rewards.front(), rewards.back());
  if (correlation < 0.8 || rewards.back() != 1) std::fputs(parts.c_str(), stdout);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  const auto is = [&](const char* mode) { return argc > 1 && std::strcmp(argv[1], mode) == 0; };
  try {
    if (argc < 2) return measure(), 0;
    if (is("threads")) return threads(), 0;
    if (is("skills")) return skills(), 0;
    const int named = is("soak") ? 3 : 2;
    if (argc < named || (!is("soak") && !is("reward"))) {
      std::fputs("environment_bench [soak N [TASK...] | threads | skills | reward [TASK...]]\n", stderr);
      return 2;
    }
    const auto session = scripts();
    std::vector<std::string> tasks(argv + named, argv + argc);
    if (tasks.empty()) tasks = session->tasks();
    bool good = true;
    for (const std::string& task : tasks) {
      if (is("soak"))
        good = soak(task, std::stoll(argv[2]), *session) && good;
      else
        reward(task, *session);
    }
    return good ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 3;
  }
}
