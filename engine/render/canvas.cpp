#include "engine/render/canvas.h"

#include <ft2build.h>
#include FT_FREETYPE_H

#include <algorithm>
#include <map>
#include <new>
#include <utility>

#include "engine/base/error.h"

extern "C" {  // font.cpp
extern const unsigned char stampede_dejavu_sans[];
extern const unsigned char stampede_dejavu_sans_end[];
}

namespace stampede {
namespace {

constexpr int kLargestLetter = 512;  // px
constexpr char32_t kReplacement = 0xFFFD;

// The next code point; damaged UTF-8 gives the replacement character, byte by byte.
char32_t next_letter(std::string_view& text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char lead = byte(0);
  const std::size_t length = lead < 0x80 ? 1 : lead >> 5 == 6 ? 2 : lead >> 4 == 14 ? 3 : lead >> 3 == 30 ? 4 : 0;
  char32_t letter = length == 1 ? lead : lead & (0x7f >> length);
  bool good = length > 0 && length <= text.size();
  for (std::size_t i = 1; good && i < length; ++i) {
    good = byte(i) >> 6 == 2;
    letter = letter << 6 | (byte(i) & 0x3f);
  }
  text.remove_prefix(good ? length : 1);
  return good ? letter : kReplacement;
}

struct Glyph {
  int left = 0, top = 0, width = 0, height = 0;  // of the pixels, from the pen
  int advance = 0;
  std::vector<std::uint8_t> shares;  // of the letter's colour, of 255
};

// FreeType with the font that is compiled in. One for each thread: its faces are not shared.
class Font {
 public:
  Font() {
    const auto size = static_cast<FT_Long>(stampede_dejavu_sans_end - stampede_dejavu_sans);
    if (FT_Init_FreeType(&library_) != 0) throw std::bad_alloc();
    if (FT_New_Memory_Face(library_, stampede_dejavu_sans, size, 0, &face_) != 0) {
      FT_Done_FreeType(library_);
      throw Error("font", "the font that is compiled in cannot be read", "build with fonts-dejavu-core installed");
    }
  }
  ~Font() {
    FT_Done_Face(face_);
    FT_Done_FreeType(library_);
  }
  Font(const Font&) = delete;
  Font& operator=(const Font&) = delete;

  static Font& of_this_thread() {
    thread_local Font font;
    return font;
  }

  const Glyph& glyph(char32_t letter, int size_px) {
    constexpr std::size_t kMost = 4096;
    const int size = std::clamp(size_px, 1, kLargestLetter);
    const std::pair key(letter, size);
    if (const auto known = glyphs_.find(key); known != glyphs_.end()) return known->second;
    if (glyphs_.size() >= kMost) glyphs_.clear();
    return glyphs_[key] = drawn(letter, size);
  }

 private:
  // Without hinting: shapes and widths then follow from the size alone.
  Glyph drawn(char32_t letter, int size) {
    Glyph glyph;
    FT_Set_Pixel_Sizes(face_, 0, static_cast<FT_UInt>(size));
    if (FT_Load_Char(face_, letter, FT_LOAD_NO_HINTING) != 0) return glyph;
    const FT_GlyphSlot slot = face_->glyph;
    glyph.advance = static_cast<int>((slot->advance.x + 32) >> 6);
    if (FT_Render_Glyph(slot, FT_RENDER_MODE_NORMAL) != 0) return glyph;
    const FT_Bitmap& bitmap = slot->bitmap;
    glyph.left = slot->bitmap_left, glyph.top = slot->bitmap_top;
    glyph.width = static_cast<int>(bitmap.width), glyph.height = static_cast<int>(bitmap.rows);
    for (int row = 0; row < glyph.height; ++row) {
      const unsigned char* const at = bitmap.buffer + std::ptrdiff_t{row} * bitmap.pitch;
      glyph.shares.insert(glyph.shares.end(), at, at + glyph.width);
    }
    return glyph;
  }

