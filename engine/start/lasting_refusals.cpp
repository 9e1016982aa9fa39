#include "engine/start/lasting_refusals.h"

#include <algorithm>

#include "engine/motion/looked.h"
#include "engine/sim/world.h"
#include "engine/start/refusals.h"
#include "engine/start/world_view.h"

namespace stampede {
namespace {

constexpr double kFar_m = 0.05;       // out of reach by this: from wherever the arm starts
constexpr double kMetresOfRad = 0.3;  // as nearest_miss has it

// The bits of what a body is and of where it is, as far as the arm can meet it.
class StandingText {
 public:
  const std::string& text() const { return text_; }

  // `moved`: with where its joints are.
  void add(const Scene& scene, const Body& body, bool moved) {
    add(body.name);
    add(body.world_from_body);
    for (const Part& part : body.parts) {
      const Joint& joint = part.joint;
      if (moved) add_bits(joint.initial);
      for (const double value : {joint.lower, joint.upper}) add_bits(value);
      add(joint.parent_from_joint);
      for (const Shape& shape : part.shapes) add(shape);
    }
    for (const Object& thing : scene.objects)
      if (thing.body == body.name) add(thing);
    if (!body.joined_to.empty()) add(scene, scene.body_at(scene.body_index(body.joined_to)), moved);
  }

 private:
  template <typename T>
  void add_bits(const T& value) {
    text_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  void add(const std::string& text) { text_ += text + '\n'; }
  void add(const Vector3& vector) {
    for (int i = 0; i < 3; ++i) add_bits(vector[i]);
  }
  void add(const Transform& pose) {
    for (int i = 0; i < 16; ++i) add_bits(pose.matrix().data()[i]);
  }
  void add(const Shape& shape) {
    if (!shape.collides) return;
    add_bits(shape.kind);
    add(shape.size);
    for (const double value : {shape.radius, shape.length}) add_bits(value);
    for (const Vector3& point : shape.points) add(point);
    add(shape.part_from_shape);
  }
  void add(const Object& thing) {
    add(thing.name);
    for (const Grasp& grasp : thing.grasps) {
      add(grasp.object_from_tip);
      for (const double value : {grasp.width, grasp.approach, grasp.force}) add_bits(value);
    }
    for (const auto& [name, number] : thing.numbers) add(name), add_bits(number);
  }

  std::string text_;
};

std::string standing_text(const Scene& scene, std::size_t body) {
  StandingText text;
  const bool robot = body == scene.bodies.size();  // which starts elsewhere in each draw
  text.add(scene, robot ? scene.robot.body : scene.bodies[body], !robot);
  return text.text();
}

}  // namespace

std::shared_ptr<const Scene> LastingRefusals::scene_of(const Literal& condition, const Scene& now) const {
  const auto known = known_.find(text_of(condition));
  if (known == known_.end()) return nullptr;
  for (const auto& [scene, standing] : known->second.for_good) {
    const bool alike = scene->bodies.size() == now.bodies.size() && std::ranges::all_of(standing, [&](const auto& one) {
                         return one.second == standing_text(now, one.first);
                       });
    if (alike) return scene;
  }
  return nullptr;
}

void LastingRefusals::add(const Literal& condition, std::shared_ptr<const Scene> scene) {
  const auto [found, first] = known_.try_emplace(text_of(condition), Known{scene, {}});
  Known& known = found->second;
  if (first || !known.last || condition.negated) return;
  const std::shared_ptr<const Scene> last = std::exchange(known.last, scene);
  if (last->bodies.size() != scene->bodies.size()) return;
  std::vector<Standing> alike;
  for (std::size_t body = 0; body <= scene->bodies.size(); ++body)
    if (std::string text = standing_text(*scene, body); text == standing_text(*last, body))
      alike.emplace_back(body, std::move(text));
  const auto stands = [&](std::size_t body) {
    return std::ranges::any_of(alike, [&](const Standing& one) { return one.first == body; });
  };
  const bool all_stand = std::ranges::all_of(condition.fact.arguments, [&](const std::string& name) {
    const Object* thing = scene->object(name);
    const int body = thing == nullptr ? -1 : scene->body_index(thing->body);
    return body >= 0 && stands(static_cast<std::size_t>(body));
  });
  if (!all_stand || !stands(scene->bodies.size())) return;
  if (out_of_reach(condition, *scene, alike))
    known.for_good.emplace_back(std::move(scene), std::move(alike));
  else
    known.last = nullptr;
}

bool LastingRefusals::out_of_reach(const Literal& condition, const Scene& scene,
                                   const std::vector<Standing>& alike) const {
  Scene bare = scene;
  double offset = 1000;  // m: out of everyone's way, and of what has no place yet
  for (std::size_t body = 0; body < bare.bodies.size(); ++body)
    if (std::ranges::none_of(alike, [&](const Standing& one) { return one.first == body; }))
      bare.bodies[body].world_from_body = translation(offset += 10, 0, 0);
  World world(std::make_shared<const Scene>(std::move(bare)));
  std::vector<Looked> looked;
  const Symbols::Watching watching(symbols_, &looked);
  const Symbols::Value value = symbols_.value(condition.fact, WorldView(world));
  const Looked* nearest = nearest_miss(looked);
  if (value.holds || !value.asked_arm || nearest == nullptr) return false;
  const bool all =
      std::ranges::all_of(looked, [](const Looked& one) { return one.fate == Looked::Fate::out_of_reach; });
  return all && std::max(nearest->missed_m, kMetresOfRad * nearest->missed_rad) >= kFar_m;
}

}  // namespace stampede
