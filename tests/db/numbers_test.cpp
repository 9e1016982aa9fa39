// Catalogues that pass SQLite's own check but lie: an error with the place, at once and in little memory.
#include <sys/stat.h>

#include <catch2/catch.hpp>

#include "sample_episode.h"

using namespace stampede;
using namespace stampede::test;
using Catch::Matchers::Contains;

namespace {

std::filesystem::path changed_copy(const Folder& folder, const std::filesystem::path& good, const std::string& sql) {
  const auto path = folder / "lie.db";
  std::filesystem::copy(good, path, std::filesystem::copy_options::overwrite_existing);
  change(path, sql);
  return path;
}

}  // namespace

TEST_CASE("a reason that this release does not know is an error with its word, not no reason") {
  const Folder folder;
  const auto good = folder / "good.db";
  EpisodeRecord failed = sample_episode("lift", "colour=red", 1);
  failed.outcome = Outcome::failure;
  failed.reason = Reason::no_plan;
  Catalogue::write(good).add(failed, kEngine);
  const auto said = Contains("reason 'lost_balance' is not one that this release knows\n    read it with the release");
  {
    const Catalogue whole = Catalogue::open(changed_copy(folder, good, "UPDATE episode SET reason = 'lost_balance'"));
    CHECK_THROWS_WITH(whole.episodes(), said);
    CHECK_THROWS_WITH(whole.read_episode(1), said);
  }
  const std::string of_a_try = "UPDATE segment SET reason = 'lost_balance' WHERE undone = 1";
  CHECK_THROWS_WITH(Catalogue::open(changed_copy(folder, good, of_a_try)).read_episode(1), said);
}

