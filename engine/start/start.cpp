// Making a start: literals of init are made true by sampling, settled in physics and tested again.
#include "engine/start/start.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "engine/base/error.h"
#include "engine/model/camera.h"
#include "engine/motion/looked.h"
#include "engine/sim/overlap.h"
#include "engine/start/altered_task.h"
#include "engine/start/constraints.h"
#include "engine/start/fact_tracker.h"
#include "engine/start/joint_placement.h"
#include "engine/start/relations.h"
#include "engine/symbolic/pddl.h"

namespace stampede {
namespace {

constexpr double kLeastSettle = 0.25, kMostSettle = 3.0;  // s
constexpr int kSamples = 8, kClutterSamples = 60;         // ways asked of one literal

std::string text_of(const Literal& literal) {
  return literal.negated ? "(not " + to_text(literal.fact) + ")" : to_text(literal.fact);
}

// Keeps things that have no place yet out of everyone's way; nothing is stepped while they are there.
void park(Scene& scene, const std::vector<std::string>& unplaced) {
  double offset = 100;
  for (const std::string& name : unplaced) {
    const Object* thing = scene.object(name);
    if (thing == nullptr) continue;
    const int body = scene.body_index(thing->body);
    if (body >= 0) scene.bodies[static_cast<std::size_t>(body)].world_from_body = translation(offset, 0, 0);
    offset += 10;
  }
}

JointVector arm_at_start(const Robot& robot) {
  JointVector start(static_cast<Eigen::Index>(robot.arm.size()));
  for (std::size_t i = 0; i < robot.arm.size(); ++i)
    start[static_cast<Eigen::Index>(i)] = robot.body.parts[static_cast<std::size_t>(robot.arm[i])].joint.initial;
  return start;
}

// One draw under construction: a scene, and a frozen world of it to ask.
class Draft {
 public:
  explicit Draft(Scene scene) : scene_(std::move(scene)) { rebuild(); }

  const WorldView& view() const { return *view_; }
  const CollisionState& collision_state() const { return *state_; }
  Scene& scene() { return scene_; }

  void place(const Placement& placement) {
    const Object* thing = scene_.object(placement.object);
    if (thing == nullptr) throw Error("", "sample placed '" + placement.object + "', which the scene does not have");
    if (const double* position = std::get_if<double>(&placement.value)) {
      auto& body = scene_.bodies[static_cast<std::size_t>(scene_.body_index(thing->body))];
      body.parts[static_cast<std::size_t>(thing->part)].joint.initial = *position;
      return rebuild();
    }
    const Transform& pose = std::get<Transform>(placement.value);
    if (thing->kind == ObjectKind::region) {
      Region& region = scene_.regions[static_cast<std::size_t>(scene_.region_index(thing->name))];
      region.part_from_region = region.body.empty() ? pose : region.part_from_region;
      return rebuild();
    }
    const int index = scene_.body_index(thing->body);
    Body& body = scene_.bodies[static_cast<std::size_t>(index)];
    body.world_from_body = pose;
    if (!body.free || carries(body)) return rebuild();
    world_->apply(operation::Place{index, pose});
    state_->move_body(index, pose);
  }

 private:
  bool carries(const Body& body) const {  // another body is joined to it
    return std::any_of(scene_.bodies.begin(), scene_.bodies.end(),
                       [&](const Body& other) { return other.joined_to == body.name; });
  }

