#include "engine/base/child_process.h"

#include <signal.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <thread>

#include "engine/base/error.h"

using namespace stampede;
using Catch::Contains;

namespace {

std::string complaint(const std::function<std::string()>& work, ChildLimits limits = {}) {
  limits.cpu_s = 1;
  try {
    (void)in_child("cup.obj", "write it again", limits, work);
  } catch (const Error& error) {
    CHECK(error.where() == "cup.obj");
    CHECK(error.hint() == "write it again");
    return error.message();
  }
  return "accepted";
}

// Not a call in its own tail, and each frame is used.
std::size_t deep(std::size_t depth) {
  volatile char frame[4096] = {static_cast<char>(depth)};
  return depth == 0 ? 0 : deep(depth - 1) + static_cast<std::size_t>(frame[0] != 0);
}

}  // namespace

TEST_CASE("a child's result comes back whole, zero bytes and all") {
  const std::string big(3'000'000, '\0');
  CHECK(in_child("a", "b", {}, [&] { return big; }) == big);
  CHECK(in_child("a", "b", {}, [] { return std::string(); }).empty());
}

TEST_CASE("a child's Error is thrown here") {
  const auto work = []() -> std::string { throw Error("bad.png", "is torn", "mend it"); };
  CHECK_THROWS_WITH(in_child("cup.obj", "hint", {}, work), Contains("bad.png: is torn") && Contains("mend it"));
  CHECK_THAT(complaint([]() -> std::string { throw std::runtime_error("odd"); }), Contains("odd"));
}

TEST_CASE("a child that crashes, aborts, works for ever or takes all memory is an Error at once") {
  CHECK_THAT(complaint([]() -> std::string { std::abort(); }), Contains("crashes"));
  CHECK_THAT(complaint([] { return std::to_string(deep(std::size_t{1} << 40)); }), Contains("crashes"));
  CHECK_THAT(complaint([]() -> std::string {
               volatile bool going = true;
               while (going) continue;
               return "";
             }),
             Contains("more than 1 s"));
  CHECK_THAT(complaint([]() -> std::string { _exit(0); }), Contains("ended early"));
  CHECK_THAT(complaint([]() -> std::string {
               raise(SIGINT);
               return "";
             }),
             Contains("interrupted"));
  ChildLimits small;
  small.output_bytes = 1000;
  CHECK_THAT(complaint([] { return std::string(100'000, 'x'); }, small), Contains("takes more than"));
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // which take all address space for themselves
  CHECK_THAT(complaint([] { return std::string(std::size_t{3} << 30, 'x'); }), Contains("1024 MiB of memory"));
#endif
}

TEST_CASE("a child writes no files and reads none of our input") {
  const auto name = std::filesystem::temp_directory_path() / ("stampede_child_" + std::to_string(getpid()));
  const auto work = [&name] {
    std::ofstream file(name);
    file << "something" << std::flush;
    return std::string(file ? "written" : "refused");
  };
  CHECK(in_child("a", "b", {}, work) == "refused");
  std::filesystem::remove(name);
}

#ifndef __SANITIZE_ADDRESS__  // its allocator stays locked in the child where another thread held the lock
TEST_CASE("children of several threads do not wait for each other's ends") {
  std::vector<std::thread> threads;
  std::vector<std::string> results(8);
  for (std::size_t i = 0; i < results.size(); ++i)
    threads.emplace_back([&results, i] {
      for (int k = 0; k < 5; ++k)
        results[i] = in_child("a", "b", {}, [i] { return std::string(100'000, static_cast<char>('a' + i)); });
    });
  for (std::thread& thread : threads) thread.join();
  for (std::size_t i = 0; i < results.size(); ++i)
    CHECK(results[i] == std::string(100'000, static_cast<char>('a' + i)));
}
#endif
