// How often tasks succeed, and how well that stands up to disturbances.
//
//   Evaluation answer = session.evaluate({"reach_target"}, {.episodes = 50,
//                                                          .perturb = {"camera", "light=2"},
//                                                          .policy = [] { return std::make_unique<MyPolicy>(); }});
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "stampede/environment.h"

namespace stampede {

struct EvaluationRequest {
  std::int64_t episodes = 20;           // of each task, undisturbed, and as many for each entry of `perturb`
  std::int64_t first_seed = 1'000'000;  // the test split's first
  std::string variation = {};           // canonical text, or axes of it; empty: all in turn

  // Each tried by itself, over the same variations and seeds: `light`, `light=2`, `camera=1,noise=0.5`. The axes are
  // those of LIBERO-Plus (arXiv:2510.13626); at strength 1:
  //   layout    three further things stand about, clear of those of the task
  //   camera    each moves by up to 5 cm and turns by up to 5 degrees
  //   start     each joint of the arm starts up to 0.2 rad elsewhere
  //   sentence  the same instruction in another frame and other words; at 2 also beside the point, at 3 mistyped
  //   light     ambient and diffuse shares up to 0.3 more or less, its direction up to 40 degrees off
  //   texture   other looks of all that is not told apart by its colour, robot and table among it
  //   noise     of pictures: rgb 0.05 (of 0 … 1), depth as three Kinects'; of joint torques: 0.5 N m
  // Other strengths, above 0 and up to 10, are factors; of texture, the share of things that look otherwise.
  std::vector<std::string> perturb = {};

  int workers = 1;   // cores to use
  Shard shard = {};  // of all these episodes, as RunRequest: parts' catalogues are asked together
  // Who acts in whole episodes: one is made for each, by the thread that runs it. `Policy::begin` gets task and
  // instruction; where `act` gives nothing the episode ends; what it throws, and 100 refusals in a row, end it with the
  // reason policy_error. Empty: the planner, whose success says what can be done.
  std::function<std::unique_ptr<Policy>()> policy = {};
  std::string policy_name = "policy";  // in the options of its episodes
  EnvironmentSettings settings = {};   // of a policy: what it observes, rates, horizon; `record` is set in any case
  const std::atomic<bool>* stop = nullptr;  // looked at between steps: what has ended by then is told
};

// Of a task, or of its variations that have one value on one axis.
struct EvaluationRow {
  std::string task;          // empty: all
  std::string perturbation;  // `none`, or as asked for with its strengths: `light=2`
  std::string axis, value;   // of variations; empty: all of them
  std::int64_t episodes = 0, succeeded = 0;
  double success = 0, lower = 0, upper = 0;       // share, and its 95 % interval (Wilson, JASA 1927)
  double mean_return = 0;                         // sum of the task's rewards over an episode, 1 at success among them
  double mean_length_s = 0;                       // simulated
  std::map<std::string, std::int64_t> reasons{};  // of the failed ones
};

struct Evaluation {
  std::vector<EvaluationRow> rows;  // by perturbation in the order asked for, then task, then axis and value
  bool interrupted = false;
};

}  // namespace stampede