  void rebuild() {
    world_ = std::make_unique<World>(std::make_shared<const Scene>(scene_));
    view_ = std::make_unique<WorldView>(*world_);
    state_ = world_->collision_state();
  }
  Scene scene_;
  std::unique_ptr<World> world_;
  std::unique_ptr<WorldView> view_;
  std::optional<CollisionState> state_;
};

// Does something of it swing or slide out?
bool opens(const Scene& scene, const Object& object) {
  constexpr double kFar = 0.05;  // m; a button's travel is less
  const int index = scene.body_index(object.body);
  if (index < 0) return false;
  const std::vector<Part>& parts = scene.bodies[static_cast<std::size_t>(index)].parts;
  return std::any_of(parts.begin() + 1, parts.end(), [](const Part& part) {
    const Joint& joint = part.joint;
    return joint.kind == JointKind::hinge || joint.kind == JointKind::screw ||
           (joint.kind == JointKind::slider && joint.upper - joint.lower > kFar);
  });
}

// How much more room than it should a thing that has no part in the task leaves there for a hand around what has one,
// and for what opens to open, m.
double spare_room(const WorldView& view, const std::vector<std::string>& clutter, const Literal& on,
                  const Placement& spot) {
  constexpr double kRoom = 0.07, kRoomToOpen = 0.16;  // m, seen from above
  constexpr double kHand = 0.15;                      // m: its height above what it takes
  constexpr double kFlat = 0.02, kFlush = 1e-4;       // m: how far above the support an area ends, and one of its parts
  const auto* pose = std::get_if<Transform>(&spot.value);
  if (pose == nullptr) return -1;
  double least = 1;
  const Vector3 size = view.size(spot.object);
  const double reach = std::hypot(size.x(), size.y()) / 2, floor = view.top(on.fact.arguments.at(1));
  for (const Object& other : view.scene().objects) {
    if (other.kind == ObjectKind::hand || other.name == spot.object) continue;
    const double low = view.bottom(other.name), high = view.top(other.name);
    const double height = other.kind == ObjectKind::region ? kFlat : size.z() + kHand;
    if (high < floor + kFlush || low > floor + height) continue;
    const bool own = std::find(clutter.begin(), clutter.end(), other.name) == clutter.end();
    const double room = !own ? 0 : opens(view.scene(), other) ? kRoomToOpen : kRoom;
    const Vector3 at(pose->translation().x(), pose->translation().y(), (low + high) / 2);
    least = std::min(least, view.box_distance(other.name, at) - reach - room);
  }
  return least;
}

bool joints_at_rest(const World& world) {
  constexpr double kStill = 0.005;  // m/s or rad/s
  for (std::size_t b = 0; b < world.scene().bodies.size(); ++b)
    for (std::size_t p = 1; p < world.scene().bodies[b].parts.size(); ++p)
      if (std::abs(world.joint_velocity({static_cast<int>(b), static_cast<int>(p)})) > kStill) return false;
  return true;
}

bool all_at_rest(const WorldView& view) {
  if (!joints_at_rest(view.world())) return false;
  for (const Object& thing : view.scene().objects)
    if (thing.kind == ObjectKind::body && !view.at_rest(thing.name)) {
      const int body = view.scene().body_index(thing.body);
      if (body >= 0 && view.scene().bodies[static_cast<std::size_t>(body)].free) return false;
    }
  return true;
}

// What keeps a draw from being a start: two things that lie in each other, or an arm that touches.
struct Blocked {
  std::string what;    // as it is told: `cabinet standing clear of table`
  double depth = 0;    // m
  std::string cure;    // empty: draw again
  std::string moment;  // what would have to vary for it to go away: the same text, the same contact
};

// All that a body's parts are placed by, to the last bit.
std::string placing_of(const Body& body) {
  std::string bytes;
  const auto add = [&](const auto& value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof value); };
  for (int i = 0; i < 16; ++i) add(body.world_from_body.matrix().data()[i]);
  for (const Part& part : body.parts) add(part.joint.initial);
  return bytes;
}

// The arm where it starts: against itself, and against all that stands or lies about.
std::optional<Blocked> blocked_arm(const CollisionState& state, const Robot& robot) {
  const JointVector start = arm_at_start(robot);
  const std::optional<Overlap> deepest = deepest_overlap(state, start);
  if (!deepest) return std::nullopt;
  const std::string one = name_of_part(state.scene(), deepest->one),
                    other = name_of_part(state.scene(), deepest->other);
  Blocked blocked{"the arm being free where it starts: " + one + " touches " + other,
                  deepest->depth,
                  {},
                  one + other + placing_of(robot.body)};
  const auto link = [&](PartRef part) { return robot.body.parts[static_cast<std::size_t>(part.part)].name; };
  if (deepest->other.on_robot() && deepest->one.on_robot())
    blocked.cure = "where only their shapes say so: allowed = { { \"" + link(deepest->one) + "\", \"" +
                   link(deepest->other) + "\" } } in worlds/robots/" + robot.name + ".lua; else another home or shape";
  else
    blocked.moment += placing_of(state.scene().body_at(deepest->other.body));
  return blocked;
}

// Nothing lies in anything else: furniture in the table, things in each other. Before they have settled, free things
// may: a cup is filled with beads in one place; and a hair deeper, for samplers put things a millimetre into what they
// are to lie on.
std::optional<Blocked> blocked_bodies(const CollisionState& state, bool settled) {
  const double most_m = settled ? 0.001 : 0.0011;
  const Scene& scene = state.scene();
  std::vector<Overlap> all = overlapping_bodies(state, most_m);
  if (!settled)
    std::erase_if(all, [&](const Overlap& pair) {
      return scene.body_at(pair.one.body).free && scene.body_at(pair.other.body).free;
    });
  if (all.empty()) return std::nullopt;
  const Overlap& worst = all.front();
  const std::string one = name_of_part(scene, worst.one), other = name_of_part(scene, worst.other);
  return Blocked{other + " being clear of " + one,
                 worst.depth,
                 {},
                 one + other + placing_of(scene.body_at(worst.one.body)) + placing_of(scene.body_at(worst.other.body))};
}

constexpr const char* kGoalHolds = "the goal not holding at the start";

class StartMaker {
 public:
  StartMaker(const TaskDraw& task, Symbols& symbols, const RunOptions& options, const std::atomic<bool>* stop)
      : draw_task_(task), symbols_(symbols), options_(options), stop_(stop) {}

