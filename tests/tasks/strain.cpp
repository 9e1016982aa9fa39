#include "tests/tasks/strain.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>
#include <set>

#include "engine/model/kinematics.h"
#include "engine/sim/world.h"

namespace stampede::test {
namespace {

std::string part_name(const Scene& scene, PartRef ref) {
  const Body& body = ref.body < 0 ? scene.robot.body : scene.bodies[static_cast<std::size_t>(ref.body)];
  const std::string& name = ref.body < 0 ? scene.robot.name : body.name;
  const std::string& part = body.parts[static_cast<std::size_t>(ref.part)].name;
  return part.empty() || part == name ? name : name + "." + part;
}

class Measurement {
 public:
  explicit Measurement(const EpisodeRecord& episode)
      : episode_(episode), world_(std::make_shared<const Scene>(scene_from_document(episode.scene.document))) {}

  Strain run() {
    const std::int64_t per_frame = episode_.physics_hz / episode_.frame_hz;
    std::size_t next = 0;
    while (world_.step_count() < episode_.steps) {
      while (next < episode_.commands.size() && episode_.commands[next].step == world_.step_count())
        world_.apply(episode_.commands[next++].operation);
      find_segments();
      world_.step();
      after_step();
      if (world_.step_count() % per_frame != 0) continue;
      world_.close_window();
      after_frame();
    }
    return finish();
  }

 private:
  // The innermost motion and skill that run at this step.
  void find_segments() {
    const std::int64_t step = world_.step_count();
    motion_ = nullptr;
    for (const SegmentRecord& segment : episode_.labels.segments) {
      const bool runs = segment.span.start_step <= step && step < segment.span.end_step;
      if (runs && segment.kind == SegmentKind::motion) motion_ = &segment;
      if (runs && segment.kind == SegmentKind::skill) skill_ = &segment;
    }
    if (motion_ != known_motion_) {
      known_motion_ = motion_;
      touched_.clear();
      for (const Contact& contact : world_.contacts()) touched_.insert({contact.a, contact.b});
    }
  }

  std::string place() const {
    char time[32];
    std::snprintf(time, sizeof time, "%.2f s", static_cast<double>(world_.step_count()) / episode_.physics_hz);
    std::string text = time;
    if (skill_) text += ", " + skill_->label;
    if (motion_) text += ", " + motion_->skill;
    return text;
  }

  void after_step() {
    const Scene& scene = world_.scene();
    for (const JointName& joint : episode_.scene.joints) {
      if (!(joint.lower < joint.upper)) continue;
      const double q = world_.joint_position(joint.part);
      const double beyond = std::max(joint.lower - q, q - joint.upper);
      (joint.unit == "m" ? strain_.beyond_m : strain_.beyond_rad).meet(beyond, joint.name + " at " + place());
    }
    const JointVector speed = world_.arm_velocity();
    const Vector3 tool = world_.arm().jacobian(world_.arm_position()).topRows<3>() * speed;
    strain_.tool_speed.meet(tool.norm(), place());
    bool saturated = false;
    for (std::size_t j = 0; j < scene.robot.arm.size(); ++j) {
      const double most = scene.robot.limits[j].effort;
      saturated = saturated || (most > 0 && std::abs(world_.joint_effort({-1, scene.robot.arm[j]})) > 0.999 * most);
    }
    saturated_steps_ += saturated;
    for (const SegmentRecord& segment : episode_.labels.segments)
      if (segment.kind == SegmentKind::skill && segment.span.end_step == world_.step_count())
        strain_.end_speed.meet(speed.cwiseAbs().maxCoeff(), "the end of: " + segment.label);
  }

