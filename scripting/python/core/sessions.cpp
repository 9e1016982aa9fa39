// Sessions: run, evaluate, plan, and make environments.
#include <nanobind/stl/array.h>
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/map.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>
#include <nanobind/stl/unique_ptr.h>
#include <nanobind/stl/vector.h>
#include <stampede/session.h>

#include <atomic>
#include <cmath>

#include "environments.h"
#include "interruptible.h"
#include "keywords.h"

namespace stampede::python {

SharedArrays shared_arrays(EpisodeArrays arrays);  // catalogue.cpp
NamedArrays picture_object(CameraPicture picture);
NamedArrays points_object(CameraPoints points);

namespace {

using namespace nb::literals;

template <typename Value>
Value one_of(const std::string& text, const char* argument, const std::vector<std::pair<const char*, Value>>& known) {
  if (const auto value = value_named(text, known)) return *value;
  std::string names;
  for (const auto& [name, value] : known) names += (names.empty() ? "" : ", ") + std::string(name);
  throw Error(std::string(argument) + "=", "there is no '" + text + "'", "one of " + names);
}

void set_frames(PictureStorage& pictures, nb::handle value, const char*) {
  pictures.frames =
      one_of<PicturesOf>(nb::cast<std::string>(value), "pictures['frames']",
                         {{"none", PicturesOf::none}, {"keyframes", PicturesOf::keyframes}, {"all", PicturesOf::all}});
}

void set_renderer(PictureStorage& pictures, nb::handle value, const char*) {
  pictures.renderer = one_of<DrawnBy>(nb::cast<std::string>(value), "pictures= renderer",
                                      {{"own", DrawnBy::own}, {"osmesa", DrawnBy::osmesa}});
}

constexpr Keyword<PictureStorage> kPictures[] = {
    {"frames", set_frames},
    {"cameras", set_field<&PictureStorage::cameras>},
    {"width", set_field<&PictureStorage::width>},
    {"height", set_field<&PictureStorage::height>},
    {"rgb", set_field<&PictureStorage::rgb>},
    {"depth", set_field<&PictureStorage::depth>},
    {"mask", set_field<&PictureStorage::instance>},
    {"semantic_mask", set_field<&PictureStorage::semantic>},
    {"points", set_field<&PictureStorage::points>},
    {"shadows", set_field<&PictureStorage::shadows>},
    {"renderer", set_renderer},
    {"rgb_noise", set_field<&PictureStorage::rgb_noise>},
    {"depth_noise", set_field<&PictureStorage::depth_noise>},
};

void set_pictures(EpisodeRequest& request, nb::handle value, const char* where) {
  PictureStorage pictures;
  for (const auto& [key, one] : nb::cast<nb::dict>(value)) {
    const auto name = nb::cast<std::string>(key);
    const Keyword<PictureStorage>* keyword = find_keyword(kPictures, name);
    if (keyword == nullptr) {
      std::string names;
      for (const auto& [known, set] : kPictures) names += (names.empty() ? "" : ", ") + std::string(known);
      throw Error("pictures=", "there is no '" + name + "'", "one of " + names);
    }
    keyword->set(pictures, one, where);
  }
  request.pictures = std::move(pictures);
}

void set_on_failure(EpisodeRequest& request, nb::handle value, const char*) {
  request.on_failure =
      one_of<OnFailure>(nb::cast<std::string>(value), "on_failure",
                        {{"undo", OnFailure::undo}, {"stop", OnFailure::stop}, {"recover", OnFailure::recover}});
}

void set_behaviour(EpisodeRequest& request, nb::handle value, const char*) {
  request.behaviour = one_of<Behaviour>(nb::cast<std::string>(value), "behaviour",
                                        {{"plan", Behaviour::plan},
                                         {"random_skills", Behaviour::random_skills},
                                         {"random_applicable", Behaviour::random_applicable}});
}

constexpr Keyword<EpisodeRequest> kRequest[] = {
    {"variation", set_field<&EpisodeRequest::variation>},
    {"seed", set_field<&EpisodeRequest::seed>},
    {"on_failure", set_on_failure},
    {"controller", set_field<&EpisodeRequest::controller>},
    {"motion_planner", set_field<&EpisodeRequest::motion_planner>},
    {"set", set_field<&EpisodeRequest::set>},
    {"pictures", set_pictures},
    {"where", set_field<&EpisodeRequest::where>},
    {"goal", set_field<&EpisodeRequest::goal>},
    {"behaviour", set_behaviour},
    {"skills", set_field<&EpisodeRequest::skills>},
    {"randomise", set_field<&EpisodeRequest::randomise>},
};

EpisodeRequest request_from(const nb::kwargs& words, const char* where) {
  return from_keywords(kRequest, words, where);
}

// For the cycle collector: a policy's function may hold its session.
int traverse_session(PyObject* self, visitproc visit, void* arg) {
  Py_VISIT(Py_TYPE(self));
  if (nb::inst_ready(self))
    for (const auto& [name, function] : nb::inst_ptr<PySession>(self)->functions) Py_VISIT((**function).ptr());
  return 0;
}
int clear_session(PyObject* self) {
  for (const auto& [name, function] : nb::inst_ptr<PySession>(self)->functions) function->let_go();
  return 0;
}
PyType_Slot kSessionSlots[] = {{Py_tp_traverse, reinterpret_cast<void*>(&traverse_session)},
                               {Py_tp_clear, reinterpret_cast<void*>(&clear_session)},
                               {0, nullptr}};

RunTally run_all(PySession& self, RunRequest request, const std::optional<nb::callable>& progress,
                 const std::optional<nb::callable>& sink) {
  if (progress)
    request.progress = [&](const RunProgress& now) {
      const Lent between_two_episodes(self.turn);
      const Acquired gil;
      (*progress)(now.episode, now.done, now.total);
    };
  if (sink)
    request.sink = [&](const Episode& episode) {
      const Lent between_two_episodes(self.turn);
      const Acquired gil;
      (*sink)(episode);
    };
  return interruptible([&](const std::atomic<bool>& stop) {
    request.stop = &stop;
    return self->run_all(request);
  });
}

Evaluation evaluate(PySession& self, const std::vector<std::string>& tasks, EvaluationRequest request,
                    const std::optional<nb::callable>& policy) {
  if (policy) request.policy = policy_maker(std::make_shared<Kept>(*policy));
  return interruptible([&](const std::atomic<bool>& stop) {
    request.stop = &stop;
    return self->evaluate(tasks, request);
  });
}

// Asked by any thread that runs an episode.
SensorEntry sensor_entry(std::shared_ptr<Kept> read, std::vector<std::string> components, std::string unit, int rate_hz,
                         std::string version) {
  SensorEntry entry{std::move(unit), std::move(components), rate_hz, std::move(version), {}};
  entry.read = [read = std::move(read)](const SimulatorView& now) {
    return ask_python("a sensor's read() gives a list of numbers", [&] {
      return numbers((**read)(nb::cast(&now, nb::rv_policy::reference)), "what a sensor reads");
    });
  };
  return entry;
}

void bind_sensors(nb::module_& module) {
  nb::class_<SimulatorView>(module, "SimulatorView", R"(The simulator after a physics step, to be read.

It lives while the sensor's read() runs. Raises Error for a name that the scene does not have.)")
      .def("time_s", &SimulatorView::time_s, "Simulated, since the episode's first frame.")
      .def("joint_position", &SimulatorView::joint_position, "joint"_a, "rad or m")
      .def("joint_velocity", &SimulatorView::joint_velocity, "joint"_a, "rad/s or m/s")
      .def("joint_effort", &SimulatorView::joint_effort, "joint"_a, "N m or N, of its motor in this step")
      .def("pose", &SimulatorView::pose, "object"_a, "Of an object, part or region; of a hand, that between the pads.")
      .def("velocity", &SimulatorView::velocity, "object"_a, "Of the centre of mass, m/s, world.")
      .def("opening_m", &SimulatorView::opening_m, "Between the pads.")
      .def("contact_force", &SimulatorView::contact_force, "one"_a, "other"_a, "Normal, N: mean over the frame before.")
      .def("distance", &SimulatorView::distance, "from_point"_a, "to_point"_a,
           "From a point to the first thing that collides on the straight way to another, m; None: it is free.");
}

std::string row_text(const EvaluationRow& row) {
  return (row.task.empty() ? "all" : row.task) + ", " + row.perturbation +
         (row.axis.empty() ? "" : ", " + row.axis + "=" + row.value) + ": " + std::to_string(row.succeeded) + " of " +
         std::to_string(row.episodes);
}

std::string per_cent(double share) { return std::to_string(std::lround(100 * share)) + " %"; }

void bind_runs(nb::module_& module) {
  nb::class_<Episode>(module, "Episode", "An episode that was run.")
      .def_ro("id", &Episode::id, "in the catalogue; 0: there is none")
      .def_ro("key", &Episode::key)
      .def_ro("task", &Episode::task)
      .def_ro("variation", &Episode::variation)
      .def_ro("seed", &Episode::seed)
      .def_prop_ro("success", [](const Episode& episode) { return episode.outcome == Outcome::success; })
      .def_ro("reason", &Episode::reason, "`none`, or why it failed, as in the catalogue")
      .def_ro("detail", &Episode::detail)
      .def_ro("frames", &Episode::frames)
      .def_ro("duration_s", &Episode::duration_s, "simulated")
      .def_ro("undone", &Episode::undone, "tries that were taken back")
      .def("__repr__", [](const Episode& e) {
        return "Episode(" + e.task + (e.variation.empty() ? "" : " " + e.variation) + ", seed " +
               std::to_string(e.seed) + ", " + (e.outcome == Outcome::success ? "success" : e.reason) + ", " +
               std::to_string(e.frames) + " frames)";
      });
  nb::class_<TaskTally>(module, "TaskTally")
      .def_ro("episodes", &TaskTally::episodes)
      .def_ro("succeeded", &TaskTally::succeeded)
      .def_ro("existing", &TaskTally::existing)
      .def_ro("reasons", &TaskTally::reasons)
      .def_ro("variations", &TaskTally::variations, "variation -> (succeeded, episodes)");
  nb::class_<RunTally>(module, "RunTally", "What came of a run.")
      .def_ro("total", &RunTally::total)
      .def_ro("finished", &RunTally::finished)
      .def_ro("succeeded", &RunTally::succeeded)
      .def_ro("existing", &RunTally::existing)
      .def_ro("interrupted", &RunTally::interrupted)
      .def_ro("tasks", &RunTally::tasks)
      .def("__repr__", [](const RunTally& tally) {
        return "RunTally(" + std::to_string(tally.succeeded) + " of " + std::to_string(tally.finished) +
               " succeeded, " + std::to_string(tally.existing) + " were there" +
               (tally.interrupted ? ", interrupted)" : ")");
      });
}

void bind_evaluations(nb::module_& module) {
  nb::class_<EvaluationRow>(module, "EvaluationRow", "Of a task, or of its variations with one value on one axis.")
      .def_ro("task", &EvaluationRow::task, "empty: all")
      .def_ro("perturbation", &EvaluationRow::perturbation)
      .def_ro("axis", &EvaluationRow::axis)
      .def_ro("value", &EvaluationRow::value)
      .def_ro("episodes", &EvaluationRow::episodes)
      .def_ro("succeeded", &EvaluationRow::succeeded)
      .def_ro("success", &EvaluationRow::success, "share")
      .def_ro("lower", &EvaluationRow::lower, "of its 95 % interval (Wilson, JASA 1927)")
      .def_ro("upper", &EvaluationRow::upper)
      .def_ro("mean_return", &EvaluationRow::mean_return)
      .def_ro("mean_length_s", &EvaluationRow::mean_length_s)
      .def_ro("reasons", &EvaluationRow::reasons)
      .def("__repr__", [](const EvaluationRow& row) { return "EvaluationRow(" + row_text(row) + ")"; });
  nb::class_<Evaluation>(module, "Evaluation")
      .def_ro("rows", &Evaluation::rows)
      .def_ro("interrupted", &Evaluation::interrupted)
      .def("__repr__",
           [](const Evaluation& evaluation) {
             std::string text = "Evaluation(";
             for (const EvaluationRow& row : evaluation.rows)
               if (row.axis.empty()) text += (text.back() == '(' ? "" : "; ") + row_text(row);
             return text + (evaluation.interrupted ? "; interrupted)" : ")");
           })
      .def("_repr_html_", [](const Evaluation& evaluation) {
        std::string rows;
        for (const EvaluationRow& row : evaluation.rows)
          rows += "<tr><td>" + (row.task.empty() ? "all" : row.task) + "</td><td>" + row.perturbation + "</td><td>" +
                  (row.axis.empty() ? "" : row.axis + "=" + row.value) + "</td><td>" + std::to_string(row.succeeded) +
                  "</td><td>" + std::to_string(row.episodes) + "</td><td>" + per_cent(row.success) + " (" +
                  per_cent(row.lower) + " – " + per_cent(row.upper) + ")</td></tr>";
        return "<table><tr><th>task</th><th>perturbation</th><th>axis</th><th>succeeded</th><th>episodes</th>"
               "<th>success</th></tr>" +
               rows + "</table>";
      });
}

void bind_plans(nb::module_& module) {
  nb::class_<TaskPlanStep>(module, "PlanStep")
      .def_ro("action", &TaskPlanStep::action)
      .def_ro("arguments", &TaskPlanStep::arguments)
      .def("__repr__", [](const TaskPlanStep& step) {
        std::string text = "(" + step.action;
        for (const std::string& argument : step.arguments) text += " " + argument;
        return text + ")";
      });
  nb::class_<TaskPlan>(module, "TaskPlan", "What the task planner says.")
      .def_ro("found", &TaskPlan::found)
      .def_ro("end", &TaskPlan::end)
      .def_ro("explanation", &TaskPlan::explanation)
      .def_ro("steps", &TaskPlan::steps)
      .def_ro("domain", &TaskPlan::domain, "PDDL")
      .def_ro("problem", &TaskPlan::problem, "PDDL")
      .def_ro("assumed", &TaskPlan::assumed)
      .def("__repr__", [](const TaskPlan& plan) {
        return "TaskPlan(" + (plan.found ? std::to_string(plan.steps.size()) + " steps" : plan.end) + ")";
      });
}

void bind_answers(nb::module_& module) {
  bind_runs(module);
  bind_evaluations(module);
  bind_plans(module);
}

void bind_making(nb::class_<PySession>& session) {
  session
      .def(
          "__init__",
          [](PySession* self, const std::optional<std::filesystem::path>& root,
             std::vector<std::filesystem::path> paths, const std::optional<std::filesystem::path>& catalogue) {
            new (self) PySession({root.value_or(""), std::move(paths), catalogue.value_or("")});
          },
          "root"_a = nb::none(), "paths"_a = std::vector<std::filesystem::path>(), "catalogue"_a = nb::none())
      .def("__repr__",
           [](const PySession& self) {
             return self.has_catalogue() ? "Session(catalogue='" + self.catalogue + "')" : std::string("Session()");
           })
      .def(
          "tasks", [](const PySession& self) { return self->tasks(); }, "Names.")
      .def(
          "variations", [](const PySession& self, const std::string& task) { return self->variations(task); }, "task"_a,
          "Canonical texts, in the task's order.");
}

void bind_running(nb::class_<PySession>& session) {
  session
      .def(
          "run",
          [](PySession& self, const std::string& task, const nb::kwargs& words) {
            const EpisodeRequest request = request_from(words, "run");
            const Using use(self.turn, "Session.run");
            return interruptible([&] { return self->run(task, request); });
          },
          "task"_a, "request"_a,
          R"(Runs one episode. What the catalogue has already is given without running. Repeatable, bit for bit.

variation, seed (from 1'000'000 up: the test split), on_failure (undo, stop, recover), controller, motion_planner
(`ompl:RRTConnect`), set (list such as `pick.height=0.2`), pictures (dict: frames none|keyframes|all, cameras, width, height, rgb, depth, mask,
semantic_mask, points, shadows, renderer (own, osmesa), rgb_noise, depth_noise), where and goal (PDDL), behaviour (plan, random_skills,
random_applicable), skills, randomise.)")
      .def(
          "run_all",
          [](PySession& self, std::vector<std::string> tasks, std::int64_t episodes, int workers,
             std::pair<std::int64_t, std::int64_t> shard, std::optional<nb::callable> progress,
             std::optional<nb::callable> sink, const nb::kwargs& words) {
            const Using use(self.turn, "Session.run_all");
            RunRequest request{.tasks = std::move(tasks), .episodes = episodes, .workers = workers};
            request.shard = {shard.first, shard.second};
            request.each = request_from(words, "run_all");
            return run_all(self, std::move(request), progress, sink);
          },
          "tasks"_a, "episodes"_a = 1, "workers"_a = 1, "shard"_a = std::pair<std::int64_t, std::int64_t>(1, 1),
          "progress"_a = nb::none(), "sink"_a = nb::none(), "request"_a,
          R"(Runs many episodes in several threads and keeps each, in a fixed order, whatever the number of workers.

shard (2, 8): the second of eight parts of this run; all parts, on any machines, merged are the whole.
progress(episode, done, total) is called after each; sink(episode) gets each instead of the catalogue. Other arguments
as of `run`; `seed` is the first one's.)")
      .def(
          "environment",
          [](nb::handle_t<PySession> self, const std::string& task, const nb::kwargs& words) {
            return std::make_unique<PyEnvironment>(nb::borrow(self), task, settings_from(words, "environment"));
          },
          "task"_a, "settings"_a, R"(The task as an environment that the caller steps.

channels, hidden, reward (sparse, dense, task), frame_hz, physics_hz, horizon_s, record, width, height, picture_sizes
(dict by camera: width, height), shadows, renderer (own, osmesa), picture_hz (dict by camera), rgb_noise, depth_noise,
torque_noise, torque_model: see EnvironmentSettings of stampede/environment.h.)");
}

void bind_planning(nb::class_<PySession>& session) {
  session
      .def(
          "plan",
          [](const PySession& self, const std::string& task, const nb::kwargs& words) {
            const EpisodeRequest request = request_from(words, "plan");
            const Using use(self.turn, "Session.plan");
            return interruptible([&] { return self->plan(task, request); });
          },
          "task"_a, "request"_a, "The plan for the start that `run` would make. variation, seed, where, goal matter.")
      .def(
          "query",
          [](const PySession& self, const std::string& question, const nb::sequence& parameters) {
            const Using use(self.turn, "Session.query");
            std::vector<SqlValue> values;
            for (const nb::handle one : parameters) values.push_back(sql_value(one));
            const Rows rows = interruptible([&] { return self->query(question, values); });
            return nb::make_tuple(rows.columns, rows_of(rows));
          },
          "question"_a, "parameters"_a = nb::tuple(), "Names of columns, and rows. parameters: for ?1, ?2 …");
}

void bind_reading(nb::class_<PySession>& session) {
  session
      .def(
          "arrays",
          [](const PySession& self, const Episode& episode, std::vector<std::string> columns) {
            const Using use(self.turn, "Session.arrays");
            return shared_arrays(interruptible([&] { return self->arrays(episode, {columns}); }));
          },
          "episode"_a, "columns"_a = std::vector<std::string>())
      .def(
          "picture",
          [](const PySession& self, const Episode& episode, std::int64_t frame, const std::string& camera, int width,
             int height, bool rgb, bool depth, bool mask, bool semantic_mask, bool shadows) {
            const Using use(self.turn, "Session.picture");
            self.turn.stay_in_this_process();  // it draws in a thread
            CameraPicture picture;
            {
              const Released free;
              picture =
                  self->picture(episode, frame, {camera, width, height, rgb, depth, mask, semantic_mask, shadows});
            }
            return picture_object(std::move(picture));
          },
          "episode"_a, "frame"_a, "camera"_a = "front", "width"_a = 0, "height"_a = 0, "rgb"_a = true,
          "depth"_a = false, "mask"_a = false, "semantic_mask"_a = false, "shadows"_a = false,
          "Drawn now: rgb, depth, mask, semantic_mask, intrinsics, extrinsics (world_from_camera).")
      .def(
          "state",
          [](const PySession& self, const Episode& episode, std::int64_t frame) {
            const Using use(self.turn, "Session.state");
            const Released free;
            return self->state(episode, frame);
          },
          "episode"_a, "frame"_a)
      .def(
          "points",
          [](const PySession& self, const Episode& episode, std::int64_t frame, const std::string& camera, int width,
             int height, bool rgb, bool mask, bool semantic_mask) {
            const Using use(self.turn, "Session.points");
            self.turn.stay_in_this_process();  // it draws in a thread
            CameraPoints points;
            {
              const Released free;
              points = self->points(episode, frame, {camera, width, height, rgb, true, mask, semantic_mask});
            }
            return points_object(std::move(points));
          },
          "episode"_a, "frame"_a, "camera"_a = "front", "width"_a = 0, "height"_a = 0, "rgb"_a = true, "mask"_a = false,
          "semantic_mask"_a = false,
          "Points that a camera sees, world: positions (n x 3, m), colours, mask, semantic_mask.");
}

void bind_own(nb::class_<PySession>& session) {
  session
      .def(
          "add_sensor",
          [](PySession& self, const std::string& name, nb::callable read, std::vector<std::string> components,
             std::string unit, int rate_hz, std::string version) {
            const Using use(self.turn, "Session.add_sensor");
            const auto kept = std::make_shared<Kept>(std::move(read));
            self->add_sensor(name,
                             sensor_entry(kept, std::move(components), std::move(unit), rate_hz, std::move(version)));
            self.functions["sensor " + name] = kept;
          },
          "name"_a, "read"_a, "components"_a, "unit"_a = "", "rate_hz"_a = 20, "version"_a = "",
          R"(Another sensor of every world: columns `sensor/NAME` of arrays, channels of environments and policies.

read(now) gives a finite number a component. It reads nothing but `now`, a SimulatorView, and keeps nothing, so that
episodes repeat. rate_hz divides the world's physics rate. components, unit, rate_hz and version are part of an episode's
key: another text, another sensor.)")
      .def(
          "add_policy",
          [](PySession& self, const std::string& name, nb::callable make, std::vector<std::string> channels,
             bool hidden, int width, int height, std::string version) {
            const Using use(self.turn, "Session.add_policy");
            const auto kept = std::make_shared<Kept>(std::move(make));
            self->add_policy(name,
                             {policy_maker(kept), std::move(channels), hidden, width, height, std::move(version)});
            self.functions["policy " + name] = kept;
          },
          "name"_a, "make"_a,
          "channels"_a =
              std::vector<std::string>{"joint_positions", "gripper_pose", "gripper_open", "task_low_dim_state"},
          "hidden"_a = false, "width"_a = 0, "height"_a = 0, "version"_a = "",
          R"(A controller that skills may have as their body: `run = policy("name")` in a skill file.

make() gives, for each call, an object with `act(observation) -> Action | None` (None: it is done), asked at each
frame, and if it likes `begin(call)`. version is part of an episode's key: another text, another policy.)")
      .def(
          "evaluate",
          [](PySession& self, const std::vector<std::string>& tasks, std::optional<nb::callable> policy,
             std::int64_t episodes, std::int64_t first_seed, const std::string& variation,
             std::vector<std::string> perturb, int workers, std::pair<std::int64_t, std::int64_t> shard,
             const std::string& policy_name, const nb::kwargs& words) {
            const Using use(self.turn, "Session.evaluate");
            EvaluationRequest request{.episodes = episodes,
                                      .first_seed = first_seed,
                                      .variation = variation,
                                      .perturb = std::move(perturb),
                                      .workers = workers,
                                      .shard = {shard.first, shard.second},
                                      .policy_name = policy_name,
                                      .settings = settings_from(words, "evaluate")};
            return evaluate(self, tasks, std::move(request), policy);
          },
          "tasks"_a, "policy"_a = nb::none(), "episodes"_a = 20, "first_seed"_a = 1'000'000, "variation"_a = "",
          "perturb"_a = std::vector<std::string>(), "workers"_a = 1,
          "shard"_a = std::pair<std::int64_t, std::int64_t>(1, 1), "policy_name"_a = "policy", "settings"_a,
          R"(How often a policy, or without one the planner, succeeds, undisturbed and along axes of perturbation.

shard (2, 8): the second of eight parts, as of `run_all`. policy() gives an object with `act` and `begin`, one an episode, as of `add_policy`. Other arguments are those of
`environment`: what it observes, rates, horizon.)");
}

}  // namespace

PySession::PySession(SessionOptions options)
    : Owned("Session", Turn::Others::wait, options), catalogue(options.catalogue) {
  if (has_catalogue()) turn.stay_in_this_process();
}

void bind_sessions(nb::module_& module) {
  bind_answers(module);
  bind_sensors(module);
  module.def(
      "plan_pddl",
      [](const std::string& domain, const std::string& problem) {
        const Calling call;
        return interruptible([&] { return plan_pddl(domain, problem); });
      },
      "domain"_a, "problem"_a,
      "Plans for the PDDL domain and problem of any author. Raises Error with line and column.");
  nb::class_<PySession> session(module, "Session", nb::type_slots(kSessionSlots),
                                R"(Runs tasks of Lua scripts and keeps their episodes in a catalogue.

root: holds tasks/, skills/, worlds/; None: those that came with the package. paths: further folders of the same shape,
whose files win. catalogue: a file, where episodes go; None: each is kept by the Episode that `run` gives.
Threads that share one wait for each other.)");
  bind_making(session);
  bind_running(session);
  bind_planning(session);
  bind_reading(session);
  bind_own(session);
}

}  // namespace stampede::python
