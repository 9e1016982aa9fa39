// Reads films with libav.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace stampede::program {

struct FilmFrame {
  int width = 0, height = 0;
  double time_s = 0;
  std::vector<std::uint8_t> rgb;  // height x width x 3
};

struct Film {
  double duration_s = 0;
  std::vector<FilmFrame> frames;
};

Film read_film(const std::string& file);  // fails the test when it is none

}  // namespace stampede::program
