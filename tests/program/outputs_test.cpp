// Every option that names a file or folder to be written: what is read, what others made, links and devices stay.
#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <catch2/catch.hpp>
#include <set>
#include <thread>

#include "tests/program/say.h"

namespace stampede::program {
namespace {

namespace fs = std::filesystem;

enum class Form { stream, film, folder };

struct Output {
  std::string command, option;
  Form form;
  std::vector<std::string> words;  // the command without the option; the first input is `input`
  std::string input;               // a file that it reads
  std::string inside;              // folder: a file that it writes there
};

// One episode with pictures, and a data set of it.
class Made {
 public:
  Made() {
    REQUIRE(say({"run", "reach_target", "--episodes", "4", "--root", kRoot, "--out", db(), "--images", "keyframes",
                 "--camera", "front", "--size", "32x32"})
                .code == kDone);
    REQUIRE(say({"dataset", "segments", db(), "--out", folder_ / "given", "--hidden", folder_ / "hidden"}).code ==
            kDone);
    REQUIRE(say({"baseline", "one_segment", folder_ / "given", "--out", answers()}).code == kDone);
    // Out of reach, so that `check` has something to draw.
    put(folder_, "mine/tasks/t.lua",
        "-- Lift the cube.\nreturn task { world = \"tabletop\", objects = { far = { \"tray\", at = { 0.75, 0, 0.75 } "
        "}, "
        "a = { \"cube\", at = { 0.75, 0, 0.7702 } } }, init = {}, goal = is.lifted(\"a\"), instructions = { \"x\" } "
        "}\n");
  }
  std::string db() const { return folder_ / "demos.db"; }
  std::string answers() const { return folder_ / "answers.json"; }
  std::string path(const std::string& name) const { return folder_ / name; }

  std::vector<Output> outputs() const {
    const std::vector<std::string> small = {"--frames", "0", "--size", "32x32"};
    const std::string given = path("given"), hidden = path("hidden"), mine = path("mine");
    const std::vector<std::string> check = {"check",  "t",   "--physics", "--episodes", "1",
                                            "--root", kRoot, "--path",    mine};
    return {{"list", "--sheet", Form::stream, {"list", "objects", "--root", kRoot}, "", ""},
            {"check", "--pictures", Form::folder, check, path("mine/tasks/t.lua"), ""},
            {"export", "--out", Form::folder, {"export", "pddl", db()}, db(), "index.csv"},
            {"export", "--out", Form::folder, {"export", "bddl", db()}, db(), "index.csv"},
            {"questions", "--out", Form::stream, {"questions", db()}, db(), ""},
            {"baseline", "--out", Form::stream, {"baseline", "one_segment", given}, given + "/given.db", ""},
            {"score", "--out", Form::stream, {"score", "segments", answers(), "--hidden", hidden}, answers(), ""},
            {"score", "--figure", Form::stream, {"score", "segments", answers(), "--hidden", hidden}, answers(), ""},
            {"render", "--out", Form::folder, with({"render", db(), "1"}, small), db(), "episode_000001/cameras.csv"},
            {"render", "--video", Form::film, with({"render", db(), "1"}, small), db(), ""},
            {"render", "--sheet", Form::stream, {"render", db(), "1", "--size", "32x32"}, db(), ""},
            {"render", "--overlay", Form::folder, {"render", db(), "1"}, db(), "episode_000001/front/000000.png"}};
  }
  static std::vector<std::string> with(std::vector<std::string> words, const std::vector<std::string>& more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }

 private:
  Folder folder_;
};

const Made& made() {
  static const Made files;
  return files;
}

Said asked(const Output& output, const std::string& place, const std::vector<std::string>& more = {}) {
  return say(Made::with(Made::with(output.words, {output.option, place}), more));
}

// Reads all that is written to a pipe while it lives.
class Listener {
 public:
  explicit Listener(const std::string& pipe) : end_(open(pipe.c_str(), O_RDWR | O_NONBLOCK)) {
    thread_ = std::thread([this] {
      std::array<char, 4096> piece;
      pollfd wait{end_, POLLIN, 0};
      while (poll(&wait, 1, 20) > 0 || !done_)
        if (const ssize_t count = read(end_, piece.data(), piece.size()); count > 0)
          text_.append(piece.data(), static_cast<std::size_t>(count));
    });
  }
  std::string heard() {
    done_ = true;
    thread_.join();
    close(end_);
    return text_;
  }

