#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numeric>
#include <ostream>

#include "engine/base/hash.h"
#include "engine/base/shell_program.h"
#include "engine/base/text.h"
#include "engine/base/text_file.h"
#include "scripting/commands/commands.h"
#include "scripting/commands/run_request.h"
#include "scripting/commands/shard_folder.h"
#include "scripting/commands/slurm.h"
#include "scripting/commands/symbol_options.h"
#include "scripting/program/json_text.h"

namespace stampede::program {
namespace {

namespace fs = std::filesystem;

// Of commands that change who works on a folder, one at a time. The lock goes with the process.
class TurnAt {
 public:
  explicit TurnAt(const fs::path& folder) : file_(open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
    if (file_ >= 0 && flock(file_, LOCK_EX | LOCK_NB) != 0) {
      close(file_);
      throw Error(folder.string(), "another command works on it now", "wait until it is done");
    }
  }
  ~TurnAt() {
    if (file_ >= 0) close(file_);
  }
  TurnAt(const TurnAt&) = delete;
  TurnAt& operator=(const TurnAt&) = delete;

 private:
  int file_;
};

// --root and --path as `make` is given them in whatever folder it runs.
std::vector<std::string> root_words(const Arguments& arguments) {
  std::vector<std::string> words;
  const auto add = [&](const char* option, const std::string& path) {
    words.insert(words.end(), {option, fs::absolute(path).lexically_normal().string()});
  };
  if (arguments.has("--root")) add("--root", arguments.text("--root"));
  for (const std::string& path : arguments.list("--path")) add("--path", path);
  return words;
}

int shards_of(const Arguments& arguments, std::int64_t episodes) {
  if (!arguments.has("--shards")) throw UsageError("stampede cluster needs --shards K");
  const auto shards = in_range(arguments, "--shards", 1, kMostShards);
  if (shards > episodes)
    throw UsageError(fmt::format("--shards: {} shards of {} episodes", shards, episodes),
                     fmt::format("--shards {} at most", episodes));
  return static_cast<int>(shards);
}

// TASK… as a folder.
ShardFolder begun(const Arguments& arguments, Console& console) {
  if (!arguments.has("--out")) throw UsageError("stampede cluster needs --out DIR");
  Arguments asked = arguments;
  asked.set("TASK", arguments.list("WHAT"), true);
  const RunRequestRead read = read_run_request(asked, console);
  tell_left_out(*read.library, {}, console);
  const Lock plan = plan_of(read, asked, "cluster");
  const int shards = shards_of(arguments, plan.episodes());
  if (arguments.text("WAY") == "slurm") require_array_of(shards);
  return {arguments.text("--out"), plan, {plan.episodes(), shards, root_words(arguments)}};
}

std::vector<int> all_shards(const ShardFolder& folder) {
  std::vector<int> shards(static_cast<std::size_t>(folder.shape().shards));
  std::iota(shards.begin(), shards.end(), 1);
  return shards;
}

void tell_submitted(const ShardFolder& folder, std::size_t shards, Console& console) {
  const ShardFolder::Submitted& submitted = folder.submitted();
  const std::string array = shards == 0 ? "" : fmt::format("{} shards as array {}, ", shards, submitted.arrays.back());
  console.out << fmt::format("{}: {}a merge as job {}\n`stampede cluster status {}` says how far they are\n",
                             folder.path().string(), array, submitted.finish, folder.path().string());
}

ExitCode begin_slurm(const Arguments& arguments, Console& console) {
  const std::vector<std::string> options = sbatch_words(arguments.text("--sbatch"));
  ShardFolder folder = begun(arguments, console);
  const TurnAt turn(folder.path());
  folder.keep({options, {}, {}});
  const std::vector<int> shards = all_shards(folder);
  submit(folder, shards);
  tell_submitted(folder, shards.size(), console);
  return kDone;
}

ExitCode begin_xargs(const Arguments& arguments, Console& console) {
  const ShardFolder folder = begun(arguments, console);
  const auto script = [&](const char* name) { return shell_word((folder.path() / name).string()); };
  console.out << fmt::format("seq {} | xargs -P {} -n 1 sh {}\nsh {}\n", folder.shape().shards, workers_of(arguments),
                             script("shard.sh"), script("finish.sh"));
  return kDone;
}

constexpr const char* kJob =
    R"text(# kubectl apply -f job.yaml; when it is over, wherever the volume is seen: sh finish.sh
apiVersion: batch/v1
kind: Job
metadata:
  name: stampede-{3}
spec:
  completionMode: Indexed
  completions: {0}
  parallelism: {0}
  backoffLimitPerIndex: 2
  maxFailedIndexes: {0}
  template:
    spec:
      restartPolicy: Never
      containers:
        - name: shard
          image: {1}
          command: ["sh", "-c", "exec sh /run/stampede/shard.sh $((JOB_COMPLETION_INDEX + 1))"]
          env:
            - name: STAMPEDE
              value: stampede
          resources:
            requests:
              cpu: "1"
              memory: 1Gi
          volumeMounts:
            - name: run
              mountPath: /run/stampede
      volumes:
        - name: run
          persistentVolumeClaim:
            claimName: {2}
)text";

ExitCode begin_kubernetes(const Arguments& arguments, Console& console) {
  const std::string image = arguments.text("--image"), claim = arguments.text("--claim");
  if (image.empty() || claim.empty())
    throw UsageError("stampede cluster kubernetes needs --image and --claim",
                     "an image with the program, and the claim of a volume that holds DIR");
  const ShardFolder folder = begun(arguments, console);
  const auto quoted = [](const std::string& text) { return nlohmann::json(text).dump(); };  // YAML holds JSON
  write_text_file(folder.path() / "job.yaml",
                  fmt::format(fmt::runtime(kJob), folder.shape().shards, quoted(image), quoted(claim),
                              content_hash(read_text_file(folder.path() / "run.plan")).substr(0, 12)));
  console.out << fmt::format("kubectl apply -f {}\n", shell_word((folder.path() / "job.yaml").string()));
  return kDone;
}

struct Progressed {
  std::int64_t made = 0;
  SlurmState slurm;
  std::vector<int> lost;  // neither made nor at work
};

Progressed progressed(const ShardFolder& folder) {
  Progressed now;
  now.slurm = state_of(folder);  // before parts are looked for: what ends meanwhile is not taken for lost
  std::vector<int> live = now.slurm.running;
  live.insert(live.end(), now.slurm.waiting.begin(), now.slurm.waiting.end());
  std::ranges::sort(live);
  for (const int shard : all_shards(folder)) {
    if (folder.has_part(shard))
      ++now.made;
    else if (!std::ranges::binary_search(live, shard))
      now.lost.push_back(shard);
  }
  return now;
}

void tell_json(const ShardFolder& folder, const Progressed& now, Console& console) {
  JsonText json;
  json.object().field("complete", folder.is_complete()).field("episodes", folder.shape().episodes);
  json.field("shards", folder.shape().shards).field("made", now.made);
  const auto add = [&](const char* name, const std::vector<int>& shards) {
    json.key(name).array();
    for (const int shard : shards) json.value(shard);
    json.end();
  };
  add("running", now.slurm.running);
  add("waiting", now.slurm.waiting);
  json.key("lost").array();
  for (const int shard : now.lost) json.object().field("shard", shard).field("said", folder.last_words(shard)).end();
  console.out << json.end().end().text();
}

constexpr std::size_t kMostLost = 10;  // told to people one by one

ExitCode tell_status(const Arguments& arguments, Console& console) {
  const ShardFolder folder(arguments.list("WHAT").front());
  const Progressed now = progressed(folder);
  const ExitCode code = folder.is_complete() ? kDone : kNo;
  if (arguments.flag("--json")) {
    tell_json(folder, now, console);
    return code;
  }
  console.out << fmt::format("{} of {} shards are made, {} run, {} wait{}, {} are lost\n", now.made,
                             folder.shape().shards, now.slurm.running.size(), now.slurm.waiting.size(),
                             now.slurm.reasons.empty() ? "" : " (" + joined(now.slurm.reasons) + ")", now.lost.size());
  for (std::size_t i = 0; i < std::min(now.lost.size(), kMostLost); ++i) {
    const std::string said = folder.last_words(now.lost[i]);
    console.out << fmt::format("    {}: {}\n", now.lost[i], said.empty() ? "never began" : said);
  }
  if (now.lost.size() > kMostLost) console.out << fmt::format("    and {} more\n", now.lost.size() - kMostLost);
  if (folder.is_complete())
    console.out << fmt::format("demos.db is {}", read_text_file(folder.path() / "complete.txt"));
  else if (now.slurm.merge_waits)
    console.out << "the merge follows\n";
  else
    console.out << fmt::format("nothing is merged; `stampede cluster resume {}` goes on\n", folder.path().string());
  return code;
}

ExitCode resume(const Arguments& arguments, Console& console) {
  ShardFolder folder(arguments.list("WHAT").front());
  const TurnAt turn(folder.path());
  if (folder.is_complete()) {
    console.out << "complete: nothing is left to do\n";
    return kDone;
  }
  if (folder.submitted().arrays.empty() && !arguments.has("--sbatch"))
    throw Error(folder.path().string(), "nothing of it was submitted to Slurm",
                "`sh shard.sh I` makes a shard that is missing, `sh finish.sh` merges; --sbatch \"\" submits to Slurm");
  const Progressed now = progressed(folder);
  if (now.lost.empty() && now.slurm.merge_waits) {
    console.out << fmt::format("nothing is lost: {} shards run, {} wait\n", now.slurm.running.size(),
                               now.slurm.waiting.size());
    return kDone;
  }
  if (arguments.has("--sbatch")) {
    ShardFolder::Submitted submitted = folder.submitted();
    submitted.options = sbatch_words(arguments.text("--sbatch"));
    folder.keep(submitted);
  }
  submit(folder, now.lost);
  tell_submitted(folder, now.lost.size(), console);
  return kDone;
}

ExitCode cancel_all(const Arguments& arguments, Console& console) {
  const ShardFolder folder(arguments.list("WHAT").front());
  const TurnAt turn(folder.path());
  console.out << fmt::format("{} tasks cancelled; `stampede cluster resume {}` goes on\n", cancel(folder),
                             folder.path().string());
  return kDone;
}

struct Way {
  ExitCode (*go)(const Arguments&, Console&);
  bool begins = false;                    // WHAT is tasks, and no folder
  std::vector<std::string> options = {};  // that others do not have
};

const std::map<std::string, Way>& ways() {
  static const std::map<std::string, Way> all = {
      {"slurm", {begin_slurm, true, {"--shards", "--out", "--sbatch"}}},
      {"kubernetes", {begin_kubernetes, true, {"--shards", "--out", "--image", "--claim"}}},
      {"xargs", {begin_xargs, true, {"--shards", "--out", "--workers"}}},
      {"status", {tell_status}},
      {"resume", {resume, false, {"--sbatch"}}},
      {"cancel", {cancel_all}}};
  return all;
}

ExitCode do_cluster(const Arguments& arguments, Console& console) {
  const std::string name = arguments.text("WAY");
  const auto way = ways().find(name);
  if (way == ways().end())
    throw UsageError("stampede cluster cannot '" + name + "'",
                     "slurm, kubernetes and xargs begin a run, status, resume and cancel are about one");
  for (const char* option : {"--shards", "--out", "--sbatch", "--image", "--claim", "--workers"})
    if (arguments.has(option) && std::ranges::find(way->second.options, option) == way->second.options.end())
      throw UsageError(fmt::format("{} is not of cluster {}", option, name), "leave it out");
  if (!way->second.begins) {
    if (arguments.list("WHAT").size() != 1) throw UsageError("stampede cluster " + name + " takes one folder");
    for (const OptionRow& option : run_request_options())
      if (arguments.has(option.name))
        throw UsageError(fmt::format("{} is not of cluster {}", option.name, name),
                         "what is made was said when the run began");
  }
  return way->second.go(arguments, console);
}

}  // namespace

