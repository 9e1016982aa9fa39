#include <catch2/catch.hpp>
#include <cstdlib>
#include <iostream>
#include "shipped.h"
using namespace stampede;
TEST_CASE("debug", "[.]") {
  const Meaning& m = shipped::meaning(std::getenv("T"));
  for (const auto& s : m.steps) { std::cout << s.action; for (auto& a : s.arguments) std::cout << " " << a; std::cout << "\n"; }
  for (const auto& t : m.things) { std::cout << t.name << " [" << t.phrase << "] heads:"; for (auto& h : t.heads) std::cout << " " << h; std::cout << " words:"; for (auto& h : t.words) std::cout << " " << h; std::cout << (t.wanted ? " wanted" : "") << (t.handled ? " handled" : "") << (t.moved ? " moved" : "") << (t.source ? " source" : "") << (t.destination ? " destination" : "") << "\n"; }
  const Reading r = read_sentence(std::getenv("Q"), m);
  for (const auto& w : r.words) std::cout << w.before << w.text << "/" << w.sense << "/" << int(w.kind) << (w.plural ? "+" : "") << " ";
  std::cout << "\n";
  for (const auto& s : r.segments) std::cout << "[" << s.begin << "," << s.end << ") " << s.intro << " verb " << (s.verb ? r.words[*s.verb].sense : "-") << (s.negated ? " neg" : "") << (s.excluding ? " excl" : "") << "\n";
  for (const auto& n : r.mentions) { std::cout << n.role << ": " << n.sense << " <" << n.preposition << "> count " << n.count.value_or(-1) << (n.partitive ? " part" : "") << " :"; for (auto& t : n.things) std::cout << " " << t; std::cout << "\n"; }
  const Verdict v = SentenceChecker(m).check(std::getenv("Q"));
  std::cout << (v.ok() ? "passes" : to_string(*v.reason)) << " " << v.detail << "\n";
}
