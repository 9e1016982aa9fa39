#include "db/check_numbers.h"

#include <cmath>
#include <initializer_list>
#include <span>

#include "engine/base/error.h"

namespace stampede {
namespace {

constexpr std::int64_t kMostParts = 1 << 20;
constexpr std::int64_t kMostInstances = 1 << 16;  // numbers in a mask

class Checker {
 public:
  Checker(const EpisodeRecord& episode, const std::string& path, std::int64_t id)
      : e_(episode),
        path_(path),
        where_("episode " + std::to_string(id) + ", "),
        frames_(static_cast<std::int64_t>(episode.frames.size())),
        segments_(static_cast<std::int64_t>(episode.labels.segments.size())) {}

  void check() const {
    frames();
    segments();
    for (const FactRecord& f : e_.labels.facts) interval("a fact", f);
    for (const FactRecord& f : e_.labels.observed_facts) interval("an observed fact", f);
    passages();
    names();
  }

 private:
  void within(const char* what, std::int64_t value, std::int64_t least, std::int64_t most) const {
    if (value < least || value > most) require_within(path_, where_ + what, value, least, most);
  }
  void span(const char* what, const Span& s, std::int64_t steps, std::int64_t frames) const {
    within(what, s.start_step, 0, steps);
    within(what, s.end_step, s.start_step, steps);
    within(what, s.first_frame, 0, frames);
    within(what, s.end_frame, s.first_frame, frames);
  }
  void interval(const char* what, const FactRecord& f) const {
    span(what, {f.start_step, f.end_step, f.first_frame, f.end_frame}, e_.steps, frames_);
  }
  void frames() const {
    std::int64_t least = 0;
    for (const FrameRecord& frame : e_.frames) {
      within("a frame's step", frame.step, least, e_.steps);
      least = frame.step + 1;
      poses(frame);
    }
    for (const Command& command : e_.commands) within("a command's step", command.step, 0, e_.steps);
    for (const AskedAction& one : e_.agent_actions) {
      span("an agent's action", {0, 0, one.first_frame, one.end_frame}, 0, frames_);
      within("an agent's action's segment", one.segment, -1, segments_ - 1);
    }
    for (const ChannelRecord& channel : e_.channels) {
      for (const std::int64_t step : channel.steps) within("a sample's step", step, 0, e_.steps);
      const auto values = static_cast<std::int64_t>(channel.steps.size() * channel.components.size());
      within("a sensor's number of values", static_cast<std::int64_t>(channel.values.size()), values, values);
    }
    for (const auto& [method, list] : e_.labels.keyframes)
      for (const std::int64_t frame : list) within("a keyframe", frame, 0, frames_ - 1);
  }
  void segments() const {
    std::int64_t ordinal = 0;
    for (const SegmentRecord& s : e_.labels.segments) {
      within("a segment's ordinal", s.ordinal, ordinal, ordinal);
      within("a segment's parent", s.parent, -1, ordinal - 1);
      span("a segment's span", s.span, e_.steps, frames_);
      ++ordinal;
    }
    // An undone try counts on a time line of its own, which went on for no longer than a very long episode.
    constexpr std::int64_t kLong = std::int64_t{1} << 40;
    for (const AttemptRecord& a : e_.labels.attempts) {
      within("an undone try's place", a.before_segment, 0, segments_);
      within("an undone try's number", a.try_number, 1, kLong);
      span("an undone try's span", a.segment.span, kLong, kLong);
    }
  }
  void passages() const {
    for (const ViaRecord& v : e_.labels.vias) {
      within("a via-point's segment", v.segment, 0, segments_ - 1);
      within("a via-point's step", v.step, 0, e_.steps);
    }
    for (const ContactRecord& c : e_.labels.contacts) span("a contact", {0, 0, c.first_frame, c.end_frame}, 0, frames_);
    for (const GraspRecord& g : e_.labels.grasps) within("a grasp's segment", g.segment, 0, segments_ - 1);
    for (const LanguageRecord& l : e_.labels.language) within("a sentence's segment", l.segment, -1, segments_ - 1);
  }
  void names() const {
    for (const Camera& c : e_.scene.cameras) {
      within("a camera's width", c.width, 1, kMostPixels);
      within("a camera's height", c.height, 1, kMostPixels);
      within("a camera's part", c.mount_part, -1, kMostParts);
      finite("a camera's lens", {c.focal_x, c.focal_y, c.centre_x, c.centre_y, c.near_m, c.far_m});
      finite("a camera's lens", c.distortion);
      finite("a camera's mount", std::span(c.mount_from_camera.matrix().data(), 16));
    }
    for (const JointName& j : e_.scene.joints) {
      within("a joint's body", j.part.body, -1, kMostParts);
      within("a joint's part", j.part.part, 0, kMostParts);
    }
    for (const MaskEntry& m : e_.scene.masks) {
      within("a mask's instance", m.instance, 1, kMostInstances);
      within("a mask's class", m.semantic, 1, kMostInstances);
    }
    for (const ImageTimeRecord& i : e_.image_times) {
      within("a picture's frame", i.frame, 0, frames_ - 1);
      within("a picture's camera", i.camera, 0, static_cast<std::int64_t>(e_.scene.cameras.size()) - 1);
    }
  }
  void finite(const char* what, std::span<const double> values) const {
    for (const double value : values)
      if (!std::isfinite(value))
        throw CatalogueError(path_, where_ + what + " is not finite",
                             "the file was damaged or changed by hand: take a copy of it, or generate it again");
  }
  void finite(const char* what, std::initializer_list<double> values) const {
    finite(what, std::span<const double>(values.begin(), values.size()));
  }
  // Of recordings much is not known (NaN); nothing is infinite.
  void bounded(const char* what, std::span<const double> values) const {
    for (const double value : values)
      if (std::isinf(value)) finite(what, {value});
  }
  void poses(const FrameRecord& frame) const {
    for (const auto* list : {&frame.object_pose, &frame.camera_pose})
      for (const Pose& pose : *list) bounded("a pose", pose.position), bounded("a pose", pose.quaternion);
    for (const HandRecord& hand : frame.hands)
      bounded("a hand", hand.tip.position), bounded("a hand", hand.tip.quaternion);
    bounded("a joint's position", frame.joint_position);
  }

  const EpisodeRecord& e_;
  const std::string& path_;
  std::string where_;
  std::int64_t frames_, segments_;
};

}  // namespace

void require_within(const std::string& path, const std::string& what, std::int64_t value, std::int64_t least,
                    std::int64_t most) {
  if (value >= least && value <= most) return;
  throw CatalogueError(
      path,
      what + " is " + std::to_string(value) + ", and can be " + std::to_string(least) + " to " + std::to_string(most),
      "the file was damaged or changed by hand: take a copy of it, or generate it again");
}

void check_numbers(const EpisodeRecord& episode, const std::string& path, std::int64_t id) {
  Checker(episode, path, id).check();
}

}  // namespace stampede
