#include "sample_episode.h"

#include <libdeflate.h>
#include <sqlite3.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <stdexcept>

#include "engine/base/hash.h"
#include "engine/base/random.h"
#include "engine/model/camera.h"
#include "engine/render/png.h"

namespace stampede::test {
namespace {

Pose pose_of(double t) { return {{0.1 + t, 1.0 / 3 + t, -t}, {std::sin(t / 2), 0, 0, std::cos(t / 2)}}; }

Fact fact(std::string predicate, std::vector<std::string> arguments) {
  return {std::move(predicate), std::move(arguments)};
}

void add_scene(EpisodeRecord& e, const SampleSize& size) {
  const std::string points(300, '7');
  e.scene.document = R"({"bodies":[{"name":"[{\"shapes\":","shapes":[)" + points + "]}],\"robot\":{\"a\":\"" + points +
                     R"(}"},"seed":)" + std::to_string(e.seed) + ",\"shapes\":[]}";
  for (int i = 0; i < size.objects; ++i) {
    Object o;
    o.name = "block" + std::to_string(i + 1);
    o.class_name = "cube", o.type = "block", o.body = o.name;
    o.traits = {"movable", "graspable"};
    o.attributes = {{"colour", i == 0 ? "red" : "blue"}, {"size", "small"}};
    o.numbers = {{"open_at", 0.25}};
    o.size = {0.04, 0.04, 0.04};
    e.scene.objects.push_back(o);
    e.scene.posed.push_back(o.name);
  }
  for (int i = 0; i < size.joints; ++i)
    e.scene.joints.push_back({"panda.joint" + std::to_string(i + 1), {-1, i}, "hinge", "rad", -2.9, 2.9, true});
  e.scene.joints.back() = {"chest.drawer", {3, 1}, "slider", "m", 0, INFINITY, false};
  e.scene.hands = {"panda.hand"};
  Camera camera;
  camera.name = "front";
  camera.mount_from_camera = to_transform({{1, 2, 3}, {0, 0, 0, 1}});
  Camera wrist = camera;
  wrist.name = "wrist", wrist.mount_body = "panda", wrist.mount_part = 1;
  wrist.mount_from_camera = looking_at({0.05, -0.0, 0.1}, {0.3, 0.7, -1e-9});
  set_field_of_view(wrist, 1.2, 160, 120);
  wrist.distortion = {0.1, -0.2, 0.001, 0.002, 0.05};
  e.scene.cameras = {camera, wrist};
  e.scene.masks = {{1, "panda.link0", "panda", "panda", 3}, {2, "panda.link1", "panda.hand", "hand", 2}};
  for (int i = 0; i < size.objects; ++i)  // not in the order of names, as numbers are shuffled
    e.scene.masks.push_back({3 + i, e.scene.objects[e.scene.objects.size() - 1 - i].name,
                             e.scene.objects[e.scene.objects.size() - 1 - i].name, "cube", 1});
  e.channels = {{"wrench", "N", {"force_x", "force_y"}, 120, {0, 2}, {0.1, 0.2, 0.3, 0.4}}};
}

void add_frames(EpisodeRecord& e, const SampleSize& size) {
  for (int i = 0; i < size.frames; ++i) {
    FrameRecord f;
    f.step = i * 12;
    f.reward = i / 7.0;
    f.done = i + 2 == size.frames;
    for (std::size_t j = 0; j < e.scene.joints.size(); ++j) {
      const auto q = static_cast<double>(j) + i * 0.1 + static_cast<double>(e.seed);
      f.joint_position.push_back(std::sin(q)), f.joint_velocity.push_back(std::cos(q));
      f.joint_effort.push_back(q * 1e-300);
    }
    for (std::size_t j = 0; j < e.scene.posed.size(); ++j) f.object_pose.push_back(pose_of(j == 0 ? i * 0.1 : 0.5));
    f.hands = {{pose_of(i), {1, 2, 3, 4, 5, 6.5}, 0.08 - i * 1e-3, {0.5, 0.25}}};
    f.camera_pose = {pose_of(i < 5 ? 0 : 1), pose_of(0.2 * i)};
    if (i + 1 < size.frames) f.action = ActionRecord{{0.5 + i, -0.5}, pose_of(-i), 0.02};
    e.frames.push_back(f);
  }
  e.steps = (size.frames - 1) * 12;
}

