// Predicates by thresholds that are found in what skills change, and operators of them.
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "db/research/baselines/functions.h"
#include "db/research/known_columns.h"
#include "db/research/signals.h"
#include "engine/base/read_json.h"
#include "engine/learning/operators.h"
#include "engine/symbolic/pddl.h"

namespace stampede::research {
namespace {

struct Box {
  std::string type;
  bool movable = false, container = false, region = false, there = false;
  Facts traits;
  Eigen::Vector3d size = Eigen::Vector3d::Zero(), at = Eigen::Vector3d::Zero();  // m
};

// What is seen of a frame.
struct View {
  std::map<std::string, Box> boxes;
  std::map<std::string, double> joints,
      joints_so_far;  // of things: how far from 0 now, and at most until now; rad or m
  std::string hand;
  Eigen::Vector3d tip = Eigen::Vector3d::Zero();
  double force = 0;  // least of the pads', N
};

// By how much something is short of a relation, in m (or rad): the less, the more it holds.
using Measured = std::map<Fact, double>;  // predicate: the name of the measure

// Where the box of a thing lies about its pose nobody says: about its middle, or above or below it.
// How far a is from resting on b: beside it, above it or in it.
double gap_on(const Box& a, const Box& b) {
  const Eigen::Vector3d off = a.at - b.at;
  double apart = std::abs(off.z());
  for (const double bottom : {0.0, a.size.z() / 2})
    for (const double top : {0.0, b.size.z() / 2, b.size.z()})
      apart = std::min(apart, std::abs(off.z() - bottom - top));
  return std::max({std::abs(off.x()) - b.size.x() / 2, std::abs(off.y()) - b.size.y() / 2, apart});
}

double gap_in(const Box& a, const Box& b) {
  const Eigen::Vector3d off = a.at - b.at;
  return std::max({std::abs(off.x()) - b.size.x() / 2, std::abs(off.y()) - b.size.y() / 2, off.z() - b.size.z(),
                   -off.z() - b.size.z() / 2, 0.0});
}

Measured measured(const View& view) {
  constexpr double kHeld = 0.5, kUntouched = 0.3;  // N; m: as far as a thing that nothing presses on
  Measured all;
  const auto least = [&](const Fact& fact, double value) {
    const auto [at, fresh] = all.emplace(fact, value);
    if (!fresh) at->second = std::min(at->second, value);
  };
  for (const auto& [name, box] : view.boxes) {
    if (!box.there || !box.movable) continue;
    const double reach = (box.at - view.tip).norm(), grip = reach + (view.force > kHeld ? 0 : kUntouched);
    least({"reach", {view.hand, name}}, reach);
    least({"grip", {view.hand, name}}, grip);
    least({"empty", {view.hand}}, grip);
    for (const auto& [other, below] : view.boxes) {
      if (other == name || !below.there) continue;
      if (below.container) least({"in", {name, other}}, gap_in(box, below));
      if (below.region) continue;
      least({"on", {name, other}}, gap_on(box, below));
      least({"clear", {other}}, gap_on(box, below));
    }
  }
  for (const auto& [joint, way] : view.joints)
    if (view.boxes.contains(joint)) least({"moved " + view.boxes.at(joint).type, {joint}}, way);
  for (const auto& [joint, way] : view.joints_so_far)
    if (view.boxes.contains(joint)) least({"moved_ever " + view.boxes.at(joint).type, {joint}}, way);
  return all;
}

// What an episode's objects are; where they are comes with each frame.
View scene_of(const PlainFile& given, std::int64_t episode) {
  View view;
  const Rows rows = given.query("SELECT * FROM objects WHERE episode = ?1 ORDER BY object", {episode});
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::string& name = rows.text(i, "object");
    Box& box = view.boxes[name];
    box.type = rows.text(i, "type"), box.region = rows.text(i, "kind") == "region";
    for (const std::string& trait : texts_from_json(rows.text(i, "traits"), given.path().string()))
      box.traits.insert({trait, {name}});
    box.movable = box.traits.contains({"movable", {name}});
    box.container = box.traits.contains({"container", {name}});
    box.size = {rows.real(i, "size_x"), rows.real(i, "size_y"), rows.real(i, "size_z")};
  }
  return view;
}

// Of the frames between which skills lie.
std::map<std::int64_t, View> views_of(const PlainFile& given, const KnownColumns& known, std::int64_t episode) {
  const std::string frames =
      " frame IN (SELECT first_frame FROM skills WHERE episode = ?1 UNION SELECT min(s.end_frame, e.frames - 1) FROM "
      "skills s JOIN episodes e USING (episode) WHERE episode = ?1) ";
  const View scene = scene_of(given, episode);
  std::map<std::int64_t, View> views;
  const Rows hands =
      given.query("SELECT * FROM hands WHERE episode = ?1 AND" + frames + "ORDER BY frame, hand", {episode});
  for (std::size_t i = 0; i < hands.size(); ++i) {
    View& view = views.emplace(hands.integer(i, "frame"), scene).first->second;
    view.hand = hands.text(i, "hand");
    view.tip = {hands.real(i, "x"), hands.real(i, "y"), hands.real(i, "z")};
    view.force = std::min(known.real(hands, i, "touch_1"), known.real(hands, i, "touch_2"));
  }
  const Rows poses = given.query("SELECT frame, object, x, y, z FROM poses WHERE episode = ?1 AND" + frames, {episode});
  for (std::size_t i = 0; i < poses.size(); ++i) {
    Box& box = views[poses.integer(i, "frame")].boxes[poses.text(i, "object")];
    box.at = {poses.real(i, "x"), poses.real(i, "y"), poses.real(i, "z")}, box.there = true;
  }
  const Rows joints = given.query(
      "SELECT * FROM (SELECT frame, joint, abs(position) AS way, max(abs(position)) OVER (PARTITION BY joint ORDER BY "
      "frame) AS most FROM object_joints WHERE episode = ?1) WHERE" +
          frames,
      {episode});
  for (std::size_t i = 0; i < joints.size(); ++i) {
    View& view = views[joints.integer(i, "frame")];
    view.joints[joints.text(i, "joint")] = joints.real(i, "way");
    view.joints_so_far[joints.text(i, "joint")] = joints.real(i, "most");
  }
  return views;
}

struct Call {
  std::int64_t first = 0, last = 0;  // frames before and after
  std::string skill;
  std::vector<std::string> arguments;
  bool success = true;
};

struct Lived {
  std::int64_t episode = 0;
  learning::Objects objects;
  Facts traits;
  std::vector<Call> calls;
  std::map<std::int64_t, Measured> measures;  // by frame
};

std::vector<Lived> lived(const PlainFile& given, const std::string& splits) {
  const KnownColumns known(given, "hands");
  std::vector<Lived> all;
  const Rows episodes =
      given.query("SELECT episode, frames FROM episodes WHERE split IN (" + splits + ") ORDER BY episode");
  for (std::size_t e = 0; e < episodes.size(); ++e) {
    Lived& one = all.emplace_back();
    one.episode = episodes.integer(e, "episode");
    std::vector<TypedObject> objects;
    for (const auto& [name, box] : scene_of(given, one.episode).boxes) {
      objects.push_back({name, box.type});
      one.traits.insert(box.traits.begin(), box.traits.end());
    }
    one.objects = std::make_shared<const std::vector<TypedObject>>(std::move(objects));
    const Rows rows = given.query("SELECT * FROM skills WHERE episode = ?1 ORDER BY ordinal", {one.episode});
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const std::string& name = rows.text(i, "case_name");
      one.calls.push_back(
          {rows.integer(i, "first_frame"), std::min(rows.integer(i, "end_frame"), episodes.integer(e, "frames") - 1),
           rows.text(i, "skill") + (name.empty() ? "" : "_" + name),
           texts_from_json(rows.text(i, "arguments"), given.path().string()), rows.text(i, "outcome") == "success"});
    }
    for (const auto& [frame, view] : views_of(given, known, one.episode)) one.measures[frame] = measured(view);
  }
  return all;
}

