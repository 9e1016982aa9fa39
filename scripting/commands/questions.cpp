#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <ostream>
#include <set>

#include "db/catalogue.h"
#include "scripting/commands/commands.h"
#include "scripting/commands/language_options.h"
#include "scripting/sentences/frame_questions.h"
#include "scripting/sentences/meaning_of.h"
#include "scripting/sentences/paraphrase.h"

namespace stampede::program {
namespace {

using Line = nlohmann::ordered_json;

// Which camera shows all of these things best: the one in which the least of them is largest. Empty: none shows all.
using Pixels = std::map<std::string, std::map<std::string, std::int64_t>>;  // camera, thing
std::string best_camera(const Pixels& pixels, const std::set<std::string>& things) {
  std::string best;
  std::int64_t most = 0;
  for (const auto& [camera, seen] : pixels) {
    std::int64_t least = things.empty() ? 0 : std::numeric_limits<std::int64_t>::max();
    for (const std::string& thing : things) {
      const auto found = seen.find(thing.substr(0, thing.find('.')));
      least = std::min(least, found == seen.end() ? 0 : found->second);
    }
    if (least > most) most = least, best = camera;
  }
  return best;
}

class Questioner {
 public:
  Questioner(const Arguments& arguments, Console& console)
      : arguments_(arguments),
        console_(console),
        library_(words_of(arguments)),
        catalogue_(Catalogue::open(arguments.text("FILE"))),
        per_frame_(static_cast<int>(in_range(arguments, "--per-frame", 1, 1000))),
        frames_(in_range(arguments, "--frames", 1, 1'000'000)) {
    if (arguments.flag("--rephrase")) client_.emplace(chat_settings(arguments));
  }

  ExitCode run() {
    std::vector<std::int64_t> ids;
    for (const std::string& text : arguments_.list("EPISODE")) ids.push_back(episode_number(text));
    if (ids.empty())
      for (const EpisodeSummary& episode : catalogue_.episodes()) ids.push_back(episode.id);
    const std::string out = arguments_.text("--out");
    OutputFile file(out, marked_kind("a file of questions", "{\"episode\":", "\"answer_type\":"),
                    output_rules(arguments_, console_));
    for (const std::int64_t id : ids) {
      if (console_.stopped()) break;
      ask_episode(id, file);
    }
    if (console_.stopped()) {
      console_.err << "interrupted: nothing is written\n";
      return kInterrupted;
    }
    file.finish();
    report(out);
    return count_ > 0 ? kDone : kNo;
  }

 private:
  void ask_episode(std::int64_t id, OutputFile& file) {
    const EpisodeRecord episode = catalogue_.read_episode(id);
    if (episode.scene.document.empty()) return;
    const Scene scene = scene_from_document(episode.scene.document);
    const auto pictures = catalogue_.images(id);
    const std::map<std::int64_t, Pixels> seen = pixels_of(id);
    for (const std::int64_t frame : frames_of(episode, pictures)) {
      const auto shown = seen.find(frame);
      for (const FrameQuestion& one : chosen_questions(
               questions_about(episode, library_->domain_of(episode.task), scene, frame), episode, frame, per_frame_)) {
        std::string camera =
            one.camera.empty() && shown != seen.end() ? best_camera(shown->second, one.things) : one.camera;
        Line line;
        line["episode"] = id;
        line["frame"] = frame;
        line["camera"] = camera.empty() ? Line() : Line(camera);
        line["type"] = one.type;
        line["question"] = one.text(worded(one.pattern));
        line["answer"] = one.answer;
        line["answer_type"] = one.answer_type;
        line["fact"] = one.proof;
        file.write(line.dump() + "\n");
        ++count_;
        ++by_type_[one.type + (one.answer_type == "yes_no" ? " " + one.answer : "")];
      }
    }
  }

  // Evenly spaced ones of those that have pictures; of all frames where there are none.
  std::vector<std::int64_t> frames_of(const EpisodeRecord& episode, const std::vector<ImageEntry>& pictures) const {
    std::set<std::int64_t> all;
    for (const ImageEntry& picture : pictures)
      if (picture.kind == "rgb") all.insert(picture.frame);
    if (all.empty())
      for (std::size_t i = 0; i < episode.frames.size(); ++i) all.insert(static_cast<std::int64_t>(i));
    const std::vector<std::int64_t> list(all.begin(), all.end());
    const auto size = static_cast<std::int64_t>(list.size()), wanted = std::min(frames_, size);
    std::vector<std::int64_t> frames;
    for (std::int64_t i = 0; i < wanted; ++i)
      frames.push_back(list[static_cast<std::size_t>(wanted == 1 ? 0 : i * (size - 1) / (wanted - 1))]);
    return frames;
  }

