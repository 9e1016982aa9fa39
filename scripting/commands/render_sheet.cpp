// A contact sheet: an episode at a glance.
#include <fmt/format.h>

#include <algorithm>

#include "engine/render/png.h"
#include "scripting/commands/render_output.h"
#include "scripting/program/command.h"

namespace stampede::program {
namespace {

constexpr std::array<int, 2> kSize{256, 256};
constexpr int kMostColumns = 6, kGap = 10, kLetters = 13, kTitle = 18, kTallest = 30'000;
constexpr std::array<std::uint8_t, 3> kPaper{250, 250, 248}, kInk{30, 32, 36}, kFaint{110, 114, 120},
    kGood{24, 128, 56}, kBad{190, 40, 40};

struct Moment {
  std::int64_t frame = 0;
  double time_s = 0;
  std::string label;
  std::string outcome;  // of the skill, or of the episode
  bool good = true;
};

std::string verdict(Outcome outcome, Reason reason) {
  return outcome == Outcome::success ? "success" : std::string(to_string(reason));
}

// The start, where the effect of each skill comes true, and the end.
std::vector<Moment> moments_of(const EpisodeRecord& episode, const std::vector<Shot>& shots) {
  std::vector<Moment> moments;
  const auto add = [&](std::int64_t frame, std::string label, std::string outcome, bool good) {
    const auto step = episode.frames[static_cast<std::size_t>(frame)].step;
    moments.push_back(
        {frame, static_cast<double>(step) / episode.physics_hz, std::move(label), std::move(outcome), good});
  };
  add(0, "start", "", true);
  for (const Shot& shot : shots)
    if (const SegmentRecord* skill = shot.skill)
      add(shot.telling_frame, label_of(*skill), verdict(skill->outcome, skill->reason),
          skill->outcome == Outcome::success);
  add(static_cast<std::int64_t>(episode.frames.size()) - 1, "end", verdict(episode.outcome, episode.reason),
      episode.outcome == Outcome::success);
  return moments;
}

void write_header(Canvas& canvas, const Drawn& drawn) {
  const EpisodeRecord& episode = drawn.stored.episode;
  const bool good = episode.outcome == Outcome::success;
  const int room = canvas.width - 2 * kGap;
  const std::string title = fmt::format("episode {}: {}", drawn.stored.id, instruction_of(episode));
  for (const std::string& line : stampede::wrapped(title, kTitle, room, 1))
    canvas.text(kGap, kGap + kTitle, line, kTitle, kInk);
  const double seconds = episode.duration_s();
  const int baseline = kGap + 2 * kTitle + 4;
  const int x = canvas.text(kGap, baseline, verdict(episode.outcome, episode.reason), kLetters, good ? kGood : kBad);
  const std::string variation = episode.variation.empty() ? "" : " · " + episode.variation;
  const std::string from = episode.real ? "recorded" : fmt::format("seed {}", episode.seed);
  const std::string facts = fmt::format("{}{} · {} · {:.1f} s", episode.task, variation, from, seconds);
  for (const std::string& line : stampede::wrapped(facts, kLetters, canvas.width - x - 2 * kGap, 1))
    canvas.text(x + kGap, baseline, line, kLetters, kFaint);
}

void write_caption(Canvas& canvas, const Moment& moment, int x, int top, int width) {
  const auto lines = stampede::wrapped(moment.label, kLetters, width, 2);
  int baseline = top + kLetters + 2;
  for (const std::string& line : lines) {
    canvas.text(x, baseline, line, kLetters, kInk);
    baseline += kLetters + 4;
  }
  const std::string time = fmt::format("{:.1f} s  ", moment.time_s);
  const int after = canvas.text(x, baseline, time, kLetters, kFaint);
  canvas.text(after, baseline, moment.outcome, kLetters, moment.good ? kGood : kBad);
}

}  // namespace

Canvas sheet_block(Renderer& renderer, const RenderRequest& request, Drawn& drawn) {
  const Portrait portrait = portrait_of(request, drawn.stored, kSize);
  PortraitPainter painter(renderer, drawn.stored, portrait);
  const std::vector<Moment> moments = moments_of(drawn.stored.episode, painter.shots());
  const int columns = std::min(static_cast<int>(moments.size()), kMostColumns);
  const int rows = (static_cast<int>(moments.size()) + columns - 1) / columns;
  const int header = kGap + 2 * kTitle + 4 + kGap, caption = 3 * (kLetters + 4) + kGap;
  const int wide = painter.width() + kGap, high = painter.height() + caption;
  Canvas canvas(columns * wide + kGap, header + rows * high + kGap, kPaper);
  write_header(canvas, drawn);
  for (std::size_t i = 0; i < moments.size(); ++i) {
    const int x = kGap + static_cast<int>(i) % columns * wide, y = header + static_cast<int>(i) / columns * high;
    painter.paint(moments[i].frame, canvas, x, y);
    write_caption(canvas, moments[i], x, y + painter.height(), painter.width());
    ++drawn.pictures;
  }
  return canvas;
}

OutputKind sheet_kind() { return marked_kind("a picture", "\x89PNG", picture_mark()); }

void write_sheet(const std::filesystem::path& file, const std::vector<Canvas>& blocks, const OutputRules& rules) {
  int width = 0, height = 0;
  for (const Canvas& block : blocks) {
    width = std::max(width, block.width);
    height += block.height;
  }
  if (height > kTallest || width > kTallest)
    throw UsageError(fmt::format("--sheet: {} episodes make a sheet of {} x {} pixels, and {} a side is the most",
                                 blocks.size(), width, height, kTallest),
                     "name fewer episodes, or a smaller --size");
  Canvas sheet(width, height, kPaper);
  auto row = sheet.rgb.begin();
  for (const Canvas& block : blocks) {
    for (int y = 0; y < block.height; ++y, row += static_cast<std::ptrdiff_t>(width) * 3) {
      const auto from = block.rgb.begin() + static_cast<std::ptrdiff_t>(y) * block.width * 3;
      std::copy(from, from + static_cast<std::ptrdiff_t>(block.width) * 3, row);
    }
  }
  const Bytes png = marked_png(sheet.width, sheet.height, sheet.rgb);
  OutputFile out(file, sheet_kind(), rules);
  out.write({reinterpret_cast<const char*>(png.data()), png.size()});
  out.finish();
}

}  // namespace stampede::program
