#include <fmt/format.h>

#include <ostream>
#include <set>

#include "db/table_text.h"
#include "engine/base/file_name.h"
#include "engine/symbolic/pddl.h"
#include "scripting/commands/commands.h"
#include "scripting/commands/export_kinds.h"
#include "scripting/session/stored_symbols.h"

namespace stampede::program {

OutputFolder indexed_folder(const ExportJob& job, const QueryResult& index) {
  const std::string head = to_csv(index);  // no rows yet: the names of its columns
  OutputFolder folder(job.folder, "index.csv", marked_kind("exported problems", head.substr(0, head.find(',')), head),
                      output_rules(job.arguments, job.console));
  folder.check({"index.csv", "index.json"});
  write_index(folder, index);
  return folder;
}

void write_index(const OutputFolder& folder, const QueryResult& index) {
  folder.write("index.csv", to_csv(index));
  folder.write("index.json", to_json(index));
}

namespace {

// A problem and a plan for it: two files and a row of the index.
struct PlannedProblem {
  std::string kind;    // start, boundary, end, ordered
  std::string domain;  // its file
  std::int64_t frame = 0;
  std::string text;
  const Plan& plan;
  bool valid = false;
};

class PddlExporter {
 public:
  explicit PddlExporter(const ExportJob& job) : job_(job), folder_(indexed_folder(job, index_)) {}

  ExportCount run() {
    for (const std::int64_t id : job_.episodes) {
      if (job_.console.stopped()) break;
      const EpisodeRecord episode = job_.catalogue.read_episode(id);
      try {
        write_episode(id, episode);
      } catch (const Error& error) {
        ++count_.left_out;
        job_.console.err << "episode " << id << " is left out: " << error.message() << "\n";
      }
    }
    write_index(folder_, index_);
    return count_;
  }

 private:
  void write_episode(std::int64_t id, const EpisodeRecord& episode) {
    const StoredSymbols symbols = read_symbols(episode);
    const std::string domain = write_domain(symbols.domain.name, *document_of(episode, DocumentKind::pddl_domain));
    const std::vector<Boundary> boundaries = skill_boundaries(episode, symbols.domain);
    for (const Boundary& boundary : boundaries) {
      const AbstractState state = abstract_state(episode, boundary.frame);
      const Problem problem = problem_at(symbols, state, job_.arguments.flag("--known"));
      const std::string kind = boundary.frame == 0                         ? "start"
                               : boundary.frame == boundaries.back().frame ? "end"
                                                                           : "boundary";
      const bool valid = validate(symbols.domain, problem, boundary.rest).valid;
      write_problem(id, episode,
                    {kind, domain, boundary.frame,
                     unknown_facts(state, symbols.domain) + to_pddl(problem, symbols.domain, episode.beside_goal),
                     boundary.rest, valid});
    }
    write_ordered(id, episode);
  }

  // With fluents for the order of the goal: what the planner was asked.
  void write_ordered(std::int64_t id, const EpisodeRecord& episode) {
    const std::string* domain = document_of(episode, DocumentKind::ordered_domain);
    const std::string* problem = document_of(episode, DocumentKind::ordered_problem);
    const std::string* plan = document_of(episode, DocumentKind::plan);
    if (domain == nullptr || problem == nullptr || plan == nullptr) return;
    const Domain ordered = domain_from_pddl(*domain, "ordered_domain");
    const Plan steps = plan_from_text(*plan, "plan");
    const bool valid = validate(ordered, problem_from_pddl(*problem, "ordered_problem", ordered), steps).valid;
    write_problem(id, episode, {"ordered", write_domain(ordered.name, *domain), 0, *problem, steps, valid});
  }

  std::string write_domain(const std::string& name, const std::string& text) {
    const std::string file = "domains/" + file_name(name) + ".pddl";
    if (domains_.insert(file).second) write(file, text);
    return file;
  }

  void write_problem(std::int64_t id, const EpisodeRecord& episode, const PlannedProblem& one) {
    const std::string task = file_name(episode.task);
    const std::string stem = one.kind == "ordered" ? fmt::format("problems/{}_e{:05}_ordered", task, id)
                                                   : fmt::format("problems/{}_e{:05}_f{:05}", task, id, one.frame);
    write(stem + ".pddl", one.text);
    write(stem + ".plan", to_pddl(one.plan));
    index_.rows.push_back({stem + ".pddl", one.domain, stem + ".plan", one.kind, id, episode.task, episode.variation,
                           episode.seed, one.frame, static_cast<double>(one.frame) / episode.frame_hz,
                           std::string(to_string(episode.outcome)), std::string(to_string(episode.reason)),
                           static_cast<std::int64_t>(one.plan.size()), std::int64_t{one.valid}, episode.beside_goal});
  }

  void write(const std::string& file, const std::string& text) {
    folder_.write(file, text);
    ++count_.files;
  }

  const ExportJob& job_;
  std::set<std::string> domains_;
  QueryResult index_{{"problem", "domain", "plan", "kind", "episode", "task", "variation", "seed", "frame", "time_s",
                      "outcome", "reason", "plan_steps", "valid", "beside_goal"},
                     {}};
  OutputFolder folder_;
  ExportCount count_;
};

}  // namespace

ExportCount export_pddl(const ExportJob& job) { return PddlExporter(job).run(); }

}  // namespace stampede::program
