// Sentences of a model in an episode's language, and questions about its frames.
#include <algorithm>
#include <catch2/catch.hpp>
#include <set>
#include <sstream>

#include "engine/start/language.h"
#include "scripting/sentences/frame_questions.h"
#include "scripting/session/episode_job.h"
#include "scripting/session/made_sentences.h"
#include "shipped.h"

using namespace stampede;

namespace {

const EpisodeJob kJob{"push_button", "colour=maroon", 0};

RunOptions with_sentences(const std::vector<MadeSentence>& sentences) {
  RunOptions options;
  options.sentences = sentences_for(sentences, kJob.variation);
  return options;
}

const std::vector<MadeSentence> kMade = {
    {LanguageLevel::task, "colour=maroon", "tap the maroon button", LanguageGrain::goal, "small"},
    {LanguageLevel::task, "colour=white", "tap the white button", LanguageGrain::goal, "small"},
    {LanguageLevel::skill, "press", "tap the {button}", LanguageGrain::goal, "small"}};

const EpisodeRecord& episode() {
  static const EpisodeRecord record = [] {
    PreparedEpisode prepared(shipped::library(), kJob, with_sentences(kMade));
    return prepared.run(nullptr);
  }();
  return record;
}

}  // namespace

TEST_CASE("an episode has the sentences of its variation and of its skills, as a model's") {
  std::vector<std::string> texts;
  for (const LanguageRecord& one : episode().labels.language) {
    if (one.source != LanguageSource::model) continue;
    CHECK(one.model == "small");
    texts.push_back(one.text);
    if (one.level == LanguageLevel::skill) CHECK(one.segment >= 0);
  }
  REQUIRE(texts.size() == 2);
  CHECK(texts[0] == "tap the maroon button");
  CHECK(texts[1].starts_with("tap the cap of the "));
}

TEST_CASE("sentences are part of the key, and only those of the variation") {
  const auto key = [](const RunOptions& options) { return PreparedEpisode(shipped::library(), kJob, options).key(); };
  CHECK(key(with_sentences(kMade)) == episode().made.key);
  CHECK(key(with_sentences(kMade)) != key({}));
  std::vector<MadeSentence> others = kMade;
  others[1].text = "press the white button";
  CHECK(key(with_sentences(others)) == key(with_sentences(kMade)));
  others[0].text = "press what is maroon";
  CHECK(key(with_sentences(others)) != key(with_sentences(kMade)));
}

TEST_CASE("what a skill is said to have changed came true or ended while it ran") {
  const Scene scene = scene_from_document(episode().scene.document);
  const Domain& domain = shipped::library()->domain_of(kJob.task);
  int asked = 0;
  for (std::int64_t frame = 0; frame < static_cast<std::int64_t>(episode().frames.size()); frame += 10)
    for (const FrameQuestion& one : questions_about(episode(), domain, scene, frame)) {
      if (one.type != "changed") continue;
      ++asked;
      const SegmentRecord& segment =
          episode().labels.segments.at(std::stoul(one.proof.substr(one.proof.find(' ') + 1)));
      CHECK(segment.span.end_frame <= frame);
      std::set<std::string> changes;
      for (const FactRecord& fact : episode().labels.facts)
        for (const bool ends : {false, true}) {
          const std::int64_t at = ends ? fact.end_frame : fact.first_frame;
          if (at <= segment.span.first_frame || at > segment.span.end_frame) continue;
          const Predicate& predicate = *domain.predicate(fact.fact.predicate);
          changes.insert((ends ? "no longer: " : "") +
                         fill(predicate.label, predicate.parameters, fact.fact.arguments, scene));
        }
      std::istringstream parts(one.answer);
      for (std::string part; std::getline(parts, part, ';');) {
        INFO(part << " of " << one.answer);
        CHECK(changes.contains(part.substr(part.find_first_not_of(' '))));
      }
    }
  CHECK(asked > 0);
}

TEST_CASE("things are counted in English") {
  const EpisodeJob job{"reach_and_drag", shipped::library()->task("reach_and_drag")->variation_texts.front(), 3};
  PreparedEpisode prepared(shipped::library(), job, {});
  const EpisodeRecord record = prepared.run(nullptr);
  const Scene scene = scene_from_document(record.scene.document);
  int patches = 0;
  for (const FrameQuestion& one : questions_about(record, shipped::library()->domain_of(job.task), scene, 0)) {
    if (one.type == "count" && one.slots.at("a").find("patch") != std::string::npos) {
      ++patches;
      CHECK(one.slots.at("a").ends_with(" patches"));
    }
  }
  CHECK(patches > 0);
}

