#include "engine/base/base64.h"

#include <catch2/catch.hpp>

#include "engine/base/error.h"
#include "engine/base/random.h"

using namespace stampede;

TEST_CASE("base64 writes what RFC 4648 says") {
  const std::vector<std::pair<std::string, std::string>> vectors = {{"", ""},
                                                                    {"f", "Zg=="},
                                                                    {"fo", "Zm8="},
                                                                    {"foo", "Zm9v"},
                                                                    {"foob", "Zm9vYg=="},
                                                                    {"fooba", "Zm9vYmE="},
                                                                    {"foobar", "Zm9vYmFy"},
                                                                    {std::string("\0\xff\xfb", 3), "AP/7"}};
  for (const auto& [bytes, text] : vectors) {
    CHECK(to_base64(bytes) == text);
    CHECK(from_base64(text) == bytes);
  }
}

TEST_CASE("any bytes survive base64") {
  Random random(RandomKey("base64"));
  for (std::size_t size = 0; size < 200; ++size) {
    std::string bytes;
    for (std::size_t i = 0; i < size; ++i) bytes += static_cast<char>(random.below(256));
    CHECK(from_base64(to_base64(bytes)) == bytes);
  }
}

TEST_CASE("what base64 never writes is an error") {
  for (const std::string bad : {"Z", "Zg", "Zg=", "Z===", "====", "Zg==Zg==", "Zm9=v", "Zm9v\n", "Zm 9", "Zm-_",
                                "Zh==", "Zm9=", "=m9v", "Zm9v===="}) {
    INFO(bad);
    CHECK_THROWS_AS(from_base64(bad), Error);
  }
}
