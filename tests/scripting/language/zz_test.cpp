#include <catch2/catch.hpp>
#include <iostream>
#include "shipped.h"
using namespace stampede;
TEST_CASE("zz","[.zz]"){
  const Meaning& m=shipped::meaning(std::getenv("TASK"));
  const Reading r=read_sentence(std::getenv("TEXT"),m);
  for(auto&w:r.words) std::cout<<w.text<<"/"<<w.sense<<"/"<<(int)w.kind<<" ";
  std::cout<<"\n";
  for(auto&x:r.mentions){ std::cout<<x.sense<<" role="<<x.role<<" prep="<<x.preposition<<" n="<<x.count.value_or(-1)<<" aside="<<x.aside<<" :"; for(auto&t:x.things) std::cout<<" "<<t; std::cout<<"\n";}
  for(auto&t:m.things) if(t.wanted) std::cout<<t.name<<(t.handled?" H":"")<<(t.moved?" M":"")<<(t.source?" S":"")<<(t.destination?" D":"")<<"\n";
  auto v=SentenceChecker(m).check(std::getenv("TEXT")); std::cout<<(v.ok()?"OK":std::string(to_string(*v.reason))+" "+v.detail)<<"\n";
}
