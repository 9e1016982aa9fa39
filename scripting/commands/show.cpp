#include <fmt/format.h>

#include <charconv>
#include <ostream>
#include <set>

#include "db/catalogue.h"
#include "db/stored_episode.h"
#include "engine/symbolic/pddl.h"
#include "scripting/commands/commands.h"
#include "scripting/program/json_text.h"
#include "scripting/program/timeline.h"
#include "scripting/runtime/bddl_mapping_reader.h"
#include "scripting/session/stored_symbols.h"

namespace stampede::program {

std::int64_t episode_number(const std::string& text) {
  std::int64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) {
    throw UsageError("an episode is a number, not '" + text + "'",
                     "stampede query FILE \"SELECT episode FROM episodes\"");
  }
  return number;
}

namespace {

// `, 208 pictures of 2 cameras, 494 kB`; nothing when there are none.
std::string pictures_text(const std::vector<ImageEntry>& images) {
  if (images.empty()) return {};
  std::set<std::string> cameras;
  std::int64_t bytes = 0;
  for (const ImageEntry& image : images) {
    cameras.insert(image.camera);
    bytes += image.bytes;
  }
  return fmt::format(", {} pictures of {} camera{}, {:.0f} kB", images.size(), cameras.size(),
                     cameras.size() == 1 ? "" : "s", static_cast<double>(bytes) / 1000);
}

void put(const Facts& facts, JsonText& json) {
  json.array();
  for (const Fact& fact : facts) json.value(to_text(fact));
  json.end();
}

void put(const std::map<std::string, double>& numbers, JsonText& json) {
  json.object();
  for (const auto& [name, value] : numbers) json.field(name, value);
  json.end();
}

std::string facts_text(const AbstractState& state) {
  Facts all = state.facts;
  all.insert(state.observed.begin(), state.observed.end());
  std::string text;
  for (const Fact& fact : all) {
    const bool holds = state.facts.contains(fact), known = state.observed.contains(fact);
    text += to_text(fact) + (holds && known ? "" : holds ? "  ; not known" : "  ; believed, not so") + "\n";
  }
  return text;
}

void collect_predicates(const Formula& formula, std::set<std::string>& names) {
  if (formula.kind == Formula::Kind::atom) names.insert(formula.predicate);
  for (const Formula& part : formula.parts) collect_predicates(part, names);
}

// In one dialect. What its goal cannot say (that the hand is empty, for one) is left out with a remark, unless the
// caller chose what to leave out: a moment is shown to be looked at.
std::string bddl_moment(const EpisodeMoment& moment, const BddlMapping& mapping,
                        const std::vector<std::string>& leave_out, std::string& refusals) {
  std::string complaint;
  const auto text_without = [&](const std::vector<std::string>& predicates) {
    complaint.clear();
    return bddl_text(moment, {mapping}, predicates, complaint);
  };
  std::string text = text_without(leave_out);
  const std::string first_complaint = complaint;
  if (text.empty() && leave_out.empty()) {
    std::set<std::string> names;
    collect_predicates(moment.symbols.problem.goal, names);
    std::vector<std::string> unsayable;
    for (const std::string& one : names) {
      std::vector<std::string> others;
      for (const std::string& name : names)
        if (name != one) others.push_back(name);
      if (text_without(others).empty()) unsayable.push_back(one);
    }
    if (unsayable.size() < names.size()) text = text_without(unsayable);
  }
  if (text.empty()) refusals += first_complaint;
  return text;
}

// One moment in the form that was asked for. `refusals`: what a dialect cannot say.
std::string moment_text(const Arguments& arguments, const StoredEpisode& stored, const AbstractState& state,
                        std::string& refusals) {
  const std::string form = arguments.text("--as");
  const StoredSymbols symbols = read_symbols(stored.episode);
  if (form == "facts") return facts_text(state);
  if (form == "sentences") return describe(state, symbols.domain, *stored.scene);
  if (form == "pddl")
    return unknown_facts(state, symbols.domain) +
           to_pddl(problem_at(symbols, state), symbols.domain, stored.episode.beside_goal);
  std::string text;
  for (const BddlMapping& mapping : bddl_mappings_of(*words_of(arguments), form))
    text += (text.empty() ? "" : "\n") + bddl_moment({stored.episode, *stored.scene, symbols, state}, mapping,
                                                     arguments.list("--leave-out"), refusals);
  return text;
}

ExitCode show_moment(const Arguments& arguments, const StoredEpisode& stored, Console& console) {
  const std::int64_t frame = *arguments.integer("--frame");
  const AbstractState state = abstract_state(stored.episode, frame);
  if (stored.scene == nullptr) throw Error("episode " + std::to_string(stored.id), stored.why_not);
  const std::string form = arguments.text("--as");
  std::string refusals;
  const std::string text = moment_text(arguments, stored, state, refusals);
  if (arguments.flag("--json")) {
    JsonText json;
    json.object().field("episode", stored.id).field("frame", frame);
    json.field("time_s", static_cast<double>(frame) / stored.episode.frame_hz).key("facts");
    put(state.facts, json);
    json.key("observed");
    put(state.observed, json);
    json.key("joints");
    put(state.joints, json);
    json.key("joint_fractions");
    put(state.joint_fractions, json);
    json.key("openings");
    put(state.openings, json);
    json.key("poses").object();
    for (const auto& [name, pose] : state.poses) {
      json.key(name).array();
      for (const double value : pose.position) json.value(value);
      for (const double value : pose.quaternion) json.value(value);
      json.end();
    }
    json.end().field("as", form).field("text", text).field("refusal", refusals);
    console.out << json.end().text();
  } else {
    console.out << text;
  }
  console.err << refusals;
  return text.empty() && !refusals.empty() ? kNo : kDone;
}

ExitCode do_show(const Arguments& arguments, Console& console) {
  const std::int64_t number = episode_number(arguments.text("EPISODE"));
  const Catalogue catalogue = Catalogue::open(arguments.text("FILE"));
  if (arguments.has("--frame")) return show_moment(arguments, read_stored(catalogue, number), console);
  if (arguments.has("--as")) throw UsageError("--as is of one moment", "add --frame N");
  const EpisodeRecord episode = catalogue.read_episode(number);
  if (arguments.flag("--json")) {
    console.out << timeline_json(episode);
    return kDone;
  }
  TimelineStyle style;
  style.width = console.width;
  style.constant_facts = arguments.flag("--all");
  style.title =
      fmt::format("episode {} of {}{}", number, arguments.text("FILE"), pictures_text(catalogue.images(number)));
  console.out << timeline(episode, style);
  return kDone;
}

}  // namespace

CommandRow show_command() {
  return {"show",
          "Show one episode as a timeline, or the world at one of its frames in symbols",
          "Skills and their motions as bars, with what each changed, the tries that were undone and why, the points "
          "passed without stopping, and the facts that came and went. With --frame: what holds at that moment, as "
          "sentences with joints and poses, as facts, as a PDDL problem, or as a BDDL problem of either dialect; what "
          "holds without being known (it is hidden, or has changed out of sight) is marked.",
          {{"FILE", "the catalogue", true, false}, {"EPISODE", "the episode's number", true, false}},
          {{"--all", "", "also the facts that held throughout", Takes::flag, "", {}, false},
           {"--frame", "N", "the world at this frame", Takes::integer, "", {}, false},
           {"--as",
            "FORM",
            "how to say it; bddl is both dialects",
            Takes::text,
            "sentences",
            {"sentences", "facts", "pddl", "bddl", "libero", "behavior"},
            false},
           {"--leave-out",
            "PREDICATE",
            "not in the goal of a BDDL problem; default: what the dialect cannot say",
            Takes::text,
            "",
            {},
            true}},
          {"stampede show demos.db 1", "stampede show demos.db 1 --frame 40 --as pddl"},
          do_show};
}

}  // namespace stampede::program