  FT_Library library_ = nullptr;
  FT_Face face_ = nullptr;
  std::map<std::pair<char32_t, int>, Glyph> glyphs_;
};

std::uint8_t mixed(std::uint8_t under, std::uint8_t over, std::uint8_t share) {
  return static_cast<std::uint8_t>((under * (255 - share) + over * share + 127) / 255);
}

std::vector<std::string> words_of(std::string_view text) {
  std::vector<std::string> words(1);
  for (const char c : text) {
    if (c != ' ' && c != '\n' && c != '\t')
      words.back() += c;
    else if (!words.back().empty())
      words.emplace_back();
  }
  if (words.back().empty()) words.pop_back();
  return words;
}

const char* const kEllipsis = "…";

void drop_last_letter(std::string& text) {
  while (!text.empty() && (static_cast<unsigned char>(text.back()) & 0xc0) == 0x80) text.pop_back();
  if (!text.empty()) text.pop_back();
}

std::string shortened(std::string line, int size_px, int width) {
  while (!line.empty() && Canvas::text_width(line + kEllipsis, size_px) > width) drop_last_letter(line);
  while (line.ends_with(' ')) line.pop_back();
  return line + kEllipsis;
}

// As many words as fit; a word that alone is too wide stands in its line, to be cut.
std::string take_line(const std::vector<std::string>& words, std::size_t& next, int size_px, int width) {
  std::string line = words[next++];
  while (next < words.size() && Canvas::text_width(line + " " + words[next], size_px) <= width)
    line += " " + words[next++];
  return line;
}

}  // namespace

Canvas::Canvas(int width_, int height_, std::array<std::uint8_t, 3> colour) : width(width_), height(height_) {
  if (width < 1 || height < 1) throw Error("canvas", "it has no pixels", "give it a width and a height above 0");
  rgb.resize(std::size_t{3} * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  fill(0, 0, width, height, colour);
}

void Canvas::fill(int x, int y, int w, int h, std::array<std::uint8_t, 3> colour) {
  for (int v = std::max(y, 0); v < std::min(y + h, height); ++v)
    for (int u = std::max(x, 0); u < std::min(x + w, width); ++u)
      std::copy(colour.begin(), colour.end(), rgb.begin() + (std::ptrdiff_t{v} * width + u) * 3);
}

void Canvas::put(int x, int y, const Picture& picture) {
  if (picture.rgb.empty()) throw Error("picture", "it has no colours", "ask the renderer for rgb");
  const int left = std::max(x, 0), right = std::min(x + picture.width, width);
  for (int v = std::max(y, 0); left < right && v < std::min(y + picture.height, height); ++v) {
    const auto from = picture.rgb.begin() + (std::ptrdiff_t{v - y} * picture.width + left - x) * 3;
    std::copy(from, from + std::ptrdiff_t{right - left} * 3, rgb.begin() + (std::ptrdiff_t{v} * width + left) * 3);
  }
}

int Canvas::text(int x, int baseline, std::string_view utf8, int size_px, std::array<std::uint8_t, 3> colour) {
  while (!utf8.empty()) {
    const Glyph& glyph = Font::of_this_thread().glyph(next_letter(utf8), size_px);
    for (int row = 0; row < glyph.height; ++row)
      for (int column = 0; column < glyph.width; ++column) {
        const int u = x + glyph.left + column, v = baseline - glyph.top + row;
        if (u < 0 || u >= width || v < 0 || v >= height) continue;
        const std::uint8_t share = glyph.shares[static_cast<std::size_t>(row * glyph.width + column)];
        for (int k = 0; k < 3; ++k) {
          std::uint8_t& channel = rgb[static_cast<std::size_t>((v * width + u) * 3 + k)];
          channel = mixed(channel, colour.at(static_cast<std::size_t>(k)), share);
        }
      }
    x += glyph.advance;
  }
  return x;
}

int Canvas::text_width(std::string_view utf8, int size_px) {
  int width = 0;
  while (!utf8.empty()) width += Font::of_this_thread().glyph(next_letter(utf8), size_px).advance;
  return width;
}

std::vector<std::string> wrapped(std::string_view utf8, int size_px, int width, int lines) {
  const std::vector<std::string> words = words_of(utf8);
  std::vector<std::string> result;
  for (std::size_t next = 0; next < words.size() && static_cast<int>(result.size()) < lines;) {
    std::string line = take_line(words, next, size_px, width);
    const bool is_last = static_cast<int>(result.size()) + 1 == lines;
    if (Canvas::text_width(line, size_px) > width || (is_last && next < words.size()))
      line = shortened(line, size_px, width);
    result.push_back(std::move(line));
  }
  return result;
}

}  // namespace stampede
