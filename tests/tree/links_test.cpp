// Pages lead a newcomer from folder to folder: no link may end nowhere.
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>

namespace fs = std::filesystem;

TEST_CASE("each link of a page leads to a file") {
  const std::regex link(R"(\]\(([^)#:]+)[^):]*\))");
  int links = 0;
  for (fs::recursive_directory_iterator at(STAMPEDE_SOURCE_DIR), end; at != end; ++at) {
    const std::string name = at->path().filename();
    if (at->is_directory() && name.starts_with(".")) at.disable_recursion_pending();
    if (!name.ends_with(".md") || name == "RECIPES.md") continue;  // that one is C++, where lambdas look like links
    std::ifstream file(at->path());
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    for (std::sregex_iterator found(text.begin(), text.end(), link), none; found != none; ++found, ++links) {
      INFO(at->path() << " links to " << found->str(1));
      CHECK(fs::exists(at->path().parent_path() / found->str(1)));
    }
  }
  CHECK(links > 15);
}
