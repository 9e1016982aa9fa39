#include "engine/base/shared_list.h"

#include <catch2/catch.hpp>
#include <string>

using namespace stampede;

namespace {

using List = SharedList<std::string, 4>;

List counted(int count) {
  List list;
  for (int i = 0; i < count; ++i) list.push_back(std::to_string(i));
  return list;
}

std::string all_of(const List& list) {
  std::string text;
  for (const std::string& one : list) text += one + " ";
  return text;
}

}  // namespace

TEST_CASE("a copy of a shared list and the list itself go ways of their own") {
  List list = counted(10);
  const List kept = list;
  List other = list;
  list.push_back("x");
  list.edit(0) = "y";
  other.shorten(5);
  other.push_back("z");
  CHECK(all_of(kept) == "0 1 2 3 4 5 6 7 8 9 ");
  CHECK(all_of(list) == "y 1 2 3 4 5 6 7 8 9 x ");
  CHECK(all_of(other) == "0 1 2 3 4 z ");
  list.erase(1);
  CHECK(all_of(list) == "y 2 3 4 5 6 7 8 9 x ");
  list = kept;
  list.edit_back() = "last";
  CHECK(kept.back() == "9");
  CHECK(list.back() == "last");
  CHECK(list.front() == "0");
  CHECK_THROWS_AS(list.at(10), std::out_of_range);
}

TEST_CASE("what a shared list gives away is its own, and a copy keeps its part") {
  List list = counted(9);
  const List kept = list;
  list.push_back("9");
  CHECK(list.take().size() == 10);
  CHECK(list.empty());
  CHECK(kept.copy() == counted(9).take());
  List few = kept;
  few.keep_last(2);
  CHECK(all_of(few) == "7 8 ");
  few.keep_last(5);
  CHECK(few.size() == 2);
  few.clear();
  few.push_back("a");
  CHECK(all_of(few) == "a ");
  CHECK(all_of(kept) == "0 1 2 3 4 5 6 7 8 ");
}

TEST_CASE("elements that copies have in common lie in one place until one of them changes") {
  List list = counted(12);
  List copy = list;
  CHECK(&list[0] == &copy[0]);
  CHECK(&list[11] == &copy[11]);
  copy.edit(5) = "other";
  CHECK(&list[0] == &copy[0]);
  CHECK(&list[5] != &copy[5]);
  CHECK(&list[11] == &copy[11]);
}
