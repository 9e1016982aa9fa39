// Episodes as a film, with the instruction and the running skill under the picture.
#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "engine/record/observation_choice.h"
#include "scripting/commands/render_output.h"
#include "scripting/program/command.h"
#include "scripting/program/video.h"

namespace stampede::program {
namespace {

constexpr std::array<int, 2> kSize{512, 512};
constexpr std::array<std::uint8_t, 3> kPaper{250, 250, 248}, kInk{30, 32, 36}, kFaint{120, 124, 130},
    kMark{32, 96, 176}, kBad{190, 40, 40};

// Sizes of letters and bands, from the picture's width.
struct Layout {
  explicit Layout(int width_)
      : width(width_), letters(std::clamp(width_ / 32, 9, 28)), margin(letters / 2), line(letters * 4 / 3) {}
  int width, letters, margin, line;
  int band() const { return 3 * line + 2 * margin; }
  int room() const { return width - 2 * margin; }
};

void write_band(Canvas& canvas, const Layout& layout, int top, const EpisodeRecord& episode, std::int64_t frame) {
  canvas.fill(0, top, layout.width, layout.band(), kPaper);
  int baseline = top + layout.margin + layout.letters;
  for (const std::string& line : stampede::wrapped(instruction_of(episode), layout.letters, layout.room(), 2)) {
    canvas.text(layout.margin, baseline, line, layout.letters, kInk);
    baseline += layout.line;
  }
  baseline = top + layout.margin + layout.letters + 2 * layout.line;
  const auto& recorded = episode.frames[static_cast<std::size_t>(frame)];
  const std::string time = fmt::format("{:.1f} s", static_cast<double>(recorded.step) / episode.physics_hz);
  const int time_width = Canvas::text_width(time, layout.letters);
  canvas.text(layout.width - layout.margin - time_width, baseline, time, layout.letters, kFaint);
  const SegmentRecord* skill = skill_at(episode, frame);
  const bool last = frame + 1 == static_cast<std::int64_t>(episode.frames.size());
  const bool good = episode.outcome == Outcome::success;
  const std::string verdict = good ? "success" : std::string(to_string(episode.reason));
  const std::string label = last ? verdict : skill ? label_of(*skill) : "";
  const int room = layout.room() - time_width - layout.letters;
  for (const std::string& line : stampede::wrapped(label, layout.letters, room, 1))
    canvas.text(layout.margin, baseline, line, layout.letters, last && !good ? kBad : kMark);
}

}  // namespace

struct Film::Impl {
  std::filesystem::path file;
  OutputRules rules;
  std::optional<VideoWriter> video;
  int width = 0, height = 0, rate = 0;
};

Film::Film(std::filesystem::path file, OutputRules rules)
    : impl_(new Impl{std::move(file), std::move(rules), {}, 0, 0, 0}) {
  try {
    VideoWriter::check_name(impl_->file);
  } catch (const Error& error) {
    throw UsageError("--video: " + error.message(), error.hint());
  }
  check_output(impl_->file, film_kind(), impl_->rules);
}
Film::~Film() = default;

void Film::add(Renderer& renderer, const RenderRequest& request, Drawn& drawn) {
  const EpisodeRecord& episode = drawn.stored.episode;
  const Portrait portrait = portrait_of(request, drawn.stored, kSize);
  PortraitPainter painter(renderer, drawn.stored, portrait);
  const Layout layout(painter.width());
  const int height = painter.height() + layout.band();
  if (!impl_->video) {
    impl_->video.emplace(impl_->file, painter.width(), height, episode.frame_hz, impl_->rules);
    impl_->width = painter.width();
    impl_->height = height;
    impl_->rate = episode.frame_hz;
  }
  if (painter.width() != impl_->width || height != impl_->height || episode.frame_hz != impl_->rate)
    throw Error(impl_->file.string(),
                fmt::format("episode {} has another rate or other cameras than the first", drawn.stored.id),
                "make a film of each");
  Canvas canvas(impl_->width, impl_->height, kPaper);
  for (const std::int64_t frame : request.frames(episode, WhichFrames::all)) {
    if (request.stopped()) return;
    painter.paint(frame, canvas, 0, 0);
    write_band(canvas, layout, painter.height(), episode, frame);
    impl_->video->add(canvas.rgb);
    ++drawn.frames;
    ++drawn.pictures;
  }
}

void Film::finish() {
  if (impl_->video) impl_->video->finish();
}

}  // namespace stampede::program
