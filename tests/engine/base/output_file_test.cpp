#include "engine/base/output_file.h"

#include <fcntl.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <fstream>
#include <sstream>

#include "engine/base/error.h"
#include "engine/base/temporary_folder.h"

namespace stampede {
namespace {

namespace fs = std::filesystem;

std::string text_in(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void put(const fs::path& path, const std::string& text) { std::ofstream(path, std::ios::binary) << text; }

OutputKind note() { return marked_kind("a note", "note", "of ours"); }

void write(const fs::path& path, const std::string& text, const OutputRules& rules = {}, OutputKind kind = note()) {
  OutputFile file(path, std::move(kind), rules);
  file.write(text);
  file.finish();
}

std::string complaint(const fs::path& path, const OutputRules& rules = {}, OutputKind kind = note()) {
  try {
    write(path, "note of ours", rules, std::move(kind));
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

std::size_t files_in(const fs::path& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

using Catch::Contains;

}  // namespace

TEST_CASE("a file has its name once it is whole, without that nothing is there, and what was there stays") {
  const TemporaryFolder folder;
  const fs::path path = folder.path() / "a";
  {
    OutputFile file(path, note(), {});
    file.write("note of ours");
    CHECK(files_in(folder.path()) <= 1);
    CHECK_FALSE(fs::exists(path));
  }
  CHECK(files_in(folder.path()) == 0);
  write(path, "note of ours, 1");
  {
    OutputFile file(path, note(), {});
    file.write("note of ours, 2");
  }
  CHECK(text_in(path) == "note of ours, 1");
  write(path, "note of ours, 3");
  CHECK(text_in(path) == "note of ours, 3");
  CHECK(files_in(folder.path()) == 1);
}

TEST_CASE("what is not of the kind is replaced with force alone, what is empty may be") {
  const TemporaryFolder folder;
  const fs::path path = folder.path() / "a";
  put(path, "a letter");
  CHECK_THAT(complaint(path), Contains("this file is there already, and is not a note") && Contains("--force"));
  CHECK(text_in(path) == "a letter");
  fs::permissions(path, fs::perms(0640));
  CHECK(complaint(path, OutputRules({}, true)).empty());
  CHECK(text_in(path) == "note of ours");
  CHECK(fs::status(path).permissions() == fs::perms(0640));
  put(path, "");
  CHECK(complaint(path).empty());
}

TEST_CASE("an input is never written over, by whatever name, not even with force") {
  const TemporaryFolder folder;
  const fs::path in = folder.path() / "in.db";
  put(in, "note of ours, read");
  fs::create_hard_link(in, folder.path() / "hard");
  fs::create_symlink(in, folder.path() / "soft");
  fs::create_directory_symlink(folder.path(), folder.path() / "round");
  for (const bool by_link : {false, true}) {
    const OutputRules rules({by_link ? folder.path() / "soft" : in}, true);
    for (const char* name : {"in.db", "./in.db", "hard", "soft", "round/in.db", "in.db-wal", "in.db-shm",
                             "in.db-journal", "round/in.db-wal"}) {
      INFO(name);
      CHECK_THAT(complaint(folder.path() / name, rules), Contains("is not written over"));
    }
  }
  CHECK(text_in(in) == "note of ours, read");
  CHECK(fs::is_symlink(folder.path() / "soft"));
  const OutputRules whole({folder.path()}, true);  // a folder that is read
  put(folder.path() / "other", "a letter");
  CHECK_THAT(complaint(folder.path() / "other", whole), Contains("lies in a folder that is read"));
  CHECK(complaint(folder.path() / "new", whole).empty());
  CHECK(complaint(folder.path() / "new", whole).empty());  // ours
}

TEST_CASE("a link is not written through: with force a file takes its place") {
  const TemporaryFolder folder;
  put(folder.path() / "target", "note of ours, elsewhere");
  fs::create_symlink(folder.path() / "target", folder.path() / "link");
  fs::create_symlink(folder.path() / "nothing", folder.path() / "loose");
  for (const char* name : {"link", "loose"}) {
    CHECK_THAT(complaint(folder.path() / name), Contains("this is a link, to "));
    CHECK(complaint(folder.path() / name, OutputRules({}, true)).empty());
    CHECK(fs::is_regular_file(fs::symlink_status(folder.path() / name)));
  }
  CHECK(text_in(folder.path() / "target") == "note of ours, elsewhere");
  CHECK_FALSE(fs::exists(folder.path() / "nothing"));
}

TEST_CASE("pipes and devices are written to as they are, or refused by kinds that cannot") {
  const TemporaryFolder folder;
  const fs::path pipe = folder.path() / "pipe";
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  const int reader = open(pipe.c_str(), O_RDWR | O_NONBLOCK);
  write(pipe, "note of ours");
  std::string got(100, ' ');
  got.resize(static_cast<std::size_t>(std::max<ssize_t>(0, read(reader, got.data(), got.size()))));
  CHECK(got == "note of ours");
  CHECK(fs::is_fifo(pipe));
  OutputKind seeking = note();
  seeking.seeks = true;
  CHECK_THAT(complaint(pipe, {}, seeking), Contains("written back and forth"));
  CHECK(complaint("/dev/fd/" + std::to_string(reader)).empty());
  close(reader);
  CHECK(complaint("/dev/null").empty());
  if (fs::is_character_file("/dev/full")) {
    CHECK_THAT(complaint("/dev/full"), Contains("could not be written: No space left on device"));
    CHECK(fs::is_character_file("/dev/full"));
  }
}

TEST_CASE("standard output has many names, and no file of these is made") {
  for (const char* name : {"-", "/dev/stdout", "/dev/fd/1", "/proc/self/fd/1", "/dev/./stdout"}) {
    std::ostringstream out;
    write(name, "note", OutputRules({}, false, &out));
    CHECK(out.str() == "note");
    CHECK_THAT(complaint(name), Contains("cannot go to standard output"));
  }
  CHECK_FALSE(fs::exists("-"));
}

TEST_CASE("folders, sockets and places that are not there are refused") {
  const TemporaryFolder folder;
  CHECK_THAT(complaint(folder.path()), Contains("this is a folder"));
  CHECK_THAT(complaint(folder.path() / "no/file"), Contains("could not be written") && Contains("make its folder"));
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const std::string name = (folder.path() / "s").string();
  REQUIRE(name.size() < sizeof address.sun_path);
  std::copy(name.begin(), name.end(), address.sun_path);
  const int server = socket(AF_UNIX, SOCK_STREAM, 0);
  REQUIRE(bind(server, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0);
  CHECK_THAT(complaint(name, OutputRules({}, true)), Contains("this is a socket"));
  CHECK(fs::is_socket(name));
  close(server);
}

TEST_CASE("a folder's files are replaced where it is ours, elsewhere only new ones are written") {
  const TemporaryFolder folder;
  const fs::path own = folder.path() / "out";
  {
    const OutputFolder out(own, "mark", note(), {});
    out.write("mark", "note of ours");
    out.write("a/b/c", "1");
    out.write("mark", "note of ours, at its end");  // its own, again
  }
  OutputFolder(own, "mark", note(), {}).write("a/b/c", "2");
  CHECK(text_in(own / "a/b/c") == "2");
  put(own / "mark", "a letter");
  const OutputFolder other(own, "mark", note(), {});
  CHECK_THROWS_WITH(other.write("a/b/c", "3"), Contains("is there already"));
  other.write("a/b/d", "3");
  OutputFolder(own, "mark", note(), OutputRules({}, true)).write("a/b/c", "4");
  CHECK(text_in(own / "a/b/c") == "4");
  CHECK_THROWS_WITH(OutputFolder(own / "mark", "mark", note(), {}), Contains("this is a file"));
  CHECK_THROWS_WITH(OutputFolder("/dev/stdout", "mark", note(), {}), Contains("a folder is needed"));
}

TEST_CASE("below the folder that was named no link is followed") {
  const TemporaryFolder folder, elsewhere;
  fs::create_directory_symlink(elsewhere.path(), folder.path() / "link");
  const OutputFolder out(folder.path(), "mark", note(), OutputRules({}, true));
  CHECK_THROWS_WITH(out.write("link/a", "1"), Contains("nothing is written through it"));
  const OutputFolder within(folder.path(), "mark", note(), OutputRules({}, true), "link");
  CHECK_THROWS_WITH(within.write("a", "1"), Contains("nothing is written through it"));
  CHECK_THROWS_WITH(within.check({"a"}), Contains("nothing is written through it"));
  CHECK(files_in(elsewhere.path()) == 0);
  OutputFolder(folder.path() / "link", "mark", note(), {}).write("a", "1");  // its owner named it
  CHECK(files_in(elsewhere.path()) == 1);
}

TEST_CASE("what could not be written is found ahead of the first file") {
  const TemporaryFolder folder;
  const OutputFolder out(folder.path(), "mark", note(), {}, "a");
  out.check({"mark", "b/c"});
  fs::create_directories(folder.path() / "a/b");
  put(folder.path() / "a/b/c", "others'");
  CHECK_THROWS_WITH(out.check({"mark", "b/c"}), Contains("is there already"));
  OutputFolder(folder.path(), "mark", note(), OutputRules({}, true), "a").check({"mark", "b/c"});
}

}  // namespace stampede
