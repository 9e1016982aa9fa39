// Baselines that say what will be: nothing changes, all goes on as it does, and a linear model of tip and joints with
// what the hand carries and the changes of facts of the nearest context that was trained.
#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <map>
#include <set>

#include "db/research/arm_joints.h"
#include "db/research/baselines/functions.h"
#include "db/research/check_dataset.h"
#include "db/research/known_columns.h"
#include "db/research/signals.h"
#include "db/research/symbols_of.h"

namespace stampede::research {
namespace {

constexpr std::int64_t kContextEvery = 40;
constexpr std::int64_t kHorizons[] = {1, 5, 20};  // frames

struct Body {
  Eigen::Vector3d now = Eigen::Vector3d::Zero(), step = Eigen::Vector3d::Zero();  // m; m a frame
  bool hand = false;
};

struct Joint {
  double now = 0, step = 0;  // rad or m; a frame
  int command = 0;           // which joint of the arm it is, 1 next to the base; 0: of a thing or finger
};

struct Context {
  std::int64_t episode = 0, frame = 0, frames = 0;
  std::map<std::string, Body> bodies;
  std::map<std::string, Joint> joints;
  std::set<Fact> facts;
  double force = 0, opening = 0;  // least of the pads', N; m
};

void read_joints(const PlainFile& given, double frame_hz, std::map<std::int64_t, Context>& by_frame) {
  if (by_frame.empty()) return;
  const std::int64_t episode = by_frame.begin()->second.episode;
  const int most = arm_joints_of(given).most;
  for (const auto& [table, arm_joint] : {std::pair{"joints", "arm_joint"}, {"object_joints", "NULL"}}) {
    const Rows rows =
        given.query(std::string("SELECT frame, joint, position, velocity, ") + arm_joint + " AS arm_joint FROM " +
                        table + " WHERE episode = ?1 AND frame % 40 = 0 ORDER BY frame, joint",
                    {episode});
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const auto context = by_frame.find(rows.integer(i, "frame"));
      if (context == by_frame.end() || rows.is_null(i, "position")) continue;
      const auto command = rows.is_null(i, "arm_joint") ? 0 : static_cast<int>(rows.integer(i, "arm_joint"));
      if (command > most)
        refuse_unfit(given, "the arm of episode " + std::to_string(episode) + " has more joints than table actions");
      const double velocity = rows.is_null(i, "velocity") ? 0 : rows.real(i, "velocity");  // of recorded fingers
      context->second.joints[rows.text(i, "joint")] = {rows.real(i, "position"), velocity / frame_hz, command};
    }
  }
}

std::set<Fact> facts_of(const PlainFile& given, std::int64_t episode, std::int64_t frame) {
  std::set<Fact> facts;
  const Rows rows = given.query(
      "SELECT fact FROM facts WHERE episode = ?1 AND first_frame <= ?2 AND end_frame > ?2 AND predicate_kind IN "
      "('basic', 'derived')",
      {episode, frame});
  for (std::size_t i = 0; i < rows.size(); ++i) facts.insert(fact_of(rows.text(i, "fact"), "table facts"));
  return facts;
}

Eigen::Vector3d position_of(const Rows& rows, std::size_t i) {
  return {rows.real(i, "x"), rows.real(i, "y"), rows.real(i, "z")};
}

// Of every 40th frame what is there, and how it came from the frame before.
std::vector<Context> contexts_of(const PlainFile& given, const std::string& splits) {
  const KnownColumns known(given, "hands");
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
      const auto number = [&](const char* column) { return known.real(hands, i, column); };
      one.force = std::min(number("touch_1"), number("touch_2"));
      one.opening = number("opening");
      const Eigen::Vector3d speed(number("linear_x"), number("linear_y"), number("linear_z"));
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
    read_joints(given, episodes.real(e, "frame_hz"), by_frame);
    for (auto& [frame, one] : by_frame) {
      one.facts = facts_of(given, episode, frame);
      all.push_back(std::move(one));
    }
  }
  return all;
}

// What a baseline says of a context: how far bodies and joints will have come, and which facts will hold.
struct Guesses {
  std::function<Eigen::Vector3d(const Context&, const Body&, std::int64_t horizon)> body;
  std::function<double(const Context&, const Joint&, std::int64_t horizon)> joint;
  std::function<std::set<Fact>(const Context&, std::int64_t horizon)> facts;
};