TEST_CASE("a number that cannot be is told with its place, whichever it is") {
  const Folder folder;
  const auto good = folder / "good.db";
  Catalogue::write(good).add(sample_episode("lift", "colour=red", 1), kEngine);
  REQUIRE_NOTHROW(Catalogue::open(good).read_episode(1));
  const std::vector<std::pair<std::string, std::string>> lies{
      {"UPDATE episode SET physics_hz = 0", "physics_hz is 0, and can be 1 to 1000000"},
      {"UPDATE episode SET physics_hz = 9000000000", "physics_hz"},
      {"UPDATE episode SET frame_hz = 0", "frame_hz"},
      {"UPDATE episode SET frame_hz = 100000", "frame_hz"},
      {"UPDATE episode SET frames = 5000000000", "frames is 5000000000, and can be 12 to 12"},
      {"UPDATE episode SET frames = -1", "frames"},
      {"UPDATE episode SET steps = -5", "steps"},
      {"UPDATE frame SET frame = 400 WHERE frame = 11", "a row of frame"},
      {"UPDATE frame SET step = -12 WHERE frame = 3", "a frame's step"},
      {"UPDATE frame SET step = 1000000000000 WHERE frame = 11", "a frame's step"},
      {"UPDATE segment SET end_step = 4000000000000000 WHERE undone = 0", "a segment's span"},
      {"UPDATE segment SET first_frame = -3 WHERE undone = 0", "a segment's span"},
      {"UPDATE segment SET end_step = 4000000000000000 WHERE undone = 1", "an undone try's span"},
      {"UPDATE segment SET parent = 2 WHERE undone = 0 AND ordinal = 1", "a segment's parent"},
      {"UPDATE segment SET ordinal = 99 WHERE undone = 0 AND ordinal = 2", "a segment's ordinal"},
      {"UPDATE segment SET before_segment = 77 WHERE undone = 1", "an undone try's place"},
      {"UPDATE fact SET end_step = 9000000000", "a fact"},
      {"UPDATE observed_fact SET end_frame = 9000000000", "an observed fact"},
      {"UPDATE via SET segment = 50", "a via-point's segment"},
      {"UPDATE via SET step = -1", "a via-point's step"},
      {"UPDATE contact SET end_frame = 999", "a contact"},
      {"UPDATE grasp SET segment = -2", "a grasp's segment"},
      {"UPDATE language SET segment = 12 WHERE level = 'skill'", "a sentence's segment"},
      {"UPDATE keyframe SET frame = 12 WHERE frame = 11", "a keyframe"},
      {"UPDATE command SET step = 123456789", "a command's step"},
      {"UPDATE sample SET step = -1", "a sample's step"},
      {"UPDATE agent_action SET end_frame = 900 WHERE ordinal = 4", "an agent's action"},
      {"UPDATE agent_action SET frame = -1 WHERE ordinal = 0", "an agent's action"},
      {"UPDATE agent_action SET segment = 3 WHERE segment = 0", "an agent's action's segment"},
      {"UPDATE agent_action SET numbers = '[1,' WHERE ordinal = 0", "a row of agent_action"},
      {"UPDATE agent_action SET numbers = '[1,]' WHERE ordinal = 0", "a row of agent_action"},
      {"UPDATE agent_action SET numbers = '[nan]' WHERE ordinal = 0", "a row of agent_action"},
      {"UPDATE agent_action SET parameters = '{\"height\":0.2}' WHERE ordinal = 1", "a row of agent_action"},
      {"UPDATE camera SET width = 0", "a camera's width"},
      {"UPDATE camera SET width = 4294967298", "a value of width can be none: '4294967298'"},
      {"UPDATE camera SET mount_part = 99999999", "a camera's part"},
      {"UPDATE camera SET focal_x = 9e999", "a camera's lens is not finite"},
      {"UPDATE camera SET k3 = -9e999", "a camera's lens is not finite"},
      {"UPDATE mask SET semantic = 70000", "a mask's class"},
      {"UPDATE joint SET body = -9", "a joint's body"},
      {"UPDATE joint SET part = -1", "a joint's part"},
      {"UPDATE object_state SET y = 9e999", "a pose is not finite"},
      {"UPDATE hand_state SET qw = -9e999", "a hand is not finite"},
      {"UPDATE object_state SET frame = 5000 WHERE frame = 0 AND posed = 0", "a row of object_state"},
      {"UPDATE object_state SET posed = 7 WHERE posed = 1", "a row of object_state"},
      {"UPDATE joint_state SET part = 9 WHERE frame = 2", "a row of joint_state"},
      {"UPDATE joint_state SET velocity_1 = NULL WHERE frame = 2", "a row of joint_state"},
      {"UPDATE action SET frame = -1 WHERE frame = 0", "a row of action"},
      {"UPDATE action SET part = 1 WHERE frame = 0", "a row of action"},
      {"UPDATE action_channel SET component = 70 WHERE space = 'tool_pose' AND component = 6",
       "a row of action_channel"},
      {"UPDATE sample SET value_1 = NULL WHERE ordinal = 1", "a row of sample"},
      {"UPDATE sample SET part = 1 WHERE ordinal = 1", "a row of sample"},
  };
  for (const auto& [statement, complaint] : lies) {
    INFO(statement);
    const Catalogue catalogue = Catalogue::open(changed_copy(folder, good, statement));
    CHECK_THROWS_WITH(catalogue.read_episode(1), Contains(complaint) && Contains("generate it again"));
    CHECK_THROWS_AS(catalogue.read_episode(1), CatalogueError);
    CHECK_NOTHROW(catalogue.query("SELECT * FROM segments"));
  }
}

