// Films are read again by libav, and must be what was put in.
#include "scripting/program/video.h"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <csignal>

#include "engine/base/error.h"
#include "tests/program/film.h"
#include "tests/program/say.h"

namespace stampede::program {
namespace {

using Rgb = std::array<std::uint8_t, 3>;

// Left half one colour, right half another; the colours change from picture to picture.
constexpr std::array<Rgb, 4> kColours{{{200, 40, 40}, {40, 180, 60}, {30, 60, 200}, {220, 220, 220}}};

std::vector<std::uint8_t> halves(int width, int height, int number) {
  std::vector<std::uint8_t> rgb;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const Rgb& colour = kColours[static_cast<std::size_t>((number / 5 + (x < width / 2 ? 0 : 1)) % 4)];
      rgb.insert(rgb.end(), colour.begin(), colour.end());
    }
  return rgb;
}

void write_film(const std::string& file, int width, int height, int rate, int count) {
  VideoWriter film(file, width, height, rate);
  for (int i = 0; i < count; ++i) film.add(halves(width, height, i));
  film.finish();
}

// Greatest difference of any channel, away from the seam between the halves.
int worst_channel(const FilmFrame& frame, int width, int height, int number) {
  const std::vector<std::uint8_t> wanted = halves(width, height, number);
  int worst = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      if (std::abs(x - width / 2) < 4) continue;
      for (int c = 0; c < 3; ++c) {
        const int there = frame.rgb[static_cast<std::size_t>((y * frame.width + x) * 3 + c)];
        worst = std::max(worst, std::abs(there - wanted[static_cast<std::size_t>((y * width + x) * 3 + c)]));
      }
    }
  return worst;
}

}  // namespace

TEST_CASE("a film has the pictures that were put in: number, size, rate and colours") {
  struct Case {
    const char* name;
    int width, height, rate, wide, high;
  };
  // H.264 halves the colours' resolution, so its sides are even.
  for (const Case& one : {Case{"even.mp4", 96, 64, 20, 96, 64}, Case{"odd.mp4", 95, 63, 30, 96, 64}}) {
    const Folder folder;
    const std::string file = folder / one.name;
    INFO(one.name);
    write_film(file, one.width, one.height, one.rate, 23);
    CHECK_FALSE(std::filesystem::exists(file + ".part"));
    const Film film = read_film(file);
    REQUIRE(film.frames.size() == 23);
    CHECK(film.frames.front().width == one.wide);
    CHECK(film.frames.front().height == one.high);
    CHECK(film.duration_s == Approx(23.0 / one.rate).margin(0.011));
    for (std::size_t i = 0; i < film.frames.size(); ++i) {
      CHECK(film.frames[i].time_s == Approx(static_cast<double>(i) / one.rate).margin(0.0051));
      CHECK(worst_channel(film.frames[i], one.width, one.height, static_cast<int>(i)) <= 10);
    }
  }
}

TEST_CASE("the same pictures make the same file, byte for byte") {
  const Folder folder;
  for (const char* name : {"a.mp4", "b.mp4"}) write_film(folder / name, 64, 64, 20, 30);
  CHECK(file_text(folder / "a.mp4") == file_text(folder / "b.mp4"));
}

TEST_CASE("films that cannot be are refused with the cure, and leave nothing") {
  const Folder folder;
  const auto complaint = [&](const std::string& name) {
    try {
      write_film(folder / name, 32, 32, 20, 2);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  CHECK(complaint("film.avi").find("say .mp4") != std::string::npos);
  CHECK(complaint("nowhere/film.mp4").find("No such file or directory") != std::string::npos);
  {
    VideoWriter film(folder / "short.mp4", 32, 32, 20);
    film.add(halves(32, 32, 0));
    CHECK_THROWS_AS(film.add(halves(16, 16, 0)), Error);
  }
  CHECK_THROWS_AS(VideoWriter(folder / "none.mp4", 0, 32, 20), Error);
  CHECK_THROWS_AS(VideoWriter(folder / "empty.mp4", 32, 32, 20).finish(), Error);
  CHECK(std::filesystem::is_empty(folder.text()));
}

TEST_CASE("a disk that is full is an error that says so, and no half film stays") {
  const Folder folder;
  const pid_t child = fork();
  if (child == 0) {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{3000, 3000};  // bytes that any file may have
    setrlimit(RLIMIT_FSIZE, &limit);
    try {
      VideoWriter film(folder / "film.mp4", 256, 256, 20);
      std::vector<std::uint8_t> noise(256 * 256 * 3);
      std::uint32_t state = 1;
      for (int i = 0; i < 20; ++i) {
        for (std::uint8_t& value : noise)
          value = static_cast<std::uint8_t>((state = state * 1664525 + 1013904223) >> 24);
        film.add(noise);
      }
      film.finish();
    } catch (const Error& error) {
      _exit(std::string(error.hint()).find("free") == std::string::npos ? 2 : 42);
    }
    _exit(1);
  }
  int status = 0;
  waitpid(child, &status, 0);
  CHECK(WEXITSTATUS(status) == 42);
  CHECK(std::filesystem::is_empty(folder.text()));
}

}  // namespace stampede::program
