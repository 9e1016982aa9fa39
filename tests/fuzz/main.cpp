// fuzz TARGET SECONDS SEED FOLDER: mutates and reads until the time is over. What is being read lies in FOLDER/TARGET,
// so that it is still there after a crash. A build with -fsanitize-coverage=trace-pc keeps inputs that reach new code.
#include <chrono>
#include <cstdio>
#include <fstream>

#include "engine/base/error.h"
#include "tests/fuzz/mutate.h"

namespace {

constexpr std::size_t kPlaces = 1 << 16;
std::size_t fresh = 0;  // places that no input reached before
std::uint8_t known[kPlaces];

}  // namespace

// GCC calls it in every block of instrumented code.
extern "C" __attribute__((visibility("default"), no_sanitize("address", "undefined"))) void __sanitizer_cov_trace_pc() {
  const auto place = reinterpret_cast<std::uintptr_t>(__builtin_return_address(0));
  const std::size_t at = (place ^ (place >> 16)) % kPlaces;
  if (known[at] == 0) known[at] = 1, ++fresh;
}

namespace stampede::fuzz {
namespace {

// Written before each input is read; the system keeps it when the process dies.
class Witness {
 public:
  explicit Witness(const std::string& file) : file_(file) {}
  void show(const std::string& bytes) const { std::ofstream(file_, std::ios::binary | std::ios::trunc) << bytes; }
  void forget() const { std::remove(file_.c_str()); }

 private:
  std::string file_;
};

int run(const Target& target, double seconds, std::int64_t seed, const std::string& folder) {
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::duration<double>(seconds);
  const Witness witness(folder + "/" + target.name);
  std::vector<std::string> corpus = target.seeds;
  Random random(RandomKey("fuzz").with(target.name).with(seed));
  const auto any = [&] { return static_cast<std::size_t>(random.below(static_cast<std::int64_t>(corpus.size()))); };
  for (const std::string& bytes : corpus) target.read(bytes);
  std::int64_t count = 0;
  double slowest = 0;
  while (Clock::now() < end) {
    const std::string bytes = mutated(corpus[any()], corpus[any()], target.words, random);
    witness.show(bytes);
    fresh = 0;
    const auto start = Clock::now();
    target.read(bytes);
    slowest = std::max(slowest, std::chrono::duration<double>(Clock::now() - start).count());
    if (fresh > 0) corpus.push_back(bytes);
    ++count;
  }
  witness.forget();
  std::printf("%s: %lld inputs, %zu kept, slowest %.2f s\n", target.name.c_str(), static_cast<long long>(count),
              corpus.size(), slowest);
  return 0;
}

}  // namespace
}  // namespace stampede::fuzz

int main(int count, char** words) {
  if (count != 5) {
    std::fprintf(stderr, "fuzz TARGET SECONDS SEED FOLDER; targets:");
    for (const auto& target : stampede::fuzz::targets()) std::fprintf(stderr, " %s", target.name.c_str());
    std::fprintf(stderr, "\n");
    return 2;
  }
  try {
    return stampede::fuzz::run(stampede::fuzz::target(words[1]), std::stod(words[2]), std::stoll(words[3]), words[4]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", words[1], error.what());
    return 1;
  }
}
