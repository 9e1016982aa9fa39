// A picture of what was turned down: ghosts in the scene of the moment, seen from where most of them can be seen.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <span>

#include "engine/model/camera.h"
#include "engine/model/masks.h"
#include "engine/render/renderer.h"
#include "scripting/commands/check_failures.h"
#include "scripting/commands/check_ghosts.h"
#include "scripting/commands/render_output.h"

namespace stampede::program {
namespace {

constexpr int kWide = 600, kHigh = 520, kGap = 10, kLetters = 14, kTitle = 19, kLook = 96;
constexpr std::size_t kMostLines = 8;
constexpr double kGhost = 0.28, kNearest = 0.75;  // alpha
constexpr double kMuch = 0.25;                    // power of a share: half of a thing is nearly all of it
constexpr std::array<std::uint8_t, 3> kPaper{250, 250, 248}, kInk{30, 32, 36}, kFaint{110, 114, 120};

std::array<std::uint8_t, 3> bytes_of(const Colour& colour) {
  const auto byte = [](double value) { return static_cast<std::uint8_t>(std::lround(255 * value)); };
  return {byte(colour.red), byte(colour.green), byte(colour.blue)};
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

// By instance: every ghost, and the thing itself, which counts as much as three.
std::map<int, double> weights_of(const Scene& scene, std::size_t first_ghost, const std::string& subject) {
  std::map<int, double> weights;
  for (std::size_t body = first_ghost; body < scene.bodies.size(); ++body)
    weights[scene.bodies[body].parts[0].instance] = 1;
  const Object* object = scene.object(subject);
  const int body = object == nullptr ? -1 : scene.body_index(object->body);
  if (body >= 0)
    weights[scene.bodies[static_cast<std::size_t>(body)].parts[static_cast<std::size_t>(object->part)].instance] = 3;
  return weights;
}

// From where most of each of these is to be seen.
Direction best_direction(Renderer& renderer, const std::shared_ptr<const Scene>& opaque, const ScenePoses& poses,
                         const Ball& ball, const std::map<int, double>& weights) {
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

// ` (2 mm at least)`, of the nearest miss of a cause.
std::string least(const std::vector<Looked>& looked, const std::string& cause) {
  std::vector<Looked> same;
  std::copy_if(looked.begin(), looked.end(), std::back_inserter(same),
               [&](const Looked& one) { return cause_of(one) == cause; });
  const Looked* nearest = nearest_miss(same);
  const std::string amount = nearest == nullptr ? "" : amount_of(*nearest);
  return amount.empty() ? "" : " (" + amount + " at least)";
}

bool is_grasp(const Looked& looked) { return looked.opening > 0; }
bool is_usable(const Looked& looked) { return looked.fate == Looked::Fate::usable; }

void write_words(Canvas& canvas, const Impasse& impasse, const std::vector<LegendLine>& legend, std::size_t ghosts,
                 int below) {
  const bool usable = std::any_of(impasse.looked.begin(), impasse.looked.end(), is_usable);
  const bool hands = std::any_of(impasse.looked.begin(), impasse.looked.end(), is_grasp);
  const std::string title = fmt::format("{}: {} · {}", impasse.task, impasse.step, to_string(impasse.reason));
  for (const std::string& line : wrapped(title, kTitle, canvas.width - 2 * kGap, 1))
    canvas.text(kGap, kGap + kTitle, line, kTitle, kInk);
  const std::string facts = fmt::format(
      "{}{}seed {} · {} of {} {} drawn{}", impasse.variation, impasse.variation.empty() ? "" : " · ", impasse.seed,
      ghosts, impasse.looked.size(), hands ? "grasps" : "places", usable ? "" : ", the nearest miss more solid");
  canvas.text(kGap, kGap + 2 * kTitle + 2, facts, kLetters, kFaint);
  int baseline = below + kLetters + 4;
  for (const LegendLine& line : std::span(legend).first(std::min(legend.size(), kMostLines))) {
    canvas.fill(kGap, baseline - kLetters + 2, kLetters, kLetters, bytes_of(line.colour));
    canvas.text(2 * kGap + kLetters, baseline,
                fmt::format("{} {}{}", line.count, line.text, least(impasse.looked, line.text)), kLetters, kInk);
    baseline += kLetters + 6;
  }
  if (const Looked* nearest = nearest_miss(impasse.looked); nearest != nullptr && !usable)
    canvas.text(kWide + 2 * kGap, below + kLetters + 4, "nearest miss: " + miss_of(*nearest), kLetters, kInk);
  if (impasse.looked.empty())
    canvas.text(kGap, baseline, "nothing was to be tried: there is no room, or no two sides to hold", kLetters, kInk);
}

}  // namespace

void draw_impasse(const Impasse& impasse, const std::filesystem::path& file, const OutputRules& rules) {
  const bool hands = std::any_of(impasse.looked.begin(), impasse.looked.end(), is_grasp);
  const std::vector<LegendLine> legend = legend_of(impasse.looked);
  const std::vector<Ghost> ghosts = chosen_ghosts(impasse.looked, legend, hands);
  const bool usable = std::any_of(impasse.looked.begin(), impasse.looked.end(), is_usable);
  const Looked* nearest = usable ? nullptr : nearest_miss(impasse.looked);
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
  const Direction from = best_direction(*renderer, std::make_shared<const Scene>(solid), poses, near,
                                        weights_of(solid, first_ghost, impasse.subject));
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
  write_sheet(file, page, rules);
}

}  // namespace stampede::program