  PreparedStart make() {
    PreparedStart start;
    for (int draw = 0; draw < options_.draws; ++draw) {
      if (stop_ && stop_->load()) {
        start.reason = Reason::interrupted;
        return start;
      }
      start.draws = draw + 1;
      task_ = draw_task_(draw);
      const bool taken = try_draw(draw, start);
      if (taken) {
        start.task = std::move(task_);
        return start;
      }
      if (nothing_to_do() || nothing_varies()) break;
    }
    start.reason = Reason::init_impossible;
    say_why(start);
    start.task = std::move(task_);
    return start;
  }

 private:
  void say_why(PreparedStart& start) {
    if (nothing_to_do()) {
      start.detail = "the goal holds at the start already, in each of " + std::to_string(start.draws) +
                     " draws: init, or the goal, must leave something to do";
      return;
    }
    for (const auto& [text, count] : failures_) {
      start.detail += (start.detail.empty() ? "" : "; ") + text;
      if (const auto blocked = blocked_.find(text); blocked != blocked_.end())
        start.detail += blocked_text(blocked->second);
      start.detail += " failed " + std::to_string(count) + (count == 1 ? " time" : " times");
    }
    if (nothing_varies()) start.detail += ": in each draw it is the same";
    for (const auto& [text, blocked] : blocked_)
      if (!blocked.cure.empty()) start.detail += "; " + blocked.cure;
    for (auto& [text, impasse] : impasses_) tell(text, std::move(impasse), start.detail);
  }

  // Every start that was drawn so far is the end too.
  bool nothing_to_do() const {
    constexpr int kEnough = 10;
    const auto goal = failures_.find(kGoalHolds);
    return goal != failures_.end() && failures_.size() == 1 && goal->second >= std::min(kEnough, options_.draws);
  }

  // Where what is in the way is the same each time, further draws are no use.
  bool nothing_varies() const {
    constexpr int kEnough = 3;
    return same_moment_ >= std::min(kEnough, options_.draws);
  }

  static std::string blocked_text(const Blocked& blocked) {
    const long depth_mm = std::max(1L, std::lround(1000 * blocked.depth));
    return " (" + std::to_string(depth_mm) + " mm deep)";
  }

  void tell(const std::string& literal, Impasse impasse, const std::string& detail) const {
    impasse.task = task_.name;
    impasse.variation = task_.variation;
    impasse.seed = options_.seed;
    impasse.step = "init " + literal;
    impasse.reason = Reason::init_impossible;
    impasse.detail = detail;
    options_.witness(impasse);
  }

  // No place for the literal's first argument: keeps the moment of the first such draw, and what all of them looked at.
  bool refuse_place(const Draft& draft, const Literal& literal, const std::vector<Looked>& looked) {
    constexpr std::size_t kMost = 1000;
    const std::string text = text_of(literal);
    if (!options_.witness) return refuse(text);
    Impasse& impasse = impasses_[text];
    if (++failures_[text] == 1) {
      impasse.subject = subject(literal);
      impasse.scene = std::make_shared<const Scene>(draft.view().scene());
      impasse.state = initial_state(*impasse.scene);
    }
    impasse.draws = failures_[text];
    if (impasse.looked.size() < kMost) impasse.looked.insert(impasse.looked.end(), looked.begin(), looked.end());
    return false;
  }

  bool refuse(const std::string& what) {
    ++failures_[what];
    return false;
  }

