#include "engine/base/file_scope.h"

#include <catch2/catch.hpp>
#include <fstream>

#include "engine/base/error.h"

using namespace stampede;
namespace fs = std::filesystem;

TEST_CASE("a file lies in a scope when it really does, by whatever name") {
  std::string name = (fs::temp_directory_path() / "stampede_scope_XXXXXX").string();
  REQUIRE(mkdtemp(name.data()) != nullptr);
  const fs::path top = name;
  fs::create_directories(top / "mine" / "deep");
  fs::create_directories(top / "mine_too");
  for (const char* file : {"mine/a", "mine/deep/b", "mine_too/c", "d"}) std::ofstream(top / file) << "x";
  fs::create_symlink(top / "d", top / "mine" / "way_out");
  fs::create_symlink(top / "mine" / "a", top / "way_in");
  fs::create_directory_symlink(top, top / "mine" / "up");

  const FileScope scope({top / "mine" / ""});
  CHECK(scope.contains(top / "mine" / "a"));
  CHECK(scope.contains(top / "mine" / "deep" / ".." / "a"));
  CHECK(scope.contains(top / "mine_too" / ".." / "mine" / "deep" / "b"));
  CHECK(scope.contains(top / "mine" / "not_there"));  // its reader says so
  CHECK(scope.contains(top / "way_in"));
  CHECK_FALSE(scope.contains(top / "mine_too" / "c"));
  CHECK_FALSE(scope.contains(top / "mine" / ".." / "d"));
  CHECK_FALSE(scope.contains(top / "mine" / "way_out"));
  CHECK_FALSE(scope.contains(top / "mine" / "up" / "d"));
  CHECK_FALSE(scope.contains("/etc/passwd"));
  CHECK(FileScope({top / "mine", top / "mine_too"}).contains(top / "mine_too" / "c"));
  CHECK(beside(top / "mine" / "a").contains(top / "mine" / "deep" / "b"));
  CHECK_FALSE(FileScope({}).contains(top / "d"));
  CHECK_THROWS_WITH(scope.check("/etc/passwd"), Catch::Contains("outside the roots") && Catch::Contains("--path"));
  fs::remove_all(top);
}
