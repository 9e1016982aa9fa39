#include "engine/base/scratch_folder.h"

#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <csignal>
#include <fstream>
#include <set>

#include "engine/base/error.h"
#include "engine/base/temporary_folder.h"

using namespace stampede;
namespace fs = std::filesystem;

namespace {

std::set<std::string> names_in(const fs::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.insert(entry.path().filename());
  return names;
}

void put_text(const fs::path& file, const std::string& text) {
  fs::create_directories(file.parent_path());
  std::ofstream(file) << text;
}

// Makes one and is killed.
void leave_one(const fs::path& output) {
  const pid_t child = ::fork();
  if (child == 0) {
    const ScratchFolder scratch(output);
    std::ofstream(scratch.file()) << "half";
    std::ofstream(scratch.file().string() + "-journal") << "half";
    ::raise(SIGKILL);
  }
  ::waitpid(child, nullptr, 0);
}

}  // namespace

TEST_CASE("what is not finished lies beside its output and goes with its owner") {
  const TemporaryFolder folder;
  const fs::path output = folder.path() / "a.db";
  {
    const ScratchFolder scratch(output), other(output);
    CHECK(scratch.file().parent_path().parent_path() == folder.path());
    CHECK(ScratchFolder::is_one(scratch.file().parent_path(), output));
    std::ofstream(scratch.file()) << "half";
    CHECK(names_in(folder.path()).size() == 2);  // the second did not sweep the first, which lives
  }
  CHECK(names_in(folder.path()).empty());
  CHECK_THROWS_AS(ScratchFolder(folder.path() / "none/a.db"), Error);
}

TEST_CASE("what a killed program left behind is swept by the next for the same output") {
  const TemporaryFolder folder;
  leave_one(folder.path() / "a.db");
  CHECK(names_in(folder.path()).size() == 1);
  { const ScratchFolder other(folder.path() / "b.db"); }
  CHECK(names_in(folder.path()).size() == 1);
  { const ScratchFolder next(folder.path() / "a.db"); }
  CHECK(names_in(folder.path()).empty());
}

TEST_CASE("what somebody else made is never swept") {
  const TemporaryFolder folder;
  const fs::path output = folder.path() / "a.db";
  put_text(folder.path() / "a.db.schema5", "a user's own copy");
  put_text(folder.path() / "a.db.unfinished", "a user's own text");
  put_text(folder.path() / "a.db.stampede-abcdef/notes", "a user's own folder");
  put_text(folder.path() / "a.db.stampede-ghijkl/made-by-stampede", "other words");
  put_text(folder.path() / "a.db.stampede-ghijkl/unfinished", "mine");
  put_text(folder.path() / "a.db.stampede-mnopqr", "a file");
  fs::create_directory_symlink("/tmp", folder.path() / "a.db.stampede-stuvwx");
  leave_one(output);
  for (const auto& entry : fs::directory_iterator(folder.path()))
    if (ScratchFolder::is_one(entry.path(), output)) put_text(entry.path() / "notes", "put there since");
  const std::set<std::string> before = names_in(folder.path());
  { const ScratchFolder scratch(output); }
  CHECK(names_in(folder.path()) == before);
  CHECK(fs::exists(folder.path() / "a.db.stampede-ghijkl/unfinished"));
  CHECK(fs::exists(folder.path() / "a.db.stampede-abcdef/notes"));
}
