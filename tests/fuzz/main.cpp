// stampede_fuzz TARGET and libFuzzer's own words: folders to learn in, or files to read once. `.ci/soak fuzz` says how.
#include <cstdio>
#include <cstdlib>

#include "engine/base/error.h"
#include "tests/fuzz/targets.h"

namespace {
const stampede::fuzz::Target* chosen = nullptr;
}

extern "C" __attribute__((visibility("default"))) int LLVMFuzzerInitialize(int* count, char*** words) {
  try {
    chosen = &stampede::fuzz::target(*count > 1 ? (*words)[1] : "");
  } catch (const stampede::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    std::exit(2);
  }
  (*words)[1] = (*words)[0];  // the rest is libFuzzer's
  ++*words, --*count;
  return 0;
}

extern "C" __attribute__((visibility("default"))) int LLVMFuzzerTestOneInput(const unsigned char* bytes,
                                                                             std::size_t size) {
  chosen->read({reinterpret_cast<const char*>(bytes), size});
  return 0;
}