void add_commands(EpisodeRecord& e) {
  Trajectory trajectory;
  trajectory.knots.resize(2);
  trajectory.knots[1].step = 24;
  trajectory.knots[1].position = JointVector::Constant(7, 1.0 / 3);
  for (auto* v : {&trajectory.knots[0].position, &trajectory.knots[0].velocity, &trajectory.knots[0].acceleration,
                  &trajectory.knots[1].velocity, &trajectory.knots[1].acceleration})
    *v = JointVector::Constant(7, -0.0);
  e.commands = {{0, operation::Boundary{}},
                {0, operation::Controller{ControllerKind::joint_impedance, 600}},
                {0, operation::Follow{trajectory}},
                {12, operation::Hand{0.04, 30}},
                {24, operation::Hand{0.08, 30, 1}}};
}

// Whoever drives the episode moves the arm, then calls the skill whose body is a policy; it goes on in parts.
void add_agent_actions(EpisodeRecord& e) {
  e.agent_actions = {
      {{.space = "joint_delta", .values = {1.0 / 3, -0.0}, .gripper = 0.04}, 0, 1, -1, 0.25, false, false},
      {{.space = "skill",
        .controller = "joint_impedance",
        .frames = 4,
        .skill = "pick",
        .arguments = {"block1", "table", "panda.hand"},
        .parameters = {{"height", {0.1}}, {"say \"when\"", {1e-300, 2, 3}}}},
       1,
       5,
       -1,
       0.5,
       false,
       false},
      {{.space = "tool_delta", .values = {0, 0, 1e-9, 0, 0, 0}, .frame = "tool"}, 1, 2, 0, {}, false, false},
      {{.space = "tool_path", .values = {0.4, 0.1, 0.3, 1, 0, 0, 0}}, 2, 6, 0, {}, false, false},
      {{.space = "go_on"}, 5, 8, -1, 1, true, false},
      {{.space = "gripper", .values = {0.07}}, 8, 8, -1, -0.0, false, true}};
}

SegmentRecord pick_segment() {
  SegmentRecord s;
  s.kind = SegmentKind::skill, s.ordinal = 0, s.robot = "panda", s.skill = "pick", s.case_name = "off_surface";
  s.arguments = {"block1", "table", "panda.hand"};
  s.controller = "joint_impedance";
  s.span = {0, 72, 0, 6};
  s.precondition_held = true, s.effect_held = true;
  s.label = "pick up the \"red\" block";
  s.parameters = {{"grasp", {0.1, 0.2, 0.3}, "", "m", "object", ChosenBy::stream},
                  {"controller", {}, "joint_impedance", "", "", ChosenBy::default_value}};
  s.preconditions = {{fact("hand_empty", {}), false, true, -1},
                     {fact("on", {"block2", "block1"}), true, true, -1},
                     {fact("on", {"block1", "table"}), false, true, 0},
                     {fact("on", {"block1", "shelf"}), false, false, 0}};
  s.declared_effects = {{fact("holding", {"panda.hand", "block1"}), false},
                        {fact("on", {"block1", "table"}), true},
                        {fact("open", {"chest"}), false}};
  s.forgotten = {"near"};
  s.searched_for = {"(inside block2 chest)"};
  return s;
}

