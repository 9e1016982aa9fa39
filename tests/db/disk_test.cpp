// A disk that fills up: SQLite's own calls to write are replaced by ones that soon answer ENOSPC.
#include <sqlite3.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <catch2/catch.hpp>
#include <cerrno>
#include <functional>
#include <limits>

#include "db/catalogue_writer.h"
#include "sample_episode.h"

using namespace stampede;
using namespace stampede::test;
using Catch::Matchers::Contains;

namespace {

constexpr std::int64_t kEndless = std::numeric_limits<std::int64_t>::max();
std::atomic<std::int64_t> space_left{kEndless};

bool takes(std::size_t size) {
  if (space_left.fetch_sub(static_cast<std::int64_t>(size)) >= static_cast<std::int64_t>(size)) return true;
  space_left = 0;  // full is full
  errno = ENOSPC;
  return false;
}
ssize_t write_or_full(int file, const void* data, std::size_t size) {
  return takes(size) ? ::write(file, data, size) : -1;
}
ssize_t pwrite_or_full(int file, const void* data, std::size_t size, off_t place) {
  return takes(size) ? ::pwrite(file, data, size, place) : -1;
}

// While it lives, this process may write so many bytes more through SQLite.
class SmallDisk {
 public:
  explicit SmallDisk(std::int64_t bytes) : bytes_(bytes) {
    space_left = bytes;
    set("write", reinterpret_cast<sqlite3_syscall_ptr>(write_or_full));
    set("pwrite", reinterpret_cast<sqlite3_syscall_ptr>(pwrite_or_full));
    set("pwrite64", reinterpret_cast<sqlite3_syscall_ptr>(pwrite_or_full));
  }
  ~SmallDisk() {
    for (const char* name : {"write", "pwrite", "pwrite64"}) set(name, nullptr);
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;
  std::int64_t used() const { return bytes_ - space_left; }

 private:
  static void set(const char* name, sqlite3_syscall_ptr call) {
    sqlite3_vfs* system = sqlite3_vfs_find(nullptr);
    REQUIRE(system->iVersion >= 3);
    REQUIRE(system->xSetSystemCall(system, name, call) == SQLITE_OK);
  }
  std::int64_t bytes_;
};

std::vector<EpisodeRecord> episodes() {
  std::vector<EpisodeRecord> list;
  for (const std::int64_t seed : {1, 2, 3, 4}) {
    list.push_back(sample_episode("lift", "colour=red", seed));
    list.back().images = sample_images(list.back(), {0, 6, 11}, {"rgb", "depth"}, 9000);
  }
  return list;
}

void run(const std::filesystem::path& path, const std::vector<EpisodeRecord>& list) {
  CatalogueWriter writer(path, {kEngine, 1'000'000'000, {}});
  for (std::size_t i = 0; i < list.size(); ++i) writer.finished(static_cast<std::int64_t>(i), list[i]);
  writer.finish();
}

// Result: what it complained of; empty: nothing.
std::string hint_of(const std::function<void()>& work) {
  try {
    work();
  } catch (const CatalogueError& error) {
    return error.hint().empty() ? "no cure" : error.hint();
  }
  return {};
}

}  // namespace

TEST_CASE("wherever the disk fills up, finished episodes are whole and running again completes them") {
  const Folder folder;
  const std::vector<EpisodeRecord> list = episodes();
  std::int64_t needed = 0;
  {
    const SmallDisk disk(kEndless);
    run(folder / "whole.db", list);
    needed = disk.used();
  }
  REQUIRE(needed > 4 * 12 * 9000);
  const std::string whole = Catalogue::open(folder / "whole.db").content_hash();
  std::size_t some = 0;
  for (int part = 0; part < 16; ++part) {
    INFO(part << " / 16 of the space it takes");
    const auto path = folder / (std::to_string(part) + ".db");
    {
      const SmallDisk disk(needed * part / 16);
      CHECK_THAT(hint_of([&] { run(path, list); }), Contains("space"));
    }
    {
      const Catalogue catalogue = Catalogue::write(path);
      const auto stored = catalogue.episodes();
      if (!stored.empty() && stored.size() < list.size()) ++some;
      for (std::size_t i = 0; i < stored.size(); ++i) {
        CHECK(stored[i].key == list[i].made.key);  // the first ones, in order
        CHECK(catalogue.images(stored[i].id).size() == list[i].images->count());
        CHECK(catalogue.read_episode(stored[i].id).labels.keyframes == list[i].labels.keyframes);
      }
    }
    run(path, list);
    CHECK(Catalogue::open(path).content_hash() == whole);
  }
  CHECK(some >= 3);  // the disk did fill up between episodes
}

TEST_CASE("a disk that fills up while pictures are added leaves the catalogue as it was") {
  const Folder folder;
  EpisodeRecord e = sample_episode("lift", "colour=red", 1);
  std::vector<CameraTrack> tracks;
  for (const Camera& camera : e.scene.cameras) tracks.push_back({camera, {}});
  const auto images = sample_images(e, {0, 3, 6, 9, 11}, {"rgb", "depth", "instance"}, 20'000);
  Catalogue catalogue = Catalogue::write(folder / "a.db");
  catalogue.add(e, kEngine);
  const std::string before = catalogue.content_hash();
  const std::int64_t size = images->bytes();
  REQUIRE(size == 5 * 2 * 3 * 20'000);
  for (const std::int64_t room : {std::int64_t{0}, std::int64_t{5000}, size / 3, size - 1}) {
    INFO(room << " bytes left");
    const SmallDisk disk(room);
    CHECK_THAT(hint_of([&] { catalogue.add_images(1, *images, tracks); }), Contains("free some space"));
    CHECK(catalogue.images(1).empty());
    CHECK(catalogue.content_hash() == before);
  }
  CHECK(catalogue.add_images(1, *images, tracks).added == static_cast<std::int64_t>(images->count()));
  e.images = images;
  Catalogue at_once = Catalogue::write(folder / "b.db");
  at_once.add(e, kEngine);
  CHECK(catalogue.content_hash() == at_once.content_hash());
}
