#include "scripting/program/progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <ostream>

namespace stampede::program {

std::string duration_text(double seconds) {
  const auto whole = static_cast<std::int64_t>(seconds + 0.5);
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} h {:02} min", whole / 3600, whole / 60 % 60);
}

namespace {

// Eighths of a column, so that a bar of 30 columns shows 240 positions.
std::string bar(double fraction, int columns) {
  static constexpr const char* kEighths[] = {"", "▏", "▎", "▍", "▌", "▋", "▊", "▉"};
  const int eighths = std::clamp(static_cast<int>(fraction * columns * 8), 0, columns * 8);
  std::string text = repeated("█", eighths / 8) + kEighths[eighths % 8];
  return text + repeated("·", columns - display_width(text));
}

}  // namespace

std::string progress_line(const ProgressState& state, int width) {
  std::string facts;
  if (state.finished > 0) {
    const double per_s = state.elapsed_s > 0 ? static_cast<double>(state.finished) / state.elapsed_s : 0;
    facts = fmt::format("{:.0f} % success, {:.1f} episodes/s",
                        100.0 * static_cast<double>(state.succeeded) / static_cast<double>(state.finished), per_s);
    if (state.done < state.total && per_s > 0) {
      facts += ", " + duration_text(static_cast<double>(state.total - state.done) / per_s) + " left";
    }
  }
  const std::string count = fmt::format("{}/{}", state.done, state.total);
  const int columns = std::clamp(width - display_width(count) - display_width(facts) - 6, 5, 40);
  const double fraction = state.total > 0 ? static_cast<double>(state.done) / static_cast<double>(state.total) : 1;
  return count + " [" + bar(fraction, columns) + "] " + facts;
}

void Progress::update(ProgressState state, const std::string& line) {
  state.elapsed_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  if (console_.err_is_terminal) {
    (console_.bare_err == nullptr ? console_.err : *console_.bare_err)
        << "\r\033[K" << progress_line(state, console_.width - 1) << std::flush;
    drawn_ = true;
    return;
  }
  const double rate = state.elapsed_s > 0 ? static_cast<double>(state.finished) / state.elapsed_s : 0;
  console_.err << fmt::format("[{}/{}] {} ({:.1f} episodes/s)\n", state.done, state.total, line, rate) << std::flush;
}

void Progress::finish() {
  if (drawn_) console_.err << std::endl;
  drawn_ = false;
}

}  // namespace stampede::program