// Before the pick: on(block1,table), hand_empty. After it: holding(hand,block1). lifted is declared by nobody,
// near is forgotten, clear follows from others.
void add_labels(EpisodeRecord& e) {
  SegmentRecord motion;
  motion.kind = SegmentKind::motion, motion.ordinal = 1, motion.parent = 0, motion.robot = "panda";
  motion.skill = "move_through", motion.span = {0, 36, 0, 3};
  SegmentRecord wait;
  wait.kind = SegmentKind::skill, wait.ordinal = 2, wait.robot = "panda", wait.skill = "wait";
  wait.span = {72, e.steps, 6, static_cast<std::int64_t>(e.frames.size())};
  e.labels.segments = {pick_segment(), motion, wait};
  AttemptRecord undone{pick_segment(), 0, 1};
  undone.segment.outcome = Outcome::failure, undone.segment.reason = Reason::grasp_missed;
  undone.segment.detail = "closed on nothing", undone.segment.effect_held = false;
  undone.segment.missing_effects = {"(holding panda.hand block1)"};
  e.labels.attempts = {undone};
  e.labels.vias = {{1, "approach", pose_of(1), pose_of(1.01), 18, 0.7, 0.2}};
  const auto end = static_cast<std::int64_t>(e.frames.size());
  const std::int64_t steps = e.steps;
  e.labels.observed_facts = {{fact("inside", {"block1", "chest.drawer"}), 12, 40, 1, 4, false, true, true, {}}};
  e.labels.facts = {{fact("on", {"block1", "table"}), 0, 40, 0, 4, true, false, true, 0.01},
                    {fact("hand_empty", {}), 0, 30, 0, 3, true, false, true, std::nullopt},
                    {fact("holding", {"panda.hand", "block1"}), 30, steps, 3, end, false, true, true, std::nullopt},
                    {fact("lifted", {"block1"}), 50, steps, 5, end, false, true, false, std::nullopt},
                    {fact("near", {"block1", "block2"}), 0, 50, 0, 5, true, false, true, std::nullopt},
                    {fact("clear", {"table"}), 40, steps, 4, end, false, true, true, std::nullopt},
                    {fact("on", {"block2", "table"}), 0, steps, 0, end, true, true, true, std::nullopt}};
  e.scene.predicates = {{"on", "basic"}, {"holding", "basic"}, {"clear", "derived"}, {"near", "basic"}};
  e.labels.contacts = {{"block1", "base", "table", "top", 0, 4, 12.5}};
  e.labels.grasps = {{0, "block1", pose_of(0.3), 0.04, true}};
  e.labels.language = {{LanguageLevel::task, "lift the red block", -1},
                       {LanguageLevel::skill, "pick up the red block", 0}};
  e.labels.documents = {{DocumentKind::pddl_domain, "(define (domain d))"},
                        {DocumentKind::plan, "(pick block1 table)\n(place block1 shelf)\n"}};
  e.labels.verdicts = {{"libero", true, false, {"(on block1 shelf)"}}};
  e.beside_goal = "the task's own test `also` must hold too";
  e.labels.keyframes = {{"gripper_and_rest", {0, 6, 11}}};
}

// 8 x 6 pixels, each of one of the `things`, or of none.
std::vector<std::uint8_t> mask_png(Random& random, std::size_t things) {
  Picture picture;
  picture.width = 8, picture.height = 6;
  for (int i = 0; i < 48; ++i)
    picture.instance.push_back(static_cast<std::uint16_t>(random.below(static_cast<std::int64_t>(things + 1))));
  return to_png(picture, PictureKind::instance);
}

}  // namespace

EpisodeRecord sample_episode(const std::string& task, const std::string& variation, std::int64_t seed,
                             const SampleSize& size) {
  EpisodeRecord e;
  e.made.key = content_hash(task + variation + std::to_string(seed));
  e.task = task, e.world = "tabletop", e.variation = variation, e.seed = seed;
  e.axes = {{"colour", variation.substr(variation.find('=') + 1)}};
  e.made.split = seed >= 1'000'000 ? Split::test : Split::train;
  e.outcome = Outcome::success;
  e.made.options = {{"on_failure", "undo"}};
  e.made.definitions = {{"skill", "pick", "skills/pick.lua", "-- Grasp.\n", "aa"},
                        {"task", task, "tasks/" + task + ".lua", "return task {}", "bb"}};
  e.state_hash = "cc", e.made.draws = 3, e.made.wall_s = 0.2, e.made.physics_wall_s = 0.1;
  add_scene(e, size);
  add_frames(e, size);
  add_commands(e);
  add_agent_actions(e);
  add_labels(e);
  return e;
}