  void after_frame() {
    const Scene& scene = world_.scene();
    const std::optional<PartRef> held = world_.grasped();
    follow_held(held);
    const bool free_motion =
        motion_ && (motion_->skill == "move_through" || motion_->skill == "move_to" || motion_->skill == "move_joints");
    std::set<std::pair<PartRef, PartRef>> touching;
    std::map<std::pair<PartRef, PartRef>, std::array<double, 3>> recent;
    for (const Contact& contact : world_.contacts()) {
      const std::string what = part_name(scene, contact.a) + " and " + part_name(scene, contact.b) + " at " + place();
      strain_.force.meet(contact.peak_force, what);
      std::array<double, 3>& depths = recent[{contact.a, contact.b}];
      if (const auto before = depths_.find({contact.a, contact.b}); before != depths_.end()) depths = before->second;
      depths = {contact.depth, depths[0], depths[1]};
      strain_.depth.meet(*std::min_element(depths.begin(), depths.end()), what);
      forces_.push_back(contact.peak_force);
      const bool of_robot = contact.a.body == -1, of_held = held && (contact.a == *held || contact.b == *held);
      const bool grasp = of_robot && held && contact.b == *held;
      touching.insert({contact.a, contact.b});
      // What touched already when the motion began is on its way out.
      if (free_motion && (of_robot || of_held) && !grasp && !touched_.contains({contact.a, contact.b}))
        strain_.free_force.meet(contact.peak_force, what);
    }
    depths_ = std::move(recent);
    for (auto it = touched_.begin(); it != touched_.end();)
      it = touching.contains(*it) ? std::next(it) : touched_.erase(it);
  }

  // From 0.1 s after the fingers have closed on a free body until they open.
  void follow_held(std::optional<PartRef> held) {
    if (held && !world_.scene().bodies[static_cast<std::size_t>(held->body)].free) held.reset();
    const bool opening = motion_ && motion_->skill == "open_hand";
    if (!held || opening || held != held_) {
      held_ = opening ? std::nullopt : held;
      held_frames_ = 0;
      return;
    }
    const Transform tip_from_held = world_.world_from_tip().inverse() * world_.world_from_part(*held);
    const Vector3 centre = tip_from_held * world_.scene()
                                               .bodies[static_cast<std::size_t>(held->body)]
                                               .parts[static_cast<std::size_t>(held->part)]
                                               .centre_of_mass;
    if (++held_frames_ <= 2) {
      held_centre_ = centre;
      return;
    }
    strain_.slip.meet((centre - held_centre_).norm(), part_name(world_.scene(), *held) + " at " + place());
  }

  Strain finish() {
    std::sort(forces_.begin(), forces_.end());
    if (!forces_.empty()) strain_.median_force = forces_[forces_.size() / 2];
    strain_.saturated =
        episode_.steps > 0 ? static_cast<double>(saturated_steps_) / static_cast<double>(episode_.steps) : 0;
    strain_.seconds = episode_.duration_s();
    return strain_;
  }

  const EpisodeRecord& episode_;
  World world_;
  Strain strain_;
  const SegmentRecord* motion_ = nullptr;
  const SegmentRecord* known_motion_ = nullptr;
  const SegmentRecord* skill_ = nullptr;
  std::set<std::pair<PartRef, PartRef>> touched_;                        // since before this motion
  std::map<std::pair<PartRef, PartRef>, std::array<double, 3>> depths_;  // in the last three frames
  std::vector<double> forces_;
  std::optional<PartRef> held_;
  int held_frames_ = 0;
  Vector3 held_centre_ = Vector3::Zero();
  std::int64_t saturated_steps_ = 0;
};

}  // namespace

Strain strain_of(const EpisodeRecord& episode) { return Measurement(episode).run(); }

std::string to_text(const Strain& strain) {
  std::string text;
  const auto line = [&](const char* name, const Worst& worst, double scale, const char* unit) {
    char number[64];
    std::snprintf(number, sizeof number, "%-12s %9.3f %s  ", name, scale * worst.value, unit);
    text += number + worst.where + "\n";
  };
  line("beyond", strain.beyond_m, 1000, "mm");
  line("beyond", strain.beyond_rad, 180 / 3.14159265358979, "deg");
  line("force", strain.force, 1, "N");
  line("free force", strain.free_force, 1, "N");
  line("depth", strain.depth, 1000, "mm");
  line("tool speed", strain.tool_speed, 1, "m/s");
  line("end speed", strain.end_speed, 1, "rad/s");
  line("slip", strain.slip, 1000, "mm");
  char rest[128];
  std::snprintf(rest, sizeof rest, "median force %.1f N, saturated %.2f %%, %.1f s\n", strain.median_force,
                100 * strain.saturated, strain.seconds);
  return text + rest;
}

}  // namespace stampede::test
