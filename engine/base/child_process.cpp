#include "engine/base/child_process.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <exception>
#include <string_view>

#include "engine/base/error.h"
#include "engine/base/shell_program.h"

namespace stampede {
namespace {

#ifndef __has_feature  // clang says so of itself
#define __has_feature(name) 0
#endif
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || __has_feature(address_sanitizer)
constexpr bool kSanitized = true;
#else
constexpr bool kSanitized = false;
#endif

// What a child says first; after `failure` come where, what and hint, each ended by a 0.
enum class Answer : char { result = 'r', failure = 'f', no_memory = 'm' };

void limit(int which, rlim_t value) {
  rlimit now{};
  if (getrlimit(static_cast<__rlimit_resource>(which), &now) != 0) return;
  now.rlim_cur = std::min(value, now.rlim_max);
  setrlimit(static_cast<__rlimit_resource>(which), &now);
}

rlim_t address_space_now() {
  std::FILE* const file = std::fopen("/proc/self/statm", "r");
  unsigned long pages = 0;
  if (file != nullptr && std::fscanf(file, "%lu", &pages) != 1) pages = 0;
  if (file != nullptr) std::fclose(file);
  return static_cast<rlim_t>(pages) * static_cast<rlim_t>(sysconf(_SC_PAGESIZE));
}

// In the child: nothing of the parent's is reached by accident, and it ends when it should.
void confine(const ChildLimits& limits, int out) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  for (const int number : {SIGINT, SIGTERM, SIGPIPE, SIGALRM, SIGSEGV, SIGABRT, SIGBUS, SIGFPE})
    signal(number, SIG_DFL);
  signal(SIGXFSZ, SIG_IGN);  // writing a file is an error, not a death
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  const int nothing = open("/dev/null", O_RDWR);
  for (int i = 0; i < 3 && nothing >= 0; ++i) dup2(nothing, i);
  if (out > 3) close_range(3, static_cast<unsigned>(out) - 1, 0);
  close_range(static_cast<unsigned>(out) + 1, ~0U, 0);
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_FSIZE, 0);
  limit(RLIMIT_CPU, static_cast<rlim_t>(limits.cpu_s) * (kSanitized ? 10 : 1));
  if (!kSanitized) limit(RLIMIT_AS, address_space_now() + limits.memory_bytes);
}

bool write_all(int out, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = write(out, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
  return true;
}

[[noreturn]] void be_child(int out, const ChildLimits& limits, const std::function<std::string()>& work) {
  confine(limits, out);
  Answer answer = Answer::result;
  std::string text;
  try {
    text = work();
  } catch (const Error& error) {
    answer = Answer::failure;
    text = error.where() + '\0' + error.message() + '\0' + error.hint() + '\0';
  } catch (const std::bad_alloc&) {
    answer = Answer::no_memory;
  } catch (const std::exception& error) {
    answer = Answer::failure;
    text = std::string(1, '\0') + error.what() + '\0' + '\0';
  }
  const char first = static_cast<char>(answer);
  const bool said = write_all(out, {&first, 1}) && write_all(out, text);
  _exit(said ? 0 : 1);  // no destructors: what they would end is the parent's
}

// Reads until the child closes its end: false when it says too much, or does nothing for minutes.
bool read_all(int in, std::size_t most, int patience_s, std::string& text) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(patience_s);
  std::array<char, 1 << 16> buffer;
  while (true) {
    const auto left =
        std::chrono::duration_cast<std::chrono::milliseconds>(end - std::chrono::steady_clock::now()).count();
    if (left <= 0 || text.size() > most) return false;
    pollfd wait{in, POLLIN, 0};
    if (poll(&wait, 1, static_cast<int>(left)) < 0 && errno != EINTR) return false;
    if (wait.revents == 0) continue;
    const ssize_t count = read(in, buffer.data(), buffer.size());
    if (count == 0) return true;
    if (count > 0) text.append(buffer.data(), static_cast<std::size_t>(count));
    if (count < 0 && errno != EINTR && errno != EAGAIN) return false;
  }
}

std::string megabytes(std::size_t bytes) { return std::to_string(bytes >> 20) + " MiB"; }

std::string end_of(int status, const ChildLimits& limits) {
  if (!WIFSIGNALED(status)) return "reading it ended early";
  switch (WTERMSIG(status)) {
    case SIGXCPU:
      return "reading it takes more than " + std::to_string(limits.cpu_s) + " s";
    case SIGINT:
    case SIGTERM:
      return "reading it was interrupted";
    case SIGKILL:
      return "reading it was stopped";
    default:
      return "its reader crashes: the file is malformed, or nested too deep";
  }
}

}  // namespace

std::string in_child(const std::string& where, const std::string& hint, const ChildLimits& limits,
                     const std::function<std::string()>& work) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) throw Error(where, "no pipe can be opened to read it", "close some files");
  const pid_t child = fork();
  if (child == 0) be_child(ends[1], limits, work);
  const OwnChild known(child);
  close(ends[1]);
  if (child < 0) {
    close(ends[0]);
    throw Error(where, "no process can be started to read it", "let this user start more processes");
  }
  std::string text;
  // The clock is for a child that waits for ever; one that works is ended by its limit of processor time long before.
  const bool whole = read_all(ends[0], limits.output_bytes, 60 * limits.cpu_s, text);
  close(ends[0]);
  if (!whole) kill(child, SIGKILL);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
  if (!whole && text.size() > limits.output_bytes)
    throw Error(where, "what is read from it takes more than " + megabytes(limits.output_bytes), hint);
  const Answer answer = text.empty() ? Answer::result : static_cast<Answer>(text[0]);
  if (answer == Answer::no_memory)
    throw Error(where, "reading it takes more than " + megabytes(limits.memory_bytes) + " of memory", hint);
  if (!whole || text.empty() || WIFSIGNALED(status) || WEXITSTATUS(status) != 0)
    throw Error(where, end_of(status, limits), hint);
  if (answer == Answer::result) return text.erase(0, 1);
  const char* const place = text.c_str() + 1;
  const char* const what = place + std::strlen(place) + 1;
  const char* const cure = what + std::strlen(what) + 1;
  throw Error(*place == '\0' ? where : place, what, *cure == '\0' ? hint : cure);
}

}  // namespace stampede
