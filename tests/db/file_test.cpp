#include <sqlite3.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <csignal>
#include <fstream>
#include <functional>

#include "db/catalogue_writer.h"
#include "sample_episode.h"

using namespace stampede;
using namespace stampede::test;
using Catch::Matchers::Contains;

namespace {

void make(const std::filesystem::path& path) {
  Catalogue::write(path).add(sample_episode("lift", "colour=red", 1), kEngine);
}

// Runs in a process of its own; true when `work` returns true.
bool child_does(const std::function<bool()>& work) {
  const pid_t child = ::fork();
  if (child == 0) {
    bool good = false;
    try {
      good = work();
    } catch (const std::exception& error) {
      std::fprintf(stderr, "%s\n", error.what());
    }
    ::_exit(good ? 0 : 1);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

// Root may write anywhere.
void become_nobody() {
  if (::getuid() == 0 && ::setuid(65534) != 0) ::_exit(2);
}

}  // namespace

TEST_CASE("a closed catalogue is one plain file that carries its mark") {
  const Folder folder;
  make(folder / "a.db");
  int files = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder.path())) ++files;
  CHECK(files == 1);
  const std::string bytes = bytes_of(folder / "a.db");
  CHECK(bytes.substr(68, 4) == "Stmp");
  CHECK(bytes[18] == 1);  // not WAL
}

TEST_CASE("files that are not ours are refused with the cure and not touched") {
  const Folder folder;
  const auto refuse = [&](const std::string& name, const std::string& complaint, const std::string& cure) {
    const std::string before = bytes_of(folder / name);
    CHECK_THROWS_WITH(Catalogue::write(folder / name), Contains(complaint) && Contains(cure));
    CHECK_THROWS_WITH(Catalogue::open(folder / name), Contains(complaint) && Contains(cure));
    CHECK(bytes_of(folder / name) == before);
  };
  change(folder / "other.db", "CREATE TABLE t (a); PRAGMA application_id = 7");
  refuse("other.db", "another application", "another file");
  std::ofstream(folder / "text.db") << std::string(2000, 'x');
  refuse("text.db", "not a database", "name a catalogue");
}

TEST_CASE("missing files, folders and empty files say what to do") {
  const Folder folder;
  CHECK_THROWS_WITH(Catalogue::open(folder / "none.db"), Contains("no such file"));
  CHECK_THROWS_WITH(Catalogue::write(folder / "none/a.db"), Contains("does not exist"));
  CHECK_THROWS_WITH(Catalogue::write(folder.path()), Contains("folder"));
  std::ofstream(folder / "empty.db").flush();
  CHECK_THROWS_WITH(Catalogue::open(folder / "empty.db"), Contains("empty"));
  CHECK_NOTHROW(make(folder / "empty.db"));  // a run that was killed at once leaves such a file
}

