#include "scripting/commands/slurm.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <set>
#include <sstream>
#include <utility>

#include "engine/base/error.h"
#include "engine/base/shell_program.h"
#include "engine/base/text.h"
#include "scripting/program/command.h"

namespace stampede::program {
namespace {

struct Answer {
  int code = 0;
  std::string text;  // of both streams
};

class Pipe {
 public:
  Pipe() {
    if (pipe2(ends_.data(), O_CLOEXEC) != 0) throw Error("cluster", "no pipe can be made");
  }
  ~Pipe() {
    close_input();
    close(ends_[0]);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  int input() const { return ends_[1]; }
  void close_input() {
    if (ends_[1] >= 0) close(std::exchange(ends_[1], -1));
  }
  std::string read_all() const {
    std::string text;
    std::array<char, 4096> piece{};
    for (ssize_t got = 0; (got = read(ends_[0], piece.data(), piece.size())) > 0;)
      text.append(piece.data(), static_cast<std::size_t>(got));
    return text;
  }

 private:
  std::array<int, 2> ends_{-1, -1};
};

Answer answer_of(const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words) line += shell_word(word) + " ";
  Pipe pipe;
  const ShellProgram program(line + "</dev/null 2>&1", -1, pipe.input(), ShellProgram::Group::ours,
                             ShellProgram::Orphans::searched);
  pipe.close_input();
  Answer answer;
  answer.text = pipe.read_all();
  const int status = program.wait();
  answer.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128;
  return answer;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  for (const std::string& line : split(text, '\n'))
    if (!trimmed(line).empty()) lines.push_back(trimmed(line));
  return lines;
}

// What it says when all is well.
std::string ask(const std::vector<std::string>& words) {
  const Answer answer = answer_of(words);
  if (answer.code == 127)
    throw Error(words[0], "is not on this machine",
                "run this where Slurm is; without it `stampede cluster xargs` runs the same shards");
  if (answer.code != 0) throw Error(words[0], joined(lines_of(answer.text), "; "), "Slurm refused it");
  return answer.text;
}

constexpr std::array kOwn = {"--array", "-a", "--chdir",   "-D",     "--dependency", "-d",          "--error",
                             "-e",      "-o", "--output",  "--wrap", "--parsable",   "--open-mode", "--test-only",
                             "--input", "-i", "--requeue", "--wait", "-W",           "--no-requeue"};

// `1-3,7`
std::string ranges_of(const std::vector<int>& shards) {
  std::string text;
  for (std::size_t i = 0; i < shards.size();) {
    std::size_t last = i;
    while (last + 1 < shards.size() && shards[last + 1] == shards[last] + 1) ++last;
    text += fmt::format("{}{}", text.empty() ? "" : ",", shards[i]);
    if (last > i) text += fmt::format("-{}", shards[last]);
    i = last + 1;
  }
  return text;
}

std::string submit_script(const ShardFolder& folder, const std::vector<std::string>& words,
                          const std::string& command) {
  std::vector<std::string> all = {"sbatch", "--parsable", "--job-name=stampede", "--requeue", "--open-mode=append"};
  all.push_back("--chdir=" + folder.path().string());
  for (const auto* more : {&folder.submitted().options, &words}) all.insert(all.end(), more->begin(), more->end());
  all.push_back("--wrap=" + command);
  const std::vector<std::string> said = lines_of(ask(all));                    // remarks of sbatch come before
  const std::string id = said.empty() ? "" : split(said.back(), ';').front();  // `12;cluster`
  if (id.empty() || id.find_first_not_of("0123456789") != std::string::npos)
    throw Error("sbatch", "answered with no job's number");
  return id;
}

// A row of squeue.
struct LiveTask {
  std::string job, index, letters, reason;  // of a job without an array the index is N/A
  bool waits() const {
    static const std::set<std::string> kWaiting = {"PD", "RQ", "RH", "RF", "SE"};
    return kWaiting.contains(letters);
  }
};

std::vector<LiveTask> live_tasks() {
  std::vector<LiveTask> tasks;
  for (const std::string& line : lines_of(ask({"squeue", "--noheader", "--me", "--array", "--format=%F %K %t %r"}))) {
    LiveTask task;
    std::istringstream words(line);
    words >> task.job >> task.index >> task.letters;
    std::getline(words >> std::ws, task.reason);
    task.reason = trimmed(task.reason);
    tasks.push_back(std::move(task));
  }
  return tasks;
}

bool is_of(const ShardFolder& folder, const std::string& job) {
  const ShardFolder::Submitted& submitted = folder.submitted();
  return job == submitted.finish || std::ranges::find(submitted.arrays, job) != submitted.arrays.end();
}

}  // namespace

std::vector<std::string> sbatch_words(const std::string& text) {
  std::vector<std::string> words;
  for (const std::string& word : split(text, ' '))
    if (!trimmed(word).empty()) words.push_back(trimmed(word));
  for (const std::string& word : words) {
    const std::string name = word.substr(0, word.find('='));
    if (std::ranges::find(kOwn, name) != kOwn.end())
      throw UsageError("--sbatch: " + name + " is said by `stampede cluster` itself", "leave it out");
    if (word.find_first_of("'\"\\\n") != std::string::npos)
      throw UsageError("--sbatch: " + word + " has quotes, which nobody takes off",
                       "--sbatch \"--time=2:00:00 -p cpu\"");
  }
  if (!words.empty() && !words.front().starts_with("-"))
    throw UsageError("--sbatch: " + words.front() + " is no option of sbatch", "--sbatch \"--time=2:00:00 -p cpu\"");
  return words;
}

void require_array_of(int shards) {
  for (const std::string& line : lines_of(ask({"scontrol", "show", "config"}))) {
    if (!line.starts_with("MaxArraySize")) continue;
    const std::string number = trimmed(line.substr(line.find('=') + 1));
    int size = 0;
    std::from_chars(number.data(), number.data() + number.size(), size);
    if (size > 0 && shards >= size)
      throw Error("--shards", fmt::format("arrays of this cluster go up to {}, not {}", size - 1, shards),
                  fmt::format("--shards {}, of more episodes each", size - 1));
  }
}

void submit(ShardFolder& folder, const std::vector<int>& shards) {
  ShardFolder::Submitted submitted = folder.submitted();
  const std::string before = submitted.finish;
  if (!shards.empty()) {
    const std::string id = submit_script(folder, {"--array=" + ranges_of(shards), "--output=logs/%a.txt"},
                                         "exec sh ./shard.sh \"$SLURM_ARRAY_TASK_ID\"");
    submitted.arrays.push_back(id);
    folder.keep(submitted);
  }
  std::string after;
  for (const std::string& id : submitted.arrays) after += ":" + id;
  submitted.finish =
      submit_script(folder, {"--dependency=afterany" + after, "--output=logs/finish.txt"}, "exec sh ./finish.sh");
  folder.keep(submitted);
  if (!before.empty()) answer_of({"scancel", before});  // gone already: as good
}

SlurmState state_of(const ShardFolder& folder) {
  SlurmState state;
  if (folder.submitted().arrays.empty()) return state;
  std::set<std::string> reasons;
  for (const LiveTask& task : live_tasks()) {
    if (!is_of(folder, task.job)) continue;
    if (task.job == folder.submitted().finish) {
      state.merge_waits = true;
      continue;
    }
    int shard = 0;
    std::from_chars(task.index.data(), task.index.data() + task.index.size(), shard);
    if (shard < 1 || shard > folder.shape().shards || folder.has_part(shard)) continue;
    (task.waits() ? state.waiting : state.running).push_back(shard);
    if (task.waits()) reasons.insert(task.reason);
  }
  state.reasons.assign(reasons.begin(), reasons.end());
  return state;
}

int cancel(const ShardFolder& folder) {
  std::set<std::string> jobs;
  int tasks = 0;
  for (const LiveTask& task : live_tasks())
    if (is_of(folder, task.job)) jobs.insert(task.job), ++tasks;
  std::vector<std::string> words = {"scancel"};
  words.insert(words.end(), jobs.begin(), jobs.end());
  if (!jobs.empty()) ask(words);
  return tasks;
}

}  // namespace stampede::program
