// What episodes of every shipped task say is so: facts against a fresh evaluation, margins, masks, and how starts vary.
#include <catch2/catch.hpp>
#include <set>

#include "engine/model/camera.h"
#include "engine/model/masks.h"
#include "engine/model/scene_poses.h"
#include "engine/render/renderer.h"
#include "engine/sim/world.h"
#include "engine/start/fact_tracker.h"
#include "tests/support/make_start.h"
#include "tests/tasks/run_task.h"

using namespace stampede;
using namespace stampede::test;

namespace {

constexpr int kMoments = 5, kAround = 4;  // frames compared, and how many on either side must agree: settle times

// Steps a stored episode through its frames.
class Film {
 public:
  explicit Film(const EpisodeRecord& episode)
      : episode_(episode), world_(std::make_shared<const Scene>(scene_from_document(episode.scene.document))) {}
  WorldView& view() { return view_; }
  void to(std::int64_t frame) {
    const std::int64_t per_frame = episode_.physics_hz / episode_.frame_hz;
    while (world_.step_count() < frame * per_frame) {
      while (next_ < episode_.commands.size() && episode_.commands[next_].step == world_.step_count())
        world_.apply(episode_.commands[next_++].operation);
      world_.step();
      if (world_.step_count() % per_frame != 0) continue;
      world_.close_window();
      view_.close_frame();
    }
  }

 private:
  const EpisodeRecord& episode_;
  World world_;
  WorldView view_{world_};
  std::size_t next_ = 0;
};

bool stored(const EpisodeRecord& episode, const Fact& fact, std::int64_t frame) {
  return std::any_of(episode.labels.facts.begin(), episode.labels.facts.end(), [&](const FactRecord& record) {
    return record.fact == fact && record.first_frame <= frame && frame < record.end_frame;
  });
}

using Values = std::map<Fact, Symbols::Value>;

// Facts that are read for `kAround` frames on either side with one result are stored with this one.
void compare(const EpisodeRecord& episode, const std::vector<Values>& around, std::int64_t frame, Symbols& symbols) {
  for (const auto& [fact, value] : around[kAround]) {
    if (symbols.traits(fact.predicate).remember) continue;
    const bool steady = std::all_of(
        around.begin(), around.end(),
        [&, own = value.holds, &name = fact](const Values& values) { return values.at(name).holds == own; });
    if (!steady || stored(episode, fact, frame) == value.holds) continue;
    FAIL_CHECK(to_text(fact) << (value.holds ? " holds" : " does not hold") << " at frame " << frame
                             << ", and the facts say otherwise");
  }
}

// The sign of a margin says whether the fact holds.
void check_margins(const Values& values) {
  for (const auto& [fact, value] : values)
    if (value.margin && (value.holds ? *value.margin < 0 : *value.margin > 0))
      FAIL_CHECK(to_text(fact) << (value.holds ? " holds" : " does not hold") << " with margin " << *value.margin);
}

const std::set<std::string> kMeasured = {"at", "closed", "hanging", "holding",     "in_slot", "inside", "lifted",
                                         "on", "open",   "over",    "pointing_at", "pressed", "turned"};

void check_stored_margins(const EpisodeRecord& episode) {
  for (const FactRecord& record : episode.labels.facts) {
    INFO(to_text(record.fact));
    CHECK(record.margin.has_value() == kMeasured.contains(record.fact.predicate));
    if (record.margin) CHECK(*record.margin >= 0);
  }
}

bool whole_and_part(const std::string& a, const std::string& b) {
  return b.starts_with(a + ".") || a.starts_with(b + ".");
}

void check_own_parts(const EpisodeRecord& episode) {
  for (const FactRecord& record : episode.labels.facts) {
    if (record.fact.predicate == "behind" || record.fact.predicate == "part_of")
      continue;  // static: the only kind that may relate them
    for (const std::string& a : record.fact.arguments)
      for (const std::string& b : record.fact.arguments) {
        INFO(to_text(record.fact));
        CHECK_FALSE(whole_and_part(a, b));
      }
  }
}

// While something is lifted, the episode's contacts know of nobody but the hand that touches it.
void check_lifted(const EpisodeRecord& episode) {
  for (const FactRecord& fact : episode.labels.facts) {
    if (fact.fact.predicate != "lifted") continue;
    const std::string& held = fact.fact.arguments[0];
    for (const ContactRecord& contact : episode.labels.contacts) {
      if (contact.object_a != held && contact.object_b != held) continue;
      const std::string& other = contact.object_a == held ? contact.object_b : contact.object_a;
      const std::int64_t together =
          std::min(contact.end_frame, fact.end_frame) - std::max(contact.first_frame, fact.first_frame);
      INFO(held << " and " << other << " for " << together << " frames");
      CHECK((other.starts_with("panda") || together <= 2));  // less than its settle time
    }
  }
}

}  // namespace

