#include <semaphore.h>
#include <signal.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <iostream>
#include <string_view>
#include <thread>

#include "engine/base/leftovers.h"
#include "scripting/commands/commands.h"
#include "scripting/program/command_line.h"
#include "scripting/program/exit_code.h"

namespace {

std::atomic<bool> stop_requested = false;
static_assert(std::atomic<bool>::is_always_lock_free);  // or a signal handler must not touch it
sem_t asked_to_stop;

extern "C" void request_stop(int) {
  stop_requested = true;
  sem_post(&asked_to_stop);
}

// Commands look at the flag in their loops. What does not in its time, within a library perhaps, is ended where it
// stands: a catalogue undoes what is half stored in it, and nothing else is read that is half written.
void end_late_ones(std::chrono::milliseconds patience) {
  while (sem_wait(&asked_to_stop) != 0) continue;
  std::this_thread::sleep_for(patience);
  stampede::remove_leftovers();
  constexpr std::string_view kSaid = "interrupted\n";
  [[maybe_unused]] const auto told = write(STDERR_FILENO, kSaid.data(), kSaid.size());
  _exit(stampede::program::kInterrupted);
}

// Those that store are given time to store what is finished.
std::chrono::milliseconds patience_with(std::string_view command) {
  for (const std::string_view storing : {"run", "evaluate", "import", "merge"})
    if (command == storing) return std::chrono::milliseconds(2000);
  return std::chrono::milliseconds(100);
}

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
  sem_init(&asked_to_stop, 0, 0);
  std::thread(end_late_ones, patience_with(count > 1 ? words[1] : "")).detach();
  handle_signals();
  stampede::program::Console console{
      std::cout, std::cerr, isatty(STDOUT_FILENO) == 1, isatty(STDERR_FILENO) == 1, terminal_width(), &stop_requested};
  return stampede::program::run_program(stampede::program::all_commands(), {words + 1, words + count}, console);
}
