// `cluster`: shards as a folder of scripts, and a real Slurm of two nodes that works on them.
#include <sys/wait.h>

#include <catch2/catch.hpp>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>

#include "db/catalogue.h"
#include "engine/base/shell_program.h"
#include "say.h"

namespace stampede::program {
namespace {

namespace fs = std::filesystem;

// An environment variable for as long as a test runs.
class Variable {
 public:
  Variable(std::string name, const std::string& value) : name_(std::move(name)) {
    if (const char* before = std::getenv(name_.c_str())) before_ = before;
    setenv(name_.c_str(), value.c_str(), 1);
  }
  ~Variable() {
    if (before_)
      setenv(name_.c_str(), before_->c_str(), 1);
    else
      unsetenv(name_.c_str());
  }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

 private:
  std::string name_;
  std::optional<std::string> before_;
};

int shell(const std::string& line) {
  const ShellProgram program(line, -1, -1, ShellProgram::Group::ours, ShellProgram::Orphans::searched);
  const int status = program.wait();
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128;
}

Said cluster(std::vector<std::string> words) {
  words.insert(words.begin(), "cluster");
  words.insert(words.end(), {"--root", kRoot});
  return say(words);
}

// Four short episodes in as many shards as are asked for.
Said begin(const std::string& way, const std::string& folder, int shards = 4, std::vector<std::string> more = {}) {
  std::vector<std::string> words = {way,        "reach_target",         "--episodes", "8",
                                    "--shards", std::to_string(shards), "--out",      folder};
  words.insert(words.end(), more.begin(), more.end());
  return cluster(words);
}

nlohmann::json status_of(const std::string& folder) {
  const Said said = cluster({"status", folder, "--json"});
  INFO(said.err);
  REQUIRE((said.code == kDone || said.code == kNo));
  nlohmann::json state = nlohmann::json::parse(said.out);
  CHECK((said.code == kDone) == state["complete"].get<bool>());
  return state;
}

const std::string& hash_of_one_run() {
  static const std::string kHash = [] {
    const Folder folder;
    say({"run", "reach_target", "--episodes", "8", "--out", folder / "one.db", "--root", kRoot});
    return Catalogue::open(folder / "one.db").content_hash();
  }();
  return kHash;
}

// The program, but shard 3 fails until the file is gone.
std::string program_that_fails(const Folder& folder) {
  put(folder, "fails", "");
  put(folder, "program",
      "#!/bin/sh\ncase \"$*\" in *'--shard 3/'*) [ -e " + shell_word(folder / "fails") +
          " ] && { echo 'no licence for shard 3' >&2; exit 3; };; esac\nexec " + shell_word(STAMPEDE_PROGRAM) +
          " \"$@\"\n");
  fs::permissions(folder / "program", fs::perms::owner_all);
  return folder / "program";
}

}  // namespace

TEST_CASE("a run in shards is a folder of two scripts, and their catalogue is that of one run") {
  const Folder folder;
  const std::string run = folder / "it's a \"run\" $HOME %a";
  const Variable program("STAMPEDE", STAMPEDE_PROGRAM);
  const Said begun = begin("xargs", run);
  INFO(begun.err);
  REQUIRE(begun.code == kDone);
  CHECK(status_of(run)["lost"].size() == 4);
  REQUIRE(shell("{ " + begun.out + "} >/dev/null") == 0);
  CHECK(Catalogue::open(run + "/demos.db").content_hash() == hash_of_one_run());
  const Said status = cluster({"status", run});
  CHECK(status.code == kDone);
  CHECK(says(status.out, "4 of 4 shards are made"));
  CHECK(says(status.out, "demos.db is complete: 8 episodes"));

  SECTION("a part that is there is not made again, and one that is lost is") {
    const auto when = fs::last_write_time(run + "/parts/part000001.db");
    fs::remove(run + "/parts/part000002.db");
    fs::remove(run + "/complete.txt");
    CHECK(status_of(run)["lost"].size() == 1);
    REQUIRE(shell("{ " + begun.out + "} >/dev/null") == 0);
    CHECK(fs::last_write_time(run + "/parts/part000001.db") == when);
    CHECK(fs::exists(run + "/parts/part000002.db"));
  }
  SECTION("another run into the same folder is refused, and so is one into a folder of something else") {
    const Said again = begin("xargs", run);
    CHECK(again.code == kBadInput);
    CHECK(says(again.err, "a run lies there already"));
    CHECK(says(again.err, "cluster resume"));
    put(folder, "mine/notes.txt", "");
    CHECK(says(begin("xargs", folder / "mine").err, "there is something of another kind"));
    CHECK(says(cluster({"status", folder / "mine"}).err, "no run lies there"));
  }
  SECTION("scripts that somebody else put there do not run") {
    put(folder, "victim.txt", "here");
    std::ofstream(run + "/shard.sh") << "rm " << folder / "victim.txt";
    CHECK(cluster({"status", run}).code == kDone);
    CHECK_FALSE(says(file_text(run + "/shard.sh"), "victim"));
  }
  SECTION("what says how the run is cut is not trusted") {
    const std::string manifest = run + "/cluster.json", good = file_text(manifest);
    const auto damaged = [&](const std::string& from, const std::string& to) {
      std::string text = good;
      const std::size_t at = text.find(from);
      REQUIRE(at != std::string::npos);
      std::ofstream(manifest) << text.replace(at, from.size(), to);
      const Said said = cluster({"status", run});
      CHECK(says(said.err, "cluster.json"));
      return said.code;
    };
    CHECK(damaged("\"shards\": 4", "\"shards\": -4") == kBadInput);
    CHECK(damaged("\"shards\": 4", "\"shards\": 1e99") == kBadInput);
    CHECK(damaged("\"shards\": 4", "\"shards\": \"; rm\"") == kBadInput);
    CHECK(damaged("\"format\": 1", "\"format\": 2") == kBadInput);
    CHECK(damaged("\"arrays\": []", "\"arrays\": [1]") == kBadInput);
    CHECK(damaged("\"arrays\": []", "\"rays\": []") == kBadInput);
    CHECK(damaged("{", "[") == kBadInput);
  }
}

TEST_CASE("a shard that fails is told with what it said, and the others are merged") {
  const Folder folder;
  const std::string run = folder / "run";
  const Variable program("STAMPEDE", program_that_fails(folder));
  const Said begun = begin("xargs", run, 4);
  REQUIRE(shell("{ " + begun.out + "} >/dev/null") != 0);
  const nlohmann::json state = status_of(run);
  REQUIRE(state["lost"].size() == 1);
  CHECK(state["lost"][0]["shard"] == 3);
  CHECK(says(state["lost"][0]["said"], "exit code 3 on "));
  CHECK(says(state["lost"][0]["said"], "no licence for shard 3"));
  CHECK(Catalogue::open(run + "/demos.db").episodes().size() == 6);
  CHECK(says(file_text(run + "/missing.txt"), "2 episodes are missing"));
  fs::remove(folder / "fails");
  REQUIRE(shell("{ " + begun.out + "} >/dev/null") == 0);
  CHECK(Catalogue::open(run + "/demos.db").content_hash() == hash_of_one_run());
}

TEST_CASE("a shard that has no room leaves nothing that looks like a part") {
  const Folder folder;
  const std::string run = folder / "run";
  const Variable program("STAMPEDE", STAMPEDE_PROGRAM);
  REQUIRE(begin("xargs", run, 2).code == kDone);
  CHECK(shell("ulimit -f 100; sh " + shell_word(run + "/shard.sh") + " 1") != 0);
  CHECK(fs::is_empty(run + "/parts"));
  CHECK(says(status_of(run)["lost"][0]["said"], "exit code"));
}

TEST_CASE("a command line for a cluster is refused before anything is written") {
  const Folder folder;
  const std::string run = folder / "run";
  const auto refused = [&](const std::vector<std::string>& words, ExitCode code, const std::string& why) {
    const Said said = cluster(words);
    INFO(said.err);
    CHECK(said.code == code);
    CHECK(says(said.err, why));
    CHECK_FALSE(fs::exists(run));
  };
  refused({"ssh", "reach_target"}, kUsage, "cannot 'ssh'");
  refused({"xargs", "reach_target", "--episodes", "8", "--out", run}, kUsage, "needs --shards");
  refused({"xargs", "reach_target", "--episodes", "8", "--shards", "9", "--out", run}, kUsage, "--shards 8 at most");
  refused({"xargs", "reach_target", "--episodes", "8", "--shards", "0", "--out", run}, kUsage, "at least 1");
  refused({"xargs", "reach_targt", "--episodes", "8", "--shards", "2", "--out", run}, kBadInput, "reach_target");
  refused({"xargs", "reach_target", "--shards", "1", "--out", run, "--sbatch", "-p cpu"}, kUsage,
          "not of cluster xargs");
  refused({"status", run, "--shards", "3"}, kUsage, "--shards is not of cluster status");
  refused({"resume", run, "--episodes", "3"}, kUsage, "--episodes is not of cluster resume");
  refused({"status", run, run}, kUsage, "one folder");
  refused({"kubernetes", "reach_target", "--shards", "1", "--out", run}, kUsage, "--image and --claim");
  refused({"slurm", "reach_target", "--shards", "1", "--out", run, "--sbatch", "--array=1-9"}, kUsage,
          "--array is said");
  refused({"slurm", "reach_target", "--shards", "1", "--out", run, "--sbatch", "evil.sh"}, kUsage,
          "no option of sbatch");
  refused({"slurm", "reach_target", "--shards", "1", "--out", run, "--sbatch", "--time='1'"}, kUsage, "quotes");
  const Variable nowhere("PATH", "/nonexistent");
  refused({"slurm", "reach_target", "--shards", "1", "--out", run}, kBadInput, "scontrol: is not on this machine");
}

TEST_CASE("the job for Kubernetes has an index for each shard and quotes what it is given") {
  const Folder folder;
  const std::string run = folder / "run";
  REQUIRE(begin("kubernetes", run, 4, {"--image", "lab/stampede:0.2", "--claim", "a: b\n- c"}).code == kDone);
  const std::string job = file_text(run + "/job.yaml");
  CHECK(says(job, "completions: 4\n"));
  CHECK(says(job, "image: \"lab/stampede:0.2\"\n"));
  CHECK(says(job, "claimName: \"a: b\\n- c\"\n"));
}

namespace {

// Slurm on two nodes, which ends with this object.
class Slurm {
 public:
  explicit Slurm(int most_in_array = 1000) : limit_("MAX_ARRAY_SIZE", std::to_string(most_in_array + 1)) {
    const std::string ready = folder_ / "ready";
    const std::string line = kScript + " " + shell_word(folder_ / "slurm") + " sh -c 'touch \"$0\"; exec sleep 600' " +
                             shell_word(ready) + " 2>" + shell_word(folder_ / "said.txt");
    program_.emplace(line, -1, -1, ShellProgram::Group::own, ShellProgram::Orphans::searched);
    for (int i = 0; i < 1800 && !fs::exists(ready); ++i) {
      if (says(file_text(folder_ / "said.txt"), "not here: ")) {
        WARN(file_text(folder_ / "said.txt"));
        return;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    INFO(file_text(folder_ / "said.txt"));
    REQUIRE(fs::exists(ready));
    here_ = true;
  }
  explicit operator bool() const { return here_; }  // false: Slurm is not on this machine, or cannot start

  void fail(const std::string& node) const { shell(kScript + " --fail " + shell_word(folder_ / "slurm") + " " + node); }
  // Slurm waits two minutes before it runs again what was on a node that failed.
  static void do_not_delay() {
    shell("for job in $(squeue -h -t PD -o %i); do scontrol update JobId=$job StartTime=now; done");
  }
  // What the folder's state is once `done` says so.
  static nlohmann::json wait(const std::string& run, const std::function<bool(const nlohmann::json&)>& done) {
    nlohmann::json state;
    for (int i = 0; i < 900; ++i) {
      state = status_of(run);
      if (done(state)) return state;
      std::this_thread::sleep_for(std::chrono::milliseconds(200));
    }
    FAIL("it does not come to that: " << state.dump(2));
    return state;
  }
  Folder& folder() { return folder_; }

 private:
  inline static const std::string kScript = shell_word(std::string(kRoot) + "/tests/program/slurm");
  Folder folder_;
  Variable limit_, conf_{"SLURM_CONF", folder_ / "slurm/slurm.conf"};
  std::optional<ShellProgram> program_;
  bool here_ = false;
};

bool is_complete(const nlohmann::json& state) { return state["complete"]; }

}  // namespace

TEST_CASE("Slurm makes the catalogue of one run, though a node fails in the middle of the array") {
  Slurm slurm;
  if (!slurm) return;
  const std::string run = slurm.folder() / "a run";
  const Variable program("STAMPEDE", STAMPEDE_PROGRAM);
  const Said begun = begin("slurm", run, 8, {"--sbatch", "--time=5 --cpus-per-task=1"});
  INFO(begun.err);
  REQUIRE(begun.code == kDone);
  CHECK(says(begun.out, "8 shards as array"));
  CHECK(says(begin("slurm", run, 8).err, "a run lies there already"));
  Slurm::wait(run, [](const auto& state) { return state["running"].size() == 2; });
  slurm.fail("n2");
  Slurm::wait(run, [](const auto& state) { return state["made"].template get<int>() + state["waiting"].size() == 8; });
  Slurm::do_not_delay();
  const nlohmann::json state = Slurm::wait(run, is_complete);
  CHECK(state["made"] == 8);
  CHECK(state["lost"].empty());
  CHECK(Catalogue::open(run + "/demos.db").content_hash() == hash_of_one_run());
  CHECK(says(cluster({"resume", run}).out, "nothing is left to do"));
}

TEST_CASE("on Slurm a shard that fails stops no other, resume runs what is lost and cancel ends all") {
  Slurm slurm(8);
  if (!slurm) return;
  const Said many =
      cluster({"slurm", "reach_target", "--episodes", "20", "--shards", "9", "--out", slurm.folder() / "many"});
  CHECK(says(many.err, "arrays of this cluster go up to 8, not 9"));
  CHECK_FALSE(fs::exists(slurm.folder() / "many"));

  const std::string run = slurm.folder() / "run";
  const Variable program("STAMPEDE", program_that_fails(slurm.folder()));
  const Said wrong = begin("slurm", run, 4, {"--sbatch", "--partition=nowhere"});
  CHECK(wrong.code == kBadInput);
  CHECK(says(wrong.err, "invalid partition"));
  REQUIRE(cluster({"resume", run, "--sbatch", "--hold"}).code == kDone);
  const nlohmann::json held = status_of(run);
  CHECK(held["waiting"].size() == 4);
  CHECK(says(cluster({"resume", run}).out, "nothing is lost: 0 shards run, 4 wait"));
  CHECK(says(cluster({"cancel", run}).out, "tasks cancelled"));
  Slurm::wait(run, [](const auto& state) { return state["lost"].size() == 4; });

  REQUIRE(cluster({"resume", run, "--sbatch", "--time=5"}).code == kDone);
  const nlohmann::json state = Slurm::wait(run, [&](const auto& now) {
    return now["made"] == 3 && now["lost"].size() == 1 && fs::exists(run + "/missing.txt");
  });
  CHECK(state["lost"][0]["shard"] == 3);
  CHECK(says(state["lost"][0]["said"], "no licence for shard 3"));
  fs::remove(slurm.folder() / "fails");
  const Said again = cluster({"resume", run});
  CHECK(says(again.out, "1 shards as array"));
  Slurm::wait(run, is_complete);
  CHECK(Catalogue::open(run + "/demos.db").content_hash() == hash_of_one_run());
}

}  // namespace stampede::program