TEST_CASE("arrays are not made of rows that lie") {
  const Folder folder;
  EpisodeRecord episode = sample_episode("lift", "colour=red", 1);
  ChannelRecord& wide = episode.channels.front();  // a sample takes two rows
  wide.components.assign(20, "force");
  wide.values.assign(wide.steps.size() * wide.components.size(), 0.5);
  const auto good = folder / "good.db";
  Catalogue::write(good).add(episode, kEngine);
  REQUIRE_NOTHROW(Catalogue::open(good).read_arrays(1));
  const std::vector<std::pair<std::string, std::string>> lies{
      // times what a frame is wide they overflow, to just before the first
      {"UPDATE joint_state SET frame = 6148914691236517205 WHERE frame = 2", "a row of joint_state"},
      {"UPDATE hand_state SET frame = 1152921504606846975 WHERE frame = 2", "a row of hand_state"},
      {"UPDATE hand_state SET hand = -1 WHERE frame = 2", "a row of hand_state"},
      {"UPDATE action SET frame = -1 WHERE frame = 0", "a row of action"},
      {"UPDATE object_state SET posed = 7 WHERE posed = 1", "a row of object_state"},
      {"DELETE FROM joint", "a row of joint_state"},
      {"DELETE FROM sample WHERE part = 1 AND ordinal = 0", "a row of sample"},
      {"UPDATE frame SET frame = 400 WHERE frame = 11; DELETE FROM frame WHERE frame = 3", "a row of"},
  };
  for (const auto& [statement, complaint] : lies) {
    INFO(statement);
    const Catalogue catalogue = Catalogue::open(changed_copy(folder, good, statement));
    CHECK_THROWS_WITH(catalogue.read_arrays(1), Contains(complaint) && Contains("generate it again"));
  }
}

TEST_CASE("pictures of frames and sizes that cannot be are told before anything is made of them") {
  const Folder folder;
  EpisodeRecord episode = sample_episode("lift", "colour=red", 1);
  episode.images = sample_images(episode, {0, 2}, {"rgb"}, 60);
  const auto good = folder / "good.db";
  Catalogue::write(good).add(episode, kEngine);
  REQUIRE(Catalogue::open(good).images(1).size() > 1);
  for (const auto& [statement, complaint] : std::vector<std::pair<std::string, std::string>>{
           {"UPDATE image SET frame = 4294967296 WHERE frame = 2", "a picture's frame is 4294967296"},
           {"UPDATE image SET frame = 12 WHERE frame = 2", "a picture's frame is 12, and can be 0 to 11"},
           {"UPDATE image SET frame = -1 WHERE frame = 2", "a picture's frame"},
           {"UPDATE image SET width = 65537", "a picture's width"},
           {"UPDATE image SET height = 4294967297", "a value of height can be none"}}) {
    INFO(statement);
    const Catalogue catalogue = Catalogue::open(changed_copy(folder, good, statement));
    CHECK_THROWS_WITH(catalogue.images(1), Contains(complaint) && Contains("generate it again"));
  }
  const Catalogue lie =
      Catalogue::open(changed_copy(folder, good, "UPDATE image SET frame = 4294967296 WHERE frame = 2"));
  CHECK_THROWS_AS(lie.read_arrays(1), CatalogueError);
}

TEST_CASE("a scene that is cut off, and a parameter without its first number, are refused") {
  const Folder folder;
  const auto path = folder / "lie.db";
  EpisodeRecord episode = sample_episode("lift", "colour=red", 1);
  Catalogue::write(path).add(episode, kEngine);
  change(path, "UPDATE scene SET document = substr(document, 1, instr(document, '$asset') + 40)");
  CHECK_THROWS_WITH(Catalogue::open(path).read_episode(1), Contains("of a scene is missing"));
  std::filesystem::remove(path);
  Catalogue::write(path).add(episode, kEngine);
  change(path, "DELETE FROM segment_parameter WHERE component = 0");
  CHECK_THROWS_WITH(Catalogue::open(path).read_episode(1), Contains("a row of segment_parameter"));
}

TEST_CASE("a pipe as catalogue is refused at once") {
  const Folder folder;
  REQUIRE(::mkfifo((folder / "pipe.db").c_str(), 0600) == 0);
  CHECK_THROWS_WITH(Catalogue::open(folder / "pipe.db"), Contains("a pipe or a device"));
  CHECK_THROWS_WITH(Catalogue::write(folder / "pipe.db"), Contains("a pipe or a device"));
}
