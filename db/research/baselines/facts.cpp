// Predicates by plain geometry of bounding boxes and fingers: no learning at all.
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "db/research/baselines/functions.h"
#include "db/research/known_columns.h"

namespace stampede::research {
namespace {

struct Thing {
  Eigen::Vector3d at = Eigen::Vector3d::Zero(), size = Eigen::Vector3d::Zero();  // m; box as authored
  bool movable = false, surface = false, container = false, there = false;
  double top() const { return at.z() + size.z() / 2; }
  double bottom() const { return at.z() - size.z() / 2; }
};

struct Hand {
  std::string name;
  Eigen::Vector3d tip = Eigen::Vector3d::Zero();
  double force = 0;  // least of the pads', N
};

struct Scene {
  std::map<std::string, Thing> things;
  std::vector<Hand> hands;
};

// Of an episode at a frame, or of a piece before or after it.
struct GivenMoment {
  std::string unit;  // column of tables objects, poses and hands
  std::int64_t number = 0;
  std::string column;  // of poses and hands
  SqlValue at;
};

Scene scene_at(const PlainFile& given, const KnownColumns& known, const GivenMoment& moment) {
  Scene scene;
  const Rows objects = given.query("SELECT * FROM objects WHERE " + moment.unit + " = ?1", {moment.number});
  for (std::size_t i = 0; i < objects.size(); ++i) {
    Thing& thing = scene.things[objects.text(i, "object")];
    thing.size = {objects.real(i, "size_x"), objects.real(i, "size_y"), objects.real(i, "size_z")};
    const auto has = [&](const char* trait) { return objects.text(i, "traits").find(trait) != std::string::npos; };
    thing.movable = has("\"movable\""), thing.surface = has("\"surface\""), thing.container = has("\"container\"");
  }
  const std::string where = " WHERE " + moment.unit + " = ?1 AND " + moment.column + " = ?2";
  const Rows poses = given.query("SELECT object, x, y, z FROM poses" + where, {moment.number, moment.at});
  for (std::size_t i = 0; i < poses.size(); ++i) {
    Thing& thing = scene.things[poses.text(i, "object")];
    thing.at = {poses.real(i, "x"), poses.real(i, "y"), poses.real(i, "z")}, thing.there = true;
  }
  const Rows hands = given.query("SELECT * FROM hands" + where, {moment.number, moment.at});
  for (std::size_t i = 0; i < hands.size(); ++i)
    scene.hands.push_back({hands.text(i, "hand"),
                           {hands.real(i, "x"), hands.real(i, "y"), hands.real(i, "z")},
                           std::min(known.real(hands, i, "touch_1"), known.real(hands, i, "touch_2"))});
  return scene;
}

bool stands_above(const Thing& above, const Thing& below) {
  const Eigen::Vector3d beside = (above.at - below.at).cwiseAbs();
  return above.movable && below.there && beside.x() < below.size.x() / 2 && beside.y() < below.size.y() / 2;
}

bool rests_on(const Thing& above, const Thing& below) {
  constexpr double kGap = 0.012;  // m
  return below.movable && stands_above(above, below) && std::abs(above.bottom() - below.top()) < kGap;
}

bool lies_in(const Thing& inner, const Thing& outer) {
  const Eigen::Vector3d beside = (inner.at - outer.at).cwiseAbs();
  return inner.movable && outer.container && outer.there && (beside.array() < outer.size.array() / 2).all();
}

// The movable thing next to the tip of a hand that presses; empty: none.
std::string held_by(const Hand& hand, const std::map<std::string, Thing>& things) {
  constexpr double kNear = 0.05, kHeld = 0.5;  // m, N
  std::string nearest;
  double least = kNear;
  for (const auto& [name, thing] : things)
    if (thing.movable && thing.there && hand.force > kHeld && (thing.at - hand.tip).norm() < least)
      least = (thing.at - hand.tip).norm(), nearest = name;
  return nearest;
}

// A thing first; else what lies below all; empty: nothing does.
std::string support_of(const std::string& name, const Thing& thing, const std::map<std::string, Thing>& things) {
  std::string support;
  for (const auto& [other, below] : things) {
    if (name == other) continue;
    if (rests_on(thing, below)) support = other;
    if (support.empty() && below.surface && !below.movable && stands_above(thing, below)) support = other;
  }
  return support;
}

// Atoms by name; a vocabulary that has others goes without.
std::set<std::string> atoms_of(const Scene& scene) {
  std::set<std::string> atoms, covered, held;
  for (const Hand& hand : scene.hands) {
    const std::string thing = held_by(hand, scene.things);
    if (thing.empty()) {
      atoms.insert("(hand_empty " + hand.name + ")");
      continue;
    }
    atoms.insert("(holding " + hand.name + " " + thing + ")");
    held.insert(thing);
  }
  for (const auto& [name, thing] : scene.things) {
    if (!thing.there || !thing.movable || held.contains(name)) continue;
    for (const auto& [other, outer] : scene.things)
      if (name != other && lies_in(thing, outer)) atoms.insert("(inside " + name + " " + other + ")");
    const std::string support = support_of(name, thing, scene.things);
    if (support.empty()) continue;
    atoms.insert("(on " + name + " " + support + ")");
    covered.insert(support);
  }
  for (const std::string& name : held) atoms.insert("(lifted " + name + ")");
  for (const auto& [name, thing] : scene.things)
    if (thing.movable && !covered.contains(name)) atoms.insert("(clear " + name + ")");
  return atoms;
}

// Where there are none, a row says so.
void add_atoms(Answers& answers, std::int64_t unit, const SqlValue& moment, const std::vector<std::string>& atoms) {
  for (const std::string& atom : atoms) answers.rows.rows.push_back({unit, moment, atom});
  if (atoms.empty()) answers.rows.rows.push_back({unit, moment, std::monostate{}});
}

}  // namespace

Answers geometry_facts(const ResearchProblem&, const PlainFile& given) {
  constexpr std::int64_t kAskedEvery = 20;
  const KnownColumns known_of_hands(given, "hands");
  std::set<std::string> known;
  const Rows names = given.query("SELECT DISTINCT predicate FROM vocabulary");
  for (std::size_t i = 0; i < names.size(); ++i) known.insert(names.text(i, "predicate"));
  const auto is_known = [&](const std::string& atom) { return known.contains(atom.substr(1, atom.find(' ') - 1)); };
  Answers answers;
  const Rows episodes = given.query("SELECT episode, frames FROM episodes WHERE split = 'test' ORDER BY episode");
  for (std::size_t i = 0; i < episodes.size(); ++i)
    for (std::int64_t frame = 0; frame < episodes.integer(i, "frames"); frame += kAskedEvery) {
      const std::int64_t episode = episodes.integer(i, "episode");
      std::vector<std::string> some;
      for (const std::string& atom : atoms_of(scene_at(given, known_of_hands, {"episode", episode, "frame", frame})))
        if (is_known(atom)) some.push_back(atom);
      add_atoms(answers, episode, frame, some);
    }
  return answers;
}

Answers geometry_symbols(const ResearchProblem&, const PlainFile& given) {
  const KnownColumns known_of_hands(given, "hands");
  Answers answers;
  const Rows pieces = given.query("SELECT piece FROM pieces WHERE split = 'test' ORDER BY piece");
  for (std::size_t i = 0; i < pieces.size(); ++i)
    for (const std::string moment : {"before", "after"}) {
      const std::int64_t piece = pieces.integer(i, "piece");
      std::vector<std::string> symbols;
      for (const std::string& atom : atoms_of(scene_at(given, known_of_hands, {"piece", piece, "moment", moment})))
        symbols.push_back("(s_" + atom.substr(1));
      add_atoms(answers, piece, moment, symbols);
    }
  return answers;
}

}  // namespace stampede::research
