#include "engine/base/naming.h"

#include <algorithm>
#include <array>
#include <cctype>

namespace stampede {
namespace {

constexpr std::array<std::string_view, 43> kReserved = {
    "and",      "break",    "do",     "else",    "elseif",   "end",    "false",     "for",      "function",
    "goto",     "if",       "in",     "local",   "nil",      "not",    "or",        "repeat",   "return",
    "then",     "true",     "until",  "while",   "object",   "number", "either",    "define",   "when",
    "forall",   "exists",   "domain", "problem", "imply",    "assign", "increase",  "decrease", "total_cost",
    "minimize", "maximize", "metric", "always",  "sometime", "within", "preference"};

bool is_word_of_a_language(std::string_view word) {
  return std::find(kReserved.begin(), kReserved.end(), word) != kReserved.end();
}

}  // namespace

std::optional<std::string> name_fault(std::string_view name) {
  if (name.empty()) return "is empty";
  if (name[0] < 'a' || name[0] > 'z') return "does not start with a letter a-z";
  for (const char c : name) {
    if (!((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_')) return "has more than a-z, 0-9 and _";
  }
  if (is_word_of_a_language(name)) return "is a reserved word of Lua or PDDL";
  return std::nullopt;
}

std::string proposed_name(std::string_view name, const std::vector<std::string>& taken) {
  std::string sound;
  char previous = 0;
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    if (std::isupper(byte) && std::islower(static_cast<unsigned char>(previous))) sound += '_';
    previous = c;
    if (byte < 128 && std::isalnum(byte)) {
      sound += static_cast<char>(std::tolower(byte));
    } else if (!sound.empty() && sound.back() != '_') {
      sound += '_';
    }
  }
  while (!sound.empty() && sound.back() == '_') sound.pop_back();
  if (sound.empty() || sound[0] < 'a' || sound[0] > 'z') sound = "my_" + sound;
  if (sound.back() == '_') sound += "name";
  if (is_word_of_a_language(sound)) sound += "_it";
  const std::string stem = sound;
  for (int i = 2; std::find(taken.begin(), taken.end(), sound) != taken.end(); ++i)
    sound = stem + "_" + std::to_string(i);
  return sound;
}

}  // namespace stampede
