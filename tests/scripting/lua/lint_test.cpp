// `catch (...)` would swallow Lua's own errors and yields; a try block in a bound function would hide them.
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace fs = std::filesystem;

// Lua throws through its own functions what only it may catch; other rooms call it protected, and programs' functions
// too.
TEST_CASE("nothing beside Lua catches everything, and one file wraps Lua functions") {
  int read = 0;
  for (const auto& entry : fs::recursive_directory_iterator(STAMPEDE_SOURCE_DIR "/scripting")) {
    const std::string extension = entry.path().extension().string();
    if (extension != ".cpp" && extension != ".h") continue;
    std::ifstream file(entry.path());
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    INFO(entry.path());
    ++read;
    const std::string room = entry.path().parent_path().filename().string();
    const bool outside =
        room == "session" || room == "recording" || room == "research" || room == "commands" || room == "program";
    if (!outside || text.find("lua.hpp") != std::string::npos) {
      CHECK(text.find("catch (...)") == std::string::npos);
      CHECK(text.find("catch(...)") == std::string::npos);
    }
    // A function handed to Lua goes through lua_function, which holds the try block.
    for (std::size_t at = text.find("lua_pushcfunction("); at != std::string::npos;
         at = text.find("lua_pushcfunction(", at + 1)) {
      const std::string call = text.substr(at, text.find('\n', at) - at);
      const bool wrapped = call.find("lua_function<") != std::string::npos ||
                           call.find("entry.function") != std::string::npos ||
                           call.find("wrapper") != std::string::npos;
      INFO(call);
      CHECK(wrapped);
    }
  }
  CHECK(read > 10);
}