struct Threshold {
  std::string name;  // of the predicate: p1, p2 …
  double at = 0;
  bool above = false;  // it holds where the measure is not less, else where it is
  bool holds(double value) const { return (value < at) != above; }
};

// A predicate for each measure that skills change: the threshold lies between the two groups of what was measured
// before and after (2-means of logarithms), of things for which it became another by a factor of three.
std::map<std::string, Threshold> thresholds(const std::vector<Lived>& all) {
  constexpr double kFinest = 0.001, kFactor = 3;  // m
  const std::set<std::string> kByExcess = {"clear", "empty", "moved", "moved_ever"};
  std::map<std::string, std::vector<double>> changed;
  const auto scaled = [&](double value) { return std::log(value + kFinest); };
  for (const Lived& one : all)
    for (const Call& call : one.calls) {
      const Measured& after = one.measures.at(call.last);
      for (const auto& [fact, value] : one.measures.at(call.first)) {
        const auto found = after.find(fact);
        if (found == after.end() || std::abs(scaled(found->second) - scaled(value)) < std::log(kFactor)) continue;
        for (const double it : {value, found->second}) changed[fact.predicate].push_back(scaled(it));
      }
    }
  std::map<std::string, Threshold> found;
  for (const auto& [measure, values] : changed) {
    const Eigen::MatrixXd rows =
        Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
    const std::vector<int> groups = k_means(rows, 2);
    double sum[2] = {0, 0}, count[2] = {0, 0};
    for (std::size_t i = 0; i < values.size(); ++i) sum[groups[i]] += values[i], ++count[groups[i]];
    if (count[0] == 0 || count[1] == 0) continue;
    found[measure] = {"p" + std::to_string(found.size() + 1),
                      std::exp((sum[0] / count[0] + sum[1] / count[1]) / 2) - kFinest,
                      kByExcess.contains(measure.substr(0, measure.find(' ')))};
  }
  return found;
}