CommandRow cluster_command() {
  CommandRow row{
      "cluster",
      "Run tasks on many machines: Slurm, Kubernetes, or whatever starts a command",
      "DIR is a folder that all machines see. `slurm`, `kubernetes` and `xargs` write the plan of the run and two "
      "scripts into it: `sh shard.sh I` makes the I-th of --shards parts, whole or not at all and never twice, `sh "
      "finish.sh` merges the parts into DIR/demos.db, which is then the catalogue of one run on one machine, bit for "
      "bit, and says what is missing. `slurm` submits an array of the shards, and the merge to follow it; a shard "
      "whose "
      "node fails is run again, one that fails stops no other. `status` says how far all are and what the lost ones "
      "said (exit code 0: complete), `resume` runs those again that are lost, `cancel` ends what runs. Each shard is "
      "made in TMPDIR of its machine. The machines need the same program: STAMPEDE names it where it lies elsewhere.",
      {{"WAY", "slurm, kubernetes or xargs; status, resume or cancel", true, false},
       {"WHAT", "tasks to run; of status, resume and cancel DIR", true, true}},
      {{"--shards", "K", "parts of the run", Takes::integer, "", {}, false},
       {"--out", "DIR", "the folder, which is not there yet", Takes::path, "", {}, false},
       {"--sbatch",
        "OPTIONS",
        "for sbatch: \"--partition=cpu --time=2:00:00 --cpus-per-task=4\"",
        Takes::text,
        "",
        {},
        false},
       {"--image", "NAME", "of kubernetes: a container image with the program", Takes::text, "", {}, false},
       {"--claim", "NAME", "of kubernetes: the claim of the volume that holds DIR", Takes::text, "", {}, false},
       {"--workers", "W", "of xargs: shards at a time, default: a core each", Takes::integer, "", {}, false}},
      {"stampede cluster slurm push_buttons --episodes 100000 --shards 100 --sbatch \"--time=2:00:00\" --out run1",
       "stampede cluster status run1", "stampede cluster resume run1", "stampede cluster cancel run1",
       "stampede cluster xargs push_buttons --episodes 4 --shards 2 --out run2",
       "stampede cluster kubernetes push_buttons --episodes 4 --shards 2 --out run3 --image stampede:0.2 --claim lab"},
      do_cluster};
  add_options(row.options, run_request_options());
  return row;
}

}  // namespace stampede::program
