// Where the program speaks: stdout is the answer, stderr the story.
#pragma once

#include <atomic>
#include <iosfwd>
#include <string>
#include <string_view>

namespace stampede::program {

struct Console {
  std::ostream& out;
  std::ostream& err;
  bool out_is_terminal = false;
  bool err_is_terminal = false;
  int width = 100;                          // columns of the terminal, or what to assume elsewhere
  const std::atomic<bool>* stop = nullptr;  // set by a signal; never null in the program
  // The streams below those, which run_program makes printable: what an output called `-` goes to, and lines that
  // change.
  std::ostream* data = nullptr;
  std::ostream* bare_err = nullptr;

  bool stopped() const { return stop != nullptr && stop->load(std::memory_order_relaxed); }
};

// Columns that UTF-8 text takes on a terminal; each code point counts as one.
int display_width(std::string_view text);
// Cut to `width` columns, the last of them `…`, or padded with blanks.
std::string clipped(std::string_view text, int width);
std::string padded(std::string_view text, int width);  // blanks on the right
// Words of a paragraph in lines of at most `width` columns, each line but the first led by `indent` blanks.
std::string wrapped(std::string_view text, int width, int indent);
std::string repeated(std::string_view piece, int times);

}  // namespace stampede::program