Facts invented(const Measured& measures, const std::map<std::string, Threshold>& predicates) {
  Facts facts;
  for (const auto& [fact, value] : measures)
    if (const auto found = predicates.find(fact.predicate); found != predicates.end() && found->second.holds(value))
      facts.insert({found->second.name, fact.arguments});
  return facts;
}

}  // namespace

Answers invented_predicates(const ResearchProblem&, const PlainFile& given) {
  constexpr learning::LearningOptions kOptions = {.support = 2, .share = 0.05, .tolerance = 0.05};
  const std::vector<Lived> trained = lived(given, "'train', 'validation'");
  const std::map<std::string, Threshold> predicates = thresholds(trained);
  learning::Experience experience;
  std::set<std::string> traits;
  for (const Lived& one : trained) {
    for (const Fact& trait : one.traits) traits.insert(trait.predicate);
    for (const TypedObject& object : *one.objects) experience.types[object.type] = "object";
    for (const Call& call : one.calls) {
      learning::Transition& transition = experience.transitions.emplace_back();
      transition.skill = call.skill, transition.arguments = call.arguments, transition.success = call.success;
      transition.objects = one.objects;
      transition.before = invented(one.measures.at(call.first), predicates);
      transition.after = invented(one.measures.at(call.last), predicates);
      for (Facts* facts : {&transition.before, &transition.after}) facts->insert(one.traits.begin(), one.traits.end());
    }
  }
  const Domain domain = learning::learn_operators(experience, kOptions).domain;
  Answers answers;
  answers.texts["domain"] = to_pddl(domain);
  for (const Lived& one : lived(given, "'test'"))
    for (const auto& [frame, measures] : one.measures) {
      const auto say = [&, &at = frame](const Fact& fact, bool holds) {
        answers.rows.rows.push_back({one.episode, at, to_text(fact), std::int64_t{holds}});
      };
      for (const auto& [fact, value] : measures)
        if (const auto found = predicates.find(fact.predicate); found != predicates.end())
          say({found->second.name, fact.arguments}, found->second.holds(value));
      for (const TypedObject& object : *one.objects) {
        for (const std::string& trait : traits)
          say({trait, {object.name}}, one.traits.contains({trait, {object.name}}));
        if (domain.types.contains(object.type)) say({object.type, {object.name}}, true);
      }
    }
  return answers;
}

}  // namespace stampede::research
