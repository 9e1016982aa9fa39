// Bytes as PDDL, for fuzzers: `extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t count)`
// needs to do no more than call `read_as_pddl` and return 0.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string_view>

#include "engine/base/error.h"
#include "engine/symbolic/pddl.h"

namespace stampede::test {

// Reads the bytes as a domain, as a problem of a small domain, as a formula and as a plan. Every complaint must be an
// Error with a place; a domain that is read and written must read as itself. Throws std::logic_error where that fails;
// whatever else escapes is a defect, too.
inline void read_as_pddl(const std::uint8_t* bytes, std::size_t count) {
  const std::string_view text(reinterpret_cast<const char*>(bytes), count);
  static const Domain kSmall = domain_from_pddl(
      "(define (domain d) (:types room thing) (:constants hall - room) (:predicates (in ?t - thing ?r - room)"
      " (lit ?r - room)) (:functions (total-cost) - number (far ?a ?b - room)))",
      "small");
  const auto refuses = [](const auto& read) {
    try {
      read();
    } catch (const Error& error) {
      if (error.where().empty()) throw std::logic_error(std::string("a complaint without place: ") + error.what());
    }
  };
  refuses([&] {
    const Domain domain = domain_from_pddl(text, "domain");
    std::string written;
    try {
      written = to_pddl(domain);
    } catch (const Error&) {
      return;  // names that PDDL keeps for itself, or that differ in nothing
    }
    if (domain_from_pddl(written, "written") != domain) throw std::logic_error("reads otherwise:\n" + written);
  });
  refuses([&] { problem_from_pddl(text, "problem", kSmall); });
  refuses([&] { formula_from_pddl(text, "formula"); });
  refuses([&] { plan_from_text(text, "plan"); });
}

}  // namespace stampede::test
