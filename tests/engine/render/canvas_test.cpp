#include "engine/render/canvas.h"

#include <catch2/catch.hpp>
#include <thread>

#include "engine/base/error.h"
#include "engine/render/png.h"

using namespace stampede;

namespace {

constexpr std::array<std::uint8_t, 3> kWhite{255, 255, 255}, kBlack{0, 0, 0}, kRed{200, 10, 30};

std::array<std::uint8_t, 3> at(const Canvas& canvas, int x, int y) {
  const std::size_t i = static_cast<std::size_t>((y * canvas.width + x) * 3);
  return {canvas.rgb[i], canvas.rgb[i + 1], canvas.rgb[i + 2]};
}

struct Ink {  // what is not white
  int left = 1 << 20, right = -1, top = 1 << 20, bottom = -1, solid = 0, grey = 0;
};

Ink ink_of(const Canvas& canvas) {
  Ink ink;
  for (int y = 0; y < canvas.height; ++y)
    for (int x = 0; x < canvas.width; ++x) {
      if (at(canvas, x, y) == kWhite) continue;
      ink.left = std::min(ink.left, x), ink.right = std::max(ink.right, x);
      ink.top = std::min(ink.top, y), ink.bottom = std::max(ink.bottom, y);
      (at(canvas, x, y) == kBlack ? ink.solid : ink.grey)++;
    }
  return ink;
}

Canvas written(std::string_view text, int size, int x = 20, int baseline = 70) {
  Canvas canvas(400, 100, kWhite);
  canvas.text(x, baseline, text, size, kBlack);
  return canvas;
}

}  // namespace

TEST_CASE("rectangles and pictures are cut at the edges") {
  Canvas canvas(4, 3, kWhite);
  canvas.fill(2, -5, 100, 6, kRed);
  CHECK(at(canvas, 1, 0) == kWhite);
  CHECK(at(canvas, 2, 0) == kRed);
  CHECK(at(canvas, 3, 0) == kRed);
  CHECK(at(canvas, 3, 1) == kWhite);
  Picture picture;
  picture.width = picture.height = 2;
  picture.rgb = {1, 1, 1, 2, 2, 2, 3, 3, 3, 4, 4, 4};
  canvas.put(-1, 1, picture);
  CHECK(at(canvas, 0, 1) == std::array<std::uint8_t, 3>{2, 2, 2});
  CHECK(at(canvas, 0, 2) == std::array<std::uint8_t, 3>{4, 4, 4});
  CHECK(at(canvas, 1, 1) == kWhite);
  const Canvas before = canvas;
  for (const auto& [x, y] : {std::pair{-2, 0}, {4, 0}, {0, 3}, {0, -2}, {1000, 1000}}) canvas.put(x, y, picture);
  CHECK(canvas.rgb == before.rgb);
  CHECK_THROWS_AS(canvas.put(0, 0, Picture()), Error);
  CHECK_THROWS_AS(Canvas(0, 5, kWhite), Error);
}

TEST_CASE("letters stand on the baseline, as high as their size says, with soft edges") {
  const Ink ink = ink_of(written("H", 50));
  CHECK(ink.bottom == 69);
  CHECK(ink.bottom - ink.top + 1 == Approx(0.729 * 50).margin(1.01));  // the capitals of DejaVu Sans
  CHECK(ink.left >= 20);
  CHECK(ink.right < 20 + Canvas::text_width("H", 50));
  CHECK(ink.solid > 300);
  CHECK(ink_of(written("O", 50)).grey > 20);
  CHECK(ink_of(written("g", 50)).bottom > 75);  // below the line
}

TEST_CASE("the end of a text is where its width says, letter by letter") {
  Canvas canvas(300, 50, kWhite);
  const std::string text = "Größe: 3 → 4";
  CHECK(canvas.text(7, 30, text, 18, kBlack) == 7 + Canvas::text_width(text, 18));
  CHECK(Canvas::text_width("ab", 18) == Canvas::text_width("a", 18) + Canvas::text_width("b", 18));
  CHECK(Canvas::text_width("", 18) == 0);
  CHECK(Canvas::text_width("W", 36) > Canvas::text_width("i", 36));
}

TEST_CASE("UTF-8 letters are one letter each, and differ") {
  CHECK(Canvas::text_width("ä", 20) == Canvas::text_width("a", 20));
  CHECK(written("ä", 40).rgb != written("a", 40).rgb);
  CHECK(ink_of(written("ä", 40)).top < ink_of(written("a", 40)).top);
}

TEST_CASE("unknown letters and damaged UTF-8 show, and stop nothing") {
  const Canvas unknown = written("\U000F1234", 40);
  CHECK(ink_of(unknown).right > 0);  // the box
  CHECK(written("\U000F1235", 40).rgb == unknown.rgb);
  for (const std::string bad : {"\xff", "\xc3", "\xe2\x82", "\x80", "\xf0\x9f\x98"}) {
    const Canvas canvas = written(bad + "a", 30);
    CHECK(ink_of(canvas).right > 0);
    CHECK(Canvas::text_width(bad + "a", 30) > Canvas::text_width("a", 30));
  }
}

TEST_CASE("text is cut at the edges, and may be tiny or huge") {
  Canvas canvas(10, 10, kWhite);
  canvas.text(-30, 9, "WWWWWWWW", 20, kBlack);
  CHECK(ink_of(canvas).solid + ink_of(canvas).grey > 0);
  canvas.text(5, 500, "W", 20, kBlack);
  canvas.text(5, 5, "W", 0, kBlack);
  canvas.text(5, 5, "W", 100000, kBlack);
}

TEST_CASE("the same text gives the same pixels, after other sizes and in other threads") {
  const Canvas first = written("stack the blue cubes", 24);
  (void)written("other", 11);
  CHECK(written("stack the blue cubes", 24).rgb == first.rgb);
  Canvas other(1, 1, kWhite);
  std::thread([&] { other = written("stack the blue cubes", 24); }).join();
  CHECK(other.rgb == first.rgb);
}

TEST_CASE("lines are broken at blanks and fit, what is too much ends in an ellipsis") {
  const std::string text = "stack three blue blocks on the green plate";
  const int width = 120, size = 14;
  const auto all = wrapped(text, size, width, 10);
  CHECK(all.size() >= 3);
  std::string joined;
  for (const std::string& line : all) {
    CHECK(Canvas::text_width(line, size) <= width);
    joined += (joined.empty() ? "" : " ") + line;
  }
  CHECK(joined == text);
  for (std::size_t i = 0; i + 1 < all.size(); ++i) {  // no line could have held the next word
    const std::string next = all[i + 1].substr(0, all[i + 1].find(' '));
    CHECK(Canvas::text_width(all[i] + " " + next, size) > width);
  }
  const auto two = wrapped(text, size, width, 2);
  REQUIRE(two.size() == 2);
  CHECK(two[0] == all[0]);
  CHECK(two[1].ends_with("…"));
  CHECK(Canvas::text_width(two[1], size) <= width);
  const auto cut = wrapped("Donaudampfschifffahrtsgesellschaft", size, 60, 3);
  REQUIRE(cut.size() == 1);
  CHECK(cut[0].ends_with("…"));
  CHECK(Canvas::text_width(cut[0], size) <= 60);
  CHECK(wrapped("", size, width, 2).empty());
  CHECK(wrapped("  a \n b  ", size, width, 2) == std::vector<std::string>{"a b"});
}
