#include "scripting/commands/check_ghosts.h"

#include <algorithm>
#include <array>
#include <map>

#include "engine/model/body_tree.h"
#include "engine/model/kinematics.h"

namespace stampede::program {
namespace {

constexpr std::size_t kMostHands = 7, kMostThings = 12;

}  // namespace

std::vector<LegendLine> legend_of(const std::vector<Looked>& looked) {
  const Colour reds[] = {{0.85, 0.10, 0.10, 1}, {0.55, 0.05, 0.30, 1}, {0.95, 0.45, 0.40, 1}};
  std::map<std::string, std::pair<int, Looked::Fate>> counts;
  for (const Looked& one : looked) {
    auto& [count, fate] = counts[cause_of(one)];
    ++count;
    fate = one.fate;
  }
  std::vector<LegendLine> lines;
  for (const auto& [cause, known] : counts) lines.push_back({{}, known.first, cause});
  std::stable_sort(lines.begin(), lines.end(),
                   [](const LegendLine& a, const LegendLine& b) { return a.count > b.count; });
  std::size_t touching = 0;
  for (LegendLine& line : lines) {
    const Looked::Fate fate = counts[line.text].second;
    if (fate == Looked::Fate::touches)
      line.colour = reds[std::min<std::size_t>(touching++, 2)];
    else if (fate == Looked::Fate::out_of_reach)
      line.colour = {0.42, 0.44, 0.48, 1};
    else if (fate == Looked::Fate::usable)
      line.colour = {0.10, 0.62, 0.25, 1};
    else
      line.colour = {0.95, 0.58, 0.10, 1};
  }
  return lines;
}

std::vector<Ghost> chosen_ghosts(const std::vector<Looked>& looked, const std::vector<LegendLine>& legend, bool hands) {
  const auto by = [](const Looked* one) {
    return one->joint.empty() ? (one->missed_m < 0 ? 1e9 : one->missed_m) : 0.3 * one->missed_rad;
  };
  std::vector<std::vector<const Looked*>> groups;
  for (const LegendLine& line : legend) {
    std::vector<const Looked*>& group = groups.emplace_back();
    for (const Looked& one : looked)
      if (cause_of(one) == line.text) group.push_back(&one);
    std::stable_sort(group.begin(), group.end(), [&](const Looked* a, const Looked* b) { return by(a) < by(b); });
  }
  std::vector<Ghost> chosen;
  const auto shows_more = [&](const Looked* one) {
    return std::none_of(chosen.begin(), chosen.end(), [&](const Ghost& other) {
      const double turn = angle_between(Quaternion(one->pose.linear()), Quaternion(other.looked->pose.linear()));
      const double way = (one->pose.translation() - other.looked->pose.translation()).norm();
      return hands ? way < 0.03 && turn < 0.5 : way < 0.012;
    });
  };
  const std::size_t most = hands ? kMostHands : kMostThings;
  for (bool any = true; any && chosen.size() < most;) {
    any = false;
    for (std::size_t i = 0; i < groups.size() && chosen.size() < most; ++i) {
      const auto next = std::find_if(groups[i].begin(), groups[i].end(), shows_more);
      if (next == groups[i].end()) continue;
      chosen.push_back({*next, legend[i].colour});
      groups[i].erase(groups[i].begin(), next + 1);
      any = true;
    }
  }
  return chosen;
}

Body ghost_of(const Scene& scene, const Impasse& impasse, const Looked& looked, const std::string& name,
              const Colour& colour) {
  Body ghost;
  ghost.name = name;
  ghost.fixture = true;
  ghost.world_from_body = looked.pose;
  Part all;
  all.name = "base";
  const auto add = [&](const Part& part, const Transform& pose_from_part) {
    for (Shape shape : part.shapes) {
      if (!shape.visible) continue;
      shape.part_from_shape = pose_from_part * shape.part_from_shape;
      shape.colour = colour;
      shape.texture.clear();
      shape.shown_by.clear();
      all.shapes.push_back(std::move(shape));
    }
  };
  if (looked.opening > 0) {
    const Robot& robot = scene.robot;
    std::vector<double> positions(robot.body.parts.size(), 0);
    for (const int finger : robot.fingers)
      positions[static_cast<std::size_t>(finger)] = looked.opening / static_cast<double>(robot.fingers.size());
    std::vector<Transform> poses;
    forward_kinematics(robot.body, Transform::Identity(), positions, poses);
    const auto tip = static_cast<std::size_t>(robot.tip_part);
    const Transform tip_from_base = (poses[tip] * robot.tip_part_from_tip).inverse();
    for (std::size_t part = 0; part < robot.body.parts.size(); ++part)
      if (hangs_on(robot.body, static_cast<int>(part), robot.tip_part))
        add(robot.body.parts[part], tip_from_base * poses[part]);
  } else if (const Object* object = scene.object(impasse.subject)) {
    if (object->kind == ObjectKind::region) {
      const Region& region = scene.regions[static_cast<std::size_t>(scene.region_index(object->name))];
      Shape box;
      box.size = region.size.cwiseMax(0.002);
      box.colour = colour;
      all.shapes.push_back(box);
    } else if (const int body = scene.body_index(object->body); body >= 0) {
      add(scene.bodies[static_cast<std::size_t>(body)].parts.front(), Transform::Identity());
    }
  }
  ghost.parts.push_back(std::move(all));
  return ghost;
}

void show_regions(const std::string& step, Scene& scene) {
  for (Region& region : scene.regions) {
    const std::size_t at = step.find(" " + region.name);
    const std::size_t end = at == std::string::npos ? at : at + 1 + region.name.size();
    if (at == std::string::npos || (end < step.size() && step[end] != ' ' && step[end] != ')')) continue;
    region.visible = true;
    region.colour = {0.95, 0.85, 0.2, 0.3};
    region.size = region.size.cwiseMax(0.001);
  }
}

void fade(Scene& scene, const std::string& subject) {
  const Object* object = scene.object(subject);
  const auto pale = [](double value, double grey) { return 0.25 * value + 0.75 * (0.45 + 0.5 * grey); };
  const auto fade_body = [&](Body& body) {
    for (std::size_t part = 0; part < body.parts.size(); ++part) {
      const bool kept = object != nullptr && object->body == body.name && object->part == static_cast<int>(part);
      for (Shape& shape : body.parts[part].shapes) {
        if (kept) continue;
        Colour& colour = shape.colour;
        const double grey = 0.3 * colour.red + 0.6 * colour.green + 0.1 * colour.blue;
        colour = {pale(colour.red, grey), pale(colour.green, grey), pale(colour.blue, grey), colour.alpha};
        shape.texture.clear();
      }
    }
  };
  for (Body& body : scene.bodies) fade_body(body);
  fade_body(scene.robot.body);
}

}  // namespace stampede::program