  bool refuse(const Blocked& blocked) {
    same_moment_ = blocked.moment == last_moment_ ? same_moment_ + 1 : 1;
    last_moment_ = blocked.moment;
    const auto [known, first] = blocked_.try_emplace(blocked.what, blocked);
    known->second.depth = std::min(known->second.depth, blocked.depth);
    return refuse(blocked.what);
  }

  bool try_draw(int draw, PreparedStart& start) {
    Scene scene = task_.scene;
    dress(scene, draw);
    park(scene, task_.unplaced);
    Draft draft(std::move(scene));
    if (!place_all(draft, draw)) return false;
    if (const auto unmet = unmet_condition(draft.view())) return refuse(*unmet);  // before anything is simulated
    if (const auto blocked = blocked_arm(draft.collision_state(), draft.scene().robot)) return refuse(*blocked);
    if (const auto blocked = blocked_bodies(draft.collision_state(), false)) return refuse(*blocked);

    World world(std::make_shared<const Scene>(draft.scene()));
    WorldView view(world);
    const int per_frame = world.scene().physics_hz / world.scene().frame_hz;
    const auto seconds = [&] { return static_cast<double>(world.step_count()) * world.dt(); };
    while (seconds() < kMostSettle && (seconds() < kLeastSettle || !all_at_rest(view))) {
      for (int i = 0; i < per_frame; ++i) world.step();
      world.close_window();
      view.close_frame();
    }
    if (!all_at_rest(view)) return refuse(moving(view));
    if (const auto blocked = blocked_arm(world.collision_state(), world.scene().robot)) return refuse(*blocked);
    if (const auto blocked = blocked_bodies(world.collision_state(), true)) return refuse(*blocked);
    return accept(view, start);
  }

  // What a run adds to a task's scene.
  void dress(Scene& scene, int draw) {
    put_cameras(scene, options_.cameras);
    const RandomKey key = RandomKey("dress").with(task_.name).with(task_.variation).with(options_.seed);
    const std::optional<Randomisation> own = task_.randomisation;
    std::vector<std::string> said = task_.instructions;
    for (const Subgoal& subgoal : task_.subgoals) said.push_back(subgoal.sentence);
    if (const auto& ranges = own ? own : options_.randomise)
      randomise(scene, *ranges, key.with("looks").with(draw), said);
    perturb(scene, options_.perturb, key.with("perturb").with(draw), said);
    number_masks(scene, key.with("masks"));
  }

  // Init, and then what `where` was drawn to mean; a literal of init gives way where `where` places the same thing.
  bool choose_literals(const Draft& draft, RandomKey key) {
    literals_ = task_.init;
    replaced_.clear();
    where_ = task_.where;
    if (!where_) return true;
    FactTracker tracker(symbols_, draft.view());
    tracker.begin({});
    where_ = checked_formula(*where_, symbols_.domain(), tracker.objects(), options_.where ? "--where" : "init");
    const auto drawn = draw_literals(*where_, symbols_, tracker.objects(), tracker.facts(), key);
    if (!drawn) return refuse(contradiction(tracker));
    const std::vector<std::string> waiting = task_.unplaced;
    for (const Literal& literal : *drawn) {
      const bool free = is_free(draft.view(), subject(literal)), part = is_part(draft.view(), subject(literal));
      if (literal.negated || literal.fact.arguments.empty() || (!free && !part)) continue;
      std::erase_if(literals_, [&](const Literal& own) { return !own.negated && subject(own) == subject(literal); });
      if (free && std::find(waiting.begin(), waiting.end(), subject(literal)) == waiting.end())
        replaced_.push_back(subject(literal));
    }
    literals_.insert(literals_.end(), drawn->begin(), drawn->end());
    return true;
  }

  // The first part of `where` that cannot be met by itself.
  std::string contradiction(const FactTracker& tracker) const {
    const std::vector<Formula> parts =
        where_->kind == Formula::Kind::conjunction ? where_->parts : std::vector<Formula>{*where_};
    for (const Formula& part : parts)
      if (!draw_literals(part, symbols_, tracker.objects(), tracker.facts(), RandomKey("where"))) return to_text(part);
    return to_text(*where_);
  }