  // Of episodes with instance masks.
  std::map<std::int64_t, Pixels> pixels_of(std::int64_t id) const {
    std::map<std::int64_t, Pixels> pixels;
    const QueryResult rows = catalogue_.query(
        "SELECT frame, camera, object, sum(pixels) AS pixels FROM visible WHERE episode = " + std::to_string(id) +
        " GROUP BY frame, camera, object");
    for (std::size_t i = 0; i < rows.size(); ++i)
      if (!rows.is_null(i, "object"))
        pixels[rows.integer(i, "frame")][rows.text(i, "camera")][rows.text(i, "object")] = rows.integer(i, "pixels");
    return pixels;
  }

  // As the model says it, where its words pass; each pattern is asked once.
  std::string worded(const std::string& pattern) {
    if (!client_) return pattern;
    const auto [found, is_new] = worded_.try_emplace(pattern, pattern);
    if (!is_new) return found->second;
    const SentenceChecker checker(meaning_of_label(*library_, "question", pattern, ""));
    SentenceFile kept;
    const ParaphraseJob job{LanguageLevel::world, pattern, Grain::goal, 4, 2, 0};
    tally_.add(paraphrase(job, checker, {"is the {a} there?", "what is the {a} made of?"}, *client_, kept,
                          console_.stop, nullptr));
    if (!kept.sentences.empty()) found->second = kept.sentences.front().text + "?";
    return found->second;
  }

  void report(const std::string& out) {
    if (arguments_.flag("--json")) {
      JsonText json;
      json.object().field("out", out).field("questions", count_).key("types").object();
      for (const auto& [type, count] : by_type_) json.field(type, count);
      json.end();
      if (client_) write_cost(client_->cost(), client_->settings(), json);
      console_.out << json.end().text();
      return;
    }
    console_.out << fmt::format("{}: {} questions\n", out, count_);
    for (const auto& [type, count] : by_type_) console_.out << fmt::format("{:>6} {}\n", count, type);
    if (client_)
      console_.out << fmt::format("{} of {} wordings passed; ", tally_.passed, tally_.received)
                   << cost_line(client_->cost(), client_->settings());
  }

  const Arguments& arguments_;
  Console& console_;
  std::shared_ptr<const Library> library_;
  Catalogue catalogue_;
  int per_frame_;
  std::int64_t frames_;
  std::optional<ChatClient> client_;
  ParaphraseTally tally_;
  std::map<std::string, std::string> worded_;
  std::int64_t count_ = 0;
  std::map<std::string, std::int64_t> by_type_;
};

ExitCode do_questions(const Arguments& arguments, Console& console) { return Questioner(arguments, console).run(); }

}  // namespace

CommandRow questions_command() {
  CommandRow row{
      "questions",
      "Write questions and answers about frames, for vision-language training",
      "What holds and what does not (as often yes as no), what is where, colours, counts, which skill comes next, what "
      "a "
      "skill changed, what is left of what: truth from the catalogue, the same for the same file. A line of JSON each: "
      "episode, frame, camera (which shows all that it speaks of, where there are instance masks), type, question, "
      "answer, answer_type, and the fact that proves it. With --rephrase a language model words the questions anew, "
      "and "
      "what passes the checks of `paraphrase` is taken. The exit code is 1 where nothing can be asked.",
      {{"FILE", "the catalogue", true, false}, {"EPISODE", "numbers of episodes; default: all", false, true}},
      {{"--out", "FILE", "where to", Takes::output, "questions.jsonl", {}, false},
       {"--per-frame", "N", "questions a frame, at most", Takes::integer, "8", {}, false},
       {"--frames", "N", "frames an episode, evenly spaced over those with pictures", Takes::integer, "5", {}, false},
       {"--rephrase", "", "a language model words them anew", Takes::flag, "", {}, false}},
      {"stampede questions demos.db --out questions.jsonl", "stampede questions demos.db 1 --frames 20 --per-frame 12"},
      do_questions};
  for (OptionRow& option : model_options()) row.options.push_back(std::move(option));
  return row;
}

}  // namespace stampede::program
