// Baselines that say where things will be: nothing moves, all goes on as it does, and a linear model of the tip with
// what it carries.
#include <algorithm>
#include <cmath>
#include <map>

#include "scripting/research/baseline_functions.h"
#include "scripting/research/signals.h"

namespace stampede::research {
namespace {

constexpr std::int64_t kContextEvery = 40;
constexpr std::int64_t kHorizons[] = {1, 5, 20};  // frames

struct Body {
  Eigen::Vector3d now = Eigen::Vector3d::Zero(), step = Eigen::Vector3d::Zero();  // m; m a frame
  bool hand = false;
};

struct Context {
  std::int64_t episode = 0, frame = 0, frames = 0;
  std::map<std::string, Body> bodies;
  double force = 0;  // least of the pads', N
};

Eigen::Vector3d position_of(const Rows& rows, std::size_t i) {
  return {rows.real(i, "x"), rows.real(i, "y"), rows.real(i, "z")};
}

// Of every 40th frame what is there, and how it came from the frame before.
std::vector<Context> contexts_of(const PlainFile& given, const std::string& splits) {
  std::vector<Context> all;
  const Rows episodes =
      given.query("SELECT episode, frames, frame_hz FROM episodes WHERE split IN (" + splits + ") ORDER BY episode");
  for (std::size_t e = 0; e < episodes.size(); ++e) {
    const std::int64_t episode = episodes.integer(e, "episode");
    std::map<std::int64_t, Context> by_frame;
    const Rows hands =
        given.query("SELECT * FROM hands WHERE episode = ?1 AND frame % 40 = 0 ORDER BY frame", {episode});
    for (std::size_t i = 0; i < hands.size(); ++i) {
      Context& one = by_frame[hands.integer(i, "frame")];
      one.episode = episode, one.frame = hands.integer(i, "frame"), one.frames = episodes.integer(e, "frames");
      one.force = std::min(hands.real(i, "touch_1"), hands.real(i, "touch_2"));
      const Eigen::Vector3d speed(hands.real(i, "linear_x"), hands.real(i, "linear_y"), hands.real(i, "linear_z"));
      one.bodies[hands.text(i, "hand")] = {position_of(hands, i), speed / episodes.real(e, "frame_hz"), true};
    }
    const Rows poses =
        given.query("SELECT * FROM poses WHERE episode = ?1 AND frame % 40 IN (39, 0) ORDER BY frame", {episode});
    std::map<std::string, Eigen::Vector3d> before;
    for (std::size_t i = 0; i < poses.size(); ++i) {
      const std::string& object = poses.text(i, "object");
      const auto context = by_frame.find(poses.integer(i, "frame"));
      if (poses.integer(i, "frame") % kContextEvery != 0) {
        before[object] = position_of(poses, i);
      } else if (context != by_frame.end()) {
        Body& body = context->second.bodies[object];
        body.now = position_of(poses, i);
        if (const auto found = before.find(object); found != before.end()) body.step = body.now - found->second;
      }
    }
    for (auto& [frame, one] : by_frame) all.push_back(std::move(one));
  }
  return all;
}

template <typename Guess>  // of a context, a body and a horizon: how far it will have come
Answers predict(const PlainFile& given, Guess guess) {
  Answers answers;
  for (const Context& context : contexts_of(given, "'test'"))
    for (const std::int64_t horizon : kHorizons) {
      if (context.frame + horizon >= context.frames) continue;
      for (const auto& [name, body] : context.bodies) {
        const Eigen::Vector3d there = body.now + guess(context, body, horizon);
        answers.rows.rows.push_back({context.episode, context.frame + horizon, name, there.x(), there.y(), there.z()});
      }
    }
  return answers;
}

// How the tip moves, and how it is told to: along one axis (x, y and z are taken alike).
struct Asked {
  Eigen::Vector3d commanded = Eigen::Vector3d::Zero();  // from here, m
};

Asked asked_of(const PlainFile& given, const Context& context, const Eigen::Vector3d& now, std::int64_t horizon) {
  const Rows rows =
      given.query("SELECT action_x AS x, action_y AS y, action_z AS z FROM actions WHERE episode = ?1 AND frame = ?2",
                  {context.episode, context.frame + horizon - 1});
  if (rows.size() == 0 || rows.is_null(0, "x")) return {};
  return {position_of(rows, 0) - now};
}

const Body* hand_of(const Context& context) {
  for (const auto& [name, body] : context.bodies)
    if (body.hand) return &body;
  return nullptr;
}

Eigen::Vector2d inputs(const Body& hand, const Asked& asked, int axis) {
  return {hand.step(axis), asked.commanded(axis)};
}

// Weights for each horizon, from training episodes, in which every frame is given.
std::map<std::int64_t, Eigen::MatrixXd> learn_tip(const PlainFile& given) {
  std::map<std::int64_t, Eigen::MatrixXd> weights;
  const std::vector<Context> contexts = contexts_of(given, "'train', 'validation'");
  for (const std::int64_t horizon : kHorizons) {
    std::vector<Eigen::MatrixXd> features, targets;
    for (const Context& context : contexts) {
      const Body* hand = hand_of(context);
      const Rows later = given.query("SELECT x, y, z FROM hands WHERE episode = ?1 AND frame = ?2 ORDER BY hand",
                                     {context.episode, context.frame + horizon});
      if (!hand || later.size() == 0) continue;
      const Asked asked = asked_of(given, context, hand->now, horizon);
      const Eigen::Vector3d moved = position_of(later, 0) - hand->now;
      for (int axis = 0; axis < 3; ++axis) {
        features.emplace_back(inputs(*hand, asked, axis).transpose());
        targets.emplace_back(Eigen::MatrixXd::Constant(1, 1, moved(axis)));
      }
    }
    if (!features.empty()) weights[horizon] = ridge(stacked(features), stacked(targets), 1e-6);
  }
  return weights;
}

// A thing between the fingers, or one that went with them just now.
bool carried(const Context& context, const Body& hand, const Body& body) {
  constexpr double kNear = 0.06, kHeld = 1.0, kAlike = 0.002;  // m, N, m a frame
  if ((body.now - hand.now).norm() < kNear && context.force > kHeld) return true;
  return body.step.norm() > kAlike && (body.step - hand.step).norm() < kAlike && context.force > kHeld;
}

}  // namespace

Answers nothing_moves(const ResearchProblem&, const PlainFile& given) {
  return predict(given, [](const Context&, const Body&, std::int64_t) { return Eigen::Vector3d::Zero().eval(); });
}

Answers constant_velocity(const ResearchProblem&, const PlainFile& given) {
  return predict(given, [](const Context&, const Body& body, std::int64_t horizon) {
    return (body.step * static_cast<double>(horizon)).eval();
  });
}

Answers linear_tip(const ResearchProblem&, const PlainFile& given) {
  const auto weights = learn_tip(given);
  return predict(given, [&](const Context& context, const Body& body, std::int64_t horizon) -> Eigen::Vector3d {
    const Body* hand = hand_of(context);
    if (!hand || !weights.contains(horizon) || (!body.hand && !carried(context, *hand, body)))
      return Eigen::Vector3d::Zero();
    const Asked asked = asked_of(given, context, hand->now, horizon);
    Eigen::Vector3d moved;
    for (int axis = 0; axis < 3; ++axis)
      moved(axis) = apply_ridge(inputs(*hand, asked, axis).transpose(), weights.at(horizon))(0, 0);
    return moved;
  });
}

}  // namespace stampede::research
