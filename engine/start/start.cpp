// Making a start: literals of init are made true by sampling, settled in physics and tested again.
#include "engine/start/start.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "engine/base/error.h"
#include "engine/model/camera.h"
#include "engine/motion/looked.h"
#include "engine/sim/world.h"
#include "engine/start/altered_task.h"
#include "engine/start/constraints.h"
#include "engine/start/draft.h"
#include "engine/start/fact_tracker.h"
#include "engine/start/joint_placement.h"
#include "engine/start/lasting_refusals.h"
#include "engine/start/refusals.h"
#include "engine/start/relations.h"
#include "engine/start/standing.h"
#include "engine/symbolic/pddl.h"

namespace stampede {
namespace {

constexpr double kLeastSettle = 0.25, kMostSettle = 3.0;  // s
constexpr int kSamples = 8, kClutterSamples = 60;         // ways asked of one literal
constexpr int kMostBack = 6, kMostBackOfAll = 60;         // things put elsewhere, in one draw and in all of them

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

constexpr const char* kGoalHolds = "the goal not holding at the start";

class StartMaker {
 public:
  StartMaker(const TaskDraw& task, Symbols& symbols, const RunOptions& options, const std::atomic<bool>* stop)
      : draw_task_(task),
        symbols_(symbols),
        options_(options),
        stop_(stop),
        lasting_(symbols),
        refusals_(symbols, options) {}

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
    if (nothing_to_do())
      start.detail = "the goal holds at the start already, in each of " + std::to_string(start.draws) +
                     " draws: init, or the goal, must leave something to do";
    else
      start.detail = refusals_.tell(task_, start.draws, nothing_varies());
  }

  // Every start that was drawn so far is the end too.
  bool nothing_to_do() const { return refusals_.only(kGoalHolds) >= enough(); }

  // Where what is in the way is the same each time, further draws are no use.
  bool nothing_varies() const { return refusals_.same_moment() >= enough(); }

  // So many draws are alike by chance only where hardly anything varies.
  int enough() const { return std::min(10, options_.draws); }

  template <typename What>
  bool refuse(const What& what) {
    refusals_.add(what);
    return false;
  }

  bool refuse_unmet(const Literal& literal, const Scene& now) {
    std::shared_ptr<const Scene> scene = lasting_.scene_of(literal, now);
    if (!scene) scene = std::make_shared<const Scene>(now);
    refusals_.add_unmet(literal, std::move(scene), asked_by_author(literal));
    return false;
  }

