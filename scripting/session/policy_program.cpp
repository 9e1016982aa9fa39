#include "scripting/session/policy_program.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <thread>
#include <utility>

#include "db/table_text.h"
#include "engine/base/error.h"

namespace stampede {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr milliseconds kFarewell{1000};  // from the end of its input to its death
constexpr milliseconds kGlance{20};      // how often `stop` is looked at

// Writing to a program that has ended is an error number, not a signal, whatever the process thinks of SIGPIPE.
class NoPipeSignal {
 public:
  NoPipeSignal() {
    sigemptyset(&pipe_);
    sigaddset(&pipe_, SIGPIPE);
    sigset_t pending;
    sigpending(&pending);
    had_ = sigismember(&pending, SIGPIPE) == 1;
    pthread_sigmask(SIG_BLOCK, &pipe_, &before_);
  }
  ~NoPipeSignal() {
    const int number = errno;
    constexpr timespec kNow{};
    if (!had_)
      while (sigtimedwait(&pipe_, nullptr, &kNow) < 0 && errno == EINTR) continue;
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
    errno = number;
  }
  NoPipeSignal(const NoPipeSignal&) = delete;
  NoPipeSignal& operator=(const NoPipeSignal&) = delete;

 private:
  sigset_t pipe_{}, before_{};
  bool had_ = false;
};

void close_end(int& end) {
  if (end >= 0) close(end);
  end = -1;
}

struct Pipe {
  Pipe() {
    if (pipe2(ends.data(), O_CLOEXEC) != 0)
      throw Error("--policy", std::string("no pipe can be opened: ") + std::strerror(errno), "close some files");
  }
  ~Pipe() {
    for (int& end : ends) close_end(end);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  int take(std::size_t which) { return std::exchange(ends[which], -1); }
  std::array<int, 2> ends{-1, -1};  // to read, to write
};

std::string seconds(milliseconds time) {
  return time.count() % 1000 == 0 ? std::to_string(time.count() / 1000) + " s" : std::to_string(time.count()) + " ms";
}

}  // namespace

std::string shown_line(std::string_view line) {
  constexpr std::size_t kMost = 160;
  if (line.size() <= kMost) return json_text(line);
  return json_text(line.substr(0, kMost)) + " … (" + std::to_string(line.size()) + " bytes)";
}

PolicyProgram::PolicyProgram(std::string command, milliseconds patience, const std::atomic<bool>* stop)
    : command_(std::move(command)), patience_(patience), stop_(stop) {
  Pipe input, output;
  try {
    program_.emplace(command_, input.ends[0], output.ends[1], ShellProgram::Group::own, ShellProgram::Orphans::adopted);
  } catch (const std::system_error& error) {
    fail("the program could not be started: " + error.code().message(), "let this user start processes");
  }
  in_ = input.take(1);
  out_ = output.take(0);
  for (const int end : {in_, out_}) fcntl(end, F_SETFL, fcntl(end, F_GETFL) | O_NONBLOCK);
}

PolicyProgram::~PolicyProgram() {
  close_end(in_);
  wait_for_end(kFarewell);
  program_.reset();
  close_end(out_);
}

void PolicyProgram::fail(const std::string& what, const std::string& cure) const {
  throw Error("--policy", what, cure + (cure.empty() ? "" : "; ") + "the command is `" + command_ + "`");
}

std::optional<int> PolicyProgram::wait_for_end(milliseconds patience) const {
  for (const auto end = Clock::now() + patience;;) {
    siginfo_t about{};
    if (waitid(P_PID, static_cast<id_t>(program_->process()), &about, WEXITED | WNOHANG | WNOWAIT) == 0 &&
        about.si_pid != 0)
      return about.si_code == CLD_EXITED ? about.si_status : -about.si_status;
    if (Clock::now() >= end || stopped()) return std::nullopt;
    std::this_thread::sleep_for(milliseconds(5));
  }
}

void PolicyProgram::complain_of_end() {
  const std::optional<int> status = wait_for_end(kFarewell);
  const std::string left = unread_.empty() ? "" : "; its last line has no end: " + shown_line(unread_);
  if (status == 126 || status == 127)
    fail("the program could not be started: the shell ended with code " + std::to_string(*status),
         "check its path, and that it may be executed");
  const std::string how = !status        ? "closed its standard output"
                          : *status >= 0 ? "ended with code " + std::to_string(*status)
                                         : "was killed by signal " + std::to_string(-*status);
  fail("the program " + how + " where " + awaited_ + " was awaited" + left,
       "it answers line by line until its standard input ends");
}

void PolicyProgram::read_some() {
  std::array<char, 1 << 16> piece;
  const ssize_t count = read(out_, piece.data(), piece.size());
  if (count > 0) unread_.append(piece.data(), static_cast<std::size_t>(count));
  if (count == 0) close_end(out_);
}

void PolicyProgram::write_some() {
  const NoPipeSignal quiet;
  const ssize_t count = write(in_, unsent_.data(), unsent_.size());
  if (count > 0) unsent_.erase(0, static_cast<std::size_t>(count));
  if (count < 0 && errno == EPIPE) close_end(in_);
}

bool PolicyProgram::take_line() {
  const std::size_t end = unread_.find('\n');
  if (std::min(end, unread_.size()) > kLongestPolicyLine)
    fail(
        "a line of the program is longer than " + std::to_string(kLongestPolicyLine) + " bytes: " + shown_line(unread_),
        awaited_ + " is awaited, in one line");
  if (end == std::string::npos) return false;
  line_ = unread_.substr(0, end);
  unread_.erase(0, end + 1);
  ++answers_;
  return true;
}

// Reads and writes as either is possible, so that neither side waits for ever for the other to listen.
PolicyProgram::Progress PolicyProgram::exchange(bool answered) {
  const auto end = Clock::now() + patience_;
  while (true) {
    if (in_ < 0) unsent_.clear();
    if (unsent_.empty() && (!answered || take_line())) return Progress::done;
    if (out_ < 0 && answered) complain_of_end();
    if (stopped()) return Progress::stopped;
    const auto left = std::chrono::duration_cast<milliseconds>(end - Clock::now());
    if (left.count() <= 0 && !unsent_.empty())
      fail("the program did not read its standard input for " + seconds(patience_),
           "it reads a line before each answer");
    if (left.count() <= 0)
      fail("the program said nothing for " + seconds(patience_) + " where " + awaited_ + " was awaited",
           "write out each line at once (print(…, flush=True)), or give it more time with --policy-timeout");
    const bool full = unread_.size() > kLongestPolicyLine;
    std::array<pollfd, 2> ends = {pollfd{full ? -1 : out_, POLLIN, 0}, pollfd{unsent_.empty() ? -1 : in_, POLLOUT, 0}};
    if (poll(ends.data(), ends.size(), static_cast<int>(std::min(left, kGlance).count())) <= 0) continue;
    if (ends[0].revents != 0) read_some();
    if (ends[1].revents != 0) write_some();
  }
}

std::optional<std::string> PolicyProgram::ask(const std::string& line, std::string_view awaited) {
  if (out_ >= 0) read_some();
  awaited_ = awaited;
  if (!unread_.empty())
    fail("the program wrote a line that nobody had asked for: " + shown_line(unread_.substr(0, unread_.find('\n'))),
         "one line for each reset and step, none for a step that is terminated or truncated, and nothing else on "
         "standard output");
  unsent_ = line + "\n";
  if (exchange(true) == Progress::stopped) return std::nullopt;
  return std::exchange(line_, {});
}

void PolicyProgram::tell(const std::string& line) {
  unsent_ = line + "\n";
  exchange(false);
}

}  // namespace stampede