Answers predict(const PlainFile& given, const Guesses& guess) {
  Answers answers;
  const SqlValue no = std::monostate{};
  for (const Context& context : contexts_of(given, "'test'"))
    for (const std::int64_t horizon : kHorizons) {
      const std::int64_t frame = context.frame + horizon;
      if (frame >= context.frames) continue;
      for (const auto& [name, body] : context.bodies) {
        const Eigen::Vector3d at = body.now + guess.body(context, body, horizon);
        answers.rows.rows.push_back({context.episode, frame, name, at.x(), at.y(), at.z(), no, no, no});
      }
      for (const auto& [name, joint] : context.joints)
        answers.rows.rows.push_back(
            {context.episode, frame, no, no, no, no, name, joint.now + guess.joint(context, joint, horizon), no});
      for (const Fact& fact : guess.facts(context, horizon))
        answers.rows.rows.push_back({context.episode, frame, no, no, no, no, no, no, to_text(fact)});
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
std::map<std::int64_t, Eigen::MatrixXd> learn_tip(const PlainFile& given, const std::vector<Context>& contexts) {
  std::map<std::int64_t, Eigen::MatrixXd> weights;
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

// What is commanded at the end of a horizon: an opening (m) or a joint's position (rad); where none is, how it is now.
double commanded(const PlainFile& given, const Context& context, std::int64_t horizon, const std::string& column,
                 double now) {
  const Rows rows = given.query("SELECT " + column + " AS value FROM actions WHERE episode = ?1 AND frame = ?2",
                                {context.episode, context.frame + horizon - 1});
  return rows.size() == 0 || rows.is_null(0, "value") ? now : rows.real(0, "value");
}

Eigen::RowVector2d joint_inputs(const PlainFile& given, const Context& context, const Joint& joint,
                                std::int64_t horizon) {
  const std::string column = column_of_joint("action_j", joint.command);
  return {joint.step, joint.command == 0 ? 0 : commanded(given, context, horizon, column, joint.now) - joint.now};
}

// Weights for each horizon, of the arm's joints (taken alike) and of the others.
std::map<std::pair<std::int64_t, bool>, Eigen::MatrixXd> learn_joints(const PlainFile& given,
                                                                      const std::vector<Context>& contexts) {
  std::map<std::pair<std::int64_t, bool>, Eigen::MatrixXd> weights;
  for (const std::int64_t horizon : kHorizons) {
    std::map<bool, std::vector<Eigen::MatrixXd>> features, targets;
    for (const Context& context : contexts)
      for (const char* table : {"joints", "object_joints"}) {
        const Rows later = given.query(
            std::string("SELECT joint, position FROM ") + table + " WHERE episode = ?1 AND frame = ?2 ORDER BY joint",
            {context.episode, context.frame + horizon});
        for (std::size_t i = 0; i < later.size(); ++i) {
          const auto there = context.joints.find(later.text(i, "joint"));
          if (there == context.joints.end() || later.is_null(i, "position")) continue;
          const Joint& joint = there->second;
          features[joint.command > 0].emplace_back(joint_inputs(given, context, joint, horizon));
          targets[joint.command > 0].emplace_back(
              Eigen::MatrixXd::Constant(1, 1, later.real(i, "position") - joint.now));
        }
      }
    for (const auto& [arm, rows] : features)
      weights[{horizon, arm}] = ridge(stacked(rows), stacked(targets.at(arm)), 1e-6);
  }
  return weights;
}

// The thing that the hand is about to do something with: what it carries, or what is nearest to where it is told to go.
std::string handled(const Context& context, const Body& hand, const Asked& asked) {
  std::string nearest;
  double least = 0.2;  // m
  for (const auto& [name, body] : context.bodies) {
    if (body.hand) continue;
    const double distance = carried(context, hand, body) ? 0 : (body.now - hand.now - asked.commanded).norm();
    if (distance < least) least = distance, nearest = name;
  }
  return nearest;
}

// What a change of facts is foreseen by.
struct Situation {
  std::string thing;  // handled
  Eigen::RowVectorXd features;
};

Situation situation_of(const PlainFile& given, const Context& context, std::int64_t horizon) {
  Situation situation{"", Eigen::RowVectorXd::Zero(11)};
  const Body* hand = hand_of(context);
  if (!hand) return situation;
  const Asked asked = asked_of(given, context, hand->now, horizon);
  situation.thing = handled(context, *hand, asked);
  Eigen::Vector3d off = Eigen::Vector3d::Constant(0.2);
  bool holds = false;
  if (!situation.thing.empty()) {
    off = context.bodies.at(situation.thing).now - hand->now;
    holds = carried(context, *hand, context.bodies.at(situation.thing));
  }
  situation.features << context.opening, commanded(given, context, horizon, "action_gripper", context.opening),
      std::min(context.force, 1.0), hand->now.z(), hand->step.z(), asked.commanded.z(), asked.commanded.head(2).norm(),
      off.head(2).norm(), off.z(), holds ? 1 : 0, static_cast<double>(situation.thing.size() > 0);
  return situation;
}

// What happened after a context that was trained, with what was handled then.
struct Seen {
  std::string thing;
  std::set<Fact> begun, ended;
};

struct Changes {
  std::vector<Seen> seen;
  Eigen::MatrixXd features;  // scaled, a row each
  Scale scale{Eigen::MatrixXd::Zero(1, 1)};
};

std::map<std::int64_t, Changes> learn_changes(const PlainFile& given, const std::vector<Context>& contexts) {
  std::map<std::int64_t, Changes> all;
  for (const std::int64_t horizon : kHorizons) {
    Changes& changes = all[horizon];
    std::vector<Eigen::MatrixXd> rows;
    for (const Context& context : contexts) {
      if (context.frame + horizon >= context.frames) continue;
      const Situation situation = situation_of(given, context, horizon);
      Seen& seen = changes.seen.emplace_back();
      seen.thing = situation.thing;
      const std::set<Fact> later = facts_of(given, context.episode, context.frame + horizon);
      std::set_difference(later.begin(), later.end(), context.facts.begin(), context.facts.end(),
                          std::inserter(seen.begun, seen.begun.end()));
      std::set_difference(context.facts.begin(), context.facts.end(), later.begin(), later.end(),
                          std::inserter(seen.ended, seen.ended.end()));
      rows.emplace_back(situation.features);
    }
    if (rows.empty()) continue;
    changes.features = stacked(rows);
    changes.scale = Scale(changes.features);
    changes.features = changes.scale.of(changes.features);
  }
  return all;
}

// The changes of the nearest context, said of what is handled here; those that make no sense here are left out.
std::set<Fact> changed_facts(const PlainFile& given, const Changes& changes, const Context& context,
                             std::int64_t horizon) {
  std::set<Fact> facts = context.facts;
  if (changes.seen.empty()) return facts;
  const Situation situation = situation_of(given, context, horizon);
  Eigen::Index nearest = 0;
  (changes.features.rowwise() - changes.scale.of(situation.features).row(0)).rowwise().squaredNorm().minCoeff(&nearest);
  const Seen& seen = changes.seen[static_cast<std::size_t>(nearest)];
  const auto here = [&](Fact fact) {
    for (std::string& argument : fact.arguments)
      if (argument == seen.thing && !seen.thing.empty()) argument = situation.thing;
    return fact;
  };
  for (const Fact& fact : seen.ended) facts.erase(here(fact));
  for (const Fact& fact : seen.begun) {
    const Fact one = here(fact);
    if (std::all_of(one.arguments.begin(), one.arguments.end(),
                    [&](const std::string& name) { return context.bodies.contains(name); }))
      facts.insert(one);
  }
  return facts;
}

}  // namespace

Answers nothing_moves(const ResearchProblem&, const PlainFile& given) {
  return predict(given, {[](const Context&, const Body&, std::int64_t) { return Eigen::Vector3d::Zero().eval(); },
                         [](const Context&, const Joint&, std::int64_t) { return 0.0; },
                         [](const Context& context, std::int64_t) { return context.facts; }});
}

Answers constant_velocity(const ResearchProblem&, const PlainFile& given) {
  return predict(given, {[](const Context&, const Body& body, std::int64_t horizon) {
                           return (body.step * static_cast<double>(horizon)).eval();
                         },
                         [](const Context&, const Joint& joint, std::int64_t horizon) {
                           return joint.step * static_cast<double>(horizon);
                         },
                         [](const Context& context, std::int64_t) { return context.facts; }});
}

Answers linear_tip(const ResearchProblem&, const PlainFile& given) {
  const std::vector<Context> contexts = contexts_of(given, "'train', 'validation'");
  const auto weights = learn_tip(given, contexts);
  const auto joint_weights = learn_joints(given, contexts);
  const auto changes = learn_changes(given, contexts);
  const auto body = [&](const Context& context, const Body& one, std::int64_t horizon) -> Eigen::Vector3d {
    const Body* hand = hand_of(context);
    if (!hand || !weights.contains(horizon) || (!one.hand && !carried(context, *hand, one)))
      return Eigen::Vector3d::Zero();
    const Asked asked = asked_of(given, context, hand->now, horizon);
    Eigen::Vector3d moved;
    for (int axis = 0; axis < 3; ++axis)
      moved(axis) = apply_ridge(inputs(*hand, asked, axis).transpose(), weights.at(horizon))(0, 0);
    return moved;
  };
  const auto joint = [&](const Context& context, const Joint& one, std::int64_t horizon) {
    const auto found = joint_weights.find({horizon, one.command > 0});
    return found == joint_weights.end() ? 0
                                        : apply_ridge(joint_inputs(given, context, one, horizon), found->second)(0, 0);
  };
  const auto facts = [&](const Context& context, std::int64_t horizon) {
    return changed_facts(given, changes.at(horizon), context, horizon);
  };
  return predict(given, {body, joint, facts});
}

}  // namespace stampede::research