TEST_CASE("what is stored agrees with a fresh look at any frame, in every task that ships") {
  for (const std::string& task : shipped_tasks()) {
    RunOptions options;
    options.seed = 61;
    const EpisodeRecord episode = run_task(task, first_variation(task), options);
    INFO(task << ": " << verdict(episode));
    REQUIRE(episode.outcome == Outcome::success);
    EpisodeScripts scripts(all_tasks(), task, episode.variation, options.seed);
    Film film(episode);
    const FactTracker tracker(scripts.symbols(), film.view());
    Random random(RandomKey("moments").with(task));
    const std::int64_t last = static_cast<std::int64_t>(episode.frames.size()) - kAround - 2;
    std::set<std::int64_t> moments;  // apart: the film does not run backwards
    for (int tries = 0; static_cast<int>(moments.size()) < kMoments && tries < 50 && last > kAround; ++tries) {
      const std::int64_t moment = kAround + 1 + random.below(last - kAround);
      const auto next = moments.lower_bound(moment - 2 * kAround);
      if (next == moments.end() || *next > moment + 2 * kAround) moments.insert(moment);
    }
    CHECK(moments.size() > 1);
    for (const std::int64_t moment : moments) {
      std::vector<Values> around;
      for (std::int64_t frame = moment - kAround; frame <= moment + kAround; ++frame) {
        film.to(frame);
        around.push_back(tracker.read_all(film.view(), false));
      }
      compare(episode, around, moment, scripts.symbols());
      check_margins(around[kAround]);
    }
    check_stored_margins(episode);
    check_own_parts(episode);
    check_lifted(episode);
  }
}

namespace {

// Numbers that are seen of a scene in which all but what `shows` picks is invisible, from four sides and from above.
template <typename Shows>
std::set<int> seen(Renderer& renderer, Scene scene, const Vector3& at, double radius, const Shows& shows) {
  for (std::size_t body = 0; body < scene.bodies.size(); ++body)
    for (std::size_t part = 0; part < scene.bodies[body].parts.size(); ++part)
      if (!shows(static_cast<int>(body), static_cast<int>(part)))
        for (Shape& shape : scene.bodies[body].parts[part].shapes) shape.visible = false;
  for (std::size_t part = 0; part < scene.robot.body.parts.size(); ++part)
    if (!shows(-1, static_cast<int>(part)))
      for (Shape& shape : scene.robot.body.parts[part].shapes) shape.visible = false;
  for (std::size_t region = 0; region < scene.regions.size(); ++region)
    if (!shows(-2, static_cast<int>(region))) scene.regions[region].visible = false;
  const auto still = std::make_shared<const Scene>(scene);
  renderer.load(still);
  DrawOptions options;
  options.kinds = {false, false, true, false};
  std::vector<View> views;
  for (const Vector3& side :
       {Vector3(1, 0, 0.3), Vector3(-1, 0, 0.3), Vector3(0, 1, 0.3), Vector3(0.01, 0, 1), Vector3(0.01, 0, -1)}) {
    View view;
    set_field_of_view(view.camera, 0.9, 64, 64);
    view.camera.near_m = 0.001, view.camera.far_m = 20;
    view.world_from_camera = looking_at(at + 2.5 * radius * side.normalized(), at);
    views.push_back(view);
  }
  std::vector<Picture> pictures;
  renderer.draw(scene_poses(*still, initial_state(*still)), views, options, pictures);
  std::set<int> numbers;
  for (const Picture& picture : pictures) numbers.insert(picture.instance.begin(), picture.instance.end());
  numbers.erase(0);
  return numbers;
}

}  // namespace

TEST_CASE("each number of the mask table is drawn, and what has none is in no mask, in every task that ships") {
  const auto renderer = make_renderer();
  for (const std::string& task : shipped_tasks()) {
    EpisodeScripts scripts(all_tasks(), task, first_variation(task), 61);
    RunOptions options;
    options.seed = 61;
    const Start start = make_start(scripts.task(), scripts.symbols(), options);
    REQUIRE(start.scene);
    const Scene& scene = *start.scene;
    const ScenePoses poses = scene_poses(scene, initial_state(scene));
    std::set<int> drawn;
    const auto look = [&](int body, int index, int number, const Transform& pose, const Vector3& low,
                          const Vector3& high) {
      const Vector3 middle = pose * Vector3((low + high) / 2);
      const auto numbers = seen(*renderer, scene, middle, std::max(0.01, (high - low).norm() / 2),
                                [&](int b, int i) { return b == body && i == index; });
      INFO(task << " body " << body << " part " << index);
      CHECK(numbers == (number == 0 ? std::set<int>{} : std::set<int>{number}));
      drawn.insert(numbers.begin(), numbers.end());
    };
    for (int body = -1; body < static_cast<int>(scene.bodies.size()); ++body) {
      const auto own = static_cast<std::size_t>(body);
      const Body& owner = body < 0 ? scene.robot.body : scene.bodies[own];
      for (std::size_t i = 0; i < owner.parts.size(); ++i) {
        const auto [low, high] = bounding_box(owner.parts[i]);
        look(body, static_cast<int>(i), owner.parts[i].instance,
             body < 0 ? poses.world_from_robot_part[i] : poses.world_from_part[own][i], low, high);
      }
    }
    for (std::size_t i = 0; i < scene.regions.size(); ++i)
      look(-2, static_cast<int>(i), scene.regions[i].instance, poses.world_from_region[i], -scene.regions[i].size / 2,
           scene.regions[i].size / 2);
    std::set<int> numbers;
    for (const MaskEntry& entry : mask_key(scene)) numbers.insert(entry.instance);
    INFO(task);
    CHECK(drawn == numbers);
  }
}
