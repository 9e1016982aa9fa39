#include "engine/geometry/careful.h"

#include <cstdio>
#include <fstream>
#include <map>
#include <mutex>
#include <sstream>

#include "engine/base/child_process.h"
#include "engine/base/error.h"
#include "engine/base/hash.h"
#include "engine/geometry/bytes.h"
#include "engine/geometry/import.h"

namespace stampede {
namespace fs = std::filesystem;
namespace {

constexpr std::uintmax_t kLargestFile = std::uintmax_t{256} << 20;
constexpr std::size_t kMostKept = std::size_t{512} << 20;  // bytes of all that is remembered

std::string hash_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return content_hash(std::move(text).str());
}

struct Kept {
  std::mutex reading;                                        // who comes second waits for who came first
  std::string hash;                                          // of the file; empty: not read yet
  std::vector<std::pair<fs::path, std::string>> companions;  // and their hashes
  std::shared_ptr<const std::string> bytes;

  bool holds(const std::string& file_hash) const {
    if (hash.empty() || hash != file_hash) return false;
    for (const auto& [path, content] : companions)
      if (hash_of(path) != content) return false;
    return true;
  }
};

struct Memory {
  std::mutex guard;
  std::size_t bytes = 0;
  std::map<std::string, std::shared_ptr<Kept>> kept;  // by file and question
};

Memory& memory() {
  static Memory* const all = new Memory;  // never ends: threads may outlive static objects
  return *all;
}

void check_file(const fs::path& file, const FileScope& scope) {
  std::error_code ignored;
  scope.check(file);
  if (!fs::is_regular_file(file, ignored))
    throw Error(file.string(), "there is no such mesh file",
                "check the name; it is looked for beside the file that uses it");
  const std::uintmax_t size = fs::file_size(file, ignored);
  if (size > kLargestFile)
    throw Error(file.string(), "the mesh file is larger than " + std::to_string(kLargestFile >> 20) + " MiB",
                "reduce it: hundreds of triangles are enough to collide, thousands to be seen");
}

// Time grows with what there is to read; nothing honest comes near.
ChildLimits limits_for(const fs::path& file) {
  std::error_code ignored;
  ChildLimits limits;
  limits.cpu_s = 2 + static_cast<int>(fs::file_size(file, ignored) >> 21);
  return limits;
}

void read_into(Kept& kept, const fs::path& file, const std::function<std::string(Companions&)>& read) {
  const std::string answer = in_child(file.string(), kMeshCure, limits_for(file), [&read] {
    Companions companions;
    const std::string bytes = read(companions);
    ByteWriter out;
    out.put(static_cast<std::uint64_t>(companions.size()));
    for (const fs::path& path : companions) out.put(std::string_view(path.string()));
    out.put(std::string_view(bytes));
    return out.take();
  });
  ByteReader in(answer);
  kept.companions.clear();
  for (auto count = in.get<std::uint64_t>(); count > 0; --count) {
    const fs::path path = in.text();
    kept.companions.emplace_back(path, hash_of(path));
  }
  kept.bytes = std::make_shared<const std::string>(in.text());
}

std::shared_ptr<Kept> place_for(const std::string& key) {
  Memory& all = memory();
  const std::scoped_lock lock(all.guard);
  if (all.bytes > kMostKept) {
    all.kept.clear();
    all.bytes = 0;
  }
  std::shared_ptr<Kept>& kept = all.kept[key];
  if (!kept) kept = std::make_shared<Kept>();
  return kept;
}

}  // namespace

std::string exact(const Vector3& scale) {
  char text[96];
  std::snprintf(text, sizeof text, " %a %a %a", scale.x(), scale.y(), scale.z());
  return text;
}

std::shared_ptr<const std::string> read_carefully(const fs::path& file, const std::string& question,
                                                  const FileScope& scope,
                                                  const std::function<std::string(Companions&)>& read) {
  check_file(file, scope);
  std::string key = fs::absolute(file).string() + '\n' + question;
  for (const fs::path& root : scope.roots()) key += '\n' + root.string();
  const std::shared_ptr<Kept> kept = place_for(key);
  const std::scoped_lock lock(kept->reading);
  const std::string hash = hash_of(file);
  if (!kept->holds(hash)) {
    kept->hash.clear();  // what is refused is tried again: perhaps a picture was missing
    read_into(*kept, file, read);
    kept->hash = hash;
    Memory& all = memory();
    const std::scoped_lock counting(all.guard);
    all.bytes += kept->bytes->size();
  }
  return kept->bytes;
}

}  // namespace stampede
