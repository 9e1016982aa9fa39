#include "engine/rollout/recorder.h"

#include <algorithm>

#include "engine/record/scene_record.h"
#include "engine/sim/world.h"

namespace stampede {
namespace {

// The most exact name for a part: the part object if there is one, else its body; robot parts keep their link name.
std::pair<std::string, std::string> name_of(const Scene& scene, PartRef ref) {
  if (ref.on_robot()) return {scene.robot.name, scene.robot.body.parts[static_cast<std::size_t>(ref.part)].name};
  const Body& body = scene.bodies[static_cast<std::size_t>(ref.body)];
  return {body.name, body.parts[static_cast<std::size_t>(ref.part)].name};
}

}  // namespace

FrameReader::FrameReader(const WorldView& view) : FrameReader(view, joints_of(view.scene())) {}

FrameReader::FrameReader(const WorldView& view, std::vector<JointName> joints) : joints_(std::move(joints)) {
  const Scene& scene = view.scene();
  for (const Object& thing : scene.objects)
    if (thing.kind != ObjectKind::hand) posed_.push_back(thing.name);
}

FrameRecord FrameReader::read(const WorldView& view) const {
  const World& world = view.world();
  FrameRecord frame;
  frame.step = world.step_count();
  for (const JointName& joint : joints_) {
    frame.joint_position.push_back(world.joint_position(joint.part));
    frame.joint_velocity.push_back(world.joint_velocity(joint.part));
    frame.joint_effort.push_back(world.joint_effort(joint.part));
  }
  for (const std::string& name : posed_) frame.object_pose.push_back(to_pose(view.world_from(name)));
  for (const Camera& camera : view.scene().cameras) {
    Transform world_from_mount = Transform::Identity();
    const bool robot = camera.mount_body == view.scene().robot.name;
    if (!camera.mount_body.empty())
      world_from_mount =
          world.world_from_part({robot ? -1 : view.scene().body_index(camera.mount_body), camera.mount_part});
    frame.camera_pose.push_back(to_pose(world_from_mount * camera.mount_from_camera));
  }
  HandRecord hand;
  hand.tip = to_pose(world.world_from_tip());
  const Eigen::Matrix<double, 6, 1> twist = world.arm().jacobian(world.arm_position()) * world.arm_velocity();
  for (std::size_t i = 0; i < 6; ++i) hand.twist[i] = twist[static_cast<Eigen::Index>(i)];
  hand.opening = world.opening();
  const auto& pads = view.scene().robot.pads;
  for (const Contact& contact : world.contacts())
    for (std::size_t pad = 0; pad < std::min<std::size_t>(2, pads.size()); ++pad)
      if (contact.a == PartRef::of_robot(pads[pad]) || contact.b == PartRef::of_robot(pads[pad]))
        hand.touch[pad] += contact.mean_force;
  frame.hands.push_back(hand);
  return frame;
}

ActionRecord FrameReader::action(const World& world) const {
  ActionRecord action;
  const JointVector reference = world.reference().position;
  // A way that ends at a stop may miss it by a hair: what is stored is what an agent may ask for.
  for (Eigen::Index i = 0; i < reference.size(); ++i) {
    const JointLimits& limits = world.arm().limits()[static_cast<std::size_t>(i)];
    const bool limited = limits.lower < limits.upper;
    action.joint_position.push_back(limited ? std::clamp(reference[i], limits.lower, limits.upper) : reference[i]);
  }
  action.tool_pose = to_pose(world.arm().world_from_tip(reference));
  action.gripper = world.commanded_opening();
  return action;
}

Recorder::Recorder(const WorldView& view)
    : reader_(view), steps_per_frame_(view.scene().physics_hz / view.scene().frame_hz) {}

void Recorder::first_frame(const WorldView& view) { frames.push_back(reader_.read(view)); }

void Recorder::frame(const WorldView& view, double reward) {
  FrameRecord& last = frames.edit_back();
  last.action = reader_.action(view.world());
  last.reward = reward;
  frames.push_back(reader_.read(view));
}

void Recorder::contacts(const WorldView& view) {
  const auto now = static_cast<std::int64_t>(frames.size());  // the window just closed ends at this frame
  std::map<std::pair<std::string, std::string>, ContactRecord> touching;
  for (const Contact& contact : view.world().contacts()) {
    const auto [object_a, part_a] = name_of(view.scene(), contact.a);
    const auto [object_b, part_b] = name_of(view.scene(), contact.b);
    ContactRecord record{object_a, part_a, object_b, part_b, now - 1, now, contact.peak_force};
    touching[{object_a + "/" + part_a, object_b + "/" + part_b}] = std::move(record);
  }
  for (auto& [pair, record] : touching)
    if (const auto open = contacts_open_.find(pair); open != contacts_open_.end()) {
      record.first_frame = open->second.first_frame;
      record.peak_force = std::max(record.peak_force, open->second.peak_force);
    }
  for (const auto& [pair, record] : contacts_open_)
    if (!touching.contains(pair)) contacts_closed_.push_back(record);
  contacts_open_ = std::move(touching);
}

int Recorder::open_segment(SegmentRecord segment, std::int64_t step) {
  segment.ordinal = static_cast<int>(segments.size());
  segment.span.start_step = segment.span.end_step = step;
  segment.span.first_frame = segment.span.end_frame = frame_at(step);
  segments.push_back(std::move(segment));
  return segments.back().ordinal;
}

void Recorder::close_segment(int ordinal, std::int64_t step, Reason reason, std::string detail) {
  SegmentRecord& record = segment(ordinal);
  record.span.end_step = step;
  record.span.end_frame = frame_at(step);
  record.outcome = reason == Reason::none ? Outcome::success : Outcome::failure;
  record.reason = reason;
  record.detail = std::move(detail);
}

std::optional<std::size_t> Recorder::place_of_last(std::int64_t segment) const {
  for (std::size_t i = agent_actions.size(); i-- > 0;)
    if (agent_actions[i].segment == segment) return i;
  return std::nullopt;
}

AskedAction* Recorder::last_asked(std::int64_t segment) {
  const std::optional<std::size_t> last = place_of_last(segment);
  return last ? &agent_actions.edit(*last) : nullptr;
}

void Recorder::end_asked(std::int64_t segment, std::int64_t step) {
  if (AskedAction* last = last_asked(segment)) last->end_frame = frame_at(step);
}

void Recorder::refuse_asked(std::int64_t segment) {
  if (const std::optional<std::size_t> last = place_of_last(segment)) agent_actions.erase(*last);
}

Recorder::Mark Recorder::mark() const {
  return {frames.size(),           segments.size(),      vias.size(),   grasps.size(),
          contacts_closed_.size(), agent_actions.size(), contacts_open_};
}

void Recorder::cut(const Mark& mark) {
  frames.shorten(mark.frames);
  FrameRecord& last = frames.edit_back();
  last.action.reset();
  last.reward = 0;
  segments.shorten(mark.segments);
  vias.shorten(mark.vias);
  grasps.shorten(mark.grasps);
  contacts_closed_.shorten(mark.contacts_closed);
  agent_actions.shorten(mark.agent_actions);
  contacts_open_ = mark.contacts_open;
}

void Recorder::forget_frames() {
  frames.keep_last(1);
  contacts_closed_.clear();
}

void Recorder::forget_segments(std::size_t first_segment) {
  segments.shorten(first_segment);
  attempts.clear();
  vias.clear();
  grasps.clear();
}

void Recorder::finish(EpisodeRecord& episode, std::int64_t end_step) {
  for (const auto& [pair, record] : contacts_open_) contacts_closed_.push_back(record);
  episode.labels.contacts = contacts_closed_.take();
  std::sort(episode.labels.contacts.begin(), episode.labels.contacts.end(),
            [](const ContactRecord& a, const ContactRecord& b) {
              return std::tie(a.first_frame, a.object_a, a.part_a, a.object_b, a.part_b) <
                     std::tie(b.first_frame, b.object_a, b.part_a, b.object_b, b.part_b);
            });
  const auto count = static_cast<std::int64_t>(frames.size());
  episode.labels.segments = segments.take();
  for (SegmentRecord& record : episode.labels.segments)
    if (record.span.end_step == end_step) record.span.end_frame = count;  // the last frame belongs to what ended there
  episode.scene.joints = reader_.joints();
  episode.scene.posed = reader_.posed();
  episode.frames = frames.take();
  episode.labels.attempts = attempts.take();
  episode.labels.vias = vias.take();
  episode.labels.grasps = grasps.take();
  episode.agent_actions = agent_actions.take();
}

}  // namespace stampede
