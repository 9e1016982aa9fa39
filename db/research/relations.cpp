#include "db/research/relations.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <set>

namespace stampede::research {
namespace {

// The words of all sentences about an episode, in small letters, and the greatest number among them (0: none).
struct Sentences {
  std::set<std::string> words;
  double number = 0;
};

std::set<std::string> words_in(const std::string& text) {
  std::set<std::string> words;
  std::string word;
  for (const char c : text + " ") {
    if (std::isalnum(static_cast<unsigned char>(c))) {
      word += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    } else if (!word.empty()) {
      words.insert(std::move(word));
      word.clear();
    }
  }
  return words;
}

Sentences sentences_of(const PlainFile& given, std::int64_t episode) {
  Sentences sentences;
  const Rows rows = given.query("SELECT text FROM instructions WHERE episode = ?1", {episode});
  for (std::size_t i = 0; i < rows.size(); ++i) sentences.words.merge(words_in(rows.text(i, "text")));
  for (const std::string& word : sentences.words)
    if (word.size() < 3 && std::all_of(word.begin(), word.end(), [](unsigned char c) { return std::isdigit(c) != 0; }))
      sentences.number = std::max(sentences.number, std::stod(word));
  return sentences;
}

struct SceneThing {
  std::string name, parent, type, colour;  // parent: of parts and regions
  bool body = false, region = false, movable = false, container = false;
  bool asked = false;  // the sentences speak of it
  Eigen::RowVector3d size = Eigen::RowVector3d::Zero();
  Eigen::MatrixXd at;  // a row a frame, m; empty: it has no pose
};
using Things = std::map<std::string, SceneThing>;

// Where the sentences name colours, things are meant by theirs, and others by what they are called.
void mark_asked(Things& things, const Sentences& sentences) {
  std::set<std::string> by_colour;  // types
  for (auto& [name, thing] : things)
    if (!thing.colour.empty() && sentences.words.contains(thing.colour))
      thing.asked = true, by_colour.insert(thing.type);
  const auto spoken = [&](const std::string& name) {
    const std::set<std::string> words = words_in(name);
    return std::includes(sentences.words.begin(), sentences.words.end(), words.begin(), words.end());
  };
  for (auto& [name, thing] : things) {
    const auto parent = things.find(thing.parent);
    if (parent != things.end() && !parent->second.colour.empty()) {
      thing.asked = sentences.words.contains(parent->second.colour);
    } else if (!thing.asked && !(!thing.colour.empty() && by_colour.contains(thing.type))) {
      std::string last = name.substr(name.rfind('.') + 1);
      while (!last.empty() && std::isdigit(static_cast<unsigned char>(last.back()))) last.pop_back();
      thing.asked = spoken(last) || (thing.body && spoken(thing.type));
    }
  }
}

Things things_of(const PlainFile& given, std::int64_t episode, const Sentences& sentences, Eigen::Index frames) {
  Things things;
  const Rows rows = given.query("SELECT * FROM objects WHERE episode = ?1 ORDER BY object", {episode});
  for (std::size_t i = 0; i < rows.size(); ++i) {
    SceneThing& thing = things[rows.text(i, "object")];
    thing.name = rows.text(i, "object"), thing.type = rows.text(i, "type");
    if (!rows.is_null(i, "colour")) thing.colour = rows.text(i, "colour");
    if (const auto dot = thing.name.rfind('.'); dot != std::string::npos) thing.parent = thing.name.substr(0, dot);
    thing.body = rows.text(i, "kind") == "body", thing.region = rows.text(i, "kind") == "region";
    const std::string& traits = rows.text(i, "traits");
    thing.movable = traits.find("\"movable\"") != std::string::npos;
    thing.container = traits.find("\"container\"") != std::string::npos;
    thing.size << rows.real(i, "size_x"), rows.real(i, "size_y"), rows.real(i, "size_z");
  }
  mark_asked(things, sentences);
  const Rows poses =
      given.query("SELECT frame, object, x, y, z FROM poses WHERE episode = ?1 ORDER BY frame", {episode});
  for (std::size_t i = 0; i < poses.size(); ++i) {
    Eigen::MatrixXd& at = things[poses.text(i, "object")].at;
    if (at.size() == 0) at.setZero(frames, 3);
    if (const auto frame = poses.integer(i, "frame"); frame < frames)
      at.row(frame) << poses.real(i, "x"), poses.real(i, "y"), poses.real(i, "z");
  }
  return things;
}

bool lies_on(const SceneThing& above, const SceneThing& below, Eigen::Index frame) {
  constexpr double kGap = 0.012;  // m
  const Eigen::RowVector3d off = above.at.row(frame) - below.at.row(frame);
  return std::abs(off.x()) < below.size.x() / 2 && std::abs(off.y()) < below.size.y() / 2 &&
         std::abs(off.z() - (above.size.z() + below.size.z()) / 2) < kGap;
}

bool lies_within(const SceneThing& inner, const SceneThing& outer, Eigen::Index frame) {
  return ((inner.at.row(frame) - outer.at.row(frame)).cwiseAbs().array() < outer.size.array() / 2).all();
}

// Columns of things that are asked for; then the same of all others.
struct Of {
  enum { moved, rise, near, held, inside, on_asked, on_other, joints, most_joints, each };
};

void add_things(const Things& things, const Signals& signals, Eigen::MatrixXd& features) {
  constexpr double kMoved = 0.02, kReach = 0.06, kFar = 1, kHeld = 0.5;  // m, m, m, N
  for (Eigen::Index frame = 0; frame < features.rows(); ++frame) {
    auto row = features.row(frame);
    const auto hand = signals.hand.row(frame);
    const double force = std::min(hand(14), hand(15));
    row(Of::near) = row(Of::each + Of::near) = -kFar;
    for (const auto& [name, thing] : things) {
      if (!thing.movable || thing.at.size() == 0) continue;
      auto of = row.segment(thing.asked ? 0 : Of::each, Of::each);
      const Eigen::RowVector3d way = thing.at.row(frame) - thing.at.row(0);
      const double distance = (thing.at.row(frame) - hand.head(3)).norm();
      of(Of::moved) += way.norm() > kMoved ? 1 : 0;
      of(Of::rise) = std::max(of(Of::rise), way.z());
      of(Of::near) = std::max(of(Of::near), -distance);
      if (distance < kReach && force > kHeld) of(Of::held) = 1;
      bool within = false;
      for (const auto& [other_name, other] : things) {
        if (&other == &thing || other.at.size() == 0) continue;
        within = within || ((other.region || other.container) && lies_within(thing, other, frame));
        if (other.movable && lies_on(thing, other, frame)) ++of(other.asked ? Of::on_asked : Of::on_other);
      }
      of(Of::inside) += within ? 1 : 0;
    }
    row.tail(4) << signals.opening()(frame), force, hand(2), hand.segment(7, 3).norm();
  }
}

void add_joints(const PlainFile& given, std::int64_t episode, const Things& things, Eigen::MatrixXd& features) {
  const Rows rows = given.query(
      "SELECT frame, joint, position, first_value(position) OVER (PARTITION BY joint ORDER BY frame) AS start "
      "FROM object_joints WHERE episode = ?1 ORDER BY joint, frame",
      {episode});
  double most = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::int64_t frame = rows.integer(i, "frame");
    const auto thing = things.find(rows.text(i, "joint"));
    const double way = std::abs(rows.real(i, "position") - rows.real(i, "start"));
    most = frame == 0 ? way : std::max(most, way);
    if (frame >= features.rows()) continue;
    auto of = features.row(frame).segment(thing != things.end() && thing->second.asked ? 0 : Of::each, Of::each);
    of(Of::joints) += way, of(Of::most_joints) += most;
  }
}

}  // namespace

Eigen::MatrixXd relations(const PlainFile& given, const Signals& signals) {
  const Eigen::Index frames = signals.hand.rows();
  Eigen::MatrixXd features = Eigen::MatrixXd::Zero(frames, 2 * Of::each + 5);
  const Sentences sentences = sentences_of(given, signals.unit);
  const Things things = things_of(given, signals.unit, sentences, frames);
  add_things(things, signals, features);
  add_joints(given, signals.unit, things, features);
  if (sentences.number > 1)
    features.col(2 * Of::each) = (sentences.number - 1 - features.col(Of::on_asked).array()).max(0);
  return features;
}

std::string kind_of_scene(const PlainFile& given, std::int64_t episode) {
  const Rows rows = given.query("SELECT DISTINCT class FROM objects WHERE episode = ?1 ORDER BY class", {episode});
  std::string kind;
  for (std::size_t i = 0; i < rows.size(); ++i) kind += rows.text(i, "class") + " ";
  return kind;
}

}  // namespace stampede::research
