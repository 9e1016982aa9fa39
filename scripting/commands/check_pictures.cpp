// A picture of what was turned down: ghosts in the scene of the moment, seen from where most of them can be seen.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <span>

#include "engine/model/body_tree.h"
#include "engine/model/camera.h"
#include "engine/model/masks.h"
#include "engine/render/renderer.h"
#include "scripting/commands/check_failures.h"
#include "scripting/commands/render_output.h"

namespace stampede::program {
namespace {

constexpr int kWide = 600, kHigh = 520, kGap = 10, kLetters = 14, kTitle = 19, kLook = 96;
constexpr std::size_t kMostHands = 7, kMostThings = 12, kMostLines = 8;
constexpr double kGhost = 0.28, kNearest = 0.75;  // alpha
constexpr double kMuch = 0.25;                    // power of a share: half of a thing is nearly all of it
constexpr std::array<std::uint8_t, 3> kPaper{250, 250, 248}, kInk{30, 32, 36}, kFaint{110, 114, 120};

std::array<std::uint8_t, 3> bytes_of(const Colour& colour) {
  const auto byte = [](double value) { return static_cast<std::uint8_t>(std::lround(255 * value)); };
  return {byte(colour.red), byte(colour.green), byte(colour.blue)};
}

struct LegendLine {
  Colour colour;
  int count = 0;
  std::string text;
};

// One line a cause, the most frequent first: red ones touch something, another shade for each of the first three.
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

struct Ghost {
  const Looked* looked = nullptr;
  Colour colour;
};

// Nearest misses first, of each cause in turn; what is nearly where another one is tells nothing.
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

// What a ghost looks like: parts of the robot behind its last joint, or of the object's body.
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
  if (impasse.reason == Reason::no_grasp) {
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

struct Ball {
  Vector3 low = Vector3::Constant(1e9), high = Vector3::Constant(-1e9);
  void add(const Vector3& point, double radius) {
    low = low.cwiseMin(point - Vector3::Constant(radius));
    high = high.cwiseMax(point + Vector3::Constant(radius));
  }
  bool empty() const { return low.x() > high.x(); }
  Vector3 centre() const { return (low + high) / 2; }
  double radius() const { return std::max(0.14, (high - low).norm() / 2); }
};

void add_body(const Body& body, const std::vector<Transform>& poses, Ball& ball) {
  for (std::size_t part = 0; part < body.parts.size(); ++part) {
    if (body.parts[part].shapes.empty()) continue;
    const auto [low, high] = bounding_box(body.parts[part]);
    ball.add(poses[part] * Vector3((low + high) / 2), (high - low).norm() / 2 * 0.8);
  }
}

View view_at(const Ball& ball, double azimuth, double elevation, int width, int height) {
  constexpr double kField = 0.6;  // rad
  const double distance = 0.95 * ball.radius() / std::sin(kField / 2);
  View view;
  set_field_of_view(view.camera, kField, width, height);
  view.camera.near_m = distance / 50;
  view.camera.far_m = distance * 6;
  const Vector3 from(std::cos(azimuth) * std::cos(elevation), std::sin(azimuth) * std::cos(elevation),
                     std::sin(elevation));
  view.world_from_camera = looking_at(ball.centre() + distance * from, ball.centre());
  return view;
}

struct Direction {
  double azimuth = 0, elevation = 0.6;
};

// From where most of every ghost is to be seen, and of the thing itself, which counts as much as three.
Direction best_direction(Renderer& renderer, const std::shared_ptr<const Scene>& opaque, const ScenePoses& poses,
                         const Ball& ball, std::size_t first_ghost, const std::string& subject) {
  std::vector<Direction> directions;
  std::vector<View> views;
  for (const double elevation : {0.35, 0.75, 1.2})
    for (int k = 0; k < 12; ++k) {
      directions.push_back({k * std::numbers::pi / 6, elevation});
      views.push_back(view_at(ball, directions.back().azimuth, elevation, kLook, kLook));
    }
  DrawOptions options;
  options.kinds = {false, false, true, false};
  std::vector<Picture> pictures;
  renderer.load(opaque);
  renderer.draw(poses, views, options, pictures);
  std::map<int, double> weights;
  for (std::size_t body = first_ghost; body < opaque->bodies.size(); ++body)
    weights[opaque->bodies[body].parts[0].instance] = 1;
  const Object* object = opaque->object(subject);
  const int body = object == nullptr ? -1 : opaque->body_index(object->body);
  if (body >= 0)
    weights[opaque->bodies[static_cast<std::size_t>(body)].parts[static_cast<std::size_t>(object->part)].instance] = 3;
  std::vector<double> worth(views.size(), 0);
  for (const auto& [number, weight] : weights) {
    if (number == 0) continue;
    std::vector<double> seen;
    for (const Picture& picture : pictures)
      seen.push_back(static_cast<double>(std::count(picture.instance.begin(), picture.instance.end(), number)));
    const double most = *std::max_element(seen.begin(), seen.end());
    for (std::size_t i = 0; i < seen.size() && most > 0; ++i) worth[i] += weight * std::pow(seen[i] / most, kMuch);
  }
  return directions[static_cast<std::size_t>(std::max_element(worth.begin(), worth.end()) - worth.begin())];
}

// Regions that the step names can be seen: what is put somewhere is put into them.
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

// Pale, but for the thing itself: what stands out are the ghosts.
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

// ` (2 mm at least)`, of the nearest miss of a cause.
std::string least(const std::vector<Looked>& looked, const std::string& cause) {
  std::vector<Looked> same;
  std::copy_if(looked.begin(), looked.end(), std::back_inserter(same),
               [&](const Looked& one) { return cause_of(one) == cause; });
  const Looked* nearest = nearest_miss(same);
  const std::string amount = nearest == nullptr ? "" : amount_of(*nearest);
  return amount.empty() ? "" : " (" + amount + " at least)";
}

void write_words(Canvas& canvas, const Impasse& impasse, const std::vector<LegendLine>& legend, std::size_t ghosts,
                 int below) {
  const bool hands = impasse.reason == Reason::no_grasp;
  const std::string title = fmt::format("{}: {} · {}", impasse.task, impasse.step, to_string(impasse.reason));
  for (const std::string& line : wrapped(title, kTitle, canvas.width - 2 * kGap, 1))
    canvas.text(kGap, kGap + kTitle, line, kTitle, kInk);
  const std::string facts = fmt::format("{}{}seed {} · {} of {} {} drawn, the nearest miss more solid",
                                        impasse.variation, impasse.variation.empty() ? "" : " · ", impasse.seed, ghosts,
                                        impasse.looked.size(), hands ? "grasps" : "places");
  canvas.text(kGap, kGap + 2 * kTitle + 2, facts, kLetters, kFaint);
  int baseline = below + kLetters + 4;
  for (const LegendLine& line : std::span(legend).first(std::min(legend.size(), kMostLines))) {
    canvas.fill(kGap, baseline - kLetters + 2, kLetters, kLetters, bytes_of(line.colour));
    canvas.text(2 * kGap + kLetters, baseline,
                fmt::format("{} {}{}", line.count, line.text, least(impasse.looked, line.text)), kLetters, kInk);
    baseline += kLetters + 6;
  }
  if (const Looked* nearest = nearest_miss(impasse.looked))
    canvas.text(kWide + 2 * kGap, below + kLetters + 4, "nearest miss: " + miss_of(*nearest), kLetters, kInk);
  if (impasse.looked.empty())
    canvas.text(kGap, baseline, "nothing was to be tried: there is no room, or no two sides to hold", kLetters, kInk);
}

}  // namespace

void draw_impasse(const Impasse& impasse, const std::filesystem::path& file) {
  const bool hands = impasse.reason == Reason::no_grasp;
  const std::vector<LegendLine> legend = legend_of(impasse.looked);
  const std::vector<Ghost> ghosts = chosen_ghosts(impasse.looked, legend, hands);
  const Looked* nearest = nearest_miss(impasse.looked);
  Scene scene = *impasse.scene, solid;
  show_regions(impasse.step, scene);
  fade(scene, impasse.subject);
  SceneState state = impasse.state;
  const std::size_t first_ghost = scene.bodies.size();
  solid = scene;
  Ball near;
  for (std::size_t i = 0; i < ghosts.size(); ++i) {
    const Looked& looked = *ghosts[i].looked;
    Colour colour = ghosts[i].colour;
    const std::string name = "ghost" + std::to_string(i);
    solid.bodies.push_back(ghost_of(scene, impasse, looked, name, colour));
    colour.alpha = &looked == nearest ? kNearest : kGhost;
    scene.bodies.push_back(ghost_of(scene, impasse, looked, name, colour));
    state.world_from_body.push_back(looked.pose);
    state.joint_position.push_back({0});
    add_body(scene.bodies.back(), {looked.pose}, near);
  }
  for (Scene* one : {&scene, &solid}) {
    one->classes.clear();
    number_masks(*one, RandomKey("ghosts"));
  }
  const ScenePoses poses = scene_poses(scene, state);
  const Object* object = scene.object(impasse.subject);
  if (hands && object != nullptr && scene.body_index(object->body) >= 0) {
    const auto body = static_cast<std::size_t>(scene.body_index(object->body)),
               part = static_cast<std::size_t>(object->part);
    const auto [low, high] = bounding_box(scene.bodies[body].parts[part]);
    near.add(poses.world_from_part[body][part] * Vector3((low + high) / 2), (high - low).norm() / 2);
  }
  Ball far = near;
  add_body(scene.robot.body, poses.world_from_robot_part, far);
  if (near.empty()) near = far;
  const auto renderer = make_renderer();
  const Direction from =
      best_direction(*renderer, std::make_shared<const Scene>(solid), poses, near, first_ghost, impasse.subject);
  DrawOptions options;
  options.kinds = {true, false, false, false};
  options.shadows = true;
  options.samples = 3;
  const std::vector<View> views = {view_at(near, from.azimuth, from.elevation, kWide, kHigh),
                                   view_at(far, from.azimuth, std::min(from.elevation, 0.5), kWide, kHigh)};
  std::vector<Picture> pictures;
  renderer->load(std::make_shared<const Scene>(scene));
  renderer->draw(poses, views, options, pictures);
  const int top = 2 * kGap + 2 * kTitle;
  const int words = (static_cast<int>(std::clamp<std::size_t>(legend.size(), 1, kMostLines)) + 1) * (kLetters + 6);
  std::vector<Canvas> page;
  Canvas& canvas = page.emplace_back(2 * kWide + 3 * kGap, top + kHigh + words + kGap, kPaper);
  canvas.put(kGap, top, pictures[0]);
  canvas.put(kWide + 2 * kGap, top, pictures[1]);
  write_words(canvas, impasse, legend, ghosts.size(), top + kHigh);
  write_sheet(file, page);
}

}  // namespace stampede::program