  // Leaves the first spot with enough room; where there is none, the roomiest that does for slim fingers.
  // Those that have not even that go to `crowded`.
  void keep_clear(std::vector<Placement>& ways, const WorldView& view, const Literal& on,
                  std::vector<Looked>& crowded) const {
    constexpr double kLeast = -0.04;  // m
    const Placement* best = nullptr;
    double most = kLeast;
    for (const Placement& way : ways) {
      const double room = spare_room(view, task_.clutter, on, way);
      if (const auto* pose = std::get_if<Transform>(&way.value); room < kLeast && pose != nullptr && options_.witness) {
        crowded.push_back({Looked::Fate::crowded, *pose});
        crowded.back().missed_m = kLeast - room;
      }
      if (room < most) continue;
      best = &way;
      most = room;
      if (room >= 0) break;
    }
    ways = best == nullptr ? std::vector<Placement>{} : std::vector<Placement>{*best};
  }

  bool is_clutter(const std::string& name) const {
    return std::find(task_.clutter.begin(), task_.clutter.end(), name) != task_.clutter.end();
  }
  static const std::string& subject(const Literal& literal) {
    return literal.fact.arguments.empty() ? literal.fact.predicate : literal.fact.arguments[0];
  }
  static bool is_part(const WorldView& view, const std::string& name) {
    const Object* thing = view.scene().object(name);
    return thing != nullptr && thing->kind == ObjectKind::part;
  }
  static bool is_free(const WorldView& view, const std::string& name) {
    const Object* thing = view.scene().object(name);
    const int body = thing == nullptr || thing->kind != ObjectKind::body ? -1 : view.scene().body_index(thing->body);
    return body >= 0 && view.scene().bodies[static_cast<std::size_t>(body)].free;
  }

  bool place_all(Draft& draft, int draw) {
    const RandomKey key = RandomKey("init").with(task_.name).with(task_.variation).with(options_.seed).with(draw);
    if (!choose_literals(draft, key.with("where"))) return false;
    std::vector<std::string> unplaced = task_.unplaced;
    unplaced.insert(unplaced.end(), replaced_.begin(), replaced_.end());
    int number = 0;
    std::vector<Literal> waiting_literals = literals_;
    while (!waiting_literals.empty()) {
      const auto next = next_to_place(waiting_literals, unplaced);
      const Literal literal = *next;
      waiting_literals.erase(next);
      if (literal.negated) continue;
      const bool clutter = is_clutter(subject(literal));
      std::vector<Looked> looked;
      const Symbols::Watching watching(symbols_, options_.witness ? &looked : nullptr);
      auto ways = symbols_.sample(literal.fact, draft.view(), draft.collision_state(), key.with(number++),
                                  clutter ? kClutterSamples : kSamples);
      if (clutter) keep_clear(ways, draft.view(), literal, looked);
      const auto waiting = std::find(unplaced.begin(), unplaced.end(), subject(literal));
      if (!clutter && waiting != unplaced.end() && is_free(draft.view(), subject(literal)))
        if (const auto better = jointly(draft, subject(literal), unplaced, ways, key.with(number))) ways = {*better};
      if (ways.empty()) {
        if (waiting != unplaced.end()) return refuse_place(draft, literal, looked);
        continue;  // nothing to place: the literal is only tested
      }
      const bool joint = std::holds_alternative<double>(ways.front().value);
      if (!joint && waiting == unplaced.end()) continue;
      draft.place(ways.front());
      if (waiting != unplaced.end()) unplaced.erase(waiting);
    }
    if (unplaced.empty()) return true;
    std::erase_if(unplaced, [&](const std::string& name) {  // `where` spoke of them, but without a sample
      return std::find(replaced_.begin(), replaced_.end(), name) != replaced_.end();
    });
    if (unplaced.empty()) return true;
    throw Error("task " + task_.name, "no literal of init places '" + unplaced.front() + "'",
                "add a literal such as is.on(\"" + unplaced.front() + "\", \"table\") to init, or give it `at`");
  }

  // The way that meets all that is asked of the thing and can be tested by now, if that is more than one literal.
  std::optional<Placement> jointly(Draft& draft, const std::string& thing, const std::vector<std::string>& unplaced,
                                   const std::vector<Placement>& ways, RandomKey key) {
    PlacementAsked asked{thing,
                         {},
                         {},
                         [&](const Placement& way) { draft.place(way); },
                         [&]() -> const WorldView& { return draft.view(); },
                         &draft.collision_state()};
    for (const Literal& literal : literals_) {
      const auto& arguments = literal.fact.arguments;
      const bool ready = std::ranges::none_of(arguments, [&](const std::string& name) {
        return name != thing && std::ranges::find(unplaced, name) != unplaced.end();
      });
      if (!ready || std::ranges::find(arguments, thing) == arguments.end()) continue;
      asked.literals.push_back(literal);
      if (start_only(literal.fact.predicate)) asked.conditions.insert(literal.fact.predicate);
    }
    return joint_placement(asked, ways, symbols_, key);
  }

