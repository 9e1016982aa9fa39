// One finished episode as plain values: what the runner produces, the catalogue stores and the replayer checks.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/reason.h"
#include "engine/geometry/transform.h"
#include "engine/model/masks.h"
#include "engine/model/operation.h"
#include "engine/model/part_ref.h"
#include "engine/symbolic/symbols.h"
#include "stampede/action.h"
#include "stampede/episode.h"

namespace stampede {

class ImageStore;  // observation.h

std::string_view to_string(Outcome outcome);

// A span of steps and frames, half-open. end_frame = first frame at or after end_step.
struct Span {
  std::int64_t start_step = 0, end_step = 0;
  std::int64_t first_frame = 0, end_frame = 0;
};

enum class ChosenBy {
  default_value,  // as the skill declares it
  stream,         // drawn among what the world allows
  planner,
  agent,   // who draws or decides skill by skill
  task,    // its `steps` say so
  caller,  // who asked for the run or the call says so: `--set`, EpisodeRequest::set, another skill
};
std::string_view to_string(ChosenBy value);  // the stored name: `default`, `stream` …
std::optional<ChosenBy> chosen_by_from(std::string_view name);

enum class SegmentKind { subgoal, skill, motion };
std::string_view to_string(SegmentKind kind);
std::optional<SegmentKind> segment_kind_from(std::string_view name);

// Whose word a segment or a fact is.
enum class Labeller { simulator, person, model };
std::string_view to_string(Labeller value);
std::optional<Labeller> labeller_from(std::string_view name);

struct ParameterRecord {  // a continuous parameter of a segment
  std::string name;       // `height`, `grasp`, `controller`
  std::vector<double> values;
  std::string text;  // instead of values: the controller's name
  std::string unit, frame;
  ChosenBy chosen_by = ChosenBy::default_value;
};

struct EffectRecord {  // a literal that an action's effect declares, ground for this call
  Fact fact;
  bool negated = false;
  friend bool operator==(const EffectRecord&, const EffectRecord&) = default;
};

// A literal of an action's precondition, ground for this call, and whether it held when it was tested.
struct PreconditionRecord {
  Fact fact;
  bool negated = false;
  bool held = false;
  int choice = -1;  // which `or` or `exists` it is a way to meet, from 0; -1: it must hold
  friend bool operator==(const PreconditionRecord&, const PreconditionRecord&) = default;
};

struct SegmentRecord {
  SegmentKind kind = SegmentKind::motion;
  int ordinal = 0;  // in the episode, by start then depth
  int parent = -1;  // ordinal, -1: none
  std::string robot;
  std::string skill;  // name of subgoal, skill or motion
  std::string case_name;
  std::vector<std::string> arguments;
  std::string controller;
  Span span;
  Outcome outcome = Outcome::success;
  Reason reason = Reason::none;
  std::string detail;                                  // for people
  std::optional<bool> precondition_held, effect_held;  // nothing: none declared or not reached
  std::vector<PreconditionRecord> preconditions;       // in the formula's order; of a forall each instance
  std::vector<EffectRecord> declared_effects;          // conditional and quantified ones already decided
  std::vector<std::string> forgotten;                  // predicates that contact leaves uncertain
  std::vector<std::string> missing_effects;            // literals that did not come true
  std::vector<std::string> searched_for;               // hidden facts that the plan assumed, and this skill showed
  std::string label;                                   // `pick up the red block`
  Labeller labelled_by = Labeller::simulator;
  std::vector<ParameterRecord> parameters;
};

// A try that was undone. Its steps and frames count from the start of the try on a time line that no longer exists.
struct AttemptRecord {
  SegmentRecord segment;
  int before_segment = 0;  // ordinal of the segment that took its place in the end (or the segment count)
  int try_number = 0;      // at this place in the plan, from 1
};

struct ViaRecord {
  int segment = 0;  // ordinal of the motion segment
  std::string name;
  Pose pose;              // as planned, world
  Pose passed;            // tip at the closest passage
  std::int64_t step = 0;  // of closest passage
  double speed = 0;       // greatest |joint velocity| there, rad/s
  double tool_speed = 0;  // m/s
};

struct FactRecord {
  Fact fact;
  std::int64_t start_step = 0, end_step = 0;
  std::int64_t first_frame = 0, end_frame = 0;
  bool open_start = false, open_end = false;
  bool observed = true;          // known all the time
  std::optional<double> margin;  // the greatest while it held
  Labeller labelled_by = Labeller::simulator;
};

struct ContactRecord {
  std::string object_a, part_a, object_b, part_b;
  std::int64_t first_frame = 0, end_frame = 0;
  double peak_force = 0;  // N
};

struct GraspRecord {
  int segment = 0;
  std::string object;
  Pose object_from_tip;
  double width = 0;  // opening measured when held, m
  bool held = false;
};

struct HandRecord {
  Pose tip;                       // world
  std::array<double, 6> twist{};  // linear m/s, angular rad/s, world
  double opening = 0;             // m
  std::array<double, 2> touch{};  // normal force at each pad, N
};

struct ActionRecord {                  // commanded over [frame, frame+1)
  std::vector<double> joint_position;  // reference at the end of the interval, rad
  Pose tool_pose;                      // of that reference
  double gripper = 0;                  // commanded opening, m
};

// Row t: the observation before action t, the reward and done after it; the last frame has no action. Of a real episode
// NaN stands for what is not known: the reward, positions in a gap of the recording, touches.
struct FrameRecord {
  std::int64_t step = 0;
  double reward = 0;
  bool done = false;
  std::vector<double> joint_position, joint_velocity, joint_effort;  // per EpisodeScene::joints
  std::vector<Pose> object_pose;                                     // per EpisodeScene::posed
  std::vector<HandRecord> hands;                                     // per EpisodeScene::hands
  std::vector<Pose> camera_pose;                                     // world, per EpisodeScene::cameras; or empty
  std::optional<ActionRecord> action;
};

struct JointName {
  std::string name;  // `panda.joint1`, `chest.top_drawer`
  PartRef part;
  std::string kind, unit;
  double lower = 0, upper = 0;
  bool driven = false;
};

enum class LanguageLevel { task, world, subgoal, skill, motion };
std::string_view to_string(LanguageLevel level);
std::optional<LanguageLevel> language_level_from(std::string_view name);

enum class LanguageSource { pattern, model, person };  // a pattern is stored as `template`
std::string_view to_string(LanguageSource source);
std::optional<LanguageSource> language_source_from(std::string_view name);

// How much of the way a sentence says.
enum class LanguageGrain { goal, steps, motions };
std::string_view to_string(LanguageGrain grain);
std::optional<LanguageGrain> language_grain_from(std::string_view name);

struct LanguageRecord {
  LanguageLevel level = LanguageLevel::task;
  std::string text;
  int segment = -1;  // levels subgoal, skill and motion: the segment
  LanguageSource source = LanguageSource::pattern;
  std::optional<LanguageGrain> grain = {};  // nothing: nobody said
  std::string model = {};                   // which model said it; empty: none
  friend bool operator==(const LanguageRecord&, const LanguageRecord&) = default;
};

enum class DocumentKind {
  pddl_domain,
  pddl_problem,
  plan,
  failed_plan,
  ordered_domain,   // with fluents for the goal's order
  ordered_problem,  // likewise
  bddl_libero,
  bddl_behavior,
};
std::string_view to_string(DocumentKind kind);
std::optional<DocumentKind> document_kind_from(std::string_view name);

struct DocumentRecord {
  DocumentKind kind = DocumentKind::plan;
  std::string text;
};

// The end of an episode by the rule of the dialect that its goal was written in, beside ours: the goal formula here.
struct VerdictRecord {
  std::string dialect;  // libero behavior
  bool theirs = false, ours = false;
  std::vector<std::string> disagreements;  // parts of the goal and ground literals
  friend bool operator==(const VerdictRecord&, const VerdictRecord&) = default;
};

// What a further sensor said, at its own rate: values[i * components … ) was read at steps[i].
struct ChannelRecord {
  std::string name;  // `wrench`
  std::string unit;
  std::vector<std::string> components;  // `force_x` …
  double rate_hz = 0;
  std::vector<std::int64_t> steps;
  std::vector<double> values;
};

// A stream that a real episode was recorded as, and how it became frames. Time on the recording's time line =
// stamp + offset_s + drift_ppm / 1e6 * (stamp - reference_s).
struct StreamRecord {
  std::string kind;   // joints gripper command wrench channel rgb depth
  std::string name;   // of the camera or channel; of the others their kind
  std::string file;   // in the recording folder
  std::string clock;  // empty: the recording's own
  double offset_s = 0, drift_ppm = 0, reference_s = 0;
  double origin_s = 0;        // that time at frame 0
  double rate_hz = 0;         // by the median way between two readings
  std::int64_t readings = 0;  // within the episode
  double longest_gap_s = 0;   // between two of them
  std::int64_t missing = 0;   // frames that have no value of it
  std::string rule;           // linear nearest hold kept
  friend bool operator==(const StreamRecord&, const StreamRecord&) = default;
};

// When the picture of a frame was taken, s from the start of the episode.
struct ImageTimeRecord {
  std::int64_t frame = 0;
  int camera = 0;    // index in EpisodeScene::cameras
  std::string kind;  // rgb depth
  double time_s = 0;
  friend bool operator==(const ImageTimeRecord&, const ImageTimeRecord&) = default;
};

// Source of a definition that took part, for the catalogue's definition tables.
struct DefinitionRecord {
  std::string kind;  // task skill predicate object world robot types
  std::string name, path, source, hash;
};

enum class Split { train, test };
std::string_view to_string(Split split);
std::optional<Split> split_from(std::string_view name);

// What an episode was made of, and at what cost.
struct EpisodeOrigin {
  std::string key;  // hash of definitions, task, variation, seed and every option that alters data
  Split split = Split::train;
  std::map<std::string, std::string> options;  // that alter data, as text
  std::vector<DefinitionRecord> definitions;
  double draws = 1;                       // starts drawn until init held
  double wall_s = 0, physics_wall_s = 0;  // host times: outside every hash
};

// What there was to see and to move, and what stands for it in the frames.
struct EpisodeScene {
  std::string document;  // all of it, as canonical JSON
  std::vector<Object> objects;
  std::vector<std::string> posed;  // names of objects whose pose is in frames
  std::vector<JointName> joints;
  std::vector<std::string> hands;
  std::vector<Camera> cameras;                    // of the scene
  std::vector<MaskEntry> masks;                   // what the numbers of its masks stand for
  std::map<std::string, std::string> predicates;  // of the domain -> basic derived fixed
};

// What is said of what happened.
struct EpisodeLabels {
  std::vector<SegmentRecord> segments;
  std::vector<AttemptRecord> attempts;
  std::vector<ViaRecord> vias;
  std::vector<FactRecord> facts;
  std::vector<FactRecord> observed_facts;  // of predicates that can hide: when they were known to hold
  std::vector<ContactRecord> contacts;
  std::vector<GraspRecord> grasps;
  std::vector<LanguageRecord> language;
  std::vector<DocumentRecord> documents;
  std::vector<VerdictRecord> verdicts;
  std::map<std::string, std::vector<std::int64_t>> keyframes;  // method -> frames
};

// Of a real episode there are no variation, seed, draws, state hash or commands; its steps are ticks of a clock of
// physics_hz, as many a frame as make about a microsecond each.
struct EpisodeRecord {
  bool real = false;
  std::string task, world, variation;
  std::map<std::string, std::string> axes;  // of the variation
  std::int64_t seed = 0;
  EpisodeOrigin made;
  Outcome outcome = Outcome::failure;
  Reason reason = Reason::none;
  std::string detail;
  std::string beside_goal;  // what success asks and the PDDL goal does not say; empty: nothing
  int physics_hz = 240, frame_hz = 20;
  std::int64_t steps = 0;
  double duration_s() const { return static_cast<double>(steps) / physics_hz; }
  EpisodeScene scene;
  std::vector<ChannelRecord> channels;
  std::vector<FrameRecord> frames;
  std::vector<Command> commands;
  std::vector<AskedAction> agent_actions;  // in the order in which they were asked for, the asker's before its skill's
  EpisodeLabels labels;
  std::vector<StreamRecord> streams;         // of a real episode
  std::vector<ImageTimeRecord> image_times;  // likewise, by frame, camera and kind
  std::shared_ptr<const ImageStore> images;  // null: none were made
  std::string state_hash;                    // World::state_hash at the end
};

const std::string* document_of(const EpisodeRecord& episode, DocumentKind kind);  // the first of it, or null

}  // namespace stampede
