// Drawing letters and pictures onto a picture: for contact sheets and videos.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "engine/render/picture.h"

namespace stampede {

struct Canvas {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;
  Canvas(int width_, int height_, std::array<std::uint8_t, 3> colour);

  void fill(int x, int y, int w, int h, std::array<std::uint8_t, 3> colour);
  void put(int x, int y, const Picture& picture);  // its rgb; clipped
  // DejaVu Sans, which is compiled in. `baseline` is where letters stand. Result: x after the last letter. UTF-8.
  int text(int x, int baseline, std::string_view utf8, int size_px, std::array<std::uint8_t, 3> colour);
  static int text_width(std::string_view utf8, int size_px);
};

// The text in lines that fit, broken at blanks, at most `lines`; what does not fit ends in an ellipsis.
std::vector<std::string> wrapped(std::string_view utf8, int size_px, int width, int lines);

}  // namespace stampede