  // The first literal whose other arguments have their places; the first of all where each waits for another.
  static std::vector<Literal>::iterator next_to_place(std::vector<Literal>& literals,
                                                      const std::vector<std::string>& unplaced) {
    const auto ready = [&](const Literal& literal) {
      return std::none_of(unplaced.begin(), unplaced.end(), [&](const std::string& name) {
        const auto& arguments = literal.fact.arguments;
        return name != subject(literal) && std::find(arguments.begin(), arguments.end(), name) != arguments.end();
      });
    };
    const auto found = std::find_if(literals.begin(), literals.end(), ready);
    return found == literals.end() ? literals.begin() : found;
  }

  // Conditions on starts are no facts: formulas read them as if they were, literals one by one.
  bool start_only(const std::string& name) const {
    const Predicate* predicate = symbols_.domain().predicate(name);
    return predicate != nullptr && predicate->kind == PredicateKind::start;
  }
  std::set<std::string> asked() const {
    std::set<std::string> names = where_ ? predicates_of(*where_) : std::set<std::string>{};
    std::erase_if(names, [&](const std::string& name) { return !start_only(name); });
    names.merge(named_by(task_, symbols_));
    return names;
  }
  // The first of them that is not met.
  std::optional<std::string> unmet_condition(const WorldView& view) {
    for (const Literal& literal : literals_)
      if (start_only(literal.fact.predicate) && symbols_.value(literal.fact, view).holds == literal.negated)
        return text_of(literal);
    return std::nullopt;
  }

  // What to say of a scene that does not settle: the first literal that this undid, where there is one.
  std::string moving(const WorldView& view) {
    FactTracker tracker(symbols_, view, asked());
    tracker.begin(tracker.read_all(view));
    if (const auto unmet = unmet_condition(view)) return *unmet + " and coming to rest";
    for (const Literal& literal : literals_)
      if (!start_only(literal.fact.predicate) && tracker.facts().contains(literal.fact) == literal.negated)
        return text_of(literal) + " and coming to rest";
    return "coming to rest";
  }

  bool accept(const WorldView& view, PreparedStart& start) {
    FactTracker tracker(symbols_, view, asked());
    auto values = tracker.read_all(view);
    tracker.begin(values);
    if (const auto unmet = unmet_condition(view)) return refuse(*unmet);
    for (const Literal& literal : literals_)
      if (!start_only(literal.fact.predicate) && tracker.facts().contains(literal.fact) == literal.negated)
        return refuse(text_of(literal));
    if (where_ && !holds(*where_, tracker.facts(), symbols_.domain(), tracker.objects()))
      return refuse(failing_parts(*where_, tracker.facts(), symbols_.domain(), tracker.objects()).front());
    tracker.look(view);
    WorldView with_facts = view;
    with_facts.set_facts(&tracker);
    if (holds(task_.goal, tracker.facts(), symbols_.domain(), tracker.objects()) &&
        (!task_.also || task_.also(with_facts)))
      return refuse(kGoalHolds);
    start.scene = std::make_shared<const Scene>(scene_as_it_is(view));
    start.values = std::move(values);
    start.history = view.history();
    return true;
  }

  const TaskDraw& draw_task_;
  Task task_;  // of the present draw
  Symbols& symbols_;
  const RunOptions& options_;
  const std::atomic<bool>* stop_;
  std::vector<Literal> literals_;      // of this draw: what is to be made true, and tested
  std::vector<std::string> replaced_;  // things with a place of their own, which `where` gives another
  std::optional<Formula> where_;
  std::map<std::string, int> failures_;
  std::map<std::string, Blocked> blocked_;   // by what is told of it: the shallowest
  std::string last_moment_;                  // of the last draw that was blocked
  int same_moment_ = 0;                      // so many were blocked in the same way, one after the other
  std::map<std::string, Impasse> impasses_;  // of literals, where somebody asks
};

}  // namespace

PreparedStart prepare_start(const TaskDraw& task, Symbols& symbols, const RunOptions& options,
                            const std::atomic<bool>* stop) {
  return StartMaker(task, symbols, options, stop).make();
}

}  // namespace stampede
