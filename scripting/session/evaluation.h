// Episodes of some tasks, undisturbed and along each perturbation, and what to say of them.
#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "db/catalogue_writer.h"
#include "scripting/session/run_job.h"
#include "stampede/evaluation.h"

namespace stampede {

inline constexpr const char* kUndisturbed = "none";  // perturbation of a row

// Collects episodes into rows. Repeatable: they do not depend on the order in which episodes come.
class EvaluationTable {
 public:
  void add(const std::string& perturbation, const EpisodeRecord& episode);
  // Of these perturbations, in their order; one of all tasks after several of them.
  std::vector<EvaluationRow> rows(const std::vector<std::string>& perturbations) const;

 private:
  struct Count {
    std::int64_t episodes = 0, succeeded = 0;
    std::int64_t microseconds = 0, returned = 0;  // whole numbers (1e-6): their sum does not depend on the order
    std::map<std::string, std::int64_t> reasons;
    void add(const EpisodeRecord& episode);
    EvaluationRow row() const;
  };
  struct Place {
    std::string task, axis, value;
    friend auto operator<=>(const Place&, const Place&) = default;
  };
  std::map<std::string, std::map<Place, Count>> counts_;  // by perturbation
};

// Wilson's interval of a share at 95 %; of nothing, 0 … 1.
std::pair<double, double> wilson_interval(std::int64_t succeeded, std::int64_t episodes);

struct EvaluationSettings {
  RunSettings run;                   // `progress` gets the tally of all perturbations; `act` empty: the planner
  std::vector<std::string> perturb;  // as EvaluationRequest
};

// `open`: where each perturbation's episodes go; empty: nowhere. Every episode is run, also one that is there already.
// Throws Error for what is no perturbation, before anything runs, and what run_jobs throws.
Evaluation evaluate(const std::shared_ptr<const Library>& library, const JobList& jobs, EvaluationSettings settings,
                    const std::function<std::unique_ptr<CatalogueWriter>()>& open);

// One episode in which a policy acts. See EvaluationRequest.
EpisodeRecord act_as(PreparedEpisode& prepared, const EvaluationRequest& request);

}  // namespace stampede