TEST_CASE("moved without its log, a file says where its data are") {
  const Folder folder;
  const auto path = folder / "a.db";
  const pid_t child = ::fork();
  if (child == 0) {
    Catalogue catalogue = Catalogue::write(path);
    catalogue.add(sample_episode("lift", "colour=red", 1), kEngine);
    ::raise(SIGKILL);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  REQUIRE(WIFSIGNALED(status));
  std::filesystem::copy_file(path, folder / "moved.db");
  CHECK_THROWS_WITH(Catalogue::open(folder / "moved.db"),
                    Contains("moved.db-wal, which is not beside it") && Contains("stampede merge copy.db"));
  std::filesystem::copy_file(path.string() + "-wal", folder / "moved.db-wal",
                             std::filesystem::copy_options::overwrite_existing);
  CHECK(Catalogue::open(folder / "moved.db").episodes().size() == 1);
}

TEST_CASE("killed while it writes in place, the file is what it was, also for who only reads") {
  const Folder folder;
  const auto path = folder / "a.db";
  Catalogue::write(path).add(sample_episode("lift", "colour=red", 0), kEngine);
  const std::string before = Catalogue::open(path).content_hash();
  const auto size = std::filesystem::file_size(path);
  EpisodeRecord large = sample_episode("lift", "colour=red", 1, {120, 15, 10});
  const auto images = std::make_shared<ImageStore>();
  for (int i = 0; i < 100; ++i)  // more than stays in memory
    images->append_made({i, 0, "rgb", 8, 8}, [i]() -> std::vector<std::uint8_t> {
      if (i == 99) ::kill(::getpid(), SIGKILL);
      return std::vector<std::uint8_t>(1'000'000, static_cast<std::uint8_t>(i));
    });
  large.images = images;
  const pid_t child = ::fork();
  if (child == 0) Catalogue::write(path, Journal::in_place).add(large, kEngine);
  int status = 0;
  ::waitpid(child, &status, 0);
  REQUIRE(WIFSIGNALED(status));
  REQUIRE(std::filesystem::file_size(path) > size + 10'000'000);
  const auto locked = folder / "locked";  // where the half cannot be undone it is not shown either
  std::filesystem::create_directory(locked);
  ::chmod(folder.path().c_str(), 0755);
  for (const std::string name : {"a.db", "a.db-journal"}) {
    std::filesystem::copy_file(folder / name, locked / name);
    ::chmod((locked / name).c_str(), 0444);
  }
  ::chmod(locked.c_str(), 0555);
  CHECK(child_does([&] {
    become_nobody();
    try {
      Catalogue::open(locked / "a.db");
    } catch (const CatalogueError& error) {
      return std::string(error.what()).find("half in it") != std::string::npos &&
             error.hint().find("-journal") != std::string::npos;
    }
    return false;
  }));
  ::chmod(locked.c_str(), 0755);
  CHECK(Catalogue::open(path).content_hash() == before);
  CHECK(std::filesystem::file_size(path) == size);
  CHECK_FALSE(std::filesystem::exists(path.string() + "-journal"));
}

TEST_CASE("a catalogue in a read-only folder can be questioned and not written") {
  const Folder folder;
  make(folder / "plain.db");
  make(folder / "log.db");
  change(folder / "log.db", "PRAGMA journal_mode = WAL");  // as a reader may have left it
  std::filesystem::remove((folder / "log.db").string() + "-wal");
  std::filesystem::remove((folder / "log.db").string() + "-shm");
  for (const char* name : {"plain.db", "log.db"}) ::chmod((folder / name).c_str(), 0444);
  ::chmod(folder.path().c_str(), 0555);
  for (const std::string name : {"plain.db", "log.db"}) {
    CHECK(child_does([&] {
      become_nobody();
      return Catalogue::open(folder / name).query("SELECT * FROM demos").rows.size() == 1;
    }));
    CHECK(child_does([&] {
      become_nobody();
      try {
        make(folder / name);
      } catch (const CatalogueError& error) {
        return std::string(error.what()).find("read-only") != std::string::npos && !error.hint().empty();
      }
      return false;
    }));
  }
  ::chmod(folder.path().c_str(), 0755);
}

TEST_CASE("a read-only file loses nothing: what would write says so and how to go on") {
  const Folder folder;
  const auto path = folder / "a.db";
  make(path);
  const std::string before = bytes_of(path);
  const EpisodeRecord e = sample_episode("lift", "colour=red", 1);
  const auto images = sample_images(e, {0});
  const std::vector<CameraTrack> tracks{{e.scene.cameras[0], {}}, {e.scene.cameras[1], {}}};
  const auto refused = [](const std::function<void()>& work) {
    try {
      work();
    } catch (const CatalogueError& error) {
      return std::string(error.what()).find("read-only") != std::string::npos && !error.hint().empty();
    }
    return false;
  };
  {
    Catalogue reader = Catalogue::open(path);
    CHECK(refused([&] { reader.add_images(1, *images, tracks); }));
    CHECK(refused([&] { reader.add(sample_episode("lift", "colour=red", 2), kEngine); }));
  }
  ::chmod(path.c_str(), 0444);
  ::chmod(folder.path().c_str(), 0777);  // the file alone is read-only
  CHECK(child_does([&] {
    become_nobody();
    return refused([&] {
             CatalogueWriter(path, {kEngine, 1000, {}});
           }) &&
           refused([&] { Catalogue::write(path).add_images(1, *images, tracks); });
  }));
  CHECK(bytes_of(path) == before);
  CHECK(std::distance(std::filesystem::directory_iterator(folder.path()), {}) == 1);  // no log was left either
}

TEST_CASE("a disk that takes no more is an error, and what was finished stays") {
  const Folder folder;
  const auto path = folder / "a.db";
  CHECK(child_does([&] {
    ::signal(SIGXFSZ, SIG_IGN);
    Catalogue catalogue = Catalogue::write(path);
    catalogue.add(sample_episode("lift", "colour=red", 0), kEngine);
    const rlimit limit{1'000'000, 1'000'000};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    try {
      for (int seed = 1; seed < 100; ++seed)
        catalogue.add(sample_episode("lift", "colour=red", seed, {120, 15, 10}), kEngine);
    } catch (const CatalogueError& error) {
      return !error.hint().empty();
    }
    return false;
  }));
  Catalogue catalogue = Catalogue::open(path);
  const auto list = catalogue.episodes();
  REQUIRE(!list.empty());
  CHECK(catalogue.read_episode(list.back().id).labels.keyframes.size() == 1);
}

TEST_CASE("readers see finished episodes while a run writes") {
  const Folder folder;
  Catalogue writer = Catalogue::write(folder / "a.db");
  writer.add(sample_episode("lift", "colour=red", 1), kEngine);
  const Catalogue reader = Catalogue::open(folder / "a.db");
  CHECK(reader.episodes().size() == 1);
  writer.add(sample_episode("lift", "colour=red", 2), kEngine);
  CHECK(reader.episodes().size() == 2);
}

TEST_CASE("the same key is not stored twice") {
  const Folder folder;
  Catalogue catalogue = Catalogue::write(folder / "a.db");
  const EpisodeRecord episode = sample_episode("lift", "colour=red", 1);
  catalogue.add(episode, kEngine);
  CHECK_THROWS_AS(catalogue.add(episode, kEngine), CatalogueError);
  CHECK(catalogue.find(episode.made.key) == 1);
}