TEST_CASE("what is said to be left of another is so in the picture") {
  const EpisodeJob job{"stack_blocks", shipped::library()->task("stack_blocks")->variation_texts.front(), 3};
  PreparedEpisode prepared(shipped::library(), job, {});
  const EpisodeRecord record = prepared.run(nullptr);
  const Scene scene = scene_from_document(record.scene.document);
  const std::int64_t frame = 5;
  int yes = 0, no = 0;
  for (const FrameQuestion& one : questions_about(record, shipped::library()->domain_of(job.task), scene, frame)) {
    if (one.type != "side") continue;
    const auto camera = std::find_if(scene.cameras.begin(), scene.cameras.end(),
                                     [&](const Camera& each) { return each.name == one.camera; });
    REQUIRE(camera != scene.cameras.end());
    const auto column = [&](const std::string& slot) {
      for (std::size_t i = 0; i < record.scene.posed.size(); ++i)
        if (scene.object(record.scene.posed[i]) != nullptr &&
            phrase(scene, record.scene.posed[i]) == one.slots.at(slot)) {
          const Pose& pose = record.frames[frame].object_pose[i];
          const Vector3 seen = camera->mount_from_camera.inverse() * to_transform(pose).translation();
          return camera->centre_x + camera->focal_x * seen.x() / seen.z();
        }
      FAIL("nothing is called " << one.slots.at(slot));
      return 0.0;
    };
    CHECK((column("a") < column("b")) == (one.answer == "yes"));
    (one.answer == "yes" ? yes : no) += 1;
  }
  CHECK(yes > 0);
  CHECK(no > 0);
}

TEST_CASE("what does not stand apart at a frame is not asked about, and names are those of the frame") {
  std::string four;
  for (const std::string& variation : shipped::library()->task("stack_blocks")->variation_texts)
    if (variation.ends_with("height=4")) four = variation;
  REQUIRE_FALSE(four.empty());
  PreparedEpisode prepared(shipped::library(), {"stack_blocks", four, 3}, {});
  const EpisodeRecord record = prepared.run(nullptr);
  REQUIRE(record.outcome == Outcome::success);
  const Scene scene = scene_from_document(record.scene.document);
  const Domain& domain = shipped::library()->domain_of("stack_blocks");
  const auto last = static_cast<std::int64_t>(record.frames.size()) - 1;
  std::set<std::string> built;  // in one tower at the end
  for (const FactRecord& fact : record.labels.facts)
    if (fact.fact.predicate == "on" && fact.open_end && fact.fact.arguments[1] != "table")
      built.insert(fact.fact.arguments.begin(), fact.fact.arguments.end());
  CHECK(built.size() == 4);
  bool before = false;
  for (const FrameQuestion& one : questions_about(record, domain, scene, 0))
    before |= std::any_of(built.begin(), built.end(), [&](const auto& name) { return one.things.contains(name); });
  CHECK(before);
  for (const FrameQuestion& one : questions_about(record, domain, scene, last)) {
    if (one.type == "count") continue;
    INFO(one.text(one.pattern));
    CHECK(std::none_of(built.begin(), built.end(), [&](const auto& name) { return one.things.contains(name); }));
  }
}

TEST_CASE("answers about frames are true, and yes as often as no") {
  const Scene scene = scene_from_document(episode().scene.document);
  const Domain& domain = shipped::library()->domain_of(kJob.task);
  int yes = 0, no = 0;
  std::set<std::string> types;
  for (std::int64_t frame = 0; frame < static_cast<std::int64_t>(episode().frames.size()); frame += 20) {
    std::set<std::string> holds;
    for (const FactRecord& fact : episode().labels.facts)
      if (fact.first_frame <= frame && frame < fact.end_frame) holds.insert(to_text(fact.fact));
    for (const FrameQuestion& one : questions_about(episode(), domain, scene, frame)) {
      types.insert(one.type);
      CHECK(one.text(one.pattern).find('{') == std::string::npos);
      if (one.type != "holds") continue;
      (one.answer == "yes" ? yes : no) += 1;
      const std::string fact = one.answer == "yes" ? one.proof : one.proof.substr(4);
      CHECK(holds.contains(fact) == (one.answer == "yes"));
    }
    const auto chosen = [&] {
      return chosen_questions(questions_about(episode(), domain, scene, frame), episode(), frame, 4);
    };
    CHECK(chosen().size() <= 4);
    const auto first = chosen(), second = chosen();
    CHECK(std::equal(first.begin(), first.end(), second.begin(), second.end(),
                     [](const auto& a, const auto& b) { return a.text(a.pattern) == b.text(b.pattern); }));
  }
  CHECK(yes == no);
  CHECK(yes > 0);
  for (const char* type : {"holds", "colour", "count", "next_skill"}) CHECK(types.contains(type));
}
