// Skills, objects and words of an author's own are understood without a line of C++.
#include <catch2/catch.hpp>

#include "engine/base/temporary_folder.h"
#include "engine/base/text_file.h"
#include "shipped.h"

using namespace stampede;

namespace {

const std::string kAuthors = STAMPEDE_SOURCE_DIR "/tests/tasks/authors";

SentenceChecker checker_of(const std::shared_ptr<const Library>& library, const std::string& task) {
  const std::vector<OwnSentences> all = sentences_of(library, task);
  return SentenceChecker(meaning_of(library, task, all.front().variation, 0, all));
}

void passes(const SentenceChecker& checker, const std::string& text) {
  const Verdict verdict = checker.check(text);
  INFO(text << ": " << (verdict.ok() ? "" : to_string(*verdict.reason)) << " " << verdict.detail);
  CHECK(verdict.ok());
}

void fails(const SentenceChecker& checker, const std::string& text) {
  INFO(text);
  CHECK_FALSE(checker.check(text).ok());
}

std::string text_of(const std::shared_ptr<const Library>& library, DefinitionKind kind, const char* name) {
  return library->file(kind, name)->source;
}

std::vector<std::string> complaints_about(const std::string& path, const std::string& text) {
  const TemporaryFolder folder;
  std::filesystem::create_directories((folder.path() / path).parent_path());
  write_text_file(folder.path() / path, text);
  std::vector<Error> errors;
  Library::check({{STAMPEDE_SOURCE_DIR, folder.path()}}, errors, {"push_button"});
  std::vector<std::string> told;
  for (const Error& error : errors) told.push_back(error.where() + ": " + error.message() + " | " + error.hint());
  return told;
}

}  // namespace

TEST_CASE("a skill without verbs is told by its label, and its tool by its effects") {
  const auto library = Library::load({{STAMPEDE_SOURCE_DIR, kAuthors}});
  const SentenceChecker wipe = checker_of(library, "wipe_stain");
  passes(wipe, "wipe the stain with the sponge");
  passes(wipe, "take the sponge and wipe the stain away");
  passes(wipe, "please wipe off the stain");
  fails(wipe, "wipe the sponge with the stain");
  fails(wipe, "press the stain with the sponge");
  fails(wipe, "wipe the table with the sponge");
  fails(wipe, "take the sponge");
  fails(wipe, "do not wipe the stain");
  const SentenceChecker beside = checker_of(library, "tin_beside_cube");
  passes(beside, "set the tin down beside the red cube");
  fails(beside, "put the cube beside the tin");
  fails(beside, "put the tin into the cube");
}

TEST_CASE("a verb that two skills claim is read as the one that the plan has") {
  const TemporaryFolder folder;
  const auto shipped = Library::load({{STAMPEDE_SOURCE_DIR, kAuthors}});
  std::string rub = text_of(shipped, DefinitionKind::skill, "rub");
  rub.replace(rub.find("  label ="), 0, "  verbs = { \"rub\", \"wipe\", \"buff up\" },\n");
  std::filesystem::create_directories(folder.path() / "skills");
  write_text_file(folder.path() / "skills/rub.lua", rub);
  const auto library = Library::load({{STAMPEDE_SOURCE_DIR, kAuthors, folder.path()}});
  const SentenceChecker patch = checker_of(library, "rub_the_patch");
  passes(patch, "wipe the patch");
  passes(patch, "buff the patch up");
  fails(patch, "wipe the table");
  fails(checker_of(shipped, "rub_the_patch"), "wipe the patch");
  const SentenceChecker stain = checker_of(library, "wipe_stain");
  passes(stain, "wipe the stain away");
  fails(stain, "wipe the sponge");
}

TEST_CASE("a thing answers to its nouns") {
  const TemporaryFolder folder;
  const auto shipped = Library::load({{STAMPEDE_SOURCE_DIR, kAuthors}});
  std::string sponge = text_of(shipped, DefinitionKind::object, "sponge");
  sponge.replace(sponge.find("object {") + 8, 0, "\n  nouns = \"scourer\",");
  std::filesystem::create_directories(folder.path() / "worlds/objects");
  write_text_file(folder.path() / "worlds/objects/sponge.lua", sponge);
  const auto library = Library::load({{STAMPEDE_SOURCE_DIR, kAuthors, folder.path()}});
  passes(checker_of(library, "wipe_stain"), "wipe the stain with the scourer");
  fails(checker_of(shipped, "wipe_stain"), "wipe the stain with the scourer");
}

TEST_CASE("words that cannot be read are complaints with a place and a cure") {
  const auto one = [](const std::string& text) {
    const std::vector<std::string> told =
        complaints_about("worlds/words.lua", "-- Words.\nreturn {\n" + text + "\n}\n");
    return told.size() == 1 ? told.front() : std::to_string(told.size()) + " complaints";
  };
  CHECK(one("  kinds = { nuon = \"gadget\" },")
            .find("/worlds/words.lua:3: kinds.nuon: there is no kind of words 'nuon' | did "
                  "you mean 'noun'?") != std::string::npos);
  CHECK(one("  classes = { keepin = \"hoard\" },").find("did you mean 'keeping'?") != std::string::npos);
  CHECK(one("  phrase = { [\"a b\"] = \"c\" },").find("did you mean 'phrases'?") != std::string::npos);
  CHECK(one("  endings = { \"ing\" },").find("an ending is") != std::string::npos);
  CHECK(one("  kinds = { noun = \"gadget\" },") == "0 complaints");
}
