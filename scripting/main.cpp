#include <signal.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <iostream>

#include "scripting/commands/commands.h"
#include "scripting/program/command_line.h"

namespace {

std::atomic<bool> stop_requested = false;
static_assert(std::atomic<bool>::is_always_lock_free);  // or a signal handler must not touch it

extern "C" void request_stop(int) { stop_requested = true; }

void handle_signals() {
  struct sigaction action = {};
  action.sa_handler = request_stop;
  action.sa_flags = static_cast<int>(SA_RESETHAND);  // asking twice ends at once
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  signal(SIGPIPE, SIG_IGN);  // a closed pipe is a failed write, not a sudden death
  signal(SIGXFSZ, SIG_IGN);  // likewise a file at its size limit: it is a full disk
}

int terminal_width() {
  winsize size{};
  if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col >= 40) return size.ws_col;
  if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col >= 40) return size.ws_col;
  return 100;
}

}  // namespace

// The `stampede` program: signals and the terminal; all else is in commands/ and program/.
int main(int count, char** words) {
  handle_signals();
  stampede::program::Console console{
      std::cout, std::cerr, isatty(STDOUT_FILENO) == 1, isatty(STDERR_FILENO) == 1, terminal_width(), &stop_requested};
  return stampede::program::run_program(stampede::program::all_commands(), {words + 1, words + count}, console);
}