  bool try_draw(int draw, PreparedStart& start) {
    Scene scene = task_.scene;
    dress(scene, draw);
    park(scene, task_.unplaced);
    Draft draft(std::move(scene));
    if (!place_all(draft, draw)) return false;
    if (blocked_) return refuse(*blocked_);
    ++moment_;

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
  // Those that have not even that go to `crowded`, where somebody asks.
  void keep_clear(std::vector<Placement>& ways, const WorldView& view, const Literal& on,
                  std::vector<Looked>* crowded) const {
    constexpr double kLeast = -0.04;  // m
    const Placement* best = nullptr;
    double most = kLeast;
    for (const Placement& way : ways) {
      const double room = spare_room(view, task_.clutter, on, way);
      if (const auto* pose = std::get_if<Transform>(&way.value); room < kLeast && pose != nullptr && crowded) {
        crowded->push_back({Looked::Fate::crowded, *pose});
        crowded->back().missed_m = kLeast - room;
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

  // What is still to be placed.
  struct Placing {
    std::vector<Literal> waiting;
    std::vector<std::string> unplaced;
    int number = 0;  // so many were sampled for
  };
  // Something that was placed: what there was to do before, and what takes it back.
  struct Step {
    Placing before;
    Placement undo;
  };
  // Why it goes no further: no place for a literal's first argument, or a condition that is met nowhere, or is no
  // longer.
  struct Stuck {
    enum class Of { place, condition, later } of;
    Literal literal;
    RandomKey key;                       // place: with which it was sampled
    std::optional<Placement> undo = {};  // takes back where its thing was tried last
  };

  // Things are put one after the other. Where one finds no place, the one before that is in its way goes elsewhere.
  bool place_all(Draft& draft, int draw) {
    const RandomKey key = RandomKey("init").with(task_.name).with(task_.variation).with(options_.seed).with(draw);
    if (!choose_literals(draft, key.with("where"))) return false;
    Placing placing{literals_, task_.unplaced};
    placing.unplaced.insert(placing.unplaced.end(), replaced_.begin(), replaced_.end());
    steps_.clear();
    ++moment_;
    RandomKey own = key;
    for (int back = 1;; ++back) {
      const std::optional<Stuck> stuck = place_rest(draft, placing, own);
      if (!stuck) return true;
      if (back > kMostBack || !go_back(draft, placing, *stuck)) return refuse_stuck(draft, *stuck);
      own = key.with("back").with(back);
    }
  }

  std::optional<Stuck> place_rest(Draft& draft, Placing& placing, RandomKey key) {
    while (!placing.waiting.empty())
      if (auto stuck = place_next(draft, placing, key)) return stuck;
    demand_none(placing.unplaced);
    blocked_ = blocked_arm(draft.collision_state(), draft.scene().robot);
    if (!blocked_) blocked_ = blocked_bodies(draft.collision_state(), false);
    if (blocked_) return std::nullopt;
    if (const auto unmet = unmet_condition(draft.view(), draft.scene())) return Stuck{Stuck::Of::later, *unmet, key};
    return std::nullopt;
  }

  std::optional<Stuck> place_next(Draft& draft, Placing& placing, RandomKey key) {
    Placing before = placing;
    const auto next = next_to_place(placing.waiting, placing.unplaced);
    const Literal literal = *next;
    placing.waiting.erase(next);
    if (literal.negated) return std::nullopt;
    const bool clutter = is_clutter(subject(literal));
    const RandomKey own = key.with(placing.number++);
    auto ways = sample(draft, literal, own, nullptr);
    const auto waiting = std::find(placing.unplaced.begin(), placing.unplaced.end(), subject(literal));
    const bool waits = waiting != placing.unplaced.end();
    std::optional<Placement> undo;
    JointPlacement joint;
    if (!clutter && waits && is_free(draft.view(), subject(literal))) {
      joint = jointly(draft, literal, placing, ways, key.with(placing.number), undo);
      if (joint.way) ways = {*joint.way};
      if (joint.unmet && start_only(joint.unmet->fact.predicate)) {
        draft.place(*joint.at);
        return Stuck{Stuck::Of::condition, *joint.unmet, own, undo};
      }
    }
    if (ways.empty() && waits) return Stuck{Stuck::Of::place, literal, own, undo};
    if (ways.empty()) return std::nullopt;  // nothing to place: the literal is only tested
    if (!waits && !std::holds_alternative<double>(ways.front().value)) return std::nullopt;
    if (!joint.way) ++moment_;
    const Placement last = draft.place(ways.front());
    steps_.push_back({std::move(before), undo && undo->object == last.object ? *undo : last});
    if (waits) placing.unplaced.erase(waiting);
    return std::nullopt;
  }

  // `looked`: where to add the ways that are turned down; null: nobody asks.
  std::vector<Placement> sample(const Draft& draft, const Literal& literal, RandomKey key,
                                std::vector<Looked>* looked) {
    const Symbols::Watching watching(symbols_, looked);
    const bool clutter = is_clutter(subject(literal));
    auto ways =
        symbols_.sample(literal.fact, draft.view(), draft.collision_state(), key, clutter ? kClutterSamples : kSamples);
    if (clutter) keep_clear(ways, draft.view(), literal, looked);
    return ways;
  }

  void demand_none(std::vector<std::string> unplaced) const {
    std::erase_if(unplaced, [&](const std::string& name) {  // `where` spoke of them, but without a sample
      return std::find(replaced_.begin(), replaced_.end(), name) != replaced_.end();
    });
    if (unplaced.empty()) return;
    throw Error("task " + task_.name, "no literal of init places '" + unplaced.front() + "'",
                "add a literal such as is.on(\"" + unplaced.front() + "\", \"table\") to init, or give it `at`");
  }

  // The way that meets all that is asked of the thing and can be tested by now, if that is more than one literal.
  // `undo` takes back where ways were tried.
  JointPlacement jointly(Draft& draft, const Literal& literal, const Placing& placing,
                         const std::vector<Placement>& ways, RandomKey key, std::optional<Placement>& undo) {
    const std::string& thing = subject(literal);
    ++moment_;
    PlacementAsked asked{thing,
                         {},
                         {},
                         [&](const Placement& way) {
                           const Placement before = draft.place(way);
                           if (!undo) undo = before;
                         },
                         [&]() -> const WorldView& { return draft.view(); },
                         &draft.collision_state()};
    for (const Literal& one : literals_) {
      const auto& arguments = one.fact.arguments;
      const bool ready = std::ranges::none_of(arguments, [&](const std::string& name) {
        return name != thing && std::ranges::find(placing.unplaced, name) != placing.unplaced.end();
      });
      if (!ready || std::ranges::find(arguments, thing) == arguments.end()) continue;
      asked.literals.push_back(one);
      if (start_only(one.fact.predicate)) asked.conditions.insert(one.fact.predicate);
    }
    JointPlacement joint = joint_placement(asked, literal, ways, symbols_, key, questions_);
    if (joint.way)
      for (const Literal& one : asked.literals) met_at_[text_of(one)] = moment_;
    return joint;
  }

  // Takes back what stands in the way of what is stuck, and all that was placed after it. False: there is no such
  // thing, or it was done often enough.
  bool go_back(Draft& draft, Placing& placing, const Stuck& stuck) {
    const std::size_t to = step_to_redo(draft, stuck);
    if (to == steps_.size() || backs_ == kMostBackOfAll) return false;
    ++backs_;
    ++moment_;
    if (stuck.undo) draft.place(*stuck.undo);
    for (; steps_.size() > to; steps_.pop_back()) {
      draft.place(steps_.back().undo);
      placing = std::move(steps_.back().before);
    }
    return true;
  }

  // The last that a condition names; of what was met until something came after it, the nearest of that; where there is
  // no place, the last. None: the number of steps.
  std::size_t step_to_redo(const Draft& draft, const Stuck& stuck) const {
    const std::size_t none = steps_.size();
    if (stuck.of == Stuck::Of::place) return none == 0 ? none : none - 1;
    std::size_t named = none;
    for (std::size_t i = 0; i < steps_.size(); ++i)
      if (std::ranges::any_of(stuck.literal.fact.arguments, [&](const std::string& name) {
            return name == steps_[i].undo.object || name.starts_with(steps_[i].undo.object + ".");
          }))
        named = i;
    if (named == none || stuck.of == Stuck::Of::condition) return named;
    const auto at = [&](const std::string& name) -> Vector3 { return draft.view().world_from(name).translation(); };
    std::size_t nearest = none;
    double least = 0;
    for (std::size_t i = named + 1; i < steps_.size(); ++i) {
      const double way = (at(steps_[i].undo.object) - at(steps_[named].undo.object)).norm();
      if (nearest == none || way < least) nearest = i, least = way;
    }
    return nearest;
  }

  bool refuse_stuck(Draft& draft, const Stuck& stuck) {
    if (stuck.of != Stuck::Of::place) return refuse_unmet(stuck.literal, draft.scene());
    if (stuck.undo) draft.place(*stuck.undo);
    std::vector<Looked> looked;
    sample(draft, stuck.literal, stuck.key, &looked);
    refusals_.add_no_place(stuck.literal, std::make_shared<const Scene>(draft.view().scene()),
                           asked_by_author(stuck.literal), looked);
    return false;
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
  // Is it the task's own, whose line is known? One of `--where` is not.
  bool asked_by_author(const Literal& literal) const {
    return !options_.where || std::ranges::any_of(task_.init, [&](const Literal& own) {
      return own.fact == literal.fact && own.negated == literal.negated;
    });
  }

  // The first condition that is not met, of those that are quickly asked first. What was met since the last thing was
  // placed is not asked again, nor what was refused for good. `now`: the scene as the view sees it.
  std::optional<Literal> unmet_condition(const WorldView& view, const Scene& now) {
    for (const bool slow : {false, true})
      for (const Literal& literal : literals_) {
        const std::string& predicate = literal.fact.predicate;
        if (!start_only(predicate) || questions_.predicates.contains(predicate) != slow) continue;
        if (const auto met = met_at_.find(text_of(literal)); met != met_at_.end() && met->second == moment_) continue;
        if (lasting_.scene_of(literal, now)) return literal;
        const Symbols::Value value = symbols_.value(literal.fact, view);
        if (value.holds == literal.negated) {
          if (value.asked_arm) lasting_.add(literal, std::make_shared<const Scene>(now));
          return literal;
        }
        if (value.asked_arm && !slow) questions_.predicates.insert(predicate), met_at_[text_of(literal)] = moment_;
      }
    return std::nullopt;
  }

  // What to say of a scene that does not settle: the first literal that this undid, where there is one.
  std::string moving(const WorldView& view) {
    FactTracker tracker(symbols_, view, asked());
    tracker.begin(tracker.read_all(view));
    if (const auto unmet = unmet_condition(view, scene_as_it_is(view))) return text_of(*unmet) + " and coming to rest";
    for (const Literal& literal : literals_)
      if (!start_only(literal.fact.predicate) && tracker.facts().contains(literal.fact) == literal.negated)
        return text_of(literal) + " and coming to rest";
    return "coming to rest";
  }

  bool accept(const WorldView& view, PreparedStart& start) {
    FactTracker tracker(symbols_, view, asked());
    auto values = tracker.read_all(view);
    tracker.begin(values);
    Scene now = scene_as_it_is(view);
    if (const auto unmet = unmet_condition(view, now)) return refuse_unmet(*unmet, now);
    for (const Literal& literal : literals_)
      if (!start_only(literal.fact.predicate) && tracker.facts().contains(literal.fact) == literal.negated)
        return refuse_unmet(literal, now);
    if (where_ && !holds(*where_, tracker.facts(), symbols_.domain(), tracker.objects()))
      return refuse(failing_parts(*where_, tracker.facts(), symbols_.domain(), tracker.objects()).front());
    tracker.look(view);
    WorldView with_facts = view;
    with_facts.set_facts(&tracker);
    if (holds(task_.goal, tracker.facts(), symbols_.domain(), tracker.objects()) &&
        (!task_.also || task_.also(with_facts)))
      return refuse(kGoalHolds);
    const RandomKey key = RandomKey("room").with(task_.name).with(task_.variation).with(options_.seed);
    if (const auto out = relation_without_room(relations_asked(task_, tracker), tracker, view, symbols_, key))
      return refuse("room for what the goal asks, " + text_of(*out) + ",");
    start.scene = std::make_shared<const Scene>(std::move(now));
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
  std::vector<Step> steps_;         // of this draw
  std::optional<Blocked> blocked_;  // this draw, once all is placed
  ArmQuestions questions_;
  int moment_ = 0;                     // other than before whenever something was moved
  std::map<std::string, int> met_at_;  // moments at which a condition was met
  int backs_ = 0;
  LastingRefusals lasting_;
  Refusals refusals_;
};

}  // namespace

PreparedStart prepare_start(const TaskDraw& task, Symbols& symbols, const RunOptions& options,
                            const std::atomic<bool>* stop) {
  return StartMaker(task, symbols, options, stop).make();
}

}  // namespace stampede