EpisodeRecord real_episode() {
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  EpisodeRecord e = sample_episode("pour_tea", "", 0);
  e.real = true;
  e.made.key = content_hash("pour_tea, recorded");
  e.variation.clear(), e.axes.clear(), e.state_hash.clear();
  e.commands.clear(), e.agent_actions.clear(), e.labels.attempts.clear(), e.labels.contacts.clear();
  for (FrameRecord& frame : e.frames) {
    frame.reward = kUnknown;
    for (HandRecord& hand : frame.hands) hand.touch = {kUnknown, kUnknown};
  }
  e.frames[2].joint_position[0] = kUnknown;
  e.frames[3].hands[0].tip.position = {kUnknown, kUnknown, kUnknown};
  e.channels.at(0).values.at(1) = kUnknown;
  e.labels.segments.at(0).labelled_by = Labeller::person;
  e.labels.facts.at(0).labelled_by = Labeller::model;
  e.labels.language.push_back({LanguageLevel::subgoal, "pour", 0, LanguageSource::person, {}, {}});
  e.labels.language.push_back({LanguageLevel::task, "tea", -1, LanguageSource::model, LanguageGrain::goal, "small"});
  e.streams = {{"joints", "joints", "joints.csv", "arm", 0.013, 40, 1.7e9, 1.7e9, 100, 31, 0.02, 1, "linear"}};
  e.image_times = {{1, 0, "rgb", 0.041}, {1, 1, "rgb", 0.06}};
  return e;
}

std::shared_ptr<ImageStore> sample_images(const EpisodeRecord& episode, const std::vector<std::int64_t>& frames,
                                          const std::vector<std::string>& kinds, std::size_t bytes) {
  auto store = std::make_shared<ImageStore>();
  for (const std::int64_t frame : frames)
    for (std::size_t camera = 0; camera < episode.scene.cameras.size(); ++camera)
      for (const std::string& kind : kinds) {
        const ImageRecord image{frame, static_cast<int>(camera), kind, episode.scene.cameras[camera].width,
                                episode.scene.cameras[camera].height};
        Random random(
            RandomKey("sample").with(episode.seed).with(frame).with(static_cast<std::int64_t>(camera)).with(kind));
        std::vector<std::uint8_t> data(bytes);
        for (std::uint8_t& byte : data) byte = static_cast<std::uint8_t>(random.below(256));
        if (kind == "instance") {  // a mask that can be read, with as many bytes: what follows a PNG's end is nothing
          const std::vector<std::uint8_t> mask = mask_png(random, episode.scene.masks.size());
          std::copy_n(mask.begin(), std::min(mask.size(), data.size()), data.begin());
        }
        store->append(image, data);
      }
  return store;
}

Folder::Folder() {
  std::string name = (std::filesystem::temp_directory_path() / "stampede_db_XXXXXX").string();
  path_ = ::mkdtemp(name.data());
}

Folder::~Folder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw std::runtime_error(file.string() + ": there is no such file");
  std::string bytes(std::filesystem::file_size(file), '\0');
  stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  return bytes;
}

void change(const std::filesystem::path& catalogue, const std::string& sql) {
  sqlite3* handle = nullptr;
  int code = sqlite3_open(catalogue.c_str(), &handle);
  if (code == SQLITE_OK) code = sqlite3_exec(handle, sql.c_str(), nullptr, nullptr, nullptr);
  const std::string message = sqlite3_errmsg(handle);
  sqlite3_close(handle);
  if (code != SQLITE_OK) throw std::runtime_error(catalogue.string() + ": " + message);
}

std::vector<std::filesystem::path> stored_releases() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(STAMPEDE_SOURCE_DIR "/tests/db/data"))
    if (entry.path().extension() == ".gz") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

void unpack(const std::filesystem::path& packed, const std::filesystem::path& to) {
  const std::string gzip = bytes_of(packed);
  std::string plain(64'000'000, '\0');
  std::size_t size = 0;
  libdeflate_decompressor* reader = libdeflate_alloc_decompressor();
  const libdeflate_result result =
      libdeflate_gzip_decompress(reader, gzip.data(), gzip.size(), plain.data(), plain.size(), &size);
  libdeflate_free_decompressor(reader);
  if (result != LIBDEFLATE_SUCCESS) throw std::runtime_error(packed.string() + ": it cannot be unpacked");
  std::ofstream(to, std::ios::binary).write(plain.data(), static_cast<std::streamsize>(size));
}

}  // namespace stampede::test
