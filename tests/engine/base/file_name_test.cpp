#include "engine/base/file_name.h"

#include <catch2/catch.hpp>
#include <filesystem>
#include <set>

namespace stampede {

TEST_CASE("usual names stay as they are") {
  for (const char* name : {"front", "stack_blocks", "RealSense D435", "top-left.v2", "küche", "a~b"})
    CHECK(file_name(name) == name);
}

TEST_CASE("what would leave the folder, or be obeyed, is escaped") {
  CHECK(file_name("../../x") == "%2E.%2F..%2Fx");
  CHECK(file_name("/etc/passwd") == "%2Fetc%2Fpasswd");
  CHECK(file_name(".") == "%2E");
  CHECK(file_name("..") == "%2E%2E");
  CHECK(file_name("") == "%");
  CHECK(file_name("-rf") == "%2Drf");
  CHECK(file_name(".bashrc") == "%2Ebashrc");
  CHECK(file_name("~root") == "%7Eroot");
  CHECK(file_name("a ") == "a%20");
  CHECK(file_name("a.") == "a%2E");
  CHECK(file_name(std::string("a\0b", 3)) == "a%00b");
  CHECK(file_name("a\x1b[31m\nb") == "a%1B[31m%0Ab");
  CHECK(file_name("a\\b:c*") == "a%5Cb%3Ac%2A");
  CHECK(file_name("\xff") == "%FF");
  CHECK(file_name("a\u202eb") == "a%E2%80%AEb");
  CHECK(file_name("nul") == "%6Eul");
  CHECK(file_name("COM1.txt") == "%43OM1.txt");
  CHECK(file_name("console") == "console");
}

TEST_CASE("no two texts have one name, and every name is one part of a path that a disk takes") {
  std::set<std::string> names;
  std::vector<std::string> texts = {"",  "%", "%2E", ".",   "%252E", "..", "a/b",   "a%2Fb", "a%2fb",    "a\\b",
                                    "a", "A", "nul", "NUL", "a ",    " a", "%6Eul", "a\xc3", "a\xc3\xa4"};
  for (const char end : {'a', 'b', '/'}) {
    texts.push_back(std::string(300, 'x') + end);
    texts.push_back(std::string(100, '\n') + end);
    std::string wide;
    for (int i = 0; i < 100; ++i) wide += "ä";
    texts.push_back(wide + end);
  }
  for (const std::string& text : texts) {
    const std::string name = file_name(text);
    INFO(name);
    CHECK(names.insert(name).second);
    CHECK(name.size() <= kLongestFileName);
    CHECK(name.find('/') == std::string::npos);
    CHECK(std::filesystem::path(name).filename() == name);
    CHECK(file_name(text) == name);
  }
}

TEST_CASE("in one folder names differ where a disk does not know large letters, and from what its owner writes") {
  FileNames names({"masks.csv"});
  CHECK(names.take("Front") == "Front");
  CHECK(names.take("front") == "front%~2");
  CHECK(names.take("FRONT") == "FRONT%~3");
  CHECK(names.take("Masks.csv") == "Masks.csv%~2");
  CHECK(names.take("wrist") == "wrist");
}

}  // namespace stampede
