#include "engine/base/naming.h"

#include <catch2/catch.hpp>

#include "engine/base/enum_names.h"

using namespace stampede;

TEST_CASE("names: distance, neighbours, proposals") {
  CHECK(edit_distance("object", "objects") == 1);
  CHECK(edit_distance("cuont", "count") == 1);  // a swap of neighbours
  CHECK(edit_distance("", "abc") == 3);
  CHECK(nearest("wrold", {"world", "word", "goal"}) == "world");
  CHECK_FALSE(nearest("zzz", {"world"}).has_value());
  CHECK(proposed_name("MyTask 2") == "my_task_2");
  CHECK(proposed_name("3d") == "my_3d");
  CHECK(proposed_name("when") == "when_it");
  CHECK(proposed_name("cup", {"cup", "cup_2"}) == "cup_3");
  CHECK_FALSE(name_fault(proposed_name("Ünicode!")).has_value());
}

TEST_CASE("values of an enumeration have the names of their places, and no other word is one") {
  enum class Side { left, right };
  constexpr std::array<std::string_view, 2> kSides{"left", "right"};
  CHECK(enum_name(kSides, Side::right) == "right");
  CHECK(enum_from<Side>(kSides, "left") == Side::left);
  CHECK_FALSE(enum_from<Side>(kSides, "Left").has_value());
  CHECK_FALSE(enum_from<Side>(kSides, "").has_value());
}
