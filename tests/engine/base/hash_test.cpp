#include "engine/base/hash.h"

#include <catch2/catch.hpp>

using namespace stampede;

TEST_CASE("content hashes are XXH3's published values: catalogues of other machines must agree") {
  CHECK(content_hash("") == "99aa06d3014798d86001c324468d497f");
  CHECK(hash64("") == 0x2d06800538d394c2ULL);
}

TEST_CASE("pieces hash like their bytes in a row, texts keep their borders") {
  const std::string bytes = "stampede";
  CHECK(Hasher().bytes(bytes.data(), 3).bytes(bytes.data() + 3, 5).digest() == content_hash(bytes));
  CHECK(Hasher().text("ab").text("c").digest() != Hasher().text("a").text("bc").digest());
  Hasher hasher;
  hasher.text("a");
  const std::string once = hasher.digest();
  CHECK(hasher.digest() == once);
  CHECK(hasher.number(1).digest() != once);
}
