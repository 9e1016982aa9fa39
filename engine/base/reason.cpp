#include "engine/base/reason.h"

namespace stampede {

std::string_view to_string(Reason reason) {
  switch (reason) {
#define X(name, text) \
  case Reason::name:  \
    return #name;
    STAMPEDE_REASONS(X)
#undef X
  }
  return "none";
}

std::string_view describe(Reason reason) {
  switch (reason) {
#define X(name, text) \
  case Reason::name:  \
    return text;
    STAMPEDE_REASONS(X)
#undef X
  }
  return "";
}

std::optional<Reason> reason_from(std::string_view name) {
  for (const Reason reason : all_reasons())
    if (to_string(reason) == name) return reason;
  return std::nullopt;
}

const std::vector<Reason>& all_reasons() {
  static const std::vector<Reason> all = {
#define X(name, text) Reason::name,
      STAMPEDE_REASONS(X)
#undef X
  };
  return all;
}

}  // namespace stampede