 private:
  int end_;
  std::atomic<bool> done_ = false;
  std::string text_;
  std::thread thread_;
};

}  // namespace

TEST_CASE("every option that writes is tried here") {
  std::set<std::string> written, tried;
  for (const CommandRow& command : all_commands())
    for (const OptionRow& option : command.options)
      if (option.takes == Takes::output) written.insert(command.name + " " + option.name);
  for (const Output& output : made().outputs()) tried.insert(output.command + " " + output.option);
  CHECK(written == tried);
}

TEST_CASE("a file that is read, or that others made, is not replaced, our own is, and with --force the others' too") {
  for (const Output& output : made().outputs()) {
    if (output.form == Form::folder) continue;
    INFO(output.command << " " << output.option);
    const Folder folder;
    const std::string ending = output.form == Form::film ? ".mp4" : "", place = folder / ("out" + ending);
    put(folder, "out" + ending, "a letter");
    const Said refused = asked(output, place);
    INFO(refused.out << refused.err);
    CHECK(refused.code == kBadInput);
    CHECK(says(refused.err, "this file is there already"));
    CHECK(file_text(place) == "a letter");
    const std::string linked = folder / ("link" + ending);
    fs::create_symlink(place, linked);
    CHECK(says(asked(output, linked).err, "this is a link"));
    CHECK(file_text(place) == "a letter");
    CHECK(asked(output, place, {"--force"}).code == kDone);
    const std::string once = file_text(place);
    CHECK(once.size() > 8);
    CHECK(asked(output, place).code == kDone);
    CHECK(file_text(place) == once);
    if (output.input.empty()) continue;
    const std::string before = file_text(output.input), hard = folder / ("hard" + ending);
    fs::create_hard_link(output.input, hard);
    for (const std::string& same : {ending.empty() ? output.input : hard, hard}) {
      const Said said = asked(output, same, {"--force"});
      CHECK(said.code == kBadInput);
      CHECK((says(said.err, "is not written over") || says(said.err, "lies in a folder that is read")));
    }
    CHECK(file_text(output.input) == before);
  }
}

TEST_CASE("pipes and standard output get the same bytes as a file, or are refused, and stay what they are") {
  for (const Output& output : made().outputs()) {
    if (output.form == Form::folder) continue;
    INFO(output.command << " " << output.option);
    const Folder folder;
    const std::string pipe = folder / "pipe.mp4";
    REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
    if (output.form == Form::film) {
      CHECK(says(asked(output, pipe).err, "written back and forth"));
      CHECK(says(asked(output, "-").err, "say .mp4"));
      continue;
    }
    REQUIRE(asked(output, folder / "file").code == kDone);
    const std::string expected = file_text(folder / "file");
    Listener listener(pipe);
    const Said piped = asked(output, pipe);
    CHECK(piped.code == kDone);
    CHECK(listener.heard() == expected);
    CHECK(fs::is_fifo(pipe));
    const Said said = asked(output, "-");
    CHECK(said.code == kDone);
    CHECK(said.out == expected);  // and the story is told beside it
    CHECK_FALSE(said.err.empty());
    CHECK(says(asked(output, folder.text()).err, "this is a folder"));
    if (!fs::is_character_file("/dev/full")) continue;
    const Said full = asked(output, "/dev/full");
    CHECK(full.code == kBadInput);
    CHECK(says(full.err, "could not be written"));
    CHECK(fs::is_character_file("/dev/full"));
  }
}

TEST_CASE("a folder's files are replaced where it is one of ours, and files of others stay without --force") {
  for (const Output& output : made().outputs()) {
    if (output.form != Form::folder) continue;
    INFO(output.command << " " << output.option << " " << output.words[1]);
    const Folder folder;
    const std::string place = folder / "out", before = output.input.empty() ? "" : file_text(output.input);
    const Said first = asked(output, place);
    INFO(first.out << first.err);
    std::string inside = output.inside;
    for (const auto& entry : fs::directory_iterator(place))
      if (inside.empty()) inside = entry.path().filename().string();  // what `check` draws
    REQUIRE_FALSE(inside.empty());
    const std::string once = file_text(place + "/" + inside);
    CHECK(once.size() > 8);
    CHECK(asked(output, place).code == first.code);
    CHECK(file_text(place + "/" + inside) == once);
    put(folder, "out/" + inside, "a letter");
    const Said refused = asked(output, place);
    CHECK(refused.code == kBadInput);
    CHECK(file_text(place + "/" + inside) == "a letter");
    CHECK(asked(output, place, {"--force"}).code == first.code);
    CHECK(file_text(place + "/" + inside) == once);
    put(folder, "plain", "a letter");
    CHECK(asked(output, folder / "plain", {"--force"}).code == kBadInput);
    CHECK(file_text(folder / "plain") == "a letter");
    CHECK(asked(output, "-").code == kUsage);
    if (!output.input.empty()) CHECK(file_text(output.input) == before);
  }
  CHECK_FALSE(fs::exists("-"));
}

TEST_CASE("two outputs of one command are not one file") {
  const Folder folder;
  const Said said = say({"score", "segments", made().answers(), "--hidden", made().path("hidden"), "--out",
                         folder / "a", "--figure", folder / "./a"});
  CHECK(said.code == kUsage);
  CHECK(says(said.err, "are one file"));
}

TEST_CASE("a catalogue is added to, and is neither a device nor standard output") {
  const Folder folder;
  REQUIRE(mkfifo((folder / "pipe").c_str(), 0600) == 0);
  put(folder, "letter", "a letter to somebody, which is no database");
  for (const std::string& place : {folder / "pipe", folder / "letter", folder.text(), std::string("/dev/full")}) {
    if (place == "/dev/full" && !fs::is_character_file(place)) continue;
    INFO(place);
    CHECK(say({"run", "reach_target", "--root", kRoot, "--out", place}).code == kCatalogue);
  }
  CHECK(file_text(folder / "letter") == "a letter to somebody, which is no database");
  CHECK(fs::is_fifo(folder / "pipe"));
}

}  // namespace stampede::program
