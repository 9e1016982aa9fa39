#include "scripting/library/naming.h"

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

}  // namespace

int edit_distance(std::string_view a, std::string_view b) {
  std::vector<int> before(b.size() + 1), last(b.size() + 1), now(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = static_cast<int>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    now[0] = static_cast<int>(i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      now[j] = std::min({last[j] + 1, now[j - 1] + 1, last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) now[j] = std::min(now[j], before[j - 2] + 1);
    }
    std::swap(before, last);
    std::swap(last, now);
  }
  return last[b.size()];
}

std::optional<std::string> nearest(std::string_view word, const std::vector<std::string>& known) {
  std::optional<std::string> best;
  const int limit = std::max(1, static_cast<int>(std::min<std::size_t>(word.size(), 64) + 2) / 3);
  int best_distance = limit + 1;
  for (const std::string& candidate : known) {
    const int distance = edit_distance(word.substr(0, 64), candidate);
    if (distance < best_distance || (distance == best_distance && best && candidate < *best)) {
      best_distance = distance;
      best = candidate;
    }
  }
  return best;
}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& known) {
  if (const auto best = nearest(word, known)) return "did you mean '" + *best + "'?";
  if (known.empty() || known.size() > 24) return {};
  std::vector<std::string> sorted = known;
  std::sort(sorted.begin(), sorted.end());
  std::string text = "known: ";
  for (std::size_t i = 0; i < sorted.size(); ++i) text += (i > 0 ? ", " : "") + sorted[i];
  return text;
}

bool is_reserved(std::string_view word) {
  return std::find(kReserved.begin(), kReserved.end(), word) != kReserved.end();
}

std::optional<std::string> name_fault(std::string_view name) {
  if (name.empty()) return "is empty";
  if (name[0] < 'a' || name[0] > 'z') return "does not start with a letter a-z";
  for (const char c : name) {
    if (!((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_')) return "has more than a-z, 0-9 and _";
  }
  if (is_reserved(name)) return "is a reserved word of Lua or PDDL";
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
  if (is_reserved(sound)) sound += "_it";
  const std::string stem = sound;
  for (int i = 2; std::find(taken.begin(), taken.end(), sound) != taken.end(); ++i)
    sound = stem + "_" + std::to_string(i);
  return sound;
}

}  // namespace stampede
