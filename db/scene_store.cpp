#include <array>
#include <string_view>

#include "db/catalogue_impl.h"
#include "engine/base/hash.h"

namespace stampede {
namespace {

// Quotes inside JSON texts are escaped, so none of these can begin inside one. None of them holds what is drawn anew
// for each start, such as a joint's position: it would be stored whole with each.
constexpr std::array<std::string_view, 6> kSharedKeys{
    "\"shapes\":", "\"grasps\":", "\"drawn\":", "\"limits\":", "\"cameras\":", "\"classes\":"};
constexpr std::string_view kMark = "{\"$asset\":\"";
constexpr std::size_t kWorthIt = 200;  // bytes; a reference takes 46
constexpr std::size_t kHashSize = 32;

// The end of the JSON object or list that begins at `begin`; begin itself when none begins there.
std::size_t end_of_value(std::string_view text, std::size_t begin) {
  int depth = 0;
  bool quoted = false;
  for (std::size_t i = begin; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted) {
      if (c == '\\') ++i;
      if (c == '"') quoted = false;
      continue;
    }
    if (c == '"') quoted = true;
    if (c == '{' || c == '[') ++depth;
    if (c == '}' || c == ']') --depth;
    if (depth == 0) return c == '}' || c == ']' ? i + 1 : begin;
  }
  return begin;
}

std::size_t next_shared_value(std::string_view text, std::size_t from) {
  std::size_t quote = from;
  while ((quote = text.find('"', quote)) != std::string_view::npos) {
    for (const std::string_view key : kSharedKeys)
      if (text.substr(quote, key.size()) == key) return quote + key.size();
    ++quote;
  }
  return text.size();
}

}  // namespace

PackedScene pack_scene(std::string_view document) {
  PackedScene packed;
  std::size_t done = 0;
  for (std::size_t begin = next_shared_value(document, 0); begin < document.size();) {
    const std::size_t end = end_of_value(document, begin);
    if (end - begin > kWorthIt) {
      const std::string_view value = document.substr(begin, end - begin);
      std::string hash = content_hash(value);
      packed.document.append(document.substr(done, begin - done)).append(kMark).append(hash).append("\"}");
      packed.assets.emplace_back(std::move(hash), value);
      done = end;
    }
    begin = next_shared_value(document, end);
  }
  packed.document.append(document.substr(done));
  return packed;
}

std::string unpack_scene(const sql::Database& database, const std::string& packed) {
  sql::Statement find(database, "SELECT body FROM asset WHERE hash = ?1");
  std::string document;
  std::size_t done = 0;
  for (std::size_t mark = packed.find(kMark); mark != std::string::npos; mark = packed.find(kMark, done)) {
    const std::string hash = packed.substr(mark + kMark.size(), kHashSize);
    const std::size_t end = mark + kMark.size() + kHashSize + 2;
    if (end > packed.size() || !find.start(hash).step())
      throw CatalogueError(database.path(), "asset " + hash + " of a scene is missing", "generate the catalogue again");
    std::string body;
    find.read(body);
    document.append(packed, done, mark - done).append(body);
    done = end;
  }
  return document.append(packed, done);
}

}  // namespace stampede
